//! Arguments that several commands share, each group a file.

pub(in crate::cli) mod family;
pub(in crate::cli) mod material;
pub(in crate::cli) mod objectives;
pub(in crate::cli) mod scoring;
pub(in crate::cli) mod stone;
pub(in crate::cli) mod tables;
pub(in crate::cli) mod values;
