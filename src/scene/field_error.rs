//! Errors of a scene file's entries.

/// What is wrong with an entry, and the key it is about.
#[derive(Debug)]
pub struct FieldError {
    /// The key.
    pub key: &'static str,
    /// The problem, in one line.
    pub problem: String,
}

pub(super) fn field_error(key: &'static str, problem: impl Into<String>) -> FieldError {
    FieldError { key, problem: problem.into() }
}

/// An entry of a catalogue by name; the error lists all.
pub(super) fn require_name<T>(
    key: &'static str,
    found: Option<T>,
    name: &str,
    all: &[&str],
) -> Result<T, FieldError> {
    found.ok_or_else(|| field_error(key, format!("{key} '{name}' is not one of {}", all.join(", "))))
}
