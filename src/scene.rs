//! Scenes: surfaces, lights, camera, and how the stones lie in them.
//!
//! World frame: right-handed, z up, lengths in millimetres (in the Cornell room, in room units).

pub mod bsdfs;
pub mod build_context;
pub mod camera;
mod contents;
pub mod field_error;
pub mod file_access;
pub mod intersection;
pub mod light_schema;
pub mod lights;
mod named_data;
pub mod panorama;
pub mod photon_guide;
pub mod pose;
pub mod reflectance;
pub mod scene_file;
pub mod schema;
pub mod shapes;
pub mod stone_instance;
pub mod surface;
pub mod surface_hit;
mod surface_schema;

use crate::parse;
pub use contents::Scene;
use std::path::Path;

pub use bsdfs::Bsdf;
pub use camera::{Camera, Lens};
pub use lights::Light;
pub use photon_guide::{BoundingSphere, PhotonGuide};
pub use pose::Pose;
pub use reflectance::Reflectance;
pub use scene_file::{SceneError, SceneFile, SceneOverrides};
pub use stone_instance::PlacedStone;
pub use surface::Surface;

/// Every scene: its name and its file.
pub static SCENES: &[(&str, &str)] = &[
    ("table", include_str!("scene/presets/table.toml")),
    ("cornell", include_str!("scene/presets/cornell.toml")),
    ("studio", include_str!("scene/presets/studio.toml")),
    ("spot", include_str!("scene/presets/spot.toml")),
    ("sun", include_str!("scene/presets/sun.toml")),
    ("office", include_str!("scene/presets/office.toml")),
    ("daylight", include_str!("scene/presets/daylight.toml")),
    ("face-up", include_str!("scene/presets/face-up.toml")),
    ("aset", include_str!("scene/presets/aset.toml")),
    ("ideal-scope", include_str!("scene/presets/ideal-scope.toml")),
    ("hearts", include_str!("scene/presets/hearts.toml")),
    ("arrows", include_str!("scene/presets/arrows.toml")),
    ("dark-field", include_str!("scene/presets/dark-field.toml")),
];

/// The scene of the catalogue called `name`.
pub fn preset(name: &str) -> Option<Result<SceneFile, SceneError>> {
    let (name, text) = SCENES.iter().find(|(n, _)| parse::is_name(n, name))?;
    Some(SceneFile::parse(name, name, text, Path::new("")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_of_the_catalogue_can_be_set_up() {
        for (name, _) in SCENES {
            let file = preset(name).expect("in the catalogue").expect(name);
            assert!(!file.about().is_empty(), "{name}");
            match file.build(&SceneOverrides::default(), 1.0) {
                Ok(scene) => assert!(!scene.lights.is_empty() && !scene.stones.is_empty(), "{name}"),
                // the user's own panorama is not there
                Err(error) => {
                    assert!(*name == "daylight" && error.to_string().contains("panorama"), "{error}")
                }
            }
        }
    }

    #[test]
    fn light_is_polarised_unless_the_scene_or_the_cast_says() {
        let scalar = format!("polarisation = false\n{}", SCENES[0].1);
        for (text, asked, polarised) in [
            (SCENES[0].1, None, true),
            (SCENES[0].1, Some(false), false),
            (&*scalar, None, false),
            (&*scalar, Some(true), true),
        ] {
            let file = SceneFile::parse("t", "t.toml", text, Path::new("")).expect("is sound");
            let cast = SceneOverrides { polarisation: asked, ..SceneOverrides::default() };
            let scene = file.build(&cast, 1.0).expect("is set up");
            assert!(scene.stones.iter().all(|s| s.polarised == polarised));
        }
    }

    #[test]
    fn only_a_plate_alone_does_not_shine_on_itself() {
        let indirect = |name| {
            preset(name).expect("in the catalogue").expect("is sound").build(&SceneOverrides::default(), 1.0)
        };
        assert!(!indirect("table").expect("is set up").has_indirect_light());
        assert!(indirect("cornell").expect("is set up").has_indirect_light());
    }

    #[test]
    fn errors_name_the_line() {
        let good = SCENES[0].1;
        let line = |text: &str| good.lines().position(|l| l.contains(text)).map(|i| i + 1).expect("is there");
        for (from, to, says) in [
            ("kind = \"square\"", "kind = \"cube\"", "kind 'cube' is not one of square, disc"),
            ("unit = \"stone\"", "unit = \"furlong\"", "furlong"),
            ("reflectance = 0.45", "reflectance = 1.45", "between 0 and 1"),
            ("pose = \"lying\"", "pose = \"asleep\"", "table-up"),
            ("radiance = 2.4", "radiance = -1", "above 0"),
            ("field = 34", "feild = 34", "'feild' is not known here"),
        ] {
            let text = good.replacen(from, to, 1);
            assert_ne!(text, good, "{from} is in the table's file");
            let error = SceneFile::parse("t", "t.toml", &text, Path::new(""))
                .and_then(|f| f.build(&SceneOverrides::default(), 1.0))
                .expect_err(to)
                .to_string();
            let place = format!("t.toml, line {}:", line(from));
            assert!(error.starts_with(&place) && error.contains(says), "{error}, not {place} {says}");
        }
    }
}
