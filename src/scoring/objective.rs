//! Objectives: what a design is made better in, as data.

use super::settings::Tilt;
use crate::metrics::{Metric, NoSuchMetric};
use crate::parse::{self, NumberUnit, format_number};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// What is wrong with an objective or a constraint, or why a stone has no value of it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjectiveError {
    /// A name that no metric has.
    #[error(transparent)]
    NoSuchMetric(#[from] NoSuchMetric),
    /// A name that neither a metric nor a proportion has.
    #[error("no metric or proportion is called '{name}'{}", parse::did_you_mean(*.nearest))]
    NoSuchQuantity {
        /// The name.
        name: String,
        /// The metric or proportion that is probably meant.
        nearest: Option<&'static str>,
    },
    /// Text that is no bound.
    #[error("'{0}' is not a bound (expected NAME=NUMBER or NAME=NUMBER*start, e.g. weight_ratio=0.95)")]
    NotABound(String),
    /// A tilt that is none.
    #[error("a stone can be tilted by up to {most}°, not by '{0}'", most = Tilt::MOST_DEGREES)]
    Tilt(String),
    /// A material that there is not.
    #[error("{0}")]
    Material(String),
    /// No objective at all.
    #[error("nothing to make better: an objective is needed")]
    Nothing,
    /// A quantity that a stone does not have.
    #[error("{quantity}: {why}")]
    NotMeasured {
        /// Its name.
        quantity: String,
        /// Why.
        why: String,
    },
}

/// What counts of a metric's values at several tilts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OverTilts {
    /// Their mean.
    #[default]
    Mean,
    /// The one that is worst for the aim: the least where more is wanted, the greatest where less is.
    Worst,
}

/// How a stone is tilted for a metric.
///
/// At each tilt the metric is the mean over the azimuths of the tilt's axis; of the tilts the mean or the worst
/// counts. By default the stone is face-up; axes are along +x, as those of tilt curves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Tilts {
    /// Tilts from face-up, in degrees ([`Tilt::degrees`]).
    pub degrees: Vec<f64>,
    /// Azimuths of the horizontal axes, in degrees from +x towards +y.
    pub azimuths: Vec<f64>,
    /// What counts of the tilts.
    pub over: OverTilts,
}

impl Default for Tilts {
    fn default() -> Tilts {
        Tilts { degrees: vec![0.0], azimuths: vec![0.0], over: OverTilts::Mean }
    }
}

/// A metric of a stone as it is made, tilted and looked at.
///
/// As text `NAME` or `NAME@TILT,TILT…`: `iso@0,10,20`.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct TiltedMetric {
    /// The metric.
    pub metric: &'static Metric,
    /// How the stone is tilted.
    #[serde(default)]
    pub tilts: Tilts,
    /// What it is made of, as [`crate::Material::open`] takes it; none for what the design is made of.
    #[serde(default)]
    pub material: Option<String>,
    /// Half-angle in degrees of the observer's dark cone; none leaves the metric its own.
    #[serde(default)]
    pub observer: Option<f64>,
}

/// Which values of a metric are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// The greatest.
    Maximise,
    /// The least.
    Minimise,
}

impl Aim {
    /// 1 where more is wanted, −1 where less is.
    pub fn sign(self) -> f64 {
        match self {
            Aim::Maximise => 1.0,
            Aim::Minimise => -1.0,
        }
    }
}

/// What a design is made better in.
///
/// ```
/// use cutlab::advanced::scoring::objective::Objective;
///
/// let objective = Objective::maximise("iso@0,10".parse()?).worst();
/// assert_eq!(objective.of.tilts.degrees, [0.0, 10.0]);
/// assert_eq!(objective.name(), "iso@0,10 (worst)");
/// # Ok::<(), cutlab::advanced::scoring::objective::ObjectiveError>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Objective {
    /// Of what.
    pub of: TiltedMetric,
    /// Which values are wanted.
    pub aim: Aim,
}

impl TiltedMetric {
    /// A metric of a face-up stone, with the metric's own observer.
    pub fn new(metric: &'static Metric) -> TiltedMetric {
        TiltedMetric { metric, tilts: Tilts::default(), material: None, observer: None }
    }

    /// Whether it is seen face-up alone.
    pub fn is_face_up(&self) -> bool {
        self.tilts.degrees == [0.0]
    }

    /// The metric as it is typed, with the tilts that it is at, and what the worst of them is called.
    pub fn name(&self) -> String {
        let Tilts { degrees, over, .. } = &self.tilts;
        let tilts: Vec<String> = degrees.iter().map(|d| format_number(*d)).collect();
        let worst = if *over == OverTilts::Worst { " (worst)" } else { "" };
        match degrees[..] {
            [0.0] => self.metric.name.into(),
            _ => format!("{}@{}{worst}", self.metric.name, tilts.join(",")),
        }
    }

    /// Tilt by tilt, the tilts about each axis. One that is face-up has no axis.
    pub(super) fn views(&self) -> Vec<Vec<Option<Tilt>>> {
        let about = |degrees: f64| match degrees {
            0.0 => vec![None],
            _ => self.tilts.azimuths.iter().map(|&azimuth| Some(Tilt { degrees, azimuth })).collect(),
        };
        self.tilts.degrees.iter().map(|degrees| about(*degrees)).collect()
    }

    /// Whether there are tilts, none of them steeper than a stone can be tilted.
    pub(super) fn check(&self) -> Result<(), ObjectiveError> {
        let Tilts { degrees, azimuths, .. } = &self.tilts;
        if degrees.is_empty() || azimuths.is_empty() {
            return Err(ObjectiveError::Tilt(String::new()));
        }
        let is_tilt = |degrees: &f64| degrees.abs() <= Tilt::MOST_DEGREES;
        match degrees.iter().find(|d| !is_tilt(d)).or(azimuths.iter().find(|a| !a.is_finite())) {
            Some(wrong) => Err(ObjectiveError::Tilt(format_number(*wrong))),
            None => Ok(()),
        }
    }
}

impl FromStr for TiltedMetric {
    type Err = ObjectiveError;

    /// `NAME` or `NAME@TILT,TILT…`.
    fn from_str(text: &str) -> Result<TiltedMetric, ObjectiveError> {
        let (name, tilts) = text.split_once('@').map_or((text, None), |(name, tilts)| (name, Some(tilts)));
        let mut tilted = TiltedMetric::new(Metric::named(name)?);
        if let Some(tilts) = tilts {
            let number = |text: &str| {
                let degrees = parse::parse_number(text, NumberUnit::Degrees);
                degrees.map_err(|_| ObjectiveError::Tilt(text.trim().into()))
            };
            tilted.tilts.degrees = tilts.split(',').map(number).collect::<Result<_, _>>()?;
        }
        tilted.check()?;
        Ok(tilted)
    }
}

impl Objective {
    /// The greatest value of a metric is wanted.
    pub fn maximise(of: TiltedMetric) -> Objective {
        Objective { of, aim: Aim::Maximise }
    }

    /// The least value of a metric is wanted.
    pub fn minimise(of: TiltedMetric) -> Objective {
        Objective { of, aim: Aim::Minimise }
    }

    /// At tilts in degrees in place of its own.
    pub fn tilts(mut self, degrees: impl IntoIterator<Item = f64>) -> Objective {
        self.of.tilts.degrees = degrees.into_iter().collect();
        self
    }

    /// About axes with these azimuths in degrees.
    pub fn azimuths(mut self, degrees: impl IntoIterator<Item = f64>) -> Objective {
        self.of.tilts.azimuths = degrees.into_iter().collect();
        self
    }

    /// The worst of the tilts counts, not their mean.
    pub fn worst(mut self) -> Objective {
        self.of.tilts.over = OverTilts::Worst;
        self
    }

    /// Of a stone of another material than the design's.
    pub fn material(mut self, name: impl Into<String>) -> Objective {
        self.of.material = Some(name.into());
        self
    }

    /// With a half-angle in degrees of the observer's dark cone.
    pub fn observer(mut self, half_angle_deg: f64) -> Objective {
        self.of.observer = Some(half_angle_deg);
        self
    }

    /// Its metric with the tilts.
    pub fn name(&self) -> String {
        self.of.name()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objectives_are_read_as_they_are_typed() {
        let iso: TiltedMetric = "ISO@0, 10°,-20".parse().expect("a metric at tilts");
        assert_eq!((iso.metric.name, &iso.tilts.degrees[..]), ("iso", &[0.0, 10.0, -20.0][..]));
        assert_eq!(iso.views().iter().map(Vec::len).sum::<usize>(), 3);
        let wrong = |text: &str| text.parse::<TiltedMetric>().expect_err(text).to_string();
        assert!(wrong("iso@95").contains("not by '95'") && wrong("iso@x").contains("'x'"));
        assert_eq!(
            wrong("fire_streek"),
            "no metric is called 'fire_streek'; did you mean 'fire_streak'? (all: cutlab list metrics)"
        );
    }

    #[test]
    fn objectives_are_data() {
        let given = Objective::minimise(TiltedMetric::new(Metric::named("windowing").expect("a metric")))
            .tilts([0.0, 15.0])
            .azimuths([0.0, 90.0])
            .worst()
            .material("quartz")
            .observer(5.0);
        let text = toml::to_string(&given).expect("is data");
        let back: Objective = toml::from_str(&text).expect("is read again");
        assert_eq!(format!("{given:?}"), format!("{back:?}"));
        assert_eq!(back.of.views().iter().map(Vec::len).collect::<Vec<_>>(), [1, 2]);
        let short: Objective = toml::from_str("aim = 'maximise'\nof = { metric = 'wlr' }").expect("is short");
        assert_eq!((short.of.tilts, short.of.observer), (Tilts::default(), None));
    }
}
