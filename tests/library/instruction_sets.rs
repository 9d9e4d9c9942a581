//! Every instruction set of this machine gives the same scores, pictures and total of light within
//! three standard errors.

use crate::brilliants::{SEED, diamond, named};
use cutlab::advanced::design::{Design, library};
use cutlab::advanced::estimators::view::{ObserverDome, ViewerLighting};
use cutlab::advanced::estimators::{
    BatchedEstimate, Contrast, Estimator, EstimatorKind, FaceterView, Hemisphere, PointLight, Scintillation,
    TraceOptics, View, ViewFrame, contrast, faceter_view, hemisphere, pixel_cells, point_light,
    scintillation, view, view_metrics,
};
use cutlab::advanced::integrators::{self, PhotonMaps, Tone};
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::MetricSource;
use cutlab::advanced::photons::{PhotonSets, PhotonSettings};
use cutlab::advanced::sampling::stats::Estimate;
use cutlab::advanced::scene::{PlacedStone, SceneOverrides, preset};
use cutlab::advanced::trace::{ConvexStone, Isa};
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

fn take(scores: &mut Scores, kind: &dyn EstimatorKind, estimator: impl Estimator, samples: u64) {
    let mut traced = BatchedEstimate::new(estimator, SEED);
    traced.extend_to(samples);
    for metric in kind.metrics() {
        let MetricSource::Sums(of) = metric.read_from else { continue };
        // a cut without a table has no scores of one, on every set
        let Some(score) = traced.score(&of) else { continue };
        let batches = traced.tallies().iter().map(|t| of.value(t)).collect();
        scores.push((metric.name.into(), score, batches));
    }
}

/// Every score that is traced.
fn scores(design: &Design, material: &Material, isa: Isa) -> Scores {
    let stone = &ConvexStone::with_isa(design.solid().expect("closed"), isa);
    let medium = &TraceOptics { material, polarised: true };
    let up = ViewFrame::FACE_UP;
    let around = ViewerLighting {
        scope: ObserverDome::with_observer(view::SCOPE_DEG),
        dome: ObserverDome::with_observer(view::GIA_OBSERVER_DEG),
    };
    let (head, dark) = (
        ObserverDome::with_observer(faceter_view::GEMRAY_OBSERVER_DEG),
        ObserverDome::with_observer(pixel_cells::AGS_OBSERVER_DEG),
    );
    let mut all = Scores::new();
    let dome = Hemisphere::in_frame(stone, medium, up).expect("can be lit");
    take(&mut all, &hemisphere::HemisphereKind, dome, SAMPLES);
    let eye = View::in_frame(stone, medium, up, around).expect("can be seen");
    take(&mut all, &view_metrics::ViewKind, eye, SAMPLES);
    let iso = FaceterView::in_frame(stone, medium, up, head).expect("can be seen");
    take(&mut all, &faceter_view::FaceterViewKind, iso, SAMPLES);
    let cells = Contrast::in_frame(stone, medium, up, dark).expect("can be seen");
    take(&mut all, &contrast::ContrastKind, cells, SAMPLES / 2);
    let rocking = Scintillation::in_frame(stone, medium, up, dark).expect("can be seen");
    take(&mut all, &scintillation::ScintillationKind, rocking, SAMPLES / 4);
    let beam = PointLight::in_frame(stone, medium, up).expect("can be lit");
    take(&mut all, &point_light::PointLightKind, beam, SAMPLES / 4);
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
    let ruby = Material::by_name("ruby").expect("in the catalogue").clone();
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
    let cast = SceneOverrides {
        designs: vec![named("reference")],
        material: Some(diamond()),
        ..SceneOverrides::default()
    };
    let mut scene = preset(scene).expect("in the catalogue").expect("is sound").build(&cast, 4.0 / 3.0);
    let scene = scene.as_mut().expect("is set up");
    let on = |p: &PlacedStone| PlacedStone {
        stone: ConvexStone::with_isa(p.stone.solid.clone(), isa),
        ..p.clone()
    };
    scene.stones = scene.stones.iter().map(on).collect();
    let shots = PhotonSets::emit(scene, &PhotonSettings { photons: 20_000, nearest: 100, seed: SEED });
    let settings = integrators::RenderSettings {
        width: 64,
        height: 48,
        samples_per_pixel: 9,
        round: 0,
        tone: Tone::default(),
        seed: SEED,
    };
    let film =
        integrators::render(scene, &scene.camera, &PhotonMaps::new(scene, shots, 100), &settings, &|| ());
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
