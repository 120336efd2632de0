//! Penalty contact: its limit for hard contacts (L4), and the homework's floor to the letter (R9).

use crate::support::weightless;
use crate::support::{
    G, assert_near, assert_vector_near, ball, body, bouncing, direction, every, floor, rod, simulation,
};
use glam::{DVec2, dvec2};
use tumble_math::trig;
use tumble_sim::{ContactModel, PenaltyLaw, PenaltySettings, Settings, SpringDamperSettings};
use tumble_solver::penalty::{damping_coefficient, damping_ratio};

fn penalty(settings: Settings, stiffness: f64, damping: Option<f64>) -> Settings {
    let law = SpringDamperSettings { stiffness: Some(stiffness), damping, ..SpringDamperSettings::default() };
    Settings {
        contact: ContactModel::Penalty,
        penalty: PenaltySettings { law: PenaltyLaw::SpringDamper(law) },
        ..settings
    }
}

/// Velocity and spin after contact of a rod (length 2, 1 kg) that falls on the floor with 3 m/s, one end first, on springs of 4ⁿ · 10⁶ N/m.
fn rod_after_soft_contact(restitution: f64, degrees: f64, n: i32) -> (DVec2, f64) {
    let stiffness = 1e6 * 4.0_f64.powi(n);
    // Steps shrink with the stiffness, so that their error shrinks as fast as the duration of the contact: as 1/√k.
    let h = 1e-5 / 4.0_f64.powi(n);
    let mut simulation = simulation(penalty(every(h), stiffness, None), bouncing(restitution));
    floor(&mut simulation);
    let centre = direction(degrees.to_radians());
    rod(2.0, 1.0).at(centre.x, centre.y).turned(degrees.to_radians()).moving(0.0, -3.0).spawn(&mut simulation, "rod");
    let lowest = |simulation: &_| body(simulation, "rod").point(dvec2(-1.0, 0.0)).y;
    simulation.step().unwrap();
    while lowest(&simulation) < 0.0 {
        simulation.step().unwrap();
    }
    (body(&simulation, "rod").velocity(), body(&simulation, "rod").angular_velocity())
}

#[test]
fn l4_penalty_answer_tends_to_the_impulse_answer_as_the_spring_hardens() {
    // C7: θ, ε, v_y, ω after the impulse.
    let cases = [
        (30.0, 0.5, -1.61538461538, -3.59733629264),
        (45.0, 1.0, -0.6, -5.09116882454),
        (60.0, 0.8, 0.0857142857143, -4.62857142857),
    ];
    for (degrees, restitution, speed, spin) in cases {
        let errors = [0, 1, 2].map(|n| {
            let (velocity, rate) = rod_after_soft_contact(restitution, degrees, n);
            ((velocity - dvec2(0.0, speed)).length_squared() + (rate - spin) * (rate - spin)).sqrt()
        });
        // The contact lasts π √(m/k), during which the rod turns: order ½ in 1/k, so a fourfold spring halves the error.
        assert_near(errors[0] / errors[1], 2.0, 0.3);
        assert_near(errors[1] / errors[2], 2.0, 0.3);
        // ω · π √(m_eff/k) of a velocity of 3 m/s at the stiffest.
        assert!(errors[2] < 0.02, "{degrees}°, ε = {restitution}: {errors:?}");
    }
}

#[test]
fn l4_ball_gives_back_the_restitution_at_any_stiffness() {
    for restitution in [0.2, 0.5, 0.8, 1.0] {
        for stiffness in [1e3, 1e5] {
            let h = 1e-3 / f64::sqrt(stiffness);
            let mut simulation = simulation(penalty(weightless(h), stiffness, None), bouncing(restitution));
            floor(&mut simulation);
            ball(0.1, 1.0).at(0.0, 0.1).moving(0.0, -1.0).spawn(&mut simulation, "ball");
            // Longer than half a period of the damped spring, for the most damped: π/√(1 − ζ²).
            for _ in 0..4000 {
                simulation.step().unwrap();
            }
            // A thousandth of a radian of phase per step.
            assert_near(body(&simulation, "ball").velocity().y, restitution, 2e-3);
        }
    }
}

/// v_y and ω of the flat rod of C9 after it has left the floor.
fn flat_rod_after_soft_contact(stiffness: f64, damping: Option<f64>) -> (f64, f64) {
    let h = 1e-3 / stiffness.sqrt();
    let mut simulation = simulation(penalty(weightless(h), stiffness, damping), bouncing(0.5));
    floor(&mut simulation);
    rod(2.0, 1.0).moving(0.0, -1.0).spawn(&mut simulation, "rod");
    for _ in 0..4000 {
        simulation.step().unwrap();
    }
    (body(&simulation, "rod").velocity().y, body(&simulation, "rod").angular_velocity())
}

#[test]
fn l4_flat_rod_on_two_springs_tends_to_the_simultaneous_answer() {
    for stiffness in [1e4, 1e6] {
        // Both springs bear the whole rod: each carries half of the damping of a spring 2k under 1 kg.
        let damping = 0.5 * damping_coefficient(2.0 * stiffness, 1.0, damping_ratio(0.5));
        let (speed, spin) = flat_rod_after_soft_contact(stiffness, Some(damping));
        // The simultaneous answer of C9; one by one it is (0.3359375, −0.0703125). A thousandth of a radian of phase per step.
        assert_near(speed, 0.5, 2e-3);
        assert_near(spin, 0.0, 1e-12);
    }
}

#[test]
fn l4_known_limit_damping_for_one_contact_is_too_little_for_two() {
    // By default the damper is right for one end alone, with K = 4/m. Two ends together have ζ/√2, and give back more:
    // ε₂ = exp(−π ζ₂/√(1 − ζ₂²)), 0.616 instead of 0.5.
    let ratio = damping_ratio(0.5) / std::f64::consts::SQRT_2;
    let expected = trig::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
    assert_near(expected, 0.616, 1e-3);
    let (speed, spin) = flat_rod_after_soft_contact(1e6, None);
    assert_near(speed, expected, 2e-3);
    assert_near(spin, 0.0, 1e-12);
}

/// The homework's rod and its floor, written down once more by hand.
struct HandWritten {
    position: DVec2,
    angle: f64,
    velocity: DVec2,
    spin: f64,
    ends_before: Option<[DVec2; 2]>,
}

impl HandWritten {
    /// R3, R9, R6, R7 for a rod of length 1 and mass 1.5; returns how many ends were pushed.
    fn step(&mut self, h: f64, stiffness: f64, viscosity: f64) -> usize {
        let half = 0.5 * direction(self.angle);
        let ends = [self.position - half, self.position + half];
        let (mut force, mut torque, mut pushed) = (dvec2(0.0, -G * 1.5), 0.0, 0);
        for k in 0..2 {
            let arm = ends[k] - self.position;
            let velocity = match self.ends_before {
                Some(before) => (ends[k] - before[k]) / h,
                None => self.velocity + self.spin * dvec2(-arm.y, arm.x),
            };
            if ends[k].y <= 0.0 && velocity.y < 0.0 {
                let push = dvec2(-viscosity * velocity.x, -stiffness * ends[k].y);
                force += push;
                torque += arm.x * push.y - arm.y * push.x;
                pushed += 1;
            }
        }
        self.ends_before = Some(ends);
        self.velocity += force / 1.5 * h;
        self.spin += torque / (1.5 / 12.0) * h;
        self.position += self.velocity * h;
        self.angle += self.spin * h;
        pushed
    }
}

#[test]
fn r9_lecture_floor_follows_the_homework_to_the_letter() {
    for (start, angle, velocity, spin) in [
        (dvec2(0.0, 1.0), 0.4, dvec2(2.0, -1.0), 3.0),
        // An end below the floor and going down in the very first step: its velocity is the analytic one.
        (dvec2(0.0, 0.1), 0.4, dvec2(1.0, -2.0), -1.0),
    ] {
        let (h, stiffness, viscosity) = (1e-3, 4000.0, 3.0);
        let settings = Settings {
            contact: ContactModel::Penalty,
            penalty: PenaltySettings { law: PenaltyLaw::Lecture { stiffness, viscosity } },
            ..every(h)
        };
        let mut simulation = simulation(settings, bouncing(1.0));
        floor(&mut simulation);
        let rod = rod(1.0, 1.5).at(start.x, start.y).turned(angle).moving(velocity.x, velocity.y).spinning(spin);
        rod.spawn(&mut simulation, "rod");
        let mut by_hand = HandWritten { position: start, angle, velocity, spin, ends_before: None };
        let mut pushed = 0;
        for _ in 0..500 {
            simulation.step().unwrap();
            pushed += by_hand.step(h, stiffness, viscosity);
            let rod = body(&simulation, "rod");
            // Round-off, which finite differences magnify by 1/h and the floor feeds back.
            assert_vector_near(rod.position(), by_hand.position, 1e-10);
            assert_near(rod.angle(), by_hand.angle, 1e-10);
            assert_vector_near(rod.velocity(), by_hand.velocity, 1e-9);
            assert_near(rod.angular_velocity(), by_hand.spin, 1e-9);
        }
        assert!(pushed > 20, "the floor pushed {pushed} times");
    }
}

#[test]
fn r9_lecture_floor_ignores_discs() {
    let settings = Settings {
        contact: ContactModel::Penalty,
        penalty: PenaltySettings { law: PenaltyLaw::Lecture { stiffness: 1e4, viscosity: 1.0 } },
        ..every(0.01)
    };
    let mut simulation = simulation(settings, bouncing(1.0));
    floor(&mut simulation);
    ball(0.1, 1.0).at(0.0, 0.2).spawn(&mut simulation, "ball");
    simulation.run_for(1.0).unwrap();
    // Free fall, to the last bit of the recurrence's own round-off.
    assert_near(body(&simulation, "ball").position().y, 0.2 - G * 0.01 * 0.01 * 5050.0, 1e-12);
}
