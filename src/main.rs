use cutlab::*;
use std::collections::BTreeMap;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let preset = scene::Preset::named(&a[1]).unwrap();
    let w: u32 = a[2].parse().unwrap();
    let h: u32 = a[3].parse().unwrap();
    let spp: u32 = a[4].parse().unwrap();
    let d = cut::library::design(preset.default_stone, &BTreeMap::new()).unwrap().unwrap();
    let stone = walk::Stone::new(d.solid().unwrap());
    let scene = (preset.build)(
        stone,
        optics::Material::named("diamond").unwrap().clone(),
        preset.default_pose,
        w as f32 / h as f32,
    );
    let t = std::time::Instant::now();
    let ps = photons::Settings { photons: 100_000, nearest: 500, seed: 1 };
    let shots = photons::Shots::shoot(&scene, &ps);
    eprintln!(
        "shots {:?} caustic {} of {} indirect {} of {}",
        t.elapsed(),
        shots.caustic.photons.len(),
        shots.caustic.emitted,
        shots.indirect.photons.len(),
        shots.indirect.emitted
    );
    let maps = render::tracer::Maps {
        caustic: photons::map::PhotonMap::new(&scene, &shots.caustic, 500),
        indirect: photons::map::PhotonMap::new(&scene, &shots.indirect, 500),
    };
    eprintln!("maps {:?}", t.elapsed());
    let film = render::render(
        &scene,
        &scene.camera,
        &maps,
        &render::Settings { width: w, height: h, rays: spp, seed: 1 },
        &|| (),
    );
    eprintln!("film {:?}", t.elapsed());
    for (p, n) in render::Pass::ALL {
        store::replace::write(
            format!("/tmp/r/{}-{n}.png", a[1]).as_ref(),
            &render::tone::png(&film, Some(p), 0.0).unwrap(),
        )
        .unwrap();
    }
    store::replace::write(
        format!("/tmp/r/{}.png", a[1]).as_ref(),
        &render::tone::png(&film, None, 0.0).unwrap(),
    )
    .unwrap();
}
