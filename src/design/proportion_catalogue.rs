//! Proportions by name: the numbers of [`Proportions`] that tables list and that bounds are set on.

use super::proportions::Proportions;
use crate::parse;

/// A proportion.
#[derive(Debug, Clone, Copy)]
pub struct NamedProportion {
    /// Its name on the command line and in tables; it ends in its unit, if it has one.
    pub name: &'static str,
    /// The name where the unit stands beside it.
    pub short: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// What it is.
    pub about: &'static str,
    /// What a difference of it is measured against: 1 for ratios, 100 for percentages, 90 for degrees.
    pub scale: f64,
    /// Its value; none of a stone that has no such measure.
    pub of: fn(&Proportions) -> Option<f64>,
}

/// Every proportion, in the order of a table's columns.
pub static PROPORTIONS: [NamedProportion; 10] = [
    NamedProportion {
        name: "length_to_width",
        short: "length_to_width",
        unit: "",
        about: "extent of the outline across the girdle width, per girdle width",
        scale: 1.0,
        of: |p| Some(p.length / p.width),
    },
    NamedProportion {
        name: "table_percent",
        short: "table",
        unit: "%",
        about: "table per girdle width",
        scale: 100.0,
        of: |p| p.table_percent,
    },
    NamedProportion {
        name: "crown_angle_deg",
        short: "crown_angle",
        unit: "°",
        about: "angle of the crown's main facet across the width",
        scale: 90.0,
        of: |p| p.crown_angle_deg,
    },
    NamedProportion {
        name: "crown_height_percent",
        short: "crown_height",
        unit: "%",
        about: "from the girdle's upper edge to the table, per girdle width",
        scale: 100.0,
        of: |p| Some(p.crown_height_percent),
    },
    NamedProportion {
        name: "pavilion_angle_deg",
        short: "pavilion_angle",
        unit: "°",
        about: "angle of the pavilion's main facet across the width",
        scale: 90.0,
        of: |p| p.pavilion_angle_deg,
    },
    NamedProportion {
        name: "pavilion_depth_percent",
        short: "pavilion_depth",
        unit: "%",
        about: "from the girdle's lower edge to the lowest point, per girdle width",
        scale: 100.0,
        of: |p| Some(p.pavilion_depth_percent),
    },
    NamedProportion {
        name: "girdle_percent",
        short: "girdle",
        unit: "%",
        about: "girdle at its thick places, per girdle width",
        scale: 100.0,
        of: |p| Some(p.girdle_percent),
    },
    NamedProportion {
        name: "depth_percent",
        short: "depth",
        unit: "%",
        about: "from the table to the lowest point, per girdle width",
        scale: 100.0,
        of: |p| Some(p.depth_percent),
    },
    NamedProportion {
        name: "culet_percent",
        short: "culet",
        unit: "%",
        about: "culet per girdle width; 0 without one",
        scale: 100.0,
        of: |p| Some(p.culet_percent),
    },
    NamedProportion {
        name: "vol_w3",
        short: "vol_w3",
        unit: "",
        about: "Vol/W³, volume per cube of the width that faceters use, corner to corner",
        scale: 1.0,
        of: |p| Some(p.ratios.vol_w3),
    },
];

impl NamedProportion {
    /// The proportion called `name`, or none.
    pub fn by_name(name: &str) -> Option<&'static NamedProportion> {
        PROPORTIONS.iter().find(|p| parse::is_name(p.name, name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{library, proportions};
    use std::collections::BTreeMap;

    #[test]
    fn every_proportion_of_a_brilliant_has_a_value_under_a_name_of_its_own() {
        let tolkowsky = library::design("tolkowsky", &BTreeMap::new()).expect("a cut").expect("solved");
        let measured = proportions::of_design(&tolkowsky).expect("closed");
        for (i, proportion) in PROPORTIONS.iter().enumerate() {
            let value = (proportion.of)(&measured).unwrap_or_else(|| panic!("{}", proportion.name));
            assert!(value >= 0.0 && value <= proportion.scale * 1.1, "{}: {value}", proportion.name);
            assert_eq!(NamedProportion::by_name(proportion.name).map(|p| p.name), Some(proportion.name));
            assert!(PROPORTIONS[..i].iter().all(|other| other.name != proportion.name));
            let unit = match proportion.unit {
                "%" => "_percent",
                "°" => "_deg",
                unit => unit,
            };
            assert_eq!(proportion.name, format!("{}{unit}", proportion.short));
        }
    }
}
