//! Every instruction set of this machine gives the same scores, pictures and total of light within
//! three standard errors.

mod brilliants;

use brilliants::{SEED, diamond, named};
use cutlab::cut::{Design, library};
use cutlab::experiments::view::{Sky, Surroundings};
use cutlab::experiments::{
    Aspect, Beam, Contrast, Experiment, Hemisphere, Iso, Medium, Scintillation, Traced, View, cells, iso,
    view,
};
use cutlab::math::stats::Estimate;
use cutlab::metrics::{METRICS, Reading, Statistic};
use cutlab::optics::Material;
use cutlab::photons::{Settings, Shots};
use cutlab::render::{self, Maps, Tone};
use cutlab::scene::{Cast, PlacedStone, preset};
use cutlab::walk::{Isa, Stone};
use std::collections::BTreeMap;

const SAMPLES: u64 = 1 << 15;

/// The other instruction sets of this machine; says so if there are none.
fn others() -> Vec<Isa> {
    let others: Vec<Isa> = Isa::all().into_iter().filter(|isa| *isa != Isa::PORTABLE).collect();
    if others.is_empty() {
        println!("skipped: this machine has one instruction set");
    }
    others
}

fn cut(name: &str) -> Design {
    library::design(name, &BTreeMap::new()).expect("in the library").expect("builds")
}

/// Name, score, and score by batch.
type Scores = Vec<(String, Estimate, Vec<f64>)>;

fn take<E: Experiment>(
    scores: &mut Scores,
    experiment: E,
    samples: u64,
    of: impl Fn(Reading) -> Option<Statistic<E::Tally>>,
) {
    let mut traced = Traced::new(experiment, SEED);
    traced.extend_to(samples);
    for metric in METRICS {
        let Some(of) = of(metric.reading) else { continue };
        // a cut without a table has no scores of one, on every set
        let Some(score) = traced.score(&of) else { continue };
        let batches = traced.tallies().iter().map(|t| of.of(t)).collect();
        scores.push((metric.name.into(), score, batches));
    }
}

/// Every score that is traced.
fn scores(design: &Design, material: &Material, isa: Isa) -> Scores {
    let stone = &Stone::with_isa(design.solid().expect("closed"), isa);
    let medium = &Medium { material, polarised: true };
    let up = Aspect::FACE_UP;
    let around = Surroundings { scope: Sky::behind(view::SCOPE_DEG), dome: Sky::behind(view::OBSERVER_DEG) };
    let (head, dark) = (Sky::behind(iso::OBSERVER_DEG), Sky::behind(cells::OBSERVER_DEG));
    let mut all = Scores::new();
    let dome = Hemisphere::seen_from(stone, medium, up).expect("can be lit");
    take(&mut all, dome, SAMPLES, |r| if let Reading::Hemisphere(f) = r { Some(f) } else { None });
    let eye = View::seen_from(stone, medium, up, around).expect("can be seen");
    take(&mut all, eye, SAMPLES, |r| if let Reading::View(f) = r { Some(f) } else { None });
    let iso = Iso::seen_from(stone, medium, up, head).expect("can be seen");
    take(&mut all, iso, SAMPLES, |r| if let Reading::Iso(f) = r { Some(f) } else { None });
    let cells = Contrast::seen_from(stone, medium, up, dark).expect("can be seen");
    take(&mut all, cells, SAMPLES / 2, |r| if let Reading::Contrast(f) = r { Some(f) } else { None });
    let rocking = Scintillation::seen_from(stone, medium, up, dark).expect("can be seen");
    take(&mut all, rocking, SAMPLES / 4, |r| if let Reading::Scintillation(f) = r { Some(f) } else { None });
    let beam = Beam::seen_from(stone, medium, up).expect("can be lit");
    take(&mut all, beam, SAMPLES / 4, |r| if let Reading::Beam(f) = r { Some(f) } else { None });
    all
}

/// Mean of the differences between two lists, and its standard error.
fn difference(a: &[f64], b: &[f64]) -> (f64, f64) {
    let off: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).filter(|d| d.is_finite()).collect();
    let n = off.len() as f64;
    let mean = off.iter().sum::<f64>() / n;
    let squares = off.iter().map(|d| (d - mean).powi(2)).sum::<f64>();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn every_score_agrees_within_three_errors() {
    let ruby = Material::named("ruby").expect("in the catalogue").clone();
    let stones = [
        ("reference", named("reference"), diamond()),
        ("asscher", cut("asscher"), diamond()),
        ("octahedron", cut("octahedron"), diamond()),
        ("ruby", named("reference").sized(6.0).expect("sized"), ruby),
    ];
    for (stone, design, material) in &stones {
        let portable = scores(design, material, Isa::PORTABLE);
        for isa in others() {
            let mut worst = (0.0, String::new());
            for ((name, a, theirs), (_, b, ours)) in portable.iter().zip(scores(design, material, isa)) {
                let error = a.error.min(b.error);
                let off = (a.value - b.value).abs();
                // what is exact has roundings alone
                assert!(off <= 3.0 * error + 1e-6, "{stone} {name} {}: {a:?} {b:?}", isa.name());
                // the same random numbers: what is left are roundings that no batch prefers
                let (mean, of_mean) = difference(theirs, &ours);
                let times = mean.abs() / (of_mean + 1e-6);
                if times > worst.0 {
                    worst =
                        (times, format!("{name}, {mean:.1e} ± {of_mean:.1e} where one error is {error:.1e}"));
                }
            }
            println!("{stone}, {}: {} scores; farthest {}", isa.name(), portable.len(), worst.1);
        }
    }
}

/// Brightness of a picture of the brilliant on the table, by blocks of pixels.
fn picture(scene: &str, isa: Isa) -> Vec<f64> {
    let cast = Cast { designs: vec![named("reference")], material: Some(diamond()), ..Cast::default() };
    let mut scene = preset(scene).expect("in the catalogue").expect("is sound").build(&cast, 4.0 / 3.0);
    let scene = scene.as_mut().expect("is set up");
    let on =
        |p: &PlacedStone| PlacedStone { stone: Stone::with_isa(p.stone.solid.clone(), isa), ..p.clone() };
    scene.stones = scene.stones.iter().map(on).collect();
    let shots = Shots::shoot(scene, &Settings { photons: 20_000, nearest: 100, seed: SEED });
    let settings =
        render::Settings { width: 64, height: 48, rays: 9, round: 0, tone: Tone::default(), seed: SEED };
    let film = render::render(scene, &scene.camera, &Maps::new(scene, shots, 100), &settings, &|| ());
    let shown = film.linear(None);
    let block = |b: usize| {
        let (x, y) = (8 * (b % 8), 8 * (b / 8));
        let sum = |row: usize| shown[row * 64 + x..][..8].iter().map(|p| f64::from(p.y)).sum::<f64>();
        (y..y + 8).map(sum).sum::<f64>() / 64.0
    };
    (0..48).map(block).collect()
}

#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn pictures_agree_within_three_errors() {
    for scene in ["table", "cornell"] {
        let portable = picture(scene, Isa::PORTABLE);
        let mean = portable.iter().sum::<f64>() / portable.len() as f64;
        for isa in others() {
            let (off, error) = difference(&portable, &picture(scene, isa));
            println!("{scene}, {}: {off:.1e} ± {error:.1e} of {mean:.3}", isa.name());
            assert!(off.abs() <= 3.0 * error + 1e-6 * mean, "{scene} {}: {off} ± {error}", isa.name());
            assert!(error < 0.01 * mean, "too noisy to tell");
        }
    }
}
