//! Stones: what a STONE argument names, with shape, material, size and orientation as one value.
//!
//! The grammar of a STONE, one wherever a stone is named, is in [`crate::manual::stones`].

mod error;
pub mod grammar;
pub mod options;
mod value;

pub use error::StoneError;
pub use grammar::StoneSpec;
pub use options::{Orientation, StoneOptions, UpAxis};
pub use value::Stone;
