//! Value parsers of `cutlab render`.

use crate::integrators::ToneCurve;
use crate::integrators::animation::Turn;
use crate::parse;
use crate::parse::NumberUnit;
use crate::render::Exposure;
use crate::scene::Pose;

/// Value parser of `--exposure`.
pub fn exposure(text: &str) -> Result<Exposure, String> {
    if text.trim().eq_ignore_ascii_case("auto") {
        return Ok(Exposure::Auto);
    }
    let stops = parse::parse_number_within(
        text,
        NumberUnit::None,
        -30.0..=30.0,
        "an exposure is auto, or a number of stops",
    )?;
    Ok(Exposure::Stops(stops as f32))
}

fn one_of<T: Copy, const N: usize>(all: &[(&str, T); N], name: &str) -> Result<T, String> {
    let found = all.iter().find(|(n, _)| parse::is_name(n, name)).map(|(_, value)| *value);
    found.ok_or_else(|| format!("there is {}", all.each_ref().map(|(n, _)| *n).join(", ")))
}

/// Value parser of `--pose`.
pub fn pose(name: &str) -> Result<Pose, String> {
    one_of(&Pose::ALL, name)
}

/// Value parser of `--turn`.
pub fn turn(name: &str) -> Result<Turn, String> {
    one_of(&Turn::ALL, name)
}

/// Value parser of `--tone`.
pub fn curve(name: &str) -> Result<ToneCurve, String> {
    one_of(&ToneCurve::ALL, name)
}

/// Value parser of `--glare`.
pub fn f_number(text: &str) -> Result<f32, String> {
    let number = text.trim().strip_prefix("f/").unwrap_or(text);
    Ok(parse::parse_number_within(number, NumberUnit::None, 1.0..=64.0, "an f-number is a number")? as f32)
}

/// Value parser of `--photons` and `--nearest`.
pub fn counted(text: &str) -> Result<usize, String> {
    Ok(parse::parse_whole_number(text, 1..=50_000_000, "photons are a whole number")? as usize)
}
