//! Windows-1252, the encoding that faceting programs write without saying so.

use encoding_rs::WINDOWS_1252;

/// The text that the bytes stand for; every byte stands for something.
pub fn decoded(bytes: &[u8]) -> String {
    WINDOWS_1252.decode_without_bom_handling(bytes).0.into_owned()
}

/// The byte of a character, if it has one.
pub fn byte_of(c: char) -> Option<u8> {
    let mut utf_8 = [0; 4];
    let (bytes, _, unmappable) = WINDOWS_1252.encode(c.encode_utf8(&mut utf_8));
    bytes.first().copied().filter(|_| !unmappable)
}

/// The bytes of the text, `?` for what Windows-1252 does not have.
pub fn encoded(text: &str) -> Vec<u8> {
    text.chars().map(|c| byte_of(c).unwrap_or(b'?')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        let all: Vec<u8> = (0..=255).collect();
        assert_eq!(encoded(&decoded(&all)), all);
        assert_eq!(decoded(b"Peter\x92s 40\xB0"), "Peter’s 40°");
        assert_eq!(encoded("α"), b"?");
    }
}
