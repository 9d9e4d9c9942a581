//! What to change first, on the page: a line for each score, and the tiers.

use crate::report::estimates::{difference_html, estimate_html};
use crate::report::tier_advice::{advice, percent, remark, rows};
use crate::scoring::Attribution;
use crate::scoring::attribution::{ChangePerDegree, TierAttribution};
use maud::{Markup, html};

/// The section.
///
/// - `found`: or why it is left out
pub(super) fn tier_section(found: &Result<Attribution, String>) -> Markup {
    html! {
        section {
            h2 { "What to change first" }
            @match found {
                Ok(found) => (tiers(found)),
                Err(why) => p class="note" { "Left out: " (why) "." },
            }
        }
        "\n"
    }
}

fn tiers(found: &Attribution) -> Markup {
    html! {
        @for line in advice(found) { p { (line) "." } "\n" }
        table class="tiers" {
            thead {
                tr {
                    th { "tier" } th { "angle" }
                    @for of in &found.objectives {
                        th { (of.name) @if !of.unit.is_empty() { " (" (of.unit) ")" } " per °" }
                    }
                    th { "light lost (%)" } th {}
                }
            }
            "\n"
            tbody { @for tier in rows(found) { (row(tier, found.objectives.len())) } }
        }
        p class="note" {
            "Each tier is turned by a quarter of a degree to both sides while what met still meets; shown is the change \
             per degree by which it is steeper, after ± one standard error, bold if it is beyond three errors and not \
             negligible. Light lost: what a viewer who looks straight down sees of what lies below the stone, by the \
             facets it comes through. cutlab attribute takes other scores and tilts, and shows single facets."
        }
    }
}

fn row(tier: &TierAttribution, objectives: usize) -> Markup {
    html! {
        tr {
            th scope="row" { (tier.place) @if tier.name != tier.place { " " span class="se" { (tier.name) } } }
            td { (format!("{:.2}°", tier.angle_deg)) }
            @for objective in 0..objectives { td { (change(tier.changes.get(objective))) } }
            td { span class="plain" { (estimate_html(Some(percent(tier.leakage)), "")) } }
            td class="note" { (remark(tier)) }
        }
        "\n"
    }
}

/// A change per degree; one that is not significant is not bold.
fn change(change: Option<&ChangePerDegree>) -> Markup {
    let is_plain = change.is_some_and(|change| !change.significant);
    html! {
        span class=[is_plain.then_some("plain")] { (difference_html(change.map(|change| change.per_degree))) }
    }
}
