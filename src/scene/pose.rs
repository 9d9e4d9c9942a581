//! Pose of a stone: a stable rest from its shape and centre of mass, or on its culet.

use crate::geometry::Polyhedron;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// A way for a stone to stand on a plane.
///
/// ```
/// use cutlab::glam::DVec3;
/// use cutlab::{Pose, Stone};
///
/// let stone = Stone::parse("tolkowsky")?;
/// let up = Pose::TableDown.rotation(stone.solid().unwrap()) * DVec3::Z; // where the table faces
/// assert!((up + DVec3::Z).length() < 1e-12);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Pose {
    /// As a loose stone lies: on a facet over which its centre of mass comes to rest, the crown
    /// side up if there is such a facet.
    Lying,
    /// Upright, the lowest corner on the plane.
    TableUp,
    /// Upside down, as for the hearts viewer.
    TableDown,
}

impl Pose {
    /// Every pose with its name on the command line.
    pub const ALL: [(&'static str, Pose); 3] =
        [("lying", Pose::Lying), ("table-up", Pose::TableUp), ("table-down", Pose::TableDown)];

    /// The pose called `name`.
    pub fn by_name(name: &str) -> Option<Pose> {
        Self::ALL.iter().find(|(n, _)| *n == name).map(|(_, pose)| *pose)
    }

    /// Rotation from the stone's frame to a world whose floor is horizontal. A lying stone is
    /// turned so that its crown leans toward −y, where the camera stands.
    pub fn rotation(self, solid: &Polyhedron) -> DMat3 {
        match self {
            Pose::TableUp => DMat3::IDENTITY,
            Pose::TableDown => DMat3::from_rotation_x(std::f64::consts::PI),
            Pose::Lying => {
                let Some(down) = resting_facet(solid) else { return DMat3::IDENTITY };
                let laid = rotation_between(down, DVec3::NEG_Z);
                let crown = laid * DVec3::Z;
                // angle that brings the crown's horizontal lean to −y
                let turn = if crown.truncate().length() < 1e-9 {
                    0.0
                } else {
                    -std::f64::consts::FRAC_PI_2 - crown.y.atan2(crown.x)
                };
                DMat3::from_rotation_z(turn) * laid
            }
        }
    }
}

/// Outward normal of the facet that a stone rests on.
///
/// A facet is a stable rest if the foot of the perpendicular from the centre of mass lies within
/// it. Among those that leave the crown side up the one with the lowest centre of mass is taken,
/// else among all. Checked in this file's tests.
fn resting_facet(solid: &Polyhedron) -> Option<DVec3> {
    let (_, centre) = solid.volume_and_centre();
    let mut rests: Vec<(bool, f64, DVec3)> = Vec::new();
    for f in 0..solid.faces.len() {
        let normal = solid.area_vector(f).normalize_or_zero();
        let corners: Vec<DVec3> = solid.polygon(f).collect();
        let height = normal.dot(corners[0] - centre);
        let foot = centre + normal * height;
        let inside = (0..corners.len()).all(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            (b - a).cross(foot - a).dot(normal) >= 0.0
        });
        if inside {
            rests.push((normal.z > -1e-3, height, normal));
        }
    }
    rests.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    rests.first().map(|r| r.2)
}

/// The shortest rotation that takes unit vector `a` to unit vector `b`.
fn rotation_between(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_quat(glam::DQuat::from_rotation_arc(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::library;
    use std::collections::BTreeMap;

    #[test]
    fn a_brilliant_rests_on_its_pavilion_and_girdle() {
        let design =
            library::design("round-brilliant", &BTreeMap::new()).expect("in the library").expect("builds");
        let solid = design.solid().expect("closed");
        let turn = Pose::Lying.rotation(&solid);
        let corners: Vec<DVec3> = solid.vertices.iter().map(|v| turn * *v).collect();
        let floor = corners.iter().map(|v| v.z).fold(f64::INFINITY, f64::min);
        let touching: Vec<usize> = (0..corners.len()).filter(|&i| corners[i].z - floor < 1e-9).collect();
        assert!(touching.len() >= 3, "{touching:?}");
        // it touches with the girdle's rim and leans by about the pavilion angle, crown to −y
        let radius = |i: usize| solid.vertices[i].truncate().length();
        assert!(touching.iter().any(|&i| radius(i) > 3.2));
        let crown = turn * DVec3::Z;
        assert!(crown.z > 0.6 && crown.z < 0.85 && crown.y < -0.5, "{crown}");
        // stable: the centre of mass stands over the hull of what touches
        let (_, centre) = solid.volume_and_centre();
        let foot = (turn * centre).truncate();
        let xs: Vec<f64> = touching.iter().map(|&i| corners[i].x).collect();
        assert!(xs.iter().any(|x| *x <= foot.x) && xs.iter().any(|x| *x >= foot.x));
    }
}
