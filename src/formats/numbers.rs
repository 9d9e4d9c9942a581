//! Numbers as design files have them.

/// Significant digits of a number. All readers take as many; one more would show the rounding of `f64`.
const DIGITS: i32 = 15;

/// The number with `least` decimals, or with more if it takes them for [`DIGITS`] significant digits.
pub fn decimals(x: f64, least: usize) -> String {
    let magnitude = if x == 0.0 { 0 } else { x.abs().log10().floor() as i32 };
    let most = (DIGITS - 1 - magnitude).clamp(least as i32, 17) as usize;
    let mut text = format!("{x:.most$}");
    let spare = text.bytes().rev().take(most - least).take_while(|b| *b == b'0').count();
    text.truncate(text.len() - spare);
    if text.ends_with('.') {
        text.pop();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_they_need_and_no_more_than_fifteen() {
        assert_eq!(decimals(-42.5, 6), "-42.500000");
        assert_eq!(decimals(-0.0, 6), "-0.000000");
        assert_eq!(decimals(1.0 / 3.0, 6), "0.333333333333333");
        assert_eq!(decimals(0.8814711600000001, 8), "0.88147116");
        assert_eq!(decimals(-42.01339541369781, 6), "-42.0133954136978");
        assert_eq!(decimals(96.0, 0), "96");
        assert_eq!(decimals(2.5, 0), "2.5");
        assert_eq!(decimals(14.523285922140165, 0), "14.5232859221402");
        assert_eq!(decimals(1.54, 2), "1.54");
        assert_eq!(decimals(0.001234567890123, 8), "0.001234567890123");
    }
}
