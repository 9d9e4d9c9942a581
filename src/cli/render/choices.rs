//! Value parsers of `cutlab render`.

use crate::render::Curve;
use crate::render::animation::Turn;
use crate::scene::Pose;

/// `--exposure`.
#[derive(Debug, Clone, Copy)]
pub enum Exposure {
    /// Found from the picture.
    Auto,
    /// In stops beside the scene's own.
    Stops(f32),
}

pub fn exposure(text: &str) -> Result<Exposure, String> {
    match text.parse::<f32>() {
        _ if text == "auto" => Ok(Exposure::Auto),
        Ok(stops) if stops.abs() <= 30.0 => Ok(Exposure::Stops(stops)),
        _ => Err("an exposure is a number of stops from -30 to 30, or auto".into()),
    }
}

fn one_of<T: Copy, const N: usize>(all: &[(&str, T); N], name: &str) -> Result<T, String> {
    let found = all.iter().find(|(n, _)| *n == name).map(|(_, value)| *value);
    found.ok_or_else(|| format!("there is {}", all.each_ref().map(|(n, _)| *n).join(", ")))
}

pub fn pose(name: &str) -> Result<Pose, String> {
    one_of(&Pose::ALL, name)
}

pub fn turn(name: &str) -> Result<Turn, String> {
    one_of(&Turn::ALL, name)
}

pub fn curve(name: &str) -> Result<Curve, String> {
    one_of(&Curve::ALL, name)
}

pub fn f_number(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(n) if (1.0..=64.0).contains(&n) => Ok(n),
        _ => Err("an f-number from 1 to 64 is needed".into()),
    }
}

pub fn counted(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=50_000_000).contains(&n) => Ok(n),
        _ => Err("a number from 1 to 50000000 is needed".into()),
    }
}
