//! Scores of one stone, as accurate as asked for, and of stones against each other.

mod adaptive;
pub mod attribution;
pub mod comparison;
pub mod constraint;
pub mod edit_report;
pub mod effort;
pub mod evaluator;
pub mod gain;
pub mod objective;
mod paired_runs;
pub mod retarget;
pub mod score;
pub mod scores;
pub mod settings;
pub mod tier_effects;
mod views;

pub use attribution::{Attribution, AttributionError, AttributionRequest};
pub use comparison::Comparison;
pub use effort::Effort;
pub use evaluator::{Evaluator, Values};
pub use gain::Gain;
pub use objective::{Aim, Objective, ObjectiveError, TiltedMetric};
pub use score::{score, score_all};
pub use scores::{ScoreError, Scores};
pub use settings::{ScoreInput, ScoreRequest, ScoreRow, StoneShape, Target, Tilt};
pub use tier_effects::{TierEffect, TierSlope};
