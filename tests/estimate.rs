//! The radiance estimate has no bias, however few photons it gathers.

use cutlab::math::random::{Purpose, Stream};
use cutlab::optics::colour::BANDS;
use cutlab::photons::map::PhotonMap;
use cutlab::photons::{Photon, Shot};
use cutlab::scene::{Cast, Scene, SceneFile};
use glam::Vec3;
use std::path::Path;

const SEED: u64 = 20_262;

/// A plate of side 2 about the origin, under a lamp.
fn plate() -> Scene {
    let text = r#"
        unit = "mm"
        camera = { at = [0, 0, 9], field = 20 }
        surface = [{ corner = [-1, -1, 0], u = [2, 0, 0], v = [0, 2, 0], reflectance = 0.5 }]
        light = [{ kind = "sphere", at = [0, 0, 5], radius = 0.1, radiance = 1 }]
    "#;
    let file = SceneFile::parse("plate", "plate.toml", text, Path::new("")).expect("is sound");
    file.build(&Cast::default(), 1.0).expect("is set up")
}

/// Photons at random places of the plate, of powers from 0 to 2, that make an irradiance of 1.
fn even_light(n: usize) -> Shot {
    let mut stream = Stream::new(SEED, Purpose::Test, 0);
    let mut photon = || {
        let [x, y] = stream.pair().map(|u| 2.0 * u - 1.0);
        let power = 2.0 * stream.unit() * 4.0 / n as f32;
        Photon { point: Vec3::new(x, y, 0.0), power, tint: [255; BANDS], surface: 0 }
    };
    Shot { photons: (0..n).map(|_| photon()).collect(), emitted: n as u64 }
}

/// [D] Even light is as bright on average as it is, also where estimates gather a handful of photons
/// and are seen at places that the photons themselves chose.
#[test]
fn even_light_is_as_bright_as_it_is() {
    let scene = plate();
    let n = 100_000;
    for nearest in [4, 10, 30, 100, 1000] {
        let map = PhotonMap::new(&scene, even_light(n), nearest);
        let mut stream = Stream::new(SEED, Purpose::Test, 1);
        let seen = 40_000;
        let (mut mean, mut nearby) = (0.0f64, 0.0f64);
        for _ in 0..seen {
            let [x, y] = stream.pair().map(|u| 2.0 * u - 1.0);
            let at = Vec3::new(x, y, 0.0);
            mean += f64::from(map.irradiance(0, at).0[3]) / f64::from(seen);
            nearby += f64::from(map.irradiance_nearby(0, at)[3]) / f64::from(seen);
        }
        println!("{nearest} photons: {mean:.4}, nearby {nearby:.4}");
        // photons' number and powers √(4/3 / n) = .4 %, and what is seen of estimates of few
        assert!((mean - 1.0).abs() < 0.02 && (nearby - 1.0).abs() < 0.02, "{nearest}: {mean} {nearby}");
    }
}

/// Two photons have no estimate, a handful has one.
#[test]
fn few_photons() {
    let scene = plate();
    for n in 0..10 {
        let map = PhotonMap::new(&scene, even_light(n), 500);
        let here = map.irradiance(0, Vec3::ZERO).0[3];
        assert!(here.is_finite() && (here == 0.0 || n > 2), "{n}: {here}");
        assert!(here > 0.0 || n < 8, "{n}: {here}");
    }
}
