//! Soft steps: all ways of running the kernels give the same bits, and contacts do what contacts must.

use fearless_simd::Level;
use glam::{DVec2, DVec3, dvec2, dvec3};
use proptest::prelude::*;
use tumble_math::{Inertia, Linear, Planar, Spatial, SymmetricTensor};
use tumble_solver::soft_step::{SoftDim, SoftPair, SoftPoint, SoftSettings, SoftStep, Width};
use tumble_solver::{Slip, SolverBody, Surface};
use tumble_team::Team;

const DT: f64 = 1.0 / 60.0;

/// A pair that owns its points.
#[derive(Clone, Debug)]
struct Pair<D: SoftDim> {
    a: u32,
    b: u32,
    normal: D::Vector,
    surface: Surface,
    points: Vec<SoftPoint<D>>,
}

/// Bodies with the world last, their accelerations, and the pairs between them.
#[derive(Clone, Debug)]
struct Problem<D: SoftDim> {
    bodies: Vec<SolverBody<D>>,
    accelerations: Vec<(D::Vector, D::Angular)>,
    pairs: Vec<Pair<D>>,
}

/// What a step did: velocities and displacements by body, impulses by point.
type Outcome<D> = (
    Vec<(<D as tumble_math::Dim>::Vector, <D as tumble_math::Dim>::Angular)>,
    Vec<(<D as tumble_math::Dim>::Vector, <D as tumble_math::Dim>::Angular)>,
    Vec<(<D as tumble_math::Dim>::Vector, Slip)>,
);

fn step<D: SoftDim>(problem: &Problem<D>, width: Width) -> (Outcome<D>, f64) {
    step_shared(problem, width, &Team::alone())
}

fn step_shared<D: SoftDim>(problem: &Problem<D>, width: Width, team: &Team) -> (Outcome<D>, f64) {
    let settings = SoftSettings::default();
    let mut model = SoftStep::<D>::default();
    model.width = width;
    let mut bodies = problem.bodies.clone();
    model.begin(&bodies);
    for (i, (a, alpha)) in problem.accelerations.iter().enumerate() {
        model.accelerate(i as u32, *a, *alpha, DT / f64::from(settings.substeps));
    }
    model.expect(problem.pairs.len());
    for (k, pair) in problem.pairs.iter().enumerate() {
        let colour = model.colours().choose([pair.a, pair.b]);
        model.announce(k, pair.points.len(), colour);
    }
    model.lay_out(team);
    model.fill(team, |places| {
        for (k, pair) in problem.pairs.iter().enumerate() {
            let Pair { a, b, normal, surface, points } = pair;
            let pair =
                SoftPair { a: *a, b: *b, normal: *normal, surface: *surface, rest_speed: 0.1, twist: 0.01, points };
            if places.want(k) {
                places.fill(k, &pair);
            }
        }
    });
    let report = model.solve(team, DT, 10.0, &settings, None, &mut bodies);
    let count = problem.bodies.len() as u32;
    let velocities = (0..count).map(|i| model.change(i)).collect();
    let displacements = (0..count).map(|i| model.displacement(i)).collect();
    let impulses = (problem.pairs.iter().enumerate())
        .flat_map(|(k, pair)| (0..pair.points.len()).map(move |point| (k, point)))
        .map(|(k, point)| (model.outcome(k).total(point), model.outcome(k).slip))
        .collect();
    ((velocities, displacements, impulses), report.residual)
}

/// Every way of running the kernels that this machine has.
fn ways() -> Vec<Width> {
    let mut ways = vec![Width::Plain, Width::Widest];
    #[cfg(target_arch = "x86_64")]
    {
        let level = Level::new();
        ways.extend(level.as_sse2().map(|token| Width::Level(Level::Sse2(token))));
        ways.extend(level.as_avx2().map(|token| Width::Level(Level::Avx2(token))));
    }
    ways
}

fn vectors(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(|(x, y)| dvec2(x, y))
}

fn vectors_of_space(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| dvec3(x, y, z))
}

fn surfaces() -> impl Strategy<Value = Surface> {
    (0.0..1.0_f64, 0.0..1.0_f64, prop_oneof![Just(0.0), 0.0..1.0_f64]).prop_map(|(one, other, restitution)| Surface {
        static_friction: one.max(other),
        kinetic_friction: one.min(other),
        restitution,
    })
}

prop_compose! {
    fn planar_problem()(count in 2_usize..20)(
        velocities in prop::collection::vec((vectors(5.0), -5.0..5.0_f64, 0.1..10.0_f64), count),
        pairs in prop::collection::vec(
            (0..count + 1, 0..count, vectors(1.0), surfaces(), prop::collection::vec(
                (vectors(1.0), vectors(1.0), -0.02..0.05_f64, 0.0..2.0_f64, -1.0..1.0_f64, any::<bool>()), 1..3)),
            0..80),
    ) -> Problem<Planar> {
        let mut bodies: Vec<SolverBody<Planar>> = velocities.iter().enumerate().map(|(i, (v, w, m))| SolverBody {
            velocity: *v,
            angular_velocity: *w,
            // One body that cannot move, and one that only turns.
            inverse_mass: if i < 2 { DVec2::ZERO } else { DVec2::splat(1.0 / m) },
            inverse_inertia: if i == 0 { 0.0 } else { 3.0 / m },
        }).collect();
        bodies.push(SolverBody::default());
        let accelerations = bodies.iter().map(|body| if body.inverse_mass == DVec2::ZERO { (DVec2::ZERO, 0.0) }
            else { (dvec2(0.0, -10.0), 0.1) }).collect();
        let pairs = pairs.into_iter().filter(|(a, b, ..)| a != b).map(|(a, b, normal, surface, points)| Pair {
            a: a as u32,
            b: b as u32,
            normal: normal.try_normalize().unwrap_or(DVec2::Y),
            surface,
            points: points.into_iter().map(|(arm_a, arm_b, separation, push, along, sticks)| SoftPoint {
                arm_a, arm_b, separation,
                impulse: dvec2(push, along),
                slip: if sticks { Slip::Sticking } else { Slip::Sliding },
            }).collect(),
        }).collect();
        Problem { bodies, accelerations, pairs }
    }
}

prop_compose! {
    fn spatial_problem()(count in 2_usize..20)(
        velocities in prop::collection::vec((vectors_of_space(5.0), vectors_of_space(5.0), 0.1..10.0_f64), count),
        pairs in prop::collection::vec(
            (0..count + 1, 0..count, vectors_of_space(1.0), surfaces(), prop::collection::vec(
                (vectors_of_space(1.0), vectors_of_space(1.0), -0.02..0.05_f64, vectors_of_space(1.0), any::<bool>()), 1..5)),
            0..80),
    ) -> Problem<Spatial> {
        let mut bodies: Vec<SolverBody<Spatial>> = velocities.iter().enumerate().map(|(i, (v, w, m))| SolverBody {
            velocity: *v,
            angular_velocity: *w,
            inverse_mass: if i < 2 { DVec3::ZERO } else { DVec3::splat(1.0 / m) },
            inverse_inertia: if i == 0 { SymmetricTensor::ZERO } else {
                SymmetricTensor { diagonal: dvec3(3.0, 4.0, 5.0) / *m, off_diagonal: dvec3(0.1, -0.2, 0.3) / *m }
            },
        }).collect();
        bodies.push(SolverBody::default());
        let accelerations = bodies.iter().map(|body| if body.inverse_mass == DVec3::ZERO { (DVec3::ZERO, DVec3::ZERO) }
            else { (dvec3(0.0, -10.0, 0.0), dvec3(0.1, 0.0, -0.1)) }).collect();
        let pairs = pairs.into_iter().filter(|(a, b, ..)| a != b).map(|(a, b, normal, surface, points)| Pair {
            a: a as u32,
            b: b as u32,
            normal: normal.try_normalize().unwrap_or(DVec3::Y),
            surface,
            points: points.into_iter().map(|(arm_a, arm_b, separation, push, sticks)| SoftPoint {
                arm_a, arm_b, separation,
                impulse: dvec3(push.x.abs(), push.y, push.z),
                slip: if sticks { Slip::Sticking } else { Slip::Sliding },
            }).collect(),
        }).collect();
        Problem { bodies, accelerations, pairs }
    }
}

/// Momentum of all bodies that move, with their masses; `None` where a body that cannot move takes part.
fn momentum<D: SoftDim>(problem: &Problem<D>, changes: &[(D::Vector, D::Angular)]) -> (D::Vector, f64) {
    let (mut sum, mut size) = (D::Vector::ZERO, 0.0);
    for (body, change) in problem.bodies.iter().zip(changes) {
        if body.inverse_mass[0] > 0.0 {
            let p = change.0 * (1.0 / body.inverse_mass[0]);
            sum += p;
            size += p.length() + body.velocity.length() / body.inverse_mass[0];
        }
    }
    (sum, size)
}

/// Bodies 0 and 1 and the world take momentum; without pairs with them the rest keeps it.
fn among_movers<D: SoftDim>(mut problem: Problem<D>) -> Problem<D> {
    let world = problem.bodies.len() as u32 - 1;
    problem.pairs.retain(|pair| [pair.a, pair.b].iter().all(|body| (2..world).contains(body)));
    problem
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn every_instruction_set_gives_the_bits_of_the_plain_version(problem in planar_problem()) {
        let oracle = step(&problem, Width::Plain);
        for way in ways() {
            prop_assert_eq!(&step(&problem, way), &oracle, "{:?}", way);
        }
    }

    #[test]
    fn every_instruction_set_gives_the_bits_of_the_plain_version_in_space(problem in spatial_problem()) {
        let oracle = step(&problem, Width::Plain);
        for way in ways() {
            prop_assert_eq!(&step(&problem, way), &oracle, "{:?}", way);
        }
    }

    #[test]
    fn contacts_between_moving_bodies_keep_momentum(planar in planar_problem(), spatial in spatial_problem()) {
        // Single precision rounds each of some 40 impulses to 6e-8 of itself.
        let planar = among_movers(planar);
        let (sum, size) = momentum(&planar, &step(&planar, Width::Widest).0.0);
        prop_assert!(sum.length() <= 1e-5 * size, "{sum} of {size}");
        let spatial = among_movers(spatial);
        let (sum, size) = momentum(&spatial, &step(&spatial, Width::Widest).0.0);
        prop_assert!(sum.length() <= 1e-5 * size, "{sum} of {size}");
    }

    #[test]
    fn contacts_push_and_never_pull(problem in spatial_problem()) {
        for (total, _) in step(&problem, Width::Widest).0.2 {
            prop_assert!(total.x >= 0.0 && total.is_finite(), "{total}");
        }
    }
}

/// The same problem so many times, side by side, on one world: enough pairs for every thread of a team.
fn repeated<D: SoftDim>(problem: &Problem<D>, times: usize) -> Problem<D> {
    let count = problem.bodies.len() - 1;
    let mut many = Problem { bodies: Vec::new(), accelerations: Vec::new(), pairs: Vec::new() };
    for k in 0..times {
        many.bodies.extend_from_slice(&problem.bodies[..count]);
        many.accelerations.extend_from_slice(&problem.accelerations[..count]);
        let place = |body: u32| if body as usize == count { (times * count) as u32 } else { body + (k * count) as u32 };
        many.pairs.extend(problem.pairs.iter().map(|pair| Pair { a: place(pair.a), b: place(pair.b), ..pair.clone() }));
    }
    many.bodies.push(problem.bodies[count]);
    many.accelerations.push(problem.accelerations[count]);
    many
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, ..ProptestConfig::default() })]

    #[test]
    fn every_team_gives_the_bits_of_one_thread(planar in planar_problem(), spatial in spatial_problem()) {
        let (planar, spatial) = (repeated(&planar, 400), repeated(&spatial, 400));
        let alone = (step(&planar, Width::Widest), step(&spatial, Width::Widest));
        for threads in 2..=4 {
            let team = Team::new(threads).unwrap();
            prop_assert!(step_shared(&planar, Width::Widest, &team) == alone.0, "{threads} threads in the plane");
            prop_assert!(step_shared(&spatial, Width::Widest, &team) == alone.1, "{threads} threads in space");
            prop_assert!(step_shared(&planar, Width::Plain, &team) == alone.0, "{threads} threads, lane by lane");
        }
    }
}

#[test]
fn a_body_without_contacts_is_not_touched() {
    let body = SolverBody {
        velocity: dvec2(1.0 / 3.0, 0.1),
        angular_velocity: 0.7,
        inverse_mass: DVec2::ONE,
        inverse_inertia: 1.0,
    };
    let far = SolverBody { velocity: dvec2(0.0, -5.0), ..body };
    let point = SoftPoint { arm_a: DVec2::ZERO, arm_b: DVec2::ZERO, separation: 0.5, ..SoftPoint::default() };
    let pair = Pair { a: 1, b: 2, normal: DVec2::NEG_Y, surface: Surface::default(), points: vec![point] };
    let gravity = (dvec2(0.0, -9.81), 0.3);
    let problem = Problem::<Planar> {
        bodies: vec![body, far, SolverBody::default()],
        accelerations: vec![gravity, gravity, (DVec2::ZERO, 0.0)],
        pairs: vec![pair],
    };
    let ((velocities, displacements, _), _) = step(&problem, Width::Widest);
    // Not to rounding: exactly, also the body whose contact is near and does not push.
    assert_eq!(velocities, vec![(DVec2::ZERO, 0.0); 3]);
    assert_eq!(displacements, vec![(DVec2::ZERO, 0.0); 3]);
}

#[test]
fn a_box_at_rest_is_carried_by_its_weight() {
    // Unit box of 2 kg on the world; steps repeated with its own impulses until they have settled.
    let corner =
        |x: f64| SoftPoint { arm_a: dvec2(x, 0.0), arm_b: dvec2(x, -0.5), separation: 0.0, ..SoftPoint::default() };
    let surface = Surface { static_friction: 0.5, kinetic_friction: 0.4, restitution: 0.3 };
    let mut problem = Problem::<Planar> {
        bodies: vec![
            SolverBody { inverse_mass: DVec2::splat(0.5), inverse_inertia: 3.0, ..SolverBody::default() },
            SolverBody::default(),
        ],
        accelerations: vec![(dvec2(1.0, -10.0), 0.0), (DVec2::ZERO, 0.0)],
        pairs: vec![Pair { a: 1, b: 0, normal: DVec2::Y, surface, points: vec![corner(-0.5), corner(0.5)] }],
    };
    let mut total = DVec2::ZERO;
    for _ in 0..200 {
        let settings = SoftSettings::default();
        let mut model = SoftStep::<Planar>::default();
        let mut bodies = problem.bodies.clone();
        model.begin(&bodies);
        model.accelerate(0, problem.accelerations[0].0, 0.0, DT / 4.0);
        model.expect(1);
        let colour = model.colours().choose([1, 0]);
        model.announce(0, 2, colour);
        let alone = Team::alone();
        model.lay_out(&alone);
        let points = &problem.pairs[0].points;
        let pair = SoftPair { a: 1, b: 0, normal: DVec2::Y, surface, rest_speed: 0.3, twist: 0.0, points };
        model.fill(&alone, |places| places.fill(0, &pair));
        model.solve(&alone, DT, 10.0, &settings, None, &mut bodies);
        let (change, _) = model.change(0);
        let (shift, turn) = model.displacement(0);
        let free = problem.accelerations[0].0 * (DT * DT * 5.0 / 8.0);
        let moved = problem.bodies[0].velocity * DT + free + shift;
        problem.bodies[0].velocity += change + problem.accelerations[0].0 * DT;
        total = DVec2::ZERO;
        for (k, point) in problem.pairs[0].points.iter_mut().enumerate() {
            let outcome = model.outcome(0);
            point.impulse = outcome.impulse(k);
            point.slip = outcome.slip;
            point.separation += moved.y + turn * point.arm_b.x;
            total += outcome.total(k);
        }
    }
    // Weight and push of a step, to single precision of sums of four; the tangent of an upward normal is +x.
    let (weight, push) = (2.0 * 10.0 * DT, 2.0 * 1.0 * DT);
    assert!((total.x - weight).abs() < 1e-5 * weight, "{total} against {weight}");
    assert!((total.y + push).abs() < 1e-4 * weight, "{total} against {push}");
    assert!(problem.bodies[0].velocity.length() < 1e-5, "{}", problem.bodies[0].velocity);
    let deepest = problem.pairs[0].points.iter().map(|point| -point.separation).fold(0.0, f64::max);
    assert!(deepest < 1e-4, "a single box hardly sinks: {deepest}");
}
