//! Estimates as text and as HTML.

use crate::sampling::stats::Estimate;

/// An estimate as text: [`Estimate::text`].
pub fn estimate_text(e: Estimate) -> (String, Option<String>) {
    e.text()
}

/// An estimate with its error as HTML, or a dash if there is none.
///
/// - `unit`: put behind the value
pub(super) fn estimate_html(value: Option<Estimate>, unit: &str) -> String {
    let minus = |text: String| text.replace('-', "−");
    match value.map(estimate_text).map(|(value, error)| (minus(value), error.map(minus))) {
        Some((value, Some(error))) => {
            format!("<b>{value}</b>{unit} <span class=\"se\">± {error}</span>")
        }
        Some((value, None)) => format!("<b>{value}</b>{unit}"),
        None => "–".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_show_two_digits_of_their_error() {
        let shown = |value, error| Estimate { value, error }.text();
        assert_eq!(shown(0.283_21, 0.000_43), ("0.28321".into(), Some("0.00043".into())));
        assert_eq!(shown(12.345, 0.5), ("12.35".into(), Some("0.50".into())));
        assert_eq!(shown(4.371e-5, 4.3e-8), ("4.37e-5".into(), Some("4e-8".into())));
        assert_eq!(shown(0.25, 0.0), ("0.2500".into(), None));
    }
}
