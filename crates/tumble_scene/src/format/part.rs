//! What the parts of bodies have in common, in the plane and in space.

use std::fmt::Debug;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Groups;

/// Declares a part with the fields that all of them have, after its own.
macro_rules! part {
    ($(#[$about:meta])* $name:ident [$($density:literal)?] { $($(#[$field_about:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$field_about])* pub $field: $type,)*
            $(
                #[doc = concat!("Mass per ", $density, ". Default 1, unless `mass` is given.")]
                #[serde(default)]
                pub density: Option<f64>,
                /// Mass [kg], instead of a density.
                #[serde(default)]
                pub mass: Option<f64>,
            )?
            /// Material. Default that of the body.
            #[serde(default)]
            pub material: Option<String>,
            /// Whether touching is only reported, without any response. Default false.
            #[serde(default)]
            pub sensor: bool,
            /// Collision groups of this part. Default those of the body.
            #[serde(default)]
            pub groups: Option<Groups>,
            /// Collision groups this part collides with. Default those of the body.
            #[serde(default)]
            pub collides_with: Option<Groups>,
        }

        impl $name {
            /// The fields that all parts have.
            fn shared(&self) -> Shared<'_> {
                Shared {
                    density_and_mass: part!(@amount self $($density)?),
                    material: self.material.as_deref(),
                    sensor: self.sensor,
                    groups: (self.groups.as_ref(), self.collides_with.as_ref()),
                }
            }
        }
    };
    (@amount $self:ident) => { (None, None) };
    (@amount $self:ident $density:literal) => { ($self.density, $self.mass) };
}

pub(super) use part;

/// What the shapes of the plane and of space have in common.
pub trait PartEntry:
    Clone + Debug + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// The fields that all parts have.
    fn shared(&self) -> Shared<'_>;

    /// The name of the list whose parts it stands for.
    fn list(&self) -> Option<&str>;

    /// What it is called, for one that has no end and no mass, so that forces cannot move it.
    fn without_mass(&self) -> Option<&'static str>;
}

/// The fields that all parts have.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shared<'p> {
    /// The density and the mass as written; ground has neither.
    pub density_and_mass: (Option<f64>, Option<f64>),
    /// The material that the part itself names.
    pub material: Option<&'p str>,
    /// Whether touching is only reported.
    pub sensor: bool,
    /// The collision groups that the part itself names, and those it collides with.
    pub groups: (Option<&'p Groups>, Option<&'p Groups>),
}
