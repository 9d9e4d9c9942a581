//! Options of `cutlab attribute`.

use crate::cli::args::scoring;
use crate::cli::args::stone::{self, StoneArgs};
use crate::cli::args::values;
use crate::design::edit::Keep;
use crate::design::{LengthUnit, USUAL_WIDTH_MM};
use crate::metrics::Metric;
use crate::parse::{self, NumberUnit};
use crate::scoring::attribution::wanted;
use crate::scoring::effort::Effort;
use crate::scoring::objective::TiltedMetric;
use crate::scoring::{AttributionRequest, Objective};
use crate::stone::Stone;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab attribute mine.asc                             what to change first for iso and wlr
  cutlab attribute mine.asc --metrics iso --tilt 0,10,20     for the mean over three tilts
  cutlab attribute classic --material quartz --metrics windowing,iso -o tiers.csv
  cutlab attribute mine.asc --json                      with the light that is lost facet by facet

Each tier is turned by a quarter of a degree to both sides while what met still meets; what is
shown is the change per degree by which it is steeper. * marks changes beyond three of their errors
that are not negligible. The first lines name the tier of which half a degree gains most: what its
change per degree predicts, and what scoring the changed stone gives. Light is lost where a viewer who
looks straight down sees what lies below the stone. See `cutlab help editing`.")]
pub struct AttributeArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, a file, or - for standard input
    #[arg(value_name = "STONE")]
    pub stone: OsString,
    /// Scores to attribute (see `cutlab list metrics`)
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "iso,wlr", value_parser = scoring::metric)]
    metrics: Vec<&'static Metric>,
    /// Tilts in degrees about the x axis at which scores are taken [0]
    #[arg(long, value_name = "DEGREES,…", value_delimiter = ',', value_parser = tilt)]
    tilt: Vec<f64>,
    /// Of several tilts the worst counts, not the mean
    #[arg(long)]
    worst: bool,
    /// What a turned tier leaves as it is: meets, angles or depths, as for `cutlab edit` [angles, and of a tier
    /// that then cannot be turned meets]
    #[arg(long, value_name = "meets|angles|depths", value_parser = super::super::edit::keep)]
    keep: Option<Keep>,
    /// Trace until the noise of every change per degree is below this times the metric's scale: 1 for
    /// fractions and degrees, 100 for percentages [131,072 points a stone]
    #[arg(long, value_name = "E", value_parser = scoring::error)]
    error: Option<f64>,
    /// Half-angle in degrees of the observer's dark cone, for the metrics that have an observer [each its own]
    #[arg(long, value_name = "HALF-ANGLE", value_parser = values::half_angle)]
    observer: Option<f64>,
    /// Whether light keeps its polarisation from facet to facet
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stone::on_off, action = clap::ArgAction::Set)]
    polarisation: bool,
    /// Seed of the random streams
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::seed)]
    seed: u64,
    #[command(flatten)]
    pub stone_args: StoneArgs,
    /// Girdle width in millimetres; the scores depend on it if the material absorbs
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    /// Where to write the table of the tiers: .csv or .json; - is standard output
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl AttributeArgs {
    /// The request that was asked for, of a stone: one that says how large it is is scored so large.
    pub fn request(&self, stone: &Stone) -> AttributionRequest {
        let objective = |metric: &&'static Metric| -> Objective {
            let mut of = TiltedMetric::new(metric);
            of.observer = self.observer;
            if !self.tilt.is_empty() {
                of.tilts.degrees.clone_from(&self.tilt);
            }
            if self.worst { wanted(of).worst() } else { wanted(of) }
        };
        let metrics = scoring::once(&self.metrics);
        let effort =
            Effort::default().seed(self.seed).polarised(self.polarisation).size_mm(self.size_mm(stone));
        let mut request =
            AttributionRequest::default().objectives(metrics.iter().map(objective)).effort(effort);
        (request.keep, request.error) = (self.keep, self.error);
        request
    }

    /// What of the stone and of its material is a guess.
    pub fn notes(&self, stone: &Stone) -> Vec<String> {
        let unsized_stone = self.size.is_none() && stone.unit() != LengthUnit::Millimetre;
        let size = (unsized_stone && !stone.material().is_clear()).then(|| {
            format!("note: a stone without a size is taken as {USUAL_WIDTH_MM} mm wide; --size MM sets it")
        });
        let warnings = stone.warnings().iter().map(|warning| format!("note: {warning}"));
        warnings.chain(size).collect()
    }

    fn size_mm(&self, stone: &Stone) -> f64 {
        let own = (stone.unit() == LengthUnit::Millimetre).then(|| stone.width());
        self.size.or(own).unwrap_or(USUAL_WIDTH_MM)
    }
}

fn tilt(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, NumberUnit::Degrees, -89.0..=89.0, "a tilt is a number of degrees")
}
