//! `tumble`: runs, checks and tests scenes of rigid bodies.
//!
//! - [`args`]: the command line; [`source`]: from its words to scenes;
//! - [`run`], [`check`], [`test`], [`compare`], [`batch`], [`accuracy`], [`scenes`]: one file or folder per command;
//! - [`simulate`]: a scene from its first step to its last, or as far as it gets; [`interrupt`]: Ctrl-C; [`parallel`]: several at a time;
//! - [`report`], [`figure`]: a run in words; [`page`]: standard output, which may be closed or full;
//! - [`failure`]: what can go wrong, and its exit code.

mod accuracy;
mod args;
mod batch;
mod check;
mod compare;
mod failure;
mod figure;
mod interrupt;
mod page;
mod parallel;
mod report;
mod run;
mod scenes;
mod simulate;
mod source;
mod test;

use std::process::ExitCode;

use args::{Arguments, Command, RunArguments};
use clap::Parser;
use failure::{Exit, Failure};
use page::Page;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut page = Page::stdout();
    let done = command(arguments.command.unwrap_or_else(|| Command::Run(RunArguments::default())), &mut page);
    // What was printed matters less than what went wrong before.
    let exit = done.and_then(|exit| page.finish().map(|()| exit));
    exit.unwrap_or_else(|failure| failure.tell()).into()
}

fn command(command: Command, page: &mut Page) -> Result<Exit, Failure> {
    match command {
        Command::Run(arguments) => run::run(&arguments, page),
        Command::Scenes => scenes::scenes(page),
        Command::Check(arguments) => check::check(&arguments, page),
        Command::Test(arguments) => test::test(&arguments, page),
        Command::Compare(arguments) => compare::compare(&arguments, page),
        Command::Batch(arguments) => batch::batch(&arguments, page),
        Command::Accuracy => accuracy::accuracy(page),
        Command::Schema => {
            page.line(tumble_scene::schema());
            Ok(Exit::Fine)
        }
    }
}
