//! A design made ready to be changed, and what becomes of it.

use super::apply;
use super::error::EditError;
use super::flat_size::Size;
use super::setting::{EditTarget, Keep, Setting, Side};
use super::tier_list::{EditableTier, TierList};
use crate::design::families;
use crate::design::meet_network::{Change, MeetNetwork, NetworkError, Solved};
use crate::design::tiers::{Design, Zone};
use crate::geometry::Polyhedron;
use crate::parse;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::RangeInclusive;

/// A design made ready to be changed: its meets are recovered once, for any number of changes.
#[derive(Debug, Clone)]
pub struct Editor {
    /// The design as it was.
    pub design: Design,
    /// Its solid.
    pub solid: Polyhedron,
    /// Its meets.
    pub network: MeetNetwork,
    /// Its tiers.
    pub tiers: TierList,
}

/// A changed design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Edited {
    /// The design: tiers and facets in the same order, with all else that it held. A tier whose facets no longer
    /// have one angle is divided.
    pub design: Design,
    /// Its solid.
    pub solid: Polyhedron,
    /// Tiers whose angles followed though no setting asked for it.
    pub followed: Vec<String>,
    /// Whether the outline had to change.
    pub is_outline_changed: bool,
}

/// Sizes are reached to this many percent of the width.
const REACHED: f64 = 1e-7;

impl Editor {
    /// Recovers the meets of a design.
    pub fn new(design: &Design) -> Result<Editor, EditError> {
        let solid = design.solid()?;
        let network = MeetNetwork::recover(design, &solid);
        let tiers = TierList::of_design(design, &network);
        Ok(Editor { design: design.clone(), solid, network, tiers })
    }

    /// The design with these settings. Errors name the setting, the tier or the meet.
    pub fn edit(&self, settings: &[Setting], keep: Keep) -> Result<Edited, EditError> {
        if let Some((rebuilt, rest)) = self.with_parameters(settings)? {
            let editor = Editor::new(&rebuilt)?;
            return match rest.is_empty() {
                true => Ok(editor.unchanged()),
                false => editor.edit(&rest, keep),
            };
        }
        let mut sizes: Vec<(Size, f64)> = Vec::new();
        let mut network = self.network.clone();
        for side in [Side::Crown, Side::Pavilion] {
            let scales = settings.iter().filter(|s| s.target == EditTarget::Scale(side));
            let ratio = scales.map(|s| s.value).product::<f64>();
            if !(ratio > 0.0 && ratio.is_finite()) {
                let target = EditTarget::Scale(side).to_string();
                return Err(EditError::Value { target, value: ratio, needed: "a number above 0" });
            }
            let [crown, pavilion] =
                [Side::Crown, Side::Pavilion].map(|s| if s == side { ratio } else { 1.0 });
            if ratio != 1.0 {
                network = network.scaled(crown, pavilion).map_err(|e| self.named(e))?;
            }
        }
        let count = network.parts.len();
        let mut change = Change {
            polars: vec![None; count],
            turns: vec![0.0; count],
            distances: vec![None; count],
            angles_stay: keep != Keep::Meets,
            ..Change::default()
        };
        for setting in settings {
            match &setting.target {
                EditTarget::Angle(asked) => {
                    for tier in self.tiers.named(asked)? {
                        self.set_angle(tier, setting, &network, &mut change)?;
                    }
                }
                EditTarget::Shift(side) => {
                    let zone = zone_of(*side);
                    for tier in self.tiers.tiers.iter().filter(|t| t.zone == zone) {
                        let added = Setting { is_added: true, ..setting.clone() };
                        self.set_angle(tier, &added, &network, &mut change)?;
                    }
                }
                EditTarget::Index(asked) => {
                    for part in self.tiers.named(asked)?.iter().flat_map(|t| &t.parts) {
                        change.turns[*part] += std::f64::consts::TAU * setting.value / self.design.gear.teeth;
                    }
                }
                EditTarget::Depth(asked) => {
                    for part in self.tiers.named(asked)?.iter().flat_map(|t| &t.parts) {
                        let by = change.distances[*part].get_or_insert(0.0);
                        *by += setting.value / 100.0 * network.width;
                    }
                }
                EditTarget::Table => self.set_size(Size::Table, setting, &mut sizes)?,
                EditTarget::Girdle => self.set_size(Size::Girdle, setting, &mut sizes)?,
                EditTarget::Culet => self.set_size(Size::Culet, setting, &mut sizes)?,
                EditTarget::Scale(_) | EditTarget::Parameter(_) => {}
            }
        }
        let planes = match keep {
            Keep::Meets | Keep::Angles => self.solved(&network, &mut change, &sizes)?,
            Keep::Depths => {
                let planes = apply::at_depths(&network, &self.network, &change, &sizes)?;
                Solved { planes, followed: Vec::new(), is_outline_changed: false, polars: Vec::new() }
            }
        };
        self.edited(planes, &change)
    }

    /// The design as it is, as if nothing had been set.
    pub fn unchanged(&self) -> Edited {
        let (design, solid) = (self.design.clone(), self.solid.clone());
        Edited { design, solid, followed: Vec::new(), is_outline_changed: false }
    }

    /// A design of a family with the parameters that are set, and the settings that are left; none if none is a
    /// parameter's.
    fn with_parameters(&self, settings: &[Setting]) -> Result<Option<(Design, Vec<Setting>)>, EditError> {
        let family = self.design.family.as_ref();
        let keys = self.parameter_keys()?;
        let (own, rest): (Vec<Setting>, Vec<Setting>) =
            settings.iter().cloned().partition(|s| match &s.target {
                EditTarget::Parameter(_) => true,
                EditTarget::Table | EditTarget::Girdle | EditTarget::Culet => {
                    keys.contains(&&*s.target.to_string())
                }
                _ => false,
            });
        if own.is_empty() {
            return Ok(None);
        }
        let mut given = BTreeMap::new();
        for setting in own {
            let key = setting.target.to_string();
            let (Some(of), true) = (family, keys.contains(&&*key)) else {
                return Err(no_such_key(key, keys));
            };
            let was = match given.get(&key) {
                Some(set) => *set,
                None => of.value(&key).unwrap_or_default(),
            };
            given.insert(key, if setting.is_added { was + setting.value } else { setting.value });
        }
        let Some(of) = family else { return Ok(None) };
        let mut rebuilt = families::build_from(&of.name, &of.given, &given)?;
        (rebuilt.name, rebuilt.source) = (self.design.name.clone(), self.design.source.clone());
        rebuilt.refractive_index = self.design.refractive_index;
        if self.design.unit != rebuilt.unit {
            rebuilt.unit = self.design.unit;
        }
        Ok(Some((rebuilt, rest)))
    }

    fn set_angle(
        &self,
        tier: &EditableTier,
        setting: &Setting,
        network: &MeetNetwork,
        change: &mut Change,
    ) -> Result<(), EditError> {
        let is_crown = match tier.zone {
            Zone::Crown => true,
            Zone::Pavilion => false,
            zone => return Err(EditError::FixedAngle { tier: tier.label().into(), zone: zone.name() }),
        };
        for &part in &tier.parts {
            let was = change.polars[part].unwrap_or(network.parts[part].polar);
            let angle = if is_crown { was } else { PI - was };
            let value = match setting.is_added {
                true => angle.to_degrees() + setting.value,
                // a pavilion's angle may be typed as the file has it, with a minus
                false if is_crown => setting.value,
                false => setting.value.abs(),
            };
            if !(value > 0.0 && value < 90.0) {
                return Err(EditError::Angle { tier: tier.label().into(), value });
            }
            let angle = value.to_radians();
            change.polars[part] = Some(if is_crown { angle } else { PI - angle });
        }
        Ok(())
    }

    fn set_size(&self, size: Size, setting: &Setting, sizes: &mut Vec<(Size, f64)>) -> Result<(), EditError> {
        let was = sizes.iter().rev().find(|(s, _)| *s == size).map(|(_, value)| *value);
        let Some(was) = was.or_else(|| size.percent(&self.solid)) else {
            return Err(EditError::Lacks(size.name()));
        };
        let value = if setting.is_added { was + setting.value } else { setting.value };
        if !(value > 0.0 && value < 100.0) {
            let target = size.name().into();
            return Err(EditError::Value { target, value, needed: "a percentage above 0 and below 100" });
        }
        sizes.retain(|(s, _)| *s != size);
        sizes.push((size, value));
        Ok(())
    }

    /// The network solved, its table, girdle and culet brought to their sizes.
    fn solved(
        &self,
        network: &MeetNetwork,
        change: &mut Change,
        sizes: &[(Size, f64)],
    ) -> Result<Solved, EditError> {
        const TRIED: usize = 20;
        let mut nearest = 0.0;
        for _ in 0..TRIED {
            let solved = network.solve(change).map_err(|e| self.named(e))?;
            if sizes.is_empty() {
                return Ok(solved);
            }
            let solid = Polyhedron::from_planes(&solved.planes)?;
            let mut is_reached = true;
            for (size, asked) in sizes {
                let is = size.percent(&solid).unwrap_or_default();
                if (is - asked).abs() > REACHED {
                    (is_reached, nearest) = (false, is);
                }
                match size {
                    Size::Table => change.table = Some(change.table.unwrap_or(1.0) * asked / is),
                    Size::Culet => change.culet = Some(change.culet.unwrap_or(1.0) * asked / is),
                    Size::Girdle => change.girdle += (asked - is) / 100.0 * network.width,
                }
            }
            if is_reached {
                return Ok(solved);
            }
        }
        let (size, asked) = sizes[0];
        Err(EditError::NotReached { target: size.name(), asked, nearest })
    }

    fn edited(&self, solved: Solved, change: &Change) -> Result<Edited, EditError> {
        let solid = Polyhedron::from_planes(&solved.planes)?;
        self.check_facets(&solid)?;
        let design = apply::to_design(&self.design, &self.network, &solved.planes, change);
        let followed =
            self.tiers.tiers.iter().filter(|t| t.parts.iter().any(|p| solved.followed.contains(p)));
        Ok(Edited {
            design,
            solid,
            followed: followed.map(|t| t.label().to_owned()).collect(),
            is_outline_changed: solved.is_outline_changed,
        })
    }

    /// Every facet that bounded the stone still does.
    fn check_facets(&self, solid: &Polyhedron) -> Result<(), EditError> {
        let stands = |of: &Polyhedron| of.faces.iter().map(|f| f.plane).collect::<Vec<_>>();
        let (was, is) = (stands(&self.solid), stands(solid));
        let lost: Vec<usize> = was.into_iter().filter(|f| is.binary_search(f).is_err()).collect();
        if lost.is_empty() { Ok(()) } else { Err(self.named(NetworkError::Lost { facets: lost })) }
    }

    /// The error with facets by name.
    fn named(&self, cause: NetworkError) -> EditError {
        let label = |facet: &usize| self.tiers.facet_label(&self.design, *facet);
        let (facets, by) = match &cause {
            NetworkError::Opens { facets, .. } | NetworkError::Lost { facets } => (facets.clone(), None),
            NetworkError::CutAway { facets, by, .. } => (facets.clone(), Some(label(by))),
            _ => (Vec::new(), None),
        };
        let facets = facets.iter().map(label).collect();
        EditError::Network { cause, facets, by }
    }

    /// Angle of a tier from the girdle plane in degrees, without sign.
    pub fn angle_deg(&self, tier: &EditableTier) -> f64 {
        let polar = self.network.parts[tier.parts[0]].polar;
        let angle = FRAC_PI_2.min(if polar > FRAC_PI_2 { PI - polar } else { polar }).to_degrees();
        (angle * 1e9).round() / 1e9
    }

    /// The value that table, girdle, culet or a parameter of the family has now. The error says what the design
    /// lacks.
    pub fn value_of(&self, target: &EditTarget) -> Result<f64, EditError> {
        let key = target.to_string();
        let keys = self.parameter_keys()?;
        if let (Some(of), true) = (&self.design.family, keys.contains(&&*key)) {
            return Ok(of.value(&key).unwrap_or_default());
        }
        let size = match target {
            EditTarget::Table => Size::Table,
            EditTarget::Girdle => Size::Girdle,
            EditTarget::Culet => Size::Culet,
            _ => return Err(no_such_key(key, keys)),
        };
        size.percent(&self.solid).ok_or(EditError::Lacks(size.name()))
    }

    /// The values that a parameter of the design's family may have; none of what is no parameter.
    pub fn parameter_range(&self, target: &EditTarget) -> Option<RangeInclusive<f64>> {
        let family = families::family(&self.design.family.as_ref()?.name).ok()?;
        let parameter = family.keys().find(|p| p.key == target.to_string())?;
        Some(parameter.range.0..=parameter.range.1)
    }

    /// The parameters of the design's family; none of a design that has none.
    fn parameter_keys(&self) -> Result<Vec<&'static str>, EditError> {
        Ok(match &self.design.family {
            Some(of) => families::family(&of.name)?.keys().map(|p| p.key).collect(),
            None => Vec::new(),
        })
    }
}

fn no_such_key(key: String, known: Vec<&'static str>) -> EditError {
    let nearest = parse::nearest_name(&key, known.iter().copied()).map(String::from);
    EditError::NoSuchKey { key, nearest, known }
}

fn zone_of(side: Side) -> Zone {
    match side {
        Side::Crown => Zone::Crown,
        Side::Pavilion => Zone::Pavilion,
    }
}
