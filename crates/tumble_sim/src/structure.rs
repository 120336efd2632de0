//! Notices when bodies, parts or masses change, so that tables are rebuilt before the next step and only then.

use bevy_ecs::lifecycle::HookContext;
use bevy_ecs::prelude::*;
use bevy_ecs::world::DeferredWorld;

/// Whether the tables built from bodies and parts are out of date.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Structure {
    /// Tables must be rebuilt before the next step.
    #[default]
    Changed,
    /// Tables are up to date.
    Known,
}

/// Component hook: the structure has changed.
pub(crate) fn mark_changed(mut world: DeferredWorld, _: HookContext) {
    if let Some(mut structure) = world.get_resource_mut::<Structure>() {
        *structure = Structure::Changed;
    }
}
