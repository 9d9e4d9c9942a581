//! Options of `cutlab edit`.

use crate::cli::changed_stone::ChangeArgs;
use crate::design::edit::{Keep, Setting};
use std::ffi::OsString;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab edit classic --set P1.angle+=0.5                what half a degree more does to tiers and proportions
  cutlab edit mine.asc --set crown.scale=0.9 --set table=57 -o lower.asc      everything else as in mine.asc
  cutlab edit mine.asc --set 'P*.angle-=0.2' --score iso,wlr     and what the scores make of it
  cutlab edit round-brilliant --set crown-angle=35 -o mine.toml     a family by its parameters
  cutlab show mine.asc --meets                           names of the tiers, and what meets where

WHAT: TIER.angle, TIER.index, TIER.depth, crown.scale, pavilion.scale, crown.shift, pavilion.shift, table,
girdle, culet, or a parameter of the design's family (cutlab help editing). TIER: a name, a place (P1, C2,
G1), a number, or a pattern (P*).

With --score the stone is scored before and after with the same random numbers; a difference is called
significant if it is beyond three of its errors and not negligible.")]
pub struct EditArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, a file, or - for standard input
    #[arg(value_name = "STONE")]
    pub stone: OsString,
    /// What to change: WHAT=VALUE, or WHAT+=VALUE and WHAT-=VALUE from what it is; give it several times for
    /// several changes
    #[arg(long, value_name = "WHAT=VALUE", required = true, value_parser = setting, allow_hyphen_values = true)]
    pub set: Vec<Setting>,
    /// What stays: meets (other tiers follow, by distances and where they must by angles), angles (only
    /// distances follow), or depths (no distance changes, and meets open)
    #[arg(long, value_name = "meets|angles|depths", default_value = "meets", value_parser = keep)]
    pub keep: Keep,
    #[command(flatten)]
    pub change: ChangeArgs,
}

/// Value parser of `--set`.
fn setting(text: &str) -> Result<Setting, String> {
    text.parse().map_err(|error: crate::design::edit::SettingError| error.to_string())
}

/// Value parser of `--keep`.
pub fn keep(text: &str) -> Result<Keep, String> {
    match &*text.trim().to_lowercase() {
        "meets" => Ok(Keep::Meets),
        "angles" => Ok(Keep::Angles),
        "depths" => Ok(Keep::Depths),
        _ => Err("what stays is meets, angles or depths".into()),
    }
}
