//! Pictures of the start and of each kept design, of one kind beside each other.

use super::kept::KeptDesign;
use crate::report::html::data_uri;
use crate::report::stone_report::ReportError;
use crate::report::viewer_images::{self, ASET, BRIGHTNESS, IDEAL_SCOPE, ViewerImage, ViewerPicture};
use crate::scoring::settings::{ScoreInput, ScoreRequest};
use crate::stone::Stone;
use maud::{Markup, html};

/// The kinds of picture, in the order of the page.
static KINDS: [&ViewerImage; 3] = [&BRIGHTNESS, &ASET, &IDEAL_SCOPE];

/// The pictures of one stone, in the order of [`KINDS`].
///
/// - `plan`: polarisation, seed and observer; `side`: pixels
pub(super) fn of_stone(
    stone: &Stone,
    plan: &ScoreRequest,
    side: u32,
) -> Result<Vec<ViewerPicture>, ReportError> {
    let all = viewer_images::pictures(&ScoreInput::from_stone(stone, None), plan, side)?;
    let of_kind = |kind: &&ViewerImage| all.iter().find(|picture| picture.scope.file == kind.file).cloned();
    Ok(KINDS.iter().filter_map(of_kind).collect())
}

/// The pictures, kind by kind.
///
/// - `pictures`: of the start, then of each design
pub(super) fn section(pictures: &[Vec<ViewerPicture>], kept: &[KeptDesign]) -> Markup {
    let labels: Vec<&str> = ["start"].into_iter().chain(kept.iter().map(|k| k.label.as_str())).collect();
    html! {
        section {
            h2 { "Before and after" }
            @for (k, kind) in KINDS.iter().enumerate() {
                h3 { (kind.name) }
                p class="note" { "Seen straight from above: " (kind.about) "." }
                ul class="keys" {
                    @for key in kind.legend {
                        @let [r, g, b] = key.colour;
                        li { i style={ "background:rgb(" (r) "," (g) "," (b) ")" } {} (key.about) }
                    }
                }
                div class="beside" {
                    @for (label, of_stone) in labels.iter().zip(pictures) {
                        @if let Some(picture) = of_stone.get(k) { (figure(label, picture)) }
                    }
                }
                "\n"
            }
        }
        "\n"
    }
}

/// A picture, and the shares of its colours.
fn figure(label: &str, picture: &ViewerPicture) -> Markup {
    let shares = picture.scope.legend.iter().zip(&picture.shares);
    let shares: Vec<String> =
        shares.map(|(key, share)| format!("{}\u{a0}{:.1}\u{a0}%", key.name, 100.0 * share)).collect();
    html! {
        figure {
            img src=(data_uri(&picture.png)) alt={ (picture.scope.name) " of " (label) ", seen from above" };
            figcaption { b { (label) } br; (shares.join(", ")) }
        }
        "\n"
    }
}
