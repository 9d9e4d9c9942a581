//! Complaints of the TOML reader, in words for the person who wrote the file.

use super::{NumberError, NumberUnit};
use crate::parse;

/// The complaint of the TOML reader as a sentence.
///
/// - `message`: its own words; `line`: what stands in the line that it is about
pub fn toml(message: &str, line: &str) -> String {
    let message = message.lines().next().unwrap_or_default();
    if let Some(rest) = message.strip_prefix("invalid type: ")
        && let Some((found, wanted)) = rest.split_once(", expected ")
    {
        return misfit(found, wanted);
    }
    if let Some(rest) = message.strip_prefix("invalid value: ")
        && let Some((found, wanted)) = rest.split_once(", expected ")
    {
        return format!("{} is needed, not {}", kind(wanted), thing(found));
    }
    if let Some(rest) = message.strip_prefix("invalid length ")
        && let Some((length, wanted)) = rest.split_once(", expected ")
    {
        return format!("{} is needed, not a list of {length}", kind(wanted));
    }
    for (beginning, what) in [("unknown field `", "the key"), ("unknown variant `", "the word")] {
        if let Some(rest) = message.strip_prefix(beginning)
            && let Some((name, known)) = rest.split_once("`, ")
        {
            let known = known.trim_start_matches("expected ").trim_start_matches("one of ").replace('`', "");
            return format!("{what} '{name}' is not known here; there is {known}");
        }
    }
    if let Some(name) = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`')) {
        return format!("the key '{name}' is missing");
    }
    if message.starts_with("duplicate key") {
        return "a key is given twice".into();
    }
    if message.contains("overflow") {
        return "a finite number is needed".into();
    }
    // what stands behind the equals sign is often a number as people write it
    if let Some((_, value)) = line.split_once('=') {
        let value = value.split('#').next().unwrap_or_default().trim();
        match parse::parse_number(value, NumberUnit::None) {
            Err(NumberError::NotANumber | NumberError::Infinite) | Ok(_) => (),
            Err(error) => return number(error),
        }
    }
    format!("this is not as TOML has it ({message})")
}

/// `string "34,5"` where a number is needed.
fn misfit(found: &str, wanted: &str) -> String {
    let text = found.strip_prefix("string \"").and_then(|rest| rest.strip_suffix('"'));
    let wanted = kind(wanted);
    if let (Some(text), true) = (text, wanted.ends_with("number")) {
        return match parse::parse_number(text, NumberUnit::None) {
            Ok(_) => format!("{wanted} is needed: write it without quotes"),
            Err(NumberError::NotANumber | NumberError::Infinite) => {
                format!("{wanted} is needed, not '{text}'")
            }
            Err(error) => number(error),
        };
    }
    format!("{wanted} is needed, not {}", thing(found))
}

fn number(error: NumberError) -> String {
    match error {
        NumberError::Unit { number, .. } => format!("a number stands alone, as {number}"),
        error => error.to_string(),
    }
}

/// A type of the program's as people call it.
fn kind(wanted: &str) -> String {
    match wanted.trim_end_matches(|c: char| c.is_whitespace()) {
        "f64" | "f32" => "a number".into(),
        "u8" | "u16" | "u32" | "u64" | "usize" | "i8" | "i16" | "i32" | "i64" | "isize" => {
            "a whole number".into()
        }
        "a string" | "string" => "text in quotes".into(),
        "a boolean" | "bool" => "true or false".into(),
        "a sequence" | "an array" => "a list".into(),
        "a map" => "a table".into(),
        other => match other.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length}"),
            None if other.starts_with("struct ") => "a table".into(),
            None => other.replace('`', "'"),
        },
    }
}

/// What stands there, as people call it.
fn thing(found: &str) -> String {
    match found {
        "sequence" => "a list".into(),
        "map" => "a table".into(),
        "datetime" => "a date".into(),
        other => {
            let value = other.find(['`', '"']).map_or(other, |at| &other[at..]);
            value.trim_matches(['`', '"']).to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn complaints_have_no_word_of_the_parser() {
        for (message, line, said) in [
            ("invalid type: string \"34,5\", expected f64", "", "as 34.5"),
            ("invalid type: string \"34.5°\", expected f64", "", "a number stands alone, as 34.5"),
            ("invalid type: string \"34\", expected f32", "", "without quotes"),
            ("invalid type: string \"x\", expected f64", "", "a number is needed, not 'x'"),
            ("invalid type: boolean `true`, expected f64", "", "a number is needed, not true"),
            ("invalid type: sequence, expected f64", "", "a number is needed, not a list"),
            ("invalid type: floating point `1.5`, expected u32", "", "a whole number is needed, not 1.5"),
            ("invalid type: integer `3`, expected a string", "", "text in quotes is needed, not 3"),
            ("invalid length 2, expected an array of length 3", "", "a list of 3 is needed, not a list of 2"),
            (
                "unknown field `index`, expected one of `name`, `angle`",
                "",
                "'index' is not known here; there is name, angle",
            ),
            (
                "unknown variant `inch`, expected `stone` or `mm`",
                "",
                "'inch' is not known here; there is stone or mm",
            ),
            ("missing field `to`", "", "the key 'to' is missing"),
            ("floating-point number overflowed", "angle = 1e400", "a finite number"),
            ("unexpected key or value, expected newline, `#`", "angle = 34,5 # steep", "as 34.5"),
            (
                "unexpected key or value, expected newline, `#`",
                "angle = 34.5°",
                "a number stands alone, as 34.5",
            ),
            ("string values must be quoted, expected literal string", "name = x y", "not as TOML has it"),
        ] {
            let plain = toml(message, line);
            assert!(plain.contains(said), "{message}: {plain}");
            for word in ["f64", "f32", "u32", "invalid", "variant", "field"] {
                assert!(!plain.contains(word), "{message}: {plain}");
            }
        }
    }
}
