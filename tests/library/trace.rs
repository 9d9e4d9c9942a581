//! The tracer: energy, the `f64` twin, brute force, instruction sets, reciprocity, rays that are hard on
//! rounding, stones that are not convex.

mod energy;
mod hard_cases;
mod instruction_sets;
mod intersect;
mod nonconvex;
mod nonconvex_scores;
mod reciprocity;
mod reference;
mod stones;
