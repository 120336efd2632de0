//! The settings at the top of a scene.

use super::Findings;
use crate::format::{Dialect, Scene};
use crate::path::ScenePath;

pub(super) fn check<D: Dialect>(scene: &Scene<D>, found: &mut Findings) {
    let top = ScenePath::root();
    if scene.format != Scene::<D>::FORMAT {
        let message = format!("format {} is not known", scene.format);
        found.error(
            &top.field("format"),
            message,
            format!("this version of tumble reads format {}", Scene::<D>::FORMAT),
        );
    }
    found.positive(&top.field("dt"), "the time step dt", scene.dt);
    found.positive(&top.field("duration"), "the duration", scene.duration);
    if scene.duration > 0.0 && scene.dt > scene.duration {
        let label = format!("{} s, but one step takes {} s", scene.duration, scene.dt);
        found.error(&top.field("duration"), "the duration is shorter than one step", label);
    }
    found.positive(&top.field("length_scale"), "the length scale", scene.length_scale);
    if let Some(slop) = scene.slop {
        found.not_negative(&top.field("slop"), "the slop", slop);
    }
    if scene.every == 0 {
        found.error(&top.field("every"), "`every` must be at least 1", "a sample every 0 steps");
    }
    if scene.bodies.is_empty() {
        found.warning(&top.field("bodies"), "the scene has no bodies", "nothing will happen");
    }
    models(scene, found);
}

fn models<D: Dialect>(scene: &Scene<D>, found: &mut Findings) {
    let penalty = &scene.models.penalty;
    let path = ScenePath::root().field("models").field("penalty");
    let positive = [
        ("stiffness", "the stiffness of penalty contact", penalty.stiffness),
        ("slip_speed", "the slip speed of penalty contact", penalty.slip_speed),
    ];
    for (field, what, value) in positive {
        if let Some(value) = value {
            found.positive(&path.field(field), what, value);
        }
    }
    let not_negative = [
        ("damping", "the damping of penalty contact", penalty.damping),
        ("viscosity", "the viscosity of penalty contact", penalty.viscosity),
    ];
    for (field, what, value) in not_negative {
        if let Some(value) = value {
            found.not_negative(&path.field(field), what, value);
        }
    }
    let impulse = &scene.models.impulse;
    let path = ScenePath::root().field("models").field("impulse");
    for (field, value) in [("iterations", impulse.iterations), ("max_impulses", impulse.max_impulses)] {
        if value == Some(0) {
            found.error(
                &path.field(field),
                format!("`{field}` must be at least 1"),
                "contacts would not be solved at all",
            );
        }
    }
    if let Some(tolerance) = impulse.colliding_tolerance {
        found.not_negative(&path.field("colliding_tolerance"), "the colliding tolerance", tolerance);
    }
    let soft = &scene.models.soft_step;
    let path = ScenePath::root().field("models").field("soft_step");
    if soft.substeps == Some(0) {
        found.error(&path.field("substeps"), "`substeps` must be at least 1", "a step consists of them");
    }
    if let Some(sleep) = &soft.sleep {
        let path = path.field("sleep");
        for (field, what, value) in
            [("speed", "the speed of a sleeper", sleep.speed), ("after", "the time to sleep", sleep.after)]
        {
            if let Some(value) = value {
                found.positive(&path.field(field), what, value);
            }
        }
    }
    let positive = [
        ("frequency", "the frequency of soft contact", soft.frequency),
        ("damping_ratio", "the damping ratio of soft contact", soft.damping_ratio),
        ("push_speed", "the push speed of soft contact", soft.push_speed),
    ];
    for (field, what, value) in positive {
        if let Some(value) = value {
            found.positive(&path.field(field), what, value);
        }
    }
}
