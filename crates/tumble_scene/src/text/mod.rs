//! The text of a scene as a tree that remembers where everything stands.
//!
//! [`parse`] reads RON into [`Node`]s, [`Grammar`] knows from the format's schema what may stand where, and [`check`] compares the two.
//! All of it serves messages only: the values themselves are read by `ron`, which has the last word.

mod check;
mod grammar;
mod node;
mod parse;

pub(crate) use check::check;
pub(crate) use grammar::{Field, Grammar, Shape, Variant};
pub(crate) use node::{Entry, Kind, Name, Node};
pub(crate) use parse::parse;

/// Options of every scene file.
pub(crate) fn options() -> ron::Options {
    use ron::extensions::Extensions;
    ron::Options::default().with_default_extension(
        Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES,
    )
}

/// Reads a value with `ron` alone.
pub(crate) fn read<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, ron::error::SpannedError> {
    options().from_str(text)
}
