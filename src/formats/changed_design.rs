//! A design before and after a change, facet by facet: what a format asks that writes it back into its file.

use super::error::FormatError;
use super::frames;
use crate::design::{Design, Facet, Gear, Tier};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Normals that differ by less, and distances that differ by less in parts of the stone's size, are the same.
pub const SAME: f64 = 1e-13;

/// As [`SAME`], of facets that stand in one tier of a file.
const ONE_ROW: f64 = 5e-13;

/// A design as its file has it, and as it is to be: the same facets in the same order.
#[derive(Debug, Clone)]
pub struct ChangedDesign<'a> {
    /// As the file has it.
    pub before: &'a Design,
    /// As it is to be.
    pub after: Cow<'a, Design>,
    /// New values of a family's parameters.
    pub parameters: &'a BTreeMap<String, f64>,
}

/// A facet before and after.
#[derive(Debug, Clone, Copy)]
pub struct ChangedFacet<'a> {
    /// As the file has it.
    pub before: &'a Facet,
    /// As it is to be.
    pub after: &'a Facet,
    /// The angle in degrees that its tier had, if it had one.
    pub angle_before: Option<f64>,
    /// The angle in degrees that its tier is to have, as stated.
    pub angle_stated: Option<f64>,
    /// The largest distance of a facet from the origin before.
    size: f64,
}

impl ChangedFacet<'_> {
    /// Whether it faces elsewhere.
    pub fn is_turned(&self) -> bool {
        self.before.plane.normal.distance(self.after.plane.normal) > SAME
    }

    /// Whether its distance from the origin changed.
    pub fn is_moved(&self) -> bool {
        (self.before.plane.distance - self.after.plane.distance).abs() > SAME * self.size
    }

    /// Whether its plane is another.
    pub fn is_changed(&self) -> bool {
        self.is_turned() || self.is_moved()
    }

    /// Whether two distances may stand in one tier.
    pub fn is_one_distance(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= ONE_ROW * self.size
    }
}

/// Whether two angles in degrees may stand in one tier; the sign of 0 tells table from culet.
pub fn is_one_angle(a: f64, b: f64) -> bool {
    (a - b).abs() <= ONE_ROW.to_degrees() && a.is_sign_negative() == b.is_sign_negative()
}

impl<'a> ChangedDesign<'a> {
    /// All facets, in the order of [`Design::facets`].
    pub fn facets(&self) -> Vec<ChangedFacet<'_>> {
        let size = size(self.before);
        let with_angle = |t: &'_ Tier| t.facets.iter().map(|_| t.angle_deg).collect::<Vec<_>>();
        let before = self.before.tiers.iter().flat_map(with_angle).zip(self.before.facets());
        let after = self.after.tiers.iter().flat_map(with_angle).zip(self.after.facets());
        let both = before.zip(after).map(|((angle_before, before), (angle_stated, after))| ChangedFacet {
            before,
            after,
            angle_before,
            angle_stated,
            size,
        });
        both.collect()
    }

    /// The gear of the file.
    pub fn gear(&self) -> Gear {
        self.before.gear
    }

    /// The index of refraction, if it is another.
    pub fn refractive_index(&self) -> Option<f64> {
        self.after.refractive_index.filter(|n| self.before.refractive_index != Some(*n))
    }

    /// Whether the file stays as it is.
    pub fn is_unchanged(&self) -> bool {
        let is_other = |f: &ChangedFacet| f.is_changed();
        !self.facets().iter().any(is_other) && self.refractive_index().is_none() && self.parameters.is_empty()
    }

    /// The same with the origin inside the stone, for formats that have no room for planes through the origin
    /// or beyond: moved only where it must be, which is remarked.
    pub fn with_origin_inside(&self, remarks: &mut Vec<String>) -> Result<ChangedDesign<'a>, FormatError> {
        let after = match frames::about_origin(&self.after)? {
            Cow::Borrowed(_) => self.after.clone(),
            Cow::Owned(moved) => {
                remarks.push("the origin came to lie outside the stone: moved to its middle".into());
                Cow::Owned(moved)
            }
        };
        Ok(ChangedDesign { before: self.before, after, parameters: self.parameters })
    }
}

/// The largest distance of a facet from the origin.
pub fn size(design: &Design) -> f64 {
    design.facets().fold(0.0, |size: f64, f| size.max(f.plane.distance.abs()))
}
