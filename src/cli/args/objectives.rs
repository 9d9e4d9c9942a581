//! Options of commands that score designs by objectives: the observer, the light, the random numbers, the stone and its size.

use super::stone::{self, StoneArgs};
use super::values;
use crate::design::LengthUnit;
use crate::scoring::effort::Effort;
use crate::stone::Stone;

/// How objectives are scored.
#[derive(Debug, clap::Args)]
pub struct ObjectiveArgs {
    /// Half-angle in degrees of the observer's dark cone, for the metrics that have an observer [each its own]
    #[arg(long, value_name = "HALF-ANGLE", value_parser = values::half_angle)]
    pub observer: Option<f64>,
    /// Whether light keeps its polarisation from facet to facet
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stone::on_off, action = clap::ArgAction::Set)]
    polarisation: bool,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    pub seed: u64,
    #[command(flatten)]
    pub stone_args: StoneArgs,
    /// Girdle width in millimetres; the scores depend on it if the material absorbs
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
}

impl ObjectiveArgs {
    /// How finely a stone is scored: one that says how large it is is scored so large.
    pub fn effort(&self, stone: &Stone) -> Effort {
        let mut effort = Effort::default().seed(self.seed).polarised(self.polarisation);
        let own = (stone.unit() == LengthUnit::Millimetre).then(|| stone.width());
        effort.size_mm = self.size.or(own).unwrap_or(effort.size_mm);
        effort
    }
}
