//! The data set of J. Wiseman's *The Perfect Diamond* (Stanford CS348B, 2005), in the two forms it
//! most probably has.
//!
//! **Unverified**: no original file could be found, so the syntax is reconstructed from what is
//! known of meshes converted from it and from the tools of that course: a pbrt scene with
//! `Shape "trianglemesh"` ([`SCENE`]), or a bare list of corners and faces ([`LIST`]). Facets are
//! stored as quadrilaterals of which triangular ones are degenerate, wound inward, and the stone is
//! tilted: it is welded, oriented, merged and stood upright, largest facet up. No unit.

mod list;
mod pbrt;
mod shapes;
mod words;

use super::error::FormatError;
use super::format::{Format, Parsed, ParsedShape};
use super::input::Input;
use super::mesh_import::{PolygonMesh, recover};
use crate::design::Design;
use crate::geometry::SolidError;
use crate::geometry::facet_recovery::Polygon;
use glam::{DMat3, DQuat, DVec3};
use shapes::{PolygonShape, PolygonShapes};

/// A pbrt scene.
pub static SCENE: Format = Format {
    name: "perfect-diamond",
    extensions: &["pbrt"],
    about: "Perfect Diamond data set as a pbrt scene (form reconstructed, unverified)",
    sniff: pbrt::sniff,
    read: |source| stone(source, pbrt::meshes(source)?),
    write: None,
    rewrite: None,
};

/// A bare list of corners and faces.
pub static LIST: Format = Format {
    name: "perfect-diamond-list",
    extensions: &["txt"],
    about: "Perfect Diamond data set as corners, then faces (form reconstructed, unverified)",
    sniff: list::sniff,
    read: |source| stone(source, list::mesh(source)?),
    write: None,
    rewrite: None,
};

/// The stone among the shapes: all of them together, or the only one that is a stone by itself.
fn stone(source: &Input, (shapes, digits): PolygonShapes) -> Result<Parsed, FormatError> {
    let together = shapes.iter().fold(PolygonShape::default(), |(mut vertices, mut polygons), (v, p)| {
        let first = vertices.len();
        vertices.extend(v);
        polygons.extend(p.iter().map(|p| Polygon {
            corners: p.corners.iter().map(|c| c.saturating_add(first)).collect(),
            ..p.clone()
        }));
        (vertices, polygons)
    });
    let as_stone =
        |(v, p): PolygonShape| recover(&source.stem(), &PolygonMesh::from_text(v, p, digits), source.limits);
    let (design, mut warnings) = match as_stone(together) {
        Ok(Parsed { shape: ParsedShape::Design(design), warnings }) => (design, warnings),
        other => {
            let count = shapes.len();
            let alone = shapes.into_iter().take(MOST_SHAPES).filter_map(|s| match as_stone(s) {
                Ok(Parsed { shape: ParsedShape::Design(design), warnings }) => Some((design, warnings)),
                _ => None,
            });
            let Ok([(design, mut warnings)]) = <[_; 1]>::try_from(alone.collect::<Vec<_>>()) else {
                return other.map_err(|cause| source.no_stone(cause));
            };
            warnings.push(format!("the stone is one of {count} shapes; the others were left out"));
            (design, warnings)
        }
    };
    let upright = upright(&design).map_err(|cause| source.no_stone(cause.into()))?;
    warnings.push("Perfect Diamond data: the file's form is reconstructed and unverified".into());
    Ok(Parsed::new(upright, warnings))
}

/// Shapes that are tried one by one when all together are no stone.
const MOST_SHAPES: usize = 64;

/// The design turned so that its largest facet is on top, its facets named by zone anew.
fn upright(design: &Design) -> Result<Design, SolidError> {
    let solid = design.solid()?;
    let largest = (0..solid.faces.len()).max_by(|&a, &b| solid.area(a).total_cmp(&solid.area(b)));
    let planes = design.planes();
    let up = largest.map_or(DVec3::Z, |f| planes[solid.faces[f].plane].normal);
    let turn = DMat3::from_quat(DQuat::from_rotation_arc(up, DVec3::Z));
    let facets = design.facets().map(|f| (f.name.clone(), f.plane.turned(turn)));
    Ok(Design::from_facets(design.name.clone(), facets.collect::<Vec<_>>()))
}
