//! Options of `cutlab attribute`.

use crate::cli::args::objectives::ObjectiveArgs;
use crate::cli::args::scoring;
use crate::cli::args::values;
use crate::design::edit::Keep;
use crate::design::{LengthUnit, USUAL_WIDTH_MM};
use crate::metrics::Metric;
use crate::scoring::attribution::wanted;
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
    #[arg(long, value_name = "DEGREES,…", value_delimiter = ',', value_parser = values::tilt)]
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
    #[command(flatten)]
    pub how: ObjectiveArgs,
    /// Where to write the table of the tiers: .csv or .json; - is standard output
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl AttributeArgs {
    /// The request that was asked for, of a stone: one that says how large it is is scored so large.
    pub fn request(&self, stone: &Stone) -> AttributionRequest {
        let objective = |metric: &&'static Metric| -> Objective {
            let mut of = TiltedMetric::new(metric);
            of.observer = self.how.observer;
            if !self.tilt.is_empty() {
                of.tilts.degrees.clone_from(&self.tilt);
            }
            if self.worst { wanted(of).worst() } else { wanted(of) }
        };
        let metrics = scoring::once(&self.metrics);
        let effort = self.how.effort(stone);
        let mut request =
            AttributionRequest::default().objectives(metrics.iter().map(objective)).effort(effort);
        (request.keep, request.error) = (self.keep, self.error);
        request
    }

    /// What of the stone and of its material is a guess.
    pub fn notes(&self, stone: &Stone) -> Vec<String> {
        let unsized_stone = self.how.size.is_none() && stone.unit() != LengthUnit::Millimetre;
        let size = (unsized_stone && !stone.material().is_clear()).then(|| {
            format!("note: a stone without a size is taken as {USUAL_WIDTH_MM} mm wide; --size MM sets it")
        });
        let warnings = stone.warnings().iter().map(|warning| format!("note: {warning}"));
        warnings.chain(size).collect()
    }
}
