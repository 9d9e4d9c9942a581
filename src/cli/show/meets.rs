//! The meet network of a stone, as `cutlab show --meets` prints it.

use super::sheet;
use crate::cli::terminal_table;
use crate::design::edit::meets::{self, AngleRule, DepthRule, MeetReport, TierMeets};
use crate::storage::terminal::in_line;

/// The network, for people.
pub fn text(report: &MeetReport) -> String {
    let held = [
        ("outline", &report.outline),
        ("girdle", &report.girdle),
        ("table", &report.table),
        ("culet", &report.culet),
    ];
    let held = sheet::text(held.into_iter().map(|(label, text)| (label, in_line(text))).collect());
    let mut tiers = terminal_table::new();
    tiers.set_header(["tier", "", "facets", "angle", "", "depth"]);
    tiers.add_rows(report.tiers.iter().map(tier));
    let mut meets = terminal_table::new();
    meets.set_header(["corners", "height", "radius", "meet"]);
    meets.add_rows(report.meets.iter().map(|meet| {
        let percent = |x: f64| format!("{:.2} %", if x.abs() < 0.005 { 0.0 } else { x });
        [
            meet.corners.to_string(),
            percent(meet.height_percent),
            percent(meet.radius_percent),
            in_line(&meets::listed(&meet.tiers)),
        ]
    }));
    let [tiers, meets] = [&tiers, &meets].map(terminal_table::lines);
    let meets = if report.meets.is_empty() { "no corner has more than three facets\n".into() } else { meets };
    format!("{held}\n{tiers}\n{meets}{LEGEND}")
}

const LEGEND: &str = "\
angle free: others follow by their distances alone; bound: their angles follow too, or it cannot change
depth free: no meet sets it; heights are above the lowest point, radii from the axis, in % of the width
";

fn tier(tier: &TierMeets) -> Vec<String> {
    let angle = match tier.angle {
        AngleRule::Free => "free",
        AngleRule::Bound => "bound",
        AngleRule::Fixed => "",
    };
    let depth = match tier.depth {
        DepthRule::Meets => "set by meets",
        DepthRule::Free => "free",
        DepthRule::Outline => "the outline",
    };
    vec![
        tier.place.clone(),
        in_line(&tier.name),
        tier.facets.to_string(),
        format!("{:.2}°", tier.angle_deg),
        angle.into(),
        depth.into(),
    ]
}
