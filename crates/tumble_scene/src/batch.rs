//! Many runs of one scene, with numbers varied from run to run.
//!
//! Every run has a random stream of its own, chosen by the seed and its number alone, and a world of its own: so a run gives the same bits
//! whichever others run, on however many threads, and running its scene singly gives them too.
//!
//! ```
//! use tumble_scene::format::Scene;
//! use tumble_scene::{Batch, Variation};
//!
//! let text = r#"(format: 1, duration: 0.1, bodies: [(name: "ball", at: (0, 5), parts: [Disc(radius: 0.1)])])"#;
//! let varied: Variation = "bodies.ball.velocity.x=-1..1".parse()?;
//! let batch = Batch::new(&Scene::parse(text, "drop.ron")?, vec![varied], 7)?;
//! let runs = batch.run_all(0..100, None);
//! assert!(runs.iter().all(|run| run.end.as_ref().is_ok_and(|end| end.steps == 10)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fmt;
use std::num::NonZero;
use std::ops::Range;
use std::str::FromStr;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use thiserror::Error;
use tumble_math::Planar;
use tumble_record::{Channel, Fingerprint, Record, Recording};
use tumble_sim::{Simulation, StepError};

use crate::build::{BuildError, FromScene};
use crate::diagnostics::{Diagnostics, nearest_or_all};
use crate::dim::SceneDim;
use crate::format::Scene;
use crate::load::Loaded;
use crate::materials::MaterialLibrary;
use crate::overlap::initial_overlaps;
use crate::text::{Kind, Node, parse};

/// A number of a scene that differs from run to run, uniformly distributed from a low value up to a high one.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Where the number stands: names of fields, bodies, joints and keys, `x`, `y`, `z`, and places in lists from 0, with dots between them.
    pub path: String,
    /// The least value.
    pub low: f64,
    /// The value that all others are below.
    pub high: f64,
}

/// Why a batch cannot run.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BatchError {
    /// A variation is not written as one.
    #[error("a variation is written PATH=LOW..HIGH, such as bodies.rod.velocity.x=-1..1, not {0:?}")]
    Form(String),
    /// A range has no number in it.
    #[error("the range {low}..{high} of {path} has no finite number in it")]
    Range {
        /// The path.
        path: String,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// Nothing of a name stands where the path looks for it.
    #[error("{path}: there is no \"{word}\" in {place}: {label}; {help}")]
    Unknown {
        /// The path.
        path: String,
        /// The word that was not found.
        word: String,
        /// Where it was looked for.
        place: String,
        /// The nearest word.
        label: String,
        /// All words.
        help: String,
    },
    /// What stands there is no number.
    #[error("{path}: what stands there is {what}, not a number; give the path of a number in it")]
    NotANumber {
        /// The path.
        path: String,
        /// What it is.
        what: String,
    },
    /// Two variations are of the same number.
    #[error("{0} is varied twice")]
    Twice(String),
    /// With the least or the greatest numbers the scene has mistakes.
    #[error("with {values} the scene is wrong:\n{mistakes}")]
    Scene {
        /// The numbers.
        values: String,
        /// The mistakes.
        mistakes: String,
    },
}

/// One scene, many runs.
#[derive(Debug)]
pub struct Batch<D: SceneDim = Planar> {
    /// The scene as a text, without the numbers that are varied.
    fixed: Vec<String>,
    /// The variations in the order in which their numbers stand in the text.
    order: Vec<usize>,
    variations: Vec<Variation>,
    materials: MaterialLibrary,
    seed: u64,
    shown: Vec<Channel>,
    dimension: std::marker::PhantomData<D>,
}

/// A run of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchRun {
    /// Its number, counted from 0.
    pub number: u64,
    /// The numbers that were varied, in the order of the variations.
    pub values: Vec<f64>,
    /// How it ended.
    pub end: Result<BatchEnd, RunFailure>,
}

/// How a run ended that came to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchEnd {
    /// Steps taken.
    pub steps: u64,
    /// Simulated time [s].
    pub time: f64,
    /// Fingerprint of the last state: that of the same scene run by itself.
    pub fingerprint: Fingerprint,
    /// Last value of each quantity that is to be shown; NaN where it has none.
    pub shown: Vec<f64>,
}

/// Why a run did not come to its end.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RunFailure {
    /// The numbers make no scene.
    #[error("{0}")]
    Scene(String),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
}

impl<D: SceneDim> Batch<D> {
    /// Prepares runs of a scene; the seed chooses the numbers of all of them.
    ///
    /// # Errors
    ///
    /// When a path leads to no number, or the scene has mistakes where all variations are at their least or all at their greatest values.
    pub fn new(loaded: &Loaded<D>, variations: Vec<Variation>, seed: u64) -> Result<Self, BatchError> {
        Self::of_scene(&loaded.scene, loaded.materials.clone(), variations, seed)
    }

    /// The same for a scene that was made in code.
    ///
    /// # Errors
    ///
    /// As for [`new`](Self::new).
    pub fn of_scene(
        scene: &Scene<D>,
        materials: MaterialLibrary,
        variations: Vec<Variation>,
        seed: u64,
    ) -> Result<Self, BatchError> {
        let wrong = |mistakes: String| BatchError::Scene { values: "no variation".to_owned(), mistakes };
        let text = (D::scene_engine().to_plain)(scene).map_err(wrong)?;
        let root = parse(&text).0.ok_or_else(|| wrong("it cannot be written".to_owned()))?;
        let mut places: Vec<(Range<usize>, usize)> = Vec::new();
        for (number, variation) in variations.iter().enumerate() {
            if !(variation.low <= variation.high && (variation.high - variation.low).is_finite()) {
                let Variation { path, low, high } = variation.clone();
                return Err(BatchError::Range { path, low, high });
            }
            places.push((number_at(&root, &variation.path)?, number));
        }
        places.sort_by_key(|(span, _)| span.start);
        if let Some(pair) = places.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(BatchError::Twice(variations[pair[1].1].path.clone()));
        }
        let starts = std::iter::once(0).chain(places.iter().map(|(span, _)| span.end));
        let ends = places.iter().map(|(span, _)| span.start).chain([text.len()]);
        let fixed = starts.zip(ends).map(|(start, end)| text[start..end].to_owned()).collect();
        let order = places.into_iter().map(|(_, number)| number).collect();
        let shown = Vec::new();
        let batch = Self { fixed, order, variations, materials, seed, shown, dimension: std::marker::PhantomData };
        for end in [|variation: &Variation| variation.low, |variation: &Variation| variation.high] {
            let values: Vec<f64> = batch.variations.iter().map(end).collect();
            batch.checked(&values).map_err(|mistakes| BatchError::Scene { values: batch.told(&values), mistakes })?;
        }
        Ok(batch)
    }

    /// Also gives the last values of these quantities.
    ///
    /// # Errors
    ///
    /// When the scene does not have one of them; several curves in one channel count as such.
    pub fn showing(mut self, channels: Vec<Channel>) -> Result<Self, String> {
        let values: Vec<f64> = self.variations.iter().map(|variation| variation.low).collect();
        let (_, mut simulation) = self.built(&values).map_err(|failure| failure.to_string())?;
        simulation.record(1).map_err(|failure| failure.to_string())?;
        let recording = simulation.recording().ok_or("nothing was recorded")?;
        for channel in &channels {
            if channel.series(recording).map_err(|error| error.to_string())?.len() != 1 {
                return Err(format!("channel `{channel}` is of several: name one as `{channel}:NAME`"));
            }
        }
        self.shown = channels;
        Ok(self)
    }

    /// The variations.
    pub fn variations(&self) -> &[Variation] {
        &self.variations
    }

    /// The numbers of a run, in the order of the variations.
    pub fn values(&self, run: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(run);
        // 53 random bits: a share from 0 up to 1.
        let mut share = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        self.variations.iter().map(|Variation { low, high, .. }| low + (high - low) * share()).collect()
    }

    /// The scene of a run, which can be run by itself.
    ///
    /// # Errors
    ///
    /// When the numbers make no scene; says why.
    pub fn scene(&self, run: u64) -> Result<Scene<D>, String> {
        self.checked(&self.values(run)).map(|(scene, _)| scene)
    }

    /// Runs one of the runs.
    pub fn run(&self, number: u64) -> BatchRun {
        let values = self.values(number);
        let end = self.end(&values);
        BatchRun { number, values, end }
    }

    /// Runs some of the runs, in the order of their numbers; on all cores, or on a number of threads.
    pub fn run_all(&self, numbers: Range<u64>, threads: Option<NonZero<usize>>) -> Vec<BatchRun> {
        let run = || numbers.clone().into_par_iter().map(|number| self.run(number)).collect();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZero::get)).build();
        // Without threads of its own it runs where it is.
        pool.map_or_else(|_| numbers.clone().map(|number| self.run(number)).collect(), |pool| pool.install(run))
    }

    fn end(&self, values: &[f64]) -> Result<BatchEnd, RunFailure> {
        let (scene, mut simulation) = self.built(values)?;
        let steps = (scene.duration / scene.dt).round() as u64;
        for _ in 0..steps {
            simulation.step()?;
        }
        // Only the end is looked at, so that no step pays for a record of the others.
        simulation.record(1)?;
        let recording: Recording<D> = simulation.take_recording().unwrap_or_default();
        let last = recording.samples.last().ok_or_else(|| RunFailure::Scene("nothing was recorded".to_owned()))?;
        let shown = self.shown.iter().map(|channel| {
            let series = channel.series(&recording).ok();
            series.and_then(|series| series.first()?.values.last().copied()).unwrap_or(f64::NAN)
        });
        Ok(BatchEnd {
            steps: last.step,
            time: last.time,
            fingerprint: recording.fingerprint(last),
            shown: shown.collect(),
        })
    }

    /// The scene with these numbers, and its simulation.
    fn built(&self, values: &[f64]) -> Result<(Scene<D>, Simulation<D>), RunFailure> {
        let (scene, materials) = self.checked(values).map_err(RunFailure::Scene)?;
        let failed = |error: BuildError| RunFailure::Scene(error.to_string());
        let overlaps = initial_overlaps(&scene, &materials).map_err(failed)?;
        if !overlaps.is_empty() {
            let mut mistakes = Diagnostics::new("the scene", "");
            mistakes.extend(overlaps);
            return Err(RunFailure::Scene(mistakes.to_string()));
        }
        let simulation = Simulation::with_materials(&scene, &materials).map_err(failed)?;
        Ok((scene, simulation))
    }

    /// The scene with these numbers, free of mistakes, and its materials.
    fn checked(&self, values: &[f64]) -> Result<(Scene<D>, MaterialLibrary), String> {
        let mut text = self.fixed[0].clone();
        for (&number, rest) in self.order.iter().zip(&self.fixed[1..]) {
            text.push_str(&format!("{:?}", values[number]));
            text.push_str(rest);
        }
        let scene = (D::scene_engine().of_plain)(&text)?;
        let materials = self.materials.of_variant(&scene);
        scene.check(&materials).map_err(|mistakes| mistakes.to_string())?;
        Ok((scene, materials))
    }

    /// Numbers in words.
    fn told(&self, values: &[f64]) -> String {
        let each = self.variations.iter().zip(values).map(|(variation, value)| format!("{} = {value}", variation.path));
        each.collect::<Vec<_>>().join(", ")
    }
}

/// Where the number of a path stands in the text of a scene.
fn number_at(root: &Node, path: &str) -> Result<Range<usize>, BatchError> {
    let (mut node, mut rest, mut place) = (root.without_some(), path, String::from("the scene"));
    while !rest.is_empty() {
        let children: Vec<(String, &Node)> = match &node.kind {
            Kind::Struct { fields, .. } => fields.iter().map(|(name, value)| (name.text.clone(), value)).collect(),
            Kind::List(items) => {
                let name = |(index, item): (usize, &Node)| name_of(item).unwrap_or_else(|| index.to_string());
                items.iter().enumerate().map(|(index, item)| (name((index, item)), item)).collect()
            }
            Kind::Tuple { items, .. } => {
                let letter = |index: usize| ["x", "y", "z", "w"].get(index).map_or(index.to_string(), |&it| it.into());
                items.iter().enumerate().map(|(index, item)| (letter(index), item)).collect()
            }
            Kind::Map(entries) => {
                entries.iter().filter_map(|entry| Some((text_of(&entry.key)?, &entry.value))).collect()
            }
            _ => Vec::new(),
        };
        // Names may have dots in them: the longest one that fits is meant.
        let fits = |name: &str| rest.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
        let found = children.iter().filter(|(name, _)| fits(name)).max_by_key(|(name, _)| name.len());
        let Some((name, child)) = found else {
            let word = rest.split('.').next().unwrap_or(rest).to_owned();
            let allowed: Vec<&str> = children.iter().map(|(name, _)| name.as_str()).collect();
            let (label, help) = nearest_or_all(&word, "name there", &allowed);
            return Err(BatchError::Unknown { path: path.to_owned(), word, place, label, help });
        };
        rest = rest[name.len()..].trim_start_matches('.');
        place = path[..path.len() - rest.len()].trim_end_matches('.').to_owned();
        node = child.without_some();
    }
    match &node.kind {
        Kind::Number => Ok(node.span.clone()),
        // A number that the scene leaves to its default.
        Kind::Word(word) if word == "None" => Ok(node.span.clone()),
        _ => Err(BatchError::NotANumber { path: path.to_owned(), what: node.describe() }),
    }
}

/// The field `name` of an entry.
fn name_of(entry: &Node) -> Option<String> {
    let Kind::Struct { fields, .. } = &entry.without_some().kind else { return None };
    fields.iter().find(|(name, _)| name.text == "name").and_then(|(_, value)| text_of(value))
}

fn text_of(node: &Node) -> Option<String> {
    if let Kind::Text(text) = &node.kind { Some(text.clone()) } else { None }
}

impl FromStr for Variation {
    type Err = BatchError;

    fn from_str(text: &str) -> Result<Self, BatchError> {
        let form = || BatchError::Form(text.to_owned());
        let (path, range) = text.split_once('=').ok_or_else(form)?;
        let (low, high) = range.split_once("..").ok_or_else(form)?;
        let number = |text: &str| text.trim().parse::<f64>().map_err(|_| form());
        let variation = Self { path: path.trim().to_owned(), low: number(low)?, high: number(high)? };
        if variation.path.is_empty() { Err(form()) } else { Ok(variation) }
    }
}

impl fmt::Display for Variation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}={}..{}", self.path, self.low, self.high)
    }
}
