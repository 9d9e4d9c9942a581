//! Stop criteria and energy budget of a beam trace.

/// Most facets over which a beam is followed. Only light that total reflection keeps (in a cube) comes so
/// far: light that is partly transmitted at every other facet holds 1e-80 of its power by then.
pub const MAX_FACETS: u32 = 256;

/// Stop criteria: when beams are left to the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopCriteria {
    /// A beam is not followed when its power is below this share of the light on the outline.
    pub power: f64,
    /// Tracing stops once the beams not yet traced hold less than this share of the incident power
    /// together. The strongest go first, so that this is reached with about the fewest.
    pub residual: f64,
    /// Most facets inside over which a beam is followed; [`MAX_FACETS`] bounds it.
    pub facets: u32,
    /// Most beams; none is followed further after that.
    pub beams: u64,
}

impl StopCriteria {
    /// Follows beams down to a power.
    pub fn at_power(power: f64) -> StopCriteria {
        StopCriteria { power, residual: 0.0, facets: MAX_FACETS, beams: u64::MAX }
    }

    /// Follows beams until this share of the light is left.
    pub fn at_residual(left: f64) -> StopCriteria {
        /// Beams below it add up to no share that matters; those above it fit into memory.
        const LEAST: f64 = 1e-9;
        StopCriteria { power: LEAST, residual: left, facets: MAX_FACETS, beams: u64::MAX }
    }
}

/// Energy budget: where the light has gone, as shares of the light on the outline.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyBudget {
    /// Area of the outline seen along the light, in the stone's (trace) unit squared.
    pub outline: f64,
    /// Reflected at entry.
    pub reflected: f64,
    /// Left the stone again.
    pub exited: f64,
    /// In beams that were not followed.
    pub not_followed: f64,
    /// Beams: one for each facet that faces the light, and one for each reflection followed.
    pub beams: u64,
}

impl EnergyBudget {
    /// All light accounted for: 1 to rounding, if the leading line goes alone. With several lines the rest
    /// has met other facets than the other lines.
    pub fn sum(&self) -> f64 {
        self.reflected + self.exited + self.not_followed
    }

    /// Whether light is missing: where corners that should be one lie apart by more than rounding, a beam
    /// along an edge may fall between two facets.
    pub fn is_short(&self) -> bool {
        /// A part in a million changes no score.
        const MISSING: f64 = 1e-6;
        (self.sum() - 1.0).abs() > MISSING
    }
}
