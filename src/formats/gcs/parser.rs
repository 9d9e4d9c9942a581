//! The parser of Gem Cut Studio files: tiers and facets, each with its element.

use crate::design::tiers::facet_normal;
use crate::design::{Facet, Gear, Tier};
use crate::formats::cutting_table::{angle_of_mesh, index_of, one_line};
use crate::formats::error::{FormatError, quoted_excerpt};
use crate::formats::input::{Input, is_no_value, number};
use crate::geometry::Plane;
use crate::limits;
use glam::DVec3;
use roxmltree::{Document, Node, ParsingOptions};
use std::ops::Range;

/// A stored depth that differs by more than this, in parts of the corners' distance from the
/// origin, from the corners' own is worth a remark.
const DEPTH_OFF: f64 = 1e-3;

/// Where the design stands in the text; anything may follow it.
pub fn design_part(text: &str) -> Range<usize> {
    let start = text.len() - text.trim_start().len();
    let end = text.rfind("</GemCutStudio").and_then(|at| Some(at + text[at..].find('>')? + 1));
    start..end.unwrap_or(text.len()).max(start)
}

/// The XML of that part of the text, of which no document type is accepted.
pub fn document<'t>(source: &Input, text: &'t str) -> Result<Document<'t>, FormatError> {
    few_attributes(source, text)?;
    let nodes_limit = u32::try_from(source.limits.max(&limits::XML_NODES)).unwrap_or(u32::MAX);
    let options = ParsingOptions { nodes_limit, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|cause| match cause {
        roxmltree::Error::NodesLimitReached => FormatError::Limit {
            place: source.name.into(),
            cause: source.limits.exceeded(&limits::XML_NODES),
        },
        cause => FormatError::Line {
            file: source.name.into(),
            line: cause.pos().row as usize,
            expected: "Gem Cut Studio's XML".into(),
            found: one_line(&cause.to_string()),
        },
    })
}

/// Refuses elements with attributes, or namespaces, without end.
fn few_attributes(source: &Input, text: &str) -> Result<(), FormatError> {
    let mut line = 1;
    let mut namespaces = 0;
    for tag in text.split('<') {
        namespaces += tag.matches("xmlns").count();
        let attributes = if tag.starts_with(['!', '?']) { 0 } else { tag.matches('=').count() };
        source.within_at(line, &limits::XML_ATTRIBUTES, attributes.max(namespaces))?;
        line += tag.matches('\n').count();
    }
    Ok(())
}

/// The file that is read, for errors that name its lines.
pub struct GcsFile<'a> {
    pub source: &'a Input<'a>,
    pub document: &'a Document<'a>,
}

/// A tier and where it stands.
pub struct GcsTier<'a> {
    /// Its element.
    pub node: Node<'a, 'a>,
    /// Its facets; those that are guides or hidden and have no polygon are none of the design.
    pub facets: Vec<GcsFacet<'a>>,
    /// What they make up.
    pub tier: Tier,
    /// Whether the tier states their depth.
    pub has_depth: bool,
    /// How many facets are left out.
    pub left_out: usize,
}

/// A facet's element and its stored corners.
pub struct GcsFacet<'a> {
    pub node: Node<'a, 'a>,
    pub corners: Vec<DVec3>,
}

/// A facet's entries, none where missing.
struct Entries {
    normal: Option<DVec3>,
    index_angle: Option<f64>,
    corners: Vec<DVec3>,
}

impl<'a> GcsFile<'a> {
    pub fn wrong(&self, node: Node, expected: &str, found: &str) -> FormatError {
        self.source.at_line(self.document.text_pos_at(node.range().start).row as usize, expected, found)
    }

    /// A number; an attribute that is missing, empty, infinite or nan is none.
    fn number(&self, node: Node, key: &str) -> Result<Option<f64>, FormatError> {
        match node.attribute(key).map(str::trim) {
            None | Some("") => Ok(None),
            Some(said) => match number(said) {
                Some(value) => Ok(Some(value)),
                None if is_no_value(said) => Ok(None),
                None => Err(self.wrong(node, &format!("a number as {key}"), said)),
            },
        }
    }

    /// A number that the stone does not depend on.
    pub fn hint(&self, node: Node, key: &str) -> Option<f64> {
        node.attribute(key).map(str::trim).and_then(number)
    }

    fn point(&self, node: Node, keys: [&str; 3]) -> Result<Option<DVec3>, FormatError> {
        let mut p = [0.0; 3];
        for (value, key) in p.iter_mut().zip(keys) {
            let Some(given) = self.number(node, key)? else { return Ok(None) };
            *value = given;
        }
        Ok(Some(DVec3::from_array(p)))
    }

    /// All tiers, as they stand in the file; guides and hidden ones may have no facets.
    pub fn tiers(&self, gear: Gear, warnings: &mut Vec<String>) -> Result<Vec<GcsTier<'a>>, FormatError> {
        let root = self.document.root_element();
        let tiers = || root.children().filter(|n| n.has_tag_name("tier"));
        let facets = tiers().flat_map(|t| t.children()).filter(|n| n.has_tag_name("facet")).count();
        self.source.has_at_most(&limits::FACETS, facets)?;
        let all: Vec<GcsTier> =
            tiers().map(|node| self.tier(node, gear, warnings)).collect::<Result<_, _>>()?;
        if all.iter().all(|t| t.tier.facets.is_empty()) {
            return Err(self.wrong(root, "tiers with facets", "none"));
        }
        Ok(all)
    }

    fn tier(
        &self,
        node: Node<'a, 'a>,
        gear: Gear,
        warnings: &mut Vec<String>,
    ) -> Result<GcsTier<'a>, FormatError> {
        let text = |key: &str| node.attribute(key).unwrap_or_default().trim().to_owned();
        let mut tier = Tier {
            name: text("name"),
            angle_deg: None,
            instructions: text("instructions"),
            facets: Vec::new(),
        };
        // from 0 (table) to 180 (culet); of use only where normals are missing
        let polar = self.hint(node, "angle").filter(|a| (0.0..=180.0).contains(a));
        let depth = self.number(node, "depth")?;
        let facets: Vec<_> = node.children().filter(|n| n.has_tag_name("facet")).collect();
        let entries: Vec<Entries> = facets.iter().map(|f| self.entries(*f)).collect::<Result<_, _>>()?;
        // one writer sets every index angle to 0
        let all_0 = facets.len() > 1 && entries.iter().all(|e| e.index_angle.is_none_or(|a| a == 0.0));
        let is = |key: &str, what: &str| node.attribute(key).is_some_and(|v| v.eq_ignore_ascii_case(what));
        let aside = is("guide", "true") || is("visible", "false");
        let mut off = 0.0f64;
        let (mut kept, all) = (Vec::new(), facets.len());
        for (facet, entries) in facets.iter().zip(entries) {
            // what was not cut has left no polygon
            if aside && entries.corners.len() < 3 {
                continue;
            }
            let normal = self.normal(*facet, &entries, polar, all_0)?;
            let corners = || entries.corners.iter();
            let level = corners().map(|c| c.dot(normal)).sum::<f64>() / corners().count() as f64;
            let distance = depth.or(Some(level).filter(|l| l.is_finite())).ok_or_else(|| {
                self.wrong(*facet, "a depth in the tier, or the facet's corners", "neither")
            })?;
            let size = corners().map(|c| c.length()).fold(0.0, f64::max);
            off = off.max((distance - level).abs() / size);
            let index = Some(index_of(gear, normal));
            tier.facets.push(Facet { name: String::new(), index, plane: Plane { normal, distance } });
            kept.push(GcsFacet { node: *facet, corners: entries.corners });
        }
        tier.angle_deg = tier.facets.first().map(|f| angle_of_mesh(f.plane.normal));
        if off > DEPTH_OFF {
            warnings.push(format!(
                "tier {}: its depth is not that of its corners; kept",
                quoted_excerpt(&tier.name)
            ));
        }
        let frosted = |node: &Node| self.hint(*node, "frosting").is_some_and(|f| f > 0.0);
        if frosted(&node) || facets.iter().any(frosted) {
            warnings.push(format!("tier {}: frosted; taken as polished", quoted_excerpt(&tier.name)));
        }
        let left_out = all - tier.facets.len();
        if left_out > 0 {
            warnings.push(format!("tier {}: a guide or hidden, left out", quoted_excerpt(&tier.name)));
        }
        Ok(GcsTier { node, facets: kept, tier, has_depth: depth.is_some(), left_out })
    }

    fn entries(&self, facet: Node) -> Result<Entries, FormatError> {
        let corner = |vertex: Node| {
            let [x, y, z] = ["x", "y", "z"].map(|key| self.hint(vertex, key));
            Some(DVec3::new(x?, y?, z?))
        };
        // of use only where something else is missing
        let vertices = facet.children().filter(|n| n.has_tag_name("vertex"));
        let corners = vertices.map(corner).collect::<Option<Vec<_>>>().unwrap_or_default();
        let normal = self.point(facet, ["nx", "ny", "nz"])?.filter(|n| n.length().is_normal());
        Ok(Entries { normal, index_angle: self.hint(facet, "index_angle"), corners })
    }

    /// The facet's outward unit normal: as stated, from angle and index angle, or from the corners.
    fn normal(
        &self,
        facet: Node,
        entries: &Entries,
        polar: Option<f64>,
        no_index: bool,
    ) -> Result<DVec3, FormatError> {
        if let Some(n) = entries.normal {
            // a unit vector to rounding is kept to the bit
            return Ok(if (n.length_squared() - 1.0).abs() < 1e-15 { n } else { n.normalize() });
        }
        let by_index = polar.zip(entries.index_angle.filter(|_| !no_index)).map(|(polar, index)| {
            // counted from −y: counter-clockwise on the crown, clockwise on pavilion and girdle
            let (teeth, angle) = if polar < 90.0 { (360.0, polar) } else { (-360.0, polar - 180.0) };
            facet_normal(Gear { teeth, offset: 0.0 }, angle, index)
        });
        let up = polar.map(|p| p.to_radians().cos());
        by_index.or_else(|| outward(&entries.corners, up)).ok_or_else(|| {
            self.wrong(facet, "a normal, an index angle in a tier with an angle, or corners", "none")
        })
    }
}

/// The unit normal of a polygon of either winding: upward or downward as the cosine `up` of the
/// tier's angle says, and for a girdle facet away from the stone's axis.
fn outward(corners: &[DVec3], up: Option<f64>) -> Option<DVec3> {
    let next = |i: usize| corners[(i + 1) % corners.len()];
    let area: DVec3 = corners.iter().enumerate().map(|(i, c)| c.cross(next(i))).sum();
    let normal = area.try_normalize()?;
    let outside = match up {
        Some(up) if up.abs() > 1e-3 => normal.z * up,
        _ => normal.dot(corners.iter().sum()),
    };
    Some(if outside < 0.0 { -normal } else { normal })
}
