//! `tumble accuracy`: how far each contact model is from closed forms, as the table in the README.
//!
//! The figures are errors of expectations of shipped scenes, whether the scene claims them for a model or not. They are the same on every machine.

use tumble_scene::AnyLoaded;
use tumble_scene::format::ContactModel;
use tumble_scene::shipped::Shipped;

use crate::args::Overrides;
use crate::failure::{Exit, Failure};
use crate::page::Page;
use crate::parallel::in_order;
use crate::simulate::{Ending, Prepared, Progress};
use crate::source::Source;

/// A figure that is known in closed form.
struct Figure {
    /// The shipped scene.
    scene: &'static str,
    /// What is measured, with its unit, and the closed form.
    what: &'static str,
    /// The scene's expectation, as `tumble test` prints it.
    expectation: &'static str,
}

const FIGURES: [Figure; 10] = [
    Figure {
        scene: "angle_of_repose",
        what: "block with tan θ a little below μ_s: stays, drift in 10 s [m]",
        expectation: "AtRest of \"above-barely\" always",
    },
    Figure {
        scene: "quiz_pushed_block",
        what: "block pushed with 2 N/s · t breaks away at μ_s m g: speed at 10 s [m/s]",
        expectation: "VelocityX of \"block\" at 10 s",
    },
    Figure {
        scene: "stopping_distance",
        what: "sliding block stops after v²/(2 μ_k g) [m]",
        expectation: "X of \"standard\" from 1.1 s",
    },
    Figure {
        scene: "rolling_disc",
        what: "thrown disc rolls at 2/3 of its speed [m/s]",
        expectation: "Speed of \"thrown\" from 0.87 s",
    },
    Figure {
        scene: "head_on",
        what: "discs of 2 and 3 kg meet at 5 m/s, ε = 0.6: speed of one after [m/s]",
        expectation: "VelocityX of \"left\" from 0.16 s",
    },
    Figure {
        scene: "newtons_cradle",
        what: "one ball in, one ball out: height of the last of five, 1 − cos 30° [m]",
        expectation: "Y of \"hung-3\" at 1.0205 s",
    },
    Figure {
        scene: "box_stack",
        what: "floor under ten boxes carries 10 m g [N]",
        expectation: "ContactForceSum on \"tower-0\" by \"floor\" at 10 s",
    },
    Figure {
        scene: "pinned_rod_pendulum",
        what: "pinned rod let go from level: angle after 3¼ periods [°]",
        expectation: "Angle of \"from-90\" at 6.283338 s",
    },
    Figure {
        scene: "double_pendulum",
        what: "double pendulum, against minimal coordinates: position at 2 s [m]",
        expectation: "Position of \"second\" at 2 s",
    },
    Figure {
        scene: "hanging_chain",
        what: "pull of a chain of ten rods on its support [N]",
        expectation: "JointForce along x of \"pin-00\" at 20 s",
    },
];

/// Runs the scenes under every model, and prints the table in Markdown.
pub fn accuracy(page: &mut Page) -> Result<Exit, Failure> {
    let runs: Vec<(&Figure, ContactModel)> =
        FIGURES.iter().flat_map(|figure| ContactModel::ALL.map(|model| (figure, model))).collect();
    let mut cells = Vec::new();
    in_order(&runs, |(figure, model)| figure.measure(*model), |_, cell| cells.push(cell));
    let cells = cells.into_iter().collect::<Result<Vec<Cell>, Failure>>()?;

    let words = ContactModel::ALL.map(|model| format!("`{}`", model.word()));
    page.line(format!("| Scene | What is known | Δt [s] | {} |", words.join(" | ")));
    page.line(format!("|---|---|---{}|", "|---".repeat(words.len())));
    for (figure, cells) in FIGURES.iter().zip(cells.chunks(words.len())) {
        let errors: Vec<String> = cells.iter().map(|cell| cell.words()).collect();
        page.line(format!("| `{}` | {} | {} | {} |", figure.scene, figure.what, cells[0].dt, errors.join(" | ")));
    }
    Ok(Exit::Fine)
}

/// The error of a model.
struct Cell {
    /// Length of a step [s].
    dt: f64,
    /// In the unit of the figure; none of a run that failed.
    error: Option<f64>,
}

impl Cell {
    /// Two digits; what is less than rounding lets expect is not told apart.
    fn words(&self) -> String {
        const ROUND_OFF: f64 = 1e-9;
        match self.error {
            None => "failed".to_owned(),
            Some(error) if error <= ROUND_OFF => format!("≤ {ROUND_OFF:e}"),
            Some(error) => format!("{error:.1e}"),
        }
    }
}

impl Figure {
    /// Runs the scene under a model.
    fn measure(&self, model: ContactModel) -> Result<Cell, Failure> {
        let shipped = Shipped::named(self.scene);
        let source = shipped.map(Source::Shipped).ok_or_else(|| self.missing("the scene"))?;
        let AnyLoaded::Planar(mut loaded) = source.load()? else { return Err(self.missing("a scene of the plane")) };
        loaded.scene.expect.iter_mut().for_each(|expectation| expectation.claim_under_all());
        let dt = loaded.scene.dt;
        let overrides = Overrides { contact: Some(model), ..Overrides::default() };
        let mut prepared = Prepared::new(&source, loaded, &overrides, None)?;
        let run = prepared.run(Progress::Hidden);
        if matches!(run.ending, Ending::Failed(_)) {
            return Ok(Cell { dt, error: None });
        }
        let verdict = prepared.verdict(&run.recording);
        let error = verdict
            .outcomes
            .iter()
            .filter(|outcome| outcome.name == self.expectation)
            .find_map(|outcome| outcome.error())
            .ok_or_else(|| self.missing(self.expectation))?;
        Ok(Cell { dt, error: Some(error) })
    }

    fn missing(&self, what: &str) -> Failure {
        Failure::Run(format!("the table cannot be made: {what} is missing from \"{}\"", self.scene))
    }
}
