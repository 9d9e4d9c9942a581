//! A design for a stone of another refractive index: pavilion by the critical angle, crown by a tangent ratio. The
//! formulas are in [`crate::manual::editing`]; which of them suits a design its scores decide
//! ([`RetargetRequest::edit`]).

use super::edit::{BeforeAfter, EditError, EditTarget, Edited, Editor, Keep, Setting, Side};
use super::tiers::Zone;
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;
use std::fmt;

/// Which angle the main facets of the pavilion get.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum PavilionRule {
    /// As far above the critical angle as before.
    Margin,
    /// The same place in the range of angles at which light along the axis is reflected at both sides.
    Range,
    /// As they are.
    Keep,
    /// So many degrees.
    Angle(f64),
}

/// What the tangents of the crown's angles are multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum CrownRule {
    /// (n − 1)/(n' − 1) from n to n': a thin prism then deviates light as before.
    Prism,
    /// n/n'.
    Index,
    /// Nothing: as they are.
    Keep,
    /// This.
    Ratio(f64),
}

impl fmt::Display for PavilionRule {
    /// As it is typed: `margin`, `41.5°`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            PavilionRule::Margin => f.write_str("margin"),
            PavilionRule::Range => f.write_str("range"),
            PavilionRule::Keep => f.write_str("keep"),
            PavilionRule::Angle(degrees) => write!(f, "{degrees}°"),
        }
    }
}

impl fmt::Display for CrownRule {
    /// As it is typed: `prism`, `0.9`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            CrownRule::Prism => f.write_str("prism"),
            CrownRule::Index => f.write_str("index"),
            CrownRule::Keep => f.write_str("keep"),
            CrownRule::Ratio(ratio) => write!(f, "{ratio}"),
        }
    }
}

/// What a design is to be made for.
///
/// ```
/// use cutlab::{RetargetRequest, Stone};
///
/// let quartz = Stone::parse("classic")?.into_design()?;
/// let sapphire = RetargetRequest::new(1.76).from(1.54).run(&quartz)?;
/// assert!(sapphire.figures.pavilion_angle_deg.after < sapphire.figures.pavilion_angle_deg.before);
/// assert_eq!(sapphire.edited.design.refractive_index, Some(1.76));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct RetargetRequest {
    /// The new refractive index.
    pub to: f64,
    /// The index that the design is for; none for the one that it states.
    #[serde(default)]
    pub from: Option<f64>,
    /// The pavilion's rule; none for the one with which the design scores best.
    #[serde(default)]
    pub pavilion: Option<PavilionRule>,
    /// The crown's rule; none for the one with which the design scores best.
    #[serde(default)]
    pub crown: Option<CrownRule>,
}

/// The figures by which a design was made for another index.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RetargetFigures {
    /// The refractive indices.
    pub refractive_index: BeforeAfter<f64>,
    /// The critical angles, in degrees.
    pub critical_angle_deg: BeforeAfter<f64>,
    /// The tier that sets the pavilion: of those that reach the lowest point, or the culet, the least steep.
    pub pavilion_tier: String,
    /// Its angle in degrees.
    pub pavilion_angle_deg: BeforeAfter<f64>,
    /// The pavilion's rule.
    pub pavilion_rule: PavilionRule,
    /// The crown's rule.
    pub crown_rule: CrownRule,
    /// What the tangents of the pavilion's angles were multiplied by.
    pub pavilion_scale: f64,
    /// What those of the crown were multiplied by.
    pub crown_scale: f64,
}

/// A design made for another index.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Retargeted {
    /// The design, with its new index, and its solid.
    pub edited: Edited,
    /// How it was made.
    pub figures: RetargetFigures,
    /// The pairs of rules that were tried, in their order; none where both rules were asked for.
    pub trials: Vec<RuleTrial>,
}

/// A pair of rules that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RuleTrial {
    /// The pavilion's rule.
    pub pavilion: PavilionRule,
    /// The crown's rule.
    pub crown: CrownRule,
    /// What the design scores by it, see [`RetargetRequest::edit`]; none if it makes no stone.
    pub score: Option<f64>,
    /// Why it makes none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// A design that cannot be made for another index. Each error is one line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RetargetError {
    /// A design that does not say which index it is for.
    #[error("the design does not say which refractive index it is for: say from which")]
    NoIndex,
    /// An index that no stone has.
    #[error("a refractive index is above 1: {0} is not")]
    Index(f64),
    /// No inclined facet reaches the lowest point.
    #[error("no inclined facet of the pavilion reaches the stone's lowest point or culet")]
    NoPavilion,
    /// An index at which no angle reflects light along the axis twice.
    #[error("at n = {0:.4} no pavilion reflects light along the axis twice: that takes n above 1.414")]
    NoRange(f64),
    /// An angle beyond the range at which light along the axis is reflected at both sides of the pavilion.
    #[error(
        "{tier} would have {angle:.2}°, and light along the axis is reflected at both sides of the pavilion \
         from {low:.2}° to {high:.2}° only (n = {index:.4})"
    )]
    Beyond {
        /// The tier.
        tier: String,
        /// What it would have, in degrees.
        angle: f64,
        /// The critical angle.
        low: f64,
        /// The angle above which the second reflection fails.
        high: f64,
        /// The new index.
        index: f64,
    },
    /// An angle that a pavilion cannot have.
    #[error("{tier} cannot have an angle of {angle:.2}°: above 0° and below 90° it must be")]
    Angle {
        /// The tier.
        tier: String,
        /// What it would have.
        angle: f64,
    },
    /// A ratio that is none.
    #[error("the ratio of the crown cannot be {0}: a number above 0")]
    Ratio(f64),
    /// A stone that cannot be scored.
    #[error("{0}")]
    Score(String),
    /// A change that the stone does not allow.
    #[error(transparent)]
    Edit(#[from] EditError),
}

/// Corners nearer to each other than this part of the width are one.
const ONE_CORNER: f64 = 1e-4;

/// The critical angle in degrees: light inside that meets a facet further from its normal is reflected whole.
fn critical_deg(index: f64) -> f64 {
    index.recip().asin().to_degrees()
}

/// The angle in degrees of a pavilion's sides above which light along the axis, reflected by one, leaves through the
/// other: it meets that at 180° − 3P, which must not be less than the critical angle.
fn most_deg(index: f64) -> f64 {
    60.0 - critical_deg(index) / 3.0
}

impl RetargetRequest {
    /// For a stone of this refractive index.
    pub fn new(to: f64) -> RetargetRequest {
        RetargetRequest { to, from: None, pavilion: None, crown: None }
    }

    /// From a stone of this refractive index, in place of the one that the design states.
    pub fn from(mut self, index: f64) -> RetargetRequest {
        self.from = Some(index);
        self
    }

    /// With a rule for the pavilion.
    pub fn pavilion(mut self, rule: PavilionRule) -> RetargetRequest {
        self.pavilion = Some(rule);
        self
    }

    /// With a rule for the crown.
    pub fn crown(mut self, rule: CrownRule) -> RetargetRequest {
        self.crown = Some(rule);
        self
    }

    /// The design for its new index by a pair of rules. Errors name the limit, the tier or the meet.
    pub fn by_rules(
        &self,
        editor: &Editor,
        pavilion: PavilionRule,
        crown: CrownRule,
    ) -> Result<Retargeted, RetargetError> {
        let from = self.from.or(editor.design.refractive_index).ok_or(RetargetError::NoIndex)?;
        for index in [from, self.to] {
            if !(index > 1.0 && index.is_finite()) {
                return Err(RetargetError::Index(index));
            }
        }
        let (pavilion_tier, before) = main_facets(editor).ok_or(RetargetError::NoPavilion)?;
        let after = self.pavilion_deg(pavilion, from, before, &pavilion_tier)?;
        if !(after > 0.0 && after < 90.0) {
            return Err(RetargetError::Angle { tier: pavilion_tier, angle: after });
        }
        let crown_scale = match crown {
            CrownRule::Prism => (from - 1.0) / (self.to - 1.0),
            CrownRule::Index => from / self.to,
            CrownRule::Keep => 1.0,
            CrownRule::Ratio(ratio) if ratio > 0.0 && ratio.is_finite() => ratio,
            CrownRule::Ratio(ratio) => return Err(RetargetError::Ratio(ratio)),
        };
        let pavilion_scale = after.to_radians().tan() / before.to_radians().tan();
        let scale = |side, value| Setting { target: EditTarget::Scale(side), is_added: false, value };
        let settings = [scale(Side::Pavilion, pavilion_scale), scale(Side::Crown, crown_scale)];
        let mut edited = editor.edit(&settings, Keep::Meets)?;
        edited.design.refractive_index = Some(self.to);
        Ok(Retargeted {
            edited,
            figures: RetargetFigures {
                refractive_index: BeforeAfter::new(from, self.to),
                critical_angle_deg: BeforeAfter::new(critical_deg(from), critical_deg(self.to)),
                pavilion_tier,
                pavilion_angle_deg: BeforeAfter::new(before, after),
                pavilion_rule: pavilion,
                crown_rule: crown,
                pavilion_scale,
                crown_scale,
            },
            trials: Vec::new(),
        })
    }

    /// The new angle of the pavilion's main facets.
    fn pavilion_deg(
        &self,
        rule: PavilionRule,
        from: f64,
        before: f64,
        tier: &str,
    ) -> Result<f64, RetargetError> {
        let [c_from, c_to] = [from, self.to].map(critical_deg);
        let [most_from, most_to] = [from, self.to].map(most_deg);
        match rule {
            PavilionRule::Keep => Ok(before),
            PavilionRule::Angle(degrees) => Ok(degrees),
            PavilionRule::Range => match [from, self.to].iter().find(|n| **n <= SQRT_2) {
                Some(index) => Err(RetargetError::NoRange(*index)),
                None => Ok(c_to + (before - c_from) / (most_from - c_from) * (most_to - c_to)),
            },
            PavilionRule::Margin => {
                let after = before + c_to - c_from;
                let is_beyond = |angle: f64, low: f64, high: f64| angle < low || angle > high;
                if is_beyond(after, c_to, most_to) && !is_beyond(before, c_from, most_from) {
                    if self.to <= SQRT_2 {
                        return Err(RetargetError::NoRange(self.to));
                    }
                    let (tier, index) = (tier.into(), self.to);
                    return Err(RetargetError::Beyond {
                        tier,
                        angle: after,
                        low: c_to,
                        high: most_to,
                        index,
                    });
                }
                Ok(after)
            }
        }
    }
}

/// Of the tiers with facets that reach the lowest point, or the culet, the least steep, and its angle in degrees.
fn main_facets(editor: &Editor) -> Option<(String, f64)> {
    let solid = &editor.solid;
    let lowest = solid.bounds().0.z + ONE_CORNER * editor.network.width;
    let reaches = |face: &usize| solid.polygon(*face).any(|corner| corner.z < lowest);
    let low: Vec<usize> = (0..solid.faces.len()).filter(reaches).map(|f| solid.faces[f].plane).collect();
    let tiers = editor.tiers.tiers.iter().filter(|t| t.zone == Zone::Pavilion);
    let mains = tiers.filter(|t| t.facets.iter().any(|f| low.contains(f)));
    let angles = mains.map(|t| (t.label().to_owned(), editor.angle_deg(t)));
    angles.min_by(|a, b| a.1.total_cmp(&b.1))
}
