//! Changes that cannot be made. Each error is one line.

use crate::design::families::CutError;
use crate::design::meet_network::NetworkError;
use crate::geometry::SolidError;
use crate::parse::did_you_mean;

/// A change that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// A tier that the design does not have.
    #[error("no tier is called '{asked}'{}: there is {}", did_you_mean(.nearest.as_deref()), .known.join(", "))]
    NoSuchTier {
        /// What was asked for.
        asked: String,
        /// What is probably meant.
        nearest: Option<String>,
        /// What there is.
        known: Vec<String>,
    },
    /// A key that is no parameter of the design's family, or a design that has none.
    #[error("{key} cannot be set{}: {}", did_you_mean(.nearest.as_deref()), settable(.known))]
    NoSuchKey {
        /// What was asked for.
        key: String,
        /// What is probably meant.
        nearest: Option<String>,
        /// The parameters of the design's family; none if it has none.
        known: Vec<&'static str>,
    },
    /// An angle that a facet cannot have.
    #[error("{tier} cannot have an angle of {value}°: above 0° and below 90° it must be")]
    Angle {
        /// The tier.
        tier: String,
        /// What it would have.
        value: f64,
    },
    /// A facet whose angle says what it is.
    #[error("{tier} is a {zone}, which stays {}: {}", if *.zone == "girdle" { "vertical" } else { "horizontal" }, instead(.zone))]
    FixedAngle {
        /// The tier.
        tier: String,
        /// Table, culet or girdle.
        zone: &'static str,
    },
    /// A value that cannot be.
    #[error("{target} cannot be {value}: {needed}")]
    Value {
        /// What was set.
        target: String,
        /// To what.
        value: f64,
        /// What it can be.
        needed: &'static str,
    },
    /// A stone that has no table, girdle or culet to be changed.
    #[error("the stone has no {0} facet whose size could be set")]
    Lacks(&'static str),
    /// A size that is not reached though every meet is kept.
    #[error("no stone with these meets has {target} = {asked}: {nearest:.2} is the nearest that was found")]
    NotReached {
        /// Table or culet or girdle.
        target: &'static str,
        /// What was asked for, in percent.
        asked: f64,
        /// What was found.
        nearest: f64,
    },
    /// A meet that cannot be kept, or facets that would be lost.
    #[error("{}", network(.cause, .facets, .by.as_deref()))]
    Network {
        /// What went wrong.
        cause: NetworkError,
        /// The facets of the meet, or those lost, by name.
        facets: Vec<String>,
        /// The facet that cuts it away, by name.
        by: Option<String>,
    },
    /// Parameters of a family that make no stone.
    #[error(transparent)]
    Family(#[from] CutError),
    /// Planes that bound no stone.
    #[error(transparent)]
    Solid(#[from] SolidError),
}

fn settable(keys: &[&str]) -> String {
    match keys {
        [] => "set TIER.angle, TIER.index, TIER.depth, crown.scale, pavilion.scale, crown.shift, \
               pavilion.shift, table, girdle or culet"
            .into(),
        keys => format!("its family has {}", keys.join(", ")),
    }
}

fn instead(zone: &str) -> &'static str {
    match zone {
        "table" => "set table=PERCENT",
        "culet" => "set culet=PERCENT",
        _ => "set girdle=PERCENT",
    }
}

/// Names joined, a long list cut short.
fn named(facets: &[String]) -> String {
    const SHOWN: usize = 6;
    let shown = facets[..facets.len().min(SHOWN)].join(", ");
    if facets.len() > SHOWN { format!("{shown} and {} more", facets.len() - SHOWN) } else { shown }
}

fn network(cause: &NetworkError, facets: &[String], by: Option<&str>) -> String {
    let facets = named(facets);
    match cause {
        NetworkError::Opens { by, .. } => {
            format!("the meet of {facets} cannot be kept: it would open by {:.2} % of the width", 100.0 * by)
        }
        NetworkError::CutAway { depth, .. } => {
            let by = by.unwrap_or("another facet");
            format!(
                "the meet of {facets} cannot be kept: {by} would cut it away, {:.2} % of the width deep",
                100.0 * depth
            )
        }
        NetworkError::Lost { .. } => format!("nothing would be left of {facets}"),
        other => other.to_string(),
    }
}
