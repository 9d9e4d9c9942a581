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

The formulas are in `cutlab help editing`. Every meet of the design is kept: crown and pavilion are each
scaled by the ratio of tangents. Scores are those of both designs in the new material, with the same
random numbers.")]
pub struct RetargetArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, a file, or - for standard input. It is
    /// made for the stone that --material or --ri says
    #[arg(value_name = "STONE")]
    pub stone: OsString,
    /// The refractive index that the design is drawn for [what it states, or diamond's]
    #[arg(long, value_name = "N", value_parser = grammar::refractive_index)]
    pub from: Option<f64>,
    /// Angle of the pavilion's main facets: margin (as far above the critical angle as before), range (the same place
    /// in the range of angles that reflect light along the axis twice), keep, or degrees
    #[arg(long, value_name = "margin|range|keep|DEGREES", default_value = "margin", value_parser = pavilion)]
    pub pavilion: PavilionRule,
    /// What the tangents of the crown's angles are multiplied by: prism ((n − 1)/(n' − 1): a thin prism then
    /// deviates light as before), keep, or a ratio
    #[arg(long, value_name = "prism|keep|RATIO", default_value = "prism", value_parser = crown)]
    pub crown: CrownRule,
    #[command(flatten)]
    pub change: ChangeArgs,
}

/// Value parser of `--pavilion`.
fn pavilion(text: &str) -> Result<PavilionRule, String> {
    match &*text.trim().to_lowercase() {
        "range" => Ok(PavilionRule::Range),
        "margin" => Ok(PavilionRule::Margin),
        "keep" => Ok(PavilionRule::Keep),
        _ => {
            let what = "the pavilion's rule is margin, range, keep or an angle";
            Ok(PavilionRule::Angle(parse::parse_number_within(text, NumberUnit::Degrees, 1.0..=89.0, what)?))
        }
    }
}

/// Value parser of `--crown`.
fn crown(text: &str) -> Result<CrownRule, String> {
    match &*text.trim().to_lowercase() {
        "prism" => Ok(CrownRule::Prism),
        "keep" => Ok(CrownRule::Keep),
        _ => {
            let what = "the crown's rule is prism, keep or a ratio";
            Ok(CrownRule::Ratio(parse::parse_number_within(text, NumberUnit::None, 0.01..=100.0, what)?))
        }
    }
}
