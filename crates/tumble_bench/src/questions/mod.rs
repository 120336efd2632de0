//! Questions about single costs, each answered by ratios of figures measured in turn.

mod measure;
mod models;
mod narrow;
mod scenes;
mod simbenchmark;
mod space;

use std::error::Error;

use clap::ValueEnum;
use tumble_sim::{ContactModel, ContactReport, StepError};
use tumble_solver::Ending;

use crate::Arguments;
use measure::{Timing, bytes_per_body, time_steps};

/// What to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Question {
    /// One free rod body: cost of a step through the whole schedule.
    FreeRod,
    /// Spread-out bodies in free fall: cost per body at 1000 and at 10 000.
    Spread,
    /// 2000 bodies of three rods settle on a floor: faster than real time?
    Settle,
    /// Pyramids of boxes under each model that solves its contacts: cost, and growth with contacts.
    Models,
    /// Pairs of boxes, hulls and cylinders: nanoseconds, beside `parry3d-f64`.
    Narrow,
    /// The shipped scene `opening_pile`: faster than real time? And cost per contact from 1000 to 10 000 contacts in space.
    Space,
    /// SimBenchmark's tables of errors with our rows; takes minutes, so only if asked for.
    Simbenchmark,
    /// Bytes per body and per contact pair.
    Memory,
}

impl Question {
    /// Measures, and prints the answer.
    pub fn answer(self, arguments: &Arguments) -> Result<(), Box<dyn Error>> {
        match self {
            Self::FreeRod => free_rod(arguments)?,
            Self::Spread => spread(arguments)?,
            Self::Settle => settle(arguments)?,
            Self::Models => models::models()?,
            Self::Narrow => narrow::narrow(),
            Self::Space => space::space(arguments.rounds)?,
            Self::Simbenchmark => simbenchmark::simbenchmark(arguments.scene.as_deref(), arguments.smallest_step)?,
            Self::Memory => memory()?,
        }
        Ok(())
    }
}

fn free_rod(arguments: &Arguments) -> Result<(), StepError> {
    let mut rod = scenes::free_rod();
    let free = time_steps(&mut rod, 100_000, arguments.rounds)?;
    let mut resting = scenes::resting_rod();
    let resting = time_steps(&mut resting, 100_000, arguments.rounds)?;
    println!("one free rod                {:8.3} µs a step   (aim: 1)", free.microseconds);
    println!("one rod resting on a floor  {:8.3} µs a step   ({:.1} × free)", resting.microseconds, resting.over(free));
    Ok(())
}

fn spread(arguments: &Arguments) -> Result<(), StepError> {
    let mut small = scenes::spread(1_000);
    let mut large = scenes::spread(10_000);
    let (mut few, mut many) = (Timing::SLOWEST, Timing::SLOWEST);
    // In turn, so that both see the same moods of the machine.
    for _ in 0..arguments.rounds {
        few = few.faster(time_steps(&mut small, 200, 1)?);
        many = many.faster(time_steps(&mut large, 20, 1)?);
    }
    let (few, many) = (few.microseconds / 1_000.0, many.microseconds / 10_000.0);
    println!("spread-out rods,  1000      {:8.4} µs a step and body", few);
    println!(
        "spread-out rods, 10000      {:8.4} µs a step and body   ratio {:.2} (aim: at most 1.5)",
        many,
        many / few
    );
    Ok(())
}

fn settle(arguments: &Arguments) -> Result<(), StepError> {
    match arguments.contact {
        Some(contact) => settle_under(contact, arguments),
        None => [ContactModel::SoftStep, ContactModel::Impulse]
            .into_iter()
            .try_for_each(|contact| settle_under(contact, arguments)),
    }
}

fn settle_under(contact: ContactModel, arguments: &Arguments) -> Result<(), StepError> {
    let steps = arguments.options.steps.unwrap_or(600);
    let mut settled = None;
    // Every round takes the same steps: the fastest time of each one counts.
    let mut fastest = vec![f64::INFINITY; steps as usize];
    let mut unconverged = 0;
    for _ in 0..arguments.rounds {
        let mut pile = scenes::settle(arguments.bodies, contact);
        unconverged = 0;
        for fastest in &mut fastest {
            let started = std::time::Instant::now();
            pile.step()?;
            *fastest = fastest.min(started.elapsed().as_secs_f64());
            let solved = pile.world().resource::<ContactReport>().solved;
            unconverged += u32::from(solved.is_some_and(|report| report.ending == Ending::NotConverged));
        }
        settled = Some(pile);
    }
    let Some(mut pile) = settled else { return Ok(()) };
    let wall: f64 = fastest.iter().sum();
    let slowest = fastest.iter().copied().fold(0.0, f64::max);
    let simulated = f64::from(steps) * pile.settings().dt;
    let figures = scenes::pile_figures(&mut pile);
    println!(
        "{} bodies of three rods, {}: {:.2} s simulated in {:.2} s: {:.2} × real time; {:.2} ms a step, slowest {:.1} ms",
        arguments.bodies,
        contact.word(),
        simulated,
        wall,
        simulated / wall,
        wall / f64::from(steps) * 1e3,
        slowest * 1e3
    );
    println!(
        "    {} near pairs, {} touching points, deepest overlap {:.4} m, {} beyond {:.3} m, fastest body {:.3} m/s; {} steps did not converge",
        figures.pairs,
        figures.touching,
        figures.deepest_overlap,
        figures.deep,
        scenes::DEEP,
        figures.fastest,
        unconverged
    );
    Ok(())
}

fn memory() -> Result<(), StepError> {
    let rods = bytes_per_body(scenes::spread)?;
    println!("memory: {rods:.0} bytes for each body with one rod");
    let compounds = bytes_per_body(|count| scenes::settle(count, ContactModel::Impulse))?;
    println!("memory: {compounds:.0} bytes for each body with three rods, its near pairs included");
    Ok(())
}
