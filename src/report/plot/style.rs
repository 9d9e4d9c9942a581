//! How a plot is to look, beyond what it shows.

use colorous::{CIVIDIS, GREYS, Gradient, MAGMA, VIRIDIS};

/// Choices about a plot; by default it chooses itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Style {
    /// Its title, in place of the names of score and stone.
    pub title: Option<String>,
    /// Ends of axes, by column: of a parameter's axis, or of a score's axis or scale of colours.
    pub ranges: Vec<(String, (f64, f64))>,
    /// Colours of a map.
    pub colours: ColourScale,
}

impl Style {
    /// The ends asked for of the axis of a column.
    pub fn range(&self, column: &str) -> Option<(f64, f64)> {
        self.ranges.iter().find(|(key, _)| key == column).map(|(_, ends)| *ends)
    }
}

/// Colours of a map, from its least to its greatest value. All but the last grow evenly lighter to every
/// eye.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ColourScale {
    /// From violet over green to yellow.
    #[default]
    Viridis,
    /// From black over magenta to pale yellow.
    Magma,
    /// From blue to yellow: the same to the colour-blind.
    Cividis,
    /// From white to black.
    Greys,
}

impl ColourScale {
    /// All, with their names.
    pub const ALL: [(&'static str, ColourScale); 4] = [
        ("viridis", ColourScale::Viridis),
        ("magma", ColourScale::Magma),
        ("cividis", ColourScale::Cividis),
        ("greys", ColourScale::Greys),
    ];

    /// The colour so far along the scale, from 0 to 1, as CSS has it.
    pub fn colour(self, along: f64) -> String {
        let gradient: Gradient = match self {
            ColourScale::Viridis => VIRIDIS,
            ColourScale::Magma => MAGMA,
            ColourScale::Cividis => CIVIDIS,
            ColourScale::Greys => GREYS,
        };
        format!("#{:x}", gradient.eval_continuous(along.clamp(0.0, 1.0)))
    }
}
