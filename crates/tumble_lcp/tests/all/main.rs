//! The tests of `tumble_lcp` as one program, which links once.

mod catalogue;
mod cone;
mod conic_oracle;
mod random;
mod wild;
