//! Mesh import: a design from the polygons that a mesh format has read.

use super::error::{FormatError, counted};
use super::format::{Parsed, ParsedShape};
use super::input::Input;
use crate::design::{Design, LengthUnit};
use crate::geometry::facet_recovery::{Polygon, RecoverError, Stored, facets_of_polygons};
use crate::limits::Limits;
use glam::DVec3;

/// How a format holds its numbers, which says how far they may be off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Digits {
    /// Binary, of 24 bits.
    F32,
    /// Binary, of 53 bits.
    #[default]
    F64,
    /// Decimal, of so many significant digits at the most.
    Decimal(usize),
}

impl Digits {
    /// Decimal numbers before any is seen.
    pub const TEXT: Digits = Digits::Decimal(0);

    /// Takes account of one more number that is written in the file.
    pub fn see(&mut self, word: &str) {
        let mantissa = word.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).skip_while(|b| *b == b'0').count();
        if let Digits::Decimal(most) = self {
            *most = (*most).max(digits);
        }
    }

    /// Of two counts of digits the larger.
    pub fn or(self, other: Digits) -> Digits {
        match (self, other) {
            (Digits::Decimal(a), Digits::Decimal(b)) => Digits::Decimal(a.max(b)),
            _ => self,
        }
    }

    /// The most that numbers up to `largest` are off by; `in_f32` if all of them happen to be numbers of 24
    /// bits, which they then were before, whatever holds them now.
    fn rounding(self, largest: f64, in_f32: bool) -> f64 {
        /// So many decimal digits hold any number of 24 bits, and no program writes more of one.
        const OF_F32: usize = 9;
        let (f32, f64) = (largest * 2f64.powi(-24), largest * 2f64.powi(-53));
        match self {
            Digits::F64 if !in_f32 => f64,
            Digits::Decimal(n) if n > OF_F32 && !in_f32 => f64.max(decimal(largest, n)),
            Digits::Decimal(n) => f32.max(decimal(largest, n)),
            _ => f32,
        }
    }
}

/// Half a unit in the last of `n` significant digits of numbers up to `largest`. A few digits are no sign of
/// rounding: a cube's corners are whole numbers.
fn decimal(largest: f64, n: usize) -> f64 {
    const FEW: usize = 4;
    if n <= FEW || largest == 0.0 {
        return 0.0;
    }
    0.5 * 10f64.powi(largest.log10().floor() as i32 + 1 - n as i32)
}

/// A mesh as a reader found it.
#[derive(Debug, Default)]
pub struct PolygonMesh {
    /// Corners; one that no polygon names may be anything.
    pub vertices: Vec<DVec3>,
    /// Polygons.
    pub polygons: Vec<Polygon>,
    /// How the corners' coordinates are held.
    pub corners: Digits,
    /// How the stated normals are held.
    pub normals: Digits,
    /// What had to be overlooked, one line each.
    pub warnings: Vec<String>,
}

impl PolygonMesh {
    /// A mesh of text, in which no normals are stated.
    pub fn from_text(vertices: Vec<DVec3>, polygons: Vec<Polygon>, corners: Digits) -> PolygonMesh {
        PolygonMesh { vertices, polygons, corners, ..PolygonMesh::default() }
    }

    fn stored(&self) -> Stored {
        let coordinates = |points: &mut dyn Iterator<Item = DVec3>| {
            points
                .flat_map(|p| p.to_array())
                .filter(|x| x.is_finite())
                .fold((0.0f64, true), |(most, f32), x| (most.max(x.abs()), f32 && f64::from(x as f32) == x))
        };
        let used = self.polygons.iter().flat_map(|p| &p.corners).filter_map(|c| self.vertices.get(*c));
        let (largest, corners_in_f32) = coordinates(&mut used.copied());
        let (_, normals_in_f32) = coordinates(&mut self.polygons.iter().filter_map(|p| p.normal));
        Stored {
            corner: self.corners.rounding(largest, corners_in_f32),
            normal: self.normals.rounding(1.0, normals_in_f32),
        }
    }
}

/// A merge tolerance beyond this is worth telling: the mesh is coarser than `f32`.
const COARSE: f64 = 2e-6;

/// The design of a mesh's facets, or the mesh where it is closed but no convex stone. Facets keep their
/// names; the design gets the file's.
pub fn stone_from_mesh(source: &Input, mesh: &PolygonMesh) -> Result<Parsed, FormatError> {
    recover(&source.stem(), mesh, source.limits).map_err(|cause| source.no_stone(cause))
}

/// As [`stone_from_mesh`], for a reader that has several meshes to try.
pub fn recover(name: &str, mesh: &PolygonMesh, limits: Limits) -> Result<Parsed, RecoverError> {
    let mut found = facets_of_polygons(&mesh.vertices, &mesh.polygons, mesh.stored(), limits)?;
    let (tolerance, divided, nonconvex) = (found.tolerance, found.divided_edges, found.take_mesh());
    let mut warnings = mesh.warnings.clone();
    let facets = match (found.into_facets(), nonconvex) {
        (Ok(facets), _) => facets,
        (Err(reason), Some(mesh)) => {
            let shape = ParsedShape::Mesh { mesh: Box::new(mesh), unit: LengthUnit::Free, reason };
            return Ok(Parsed { shape, warnings });
        }
        (Err(reason), None) => return Err(reason),
    };
    let design = Design::from_facets(name, facets);
    if divided > 0 {
        let edges = counted(divided, "corner");
        warnings.push(format!("{edges} on edges of other faces: closed as a set of points"));
    }
    if tolerance > COARSE {
        warnings
            .push(format!("coarse mesh: faces were taken as coplanar within {tolerance:.0e} of its size"));
    }
    Ok(Parsed::new(design, warnings))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roundings_follow_from_what_is_written() {
        let of = |words: &[&str], largest: f64| {
            let mut digits = Digits::TEXT;
            words.iter().for_each(|w| digits.see(w));
            digits.rounding(largest, false)
        };
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a:e} {b:e}");
        // five decimals, fixed or with exponents
        near(of(&["-3.25000", "0.00001"], 3.25), 5e-6);
        near(of(&["-3.25000e0", "1.2e-5"], 3.25), 5e-6);
        near(of(&["103.25000"], 103.25), 0.5e-5f64.max(103.25 * 2f64.powi(-24)));
        // all digits of an f32 and of an f64
        near(of(&["0.123456789"], 1.0), 2f64.powi(-24));
        near(of(&["0.12345678901234567"], 1.0), 2f64.powi(-53).max(0.5e-16));
        // whole numbers
        near(of(&["100", "-1"], 100.0), 100.0 * 2f64.powi(-24));
        // f32 in a wider file
        near(Digits::F64.rounding(2.0, true), 2f64.powi(-23));
        near(Digits::F64.rounding(2.0, false), 2f64.powi(-52));
    }
}
