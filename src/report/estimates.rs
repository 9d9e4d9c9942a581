//! Estimates as text and as HTML.

use crate::sampling::stats::Estimate;
use maud::{Markup, html};

/// The sign that a difference has before its text: `+` if it is shown as more than zero; the text of a
/// negative one has its own.
pub fn plus(e: Estimate) -> &'static str {
    if e.value > 0.0 && e.text().0.parse() != Ok(0.0) { "+" } else { "" }
}

/// An estimate with its error as HTML, or a dash if there is none.
///
/// - `unit`: stands behind the value, if it is not empty
pub(super) fn estimate_html(value: Option<Estimate>, unit: &str) -> Markup {
    shown(value, "", unit)
}

/// As [`estimate_html`], with its sign.
pub(super) fn difference_html(value: Option<Estimate>) -> Markup {
    shown(value, value.map_or("", plus), "")
}

fn shown(value: Option<Estimate>, sign: &str, unit: &str) -> Markup {
    let minus = |text: String| text.replace('-', "−");
    html! {
        @if let Some((value, error)) = value.map(Estimate::text) {
            b { (sign) (minus(value)) }
            @if !unit.is_empty() { " " (unit) }
            @if let Some(error) = error { " " span class="se" { "± " (minus(error)) } }
        } @else {
            "–"
        }
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
