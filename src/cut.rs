//! Cuts: designs as tiers of facets, parametric families, the library, proportions.

pub mod brilliant;
pub mod design;
pub mod document;
pub mod families;
mod hull;
pub mod library;
pub mod measured;
pub mod meet;
pub mod proportions;
pub mod standing;
pub mod stretch;
pub mod symmetry;

pub use design::{Design, Facet, Gear, Tier, USUAL_WIDTH_MM, Unit, Zone};
pub use families::CutError;
