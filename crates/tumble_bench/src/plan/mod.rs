//! Plans: which bodies a scene has, without an engine that moves them.

mod planar;
mod spatial;

use std::fmt::Debug;

use tumble_math::{Bounds, Dim, Linear, Pose, Vector};

pub use planar::PlanarShape;
pub use spatial::{SpatialShape, icosahedron};

/// What differs between plans of the plane and of space.
pub trait PlanDim: Dim {
    /// A shape, in its own axes around the origin.
    type Shape: Clone + Debug + PartialEq;
    /// A shape where it is, as the judge sees it: a convex core, rounded by a radius.
    type Core;

    /// Area [m²] or volume [m³].
    fn measure(shape: &Self::Shape) -> f64;

    /// The shape with its points put in their places.
    fn core(shape: &Self::Shape, place: impl Fn(Self::Vector) -> Self::Vector) -> Self::Core;

    /// The box around a core [m].
    fn bounds(core: &Self::Core) -> Bounds<Self::Vector>;

    /// How far apart two cores are, negative when they overlap [m].
    fn separation(a: &Self::Core, b: &Self::Core) -> f64;

    /// Pose and velocity as plain numbers, appended in a fixed order.
    fn write_numbers(pose: &Pose<Self>, velocity: Self::Vector, spin: Self::Angular, numbers: &mut Vec<f64>);
}

/// What moves a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Nothing.
    Static,
    /// The constant velocity that it is given.
    Kinematic,
    /// Forces and impulses.
    Dynamic,
}

/// A shape on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Part<D: PlanDim> {
    /// Its shape.
    pub shape: D::Shape,
    /// Where it is, in the body frame.
    pub pose: Pose<D>,
}

/// A body, whose origin is its centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Body<D: PlanDim> {
    /// What moves it.
    pub kind: Kind,
    /// Where it begins.
    pub pose: Pose<D>,
    /// Its first velocity [m/s].
    pub velocity: D::Vector,
    /// Its first rate of turn [rad/s].
    pub angular_velocity: D::Angular,
    /// Its shapes. Where they overlap, mass counts twice.
    pub parts: Vec<Part<D>>,
}

impl<D: PlanDim> Body<D> {
    /// A body at rest with one shape around its origin.
    pub fn simple(kind: Kind, position: D::Vector, shape: D::Shape) -> Self {
        Self::compound(kind, position, vec![Part { shape, pose: Pose::default() }])
    }

    /// A body at rest with several shapes; they are moved so that their common centre is at the origin.
    pub fn compound(kind: Kind, position: D::Vector, mut parts: Vec<Part<D>>) -> Self {
        let centre = centre(&parts);
        for part in &mut parts {
            part.pose.position -= centre;
        }
        let pose = Pose { position, rotation: D::Rotation::default() };
        Self { kind, pose, velocity: D::Vector::ZERO, angular_velocity: D::Angular::ZERO, parts }
    }

    /// The same body, turned.
    pub fn turned(mut self, rotation: D::Rotation) -> Self {
        self.pose.rotation = rotation;
        self
    }

    /// The same body, turning [rad/s].
    pub fn turning(mut self, angular_velocity: D::Angular) -> Self {
        self.angular_velocity = angular_velocity;
        self
    }

    /// Area [m²] or volume [m³] of all parts.
    pub fn measure(&self) -> f64 {
        self.parts.iter().map(|part| D::measure(&part.shape)).sum()
    }

    /// Centre of mass of the parts, in the body frame [m].
    pub fn centre(&self) -> D::Vector {
        centre(&self.parts)
    }
}

fn centre<D: PlanDim>(parts: &[Part<D>]) -> D::Vector {
    let mut moment = D::Vector::ZERO;
    let mut measure = 0.0;
    for part in parts {
        moment += part.pose.position * D::measure(&part.shape);
        measure += D::measure(&part.shape);
    }
    moment * (1.0 / measure)
}

/// A scene as plain data. One material; y points up.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan<D: PlanDim> {
    /// Its name.
    pub name: String,
    /// Its bodies, in the order in which every engine gets them.
    pub bodies: Vec<Body<D>>,
    /// Acceleration of free fall [m/s²].
    pub gravity: D::Vector,
    /// Mass per area [kg/m²] or volume [kg/m³].
    pub density: f64,
    /// Friction coefficient, at rest and sliding [1].
    pub friction: f64,
    /// Coefficient of restitution [1].
    pub restitution: f64,
    /// Length of a step [s].
    pub dt: f64,
    /// Steps of a run, where nothing else is asked for.
    pub steps: u32,
}

impl<D: PlanDim> Plan<D> {
    /// Bodies under gravity of 10 m/s², density and friction as in all scenes: 1 and 0.6.
    pub fn new(name: impl Into<String>, steps: u32, bodies: Vec<Body<D>>) -> Self {
        let gravity = D::Vector::unit(1) * -10.0;
        let dt = 1.0 / 60.0;
        Self { name: name.into(), bodies, gravity, density: 1.0, friction: 0.6, restitution: 0.0, dt, steps }
    }

    /// Mass of a body [kg].
    pub fn mass(&self, body: &Body<D>) -> f64 {
        self.density * body.measure()
    }
}
