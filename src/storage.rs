//! Files on disk: atomic writes, locks, journals, checkpoints, and limits on what is read.

pub mod atomic_write;
pub mod bounded_read;
pub mod checkpoint;
pub mod find_files;
pub mod include;
pub mod journal;
pub mod lock;
pub mod output_path;
pub mod stdin;
pub mod terminal;
pub mod text;
pub mod text_patch;
