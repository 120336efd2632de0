//! Bodies in a few words, and what the tests ask about them.

use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use glam::{DVec2, dvec2};
use tumble_math::{Planar, PlanarRotation, trig};
use tumble_shape::{ConvexPolygon, Disc, HalfPlane, PlanarShape, Rod};
use tumble_sim::{
    Amount, AngularVelocity, BodyId, BodyKind, BodyTable, BodyView, ContactManifold, ContactMemory, ContactModel,
    ContactPair, Geometry, InertiaOverride, LinearVelocity, MaterialId, Orientation, Part, Position, Settings,
    Simulation,
};
use tumble_solver::Surface;

/// Acceleration of free fall in the tests [m/s²].
pub const G: f64 = 9.81;

/// A simulation whose only material has this surface.
pub fn simulation(settings: Settings, surface: Surface) -> Simulation {
    let mut simulation = Simulation::new(settings);
    simulation.materials_mut().set("default", surface);
    simulation
}

/// A frictionless surface.
pub fn bouncing(restitution: f64) -> Surface {
    Surface { restitution, ..Surface::default() }
}

/// A surface that does not bounce.
pub fn rough(static_friction: f64, kinetic_friction: f64) -> Surface {
    Surface { static_friction, kinetic_friction, restitution: 0.0 }
}

/// Settings with a step [s].
pub fn every(dt: f64) -> Settings {
    Settings { dt, ..Settings::default() }
}

/// Settings with a step [s] and without gravity.
pub fn weightless(dt: f64) -> Settings {
    Settings { dt, ..Settings::weightless() }
}

/// Unit vector at an angle [rad].
pub fn direction(angle: f64) -> DVec2 {
    dvec2(trig::cos(angle), trig::sin(angle))
}

/// Settings under a contact model.
pub fn under(contact: ContactModel, settings: Settings) -> Settings {
    Settings { contact, ..settings }
}

/// Settings under each model that keeps contacts rigid. A test that fails shows the last one it was in.
pub fn rigid(settings: Settings) -> impl Iterator<Item = Settings> {
    [ContactModel::Impulse, ContactModel::RestingLcp, ContactModel::VelocityLcp].into_iter().map(move |contact| {
        println!("under {}", contact.word());
        under(contact, settings)
    })
}

/// Settings under the models that solve all contacts together, to round-off.
pub fn complementarity(settings: Settings) -> impl Iterator<Item = Settings> {
    rigid(settings).filter(|settings| settings.contact != ContactModel::Impulse)
}

/// Makes a material that does not bounce, and has this friction against the default one.
pub fn material(simulation: &mut Simulation, name: &str, friction: f64) -> MaterialId {
    let standard = simulation.materials_mut().find("default").unwrap();
    let material = simulation.materials_mut().set(name, rough(friction, friction));
    simulation.materials_mut().set_pair(material, standard, rough(friction, friction));
    material
}

/// A floor at height 0.
pub fn floor(simulation: &mut Simulation) -> Entity {
    incline(simulation, 0.0)
}

/// A half-plane through the origin that rises to the right at an angle [rad].
pub fn incline(simulation: &mut Simulation, angle: f64) -> Entity {
    wall(simulation, "floor", direction(angle).perp())
}

/// A static half-plane through the origin that faces along a normal.
pub fn wall(simulation: &mut Simulation, name: &str, normal: DVec2) -> Entity {
    let wall = simulation.spawn((Name::new(name.to_owned()), Position(DVec2::ZERO), BodyKind::Static));
    simulation.attach(wall, Part::new(HalfPlane::try_new(normal, 0.0).unwrap(), Amount::Density(0.0)));
    wall
}

/// A body of one part, on its way into a simulation.
pub struct OneShape {
    shape: PlanarShape,
    mass: f64,
    position: DVec2,
    angle: f64,
    velocity: DVec2,
    spin: f64,
    kind: BodyKind,
    id: Option<u64>,
    inertia: Option<f64>,
}

fn one_shape(shape: impl Into<PlanarShape>, mass: f64) -> OneShape {
    OneShape {
        shape: shape.into(),
        mass,
        position: DVec2::ZERO,
        angle: 0.0,
        velocity: DVec2::ZERO,
        spin: 0.0,
        kind: BodyKind::Dynamic,
        id: None,
        inertia: None,
    }
}

/// A disc.
pub fn ball(radius: f64, mass: f64) -> OneShape {
    one_shape(Disc::try_new(DVec2::ZERO, radius).unwrap(), mass)
}

/// A thin rod along x.
pub fn rod(length: f64, mass: f64) -> OneShape {
    let end = dvec2(0.5 * length, 0.0);
    one_shape(Rod::try_new(-end, end, 0.0).unwrap(), mass)
}

/// A rod with rounded ends, from one point to another.
pub fn card(from: DVec2, to: DVec2, radius: f64, mass: f64) -> OneShape {
    one_shape(Rod::try_new(from, to, radius).unwrap(), mass)
}

/// A box.
pub fn block(width: f64, height: f64, mass: f64) -> OneShape {
    one_shape(ConvexPolygon::rectangle(DVec2::ZERO, 0.5 * dvec2(width, height), 0.0).unwrap(), mass)
}

/// A convex polygon of area density 1, where its corners are.
pub fn polygon(corners: &[DVec2]) -> OneShape {
    let shape = ConvexPolygon::try_new(corners).unwrap();
    let mass = shape.mass_properties(1.0).mass;
    one_shape(shape, mass)
}

impl OneShape {
    /// Where the origin of its shape is, which is the centre of mass of rods, discs and boxes [m].
    pub fn at(mut self, x: f64, y: f64) -> Self {
        self.position = dvec2(x, y);
        self
    }

    /// Its mass [kg].
    pub fn mass(mut self, mass: f64) -> Self {
        self.mass = mass;
        self
    }

    /// Its angle [rad].
    pub fn turned(mut self, angle: f64) -> Self {
        self.angle = angle;
        self
    }

    /// Its velocity [m/s].
    pub fn moving(mut self, x: f64, y: f64) -> Self {
        self.velocity = dvec2(x, y);
        self
    }

    /// Its rate of turn [rad/s].
    pub fn spinning(mut self, spin: f64) -> Self {
        self.spin = spin;
        self
    }

    /// Its inertia, given outright [kg·m²].
    pub fn inertia(mut self, inertia: f64) -> Self {
        self.inertia = Some(inertia);
        self
    }

    /// What moves it.
    pub fn kind(mut self, kind: BodyKind) -> Self {
        self.kind = kind;
        self
    }

    /// Its id.
    pub fn id(mut self, id: u64) -> Self {
        self.id = Some(id);
        self
    }

    /// Puts it into a simulation.
    pub fn spawn(self, simulation: &mut Simulation, name: &str) -> Entity {
        self.spawn_with(simulation, name, |part| part)
    }

    /// Puts it into a simulation with a part that differs.
    pub fn spawn_with(
        self,
        simulation: &mut Simulation,
        name: &str,
        change: impl FnOnce(Part<Planar>) -> Part<Planar>,
    ) -> Entity {
        let body = simulation.spawn((
            Name::new(name.to_owned()),
            Position(self.position),
            Orientation(PlanarRotation::from_angle(self.angle)),
            LinearVelocity(self.velocity),
            AngularVelocity(self.spin),
            self.kind,
        ));
        if let Some(id) = self.id {
            simulation.world_mut().entity_mut(body).insert(BodyId(id));
        }
        if let Some(inertia) = self.inertia {
            simulation.world_mut().entity_mut(body).insert(InertiaOverride(inertia));
        }
        simulation.attach(body, change(Part::new(self.shape, Amount::Mass(self.mass))));
        body
    }
}

/// The body of a name.
pub fn body<'a>(simulation: &'a Simulation, name: &str) -> BodyView<'a, Planar> {
    simulation.body(name).unwrap()
}

/// Names of all bodies, in the order of their ids.
pub fn names(simulation: &Simulation) -> Vec<String> {
    simulation.world().resource::<BodyTable>().entries().iter().map(|entry| entry.name.clone()).collect()
}

/// Kinetic energy of all bodies [J].
pub fn kinetic_energy(simulation: &Simulation) -> f64 {
    names(simulation).iter().map(|name| body(simulation, name).kinetic_energy()).sum()
}

/// Momentum of all bodies [N·s].
pub fn momentum(simulation: &Simulation) -> DVec2 {
    names(simulation).iter().map(|name| body(simulation, name)).map(|body| body.mass() * body.velocity()).sum()
}

/// Angular momentum of all bodies about the origin [N·m·s].
pub fn angular_momentum(simulation: &Simulation) -> f64 {
    let of = |body: BodyView<'_, Planar>| {
        body.mass() * body.position().perp_dot(body.velocity()) + body.inertia() * body.angular_velocity()
    };
    names(simulation).iter().map(|name| of(body(simulation, name))).sum()
}

/// Force of body `a` on body `b` in the last step: the impulses of all their contact points over Δt [N].
pub fn contact_force(simulation: &mut Simulation, a: &str, b: &str) -> DVec2 {
    contact_forces(simulation, a, b).iter().map(|(_, force)| *force).sum()
}

/// Where body `a` pushes body `b`, and with what force in the last step, from left to right [m], [N].
pub fn contact_forces(simulation: &mut Simulation, a: &str, b: &str) -> Vec<(DVec2, DVec2)> {
    let dt = simulation.clock().dt;
    let rank = |name| simulation.world().resource::<BodyTable>().index_of(name).unwrap();
    let (a, b) = (rank(a), rank(b));
    let mut forces = Vec::new();
    for_each_contact(simulation, |pair, manifold, memory| {
        let side = match pair.bodies {
            bodies if bodies == [a, b] => 1.0,
            bodies if bodies == [b, a] => -1.0,
            _ => return,
        };
        let points = Planar::points(&manifold.0).iter().zip(&memory.0);
        forces.extend(points.map(|(point, memory)| (point.point, memory.given * side / dt)));
    });
    forces.sort_by(|one, other| one.0.x.total_cmp(&other.0.x));
    forces
}

/// The farthest that any body gets from its place within a time, or until that is `enough` [m].
pub fn farthest(simulation: &mut Simulation, seconds: f64, enough: f64) -> f64 {
    simulation.prepare().unwrap();
    let all = names(simulation);
    let places =
        |simulation: &Simulation| -> Vec<DVec2> { all.iter().map(|name| body(simulation, name).position()).collect() };
    let (start, end, mut farthest) = (places(simulation), simulation.time() + seconds, 0.0_f64);
    while simulation.time() < end && farthest < enough {
        simulation.step().unwrap();
        let ways = start.iter().zip(places(simulation)).map(|(a, b)| (*a - b).length());
        farthest = ways.fold(farthest, f64::max);
    }
    farthest
}

/// The deepest overlap of all contact points; negative when none touches [m].
pub fn deepest_overlap(simulation: &mut Simulation) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for_each_contact(simulation, |_, manifold, _| {
        for point in Planar::points(&manifold.0) {
            deepest = deepest.max(-point.separation);
        }
    });
    deepest
}

fn for_each_contact(
    simulation: &mut Simulation,
    mut visit: impl FnMut(&ContactPair, &ContactManifold<Planar>, &ContactMemory<Planar>),
) {
    let mut contacts =
        simulation.world_mut().query::<(&ContactPair, &ContactManifold<Planar>, &ContactMemory<Planar>)>();
    let world = simulation.world();
    for (pair, manifold, memory) in contacts.iter(world) {
        visit(pair, manifold, memory);
    }
}

/// Fails with both numbers unless they differ by at most `within`.
#[track_caller]
pub fn assert_near(measured: f64, expected: f64, within: f64) {
    let off = (measured - expected).abs();
    assert!(off <= within, "measured {measured}, expected {expected}: off by {off:.3e}, more than {within:.3e}");
}

/// The same for vectors.
#[track_caller]
pub fn assert_vector_near(measured: DVec2, expected: DVec2, within: f64) {
    let off = (measured - expected).length();
    assert!(off <= within, "measured {measured}, expected {expected}: off by {off:.3e}, more than {within:.3e}");
}
