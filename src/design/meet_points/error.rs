//! Why a tier cannot be placed. Each error is one line.

use crate::geometry::SolidError;
use crate::limits::Exceeded;

/// Why a tier cannot be placed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeetError {
    /// A rule names a facet that no earlier tier has.
    #[error("no facet before it is called '{facet}' (write TIER@INDEX or TIER NUMBER; there is {})", .known.join(", "))]
    UnknownFacet {
        /// What was named.
        facet: String,
        /// The tiers there are.
        known: Vec<String>,
    },
    /// A tier's name where one of its facets is meant.
    #[error("'{tier}' has {count} facets: say which, as {tier}@INDEX or {tier} NUMBER")]
    WhichFacet {
        /// The tier.
        tier: String,
        /// How many facets it has.
        count: usize,
    },
    /// Fewer than three facets.
    #[error("'{corner}' names {count} facets: a corner needs three (a guide can be one of them)")]
    TooFew {
        /// The corner as written.
        corner: String,
        /// How many facets it names.
        count: usize,
    },
    /// Planes that have no point in common, or more than one.
    #[error("'{corner}' is not a corner: these planes do not meet in one point{}", miss(*.apart))]
    NoCorner {
        /// The corner as written.
        corner: String,
        /// How far the planes pass each other by, if they cross at all.
        apart: f64,
    },
    /// The corner is not on the stone.
    #[error("'{corner}' is not a corner of the stone: {by} cuts it away, {depth:.6} deep")]
    CutAway {
        /// The corner as written.
        corner: String,
        /// The facet that cuts it away.
        by: String,
        /// How far beyond that facet the corner lies.
        depth: f64,
    },
    /// A tier without angle and without two corners.
    #[error("needs an angle, or two corners that fix it")]
    NoAngle,
    /// Angle and two corners at once.
    #[error("has an angle and two corners: one of the three must go")]
    TooMuch,
    /// Two corners that no facet at this index can both hold.
    #[error(
        "no facet at index {index} passes through both corners: they lie one above the other or across it"
    )]
    NoPlane {
        /// The tier's first index.
        index: f64,
    },
    /// `width` on a tier that is not vertical, `table` on one that is not horizontal.
    #[error("'{rule}' is for {needed} tiers; this one stands at {angle_deg}°")]
    WrongAngle {
        /// The rule's word.
        rule: &'static str,
        /// Which tiers it is for.
        needed: &'static str,
        /// The tier's angle.
        angle_deg: f64,
    },
    /// A rule that speaks of W before the girdle is cut.
    #[error("the stone has no girdle yet, so it has no width: cut the girdle before this tier")]
    NoGirdle,
    /// A table larger than any that the crown allows.
    #[error("a table of {asked:.4} W cannot be cut: the stone there is at most {most:.4} W wide")]
    TableTooLarge {
        /// What was asked for, as a fraction of W.
        asked: f64,
        /// The most there is.
        most: f64,
    },
    /// More facets, or more work, than is taken on.
    #[error(transparent)]
    Limit(#[from] Exceeded),
    /// The tiers before it leave the stone open where it must be closed.
    #[error("the tiers before it do not close the stone: {0}")]
    Open(#[from] SolidError),
}

fn miss(distance: f64) -> String {
    if distance.is_finite() { format!(", they miss it by {distance:.3e}") } else { String::new() }
}
