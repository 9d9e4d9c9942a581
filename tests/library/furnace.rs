//! Light goes both ways: in even light everything has its radiance, in a closed room all light that is sent
//! out is absorbed, and what no light reaches is dark; over plates, meshes, mirrors, every kind of light and
//! every scene of the catalogue.

use cutlab::advanced::color::Illuminant;
use cutlab::advanced::integrators::{self, Film, PhotonMaps, Tone};
use cutlab::advanced::photons::{PhotonSets, PhotonSettings};
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::scene::bsdfs::diffuse::Diffuse;
use cutlab::advanced::scene::intersection::SurfacePoint;
use cutlab::advanced::scene::lights::LIGHTS;
use cutlab::advanced::scene::lights::dome::Dome;
use cutlab::advanced::scene::surface::Shape;
use cutlab::advanced::scene::{Light, Reflectance, SCENES, Scene, SceneFile, SceneOverrides, preset};
use glam::Vec3;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

const SEED: u64 = 20_263;

/// Corners of a box, and its twelve triangles as seen from outside.
fn boxed(low: Vec3, high: Vec3) -> String {
    let mut obj = String::new();
    for i in 0..8 {
        let side = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
        writeln!(obj, "v {} {} {}", side(0), side(1), side(2)).expect("into a string");
    }
    for [a, b, c, d] in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        writeln!(obj, "f {a} {b} {c}\nf {a} {c} {d}").expect("into a string");
    }
    obj
}

fn build(text: &str, folder: &Path) -> Scene {
    let file = SceneFile::parse("t", "t.toml", text, folder).expect(text);
    file.build(&SceneOverrides::default(), 4.0 / 3.0).expect(text)
}

fn photons(photons: usize) -> PhotonSettings {
    PhotonSettings { photons, nearest: 200, seed: SEED }
}

fn picture(scene: &Scene, shots: PhotonSets) -> Film {
    let maps = PhotonMaps::new(scene, shots, 200);
    let tone = Tone::default();
    let settings = integrators::RenderSettings {
        width: 32,
        height: 24,
        samples_per_pixel: 9,
        round: 0,
        tone,
        seed: SEED,
    };
    integrators::render(scene, &scene.camera, &maps, &settings, &|| ())
}

/// [D] A stone on a white floor or a mirror under an even sky is not to be seen, and nor is the floor.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn in_even_light_everything_is_as_bright() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).expect("written");
    write("slab.obj", boxed(Vec3::new(-80.0, -80.0, -0.05), Vec3::new(80.0, 80.0, 0.0)));
    write("sheet.obj", "v -80 -80 0\nv 80 -80 0\nv 80 80 0\nv -80 80 0\nf 1 2 3\nf 1 3 4\n".into());
    write("under.obj", "v -80 -80 0\nv 80 -80 0\nv 80 80 0\nv -80 80 0\nf 1 3 2\nf 1 4 3\n".into());
    let plate = "corner = [-80, -80, 0], u = [160, 0, 0], v = [0, 160, 0], reflectance = 1";
    let one = "{ kind = 'dome', radiance = 0.5 }";
    let two = "{ kind = 'dome', radiance = 0.2 }, { kind = 'dome', radiance = 0.3 }";
    for (name, surfaces) in [
        ("nothing", String::new()),
        ("plate", format!("{{ {plate} }}")),
        ("mirror", format!("{{ {plate}, mirror = true }}")),
        ("sheet", "{ mesh = 'sheet.obj', reflectance = 1 }".into()),
        ("sheet, its back up", "{ mesh = 'under.obj', reflectance = 1 }".into()),
        ("slab", "{ mesh = 'slab.obj', reflectance = 1 }".into()),
        ("mirror of two triangles", "{ mesh = 'under.obj', reflectance = 1, mirror = true }".into()),
        (
            "plate and a white card with its back to the stone",
            format!(
                "{{ {plate} }}, {{ corner = [-4, 4, 0.1], u = [0, 0, 6], v = [8, 0, 0], reflectance = 1 }}"
            ),
        ),
        (
            "plate and the back of a mirror",
            format!(
                "{{ {plate} }}, {{ corner = [4, 5, 0.1], u = [-8, 0, 0], v = [0, 0, 6], reflectance = 1, mirror = true }}"
            ),
        ),
    ] {
        // two lamps in place of one: where shadow rays and photons find them, and where a mirror does
        for sky in if matches!(name, "plate" | "mirror") { vec![one, two] } else { vec![one] } {
            let text = format!(
                "unit = 'mm'\ncamera = {{ at = [0, -18, 12], to = [0, 0, 0.5], field = 18 }}\n\
                 stone = [{{ cut = 'tolkowsky', pose = 'table-up', size = 2 }}]\n\
                 surface = [{surfaces}]\nlight = [{sky}]\n"
            );
            let scene = build(&text, folder.path());
            let film = picture(&scene, PhotonSets::emit(&scene, &photons(60_000)));
            let light = film.linear(None);
            let mean = light.iter().sum::<Vec3>() / light.len() as f32;
            let middle: Vec3 =
                (0..12 * 16).map(|i| light[(6 + i / 16) * 32 + 8 + i % 16]).sum::<Vec3>() / 192.0;
            println!("{name}: {mean} {middle}");
            assert!((mean - 0.5).abs().max_element() < 0.01, "{name}: {mean}");
            assert!((middle - 0.5).abs().max_element() < 0.02, "{name}: {middle}");
        }
    }
}

/// Light on both sides of all surfaces, its mean over the bands: direct light by four shadow rays at each
/// place, the rest from maps.
///
/// - `counts`: whether a place and the normal of its side count
fn fallen(scene: &Scene, counts: impl Fn(Vec3, Vec3) -> bool) -> f64 {
    let shots = PhotonSets::emit(scene, &photons(200_000));
    let maps = PhotonMaps::new(scene, shots, 200);
    let mut stream = Stream::new(SEED, Purpose::TEST, 0);
    let mut sum = 0.0;
    for (surface, shape) in scene.surfaces.iter().map(|s| &s.shape).enumerate() {
        let patches: Vec<(Vec3, Vec3, Vec3, bool)> = match shape {
            Shape::Quad(p) => vec![(p.corner, p.u, p.v, false)],
            Shape::Mesh(m) => m.triangles().map(|[a, b, c]| (a, b - a, c - a, true)).collect(),
        };
        for (corner, u, v, triangle) in patches {
            let area = u.cross(v).length() * if triangle { 0.5 } else { 1.0 };
            // one place in each cell of a grid: the lamp is near a wall, which has most of the light
            const SIDE: usize = 24;
            let n = SIDE * SIDE;
            for front in [true, false] {
                let normal = u.cross(v).normalize() * if front { 1.0 } else { -1.0 };
                for cell in 0..n {
                    let [s, t] = stream.pair();
                    let mut s = ((cell % SIDE) as f32 + s) / SIDE as f32;
                    let mut t = ((cell / SIDE) as f32 + t) / SIDE as f32;
                    if triangle && s + t > 1.0 {
                        (s, t) = (1.0 - s, 1.0 - t);
                    }
                    if !counts(corner + u * s + v * t, normal) {
                        continue;
                    }
                    let at = SurfacePoint { surface, point: corner + u * s + v * t, normal, front };
                    let direct: f32 = (0..scene.lights.len())
                        .map(|i| {
                            let places = [stream.pair(), stream.pair(), stream.pair(), stream.pair()];
                            scene.lights[i].radiance_at(scene.direct_irradiance(i, &at, places), 560.0)
                        })
                        .sum();
                    let maps = maps.caustic.irradiance(&at).0[3] + maps.indirect.irradiance(&at).0[3];
                    sum += f64::from((direct + maps) * area) / n as f64;
                }
            }
        }
    }
    sum
}

/// All of one grey, and every lamp of equal energy; the power of the lamps, none where one is at infinity.
fn greyed(scene: &mut Scene, grey: f32) -> Option<f64> {
    scene.surfaces.iter_mut().for_each(|s| s.finish = Arc::new(Diffuse(Reflectance::Grey(grey))));
    for light in &mut scene.lights {
        light.spectrum = Illuminant::equal_energy();
        light.radiance = Vec3::splat(light.radiance.element_sum() / 3.0);
    }
    let power = |light: &Light| Some(f64::from(light.emitter.power()? * light.radiance_at(Vec3::ONE, 560.0)));
    scene.lights.iter().map(power).sum()
}

/// [D] In a closed room of albedo ρ all light that falls on walls is Φ/(1 − ρ), whatever lamp sends it, and
/// no light comes in from outside. The lamp takes in a little.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn a_closed_grey_room_balances_under_every_light() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let room = boxed(Vec3::splat(-2.0), Vec3::splat(2.0));
    std::fs::write(folder.path().join("room.obj"), room).expect("written");
    let mut plates = String::new();
    for axis in 0..3 {
        for (side, front) in [(-2.0, true), (2.0, false)] {
            let (mut corner, mut u, mut v) = ([-2.0; 3], [0.0; 3], [0.0; 3]);
            (corner[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (side, 4.0, 4.0);
            // some walls show their backs to the room: for light it is the same
            let (u, v) = if front || axis == 1 { (u, v) } else { (v, u) };
            writeln!(plates, "{{ corner = {corner:?}, u = {u:?}, v = {v:?}, reflectance = 0.5 }},")
                .expect("written");
        }
    }
    for (i, walls) in [&*plates, "{ mesh = 'room.obj', reflectance = 0.5 }"].into_iter().enumerate() {
        // every light in one of the rooms, the first in both
        for (_, kind) in LIGHTS.iter().enumerate().filter(|(k, _)| *k == 0 || k % 2 == i) {
            let entry = match kind.name {
                "square" => "side = 0.3",
                "disc" => "radius = 0.15",
                "sphere" => "radius = 0.15",
                "spot" => "radius = 0.15, cone = 50",
                "dome" => "turn = [0, 0, 30]",
                "sky" | "sun" => "sun-elevation = 40, sun-azimuth = 20",
                other => panic!("no entry of a {other} is known here"),
            };
            let placed = match kind.name {
                "dome" | "sky" | "sun" => "",
                "sphere" => "at = [0.4, 0.2, 1.5],",
                _ => "at = [0.4, 0.2, 1.5], to = [0, 0, 0],",
            };
            let text = format!(
                "unit = 'mm'\ncamera = {{ at = [0, -1.9, 0], to = [0, 0, 0], field = 60 }}\n\
                 stone = [{{ cut = 'octahedron', pose = 'table-up', radius = 0.5, at = [0, 0, -1] }}]\n\
                 surface = [{walls}]\nlight = [{{ kind = '{}', {placed} {entry}, radiance = 10 }}]\n",
                kind.name
            );
            let mut scene = build(&text, folder.path());
            let power = greyed(&mut scene, 0.5);
            let fallen = fallen(&scene, |place, normal| place.dot(normal) < 0.0);
            println!("{}: {fallen:.4} of {power:.4?}", kind.name);
            match power {
                Some(power) => assert!((0.975..1.01).contains(&(fallen / (2.0 * power))), "{}", kind.name),
                None => assert_eq!(fallen, 0.0, "{}", kind.name),
            }
        }
    }
}

/// [D] No scene of the catalogue gains light: its surfaces absorb no more than its lamps send out, and
/// under an even sky nothing is brighter than the sky; what stands open and is white is as bright.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn no_scene_gains_light() {
    let mut wrong = Vec::new();
    for (name, _) in SCENES {
        let file = preset(name).expect("in the catalogue").expect(name);
        let Ok(mut scene) = file.build(&SceneOverrides::default(), 4.0 / 3.0) else {
            assert_eq!(*name, "daylight", "its panorama is the user's");
            continue;
        };
        let grey = 0.5;
        if let Some(power) = greyed(&mut scene, grey).filter(|_| !scene.surfaces.is_empty()) {
            let absorbed = fallen(&scene, |_, _| true) * f64::from(1.0 - grey);
            println!("{name}: absorbed {:.3} of the light", absorbed / power);
            assert!(absorbed < 1.02 * power, "{name}: {absorbed} of {power}");
            // what falls on its window and lamps they take in
            assert!(*name != "office" || absorbed > 0.85 * power, "{name} is closed: {absorbed} of {power}");
        }
        let white = if *name == "office" { 0.8 } else { 1.0 };
        scene.surfaces.iter_mut().for_each(|s| s.finish = Arc::new(Diffuse(Reflectance::Grey(white))));
        scene.lights = vec![Light::white(Dome::uniform(), 0.5)];
        scene.camera.white = Illuminant::equal_energy();
        let film = picture(&scene, PhotonSets::emit(&scene, &photons(100_000)));
        let light = film.linear(None);
        let mean = light.iter().sum::<Vec3>() / light.len() as f32;
        println!("{name}: {mean}");
        let expected = if *name == "office" { 0.0 } else { 0.5 };
        // what a reflection loses at edges and corners counts once for each of the many in a white box
        if mean.max_element() > expected + 0.0075 || mean.min_element() < 0.95 * expected {
            wrong.push(format!("{name}: {mean}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// [D] What is lit from above is dark below, whatever it is made of.
#[test]
fn a_sheet_lit_from_above_is_black_below() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).expect("written");
    write("slab.obj", boxed(Vec3::new(-9.0, -9.0, -0.02), Vec3::new(9.0, 9.0, 0.0)));
    write("sheet.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3\nf 1 3 4\n".into());
    let twin = "{ corner = [-9, -9, 0], u = [18, 0, 0], v = [0, 18, 0], reflectance = 0.8 }, \
                { corner = [-9, -9, -0.005], u = [0, 18, 0], v = [18, 0, 0], reflectance = 0.8 }";
    for surfaces in
        [twin, "{ mesh = 'sheet.obj', reflectance = 0.8 }", "{ mesh = 'slab.obj', reflectance = 0.8 }"]
    {
        for lamps in [
            "{ kind = 'square', at = [0, 0, 20], to = [0, 0, 0], side = 2, radiance = 50 }",
            "{ kind = 'sun', sun-elevation = 50, sun-azimuth = 0, radiance = 1 }",
        ] {
            let text = format!(
                "unit = 'mm'\ncamera = {{ at = [0, -6, -9], to = [0, 0, 0], field = 18 }}\n\
                 stone = [{{ cut = 'tolkowsky', size = 2 }}]\nsurface = [{surfaces}]\nlight = [{lamps}]\n"
            );
            let scene = build(&text, folder.path());
            let film = picture(&scene, PhotonSets::emit(&scene, &photons(20_000)));
            let brightest = film.linear(None).iter().fold(Vec3::ZERO, |a, p| a.max(*p));
            assert_eq!(brightest, Vec3::ZERO, "{surfaces} {lamps}");
        }
    }
}
