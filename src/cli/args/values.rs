//! Values of options: read from what people type, refused with a sentence.

use crate::parse;
use crate::parse::NumberUnit;
use crate::report::diagram::Paper;
use std::ops::RangeInclusive;
use std::time::Duration;

/// Value parser of `--seed`.
pub fn seed(text: &str) -> Result<u64, String> {
    parse::parse_whole_number(text, 0..=u64::MAX, "a seed is a whole number")
}

/// Value parser of whole numbers.
///
/// - `what`: begins the sentence about what is needed: `a width is a whole number of pixels`
pub fn whole_number(
    range: RangeInclusive<u32>,
    what: &'static str,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    let range = u64::from(*range.start())..=u64::from(*range.end());
    move |text| parse::parse_whole_number(text, range.clone(), what).map(|n| n as u32)
}

/// Value parser of a number that any command may refuse later.
pub fn number(unit: NumberUnit) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| parse::parse_number(text, unit).map_err(|e| e.to_string())
}

/// Value parser of `--tilt`, of commands that score at single tilts.
pub fn tilt(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Degrees, -89.0..=89.0, "a tilt is a number of degrees")
}

/// Value parser of `--observer`.
pub fn half_angle(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Degrees, 0.0..=90.0, "a half-angle is a number of degrees")
}

/// Value parser of `--least-facet`.
pub fn facet_width(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Percent, 0.0..=50.0, "a facet's width is a percentage")
}

/// Value parser of `--least-girdle`.
pub fn part(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::None, 0.0..=1.0, "a part is a number")
}

/// Value parser of `--time`.
pub fn duration(text: &str) -> Result<Duration, String> {
    humantime::parse_duration(text.trim())
        .map_err(|_| "a time is given with its unit, e.g. 60s, 5min or 1h30m".into())
}

/// Value parser of `--paper`.
pub fn paper(name: &str) -> Result<Paper, String> {
    match &*name.to_lowercase() {
        "a4" => Ok(Paper::A4),
        "letter" => Ok(Paper::Letter),
        _ => Err("paper is a4 or letter".into()),
    }
}
