//! Backgrounds: what stands behind the stones in a picture.

use crate::color::cie;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// What a picture has for its background.
///
/// ```
/// use cutlab::Background;
///
/// let json = serde_json::to_string(&Background::Colour([255, 0, 128]))?;
/// assert_eq!(json, r#"{"colour":[255,0,128]}"#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Background {
    /// Nothing: the picture is transparent there.
    Transparent,
    /// One colour: red, green and blue of sRGB.
    Colour([u8; 3]),
}

/// A colour of sRGB as linear light.
pub fn linear(colour: [u8; 3]) -> Vec3 {
    Vec3::from(colour.map(|byte| cie::srgb_decode(f32::from(byte) / 255.0)))
}

/// Reads `transparent`, `white`, `black` or `#RRGGBB`; the error says what is expected.
pub fn parse(text: &str) -> Result<Background, String> {
    match text.to_ascii_lowercase().as_str() {
        "transparent" => Ok(Background::Transparent),
        "white" => Ok(Background::Colour([255; 3])),
        "black" => Ok(Background::Colour([0; 3])),
        other => other.strip_prefix('#').and_then(bytes).map(Background::Colour).ok_or_else(|| {
            "a background is transparent, white, black, or a colour as '#1e90ff' (in quotes: # begins a comment)"
                .into()
        }),
    }
}

/// Six hexadecimal digits.
fn bytes(digits: &str) -> Option<[u8; 3]> {
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let [_, r, g, b] = number.to_be_bytes();
    Some([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_as_a_style_sheet_has_them() {
        assert_eq!(parse("Transparent"), Ok(Background::Transparent));
        assert_eq!(parse("white"), Ok(Background::Colour([255; 3])));
        assert_eq!(linear([255; 3]), Vec3::ONE);
        assert_eq!(parse("#000000"), Ok(Background::Colour([0; 3])));
        assert_eq!(parse("#FF0080"), Ok(Background::Colour([255, 0, 128])));
        let c = linear([255, 0, 128]);
        assert!((c - Vec3::new(1.0, 0.0, 0.2158605)).abs().max_element() < 1e-5, "{c}");
        for wrong in ["#fff", "red ", "#12345g", "#+12345", "#1234567", ""] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
