//! GemCad ASCII, `.asc`: tiers of angle, distance and gear indices.
//!
//! The program's own frame is the y-mirror of ours; with the formula of [`facet_normal`] the stone
//! comes out the right way round. Distances have no unit and the origin is free.

use super::error::{FormatError, shown};
use super::gemcad_text_write::write;
use super::source::{Source, lines, number};
use super::{Format, Reading, Writer};
use crate::cut::design::facet_normal;
use crate::cut::{Design, Facet, Gear, Tier};
use crate::solid::{Plane, SolidError};
use crate::store::limits;

/// GemCad text designs, of every version in circulation.
pub static FORMAT: Format = Format {
    name: "gemcad",
    extensions: &["asc"],
    about: "GemCad text design: tiers by angle, distance and index",
    sniff,
    read,
    write: Some(Writer::Design(write)),
};

fn sniff(source: &Source) -> u8 {
    let start = source.beginning();
    let start = start.trim_start();
    if start.get(..6).is_some_and(|s| s.eq_ignore_ascii_case("gemcad")) {
        return 100;
    }
    let tier = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("a")
            && words.next().and_then(number).is_some()
            && words.next().and_then(number).is_some()
    };
    if lines(start).any(|(_, line)| tier(line)) { 60 } else { 0 }
}

/// A file of other text has remarks on every line: nobody reads more of them.
const MOST_REMARKS: usize = 50;

/// What lines begin with.
const KEYWORDS: [&str; 6] = ["a", "g", "y", "I", "H", "F"];

/// Whether an indented line goes on with the open tier: it begins with an index, or with what
/// would have to be one, a name or instructions.
fn is_of_a_tier(content: &str) -> bool {
    let first = content.split_whitespace().next().unwrap_or_default();
    let starts_as_number = first.starts_with(|c: char| c.is_ascii_digit() || "+-.\u{2212}".contains(c));
    starts_as_number || first == "n" || first == "G"
}

/// A tier as the file gives it, before it is known which way its flat facets look.
struct Entry {
    line: usize,
    angle_deg: f64,
    rho: f64,
    indices: Vec<(f64, String)>,
    name: String,
    instructions: String,
}

#[derive(Default)]
struct File {
    gear: Option<Gear>,
    symmetry: Option<(u32, bool)>,
    refractive_index: Option<f64>,
    headers: Vec<String>,
    footers: Vec<String>,
    tiers: Vec<Entry>,
    facet_count: usize,
    expecting_name: bool,
    /// The letter that the last line with a keyword began with.
    last: Option<char>,
    warnings: Vec<String>,
}

fn read(source: &Source) -> Result<Reading, FormatError> {
    let text = source.text();
    let mut file = File::default();
    let mut last = 1;
    for (number, line) in lines(&text) {
        last = number;
        file.line(source, number, line)?;
    }
    if file.expecting_name {
        return Err(source.at_line(last, "a facet name after 'n'", ""));
    }
    if file.tiers.is_empty() {
        return Err(source.at_line(last, "tiers (lines 'a ANGLE DISTANCE INDEX …')", ""));
    }
    file.design(source)
}

impl File {
    fn line(&mut self, source: &Source, at: usize, line: &str) -> Result<(), FormatError> {
        let content = line.trim();
        if content.is_empty() {
            return Ok(());
        }
        let indented = line.starts_with([' ', '\t']);
        if let (true, Some(text)) = (indented, self.open_text(content)) {
            text.push(' ');
            text.push_str(content);
            return Ok(());
        }
        let continues = indented && !self.tiers.is_empty() && (self.expecting_name || is_of_a_tier(content));
        if self.expecting_name && !continues {
            return Err(source.at_line(at, "a facet name after 'n'", content));
        }
        if continues {
            return self.facets(source, at, content);
        }
        let (keyword, rest) = content.split_once(char::is_whitespace).unwrap_or((content, ""));
        let rest = rest.trim();
        match keyword {
            "a" => self.tier(source, at, rest)?,
            "H" => self.headers.push(rest.into()),
            "F" => self.footers.push(rest.into()),
            "I" => self.index(at, rest),
            "y" => self.symmetry(at, rest),
            "g" => self.gear(source, at, rest)?,
            _ if content.starts_with([';', '#']) || self.is_title(keyword) => {}
            // `g96 0.0`, and `96 0.0` as some writer leaves the letter out
            _ if self.gear.is_none() && number(keyword.trim_start_matches('g')).is_some() => {
                self.gear(source, at, content.trim_start_matches('g'))?;
            }
            _ => self.remark(|| format!("line {at}: not understood and left out: {}", shown(content))),
        }
        self.last = keyword.chars().next().filter(|_| keyword.len() == 1);
        Ok(())
    }

    /// Keeps a remark on a line, if it is one of the first.
    fn remark(&mut self, remark: impl FnOnce() -> String) {
        match self.warnings.len() {
            0..MOST_REMARKS => self.warnings.push(remark()),
            MOST_REMARKS => self.warnings.push("more lines like these are not told of".into()),
            _ => {}
        }
    }

    /// The header or footer that an indented line goes on with: any text but another keyword.
    fn open_text(&mut self, content: &str) -> Option<&mut String> {
        let keyword = content.split_whitespace().next().is_some_and(|w| KEYWORDS.contains(&w));
        match self.last.filter(|_| !keyword) {
            Some('H') => self.headers.last_mut(),
            Some('F') => self.footers.last_mut(),
            _ => None,
        }
    }

    /// `GemCad 5.0` on the first line.
    fn is_title(&self, keyword: &str) -> bool {
        self.gear.is_none() && keyword.get(..6).is_some_and(|k| k.eq_ignore_ascii_case("gemcad"))
    }

    fn gear(&mut self, source: &Source, at: usize, rest: &str) -> Result<(), FormatError> {
        let mut words = rest.split_whitespace();
        let first = words.next().unwrap_or_default();
        let teeth = number(first)
            .filter(|t| *t != 0.0)
            .ok_or_else(|| source.at_line(at, "the number of gear teeth, not 0", first))?;
        let offset = match words.next() {
            Some(w) => number(w).ok_or_else(|| source.at_line(at, "the gear's offset in teeth", w))?,
            None => 0.0,
        };
        self.gear = Some(Gear { teeth, offset });
        Ok(())
    }

    /// For information: no facet depends on it.
    fn symmetry(&mut self, at: usize, rest: &str) {
        let mut words = rest.split_whitespace();
        let first = words.next().unwrap_or_default();
        match number(first).filter(|n| n.fract() == 0.0 && (0.0..=1e4).contains(&n.abs())) {
            Some(order) => {
                let mirror = words.next().is_some_and(|w| w.eq_ignore_ascii_case("y"));
                self.symmetry = Some((order.abs() as u32, mirror));
            }
            None => self.remark(|| format!("line {at}: no order of symmetry, left out: {}", shown(first))),
        }
    }

    /// For information: no facet depends on it.
    fn index(&mut self, at: usize, rest: &str) {
        let first = rest.split_whitespace().next().unwrap_or_default();
        let Some(index) = number(first) else {
            self.remark(|| format!("line {at}: no index of refraction, left out: {}", shown(first)));
            return;
        };
        if !(index > 1.0 && index <= 3.5) {
            let done = if index < 1.0 { "left out" } else { "kept" };
            self.remark(|| format!("line {at}: index of refraction {index} is that of no gem; {done}"));
        }
        self.refractive_index = Some(index).filter(|n| *n >= 1.0);
    }

    fn tier(&mut self, source: &Source, at: usize, rest: &str) -> Result<(), FormatError> {
        let (first, rest) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
        let angle_deg = number(first)
            .filter(|a| a.abs() <= 90.0)
            .ok_or_else(|| source.at_line(at, "an angle from -90 to 90 degrees", first))?;
        let rest = rest.trim_start();
        let (second, rest) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
        let rho = number(second).ok_or_else(|| source.at_line(at, "the distance of the facets", second))?;
        let (indices, name, instructions) = Default::default();
        self.tiers.push(Entry { line: at, angle_deg, rho, indices, name, instructions });
        self.facets(source, at, rest)
    }

    /// Indices, names and instructions, on the tier's own line or one that continues it.
    fn facets(&mut self, source: &Source, at: usize, content: &str) -> Result<(), FormatError> {
        let Some(tier) = self.tiers.last_mut() else { return Ok(()) };
        let mut rest = content.trim_start();
        while !rest.is_empty() {
            let (word, after) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
            if std::mem::take(&mut self.expecting_name) {
                // any word at all: facets are called G, n, a or 12
                if let Some((_, name)) = tier.indices.last_mut() {
                    *name = word.into();
                }
                if tier.name.is_empty() {
                    tier.name = word.into();
                }
            } else if word == "n" {
                self.expecting_name = true;
            } else if word == "G" {
                if !tier.instructions.is_empty() {
                    tier.instructions.push(' ');
                }
                tier.instructions += after.trim();
                return Ok(());
            } else {
                let index =
                    number(word).ok_or_else(|| source.at_line(at, "an index, 'n NAME' or 'G'", word))?;
                tier.indices.push((index, String::new()));
                self.facet_count += 1;
                source.within_at(at, &limits::FACETS, self.facet_count)?;
            }
            rest = after.trim_start();
        }
        Ok(())
    }

    fn design(mut self, source: &Source) -> Result<Reading, FormatError> {
        // a table lies at any index
        for flat in self.tiers.iter_mut().filter(|t| t.angle_deg == 0.0 && t.indices.is_empty()) {
            flat.indices.push((self.gear.map_or(0.0, |g| g.teeth.abs()), flat.name.clone()));
        }
        if let Some(tier) = self.tiers.iter().find(|t| t.indices.is_empty()) {
            return Err(source.at_line(tier.line, "at least one index in the tier", ""));
        }
        let gear = self.gear.unwrap_or_else(|| {
            self.warnings.push("no gear is given: 96 teeth assumed".into());
            Gear::default()
        });
        let mut design = Design::named(source.stem());
        if let Some(title) = self.headers.iter().find(|h| !h.is_empty()) {
            design.name = title.clone();
        }
        design.gear = gear;
        design.symmetry = self.symmetry;
        design.refractive_index = self.refractive_index;
        design.tiers = self.tiers.iter().map(|t| t.tier(gear, t.looks_down(false))).collect();
        let by_token = self.tiers.iter().any(|t| t.looks_down(true) != t.looks_down(false));
        if by_token && matches!(design.solid(), Err(SolidError::Open { .. })) {
            let tiers = self.tiers.iter().map(|t| t.tier(gear, t.looks_down(true))).collect();
            let other = Design { tiers, ..design.clone() };
            if other.solid().is_ok() {
                self.warnings
                    .push("a facet at angle -0.00 is taken as culet: the stone is open without".into());
                design = other;
            }
        }
        for (kept, lines) in [(&mut design.headers, self.headers), (&mut design.footers, self.footers)] {
            *kept = lines;
            // blank lines after the last say nothing, and the binary form cannot tell them from none
            kept.truncate(kept.iter().rposition(|l| !l.is_empty()).map_or(0, |last| last + 1));
        }
        Ok(Reading { design, warnings: self.warnings })
    }
}

impl Entry {
    /// Whether the tier's facets are on the pavilion's side. For flat facets the sign of the
    /// distance tells, or, if that leaves the stone open, the sign of the angle's zero.
    fn looks_down(&self, by_token: bool) -> bool {
        if self.angle_deg == 0.0 && !by_token && self.rho != 0.0 {
            self.rho < 0.0
        } else {
            self.angle_deg.is_sign_negative() || (self.angle_deg == 0.0 && self.rho < 0.0)
        }
    }

    fn tier(&self, gear: Gear, down: bool) -> Tier {
        let angle = self.angle_deg.abs().copysign(if down { -1.0 } else { 1.0 });
        let facet = |(index, name): &(f64, String)| Facet {
            name: name.clone(),
            index: Some(*index),
            plane: Plane { normal: facet_normal(gear, angle, *index), distance: self.rho.abs() },
        };
        Tier {
            name: self.name.clone(),
            angle_deg: Some(angle),
            instructions: self.instructions.clone(),
            facets: self.indices.iter().map(facet).collect(),
        }
    }
}
