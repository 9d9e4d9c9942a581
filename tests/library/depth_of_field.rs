//! Depth of field: the circle of confusion is that of a thin lens, a plane in focus stays sharp, and
//! what a lens cannot be is said.

use cutlab::advanced::integrators::{self, PhotonMaps, Tone};
use cutlab::advanced::photons::{PhotonSets, PhotonSettings};
use cutlab::advanced::scene::{Scene, SceneFile, SceneOverrides};
use std::path::Path;

/// Pixels across, and down.
const SIDE: u32 = 128;

/// A camera on the x axis that looks along it, a light before it, and a stone out of the way.
fn scene(lens: &str, light: &str) -> Result<Scene, String> {
    let text = format!(
        "unit = \"mm\"\n[camera]\nat = [-100, 0, 0]\nto = [0, 0, 0]\nfield = 20\n{lens}\n\
         [[stone]]\nsize = 6\nat = [0, 0, 500]\n[[light]]\nradiance = 1\n{light}\n"
    );
    let file = SceneFile::parse("lens", "lens.toml", &text, Path::new("")).map_err(|e| e.to_string())?;
    file.build(&SceneOverrides::default(), 1.0).map_err(|e| e.to_string())
}

/// Luminance of each pixel.
fn picture(lens: &str, light: &str) -> Vec<f64> {
    let scene = scene(lens, light).expect("a sound scene");
    let tone = Tone::default();
    let settings = integrators::RenderSettings {
        width: SIDE,
        height: SIDE,
        samples_per_pixel: 256,
        round: 0,
        tone,
        seed: 5,
    };
    let shots = PhotonSets::emit(&scene, &PhotonSettings { photons: 1, nearest: 1, seed: 5 });
    let film =
        integrators::render(&scene, &scene.camera, &PhotonMaps::new(&scene, shots, 1), &settings, &|| ());
    film.linear(None).iter().map(|p| f64::from(p.y)).collect()
}

/// A globe of 1 mm radius on the view, so far behind the middle of the scene.
fn globe(behind_mm: f64) -> String {
    format!("kind = \"sphere\"\nat = [{behind_mm}, 0, 0]\nradius = 1")
}

/// Sum of all pixels, and the mean square of their distances from the middle in pictures' widths.
fn spread(picture: &[f64]) -> (f64, f64) {
    let middle = |i: usize| (i as f64 + 0.5) / f64::from(SIDE) - 0.5;
    let one =
        |(i, l): (usize, &f64)| l * (middle(i % SIDE as usize).powi(2) + middle(i / SIDE as usize).powi(2));
    let sum: f64 = picture.iter().sum();
    (sum, picture.iter().enumerate().map(one).sum::<f64>() / sum)
}

/// [D] A point at depth z blurs to a disc of c = (f/N) · |z − s|/z · f/(s − f) on the film, whose mean
/// square radius is c²/8; it adds to the globe's own, and no light is lost.
#[test]
fn the_circle_of_confusion_is_that_of_a_thin_lens() {
    let focus_mm = 100.0;
    let film_mm = 18.0 / 10f64.to_radians().tan();
    let f = 1.0 / (1.0 / focus_mm + 1.0 / film_mm);
    for (number, behind) in [(8.0, 60.0), (8.0, -40.0), (2.8, 25.0)] {
        let (sharp_light, sharp) = spread(&picture("", &globe(behind)));
        let (light, blurred) = spread(&picture(&format!("aperture = \"f/{number}\""), &globe(behind)));
        let z = focus_mm + behind;
        let c_mm = f / number * (z - focus_mm).abs() / z * f / (focus_mm - f);
        let expected = (c_mm / 36.0).powi(2) / 8.0;
        let found = blurred - sharp;
        assert!((found / expected - 1.0).abs() < 0.03, "f/{number} at {z} mm: {found} for {expected}");
        // some 4000 rays meet the globe: 1.6 % if they were independent
        assert!((light / sharp_light - 1.0).abs() < 0.05, "f/{number}: {light} of {sharp_light}");
    }
}

/// [D] The edge of a square in the plane in focus is as sharp as a pinhole's: within the noise of 256
/// rays a pixel. The same square out of focus is not.
#[test]
fn a_plane_in_focus_stays_sharp() {
    let square = "kind = \"square\"\nat = [30, 0, 0]\nto = [0, 0, 0]\nside = 20";
    let pinhole = picture("", square);
    let apart = |lens: &str| {
        let off = picture(lens, square).iter().zip(&pinhole).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (off * 100.0).round() / 100.0
    };
    for focus in ["focus = 130", "focus = [30, 5, 7]"] {
        let off = apart(&format!("aperture = 10\n{focus}"));
        assert!(off < 0.15, "{focus}: {off}");
    }
    assert!(apart("aperture = 10") > 0.4, "out of focus");
}

#[test]
fn a_lens_that_cannot_be_is_said_with_its_line() {
    for (lens, line, says) in [
        ("aperture = -1", 6, "aperture = -1 is not a number above 0"),
        ("aperture = \"8\"", 6, "f/8"),
        ("aperture = \"f/0\"", 6, "f/8"),
        ("focus = 10", 6, "without an aperture"),
        ("aperture = 1\nfocus = -5", 7, "before the camera"),
        ("aperture = 1\nfocus = [-200, 0, 0]", 7, "before the camera"),
    ] {
        let error = scene(lens, &globe(0.0)).map(|_| ()).expect_err(lens);
        assert!(error.starts_with(&format!("lens.toml, line {line}:")) && error.contains(says), "{error}");
    }
}
