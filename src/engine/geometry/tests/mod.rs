//! Fast closed forms against a slow reference that shares nothing with them, on drawn and named cases.

mod pairs;
mod parry;
mod reference;
pub(super) mod sample;
mod shapes;
