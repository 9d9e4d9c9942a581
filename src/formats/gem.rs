//! GemCad binary, `.gem`: facet planes, names and polygons, little-endian and without magic number.
//!
//! A plane is the point p with p·x = 1 on the facet, in GemCad's own frame, the y-mirror of ours.
//! The stored polygons are for drawing (their winding is mixed) and not used. As nothing marks such
//! a file, its facets tell it: normals and distances that a stone may have, and names that are text. What
//! follows the facets may be missing or break off at any place, as in old files, and anything may follow it.

use super::cutting_table::{angle_deg, index_of};
use super::error::{FormatError, counted};
use super::gem_write::{END_OF_FACETS, LINES, NAME, OFFSET_FOLLOWS, write};
use super::input::Input;
use super::windows_1252::decoded;
use super::{Format, Parsed, Writer};
use crate::design::{Design, Facet, Gear, Tier};
use crate::geometry::Plane;
use crate::limits;
use glam::DVec3;
use std::collections::HashMap;

/// GemCad binary designs.
pub static FORMAT: Format = Format {
    name: NAME,
    extensions: &["gem"],
    about: "GemCad binary design: tiers by angle, distance and index",
    sniff,
    read,
    write: Some(Writer::Design(write)),
};

/// What a nested design of the rough's shape begins with.
const PREFORM: &[u8] = b"\x07preform";

/// Facets whose angle (degrees) and distance (in parts of it) differ by less were cut as one tier.
const ONE_TIER: f64 = 1e-6;

fn sniff(source: &Input) -> u8 {
    match (ByteReader { source, at: 0 }).design() {
        Ok(raw) if !raw.facets.is_empty() => 96,
        // breaks off after good facets
        Err(_) if matches!((ByteReader { source, at: 0 }).facet(), Ok(Some(_))) => 40,
        // the extension is all there is to go by: worth a complaint that says where it breaks off
        _ => u8::from(source.extension() == "gem" && source.is_binary()),
    }
}

/// A facet as it is stored.
struct RawFacet {
    point: DVec3,
    tier: i32,
    name: String,
    instructions: String,
}

/// A whole file as it is stored; what its tail does not say is not there.
#[derive(Default)]
struct RawDesign {
    facets: Vec<RawFacet>,
    symmetry: Option<(i32, i32)>,
    teeth: Option<f64>,
    offset: f64,
    refractive_index: Option<f64>,
    lines: Vec<String>,
    remarks: Vec<String>,
}

/// The file and the place that is read next.
struct ByteReader<'s> {
    source: &'s Input<'s>,
    at: usize,
}

impl<'s> ByteReader<'s> {
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
    fn facet(&mut self) -> Result<Option<RawFacet>, FormatError> {
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
        loop {
            let at = self.at;
            match self.int("a polygon's corner, or its end")? {
                0 => return Ok(Some(RawFacet { point, tier, name, instructions })),
                1 => {
                    self.read_array::<24>("a polygon's corner")?;
                }
                other => return Err(self.source.at_byte(at, "0 or 1 in a polygon", other.to_string())),
            }
        }
    }

    /// Whether all that is left is what old systems fill a file up with, or a part of the mark of the end.
    fn is_at_end(&self) -> bool {
        let rest = self.rest();
        END_OF_FACETS.to_le_bytes()[..7].starts_with(rest) || rest.iter().all(|b| matches!(b, 0 | 0x1A))
    }

    fn design(&mut self) -> Result<RawDesign, FormatError> {
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
        raw.refractive_index = Some(f64::from_le_bytes(self.read_array("an index of refraction")?));
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

fn read(source: &Input) -> Result<Parsed, FormatError> {
    let mut raw = ByteReader { source, at: 0 }.design()?;
    if raw.facets.is_empty() {
        return Err(source.at_byte(0, "at least one facet", "the end of facets"));
    }
    let mut warnings = std::mem::take(&mut raw.remarks);
    let mut design = Design::new(source.stem());
    let lines = |range: std::ops::Range<usize>| {
        let lines = raw.lines.get(range.start.min(raw.lines.len())..range.end.min(raw.lines.len()));
        let lines = lines.unwrap_or_default();
        let last = lines.iter().rposition(|l| !l.trim().is_empty()).map_or(0, |i| i + 1);
        lines[..last].iter().map(|l| l.trim().to_owned()).collect::<Vec<_>>()
    };
    design.headers = lines(0..LINES);
    design.footers = lines(LINES..2 * LINES);
    if let Some(title) = design.headers.iter().find(|h| !h.is_empty()) {
        design.name = title.clone();
    }
    match raw.teeth {
        Some(teeth) if teeth != 0.0 => design.gear = Gear { teeth, offset: raw.offset },
        _ => warnings.push("no gear is given: 96 teeth assumed".into()),
    }
    let symmetry = raw.symmetry.and_then(|(order, mirror)| Some((u32::try_from(order).ok()?, mirror != 0)));
    design.symmetry = symmetry;
    if let Some(index) = raw.refractive_index.filter(|n| !(*n > 1.0 && *n <= 3.5)) {
        let done = if index >= 1.0 && index.is_finite() { "kept" } else { "left out" };
        warnings.push(format!("index of refraction {index:.4e} is not that of any gem; {done}"));
    }
    design.refractive_index = raw.refractive_index.filter(|n| *n >= 1.0 && n.is_finite());
    design.tiers = tiers(raw.facets, design.gear);
    Ok(Parsed::new(design, warnings))
}

/// Facets grouped by the file's key, and by angle and distance where one key is used for all.
fn tiers(facets: Vec<RawFacet>, gear: Gear) -> Vec<Tier> {
    let mut tiers: Vec<Tier> = Vec::new();
    let mut with_key: HashMap<i32, Vec<usize>> = HashMap::new();
    for facet in facets {
        let direction = facet.point.normalize();
        let normal = DVec3::new(direction.x, -direction.y, direction.z);
        let (angle, distance) = (angle_deg(normal), facet.point.length().recip());
        let same = |t: &&usize| {
            let tier = &tiers[**t];
            let other = tier.facets.first().map_or(f64::INFINITY, |f| f.plane.distance);
            tier.angle_deg.is_some_and(|a| (a - angle).abs() < ONE_TIER)
                && (other - distance).abs() < ONE_TIER * distance
        };
        let candidates = with_key.entry(facet.tier).or_default();
        let number = candidates.iter().rev().find(same).copied().unwrap_or_else(|| {
            candidates.push(tiers.len());
            let (name, instructions, facets) = Default::default();
            tiers.push(Tier { name, angle_deg: Some(angle), instructions, facets });
            tiers.len() - 1
        });
        let tier = &mut tiers[number];
        for (kept, new) in [(&mut tier.name, &facet.name), (&mut tier.instructions, &facet.instructions)] {
            if kept.is_empty() {
                kept.clone_from(new);
            }
        }
        let index = Some(index_of(gear, normal));
        tier.facets.push(Facet { name: facet.name, index, plane: Plane { normal, distance } });
    }
    tiers
}
