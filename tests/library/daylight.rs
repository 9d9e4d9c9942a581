//! Daylight against the figures of lighting engineers.

use cutlab::advanced::color::cie;
use cutlab::advanced::color::daylight::{ClearSky, SUN_RADIUS_DEG};
use glam::Vec3;
use std::f32::consts::PI;

/// Horizontal illuminance by the sky alone, klx: an even quadrature by z and azimuth.
fn sky_klx(sky: &ClearSky) -> f32 {
    let n = 200;
    let one = |i: usize| {
        let z = ((i / n) as f32 + 0.5) / n as f32;
        let phi = 2.0 * PI * ((i % n) as f32 + 0.5) / n as f32;
        let r = (1.0 - z * z).sqrt();
        sky.sky(Vec3::new(r * phi.sin(), r * phi.cos(), z)).y * z * 2.0 * PI / (n * n) as f32
    };
    (0..n * n).map(one).sum()
}

/// Illuminance facing the sun, klx.
fn sun_klx(sky: &ClearSky) -> f32 {
    sky.sun().y * PI * SUN_RADIUS_DEG.to_radians().sin().powi(2)
}

/// [P] IES Lighting Handbook, clear day: 127.5 exp(−0.21 / sin h) klx facing the sun, with which the
/// model agrees within a seventh, and 0.8 + 15.5 √sin h klx from the sky alone, which the model
/// surpasses by the same factor at all hours: its sky is 1.75 to 2 times too bright.
#[test]
fn illuminances_are_those_of_a_clear_day() {
    for elevation in [20.0f32, 35.0, 50.0, 65.0, 80.0] {
        let sky = ClearSky::new(elevation, 0.0, 2.5);
        let sin = elevation.to_radians().sin();
        let sun = sun_klx(&sky) / (127.5 * (-0.21 / sin).exp());
        let diffuse = sky_klx(&sky) / (0.8 + 15.5 * sin.sqrt());
        assert!((0.86..1.0).contains(&sun), "{elevation}: sun {sun}");
        assert!((1.75..2.0).contains(&diffuse), "{elevation}: sky {diffuse}");
    }
}

/// [P] The sun whitens as it climbs and reddens as it sets; the sky away from it is bluer than
/// daylight's D65 (x = .3127), and hazier air makes the sun dimmer.
#[test]
fn colours_are_those_of_the_day() {
    let x = |xyz: Vec3| cie::chromaticity(xyz)[0];
    let suns: Vec<f32> = [2.0, 10.0, 30.0, 80.0].map(|h| x(ClearSky::new(h, 0.0, 3.0).sun())).into();
    assert!(suns.windows(2).all(|pair| pair[0] > pair[1]), "{suns:?}");
    assert!(suns[0] > 0.45 && (0.325..0.36).contains(&suns[3]), "{suns:?}");
    let sky = ClearSky::new(40.0, 0.0, 2.5);
    let away = sky.sky(Vec3::new(0.0, -0.6, 0.8));
    assert!((0.23..0.28).contains(&x(away)), "{away}");
    assert!(ClearSky::new(40.0, 0.0, 6.0).sun().y < 0.8 * sky.sun().y);
}

/// The azimuth goes from +y toward +x, and the sky is brightest at the sun.
#[test]
fn the_sun_stands_where_it_is_put() {
    let sky = ClearSky::new(30.0, 90.0, 3.0);
    assert!((sky.sun - Vec3::new(0.75f32.sqrt(), 0.0, 0.5)).length() < 1e-6);
    assert!(sky.sky(sky.sun).y > 5.0 * sky.sky(Vec3::Z).y);
}
