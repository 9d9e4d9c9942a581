//! The radiance estimate has no bias, however few photons it gathers.

use cutlab::math::random::{Purpose, Stream};
use cutlab::optics::colour::BANDS;
use cutlab::photons::map::PhotonMap;
use cutlab::photons::{Photon, Shot};
use cutlab::scene::{Cast, Scene, SceneFile};
use cutlab::transport::SurfacePoint;
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

/// A place on the front of the plate.
fn on_plate(x: f32, y: f32) -> SurfacePoint {
    SurfacePoint { surface: 0, point: Vec3::new(x, y, 0.0), normal: Vec3::Z, front: true }
}

/// Photons at random places of the plate, of powers from 0 to 2, that make an irradiance of 1.
fn even_light(n: usize) -> Shot {
    let mut stream = Stream::new(SEED, Purpose::Test, 0);
    let mut photon = || {
        let [x, y] = stream.pair().map(|u| 2.0 * u - 1.0);
        let power = 2.0 * stream.unit() * 4.0 / n as f32;
        Photon::new(&on_plate(x, y), &[power; BANDS])
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
            let at = on_plate(x, y);
            mean += f64::from(map.irradiance(&at).0[3]) / f64::from(seen);
            nearby += f64::from(map.irradiance_nearby(&at)[3]) / f64::from(seen);
        }
        println!("{nearest} photons: {mean:.4}, nearby {nearby:.4}");
        // photons' number and powers √(4/3 / n) = .4 %, and what is seen of estimates of few
        assert!((mean - 1.0).abs() < 0.02 && (nearby - 1.0).abs() < 0.02, "{nearest}: {mean} {nearby}");
    }
}

/// However few the photons, their light is all there, and a side without any is dark.
#[test]
fn few_photons() {
    let scene = plate();
    for n in 0..10 {
        let shot = even_light(n);
        let power: f32 = shot.photons.iter().map(|p| p.power).sum();
        let map = PhotonMap::new(&scene, shot, 500);
        let grid = 40;
        let middle = |i: usize| (i as f32 + 0.5) / grid as f32 * 2.0 - 1.0;
        let places = (0..grid * grid).map(|i| on_plate(middle(i % grid), middle(i / grid)));
        let seen: f32 = places.map(|at| map.irradiance(&at).0[3] * 4.0 / (grid * grid) as f32).sum();
        assert!((seen - power).abs() <= 0.01 * power, "{n}: {seen} {power}");
        let below = SurfacePoint { normal: -Vec3::Z, front: false, ..on_plate(0.0, 0.0) };
        assert_eq!(map.irradiance(&below).0, [0.0; BANDS]);
    }
}
