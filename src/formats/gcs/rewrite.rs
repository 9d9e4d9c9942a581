//! Writing a changed design back into its Gem Cut Studio file: attributes and corners that changed are replaced,
//! and all else stays as it is.

use super::parser::{GcsFacet, GcsFile, GcsTier, design_part, document};
use crate::formats::changed_design::{ChangedDesign, ChangedFacet};
use crate::formats::changed_polygon::ChangedPolygons;
use crate::formats::cutting_table::angle_as_stated;
use crate::formats::error::FormatError;
use crate::formats::gcs_write::index_angle;
use crate::formats::input::{Input, number};
use crate::storage::text_patch::TextPatch;
use glam::DVec3;
use roxmltree::Node;
use std::fmt::Write;
use std::ops::Range;

/// Angles in degrees that differ by less are those of one tier.
const ONE_ANGLE: f64 = 1e-6;

/// An index angle in degrees that is farther than this from the normal's own says nothing, and stays: one program
/// writes 0 everywhere.
const TRUE_INDEX: f64 = 1e-2;

/// The bytes of the file with the changed design in it, in the frame that the file has.
///
/// Facets of one tier that now differ in depth or angle become tiers of their own, with the same attributes; the
/// instructions stand in the last.
pub fn rewrite(
    source: &Input,
    changed: &ChangedDesign,
    remarks: &mut Vec<String>,
) -> Result<Vec<u8>, FormatError> {
    let patch = TextPatch::new(source.bytes);
    let text = patch.text().to_owned();
    let part = design_part(&text);
    let document = document(source, &text[part.clone()])?;
    let file = GcsFile { source, document: &document };
    let tiers = file.tiers(changed.gear(), &mut Vec::new())?;
    let polygons = ChangedPolygons::new(source.name, changed)?;
    let mut page = Page { text: &text, start: part.start, patch };
    let facets = changed.facets();
    let mut number = 0;
    for tier in &tiers {
        let of_tier = facets.get(number..number + tier.facets.len()).unwrap_or_default();
        page.tier(tier, of_tier);
        for (stored, facet) in tier.facets.iter().zip(of_tier) {
            page.normal(stored, facet);
            if let Some(corners) = polygons.changed(number).filter(|_| !stored.corners.is_empty()) {
                page.corners(stored, facet.before.plane.normal, &corners, polygons.near);
            }
            number += 1;
        }
    }
    if tiers.iter().any(|t| t.left_out > 0) {
        remarks.push("facets of guides and hidden tiers stay where they were".into());
    }
    if let Some(index) = changed.refractive_index() {
        page.refractive_index(&file, index, remarks);
    }
    Ok(page.patch.finish())
}

/// The angle of a normal from +z, 0 to 180 degrees.
fn polar(normal: DVec3) -> f64 {
    normal.truncate().length().atan2(normal.z).to_degrees()
}

/// The file's text and its changes.
struct Page<'t, 'b> {
    text: &'t str,
    /// Where the XML begins in it.
    start: usize,
    patch: TextPatch<'b>,
}

impl Page<'_, '_> {
    /// Where an element stands.
    fn place(&self, node: Node) -> Range<usize> {
        let range = node.range();
        self.start + range.start..self.start + range.end
    }

    /// Gives an attribute another value, or the element the attribute.
    fn set(&mut self, node: Node, key: &str, value: &str) {
        match node.attribute_node(key) {
            Some(attribute) => {
                let at = attribute.range_value();
                self.patch.replace(self.start + at.start..self.start + at.end, value);
            }
            None => {
                let name = self.place(node).start + 1 + node.tag_name().name().len();
                self.patch.replace(name..name, format!(" {key}=\"{value}\""));
            }
        }
    }

    /// As [`Page::set`]; a number that is there already stays as it is written.
    fn set_number(&mut self, node: Node, key: &str, value: f64) {
        if node.attribute(key).map(str::trim).and_then(number) != Some(value) {
            self.set(node, key, &value.to_string());
        }
    }

    /// The white space before a place, up to the line or element before.
    fn gap(&self, at: usize) -> Range<usize> {
        self.text[..at].trim_end().len()..at
    }

    /// Angle and depth of a tier, and the tiers that it comes apart into.
    fn tier(&mut self, tier: &GcsTier, facets: &[ChangedFacet]) {
        let Some(first) = facets.first() else { return };
        // the first facet of each row
        let mut rows = vec![(0, first)];
        for (i, facet) in facets.iter().enumerate() {
            let (_, row) = rows.last().copied().unwrap_or((0, first));
            let apart = |a: &ChangedFacet, b: &ChangedFacet| {
                let angles = |normals: [DVec3; 2]| (polar(normals[0]) - polar(normals[1])).abs() > ONE_ANGLE;
                angles([a.after.plane.normal, b.after.plane.normal])
                    && !angles([a.before.plane.normal, b.before.plane.normal])
            };
            let (here, there) = (facet.after.plane.distance, row.after.plane.distance);
            if apart(facet, row) || (tier.has_depth && !facet.is_one_distance(here, there)) {
                rows.push((i, facet));
            }
        }
        let last = rows.len() - 1;
        for (i, (number, facet)) in rows.into_iter().enumerate() {
            let plane = facet.after.plane;
            let silent = i < last && tier.node.attribute("instructions").is_some_and(|s| !s.is_empty());
            if i == 0 {
                if facet.is_turned() {
                    self.set_number(tier.node, "angle", polar_as_stated(facet));
                }
                if facet.is_moved() && tier.has_depth {
                    self.set_number(tier.node, "depth", plane.distance);
                }
                if silent {
                    self.set(tier.node, "instructions", "");
                }
            } else if let Some(stored) = tier.facets.get(number) {
                self.new_tier(tier, stored, facet, silent);
            }
        }
    }

    /// Ends the tier before a facet, and begins one of the same attributes.
    fn new_tier(&mut self, tier: &GcsTier, stored: &GcsFacet, facet: &ChangedFacet, silent: bool) {
        let mut tag = String::from("<tier");
        for attribute in tier.node.attributes() {
            let range = attribute.range();
            // a String takes every write
            let _ = match attribute.name() {
                "angle" => write!(tag, " angle=\"{}\"", polar_as_stated(facet)),
                "depth" => write!(tag, " depth=\"{}\"", facet.after.plane.distance),
                "instructions" if silent => write!(tag, " instructions=\"\""),
                _ => write!(tag, " {}", &self.text[self.start + range.start..self.start + range.end]),
            };
        }
        let (outer, inner) = (self.gap(self.place(tier.node).start), self.gap(self.place(stored.node).start));
        let (outer, inner_text) = (&self.text[outer], &self.text[inner.clone()]);
        self.patch.replace(inner, format!("{outer}</tier>{outer}{tag}>{inner_text}"));
    }

    /// The normal of a facet and its index angle, if it faces elsewhere.
    fn normal(&mut self, stored: &GcsFacet, facet: &ChangedFacet) {
        if !facet.is_turned() {
            return;
        }
        let (old, new) = (facet.before.plane.normal, facet.after.plane.normal);
        for (key, value) in ["nx", "ny", "nz"].into_iter().zip(new.to_array()) {
            self.set_number(stored.node, key, value);
        }
        let off = |a: f64, b: f64| ((a - b + 180.0).rem_euclid(360.0) - 180.0).abs();
        let said = stored.node.attribute("index_angle").map(str::trim).and_then(number);
        let (was, is) = (index_angle(old, polar(old)), index_angle(new, polar(new)));
        if said.is_some_and(|said| off(said, was) < TRUE_INDEX) && off(was, is) > 1e-9 {
            self.set_number(stored.node, "index_angle", is);
        }
    }

    /// The corners of a facet: new coordinates where there are as many as before, else new elements.
    ///
    /// - `normal`: the facet's, as the stored corners have it
    /// - `corners`: counter-clockwise seen from outside
    /// - `near`: coordinates that differ by less stay as they are written
    fn corners(&mut self, stored: &GcsFacet, normal: DVec3, corners: &[DVec3], near: f64) {
        let nodes: Vec<Node> = stored.node.children().filter(|n| n.has_tag_name("vertex")).collect();
        let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else { return };
        let n = stored.corners.len();
        let old = &stored.corners;
        let area: DVec3 = (0..n).map(|i| old[i].cross(old[(i + 1) % n])).sum();
        let mut corners = corners.to_vec();
        // most programs store them clockwise
        if area.dot(normal) <= 0.0 {
            corners.reverse();
        }
        if corners.len() == n && n == nodes.len() {
            let off = |turn: &usize| (0..n).map(|i| old[i].distance(corners[(i + turn) % n])).sum::<f64>();
            let turn = (0..n).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
            for (i, (node, old)) in nodes.iter().zip(old).enumerate() {
                let both = old.to_array().into_iter().zip(corners[(i + turn) % n].to_array());
                for (key, (old, new)) in ["x", "y", "z"].into_iter().zip(both) {
                    if (old - new).abs() > near {
                        self.set_number(*node, key, new);
                    }
                }
            }
            return;
        }
        let gap = self.gap(self.place(*first).start);
        let before = &self.text[gap.clone()];
        let vertex = |c: &DVec3| format!("{before}<vertex x=\"{}\" y=\"{}\" z=\"{}\" />", c.x, c.y, c.z);
        let elements: String = corners.iter().map(vertex).collect();
        self.patch.replace(gap.start..self.place(*last).end, elements);
    }

    fn refractive_index(&mut self, file: &GcsFile, index: f64, remarks: &mut Vec<String>) {
        let root = file.document.root_element();
        match root.children().find(|n| n.has_tag_name("render")) {
            Some(render) => {
                self.set_number(render, "refractive_index", index);
                let others = ["material", "dispersion", "density"];
                let kept: Vec<_> = others.into_iter().filter(|key| render.has_attribute(*key)).collect();
                if !kept.is_empty() {
                    remarks.push(format!(
                        "beside the new index of refraction the file's {} of the material it was drawn for stay",
                        kept.join(", ")
                    ));
                }
            }
            None => {
                let end = self.place(root).end;
                let at = self.text[..end].rfind("</").unwrap_or(end);
                self.patch.replace(at..at, format!("<render refractive_index=\"{index}\" />\n"));
            }
        }
    }
}

/// The angle from +z of a facet: as its tier states it where that gives its normal.
fn polar_as_stated(facet: &ChangedFacet) -> f64 {
    let stated: Vec<f64> = facet.angle_stated.into_iter().collect();
    let angle = angle_as_stated(&stated, facet.after.plane.normal);
    if angle.is_sign_negative() { 180.0 + angle } else { angle }
}
