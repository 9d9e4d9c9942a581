//! The records of a GemCad binary file, each with its place.

use crate::design::Gear;
use crate::formats::error::{FormatError, counted};
use crate::formats::gem_write::{END_OF_FACETS, LINES, OFFSET_FOLLOWS};
use crate::formats::input::Input;
use crate::formats::windows_1252::decoded;
use crate::geometry::Plane;
use crate::limits;
use glam::DVec3;
use std::ops::Range;

/// What a nested design of the rough's shape begins with.
const PREFORM: &[u8] = b"\x07preform";

/// A facet as it is stored.
pub struct RawFacet {
    /// Where its plane stands.
    pub at: usize,
    /// The plane, in GemCad's frame.
    pub point: DVec3,
    /// The key of its tier.
    pub tier: i32,
    pub name: String,
    pub instructions: String,
    /// Where its corners stand, with the mark of their end.
    pub polygon_at: Range<usize>,
}

impl RawFacet {
    /// Its plane in our frame.
    pub fn plane(&self) -> Plane {
        let direction = self.point.normalize();
        let normal = DVec3::new(direction.x, -direction.y, direction.z);
        Plane { normal, distance: self.point.length().recip() }
    }
}

/// A whole file as it is stored; what its tail does not say is not there.
#[derive(Default)]
pub struct RawDesign {
    pub facets: Vec<RawFacet>,
    pub symmetry: Option<(i32, i32)>,
    teeth: Option<f64>,
    offset: f64,
    pub refractive_index: Option<f64>,
    /// Where that stands.
    pub refractive_index_at: Option<usize>,
    pub lines: Vec<String>,
    pub remarks: Vec<String>,
}

impl RawDesign {
    /// The index wheel, if it has teeth.
    pub fn gear(&self) -> Option<Gear> {
        let teeth = self.teeth.filter(|t| *t != 0.0)?;
        Some(Gear { teeth, offset: self.offset })
    }
}

/// The file and the place that is read next.
pub struct ByteReader<'s> {
    source: &'s Input<'s>,
    at: usize,
}

impl<'s> ByteReader<'s> {
    /// At the file's start.
    pub fn new(source: &'s Input<'s>) -> ByteReader<'s> {
        ByteReader { source, at: 0 }
    }

    fn rest(&self) -> &'s [u8] {
        self.source.bytes.get(self.at..).unwrap_or_default()
    }

    fn read_array<const N: usize>(&mut self, expected: &str) -> Result<[u8; N], FormatError> {
        let Some(bytes) = self.rest().first_chunk::<N>() else {
            return Err(self.source.at_byte(self.at, expected, "the end"));
        };
        self.at += N;
        Ok(*bytes)
    }

    fn float(&mut self, expected: &str) -> Result<f64, FormatError> {
        let at = self.at;
        let value = f64::from_le_bytes(self.read_array(expected)?);
        if value.is_finite() { Ok(value) } else { Err(self.source.at_byte(at, expected, "no number")) }
    }

    fn int(&mut self, expected: &str) -> Result<i32, FormatError> {
        Ok(i32::from_le_bytes(self.read_array(expected)?))
    }

    fn text(&mut self, expected: &str) -> Result<String, FormatError> {
        let at = self.at;
        let [len] = self.read_array(expected)?;
        let Some(bytes) = self.rest().get(..len as usize) else {
            return Err(self.source.at_byte(self.at, format!("{len} bytes of {expected}"), "the end"));
        };
        self.at += bytes.len();
        let text = decoded(bytes).replace('\0', "");
        match text.contains(|c: char| c.is_ascii_control() && !"\t\r\n".contains(c)) {
            true => Err(self.source.at_byte(at, format!("text as {expected}"), "other bytes")),
            false => Ok(text),
        }
    }

    /// The next facet, or none at their end.
    pub fn facet(&mut self) -> Result<Option<RawFacet>, FormatError> {
        /// Distances of facets, in any unit that a stone may be measured in.
        const DISTANCES: std::ops::Range<f64> = 1e-6..1e6;
        let at = self.at;
        let x = self.float("a facet's plane or the end of facets")?;
        if x == END_OF_FACETS {
            return Ok(None);
        }
        let point = DVec3::new(x, self.float("a facet's plane")?, self.float("a facet's plane")?);
        if !DISTANCES.contains(&point.length().recip()) {
            return Err(self.source.at_byte(at, "a facet's plane", "numbers that no stone has"));
        }
        let tier = self.int("a facet's tier")?;
        let said = self.text("a facet's name")?;
        let (name, instructions) = said.split_once('\t').unwrap_or((&said, ""));
        let (name, instructions) = (name.trim().to_owned(), instructions.trim().to_owned());
        let polygon = self.at;
        loop {
            let before = self.at;
            match self.int("a polygon's corner, or its end")? {
                0 => {
                    let polygon_at = polygon..self.at;
                    return Ok(Some(RawFacet { at, point, tier, name, instructions, polygon_at }));
                }
                1 => {
                    self.read_array::<24>("a polygon's corner")?;
                }
                other => return Err(self.source.at_byte(before, "0 or 1 in a polygon", other.to_string())),
            }
        }
    }

    /// Whether all that is left is what old systems fill a file up with, or a part of the mark of the end.
    fn is_at_end(&self) -> bool {
        let rest = self.rest();
        END_OF_FACETS.to_le_bytes()[..7].starts_with(rest) || rest.iter().all(|b| matches!(b, 0 | 0x1A))
    }

    pub fn design(&mut self) -> Result<RawDesign, FormatError> {
        let (mut raw, mut count) = (RawDesign::default(), 0);
        while !self.is_at_end() {
            let Some(facet) = self.facet()? else { break };
            count += 1;
            if self.source.limits.check(&limits::FACETS, count).is_ok() {
                raw.facets.push(facet);
            }
        }
        self.source.has_at_most(&limits::FACETS, count)?;
        if !raw.facets.is_empty() && self.tail(&mut raw).is_err() {
            raw.remarks.push("the file ends before its texts do: what is missing is left empty".into());
            return Ok(raw);
        }
        if self.rest().starts_with(PREFORM) {
            self.at += PREFORM.len();
            let preform = ByteReader { source: self.source, at: self.at }.design();
            let said = if preform.is_ok() { "a preform" } else { "what follows, maybe a preform," };
            raw.remarks.push(format!("{said} is left out"));
        } else if !self.rest().is_empty() {
            raw.remarks.push(format!("{} after the design passed over", counted(self.rest().len(), "byte")));
        }
        Ok(raw)
    }

    /// What follows the facets, as far as it goes.
    fn tail(&mut self, raw: &mut RawDesign) -> Result<(), FormatError> {
        raw.symmetry = Some((self.int("the symmetry's order")?, self.int("whether it is mirrored")?));
        raw.teeth = Some(self.int("the number of gear teeth")?.into());
        let at = self.at;
        raw.refractive_index = Some(f64::from_le_bytes(self.read_array("an index of refraction")?));
        raw.refractive_index_at = Some(at);
        let mark = u32::from_le_bytes(self.read_array("the mark of the gear's offset")?);
        // one writer leaves the offset out
        if mark == OFFSET_FOLLOWS {
            raw.offset = self.float("the gear's offset")?;
        }
        for _ in 0..2 * LINES {
            raw.lines.push(self.text("a header or footer")?);
        }
        Ok(())
    }
}
