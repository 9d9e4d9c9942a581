//! Studies: many stones, many scores.

pub mod score;
pub mod table;
