//! Scores of one stone, as accurate as asked for, and of stones against each other.

mod adaptive;
pub mod comparison;
pub mod score;
pub mod settings;
