//! From linear light to a PNG.

use super::film::{Film, Pass};
use crate::optics::colour;
use glam::Vec3;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

/// A picture that could not be encoded.
#[derive(Debug, thiserror::Error)]
#[error("cannot encode the picture: {0}")]
pub struct EncodeError(#[from] image::ImageError);

/// Where the tone curve leaves the straight line.
const SHOULDER: f32 = 0.7;

/// Straight up to [`SHOULDER`], then bending smoothly toward 1: bright facets keep their drawing
/// where a straight line would burn out.
fn curve(x: f32) -> f32 {
    if x <= SHOULDER {
        x.max(0.0)
    } else {
        SHOULDER + (1.0 - SHOULDER) * (1.0 - (-(x - SHOULDER) / (1.0 - SHOULDER)).exp())
    }
}

/// One pixel as 8-bit sRGB.
fn display(linear: Vec3, exposure: f32) -> [u8; 3] {
    (linear * exposure).to_array().map(|x| (colour::srgb_encode(curve(x)) * 255.0).round() as u8)
}

/// A PNG of one pass, or of the sum of all.
///
/// - `stops`: exposure, 0 leaves the scene's own
pub fn png(film: &Film, pass: Option<Pass>, stops: f32) -> Result<Vec<u8>, EncodeError> {
    let exposure = stops.exp2();
    let bytes: Vec<u8> = film.linear(pass).into_iter().flat_map(|p| display(p, exposure)).collect();
    encode_rgb(&bytes, film.width, film.height)
}

/// A PNG of 8-bit RGB bytes, row after row.
pub fn encode_rgb(bytes: &[u8], width: u32, height: u32) -> Result<Vec<u8>, EncodeError> {
    let mut out = Vec::new();
    PngEncoder::new(&mut out).write_image(bytes, width, height, ExtendedColorType::Rgb8)?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_rises_smoothly_to_one() {
        assert_eq!(curve(-0.1), 0.0);
        assert_eq!(curve(0.5), 0.5);
        let slope = (curve(SHOULDER + 1e-3) - curve(SHOULDER)) / 1e-3;
        assert!((slope - 1.0).abs() < 0.01);
        assert!(curve(4.0) > 0.99 && curve(1e6) <= 1.0);
    }
}
