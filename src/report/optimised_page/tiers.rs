//! Cutting diagrams of the kept designs, and tier by tier what changed.

use super::headline::link;
use super::kept::KeptDesign;
use crate::design::edit::{BeforeAfter, TierChange, TierState};
use crate::parse::format_number;
use crate::report::diagram;
use crate::report::html::svg_uri;
use crate::report::stone_report::ReportError;
use maud::{Markup, html};

/// The section: the first design unfolded, the others to be unfolded.
///
/// - `index`: of refraction that the designs are for
pub(super) fn section(kept: &[KeptDesign], index: f64) -> Result<Markup, ReportError> {
    let mut drawn = Vec::new();
    for design in kept {
        drawn.push((design, diagram::draw(&design.finalist.edited.design, Some(index))?));
    }
    Ok(html! {
        section {
            h2 { "To cut it" }
            p class="note" {
                "Tier by tier what changed, in cutting order: angle from the girdle plane, teeth of index by which the \
                 tier was turned, distance of its facets from the middle in percent of the width. A tier that \
                 followed changed so that what met still meets."
            }
            @for (i, (design, svg)) in drawn.iter().enumerate() {
                details open[i == 0] {
                    summary { (design.label) }
                    @if design.file.is_some() { p { "The design: " (link(design)) } }
                    (tier_table(design))
                    figure class="sheet" {
                        img src=(svg_uri(svg)) alt={ "cutting diagram of " (design.label) };
                        figcaption {
                            "Cutting diagram: crown from above, pavilion from below, two sides, the tiers as \
                             they are cut."
                        }
                    }
                }
                "\n"
            }
        }
        "\n"
    })
}

/// The tiers before and after.
fn tier_table(design: &KeptDesign) -> Markup {
    let changes = &design.changes;
    let count = changes.tiers.iter().filter(|tier| tier.is_changed()).count();
    html! {
        p { (count) " of " (changes.tiers.len()) " tiers changed." }
        @if changes.is_outline_changed { p { "The outline changed, so that what met still meets." } }
        div class="wide" {
            table class="versus tiers" {
                thead { tr { th { "tier" } th { "angle" } th { "index" } th { "depth" } th {} } }
                "\n"
                tbody { @for tier in &changes.tiers { (tier_row(tier)) } }
            }
        }
    }
}

fn tier_row(tier: &TierChange) -> Markup {
    let BeforeAfter { before, after } = tier.state;
    let each = |of: &dyn Fn(&TierState) -> String| both(before.as_ref().map(of), after.as_ref().map(of));
    let angle = each(&|state| format!("{:.2}°", state.angle_deg));
    let depth = each(&|state| match state.most_depth_percent - state.depth_percent > 0.005 {
        true => format!("{:.2}–{:.2} %", state.depth_percent, state.most_depth_percent),
        false => format!("{:.2} %", state.depth_percent),
    });
    let index = match tier.index_shift {
        0.0 => "unchanged".to_owned(),
        shift => format!("{}{}", if shift > 0.0 { "+" } else { "−" }, format_number(shift.abs())),
    };
    let said = match (before, after) {
        (None, Some(_)) => "new",
        (Some(_), None) => "gone",
        _ if tier.followed => "followed",
        _ => "",
    };
    html! {
        tr class=(if tier.is_changed() { "differs" } else { "same" }) {
            th scope="row" { (tier.place) @if !tier.name.is_empty() { " " span class="se" { (tier.name) } } }
            td class="value" { (angle) }
            td class="value" { (index) }
            td class="value" { (depth) }
            td { (said) }
        }
        "\n"
    }
}

/// A value, or both where they are shown differently.
fn both(before: Option<String>, after: Option<String>) -> Markup {
    let shown = |value: &Option<String>| value.clone().unwrap_or_else(|| "–".into());
    html! {
        @if before == after { (shown(&before)) } @else { (shown(&before)) " → " b { (shown(&after)) } }
    }
}
