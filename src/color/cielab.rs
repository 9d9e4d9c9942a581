//! CIELAB: colours as an eye adapted to a white sees them.

use glam::Vec3;

/// A colour in CIE 1976 L*a*b*.
///
/// Source: CIE 015:2018, §8.2.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lab {
    /// Lightness, 0 to 100 for what is no lighter than the white.
    pub l: f32,
    /// From green to red.
    pub a: f32,
    /// From blue to yellow.
    pub b: f32,
}

impl Lab {
    /// The colour of `xyz` against `white`, both CIE XYZ on one scale.
    pub fn new(xyz: Vec3, white: Vec3) -> Lab {
        let [x, y, z] = (xyz / white).to_array().map(response);
        Lab { l: 116.0 * y - 16.0, a: 500.0 * (x - y), b: 200.0 * (y - z) }
    }

    /// Chroma C*: 0 for greys.
    pub fn chroma(&self) -> f32 {
        self.a.hypot(self.b)
    }

    /// Hue angle h, degrees from 0 to 360: red near 30, yellow near 90, green near 150, blue near 270.
    pub fn hue_deg(&self) -> f32 {
        self.b.atan2(self.a).to_degrees().rem_euclid(360.0)
    }
}

/// The cube root, with a line in place of it near black.
fn response(t: f32) -> f32 {
    const EDGE: f32 = 24.0 / 116.0;
    if t > EDGE * EDGE * EDGE { t.cbrt() } else { 841.0 / 108.0 * t + 16.0 / 116.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [D] White and black; a grey of Y = 0.184187 has L* = 50; the line meets the cube root.
    #[test]
    fn white_grey_and_black_are_where_they_belong() {
        let white = Vec3::new(0.9505, 1.0, 1.089);
        let of = |share: f32| Lab::new(white * share, white);
        assert!((of(1.0).l - 100.0).abs() < 1e-4 && of(1.0).chroma() < 1e-3);
        assert!(of(0.0).l.abs() < 1e-4 && (of(0.184_187).l - 50.0).abs() < 1e-3);
        let edge = (24f32 / 116.0).powi(3);
        assert!((response(edge * 0.9999) - response(edge * 1.0001)).abs() < 1e-4);
    }

    /// [P] The primaries of sRGB: L* a* b* of red 53.24 80.09 67.20, of blue 32.30 79.19 −107.86 (D65).
    #[test]
    fn primaries_of_srgb_have_their_colours() {
        let white = Vec3::new(0.950_47, 1.0, 1.088_83);
        let red = Lab::new(Vec3::new(0.412_456, 0.212_673, 0.019_334), white);
        assert!((red.l - 53.24).abs() < 0.02 && (red.a - 80.09).abs() < 0.05 && (red.b - 67.20).abs() < 0.05);
        assert!((red.hue_deg() - 40.0).abs() < 0.1 && (red.chroma() - 104.55).abs() < 0.05);
        let blue = Lab::new(Vec3::new(0.180_437, 0.072_175, 0.950_304), white);
        assert!(
            (blue.l - 32.30).abs() < 0.02 && (blue.a - 79.19).abs() < 0.05 && (blue.b + 107.86).abs() < 0.05
        );
        assert!((blue.hue_deg() - 306.29).abs() < 0.05);
    }
}
