//! A room with a stone, as the text of a scene file, for tests of scenes and of what their pictures show.

#![allow(dead_code)] // each test file uses its part

use cutlab::advanced::integrators::{self, PhotonMaps, Tone, ToneCurve};
use cutlab::advanced::photons::{self, PhotonSets};
use cutlab::advanced::scene::{Scene, SceneFile, SceneOverrides};
use std::path::Path;

pub const SMALL: [&str; 8] = ["--width", "16", "--spp", "1", "--photons", "200", "--nearest", "10"];

pub const ROOM: &str = r#"unit = "mm"
picture = [16, 12]
[camera]
at = [0, -36, 20]
field = 40
[[stone]]
cut = "cube"
pose = "table-up"
size = 6
[[surface]]
corner = [-50, -50, 0]
u = [100, 0, 0]
v = [0, 100, 0]
reflectance = [0.5, 0.4, 0.3]
[[light]]
kind = "square"
at = [8, -8, 20]
side = 4
radiance = 9
colour = [1, 0.9, 0.8]
[[light]]
kind = "dome"
radiance = 0.1
"#;

pub fn built(text: &str) -> Result<Scene, String> {
    let file = SceneFile::parse("t", "t.toml", text, Path::new("")).map_err(|e| e.to_string())?;
    file.build(&SceneOverrides::default(), 4.0 / 3.0).map_err(|e| e.to_string())
}

pub fn taken(scene: &Scene, side: u32) -> integrators::Film {
    let photons = photons::PhotonSettings { photons: 100, nearest: 10, seed: 1 };
    let maps = PhotonMaps::new(scene, PhotonSets::emit(scene, &photons), photons.nearest);
    let tone = Tone { curve: ToneCurve::Linear, ..Tone::default() };
    let settings = integrators::RenderSettings {
        width: side,
        height: side,
        samples_per_pixel: 9,
        round: 0,
        tone,
        seed: 1,
    };
    integrators::render(scene, &scene.camera, &maps, &settings, &|| ())
}
