//! Options of `cutlab retarget`.

use crate::cli::changed_stone::ChangeArgs;
use crate::design::retarget::{CrownRule, PavilionRule};
use crate::parse::{self, NumberUnit};
use crate::stone::grammar;
use std::ffi::OsString;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab retarget classic --material sapphire               a design for quartz, for sapphire
  cutlab retarget mine.asc --ri 1.62 --from 1.54 -o topaz.asc
  cutlab retarget mine.asc --material spinel --pavilion 41 --crown keep

The formulas are in `cutlab help editing`; unless one is named they are all tried, and the design is taken with
the greatest ISO (mean of face-up and 10° of tilt). Every meet of the design is kept: crown and pavilion are
each scaled by the ratio of tangents. Scores are those of both designs in the new material, with the same random
numbers.")]
pub struct RetargetArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, a file, or - for standard input. It is
    /// made for the stone that --material or --ri says
    #[arg(value_name = "STONE")]
    pub stone: OsString,
    /// The refractive index that the design is drawn for [what it states, or diamond's]
    #[arg(long, value_name = "N", value_parser = grammar::refractive_index)]
    pub from: Option<f64>,
    /// Angle of the pavilion's main facets: margin (as far above the critical angle as before), range (the same place
    /// in the range of angles that reflect light along the axis twice), keep, degrees, or best (which of these
    /// formulas scores best) [best]
    #[arg(long, value_name = "best|margin|range|keep|DEGREES", value_parser = pavilion)]
    pub pavilion: Option<Choice<PavilionRule>>,
    /// What the tangents of the crown's angles are multiplied by: prism ((n − 1)/(n' − 1): a thin prism then
    /// deviates light as before), index (n/n'), keep, a ratio, or best [best]
    #[arg(long, value_name = "best|prism|index|keep|RATIO", value_parser = crown)]
    pub crown: Option<Choice<CrownRule>>,
    #[command(flatten)]
    pub change: ChangeArgs,
}

/// A rule, or whichever scores best.
#[derive(Debug, Clone, Copy)]
pub enum Choice<R> {
    /// Whichever scores best.
    Best,
    /// This one.
    One(R),
}

impl<R> Choice<R> {
    /// The rule that was asked for.
    pub fn rule(self) -> Option<R> {
        match self {
            Choice::Best => None,
            Choice::One(rule) => Some(rule),
        }
    }
}

/// Value parser of `--pavilion`.
fn pavilion(text: &str) -> Result<Choice<PavilionRule>, String> {
    match &*text.trim().to_lowercase() {
        "best" => Ok(Choice::Best),
        "range" => Ok(Choice::One(PavilionRule::Range)),
        "margin" => Ok(Choice::One(PavilionRule::Margin)),
        "keep" => Ok(Choice::One(PavilionRule::Keep)),
        _ => {
            let what = "the pavilion's rule is best, margin, range, keep or an angle";
            Ok(Choice::One(PavilionRule::Angle(parse::parse_number_within(
                text,
                NumberUnit::Degrees,
                1.0..=89.0,
                what,
            )?)))
        }
    }
}

/// Value parser of `--crown`.
fn crown(text: &str) -> Result<Choice<CrownRule>, String> {
    match &*text.trim().to_lowercase() {
        "best" => Ok(Choice::Best),
        "prism" => Ok(Choice::One(CrownRule::Prism)),
        "index" => Ok(Choice::One(CrownRule::Index)),
        "keep" => Ok(Choice::One(CrownRule::Keep)),
        _ => {
            let what = "the crown's rule is best, prism, index, keep or a ratio";
            Ok(Choice::One(CrownRule::Ratio(parse::parse_number_within(
                text,
                NumberUnit::None,
                0.01..=100.0,
                what,
            )?)))
        }
    }
}
