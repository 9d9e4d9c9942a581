//! Options of `cutlab optimise`.

use crate::cli::args::objectives::ObjectiveArgs;
use crate::cli::args::values;
use crate::design::edit::Keep;
use crate::optimise::{Guards, MOST_TOLERANCE_DEG, OptimiseRequest, Variable};
use crate::parse::{self, NumberUnit};
use crate::report::LEAST_WIDTH;
use crate::scene::scene_file::MOST_PIXELS;
use crate::scoring::constraint::Constraint;
use crate::scoring::objective::{Objective, TiltedMetric};
use crate::search::{METHODS, Method};
use crate::stone::Stone;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab optimise mine.asc --maximise iso -o best.asc        by the two tangent ratios
  cutlab optimise mine.asc --vary 'P*.angle' --vary C1.angle=28:36 --maximise iso --tilt 0,10,20 -o best.asc
  cutlab optimise tolkowsky --vary crown-angle=30:36 --vary pavilion-angle=40:42 --maximise wlr
  cutlab optimise mine.asc --maximise iso --maximise fire_streak --at-least weight_ratio=0.95*start -o front
  cutlab optimise mine.asc --maximise iso@0,10 --minimise windowing@20 --evaluations 800 -o front

Scores of the faceters' view are taken from exact beams, others by the same random numbers for every candidate.
The designs that are kept are scored again with fresh random numbers; a gain is called significant if it is
beyond three of its errors and not negligible. An interrupted command leaves the best design so far and goes
on when it is started again. See `cutlab help optimising`.")]
pub struct OptimiseArgs {
    /// The stone: a name from `cutlab list cuts`, with parameters or not, or a file
    #[arg(value_name = "STONE")]
    pub stone: OsString,
    /// What may vary, and how far: WHAT, or WHAT=FROM:TO, where WHAT is as for `cutlab edit --set`; may be
    /// given several times [the two tangent ratios]
    #[arg(long, value_name = "WHAT[=FROM:TO]", value_parser = variable)]
    vary: Vec<Variable>,
    /// A score of which more is wanted, see `cutlab list metrics`; NAME@0,10,20 at tilts of its own. Several
    /// objectives give a front
    #[arg(long, value_name = "NAME", value_parser = tilted)]
    maximise: Vec<TiltedMetric>,
    /// A score of which less is wanted
    #[arg(long, value_name = "NAME", value_parser = tilted)]
    minimise: Vec<TiltedMetric>,
    /// Tilts in degrees about the x axis at which scores are taken [0]
    #[arg(long, value_name = "DEGREES,…", value_delimiter = ',', value_parser = values::tilt)]
    tilt: Vec<f64>,
    /// Of several tilts, and of the stones within --tolerance, the worst counts, not the mean
    #[arg(long)]
    worst: bool,
    /// By how much each tier's angle may be off when the stone is cut: scores are those of stones with such errors
    /// [0, cut as drawn]
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, hide_default_value = true, value_parser = tolerance)]
    tolerance: f64,
    /// A bound from below on a score or a proportion: NAME=VALUE, or NAME=0.95*start for a part of what the
    /// stone has
    #[arg(long, value_name = "NAME=VALUE", value_parser = at_least)]
    at_least: Vec<Constraint>,
    /// A bound from above
    #[arg(long, value_name = "NAME=VALUE", value_parser = at_most)]
    at_most: Vec<Constraint>,
    /// No facet becomes narrower than this percentage of the girdle width
    #[arg(long, value_name = "PERCENT", default_value_t = Guards::default().least_facet_percent, value_parser = values::facet_width)]
    least_facet: f64,
    /// The girdle keeps at least this part of its thickness
    #[arg(long, value_name = "PART", default_value_t = Guards::default().least_girdle, value_parser = values::part)]
    least_girdle: f64,
    /// What stays when something varies: meets, angles or depths, as for `cutlab edit`
    #[arg(long, value_name = "meets|angles|depths", default_value = "meets", value_parser = super::super::edit::keep)]
    keep: Keep,
    /// The most designs that are scored
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = values::whole_number(1..=1_000_000, "a number of evaluations is a whole number"))]
    evaluations: u32,
    /// How many improvements run side by side
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = values::whole_number(1..=1000, "a number of starts is a whole number"))]
    starts: u32,
    /// How many distinct designs are kept [1, of a front 8]
    #[arg(long, value_name = "N", value_parser = values::whole_number(1..=1000, "a number of designs is a whole number"))]
    keep_best: Option<u32>,
    /// How candidates are chosen: random, nelder-mead, cma-es, nsga-ii, sms-emoa, surrogate
    #[arg(long, value_name = "NAME", value_parser = method)]
    method: Option<Method>,
    #[command(flatten)]
    pub how: ObjectiveArgs,
    /// Where to write: a design file, whose extension chooses the format (best.asc; further designs are
    /// best-2.asc, best-3.asc …); or a folder, for these, the table of the front, and a page (index.html)
    #[arg(long, short, value_name = "FILE|DIR")]
    pub output: Option<PathBuf>,
    /// Pixels across each picture of the page in a folder [320]
    #[arg(long, value_name = "PIXELS", value_parser = values::whole_number(LEAST_WIDTH..=MOST_PIXELS, "a width is a whole number of pixels"))]
    pub width: Option<u32>,
    /// The candidates of the front as a table, with variables and objectives; .csv
    #[arg(long, value_name = "FILE")]
    pub front: Option<PathBuf>,
}

impl OptimiseArgs {
    /// The request that was asked for, of a stone: one that says how large it is is scored so large.
    pub fn request(&self, stone: &Stone) -> OptimiseRequest {
        let tilted = |of: &TiltedMetric| {
            let mut of = of.clone();
            if of.is_face_up() && !self.tilt.is_empty() {
                of.tilts.degrees.clone_from(&self.tilt);
            }
            of.observer = of.observer.or(self.how.observer);
            of
        };
        let objective = |objective: Objective| if self.worst { objective.worst() } else { objective };
        let more = self.maximise.iter().map(|of| objective(Objective::maximise(tilted(of))));
        let less = self.minimise.iter().map(|of| objective(Objective::minimise(tilted(of))));
        let mut request = OptimiseRequest::new(more.chain(less)).vary(self.vary.iter().cloned());
        request.constraints = self.at_least.iter().chain(&self.at_most).cloned().collect();
        request.guards = Guards::new(self.least_facet, self.least_girdle);
        request.keep = self.keep;
        request.effort = self.how.effort(stone);
        request.tolerance_deg = self.tolerance;
        request.method = self.method;
        request.evaluations = self.evaluations as usize;
        request.starts = self.starts as usize;
        request.seed = self.how.seed;
        request.keep_best = self.keep_best.map(|n| n as usize);
        request
    }
}

fn variable(text: &str) -> Result<Variable, String> {
    text.parse().map_err(|error: crate::optimise::VariableError| error.to_string())
}

fn tilted(text: &str) -> Result<TiltedMetric, String> {
    text.parse().map_err(|error: crate::scoring::objective::ObjectiveError| error.to_string())
}

fn at_least(text: &str) -> Result<Constraint, String> {
    Constraint::at_least(text).map_err(|error| error.to_string())
}

fn at_most(text: &str) -> Result<Constraint, String> {
    Constraint::at_most(text).map_err(|error| error.to_string())
}

fn tolerance(text: &str) -> Result<f64, String> {
    let what = "the error of an angle is a number of degrees";
    parse::parse_number_within(text, NumberUnit::Degrees, 0.0..=MOST_TOLERANCE_DEG, what)
}

fn method(text: &str) -> Result<Method, String> {
    let names: Vec<&str> = METHODS.iter().map(|m| m.name()).collect();
    text.trim().to_lowercase().parse().map_err(|_| format!("a method is one of {}", names.join(", ")))
}
