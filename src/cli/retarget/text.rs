//! How a design was made for another stone, for people.

use crate::cli::terminal_table::{self, NONE};
use crate::design::retarget::Retargeted;

/// The figures, for people.
pub fn head(made: &Retargeted) -> Vec<String> {
    let figures = &made.figures;
    let (n, c, p) = (figures.refractive_index, figures.critical_angle_deg, figures.pavilion_angle_deg);
    let lines = vec![
        format!("n {:.4} → {:.4}, critical angle {:.2}° → {:.2}°", n.before, n.after, c.before, c.after),
        format!(
            "pavilion by {} {:.2}° → {:.2}°: tangents × {:.4}; crown: tangents × {:.4}",
            figures.pavilion_tier, p.before, p.after, figures.pavilion_scale, figures.crown_scale
        ),
    ];
    lines.into_iter().chain(trials(made)).collect()
}

/// What every pair of rules scores, a line for each of the pavilion's; nothing where no rule was chosen.
fn trials(made: &Retargeted) -> Vec<String> {
    let (mut crowns, mut rows): (Vec<String>, Vec<Vec<String>>) = (Vec::new(), Vec::new());
    let mut last = None;
    for trial in &made.trials {
        if last.replace(trial.pavilion) != Some(trial.pavilion) {
            rows.push(vec![format!("pavilion {}", trial.pavilion)]);
        }
        if rows.len() == 1 {
            crowns.push(format!("crown {}", trial.crown));
        }
        let is_best = trial.pavilion == made.figures.pavilion_rule && trial.crown == made.figures.crown_rule;
        let score = trial.score.map_or_else(|| NONE.into(), |iso| format!("{iso:.1}"));
        let cell = if is_best { score + " *" } else { score };
        if let Some(row) = rows.last_mut() {
            row.push(cell);
        }
    }
    if rows.is_empty() {
        return Vec::new();
    }
    let mut table = terminal_table::new();
    table.set_header(["ISO".to_owned()].into_iter().chain(crowns));
    table.add_rows(rows);
    let mut lines: Vec<String> = terminal_table::lines(&table).lines().map(String::from).collect();
    lines.push("ISO is the mean of 0° and 10° of tilt; * the best, which is taken".into());
    lines
}
