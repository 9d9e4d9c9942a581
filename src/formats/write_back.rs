//! Writing a changed design back into the file it was read from, with all else that the file holds.

use super::changed_design::{ChangedDesign, SAME, size};
use super::cutlab_toml::{self, rewrite::RULES_AGREE};
use super::error::FormatError;
use super::format::Format;
use super::input::Input;
use super::{Encoded, Loaded, encode, format_of, frames, read_content_bytes};
use crate::design::Design;
use crate::geometry::Plane;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What a design read from a file is to become.
#[derive(Debug, Clone)]
pub struct Change<'a> {
    /// The same facets in the same order, in the file's own unit and frame, with new planes. Stated angles and
    /// indices are written where they give these planes. Its index of refraction is the new one.
    pub design: &'a Design,
    /// New values of parameters, for a design file of a family: the design is then what they make, and may have
    /// other facets.
    pub parameters: BTreeMap<String, f64>,
}

/// Planes that are read back agree to this, in parts of the stone's size.
const READ_BACK: f64 = 10.0 * SAME;

impl<'a> Change<'a> {
    /// A change to that design.
    pub fn new(design: &'a Design) -> Change<'a> {
        Change { design, parameters: BTreeMap::new() }
    }

    /// The bytes of the file with the change in it. Without a change they are the file's own.
    ///
    /// Numbers that did not change stay the very text they were, and so does all that is not a number of a facet:
    /// texts, names, order, line ends, comments, what the reader passes over. What is written is read back, and
    /// must give the planes to 1e-12 of the stone's size (1e-9 where rules of a design file do). Formats without
    /// such a writer (meshes) are written anew, which is remarked. Checked in `tests/library/write_back.rs`.
    pub fn write_back(&self, file: &Input) -> Result<Encoded, FormatError> {
        let format = format_of(file)?;
        let before = read(file, file.bytes)?.design;
        let unfit =
            |problem: String| FormatError::Encode { name: file.name.into(), format: format.name, problem };
        let (were, are) = (before.facets().count(), self.design.facets().count());
        let is_cutlab = format.name == cutlab_toml::FORMAT.name;
        if !is_cutlab && !self.parameters.is_empty() {
            return Err(unfit("only a design file has parameters".into()));
        }
        if were != are && self.parameters.is_empty() {
            return Err(unfit(format!("the file has {were} facets, and the changed design {are}")));
        }
        if before.unit != self.design.unit {
            return Err(unfit("the changed design has another unit than the file".into()));
        }
        self.design.solid().map_err(|cause| FormatError::Solid { file: self.design.name.clone(), cause })?;
        let after = Cow::Borrowed(self.design);
        let changed = ChangedDesign { before: &before, after, parameters: &self.parameters };
        let mut remarks = Vec::new();
        if differ_in_texts(&before, self.design) {
            remarks.push("names, texts, gear and symmetry stay as the file has them".into());
        }
        if changed.is_unchanged() {
            return Ok(Encoded { bytes: file.bytes.to_vec(), remarks });
        }
        let bytes = match format.rewrite {
            Some(rewrite) => rewrite(file, &changed, &mut remarks)?,
            None => anew(format, self.design, &mut remarks)?,
        };
        if format.rewrite.is_some() {
            let again = read(file, &bytes)?.design;
            let moved = frames::about_origin(self.design)?;
            let near = if is_cutlab { RULES_AGREE } else { READ_BACK };
            if !has_planes(&again, self.design, near) && !has_planes(&again, &moved, near) {
                return Err(unfit("what was written does not give its planes again".into()));
            }
        }
        Ok(Encoded { bytes, remarks })
    }
}

fn read(file: &Input, bytes: &[u8]) -> Result<Loaded, FormatError> {
    read_content_bytes(file.name, bytes, file.folder, file.limits)?.into_design()
}

/// The design by its format's writer, in that writer's frame.
fn anew(format: &Format, design: &Design, remarks: &mut Vec<String>) -> Result<Vec<u8>, FormatError> {
    remarks.push(format!("{} files are written anew: only the facets are kept", format.name));
    encode(design, format.name)
}

/// Whether one has other words than the other, or another wheel.
fn differ_in_texts(a: &Design, b: &Design) -> bool {
    let facets = |d: &Design| d.facets().map(|f| f.name.clone()).collect::<Vec<_>>();
    (&a.headers, &a.footers, a.gear, a.symmetry) != (&b.headers, &b.footers, b.gear, b.symmetry)
        || facets(a) != facets(b)
}

/// Whether a design has these planes, each once, in any order: a tier that came apart may stand elsewhere.
///
/// - `near`: how far off they may be, in parts of the stone's size
fn has_planes(found: &Design, wanted: &Design, near: f64) -> bool {
    let mut left: Vec<Plane> = found.planes();
    let along = near * size(wanted);
    let is_same = |a: &Plane, b: &Plane| {
        a.normal.distance(b.normal) <= near && (a.distance - b.distance).abs() <= along
    };
    let all = wanted.planes();
    left.len() == all.len()
        && all.iter().enumerate().all(|(i, plane)| {
            // most often each stands where it did
            let in_place = left.get(i).is_some_and(|p| is_same(p, plane)).then_some(i);
            let at = in_place.or_else(|| left.iter().position(|p| is_same(p, plane)));
            // no plane serves twice
            at.and_then(|at| left.get_mut(at)).map(|taken| taken.distance = f64::NAN).is_some()
        })
}
