//! An attribution as a table, a row for each tier, and as JSON.

use crate::cli::error::CliError;
use crate::scoring::Attribution;
use crate::scoring::attribution::TierAttribution;

/// As CSV: of each objective the change per degree, its standard error, and whether it is significant.
pub fn csv(found: &Attribution) -> Result<Vec<u8>, CliError> {
    let failed = |error: csv::Error| CliError::input(error.to_string());
    let mut table = csv::Writer::from_writer(Vec::new());
    let mut head: Vec<String> = ["place", "name", "zone", "facets", "angle_deg"].map(String::from).to_vec();
    for objective in &found.objectives {
        let column = format!("{}_per_deg", objective.name);
        head.extend([column.clone(), format!("{column}_se"), format!("{column}_significant")]);
    }
    head.extend(["leakage", "leakage_se", "followed", "left_out"].map(String::from));
    table.write_record(&head).map_err(failed)?;
    for tier in &found.tiers {
        table.write_record(row(tier, found.objectives.len())).map_err(failed)?;
    }
    table.into_inner().map_err(|error| CliError::input(error.to_string()))
}

fn row(tier: &TierAttribution, objectives: usize) -> Vec<String> {
    let number = |value: f64| format!("{value:.9}");
    let mut row = vec![
        tier.place.clone(),
        tier.name.clone(),
        tier.zone.into(),
        tier.facets.to_string(),
        number(tier.angle_deg),
    ];
    for objective in 0..objectives {
        row.extend(tier.changes.get(objective).map_or_else(Default::default, |change| {
            [number(change.per_degree.value), number(change.per_degree.error), change.significant.to_string()]
        }));
    }
    row.extend([number(tier.leakage.value), number(tier.leakage.error)]);
    row.extend([tier.followed.join(", "), tier.left_out.clone().unwrap_or_default()]);
    row
}

/// As JSON.
pub fn json(found: &Attribution) -> Result<Vec<u8>, CliError> {
    let text = serde_json::to_string_pretty(found).map_err(|error| CliError::input(error.to_string()))?;
    Ok((text + "\n").into_bytes())
}
