//! Looking at one body.

use bevy_ecs::prelude::*;
use glam::DVec2;
use tumble_math::{Linear, Planar, PlanarRotation};

use super::table::PartFrame;
use super::{AngularVelocity, BodyInertia, LinearVelocity, Mass, Orientation, Position};
use crate::geometry::Geometry;

/// The state of one body.
#[derive(Clone, Copy)]
pub struct BodyView<'w, D: Geometry> {
    entity: EntityRef<'w>,
    dim: std::marker::PhantomData<D>,
}

impl<D: Geometry> std::fmt::Debug for BodyView<'_, D> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("BodyView")
            .field("entity", &self.entity())
            .field("position", &self.position())
            .field("velocity", &self.velocity())
            .finish_non_exhaustive()
    }
}

impl<'w, D: Geometry> BodyView<'w, D> {
    pub(crate) fn new(entity: EntityRef<'w>) -> Self {
        Self { entity, dim: std::marker::PhantomData }
    }

    /// Its entity.
    pub fn entity(&self) -> Entity {
        self.entity.id()
    }

    /// Centre of mass in world axes [m].
    pub fn position(&self) -> D::Vector {
        self.component::<Position<D::Vector>>().0
    }

    /// Rotation from body to world axes.
    pub fn rotation(&self) -> D::Rotation {
        self.component::<Orientation<D::Rotation>>().0
    }

    /// Velocity of the centre of mass in world axes [m/s].
    pub fn velocity(&self) -> D::Vector {
        self.component::<LinearVelocity<D::Vector>>().0
    }

    /// Rate of turn in world axes [rad/s].
    pub fn angular_velocity(&self) -> D::Angular {
        self.component::<AngularVelocity<D::Angular>>().0
    }

    /// Mass; 0 for static and kinematic bodies [kg].
    pub fn mass(&self) -> f64 {
        self.component::<Mass>().0
    }

    /// Inertia about the centre of mass, in body axes [kg·m²].
    pub fn inertia(&self) -> D::Inertia {
        self.component::<BodyInertia<D::Inertia>>().0
    }

    /// Body-frame place of a point of the frame in which the body's parts are written [m].
    pub fn from_part_frame(&self, point: D::Vector) -> D::Vector {
        point + self.entity.get::<PartFrame<D::Vector>>().map_or(D::Vector::ZERO, |frame| frame.0)
    }

    /// ½ m v² + ½ ω · I ω [J].
    pub fn kinetic_energy(&self) -> f64 {
        use tumble_math::Inertia;
        let (velocity, spin) = (self.velocity(), self.angular_velocity());
        let momentum = self.inertia().in_world(&self.rotation()).apply(spin);
        0.5 * (self.mass() * velocity.dot(velocity) + spin.dot(momentum))
    }

    fn component<C: Component>(&self) -> &'w C {
        // Present by construction: `Position` requires all of them.
        self.entity.get::<C>().expect("a body has all components that Position requires")
    }
}

impl BodyView<'_, Planar> {
    /// Angle from the world axes, counter-clockwise, accumulated over turns (R2) [rad].
    pub fn angle(&self) -> f64 {
        let rotation: PlanarRotation = self.rotation();
        rotation.angle()
    }

    /// World place of a point of the body frame (R3) [m].
    pub fn point(&self, point_body: DVec2) -> DVec2 {
        use tumble_math::Rotation;
        self.position() + self.rotation().rotate(point_body)
    }
}
