//! Contact points of two shapes of the plane.
//!
//! Every shape but the half-plane is a core (point, segment or polygon) grown by a radius, so the pairs reduce to two:
//! half-plane and core (`half_plane.rs`), core and core (`convex.rs`).
//!
//! # How two cores meet
//!
//! ```text
//!   a side and a corner            two sides                 two corners
//!
//!        \  b  /                   |   b   |                       / b
//!         \   /                    |_______|                      /__
//!     _____\ /_____              __v_______v__                   .
//!           v                          a                 ______. ↗ normal
//!           a                                              a   |
//! ```
//!
//! 1. Every side of both is tried as a separating axis. The one with the largest separation is the *reference* side.
//! 2. The facing side of the other core (*incident*) is cut to the length of the reference side: one or two points.
//! 3. Cores that are apart may be closest at two corners, where no side faces the other shape: the normal joins the corners.
//!
//! Radii are subtracted last. For separated shapes the smallest separation is the true distance.
//!
//! # Thin rods remember their side
//!
//! A rod of radius zero has no inside, so geometry alone cannot tell on which side something belongs once it is a little through.
//! The normal of the manifold before can: among the sides, only those facing within 60° of it may be the reference as long as the
//! cores overlap, or lie just beyond each other (a quarter of the smaller one's length). Without memory the least depth decides.
//! The memory is a world direction: it holds while the pair turns by less than 60° from one query to the next. Two thin rods that
//! met end to end keep their normal in the same way, as long as the ends stay in line within the flush tolerance.
//!
//! # No ghost bumps
//!
//! ```text
//!        slider →      ·
//!    ______________|   ·  gap or overlap across the seam: any
//!   ──────────────┐┌───·────────
//!       box 1     ││ box 2       depth below the top of box 2: at most the flush tolerance
//! ```
//!
//! What slides over box 1 sinks in by a hair, and then meets the last sliver of the left side of box 2. That side must not stop it,
//! neither when it is reached nor as a speculative contact before. Rule: when the side with the largest separation is one, and a
//! side *across* it (60° to 90°) has a separation within ± the flush tolerance, the two shapes pass each other corner by corner at
//! no more than that depth, and there is no contact. Once the slider's overlap along the seam exceeds the tolerance, the top of box
//! 2 has the larger separation and makes an ordinary flush contact. A step higher than the tolerance stops the slider as it should.
//!
//! The rule holds for sharp shapes. It leaves out pairs of rods: two thin rods that meet end to end look the same as one
//! sliding over the other, and they should bounce. It leaves out round shapes, whose normal at a corner is a true one; so a disc
//! that rolls over a seam may feel the corner behind it as a speculative contact.

mod convex;
mod core;
mod corner;
mod face;
mod half_plane;

use tumble_math::{Planar, Pose};
use tumble_shape::PlanarShape;

use self::core::{Core, Owner};
use crate::manifold::PlanarManifold;
use crate::narrow::PlanarQuery;

/// Contact points of shapes a and b in the given poses, the normal running from a to b.
///
/// Empty when the shapes are further apart than the margin, for two half-planes, and for a pose that is not finite.
pub fn collide(
    a: &PlanarShape,
    pose_a: &Pose<Planar>,
    b: &PlanarShape,
    pose_b: &Pose<Planar>,
    query: &PlanarQuery,
) -> PlanarManifold {
    match (a, b) {
        (PlanarShape::HalfPlane(_), PlanarShape::HalfPlane(_)) => PlanarManifold::EMPTY,
        (PlanarShape::HalfPlane(plane), _) => half_plane::collide(plane, pose_a, Owner::A, b, pose_b, query),
        (_, PlanarShape::HalfPlane(plane)) => half_plane::collide(plane, pose_b, Owner::B, a, pose_a, query),
        _ => {
            // Relative to a's centre of mass, so that nothing is lost far from the origin.
            let origin = pose_a.position;
            convex::collide(&Core::new(a, pose_a, origin), &Core::new(b, pose_b, origin), origin, query)
        }
    }
}
