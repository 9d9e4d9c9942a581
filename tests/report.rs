//! The report's pictures against reference figures, and what its page holds.

mod bench;
mod brilliants;

use bench::Bench;
use brilliants::{SEED, design, diamond, named, plan, stone, subject};
use cutlab::advanced::design::library;
use cutlab::advanced::materials::Material;
use cutlab::advanced::metrics::METRICS;
use cutlab::advanced::report::references::{References, STONES};
use cutlab::advanced::report::viewer_images::{self, ASET, IDEAL_SCOPE, VIEWER_IMAGES, WINDOWS};
use cutlab::advanced::scoring::score::{ScoreRequest, Target, score};

/// Shares of the strongest path from the project's sources (reference tracer): green 6.0, red 66.7,
/// blue 22.8, leakage 4.5, ±.5 % of the face-up area.
#[test]
fn the_aset_picture_has_the_reference_shares() {
    let index = diamond().index_d() as f32;
    let pictures =
        viewer_images::pictures(&stone(&named("reference")), index, &[&ASET], 160).expect("can be encoded");
    let shares = &pictures[0].shares;
    for (share, expected) in shares.iter().zip([0.060, 0.667, 0.228, 0.045]) {
        assert!((share - expected).abs() < 0.005, "{shares:?}");
    }
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

/// Pixels on a grid and random points see the same leakage, windows and extinction: in diamond, and
/// in a shallow stone of glass, which has a window.
#[test]
fn the_other_pictures_have_the_shares_that_are_scored() {
    let glass = Material::from_index(1.5);
    for (material, pavilion) in [(diamond(), 40.5), (glass, 38.0)] {
        let design = design(&[("pavilion-angle", pavilion)]);
        let index = material.index_d() as f32;
        let pictures = viewer_images::pictures(&stone(&design), index, &[&IDEAL_SCOPE, &WINDOWS], 160)
            .expect("can be encoded");
        let metrics = ["leakage_strongest", "windowing", "extinction"];
        let scored = score(&subject("", &design, material), &plan(&metrics, 1 << 16)).scores;
        let seen = [pictures[0].shares[2], pictures[1].shares[0], pictures[1].shares[1]];
        for ((metric, seen), scored) in metrics.iter().zip(seen).zip(scored) {
            let scored = scored.expect("applies");
            // the grid's own error: .002 for the ASET's shares at this size
            let off = (seen - scored.value).abs();
            assert!(off < 0.005 + 4.0 * scored.error, "{metric}: {seen}, {scored:?}");
        }
    }
}

#[test]
fn the_pictures_are_the_same_on_any_number_of_threads() {
    let stone = stone(&named("reference"));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let pictures = pool
            .install(|| viewer_images::pictures(&stone, 2.417, &VIEWER_IMAGES, 48).expect("can be encoded"));
        pictures.into_iter().map(|p| p.png).collect::<Vec<_>>()
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}

/// The table in the binary is of this program: other random numbers give the same scores. Of 175
/// differences none is expected beyond 4.5 errors (P = .001).
#[test]
fn the_reference_stones_have_the_scores_of_this_program() {
    let references = References::read().expect("can be read");
    let plan = ScoreRequest { target: Target::Samples(1 << 14), seed: SEED + 1, ..ScoreRequest::default() };
    for (i, (_, _, stone)) in STONES.iter().enumerate() {
        let parameters = stone.split_once(':').map_or("", |(_, p)| p);
        let name = stone.split(':').next().expect("a name");
        let pairs = parameters.split(',').filter_map(|p| p.split_once('='));
        let parameters = pairs.map(|(k, v)| (k.to_string(), v.parse().expect("a number"))).collect();
        let design = library::design(name, &parameters).expect("in the library").expect("can be made");
        let scored = score(&subject(name, &design, diamond()), &plan).scores;
        for (metric, fresh) in METRICS.iter().zip(scored) {
            let (fresh, kept) =
                (fresh.expect("applies"), references.scores(metric)[i].expect("in the table"));
            let off = (fresh.value - kept.value).abs();
            let error = fresh.error.hypot(kept.error);
            assert!(off <= 4.5 * error + 1e-6, "{} of {stone}: {fresh:?}, {kept:?}", metric.name);
        }
    }
}

/// A stone of another material stands beside the same five stones in that material: they have the scores
/// that other random numbers give.
#[test]
fn the_reference_stones_are_of_the_stones_own_material() {
    let quartz = Material::by_name("quartz").expect("in the catalogue");
    let ruby = Material::by_name("ruby").expect("in the catalogue");
    let glass = Material::from_index(1.54);
    let names = ["wlr", "leakage", "iso", "fire_streak", "absorbed"];
    let metrics = || names.iter().filter_map(|n| METRICS.iter().copied().find(|m| m.name == *n));
    let scalar = ScoreRequest { polarised: false, ..ScoreRequest::default() };
    let in_diamond = References::read().expect("can be read");
    for (material, width) in [(quartz, 8.0), (ruby, 5.0), (&glass, 6.5)] {
        let references = References::within(material, width, &scalar).expect("can be scored");
        assert_eq!(references.material, material.name);
        let design = named("tolkowsky").sized(width).expect("can be sized");
        let fresh = score(&subject("", &design, material.clone()), &plan(&names, 1 << 16)).scores;
        for (metric, fresh) in metrics().zip(fresh) {
            let kept = references.scores(metric)[1];
            let Some((fresh, kept)) = fresh.zip(kept) else {
                assert!(metric.name == "fire_streak" && material.name == "n=1.54", "{}", metric.name);
                assert_eq!((fresh, kept), (None, None));
                continue;
            };
            let error = fresh.error.hypot(kept.error);
            let off = (fresh.value - kept.value).abs();
            assert!(off <= 4.5 * error + 1e-6, "{} in {}: {fresh:?}, {kept:?}", metric.name, material.name);
            let diamond = in_diamond.scores(metric)[1].expect("in the table");
            let differs = (diamond.value - kept.value).abs() > 10.0 * error;
            assert!(differs || metric.name == "absorbed", "{} in {}", metric.name, material.name);
        }
    }
}

/// The page holds every head, every score beside the references, all drawings, and no address
/// outside.
#[test]
#[ignore = "two pictures on tables take half a minute: .ci/run runs it"]
fn the_page_holds_everything_and_needs_nothing_beside_it() {
    let bench = Bench::new();
    bench.good(&["report", "round-brilliant:pavilion-angle=43", "-o", "out"]);
    let page = String::from_utf8(bench.read("out/index.html")).expect("UTF-8");
    for head in [
        "Brilliance",
        "Dispersion",
        "Contrast and scintillation",
        "Faceters’ scores",
        "Weight and spread",
        "Viewer maps",
        "Seen straight from above",
        "Proportions",
        "Cutting diagram",
        "Tilted",
        "Among round brilliants",
    ] {
        assert!(page.contains(&format!("<h2>{head}</h2>")), "{head}");
    }
    for metric in METRICS.iter() {
        let row = page.split("</tr>").find(|r| r.contains(&format!("<code>{}</code>", metric.name)));
        let row = row.unwrap_or_else(|| panic!("no row of {}", metric.name));
        assert_eq!(row.matches("data-stone=").count(), STONES.len(), "{}", metric.name);
        let closed = ["absorbed", "windowing", "spread", "weight_ratio"].contains(&metric.name);
        assert!(closed || row.matches('±').count() == 1 + STONES.len(), "{row}");
    }
    // the table, three scopes; the diagram, three tilts, the map
    assert_eq!(page.matches("data:image/png;base64,").count(), 4);
    assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 5);
    assert!(page.contains("this stone lies outside of it"), "43° is below the map");
    assert!(page.contains("(table/crown/pavilion) in diamond.") && page.contains("<em>less is better</em>"));
    assert!(!page.contains("http://") && !page.contains("https://"), "the page needs no network");
    let other = Bench::new();
    other.good(&["report", "princess", "--ri", "1.544", "-o", "out"]);
    let page = String::from_utf8(other.read("out/index.html")).expect("UTF-8");
    assert!(page.contains("(table/crown/pavilion) in n=1.544."), "references of the stone's own index");
    assert!(page.contains(" ct in quartz") && page.contains("Weight: n = 1.544 is nearest to quartz"));
    assert!(!page.contains("Among round brilliants") && page.contains("Cutting diagram"));
}
