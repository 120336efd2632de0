//! Cost of the contact models: pyramids of boxes at rest, from two contacts to eight hundred.

use std::time::Instant;

use tumble_sim::{ContactModel, ContactReport, ImpulseSettings, Settings, StepError};
use tumble_solver::Ending;

use super::scenes::{pile_figures, pyramid};

/// A way to answer contacts.
struct Way {
    name: &'static str,
    contact: ContactModel,
    impulse: ImpulseSettings,
    /// Rows of the largest pyramid that it is asked for.
    up_to_rows: u32,
}

/// What came of a pyramid.
struct Figures {
    contacts: usize,
    /// The first step, which knows no impulses [µs].
    cold: f64,
    /// A step of the last hundred, mean [µs].
    warm: f64,
    /// The slowest step but the first [µs].
    slowest: f64,
    /// Largest error left in the last hundred steps [m/s].
    residual: f64,
    unconverged: u32,
}

const ROWS: [u32; 6] = [1, 2, 3, 5, 10, 20];
const STEPS: u32 = 200;
const LAST: u32 = 100;

/// Prints a line per pyramid and model, with the growth from the one before.
pub fn models() -> Result<(), StepError> {
    let to_the_end = ImpulseSettings { iterations: Some(20_000), ..ImpulseSettings::default() };
    let ways = [
        Way { name: "impulse", contact: ContactModel::Impulse, impulse: ImpulseSettings::default(), up_to_rows: 20 },
        Way { name: "impulse, swept to 1e-12", contact: ContactModel::Impulse, impulse: to_the_end, up_to_rows: 20 },
        Way {
            name: "resting-lcp",
            contact: ContactModel::RestingLcp,
            impulse: ImpulseSettings::default(),
            up_to_rows: 5,
        },
        Way {
            name: "velocity-lcp",
            contact: ContactModel::VelocityLcp,
            impulse: ImpulseSettings::default(),
            up_to_rows: 20,
        },
    ];
    println!("pyramids of boxes at rest: µs per step, and the exponent of growth with contacts since the line above");
    println!("model                    contacts     first      warm  slowest  growth  residual [m/s]  not converged");
    for way in &ways {
        let mut before: Option<Figures> = None;
        for rows in ROWS.into_iter().filter(|rows| *rows <= way.up_to_rows) {
            let figures = measure(way, rows)?;
            let growth = before.as_ref().map_or_else(String::new, |before| {
                let more = figures.contacts as f64 / before.contacts as f64;
                format!("{:.1}", (figures.warm / before.warm).log2() / more.log2())
            });
            println!(
                "{:23}  {:8}  {:8.1}  {:8.1}  {:7.0}  {:>6}  {:14.0e}  {} of {STEPS}",
                way.name,
                figures.contacts,
                figures.cold,
                figures.warm,
                figures.slowest,
                growth,
                figures.residual,
                figures.unconverged
            );
            before = Some(figures);
        }
    }
    Ok(())
}

fn measure(way: &Way, rows: u32) -> Result<Figures, StepError> {
    let mut simulation = pyramid(rows, Settings { contact: way.contact, impulse: way.impulse, ..Settings::default() });
    simulation.prepare()?;
    let mut figures = Figures { contacts: 0, cold: 0.0, warm: 0.0, slowest: 0.0, residual: 0.0, unconverged: 0 };
    for step in 0..STEPS {
        let started = Instant::now();
        simulation.step()?;
        let taken = started.elapsed().as_secs_f64() * 1e6;
        let solved = simulation.world().resource::<ContactReport>().solved;
        figures.unconverged += u32::from(solved.is_some_and(|report| report.ending == Ending::NotConverged));
        if step == 0 {
            figures.cold = taken;
        } else {
            figures.slowest = figures.slowest.max(taken);
        }
        if step >= STEPS - LAST {
            figures.warm += taken / f64::from(LAST);
            figures.residual = figures.residual.max(solved.map_or(0.0, |report| report.residual));
        }
    }
    figures.contacts = pile_figures(&mut simulation).touching;
    Ok(figures)
}
