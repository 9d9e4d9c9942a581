//! Requests for tables of scores: everything that a table follows from, beside what its stones' files hold.
//!
//! A request is data. Its canonical JSON is hashed for the table's identity ([`super::fingerprint`]), so no
//! field can be left out of it; the command line that would make it again is written from it.

use super::sweep::{Steps, SweptParameter};
use super::table_job::Order;
use crate::design::outline_shape::OutlineShape;
use crate::metrics::Metric;
use crate::parse::shell::quoted;
use crate::scoring::settings::{ScoreRequest, Target};
use crate::stone::StoneOptions;
use serde::{Deserialize, Serialize};

/// A request for a table of scores.
///
/// ```
/// use cutlab::TableRequest;
///
/// let json = r#"{ "command": "score", "stones": ["tolkowsky"], "options": {}, "scores": { "metrics": ["wlr"] },
///     "tilt": null, "proportions": false, "sort": null }"#;
/// let request: TableRequest = serde_json::from_str(json)?;
/// assert!(request.command().starts_with("cutlab score tolkowsky --metrics wlr"));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(tag = "command", rename_all = "snake_case")]
#[non_exhaustive]
pub enum TableRequest {
    /// A row for each stone, or for each stone and tilt.
    Score(ScoreTable),
    /// A row for each point of a grid of parameters.
    Sweep(SweepTable),
    /// A row for each metric and stone.
    Compare(ComparisonTable),
}

/// A table with a row for each stone, or for each stone and tilt.
///
/// ```
/// use cutlab::{ScoreRequest, ScoreTable, TableRequest};
///
/// let table = ScoreTable::new(["tolkowsky", "oval"], ScoreRequest::new(["wlr"]).seed(2)).proportions(true);
/// let command = TableRequest::Score(table).command();
/// assert!(command.starts_with("cutlab score tolkowsky oval --metrics wlr"));
/// assert!(command.ends_with("--seed 2 --proportions"));
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ScoreTable {
    /// The stones as they are named: cuts, files, folders, patterns.
    pub stones: Vec<String>,
    /// What they are made of, how large they are and how they stand.
    pub options: StoneOptions,
    /// What is scored, and how.
    pub scores: ScoreRequest,
    /// How each stone is tilted; none for face-up.
    pub tilt: Option<TiltRange>,
    /// Whether there are columns of each stone's proportions.
    pub proportions: bool,
    /// By what the rows are sorted, if they are.
    pub sort: Option<SortRequest>,
    /// The outlines of which stones are scored; none for any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<OutlineShape>,
}

impl ScoreTable {
    /// Of these stones, as each is, face-up, a row for each.
    pub fn new<S: Into<String>>(stones: impl IntoIterator<Item = S>, scores: ScoreRequest) -> ScoreTable {
        let stones = stones.into_iter().map(Into::into).collect();
        let options = StoneOptions::default();
        ScoreTable {
            stones,
            options,
            scores,
            tilt: None,
            proportions: false,
            sort: None,
            outline: Vec::new(),
        }
    }

    /// With what is asked for of every stone.
    pub fn options(mut self, options: StoneOptions) -> ScoreTable {
        self.options = options;
        self
    }

    /// With a row for each tilt of each stone.
    pub fn tilt(mut self, tilt: TiltRange) -> ScoreTable {
        self.tilt = Some(tilt);
        self
    }

    /// Whether there are columns of each stone's proportions.
    pub fn proportions(mut self, proportions: bool) -> ScoreTable {
        self.proportions = proportions;
        self
    }

    /// Of stones with one of these outlines alone.
    pub fn outline(mut self, outlines: impl IntoIterator<Item = OutlineShape>) -> ScoreTable {
        self.outline = outlines.into_iter().collect();
        self
    }

    /// With its rows sorted.
    pub fn sort(mut self, sort: SortRequest) -> ScoreTable {
        self.sort = Some(sort);
        self
    }
}

/// Tilts about horizontal axes.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TiltRange {
    /// Degrees, right-handed about each axis.
    pub degrees: Steps,
    /// Azimuths of the axes, in degrees from +x towards +y.
    pub azimuths: Vec<f64>,
}

/// A metric that rows are sorted by.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SortRequest {
    /// The metric, one of those that are scored.
    pub metric: &'static Metric,
    /// Which rows come first, and how many are kept.
    pub order: Order,
}

/// A table with a row for each point of a grid of parameters, or of points scattered over it.
///
/// ```
/// use cutlab::{ScoreRequest, SweepTable, TableRequest};
///
/// let angles = "crown-angle=30:38:0.5".parse()?;
/// let table = SweepTable::new("round-brilliant", [angles], ScoreRequest::new(["wlr"]));
/// let command = TableRequest::Sweep(table).command();
/// assert!(command.starts_with("cutlab sweep round-brilliant --vary crown-angle=30:38:0.5 --metrics wlr"));
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct SweepTable {
    /// The stone that is varied.
    pub stone: String,
    /// What it is made of, how large it is and how it stands.
    pub options: StoneOptions,
    /// What is scored, and how.
    pub scores: ScoreRequest,
    /// What is varied, the first slowest.
    pub vary: Vec<SweptParameter>,
    /// So many scattered points in place of the grid.
    pub scatter: Option<u64>,
}

impl SweepTable {
    /// Of a stone, as it is otherwise, over the grid of these parameters.
    pub fn new(
        stone: impl Into<String>,
        vary: impl IntoIterator<Item = SweptParameter>,
        scores: ScoreRequest,
    ) -> SweepTable {
        let vary = vary.into_iter().collect();
        SweepTable { stone: stone.into(), options: StoneOptions::default(), scores, vary, scatter: None }
    }

    /// With what is asked for of the stone.
    pub fn options(mut self, options: StoneOptions) -> SweepTable {
        self.options = options;
        self
    }

    /// With so many scattered points in place of the grid.
    pub fn scatter(mut self, points: u64) -> SweepTable {
        self.scatter = Some(points);
        self
    }
}

/// A table with a row for each metric and stone, with differences from the first stone.
///
/// ```
/// use cutlab::{ComparisonTable, ScoreRequest, StoneOptions, TableRequest};
///
/// let table = ComparisonTable::new(["tolkowsky", "oval"], ScoreRequest::new(["wlr"]));
/// let table = table.options(StoneOptions::default().material("sapphire"));
/// let command = TableRequest::Compare(table).command();
/// assert!(command.starts_with("cutlab compare tolkowsky oval --metrics wlr --material sapphire"));
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ComparisonTable {
    /// The stones as they are named: cuts, files, folders, patterns.
    pub stones: Vec<String>,
    /// What they are made of, how large they are and how they stand.
    pub options: StoneOptions,
    /// What is scored, and how.
    pub scores: ScoreRequest,
}

impl ComparisonTable {
    /// Of these stones, as each is.
    pub fn new<S: Into<String>>(
        stones: impl IntoIterator<Item = S>,
        scores: ScoreRequest,
    ) -> ComparisonTable {
        let stones = stones.into_iter().map(Into::into).collect();
        ComparisonTable { stones, options: StoneOptions::default(), scores }
    }

    /// With what is asked for of every stone.
    pub fn options(mut self, options: StoneOptions) -> ComparisonTable {
        self.options = options;
        self
    }
}

impl TableRequest {
    /// What is scored, and how.
    pub fn scores(&self) -> &ScoreRequest {
        match self {
            TableRequest::Score(table) => &table.scores,
            TableRequest::Sweep(table) => &table.scores,
            TableRequest::Compare(table) => &table.scores,
        }
    }

    /// What is asked for of every stone.
    pub fn options(&self) -> &StoneOptions {
        match self {
            TableRequest::Score(table) => &table.options,
            TableRequest::Sweep(table) => &table.options,
            TableRequest::Compare(table) => &table.options,
        }
    }

    /// The command line that makes the table, every setting spelled out, without output and shard.
    pub fn command(&self) -> String {
        match self {
            TableRequest::Score(table) => {
                let mut words = command_of("score", &table.stones, &table.scores, &table.options);
                if table.proportions {
                    words += " --proportions";
                }
                if !table.outline.is_empty() {
                    let names: Vec<&str> = table.outline.iter().map(|outline| outline.name()).collect();
                    words += &format!(" --outline {}", names.join(","));
                }
                if let Some(SortRequest { metric, order }) = table.sort {
                    words += &format!(" --sort {}{}", if order.ascending { "-" } else { "" }, metric.name);
                    words += &order.top.map_or(String::new(), |n| format!(" --top {n}"));
                }
                if let Some(TiltRange { degrees, azimuths }) = &table.tilt {
                    let azimuths: Vec<String> = azimuths.iter().map(f64::to_string).collect();
                    words += &format!(" --tilt {degrees} --tilt-axis {}", azimuths.join(","));
                }
                words
            }
            TableRequest::Sweep(table) => {
                let mut words = format!("cutlab sweep {}", quoted(&table.stone));
                for varied in &table.vary {
                    words += &format!(" --vary {}={}", varied.key, varied.steps);
                }
                words += &table.scatter.map_or(String::new(), |n| format!(" --scatter {n}"));
                words + &settings(&table.scores, &table.options)
            }
            TableRequest::Compare(table) => {
                command_of("compare", &table.stones, &table.scores, &table.options)
            }
        }
    }
}

fn command_of(name: &str, stones: &[String], scores: &ScoreRequest, options: &StoneOptions) -> String {
    let stones: String = stones.iter().map(|stone| format!(" {}", quoted(stone))).collect();
    format!("cutlab {name}{stones}{}", settings(scores, options))
}

/// The options of a scoring command, with a blank before each.
fn settings(scores: &ScoreRequest, options: &StoneOptions) -> String {
    let names: Vec<&str> = scores.metrics.iter().map(|m| m.name).collect();
    let mut words = format!(" --metrics {}", names.join(","));
    let mut option = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            words += &format!(" --{name} {}", quoted(&value));
        }
    };
    option("error", if let Target::Error(e) = scores.target { Some(e.to_string()) } else { None });
    option("observer", scores.observer.map(|o| o.to_string()));
    option("material", options.material.clone());
    option("ri", options.ri.map(|n| n.to_string()));
    option("size", options.size_mm.map(|mm| mm.to_string()));
    option("polarisation", Some(if scores.polarised { "on" } else { "off" }.into()));
    option("seed", Some(scores.seed.to_string()));
    if scores.exact {
        words += " --exact";
    }
    words += &options.orientation.up.map_or(String::new(), |up| format!(" --up {}", up.name()));
    if options.orientation.align { words + " --align" } else { words }
}
