//! Scores of one stone, as accurate as asked for, and of stones against each other.

mod adaptive;
pub mod comparison;
pub mod edit_report;
pub mod score;
pub mod scores;
pub mod settings;

pub use comparison::Comparison;
pub use score::{score, score_all};
pub use scores::{ScoreError, Scores};
pub use settings::{ScoreInput, ScoreRequest, ScoreRow, StoneShape, Target, Tilt};
