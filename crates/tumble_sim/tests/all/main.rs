//! The tests of `tumble_sim` as one program, which links once.

mod contacts;
mod contacts_in_space;
mod driven_in_space;
mod laws;
mod ledger;
mod rolling_in_space;
mod soft_step;
mod space;
mod space_support;
mod support;
mod time_of_impact;
mod turning_contacts;
mod validation_arch;
mod validation_arch_forces;
mod validation_assemblies;
mod validation_collisions;
mod validation_forces;
mod validation_friction;
mod validation_limits;
mod validation_mechanisms;
mod validation_models;
mod validation_painleve;
mod validation_rolling;
mod validation_space;
mod validation_statics;
