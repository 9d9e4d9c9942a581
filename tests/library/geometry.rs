//! Half-space intersection: known solids, random ones, and the planes that bound nothing.

use cutlab::advanced::design::library;
use cutlab::advanced::geometry::polyhedron::PlaneStatus;
use cutlab::advanced::geometry::{Plane, Polyhedron, SolidError};
use glam::{DMat3, DQuat, DVec3};
use proptest::prelude::*;
use std::collections::{BTreeMap, HashMap};

fn cube(half: f64) -> Vec<Plane> {
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
        .map(|n| Plane::new(n, half))
        .to_vec()
}

fn library_solid(name: &str, values: &[(&str, f64)]) -> Polyhedron {
    let values: BTreeMap<String, f64> = values.iter().map(|(k, v)| (k.to_string(), *v)).collect();
    library::design(name, &values).expect("in the library").expect("can be made").solid().expect("closed")
}

/// V − E + F = 2, and every edge is run once in each direction.
fn assert_closed(solid: &Polyhedron) {
    assert_eq!(solid.euler(), 2);
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    for face in &solid.faces {
        let c = &face.corners;
        (0..c.len()).for_each(|i| *edges.entry((c[i], c[(i + 1) % c.len()])).or_default() += 1);
    }
    for (&(a, b), &times) in &edges {
        assert!(times == 1 && edges.get(&(b, a)) == Some(&1), "edge {a}–{b}");
    }
}

fn assert_near(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
}

#[test]
fn known_solids_have_their_volumes_and_counts() {
    let solid = Polyhedron::from_planes(&cube(1.0)).expect("closed");
    assert_closed(&solid);
    assert_eq!((solid.vertices.len(), solid.edge_count(), solid.faces.len()), (8, 12, 6));
    assert_near(solid.volume(), 8.0, 1e-14);
    assert_near(solid.surface(), 24.0, 1e-14);

    // a regular octahedron of circumradius R has volume 4/3 R³
    let solid = library_solid("octahedron", &[]);
    assert_closed(&solid);
    assert_eq!((solid.vertices.len(), solid.edge_count(), solid.faces.len()), (6, 12, 8));
    assert_near(solid.volume(), 4.0 / 3.0 * 3.25f64.powi(3), 1e-13);

    // a right prism over a regular polygon of inner radius r: n r² tan(π/n) h
    for sides in [3.0, 5.0, 6.0, 17.0, 360.0] {
        let solid = library_solid("prism", &[("sides", sides), ("height", 5.0), ("size", 8.0)]);
        assert_closed(&solid);
        assert_eq!(solid.faces.len(), sides as usize + 2);
        assert_near(solid.volume(), sides * 16.0 * (std::f64::consts::PI / sides).tan() * 5.0, 1e-12);
    }
}

#[test]
fn the_reference_stone_has_its_volume_and_every_library_cut_is_closed() {
    let solid = library_solid("round-brilliant", &[]);
    assert_eq!(solid.faces.len(), 153);
    // .2085 D³, from the project's sources
    assert!((solid.volume() / 6.5f64.powi(3) - 0.2085).abs() < 5e-5, "{}", solid.volume());
    for name in library::names() {
        assert_closed(&library_solid(name, &[]));
    }
}

#[test]
fn a_crown_of_no_height_merges_into_the_table() {
    let solid = library_solid("round-brilliant", &[("crown-angle", 0.0)]);
    assert_closed(&solid);
    assert_eq!(solid.faces.len(), 1 + 24 + 96);
    let merged = solid.plane_status.iter().filter(|f| matches!(f, PlaneStatus::Duplicate(_))).count();
    assert_eq!(merged, 32);
}

#[test]
fn coincident_and_redundant_planes_are_told_apart() {
    let mut planes = cube(1.0);
    planes.push(Plane::new(DVec3::Z, 1.0)); // the top again
    planes.push(Plane::new(DVec3::ONE, 5.0)); // far outside
    planes.push(Plane::new(DVec3::ONE, 3f64.sqrt())); // touches one corner
    let solid = Polyhedron::from_planes(&planes).expect("closed");
    assert_eq!(solid.plane_status[6], PlaneStatus::Duplicate(4));
    assert_eq!(solid.plane_status[7], PlaneStatus::Redundant);
    assert_eq!(solid.plane_status[8], PlaneStatus::Redundant);
    assert_eq!(solid.faces.len(), 6);
    assert_near(solid.volume(), 8.0, 1e-14);
    // a plane that later cuts leave nothing of
    let mut planes = vec![Plane::new(DVec3::Z, 2.0)];
    planes.extend(cube(1.0));
    let solid = Polyhedron::from_planes(&planes).expect("closed");
    assert_eq!(solid.plane_status[0], PlaneStatus::Redundant);
}

#[test]
fn an_open_set_names_the_direction_and_the_planes_around_it() {
    let planes: Vec<Plane> = cube(1.0).into_iter().filter(|p| p.normal != DVec3::Z).collect();
    match Polyhedron::from_planes(&planes) {
        Err(SolidError::Open { planes, direction }) => {
            assert_eq!(planes, [0, 1, 2, 3]);
            assert!(direction.dot(DVec3::Z) > 0.99, "{direction}");
        }
        other => panic!("{other:?}"),
    }
    assert!(matches!(Polyhedron::from_planes(&[]), Err(SolidError::Open { .. })));
}

#[test]
fn nothing_left_and_what_is_no_plane_are_errors() {
    let mut planes = cube(1.0);
    planes.push(Plane::new(DVec3::Z, -2.0));
    assert_eq!(Polyhedron::from_planes(&planes).err(), Some(SolidError::Empty { plane: 6 }));
    for bad in [
        Plane { normal: DVec3::NAN, distance: 1.0 },
        Plane { normal: DVec3::ZERO, distance: 1.0 },
        Plane { normal: DVec3::Z, distance: f64::INFINITY },
    ] {
        let mut planes = cube(1.0);
        planes.push(bad);
        assert!(matches!(Polyhedron::from_planes(&planes), Err(SolidError::NotAPlane { plane: 6, .. })));
    }
}

#[test]
fn slivers_stay_closed() {
    // a shaving off a corner, down to what the weld takes for nothing
    for depth in [1e-3, 1e-6, 1e-8, 1e-9, 1e-11, 1e-13] {
        let mut planes = cube(1.0);
        planes.push(Plane::new(DVec3::ONE, 3f64.sqrt() - depth));
        planes.push(Plane::new(DVec3::new(1.0, 1.0, 1.0 + depth), 3f64.sqrt() - depth / 2.0));
        let solid = Polyhedron::from_planes(&planes).expect("closed");
        assert_closed(&solid);
        assert_near(solid.volume(), 8.0, 1e-2);
    }
}

#[test]
fn the_unit_does_not_matter() {
    for name in ["round-brilliant", "octahedron"] {
        let design = library::design(name, &BTreeMap::new()).expect("in the library").expect("can be made");
        let volume = design.solid().expect("closed").volume();
        for k in [1e-6, 1e6] {
            let planes: Vec<Plane> = design.planes().iter().map(|p| p.scaled(k)).collect();
            let solid = Polyhedron::from_planes(&planes).expect("closed");
            assert_closed(&solid);
            assert_near(solid.volume(), volume * k.powi(3), 1e-12);
        }
    }
}

/// No empty triangle, every edge shared by two, normals outward, the surface covered once.
fn assert_triangulated(solid: &Polyhedron) {
    let mesh = solid.triangulate();
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    let mut surface = 0.0;
    for (t, &face) in mesh.triangles.iter().zip(&mesh.faces) {
        let [a, b, c] = t.map(|i| mesh.vertices[i]);
        let area = (b - a).cross(c - a) * 0.5;
        assert!(area.dot(solid.area_vector(face)) > 0.0, "{t:?} of face {face} has area {area}");
        surface += area.length();
        (0..3).for_each(|i| *edges.entry((t[i], t[(i + 1) % 3])).or_default() += 1);
    }
    assert_near(surface, solid.surface(), 1e-9);
    for (&(a, b), &times) in &edges {
        assert!(times == 1 && edges.get(&(b, a)) == Some(&1), "edge {a}–{b}");
    }
}

#[test]
fn every_library_cut_is_triangulated_without_gap() {
    for name in library::names() {
        assert_triangulated(&library_solid(name, &[]));
    }
    assert_triangulated(&library_solid("round-brilliant", &[("culet", 1.0), ("girdle-facets", 960.0)]));
}

/// A cube with `n` random cuts: always closed, never empty.
fn random_planes() -> impl Strategy<Value = Vec<Plane>> {
    let direction = (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)
        .prop_filter("needs a direction", |(x, y, z)| x * x + y * y + z * z > 1e-3);
    let cut = (direction, 0.3..1.5f64).prop_map(|((x, y, z), d)| Plane::new(DVec3::new(x, y, z), d));
    proptest::collection::vec(cut, 0..60).prop_map(|cuts| cube(1.0).into_iter().chain(cuts).collect())
}

fn rotation() -> impl Strategy<Value = DMat3> {
    (0.0..6.3f64, 0.0..6.3f64, 0.0..6.3f64)
        .prop_map(|(a, b, c)| DMat3::from_quat(DQuat::from_euler(glam::EulerRot::ZYX, a, b, c)))
}

proptest! {
    #[test]
    fn random_stones_are_closed_and_triangulated(planes in random_planes()) {
        let solid = Polyhedron::from_planes(&planes).expect("closed");
        assert_closed(&solid);
        assert_triangulated(&solid);
        for v in &solid.vertices {
            prop_assert!(planes.iter().all(|p| p.signed_distance(*v) < 1e-9));
        }
    }

    #[test]
    fn brilliants_of_any_proportions_have_57_facets_and_a_girdle(
        table in 45.0..70.0f64,
        crown in 25.0..42.0f64,
        pavilion in 36.0..46.0f64,
        star in 40.0..65.0f64,
        lower in 60.0..90.0f64,
        sixteenths in 1..8u32,
    ) {
        let values = [("table", table), ("crown-angle", crown), ("pavilion-angle", pavilion),
            ("star", star), ("lower-half", lower), ("girdle", 6.0), ("girdle-facets", f64::from(16 * sixteenths))];
        let solid = library_solid("round-brilliant", &values);
        prop_assert_eq!(solid.faces.len(), 57 + 16 * sixteenths as usize);
        assert_closed(&solid);
        assert_triangulated(&solid);
        // corners where many facets meet are one corner
        for (i, v) in solid.vertices.iter().enumerate() {
            prop_assert!(solid.vertices[..i].iter().all(|w| w.distance(*v) > 1e-9));
        }
    }

    #[test]
    fn volume_does_not_depend_on_order_pose_or_origin(
        (planes, shuffled) in random_planes().prop_flat_map(|p| (Just(p.clone()), Just(p).prop_shuffle())),
        turn in rotation(),
        offset in (-3.0..3.0f64, -3.0..3.0f64, -3.0..3.0f64),
    ) {
        let volume = Polyhedron::from_planes(&planes).expect("closed").volume();
        let offset = DVec3::from(offset);
        let moved: Vec<Plane> = shuffled.iter().map(|p| p.turned(turn).moved(offset)).collect();
        let again = Polyhedron::from_planes(&moved).expect("closed");
        assert_closed(&again);
        assert_near(again.volume(), volume, 1e-9);
    }
}
