//! `tumble compare`: one scene under several contact models and step sizes, side by side.
//!
//! - [`figures`]: what is measured of a run; [`reference`]: how far it is from a fine one;
//! - [`words`]: the table and the sentence below it, `compare.csv`.

mod figures;
mod reference;
mod words;

use std::path::Path;

use tumble_record::plot::{MOST_BREADTHS, Plot, Strokes};
use tumble_record::{Channel, Completeness, MOST_CURVES, OutputFolder, Recording, Series};
use tumble_scene::expect::watched_steps;
use tumble_scene::format::ContactModel;
use tumble_scene::{AnyLoaded, Loaded, SceneDim};

use crate::args::{CompareArguments, Overrides};
use crate::failure::{Exit, Failure, stderr_color, tell};
use crate::figure::counted;
use crate::interrupt;
use crate::page::Page;
use crate::report;
use crate::run::OUT;
use crate::simulate::{Ending, Prepared, Progress, Run};
use crate::source::Source;
use figures::{Row, resting_bodies};
use reference::Reference;

/// Parts of the smallest step that the reference takes [1].
const REFERENCE_STEPS: u32 = 16;

/// Runs the scene in every combination, prints the table, and writes `compare.csv` and `compare.svg`.
pub fn compare(arguments: &CompareArguments, page: &mut Page) -> Result<Exit, Failure> {
    let source = Source::of(&arguments.scene)?;
    match source.load()? {
        AnyLoaded::Planar(loaded) => compare_loaded(arguments, &source, &loaded, page),
        AnyLoaded::Spatial(loaded) => compare_loaded(arguments, &source, &loaded, page),
    }
}

fn compare_loaded<D: SceneDim>(
    arguments: &CompareArguments,
    source: &Source,
    loaded: &Loaded<D>,
    page: &mut Page,
) -> Result<Exit, Failure> {
    if !loaded.warnings.is_empty() {
        tell(loaded.warnings.render(stderr_color()));
    }
    let Chosen { cases, left_out, strokes } = choose(arguments, loaded)?;
    let name = source.stem().to_string_lossy().into_owned();
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new(OUT).join(&name).join("compare"));
    let folder = OutputFolder::new(folder);
    // Everything that can be refused is refused before the first long run.
    let mut prepared =
        cases.iter().map(|case| case.prepare(source, loaded)).collect::<Result<Vec<Prepared<D>>, Failure>>()?;
    let channel = channel(arguments, &mut prepared)?;
    let finest = cases.iter().map(|case| case.dt).fold(f64::INFINITY, f64::min);
    // Where nothing is expected, the scene's own model with small steps is the measure.
    let is_claimed = |case: &Case| loaded.scene.expect.iter().any(|expected| expected.is_claimed_under(case.contact));
    let fallback = (!cases.iter().any(is_claimed)).then_some(loaded.scene.contact);
    let measure = arguments.reference.or(fallback);
    let reference = measure.map(|contact| Case { contact, dt: finest / f64::from(REFERENCE_STEPS) });
    let reference = reference.map(|case| Reference::prepare(&case, source, loaded)).transpose()?;
    folder.prepare(Completeness::Whole).map(drop)?;
    interrupt::listen();

    let (reference, lost) = match reference.map(Reference::run).transpose()? {
        Some(Ok(reference)) => (Some(reference), None),
        Some(Err(error)) => (None, Some(error)),
        None => (None, None),
    };
    let several_steps = cases.iter().any(|case| case.dt != cases[0].dt);
    let (mut rows, mut curves, mut value_label) = (Vec::new(), Vec::new(), String::new());
    for (case, mut prepared) in cases.iter().zip(prepared) {
        let run = finished(prepared.run(Progress::Shown))?;
        let verdict = prepared.verdict(&run.recording);
        let resting = resting_bodies(&prepared.loaded.scene, &run.recording);
        let row = Row::of(case, &run, &verdict, &resting, reference.as_ref());
        let plot = Plot::channel(&run.recording, &channel)?;
        let label = case.label(several_steps);
        curves.extend(plot.series.into_iter().map(|series| Series { label: label.clone(), ..series }));
        value_label = plot.value_label;
        rows.push(row);
    }

    page.line(format!("{name}: {} of {} s", counted(rows.len() as u64, "run"), loaded.scene.duration));
    page.line("");
    words::table(&rows, measure).iter().for_each(|line| page.line(line));
    page.line("");
    for row in rows.iter().filter(|row| row.failure.is_some()) {
        page.line(format!("{}: {}", row.label(several_steps), row.failure.as_deref().unwrap_or_default()));
    }
    if let Some(contact) = measure {
        let why = if arguments.reference.is_none() { "nothing is expected, so " } else { "" };
        let what = format!("{} with steps of {} s", contact.word(), finest / f64::from(REFERENCE_STEPS));
        page.line(match lost {
            Some(error) => format!("the reference, {what}, failed: {error}"),
            None => format!("{why}errors are distances from {what}"),
        });
    }
    if !left_out.is_empty() {
        let words: Vec<&str> = left_out.iter().map(|model| model.word()).collect();
        page.line(format!("left out, because the scene claims nothing for it: {} (see --contact)", words.join(", ")));
    }
    page.line(words::best(&rows, several_steps, words::Promises::of(&loaded.scene)));
    page.line("");
    let plot = Plot { title: format!("{name}  ·  {}", channel.title()), value_label, series: curves, strokes };
    let mut files = folder.prepare(Completeness::Whole)?;
    files.add("compare.csv", |out| words::write_csv(&rows, out))?;
    files.add("compare.svg", |out| out.write_all(plot.to_svg().as_bytes()))?;
    let files = files.publish()?;
    page.line(report::files(&folder, Completeness::Whole, &files));
    Ok(if rows.iter().any(|row| row.failure.is_none()) { Exit::Fine } else { Exit::RunFailed })
}

/// A contact model and a step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The contact model.
    pub contact: ContactModel,
    /// Length of a step [s].
    pub dt: f64,
}

impl Case {
    fn prepare<D: SceneDim>(&self, source: &Source, loaded: &Loaded<D>) -> Result<Prepared<D>, Failure> {
        let overrides = Overrides { contact: Some(self.contact), dt: Some(self.dt), duration: None };
        // Rest is measured from the beginning of the last tenth on.
        let last_tenth = (0.9 * (loaded.scene.duration / self.dt).round()).round() as u64;
        Prepared::sampled(source, loaded.clone(), &overrides, None, |scene| {
            let mut spans = watched_steps(scene, scene.contact);
            spans.push(last_tenth..=last_tenth);
            spans
        })
    }

    fn label(&self, with_step: bool) -> String {
        if with_step { format!("{} at {} s", self.contact.word(), self.dt) } else { self.contact.word().to_owned() }
    }
}

/// What is compared.
struct Chosen {
    /// Every model with every step size.
    cases: Vec<Case>,
    /// Models that nobody asked for and that the scene claims nothing for.
    left_out: Vec<ContactModel>,
    /// How the curves are drawn: several models with a few steps in a colour for each model, broad to fine in the order of the steps.
    strokes: Strokes,
}

fn choose<D: SceneDim>(arguments: &CompareArguments, loaded: &Loaded<D>) -> Result<Chosen, Failure> {
    refuse_twice("--contact", &arguments.contact, |model| model.word().to_owned())?;
    refuse_twice("--dt", &arguments.dt, f64::to_string)?;
    let scene = &loaded.scene;
    let is_meant = |model: &ContactModel| {
        scene.expect.is_empty() || scene.expect.iter().any(|expectation| expectation.is_claimed_under(*model))
    };
    let (models, left_out): (Vec<ContactModel>, Vec<ContactModel>) = if arguments.contact.is_empty() {
        ContactModel::ALL.into_iter().partition(is_meant)
    } else {
        (arguments.contact.clone(), Vec::new())
    };
    let steps = if arguments.dt.is_empty() { vec![scene.dt] } else { arguments.dt.clone() };
    let cases: Vec<Case> =
        models.iter().flat_map(|&contact| steps.iter().map(move |&dt| Case { contact, dt })).collect();
    if models.len() > 1 && (2..=MOST_BREADTHS).contains(&steps.len()) {
        return Ok(Chosen { cases, left_out, strokes: Strokes::Families { size: steps.len() } });
    }
    if cases.len() > MOST_CURVES {
        let message = format!(
            "{} runs cannot be told apart in one plot: at most {MOST_BREADTHS} time steps of several models, or {MOST_CURVES} runs in all",
            cases.len()
        );
        return Err(Failure::Arguments(message));
    }
    Ok(Chosen { cases, left_out, strokes: Strokes::Dashed })
}

/// Refuses a list with a value that stands in it twice.
fn refuse_twice<T: PartialEq>(flag: &str, values: &[T], word: impl Fn(&T) -> String) -> Result<(), Failure> {
    let twice = values.iter().enumerate().find(|(index, value)| values[..*index].contains(value));
    twice.map_or(Ok(()), |(_, value)| Err(Failure::Arguments(format!("{flag}: {} is given twice", word(value)))))
}

/// The channel of the plot, checked; the total energy if none was asked for.
fn channel<D: SceneDim>(arguments: &CompareArguments, prepared: &mut [Prepared<D>]) -> Result<Channel, Failure> {
    let channel = arguments.plot.clone().map_or_else(|| "total".parse(), Ok)?;
    if let Some(recording) = prepared.first_mut().and_then(Prepared::recording) {
        channel.check(recording)?;
        let count = channel.series(recording)?.len();
        if count != 1 {
            let message = format!("one curve is compared, and `{channel}` has {count}: name one as `{channel}:NAME`");
            return Err(Failure::Arguments(message));
        }
    }
    Ok(channel)
}

/// A run that nobody interrupted.
fn finished<D: SceneDim>(run: Run<D>) -> Result<Run<D>, Failure> {
    match run.ending {
        Ending::Interrupted => Err(Failure::Run("interrupted: nothing was written".to_owned())),
        Ending::Complete | Ending::Failed(_) => Ok(run),
    }
}

/// Time of the last sample [s].
fn end_of<D: SceneDim>(recording: &Recording<D>) -> f64 {
    recording.samples.last().map_or(0.0, |sample| sample.time)
}
