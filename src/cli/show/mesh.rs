//! A mesh that is no convex stone, as `cutlab show` tells of it.

use crate::cli::outcome::{Failure, Shape};
use serde::Serialize;

/// A closed mesh with dents: shown, though it is no stone that can be cut.
#[derive(Debug, Serialize)]
pub struct MeshSheet {
    file: String,
    format: &'static str,
    facets: usize,
    closed: bool,
    convex: bool,
    /// In the file's own unit cubed.
    volume: f64,
    /// Smallest and largest coordinates.
    #[serde(rename = "box")]
    bounds: [[f64; 3]; 2],
    reason: String,
}

impl MeshSheet {
    /// What is known of the file; none if it is not a mesh with dents.
    pub fn of(file: &str, failure: &Failure) -> Option<MeshSheet> {
        let Shape { format, closed, dented: Some(mesh), .. } = failure.shape()? else { return None };
        Some(MeshSheet {
            file: file.into(),
            format,
            facets: mesh.facets,
            closed,
            convex: false,
            volume: mesh.volume,
            bounds: [mesh.bounds.0.to_array(), mesh.bounds.1.to_array()],
            reason: failure.message(),
        })
    }

    /// Lines for people.
    pub fn text(&self) -> String {
        let [low, high] = self.bounds;
        let side = |a: usize| format!("{:.6}", high[a] - low[a]);
        format!(
            "{} ({})\n  facets          {}\n  box             {} × {} × {}\n  volume          {:.6} in the \
             file's own unit\n  closed          yes\n  convex          no\n  note            {}\n",
            self.file,
            self.format,
            self.facets,
            side(0),
            side(1),
            side(2),
            self.volume,
            self.reason
        )
    }
}
