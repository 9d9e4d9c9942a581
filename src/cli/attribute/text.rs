//! An attribution for people: what to change first, and a line for each tier.

use crate::cli::terminal_table::{self, NONE, format_estimate};
use crate::report::estimates::plus;
use crate::report::tier_advice::{advice, percent, remark, rows};
use crate::sampling::stats::Estimate;
use crate::scoring::Attribution;
use crate::scoring::attribution::TierAttribution;
use crate::storage::terminal::in_line;

/// The text.
pub fn text(found: &Attribution) -> String {
    let mut text: String = advice(found).iter().map(|line| format!("{}\n", in_line(line))).collect();
    text += &format!("\n{} ({})\n", in_line(&found.stone), found.material);
    let mut table = terminal_table::new();
    let heads = ["tier", "", "facets", "angle"].map(String::from).into_iter();
    let per_degree = found.objectives.iter().map(|of| match of.unit {
        "" => format!("{} per °", of.name),
        unit => format!("{} ({unit}) per °", of.name),
    });
    table.set_header(heads.chain(per_degree).chain(["light lost (%)", ""].map(String::from)));
    table.add_rows(rows(found).map(|tier| row(tier, found)));
    table.add_row(total(found));
    text += &terminal_table::lines(&table);
    text += "per degree by which a tier is steeper, after ± one standard error; * beyond three errors, and not \
             negligible\n";
    text += "light lost: what a face-up viewer sees of what lies below the stone, by the facets it comes through\n";
    text
}

fn row(tier: &TierAttribution, found: &Attribution) -> Vec<String> {
    let change = |objective: usize| match tier.changes.get(objective) {
        Some(change) => {
            let (sign, mark) = (plus(change.per_degree), if change.significant { " *" } else { "" });
            format!("{sign}{}{mark}", format_estimate(change.per_degree))
        }
        None => NONE.into(),
    };
    let mut row = vec![
        tier.place.clone(),
        in_line(&tier.name),
        tier.facets.to_string(),
        format!("{:.2}°", tier.angle_deg),
    ];
    row.extend((0..found.objectives.len()).map(change));
    row.extend([lost(tier.leakage), in_line(&remark(tier))]);
    row
}

fn total(found: &Attribution) -> Vec<String> {
    let facets: usize = found.tiers.iter().map(|tier| tier.facets).sum();
    let mut row = vec!["all".to_owned(), String::new(), facets.to_string(), String::new()];
    row.extend(found.objectives.iter().map(|of| format!("of {}", format_estimate(of.value))));
    row.extend([lost(found.leakage), String::new()]);
    row
}

fn lost(share: Estimate) -> String {
    format_estimate(percent(share))
}
