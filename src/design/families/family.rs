//! A parametric family: its parameters, their ranges, and why a cut cannot be made.

use super::super::tiers::{Design, FamilyValues};
use crate::parse::format_number;

/// One parameter of a family.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Its key, as in `round-brilliant:crown-angle=35` and `--crown-angle 35`.
    pub key: &'static str,
    /// Value when not given.
    pub default: f64,
    /// Least and greatest value allowed.
    pub range: (f64, f64),
    /// `%` of the girdle diameter, `°`, `mm` or empty.
    pub unit: &'static str,
    /// One line of help.
    pub about: &'static str,
}

/// A parametric family of cuts.
pub struct Family {
    /// Its name, as in `family = "round-brilliant"`.
    pub name: &'static str,
    /// One line of help.
    pub about: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// What a grading report states in place of some of them (see [`super::heights`]); without defaults.
    pub heights: &'static [Parameter],
    /// The parameter by which the number of facets is set, and its step.
    pub total: Option<(&'static str, usize)>,
    /// Builds the design from a full set of values, each already within its range.
    pub build: fn(&ParameterValues) -> Result<Design, CutError>,
}

impl Family {
    /// Everything that can be set, parameters first.
    pub fn keys(&self) -> impl Iterator<Item = &'static Parameter> {
        self.parameters.iter().chain(self.heights)
    }
}

/// A cut that cannot be made, and why.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CutError {
    /// A family that is not in the catalogue.
    #[error("no family is called '{name}': there is {}", .known.join(", "))]
    UnknownFamily {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// A parameter that the family does not have.
    #[error("{family} has no parameter '{key}': it has {}", .known.join(", "))]
    UnknownParameter {
        /// The family.
        family: &'static str,
        /// What was asked for.
        key: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// A cut of fixed tiers was given another parameter than length to width.
    #[error("{name} has fixed facets: it takes length-to-width alone, no parameter '{key}'")]
    NoParameters {
        /// The cut.
        name: String,
        /// What was asked for.
        key: String,
    },
    /// A value outside its range.
    #[error("{key} = {}{unit} is out of range: {from} to {to}{unit}", format_number(*.value))]
    OutOfRange {
        /// The parameter.
        key: &'static str,
        /// What was given.
        value: f64,
        /// The unit.
        unit: &'static str,
        /// Least value.
        from: f64,
        /// Greatest value.
        to: f64,
    },
    /// A total of facets that the cut cannot have.
    #[error("{name} cannot have {asked} facets: {nearest} is the nearest that can be made ({made_up})")]
    Total {
        /// The cut.
        name: String,
        /// What was asked for.
        asked: usize,
        /// The nearest total.
        nearest: usize,
        /// How that total is made up.
        made_up: String,
    },
    /// The planes bound no stone.
    #[error(transparent)]
    Solid(#[from] crate::geometry::SolidError),
    /// Values that no stone can have together.
    #[error("{problem}: {bound}")]
    Impossible {
        /// What would go wrong.
        problem: &'static str,
        /// The bound that was crossed, with the figures.
        bound: String,
    },
}

/// A full set of values for a family.
#[derive(Debug)]
pub struct ParameterValues {
    pub(super) family: &'static Family,
    pub(super) values: Vec<f64>,
}

impl ParameterValues {
    /// The value of a parameter of the family; a key that it does not have is a mistake in the
    /// family's own file and gives NaN, which no stone survives.
    pub fn get(&self, key: &str) -> f64 {
        self.family.parameters.iter().position(|p| p.key == key).map_or(f64::NAN, |i| self.values[i])
    }
}

impl Parameter {
    /// The value, if it lies within the range.
    pub(super) fn checked(&self, value: f64) -> Result<f64, CutError> {
        let (from, to) = self.range;
        match (from..=to).contains(&value) {
            true => Ok(value),
            false => Err(CutError::OutOfRange { key: self.key, value, unit: self.unit, from, to }),
        }
    }
}

impl FamilyValues {
    /// The value of a parameter: as given, else its default; none if the family has no such parameter.
    pub fn value(&self, key: &str) -> Option<f64> {
        let default = || super::family(&self.name).ok()?.keys().find(|p| p.key == key).map(|p| p.default);
        self.given.get(key).copied().or_else(default)
    }
}

impl std::fmt::Debug for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// Every plane must bound the stone: a facet that vanishes is a mistake of the parameters.
pub(super) fn check_every_facet_stands(design: &Design) -> Result<(), CutError> {
    let solid = design.solid()?;
    let lost = design
        .facets()
        .zip(&solid.plane_status)
        .find(|(_, status)| !matches!(status, crate::geometry::polyhedron::PlaneStatus::Facet(_)));
    match lost {
        None => Ok(()),
        Some((facet, _)) => Err(CutError::Impossible {
            problem: "a facet would vanish",
            bound: format!("the other facets leave nothing of {}", facet.name),
        }),
    }
}

/// Checks that `value` is a whole number.
pub(super) fn whole_number(key: &'static str, value: f64) -> Result<usize, CutError> {
    if value.fract() == 0.0 {
        Ok(value as usize)
    } else {
        Err(CutError::Impossible { problem: "a count must be whole", bound: format!("{key} = {value}") })
    }
}
