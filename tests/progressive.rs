//! Progressive pictures: they converge to what one picture of many photons shows, by as much as they say.

use cutlab::cut::library;
use cutlab::photons::{self, Shots};
use cutlab::render::{self, Maps, Progressive, Tone};
use cutlab::scene::{Cast, Scene, preset};
use glam::Vec3;
use std::collections::BTreeMap;

const SEED: u64 = 20_261;

fn table() -> Scene {
    let design =
        library::design("round-brilliant", &BTreeMap::new()).expect("in the library").expect("builds");
    let cast = Cast { designs: vec![design], ..Cast::default() };
    preset("table").expect("in the catalogue").expect("is sound").build(&cast, 4.0 / 3.0).expect("is set up")
}

fn settings(rays: u32) -> render::Settings {
    render::Settings { width: 40, height: 30, rays, round: 0, tone: Tone::default(), seed: SEED }
}

fn mean(film: &render::Film) -> Vec3 {
    let light = film.linear(None);
    light.iter().sum::<Vec3>() / light.len() as f32
}

/// [C] The mean of many rounds of few photons is the picture of many photons; the noise that it
/// states falls as rounds go on.
#[test]
fn rounds_converge_to_the_plain_picture() {
    let scene = table();
    let many = photons::Settings { photons: 100_000, nearest: 200, seed: SEED };
    let maps = Maps::new(&scene, Shots::shoot(&scene, &many), many.nearest);
    let plain = render::render(&scene, &scene.camera, &maps, &settings(64), &|| ());
    let few = photons::Settings { photons: 3_000, nearest: 60, seed: SEED };
    let mut picture = Progressive::new(&scene, &scene.camera, settings(1), few);
    let mut noise = Vec::new();
    for _ in 0..64 {
        picture.round(&|| ());
        noise.push(picture.noise());
    }
    assert!(noise[0].is_infinite() && noise[63] < 0.5 * noise[7], "{noise:?}");
    let (a, b) = (mean(&plain), mean(picture.film()));
    assert!((a - b).abs().max_element() < 0.03 * a.max_element(), "{a} {b}");
}

/// The same rounds give the same picture on any number of threads.
#[test]
fn rounds_do_not_depend_on_threads() {
    let scene = table();
    let few = photons::Settings { photons: 1_000, nearest: 30, seed: SEED };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut picture = Progressive::new(&scene, &scene.camera, settings(1), few);
            (0..3).for_each(|_| picture.round(&|| ()));
            picture.film().clone()
        })
    };
    assert_eq!(on(1), on(5));
}

/// A picture put where another was goes on as that would have; a state of another form is refused.
#[test]
fn a_picture_goes_on_from_its_state() {
    let scene = table();
    let few = photons::Settings { photons: 1_000, nearest: 30, seed: SEED };
    let new = || Progressive::new(&scene, &scene.camera, settings(1), few);
    let mut whole = new();
    (0..2).for_each(|_| whole.round(&|| ()));
    let (state, noise) = (whole.state(), whole.noise());
    let mut later = new();
    assert!(!later.go_on_from(&state[1..]) && !later.go_on_from(&[]));
    assert!(later.go_on_from(&state));
    assert_eq!((later.rounds(), later.noise(), later.film()), (2, noise, whole.film()));
    for picture in [&mut whole, &mut later] {
        (0..2).for_each(|_| picture.round(&|| ()));
    }
    assert_eq!((later.film(), later.noise()), (whole.film(), whole.noise()));
}
