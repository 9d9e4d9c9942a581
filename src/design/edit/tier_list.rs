//! The tiers of a design as they are named in settings.

use super::error::EditError;
use crate::design::meet_network::MeetNetwork;
use crate::design::tiers::{Design, Zone};
use crate::parse;

/// Facets of a tier whose angles differ by less, in radians, are set as one: above the rounding of three decimals of
/// a degree.
const ONE_ANGLE: f64 = 2e-5;

/// A tier as it can be changed: facets that one angle is set for.
#[derive(Debug, Clone)]
pub struct EditableTier {
    /// Its name in the file; empty if it has none.
    pub name: String,
    /// Its place in the cutting order of its part of the stone: `P1`, `C2`, `G1`; of a mesh, whose facets have no
    /// order, the steepest first. Its number (`#7`) where another tier has that name.
    pub place: String,
    /// Where its facets are.
    pub zone: Zone,
    /// Its parts in the network: several where its facets differ in distance.
    pub parts: Vec<usize>,
    /// Its facets, numbers in [`Design::facets`].
    pub facets: Vec<usize>,
}

impl EditableTier {
    /// What it is called: its name, else its place.
    pub fn label(&self) -> &str {
        if self.name.is_empty() { &self.place } else { &self.name }
    }
}

/// The tiers of a design, in cutting order.
#[derive(Debug, Clone)]
pub struct TierList {
    /// The tiers.
    pub tiers: Vec<EditableTier>,
}

impl TierList {
    /// The tiers of a design: its own; of a mesh, which has none, those of its network.
    pub fn of_design(design: &Design, network: &MeetNetwork) -> TierList {
        let mut tiers: Vec<EditableTier> = Vec::new();
        let mut number = 0;
        for tier in &design.tiers {
            let first = tiers.len();
            let labels = |i: usize| tier.facets.get(i).map_or("", |f| f.name.as_str());
            let is_cut = tier.angle_deg.is_some();
            for i in 0..tier.facets.len() {
                let part = network.part_of(number);
                let zone = network.parts[part].zone;
                let polar = network.parts[part].polar;
                let same = |t: &&mut EditableTier| {
                    let of = &network.parts[t.parts[0]];
                    t.zone == zone
                        && (of.polar - polar).abs() < ONE_ANGLE
                        && (is_cut || t.parts.contains(&part))
                };
                match tiers[first..].iter_mut().find(same) {
                    Some(known) => {
                        known.facets.push(number);
                        if !known.parts.contains(&part) {
                            known.parts.push(part);
                        }
                    }
                    None => {
                        let own = if tier.name.is_empty() { labels(i) } else { &tier.name };
                        tiers.push(EditableTier {
                            name: if is_cut { own.into() } else { String::new() },
                            place: String::new(),
                            zone,
                            parts: vec![part],
                            facets: vec![number],
                        });
                    }
                }
                number += 1;
            }
        }
        if design.tiers.iter().all(|t| t.angle_deg.is_none()) {
            let steep =
                |t: &EditableTier| (network.parts[t.parts[0]].polar - std::f64::consts::FRAC_PI_2).abs();
            tiers.sort_by(|a, b| a.zone.cmp(&b.zone).then(steep(a).total_cmp(&steep(b))));
        }
        let named: Vec<(Zone, &str)> = tiers.iter().map(|t| (t.zone, t.name.as_str())).collect();
        let places = places(&named);
        tiers.iter_mut().zip(places).for_each(|(tier, place)| tier.place = place);
        TierList { tiers }
    }

    /// The tiers that are meant by a name, a place, a number from 1, or a pattern with `*` and `?`, which is
    /// one of names and places; else names come first. The error names the nearest.
    pub fn named(&self, asked: &str) -> Result<Vec<&EditableTier>, EditError> {
        let all = |is: &dyn Fn(&EditableTier) -> bool| -> Vec<&EditableTier> {
            self.tiers.iter().filter(|t| is(t)).collect()
        };
        let found = if asked.contains(['*', '?']) {
            all(&|t| matches(asked, &t.name) || matches(asked, &t.place))
        } else {
            let exact = all(&|t| t.name == asked.trim());
            let by_name = if exact.is_empty() { all(&|t| parse::is_name(&t.name, asked)) } else { exact };
            // the only table of a stone is T in its diagram, the only culet K
            let alone =
                |t: &EditableTier| matches!(&*t.place, "T1" | "K1") && t.place.starts_with(asked.trim());
            let by_place =
                || all(&|t| parse::is_name(&t.place, asked) || (asked.trim().len() == 1 && alone(t)));
            let number = asked.trim().trim_start_matches('#').parse::<usize>().ok();
            let by_number = || number.and_then(|n| self.tiers.get(n.checked_sub(1)?)).into_iter().collect();
            [&|| by_name.clone(), &by_place as &dyn Fn() -> Vec<_>, &by_number]
                .into_iter()
                .map(|find| find())
                .find(|found| !found.is_empty())
                .unwrap_or_default()
        };
        if found.is_empty() {
            return Err(EditError::NoSuchTier {
                asked: asked.into(),
                nearest: self.nearest(asked).map(String::from),
                known: self.tiers.iter().map(|t| t.label().to_owned()).collect(),
            });
        }
        Ok(found)
    }

    /// The name or place that is probably meant: of a place beyond the last (`P9` of four) the last of its part
    /// of the stone, else what is spelled alike.
    fn nearest(&self, asked: &str) -> Option<&str> {
        let places = || self.tiers.iter().map(|t| t.place.as_str());
        let beyond = numbered_place(asked).and_then(|(letter, number)| {
            let alike = places().filter_map(|place| Some((place, numbered_place(place)?)));
            let numbers = alike.filter(|(_, (other, _))| *other == letter).map(|(place, (_, n))| (place, n));
            numbers.min_by_key(|(_, other)| other.abs_diff(number)).map(|(place, _)| place)
        });
        let names = places().chain(self.tiers.iter().map(|t| t.name.as_str())).filter(|n| !n.is_empty());
        beyond.or_else(|| parse::nearest_name(asked, names))
    }

    /// What a facet is called: its tier, and its index or number there.
    pub fn facet_label(&self, design: &Design, facet: usize) -> String {
        let tier = self.tiers.iter().find(|t| t.facets.contains(&facet));
        let Some(tier) = tier else { return format!("facet {}", facet + 1) };
        if tier.facets.len() == 1 {
            return tier.label().into();
        }
        match design.facets().nth(facet).and_then(|f| f.index) {
            Some(index) => format!("{}@{}", tier.label(), parse::format_number((index * 1e4).round() / 1e4)),
            None => {
                let number = tier.facets.iter().position(|f| *f == facet).unwrap_or_default();
                format!("{} {}", tier.label(), number + 1)
            }
        }
    }
}

/// The letter, as a capital, and the number of a place: `P9`.
fn numbered_place(text: &str) -> Option<(char, usize)> {
    let mut letters = text.trim().chars();
    let letter = letters.next()?.to_ascii_uppercase();
    letters.as_str().parse().ok().map(|number| (letter, number))
}

/// The place of each tier in its part of the stone: `P1`, `C2`, `G1`, `T1`, `K1`. Where another tier has that as its
/// name, the tier's number: `#7`.
///
/// - `tiers`: zone and name of each, in cutting order
pub fn places(tiers: &[(Zone, &str)]) -> Vec<String> {
    let mut counts = [0; 5];
    let place = |(number, (zone, name)): (usize, &(Zone, &str))| {
        let count = &mut counts[*zone as usize];
        *count += 1;
        let letter = match zone {
            Zone::Table => "T",
            Zone::Crown => "C",
            Zone::Girdle => "G",
            Zone::Pavilion => "P",
            Zone::Culet => "K",
        };
        let place = format!("{letter}{count}");
        let is_taken = !parse::is_name(name, &place) && tiers.iter().any(|(_, n)| parse::is_name(n, &place));
        if is_taken { format!("#{}", number + 1) } else { place }
    };
    tiers.iter().enumerate().map(place).collect()
}

/// The place of the first facet of each tier of a design that was cut by angle and index.
pub fn places_of_tiers(design: &Design) -> Vec<String> {
    let (mut named, mut first) = (Vec::new(), Vec::new());
    for tier in &design.tiers {
        first.push(named.len());
        let mut known: Vec<(Zone, f64)> = Vec::new();
        for facet in &tier.facets {
            let normal = facet.plane.normal;
            let (zone, polar) = (Zone::from_normal(normal), normal.truncate().length().atan2(normal.z));
            if !known.iter().any(|(z, p)| *z == zone && (p - polar).abs() < ONE_ANGLE) {
                known.push((zone, polar));
                named.push((zone, if tier.name.is_empty() { &*facet.name } else { &*tier.name }));
            }
        }
    }
    let places = places(&named);
    first.iter().map(|i| places.get(*i).cloned().unwrap_or_default()).collect()
}

/// Whether a name fits a pattern: `*` stands for any letters, `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.chars().next() {
        None => name.is_empty(),
        Some('*') => {
            let rest = &pattern[1..];
            (0..=name.len()).filter(|i| name.is_char_boundary(*i)).any(|i| matches(rest, &name[i..]))
        }
        Some(letter) => name.chars().next().is_some_and(|first| {
            (letter == '?' || letter == first)
                && matches(&pattern[letter.len_utf8()..], &name[first.len_utf8()..])
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_stand_for_names() {
        assert!(matches("P*", "P1") && matches("*", "") && matches("C?", "C1") && matches("*a*", "star"));
        assert!(!matches("P*", "C1") && !matches("C?", "C12") && !matches("P", "P1"));
    }
}
