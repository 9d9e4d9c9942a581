//! GemCad binary, `.gem`: facet planes, names and polygons, little-endian and without magic number.
//!
//! A plane is the point p with p·x = 1 on the facet, in GemCad's own frame, the y-mirror of ours.
//! The stored polygons are for drawing (their winding is mixed) and not used. As nothing marks such
//! a file, only one that parses to its exact end is one.

use super::cutting_table::{angle_deg, index_of};
use super::error::FormatError;
use super::gem_write::write;
use super::source::Source;
use super::windows_1252::decoded;
use super::{Format, Reading, Writer};
use crate::cut::{Design, Facet, Gear, Tier};
use crate::solid::Plane;
use crate::store::limits;
use glam::DVec3;
use std::collections::HashMap;

/// GemCad binary designs.
pub static FORMAT: Format = Format {
    name: "gemcad-binary",
    extensions: &["gem"],
    about: "GemCad binary design: tiers by angle, distance and index",
    sniff,
    read,
    write: Some(Writer::Design(write)),
};

/// Stands where the next facet's plane would.
pub const END_OF_FACETS: f64 = -99999.0;
/// Says that the gear's offset follows the refractive index.
pub const OFFSET_FOLLOWS: u32 = 0x7FFF;
/// Header lines, and as many footers.
pub const LINES: usize = 4;
/// What a nested design of the rough's shape begins with.
const PREFORM: &[u8] = b"\x07preform";

/// Facets whose angle (degrees) and distance (in parts of it) differ by less were cut as one tier.
const ONE_TIER: f64 = 1e-6;

fn sniff(source: &Source) -> u8 {
    let mut bytes = Bytes { source, at: 0 };
    let first = bytes.facet();
    let plausible = |f: &RawFacet| {
        let p = f.point.length();
        (1e-6..1e6).contains(&p) && (0..100_000).contains(&f.tier)
    };
    match first {
        Ok(Some(facet)) if plausible(&facet) => {}
        // the ending is all there is to go by: worth a complaint that says where it breaks off
        _ => return u8::from(source.extension() == "gem" && !source.bytes.is_empty()),
    }
    if parsed(source).is_ok() { 96 } else { 40 }
}

/// A facet as it is stored.
struct RawFacet {
    point: DVec3,
    tier: i32,
    name: String,
    instructions: String,
}

/// A whole file as it is stored.
struct Raw {
    facets: Vec<RawFacet>,
    symmetry: (i32, i32),
    gear: Gear,
    refractive_index: f64,
    lines: Vec<String>,
    has_preform: bool,
}

fn parsed(source: &Source) -> Result<Raw, FormatError> {
    let mut bytes = Bytes { source, at: 0 };
    let mut raw = bytes.design()?;
    while bytes.rest() != b"" {
        if !bytes.rest().starts_with(PREFORM) {
            let found = format!("{} more bytes", bytes.rest().len());
            return Err(source.at_byte(bytes.at, "the end, or a preform", found));
        }
        bytes.at += PREFORM.len();
        bytes.design()?;
        raw.has_preform = true;
    }
    Ok(raw)
}

/// The file and the place that is read next.
struct Bytes<'s> {
    source: &'s Source<'s>,
    at: usize,
}

impl<'s> Bytes<'s> {
    fn rest(&self) -> &'s [u8] {
        self.source.bytes.get(self.at..).unwrap_or_default()
    }

    fn take<const N: usize>(&mut self, expected: &str) -> Result<[u8; N], FormatError> {
        let Some(bytes) = self.rest().first_chunk::<N>() else {
            return Err(self.source.at_byte(self.at, expected, "the end"));
        };
        self.at += N;
        Ok(*bytes)
    }

    fn float(&mut self, expected: &str) -> Result<f64, FormatError> {
        let at = self.at;
        let value = f64::from_le_bytes(self.take(expected)?);
        if value.is_finite() { Ok(value) } else { Err(self.source.at_byte(at, expected, value.to_string())) }
    }

    fn int(&mut self, expected: &str) -> Result<i32, FormatError> {
        Ok(i32::from_le_bytes(self.take(expected)?))
    }

    fn text(&mut self, expected: &str) -> Result<String, FormatError> {
        let [len] = self.take(expected)?;
        let Some(bytes) = self.rest().get(..len as usize) else {
            return Err(self.source.at_byte(self.at, format!("{len} bytes of {expected}"), "the end"));
        };
        self.at += bytes.len();
        Ok(decoded(bytes).replace('\0', ""))
    }

    /// The next facet, or none at their end.
    fn facet(&mut self) -> Result<Option<RawFacet>, FormatError> {
        let at = self.at;
        let x = self.float("a facet's plane or the end of facets")?;
        if x == END_OF_FACETS {
            return Ok(None);
        }
        let point = DVec3::new(x, self.float("a facet's plane")?, self.float("a facet's plane")?);
        if !(point.length().is_normal() && point.length().recip().is_finite()) {
            return Err(self.source.at_byte(at, "a facet's plane", point.to_string()));
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
                    self.take::<24>("a polygon's corner")?;
                }
                other => return Err(self.source.at_byte(at, "0 or 1 in a polygon", other.to_string())),
            }
        }
    }

    fn design(&mut self) -> Result<Raw, FormatError> {
        let mut facets = Vec::new();
        while let Some(facet) = self.facet()? {
            facets.push(facet);
            self.source.within(&limits::FACETS, facets.len())?;
        }
        let symmetry = (self.int("the symmetry's order")?, self.int("whether it is mirrored")?);
        let at = self.at;
        let teeth = f64::from(self.int("the number of gear teeth")?);
        if teeth == 0.0 {
            return Err(self.source.at_byte(at, "the number of gear teeth, not 0", "0"));
        }
        let refractive_index = self.float("an index of refraction")?;
        let mark = u32::from_le_bytes(self.take("the mark of the gear's offset")?);
        // one writer leaves the offset out
        let offset = if mark == OFFSET_FOLLOWS { self.float("the gear's offset")? } else { 0.0 };
        let gear = Gear { teeth, offset };
        let lines = (0..2 * LINES).map(|_| self.text("a header or footer")).collect::<Result<_, _>>()?;
        Ok(Raw { facets, symmetry, gear, refractive_index, lines, has_preform: false })
    }
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let raw = parsed(source)?;
    if raw.facets.is_empty() {
        return Err(source.at_byte(0, "at least one facet", "the end of facets"));
    }
    let mut warnings = Vec::new();
    if raw.has_preform {
        warnings.push("a preform is left out".into());
    }
    let mut design = Design::named(source.stem());
    let lines = |range: std::ops::Range<usize>| {
        let lines = &raw.lines[range];
        let last = lines.iter().rposition(|l| !l.trim().is_empty()).map_or(0, |i| i + 1);
        lines[..last].iter().map(|l| l.trim().to_owned()).collect::<Vec<_>>()
    };
    design.headers = lines(0..LINES);
    design.footers = lines(LINES..2 * LINES);
    if let Some(title) = design.headers.iter().find(|h| !h.is_empty()) {
        design.name = title.clone();
    }
    design.gear = raw.gear;
    design.symmetry = u32::try_from(raw.symmetry.0).ok().map(|order| (order, raw.symmetry.1 != 0));
    let index = raw.refractive_index;
    if !(index > 1.0 && index <= 3.5) {
        let done = if index < 1.0 { "left out" } else { "kept" };
        warnings.push(format!("index of refraction {index} is that of no gem; {done}"));
    }
    design.refractive_index = Some(index).filter(|n| *n >= 1.0);
    design.tiers = tiers(raw);
    Ok(Reading { design, warnings })
}

/// Facets grouped by the file's key, and by angle and distance where one key is used for all.
fn tiers(raw: Raw) -> Vec<Tier> {
    let mut tiers: Vec<Tier> = Vec::new();
    let mut with_key: HashMap<i32, Vec<usize>> = HashMap::new();
    for facet in raw.facets {
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
        let index = Some(index_of(raw.gear, normal));
        tier.facets.push(Facet { name: facet.name, index, plane: Plane { normal, distance } });
    }
    tiers
}
