//! Numbers and names as people type them on a command line or in a stone's parameters; data files and tables
//! of spectra.

pub mod data_file;
mod display;
pub mod plain;
pub mod shell;
pub mod spectral_table;
pub mod table_entry;

pub use display::display_name;
use std::ops::RangeInclusive;

/// What stands for a minus sign in text that went through a word processor: U+2212 and dashes.
pub const MINUS_SIGNS: [char; 6] = ['\u{2212}', '\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{FF0D}'];

/// Text that is not the number that is needed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NumberError {
    /// A comma where the decimal point belongs, or between thousands.
    #[error("write decimals with a point and no separators, as {0}")]
    Comma(String),
    /// Two numbers, as in a width by a height.
    #[error("one number is needed, '{0}' is two")]
    Two(String),
    /// A number with a unit other than its own.
    #[error("'{unit}' is not the unit: give {wanted}, as {number}")]
    Unit {
        /// What follows the number.
        unit: String,
        /// What is needed.
        wanted: &'static str,
        /// The number alone.
        number: String,
    },
    /// Larger than a number can be, or `nan`.
    #[error("a finite number is needed")]
    Infinite,
    /// A number with decimals where none can be.
    #[error("a whole number is needed")]
    Decimals,
    /// Nothing of the kind.
    #[error("a number is needed")]
    NotANumber,
}

/// The unit that a number is taken in. It may be typed after the number or left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberUnit {
    /// None: an index, a ratio, a count.
    None,
    /// Degrees.
    Degrees,
    /// Hundredths.
    Percent,
    /// Millimetres.
    Millimetres,
    /// Metric carats.
    Carats,
}

impl NumberUnit {
    /// The unit whose sign, blanks apart, is `sign`.
    pub fn from_sign(sign: &str) -> NumberUnit {
        match sign.trim() {
            "°" => NumberUnit::Degrees,
            "%" => NumberUnit::Percent,
            "mm" => NumberUnit::Millimetres,
            "ct" => NumberUnit::Carats,
            _ => NumberUnit::None,
        }
    }

    /// The sign that stands behind a number; empty for none.
    pub fn sign(self) -> &'static str {
        self.signs().first().copied().unwrap_or_default()
    }

    fn signs(self) -> &'static [&'static str] {
        match self {
            NumberUnit::None => &[],
            NumberUnit::Degrees => &["°", "º", "degrees", "degree", "deg"],
            NumberUnit::Percent => &["%", "percent"],
            NumberUnit::Millimetres => &["mm", "millimetres", "millimeters"],
            NumberUnit::Carats => &["ct", "carats", "carat"],
        }
    }

    /// The number in this unit of one in the unit `sign`, as text; none if it cannot be told.
    fn converted(self, number: &str, sign: &str) -> Option<String> {
        let factor = match (self, sign) {
            (NumberUnit::None, "%") => 0.01,
            (NumberUnit::Millimetres, "\u{b5}m" | "\u{3bc}m" | "um" | "microns") => 1e-3,
            (NumberUnit::Millimetres, "cm") => 10.0,
            (NumberUnit::Millimetres, "m") => 1000.0,
            (NumberUnit::Millimetres, "in" | "inch" | "\"" | "″") => 25.4,
            (NumberUnit::Degrees, "rad") => 1f64.to_degrees(),
            (NumberUnit::Carats, "g") => 5.0,
            (NumberUnit::Carats, "mg") => 0.005,
            (NumberUnit::Carats, "pt" | "points") => 0.01,
            _ => return None,
        };
        Some(format_number((number.parse::<f64>().ok()? * factor * 1e6).round() / 1e6))
    }

    fn spelled_out(self) -> &'static str {
        match self {
            NumberUnit::None => "the number alone",
            NumberUnit::Degrees => "degrees",
            NumberUnit::Percent => "per cent",
            NumberUnit::Millimetres => "millimetres",
            NumberUnit::Carats => "carats",
        }
    }
}

/// A finite number, with or without its unit: `34.5`, `34.5°`, `57 %`, `8mm`. The minus sign may be one of
/// [`MINUS_SIGNS`].
///
/// - `unit`: what it is taken in
pub fn parse_number(text: &str, unit: NumberUnit) -> Result<f64, NumberError> {
    let typed = text.trim().replace(MINUS_SIGNS, "-");
    let lower = typed.to_lowercase();
    let alone = unit.signs().iter().find_map(|sign| lower.strip_suffix(sign)).unwrap_or(&lower).trim_end();
    match alone.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(_) => Err(NumberError::Infinite),
        Err(_) => Err(explain(alone, unit)),
    }
}

/// Why a text is not a number.
fn explain(text: &str, unit: NumberUnit) -> NumberError {
    let is_number = |t: &str| t.trim().parse::<f64>().is_ok_and(f64::is_finite);
    if text.trim_start_matches(['+', '-']).starts_with("0x") {
        return NumberError::NotANumber; // hexadecimal, not a width by a height
    }
    if let Some((a, b)) = text.split_once(['x', '×', '*'])
        && is_number(a)
        && is_number(b)
    {
        return NumberError::Two(text.into());
    }
    let digits = text.bytes().all(|b| b.is_ascii_digit() || b",.'_+- ".contains(&b));
    if digits && text.contains(',') {
        let (whole, decimals) = text.rsplit_once(',').unwrap_or((text, ""));
        let whole: String = whole.chars().filter(|c| !",.'_ ".contains(*c)).collect();
        let thousands = decimals.len() == 3 && text.matches(',').count() > 1 || decimals.contains('.');
        let right = if thousands {
            text.chars().filter(|c| !",'_ ".contains(*c)).collect()
        } else {
            format!("{whole}.{decimals}")
        };
        if is_number(&right) {
            return NumberError::Comma(right);
        }
    }
    // the longest beginning that is a number, and what follows it
    let ends = text.char_indices().map(|(i, _)| i).skip(1);
    if let Some(end) = ends.filter(|end| is_number(&text[..*end])).last() {
        let (number, sign) = (text[..end].trim().to_owned(), text[end..].trim().to_owned());
        if sign.chars().all(|c| c.is_alphabetic() || "°º%′″'\"²³".contains(c)) {
            let number = unit.converted(&number, &sign).unwrap_or(number);
            return NumberError::Unit { unit: sign, wanted: unit.spelled_out(), number };
        }
    }
    NumberError::NotANumber
}

/// A number in a range, or a sentence that says what is needed.
///
/// - `what`: begins the sentence: `a girdle width is a number of millimetres`
pub fn parse_number_within(
    text: &str,
    unit: NumberUnit,
    range: RangeInclusive<f64>,
    what: &str,
) -> Result<f64, String> {
    let needed =
        || format!("{what} from {} to {}", format_number(*range.start()), format_number(*range.end()));
    match parse_number(text, unit) {
        Ok(x) if range.contains(&x) => Ok(x),
        Ok(_) | Err(NumberError::Infinite | NumberError::NotANumber) => Err(needed()),
        Err(error) => Err(error.to_string()),
    }
}

/// A whole number in a range, or a sentence that says what is needed.
///
/// - `what`: begins the sentence: `a width is a whole number of pixels`
pub fn parse_whole_number(text: &str, range: RangeInclusive<u64>, what: &str) -> Result<u64, String> {
    let needed = || match range.end() {
        &u64::MAX => format!("{what} from {} on", range.start()),
        end => format!("{what} from {} to {end}", range.start()),
    };
    let typed = text.trim();
    match typed.parse::<u64>() {
        Ok(n) if range.contains(&n) => return Ok(n),
        Ok(_) => return Err(needed()),
        Err(_) => (),
    }
    match parse_number(typed, NumberUnit::None) {
        // `1e5`, as a number with decimals or a sign would be
        Ok(x) if x.fract() == 0.0 && (0.0..1e15).contains(&x) && range.contains(&(x as u64)) => Ok(x as u64),
        Ok(x) if x.fract() != 0.0 => Err(NumberError::Decimals.to_string()),
        // decimals, or thousands apart
        Err(NumberError::Comma(_)) => {
            let digits: String = typed.chars().filter(|c| !",.'_ ".contains(*c)).collect();
            let thousands = typed.split(',').skip(1).all(|part| part.len() == 3);
            Err(if thousands { format!("write no separators, as {digits}") } else { needed() })
        }
        Ok(_) | Err(NumberError::Infinite | NumberError::NotANumber) => Err(needed()),
        Err(error) => Err(error.to_string()),
    }
}

/// Whether a name of a catalogue is the one typed: in any case, blanks around it left out.
pub fn is_name(name: &str, typed: &str) -> bool {
    name.eq_ignore_ascii_case(typed.trim())
}

/// The candidate that is meant by `typed`, if one is so near that it probably is: up to a third of its
/// letters differ, or `typed` begins it.
pub fn nearest_name<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let typed = typed.trim().to_lowercase();
    let letters = typed.chars().count();
    let distance = |name: &str| match letters >= 3 && name.starts_with(&typed) {
        true => 1,
        false => strsim::damerau_levenshtein(&name.to_lowercase(), &typed),
    };
    let (name, distance) = candidates.map(|n| (n, distance(n))).min_by_key(|(_, d)| *d)?;
    (3 * distance <= letters).then_some(name)
}

/// `, did you mean 'NAME'?`, or nothing.
pub fn did_you_mean(near: Option<&str>) -> String {
    near.map_or_else(String::new, |name| format!("; did you mean '{name}'?"))
}

/// A number for a message: all its digits, with an exponent where it would have many zeros.
pub fn format_number(x: f64) -> String {
    if x == 0.0 || (1e-5..1e10).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_understood_with_their_unit() {
        for (text, unit, x) in [
            ("34.5", NumberUnit::Degrees, 34.5),
            ("34.5°", NumberUnit::Degrees, 34.5),
            (" 34.5 deg ", NumberUnit::Degrees, 34.5),
            ("57%", NumberUnit::Percent, 57.0),
            ("57 %", NumberUnit::Percent, 57.0),
            ("8mm", NumberUnit::Millimetres, 8.0),
            ("1.5 ct", NumberUnit::Carats, 1.5),
            ("\u{2212}3", NumberUnit::None, -3.0),
            ("1e3", NumberUnit::None, 1000.0),
        ] {
            assert_eq!(parse_number(text, unit), Ok(x), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_explained() {
        let said = |text: &str, unit| parse_number(text, unit).map_err(|e| e.to_string());
        for (text, unit, word) in [
            ("34,5", NumberUnit::Degrees, "as 34.5"),
            ("1,234,567", NumberUnit::None, "as 1234567"),
            ("1,234.5", NumberUnit::None, "as 1234.5"),
            ("640x480", NumberUnit::None, "is two"),
            ("57%", NumberUnit::Degrees, "give degrees, as 57"),
            ("8 cm", NumberUnit::Millimetres, "give millimetres, as 80"),
            ("8µm", NumberUnit::Millimetres, "give millimetres, as 0.008"),
            ("200mg", NumberUnit::Carats, "give carats, as 1"),
            ("0.2 g", NumberUnit::Carats, "give carats, as 1"),
            ("34.5°", NumberUnit::None, "the number alone, as 34.5"),
            ("inf", NumberUnit::None, "finite"),
            ("1e400", NumberUnit::None, "finite"),
            ("nan", NumberUnit::None, "finite"),
            ("", NumberUnit::None, "a number is needed"),
            ("abc", NumberUnit::None, "a number is needed"),
            ("34.5.6", NumberUnit::None, "a number is needed"),
        ] {
            assert!(said(text, unit).is_err_and(|e| e.contains(word)), "{text}: {:?}", said(text, unit));
        }
    }

    #[test]
    fn whole_numbers_and_ranges_say_what_they_are() {
        let pixels = |text: &str| parse_whole_number(text, 1..=16384, "a width is a whole number of pixels");
        assert_eq!(pixels("640"), Ok(640));
        assert_eq!(pixels("1e3"), Ok(1000));
        for text in ["0", "16385", "-4", "x", "", "99999999999999999999999"] {
            let said = pixels(text);
            assert_eq!(said, Err("a width is a whole number of pixels from 1 to 16384".into()), "{text}");
        }
        assert_eq!(pixels("2.5"), Err("a whole number is needed".into()));
        assert!(pixels("640x480").is_err_and(|e| e.contains("is two")));
        assert_eq!(pixels("1,000"), Err("write no separators, as 1000".into()));
        assert_eq!(pixels("640,5"), Err("a width is a whole number of pixels from 1 to 16384".into()));
        let size = |text: &str| {
            parse_number_within(
                text,
                NumberUnit::Millimetres,
                1e-3..=1e3,
                "a width is a number of millimetres",
            )
        };
        assert_eq!(size("5mm"), Ok(5.0));
        assert_eq!(size("0"), Err("a width is a number of millimetres from 0.001 to 1000".into()));
    }

    #[test]
    fn names_are_known_in_any_case_and_suggested_only_when_near() {
        assert!(is_name("round-brilliant", " Round-Brilliant "));
        let names = ["tolkowsky", "asscher", "classic", "round-brilliant", "weight_ratio", "quartz"];
        let near = |typed| nearest_name(typed, names.into_iter());
        assert_eq!(near("tolkovski"), Some("tolkowsky"));
        assert_eq!(near("ROUND-BRILIANT"), Some("round-brilliant"));
        assert_eq!(near("weight"), Some("weight_ratio"));
        for far in ["PC", "emptydir", "amethyst", "x", "", "iso"] {
            assert_eq!(near(far), None, "{far}");
        }
    }

    #[test]
    fn numbers_of_many_zeros_are_shown_with_an_exponent() {
        assert_eq!(
            [0.0, 0.05, 34.5, 1e-300, -2e300].map(format_number),
            ["0", "0.05", "34.5", "1e-300", "-2e300"]
        );
    }
}
