//! What the tiers of a design do, in words: what to change first, and what is said of a tier.

use super::estimates::plus;
use crate::sampling::stats::Estimate;
use crate::scoring::attribution::{AttributedObjective, Attribution, HALF_DEGREE, TierAttribution};
use crate::scoring::objective::Aim;

/// For each objective a line on what to change first.
pub fn advice(found: &Attribution) -> Vec<String> {
    found.objectives.iter().map(|objective| line(objective, found)).collect()
}

fn line(of: &AttributedObjective, found: &Attribution) -> String {
    let less = if of.aim == Aim::Minimise { " (less is better)" } else { "" };
    let head = format!("{}{less}", of.name);
    let Some(first) = &of.first else {
        let none_turns = found.tiers.iter().all(|tier| tier.changes.is_empty());
        return match none_turns {
            true => format!("{head}: no tier can be turned"),
            false => format!("{head}: no single tier gains significantly by half a degree"),
        };
    };
    let way = if first.degrees > 0.0 { "steeper" } else { "flatter" };
    let tier = match &*first.name {
        "" => first.place.clone(),
        name if name == first.place => first.place.clone(),
        name => format!("{} ({name})", first.place),
    };
    let follow = match &first.followed[..] {
        [] => String::new(),
        tiers => format!(", {} following", listed(tiers)),
    };
    let unit = if of.unit.is_empty() { String::new() } else { format!(" {}", of.unit) };
    let signed = |change: Estimate| format!("{}{change}{unit}", plus(change));
    format!(
        "{head}: turn {tier} {HALF_DEGREE}° {way} first{follow}: {} by its change per degree (linear), {} when scored",
        signed(first.predicted),
        signed(first.scored)
    )
}

/// The tiers in the order in which to change them for the first objective, then all others in cutting order.
pub fn rows(found: &Attribution) -> impl Iterator<Item = &TierAttribution> {
    let order = found.objectives.first().map_or(&[][..], |of| &of.order);
    let first = order.iter().filter_map(|place| found.tiers.iter().find(|tier| tier.place == *place));
    first.chain(found.tiers.iter().filter(|tier| !order.contains(&tier.place)))
}

/// What is to be said of a tier: what follows it, or why it is not turned.
pub fn remark(tier: &TierAttribution) -> String {
    match (&tier.left_out, tier.zone, &tier.followed[..]) {
        (Some(_), "girdle", _) => "stays vertical".into(),
        (Some(_), "table" | "culet", _) => "stays horizontal".into(),
        (Some(why), ..) => format!("cannot be turned: {why}"),
        (None, _, []) => String::new(),
        (None, _, tiers) => format!("others follow: {}", listed(tiers)),
    }
}

/// Places joined, a long list cut short.
fn listed(places: &[String]) -> String {
    const SHOWN: usize = 4;
    let shown = places[..places.len().min(SHOWN)].join(", ");
    if places.len() > SHOWN { format!("{shown} and {} more", places.len() - SHOWN) } else { shown }
}

/// A share in percent.
pub fn percent(share: Estimate) -> Estimate {
    Estimate { value: 100.0 * share.value, error: 100.0 * share.error }
}
