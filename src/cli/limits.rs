//! The limits on what a command reads, as the environment raises them.

use crate::limits::{FactorError, Limits, VARIABLE};

/// The limits that `CUTLAB_LIMIT` asks for; as they are without it.
pub fn asked() -> Result<Limits, FactorError> {
    std::env::var_os(VARIABLE).map_or(Ok(Limits::default()), |factor| factor.to_string_lossy().parse())
}

/// The same, for commands: [`super::run`] starts none where [`asked`] fails.
pub fn limits() -> Limits {
    asked().unwrap_or_default()
}
