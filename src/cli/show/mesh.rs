//! A mesh that is no convex stone, as `cutlab show` tells of it.

use super::sheet;
use crate::design::LengthUnit;
use crate::stone::Stone;
use crate::storage::terminal::in_line;
use serde::Serialize;

/// A closed mesh with concavities or in several parts: shown, though it is no stone that can be cut.
#[derive(Debug, Serialize)]
pub struct MeshSheet {
    file: String,
    format: &'static str,
    facets: usize,
    triangles: usize,
    /// Separate closed surfaces.
    parts: usize,
    closed: bool,
    convex: bool,
    /// In the unit cubed.
    volume: f64,
    /// `mm`, or `file` where the file has no unit.
    unit: &'static str,
    /// Smallest and largest coordinates.
    #[serde(rename = "box")]
    bounds: [[f64; 3]; 2],
    reason: String,
}

impl MeshSheet {
    /// What is known of a mesh; none of a convex stone.
    pub fn new(stone: &Stone) -> Option<MeshSheet> {
        let mesh = stone.mesh()?;
        let (low, high) = mesh.bounds();
        Some(MeshSheet {
            file: stone.name().into(),
            format: stone.format(),
            facets: mesh.facets.len(),
            triangles: mesh.triangles.len(),
            parts: mesh.shells,
            closed: true,
            convex: false,
            volume: mesh.volume,
            unit: if stone.unit() == LengthUnit::Millimetre { "mm" } else { "file" },
            bounds: [low.to_array(), high.to_array()],
            reason: stone.why_not_convex().map_or_else(String::new, ToString::to_string),
        })
    }

    /// Lines for people.
    pub fn text(&self) -> String {
        let [low, high] = self.bounds;
        let side = |a: usize| format!("{:.6}", high[a] - low[a]);
        let (unit, of_volume) =
            if self.unit == "file" { ("", " in the file's own unit") } else { (" mm", " mm³") };
        let parts = if self.parts == 1 { "one part".into() } else { format!("{} parts", self.parts) };
        let lines = vec![
            ("facets", format!("{} in {} triangles, {parts}", self.facets, self.triangles)),
            ("box", format!("{} × {} × {}{unit}", side(0), side(1), side(2))),
            ("volume", format!("{:.6}{of_volume}", self.volume)),
            ("closed", "yes".into()),
            ("convex", "no".into()),
            ("note", self.reason.clone()),
        ];
        format!("{} ({})\n{}", in_line(&self.file), self.format, sheet::text(lines))
    }
}
