//! Windows-1252, the encoding that faceting programs write without saying so.

/// Windows-1252 from 0x80 to 0x9F; the rest is Latin-1. The five that it leaves undefined stay
/// control characters. Source: the table of the WHATWG Encoding Standard.
const HIGH: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}',
    '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// The text that the bytes stand for; every byte stands for something.
pub fn decoded(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|&b| if (0x80..0xA0).contains(&b) { HIGH[b as usize - 0x80] } else { b as char })
        .collect()
}

/// The byte of a character, if it has one.
pub fn byte_of(c: char) -> Option<u8> {
    match u32::from(c) {
        code @ (0..0x80 | 0xA0..=0xFF) => Some(code as u8),
        _ => HIGH.iter().position(|h| *h == c).map(|i| 0x80 + i as u8),
    }
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
