//! Studies: many stones, many scores.

pub mod batch;
pub mod compare;
pub mod identity;
pub mod line;
pub mod merge;
pub mod meta;
pub mod score;
pub mod shard;
mod sheet;
pub mod sweep;
pub mod table;
pub mod validate;
