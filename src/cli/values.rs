//! Values of options: read from what people type, refused with a sentence.

use crate::math::typed::{self, Unit};
use std::ops::RangeInclusive;
use std::time::Duration;

/// Value parser of `--seed`.
pub fn seed(text: &str) -> Result<u64, String> {
    typed::whole(text, 0..=u64::MAX, "a seed is a whole number")
}

/// Value parser of whole numbers.
///
/// - `what`: begins the sentence about what is needed: `a width is a whole number of pixels`
pub fn whole(
    range: RangeInclusive<u32>,
    what: &'static str,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    let range = u64::from(*range.start())..=u64::from(*range.end());
    move |text| typed::whole(text, range.clone(), what).map(|n| n as u32)
}

/// Value parser of a number that any command may refuse later.
pub fn number(unit: Unit) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| typed::number(text, unit).map_err(|e| e.to_string())
}

/// Value parser of `--time`.
pub fn duration(text: &str) -> Result<Duration, String> {
    humantime::parse_duration(text.trim())
        .map_err(|_| "a time is given with its unit, as 60s, 5min or 1h30m".into())
}
