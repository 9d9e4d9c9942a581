//! Tables of many stones: rows, shards, sweeps, merging; and the check against reference figures.

pub mod fingerprint;
pub mod finished_row;
pub mod merge;
pub mod request;
pub mod shard;
pub mod sidecar;
pub mod sweep;
pub mod table;
pub mod table_job;
pub mod validate;
