//! Pictures from requests: photon maps, exposure, rounds of a progressive picture, frames of an animation,
//! and the files that they are written to.

pub mod background;
mod conflicts;
mod error;
mod frames;
mod picture;
mod picture_kind;
mod progressive;
pub mod record;
mod remaining_time;
pub mod request;
mod request_builder;
pub mod target;

pub use background::Background;
pub use conflicts::first as first_conflict;
pub use error::RenderError;
pub use frames::to_files;
pub use picture::Picture;
pub use picture_kind::PictureKind;
pub use record::Record;
pub use request::{AnimationRequest, Exposure, RenderRequest, StopRequest};
pub use target::OutputTarget;
