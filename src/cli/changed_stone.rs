//! A changed stone on the command line: the file it goes to, and its tables.

mod file;
mod text;

pub use file::{ChangeArgs, ChangedFile};
pub use text::ChangedText;
