//! The walk: energy, the `f64` twin, brute force, instruction sets, reciprocity, rays that are hard on
//! rounding, stones with dents.

mod dented;
mod dents;
mod energy;
mod instruction_sets;
mod reciprocity;
mod search;
mod stones;
mod thin;
mod twin;
