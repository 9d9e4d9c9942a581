//! The sheet of a convex stone, for people.

use super::measured::{figure, symmetry};
use super::meets;
use super::sheet;
use super::stone_sheet::StoneSheet;
use super::tiers::TierRow;
use crate::storage::terminal::in_line;

impl StoneSheet {
    /// Lines for people.
    pub fn text(&self) -> String {
        let mut lines: Vec<(&str, String)> = Vec::new();
        let mut line = |label, value| lines.push((label, value));
        if !self.name.is_empty() && self.name != self.file {
            line("name", in_line(&self.name));
        }
        let kinds: Vec<String> = ["table", "crown", "girdle", "pavilion", "culet"]
            .iter()
            .filter_map(|k| self.facets_by_kind.get(k).filter(|n| **n > 0).map(|n| format!("{n} {k}")))
            .collect();
        line("facets", format!("{} = {}", self.facets, kinds.join(" + ")));
        let m = &self.measured;
        let angle = |a: Option<f64>| a.map_or("no facets".into(), |a| format!("{a:.2}°"));
        let (k, is_free) = (self.unit_mm, self.unit == "file");
        let unit = if is_free { "" } else { " mm" };
        line("table", m.table_percent.map_or("none".into(), |t| format!("{t:.2} %")));
        line("crown", format!("{}, height {:.2} %", angle(m.crown_angle_deg), m.crown_height_percent));
        line("pavilion", format!("{}, depth {:.2} %", angle(m.pavilion_angle_deg), m.pavilion_depth_percent));
        line("girdle", format!("{:.2} % at its thick places", m.girdle_percent));
        if m.culet_percent > 0.0 {
            line("culet", format!("{:.2} %", m.culet_percent));
        }
        line("depth", format!("{:.2} %", m.depth_percent));
        if let Some(b) = &self.brilliant {
            line("star", format!("{:.1} %, lower half {:.1} %", b.star_percent, b.lower_half_percent));
        }
        if self.brilliant.is_some() && self.graded {
            let envelope = self.proportion_envelope.map_or("outside the proportion envelopes".into(), |e| {
                format!("within the proportion envelope of {e}")
            });
            line(
                "envelope",
                format!("{envelope} (GIA's table of single proportions, which is necessary only)"),
            );
        }
        line("width × length", format!("{} × {}{unit}", figure(k * m.width, 4), figure(k * m.length, 4)));
        line(
            "volume",
            match is_free {
                true => format!("{} in the file's own unit", figure(self.volume, 6)),
                false => format!("{:.4} mm³", k.powi(3) * self.volume),
            },
        );
        if let (Some(mm), Some(mm3)) = (m.width_mm, m.volume_mm3) {
            let weight = match (m.carats, &m.weighed_as) {
                (Some(ct), Some(name)) => format!("{ct:.3} ct in {name}"),
                _ => "not known".into(),
            };
            let why = m.weight_note.as_ref().map_or(String::new(), |why| format!("; {why}"));
            line("weight", format!("{weight} ({mm3:.3} mm³ at a width of {mm:.3} mm){why}"));
        }
        let r = &self.ratios;
        let t_w = r.t_w.map_or(String::new(), |t| format!("T/W {t:.3}  "));
        line(
            "ratios",
            format!(
                "{t_w}P/W {:.3}  C/W {:.3}  H/W {:.3}  L/W {:.3}  Vol/W³ {:.4}  (W {:.4}, measured as GemCad does)",
                r.p_w,
                r.c_w,
                r.h_w,
                r.l_w,
                r.vol_w3,
                k * r.w
            ),
        );
        line("symmetry", symmetry(&self.symmetry));
        line("closed", "yes".into());
        line("convex", "yes".into());
        line(
            "critical angle",
            format!("{:.2}° ({}, n {:.4})", self.critical_angle_deg, self.material, self.refractive_index),
        );
        let tiers = self.tiers.chunk_by(TierRow::reads_like).map(TierRow::joined);
        tiers.enumerate().for_each(|(i, t)| line(if i == 0 { "tiers" } else { "" }, t.text()));
        self.warnings.iter().for_each(|w| line("note", w.clone()));
        let meets = self.meets.as_ref().map_or_else(String::new, |m| format!("\n{}", meets::text(m)));
        format!("{} ({})\n{}{meets}", in_line(&self.file), self.format, sheet::text(lines))
    }
}
