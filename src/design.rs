//! Designs: tiers of facets, parametric families, the library, proportions.

pub mod cutting_error;
pub mod design_file;
pub mod edit;
pub mod families;
pub mod gia_envelopes;
mod hull;
pub mod library;
pub mod measured_tiers;
pub mod meet_network;
pub mod meet_points;
pub mod orientation;
pub mod outline_shape;
pub mod proportion_catalogue;
pub mod proportions;
pub mod retarget;
pub mod round_brilliant_measures;
pub mod scaling;
pub mod symmetry;
pub mod tiers;

pub use families::CutError;
pub use tiers::{Design, Facet, FamilyValues, Gear, LengthUnit, Tier, USUAL_WIDTH_MM, Zone};
