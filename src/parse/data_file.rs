//! Data files in TOML, of materials and illuminants: their documents, and errors that name a place in them.

use super::{did_you_mean, nearest_name, plain};
use serde::de::DeserializeOwned;

/// A data file that cannot be used. Each error is one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DataFileError {
    /// The file cannot be read, or holds too much.
    #[error("{file}: {problem}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why not.
        problem: String,
    },
    /// Not TOML, or not of the document's form.
    #[error("{file}, line {line}: {problem}")]
    Form {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
    /// A value that cannot be.
    #[error("{file}, line {line}: {key}: expected {expected}, found {found}")]
    Value {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The key.
        key: String,
        /// What belongs there.
        expected: String,
        /// What stands there.
        found: String,
    },
}

/// A value of a document that cannot be, before its line is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueProblem {
    /// The key.
    pub key: &'static str,
    /// What belongs there.
    pub expected: String,
    /// What stands there.
    pub found: String,
}

impl ValueProblem {
    /// A problem with the value of `key`.
    pub fn new(key: &'static str, expected: impl Into<String>, found: impl Into<String>) -> ValueProblem {
        ValueProblem { key, expected: expected.into(), found: found.into() }
    }
}

/// A data file's text with the name that messages give it.
#[derive(Debug, Clone, Copy)]
pub struct DataFile<'a> {
    /// The name.
    pub name: &'a str,
    /// The text, in lines that end in LF.
    pub text: &'a str,
}

impl DataFile<'_> {
    /// The document that the text is.
    pub fn document<T: DeserializeOwned>(&self) -> Result<T, DataFileError> {
        toml::from_str(self.text).map_err(|error| {
            let line = self.line_at(error.span().map_or(0, |span| span.start));
            let found = self.text.lines().nth(line - 1).unwrap_or_default();
            let problem = plain::toml(error.message(), found) + &suggestion(error.message());
            DataFileError::Form { file: self.name.into(), line, problem }
        })
    }

    /// The error of a value in the part of the document that begins at `start` (bytes). Its line is that of
    /// the first line from there on that begins with the key, else the one where the part begins.
    pub fn error(&self, start: usize, problem: ValueProblem) -> DataFileError {
        let is_key = |line: &str| {
            let rest = line.trim_start().strip_prefix(problem.key);
            rest.is_some_and(|rest| rest.trim_start().starts_with('='))
        };
        let down = self.text.get(start..).unwrap_or_default().lines().position(is_key).unwrap_or(0);
        DataFileError::Value {
            file: self.name.into(),
            line: self.line_at(start) + down,
            key: problem.key.into(),
            expected: problem.expected,
            found: problem.found,
        }
    }

    /// The number, from 1, of the line that a byte lies in.
    fn line_at(&self, byte: usize) -> usize {
        1 + self.text.bytes().take(byte).filter(|b| *b == b'\n').count()
    }
}

/// What an unknown key or word was probably meant to be, of those that the TOML reader lists.
fn suggestion(message: &str) -> String {
    let message = message.lines().next().unwrap_or_default();
    if !message.starts_with("unknown ") {
        return String::new();
    }
    let mut names = message.split('`').skip(1).step_by(2);
    let typed = names.next().unwrap_or_default();
    did_you_mean(nearest_name(typed, names))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "kebab-case")]
    struct Stone {
        #[allow(dead_code)]
        specific_gravity: f64,
    }

    #[test]
    fn errors_name_line_and_key() {
        let file = DataFile { name: "my.toml", text: "# mine\nspecifc-gravity = 3\n" };
        let error = file.document::<Stone>().expect_err("a key is misspelt").to_string();
        assert!(error.starts_with("my.toml, line 2: the key 'specifc-gravity' is not known"), "{error}");
        assert!(error.ends_with("did you mean 'specific-gravity'?"), "{error}");
        let file = DataFile { name: "my.toml", text: "a = 1\n[b]\nc = 2\nspecific-gravity = -3\n" };
        let problem = ValueProblem::new("specific-gravity", "a number above 0", "-3");
        assert_eq!(
            file.error(6, problem).to_string(),
            "my.toml, line 4: specific-gravity: expected a number above 0, found -3"
        );
    }
}
