//! Tables of many stones: rows, shards, sweeps, merging; and the check against reference figures.

pub mod comparison;
pub mod comparison_table;
pub mod fingerprint;
pub mod finished_row;
pub mod input_files;
pub mod merge;
pub mod outlines;
pub mod output_places;
mod proportion_columns;
pub mod request;
mod row_maker;
pub mod score_rows;
pub mod shard;
pub mod sidecar;
pub mod stone_files;
pub mod sweep;
pub mod sweep_rows;
pub mod table;
pub mod table_job;
pub mod table_rows;
pub mod validate;
