//! Standard output, which may be closed or full.

use std::fmt::Display;
use std::io::{self, Write};

use crate::failure::Failure;

/// Lines on their way to standard output.
///
/// Trouble is kept until the end, so that a reader who has seen enough (`tumble scenes | head -1`) or a full disk keeps no run from
/// writing its files.
pub struct Page {
    out: Box<dyn Write>,
    trouble: Option<io::Error>,
}

impl Page {
    /// Standard output.
    pub fn stdout() -> Self {
        Self::new(io::stdout().lock())
    }

    /// Lines to anywhere.
    pub fn new(out: impl Write + 'static) -> Self {
        Self { out: Box::new(out), trouble: None }
    }

    /// Prints a line, or several.
    pub fn line(&mut self, text: impl Display) {
        if self.trouble.is_none() {
            self.trouble = writeln!(self.out, "{text}").err();
        }
    }

    /// Flushes; a reader who went away is no failure.
    pub fn finish(mut self) -> Result<(), Failure> {
        let trouble = self.trouble.take().or_else(|| self.out.flush().err());
        match trouble {
            Some(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                Err(Failure::Run(format!("cannot write to standard output: {error}")))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Broken(io::ErrorKind);

    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_reader_who_went_away_is_no_failure_and_a_full_disk_is() {
        for (kind, fine) in [(io::ErrorKind::BrokenPipe, true), (io::ErrorKind::StorageFull, false)] {
            let mut page = Page::new(Broken(kind));
            page.line("one");
            page.line("two");
            assert_eq!(page.finish().is_ok(), fine);
        }
    }
}
