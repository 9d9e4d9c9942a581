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
