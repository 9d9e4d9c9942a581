//! The entries of the materials.

use super::CatalogueEntry;
use super::entries::block;
use crate::color::{Illuminant, cie};
use crate::materials::{Birefringence, MATERIALS, Material};
use crate::optics::absorption::Absorption;
use crate::optics::dispersion::lines;
use glam::Vec3;
use serde_json::{Value, json};

/// Depth at which a material shows its colour, mm: what light goes through in a small stone.
const DEPTH_MM: f64 = 10.0;

/// Depth at which the colours along the axes are given, mm: some thickness of a stone, as through a dichroscope.
const AXIS_DEPTH_MM: f64 = 5.0;

/// Materials.
pub fn materials() -> Vec<CatalogueEntry> {
    MATERIALS.iter().map(material).collect()
}

fn material(m: &Material) -> CatalogueEntry {
    let b_g = m.index(lines::G) - m.index(lines::B);
    let valid = valid_nm(m);
    let density = m.specific_gravity.map_or_else(|| "unknown".into(), |sg| format!("{sg} g/cm³"));
    let colour = through(m);
    let indices = indices(m);
    let mut lines = vec![
        ("index", indices.clone()),
        ("crystal", crystal(m)),
        ("dispersion", format!("n_G − n_B {b_g:.4}")),
        ("valid", format!("{:.0} to {:.0} nm", valid[0], valid[1])),
        ("density", density.clone()),
        (
            "colour",
            colour
                .as_ref()
                .map_or_else(|| "none".into(), |c| format!("{c} through {DEPTH_MM} mm by daylight")),
        ),
        ("along the axes", pleochroism(m)),
    ];
    lines.extend(absorptions(m).into_iter().map(|(label, a)| (label, format!("{}; {}", a.about, a.source))));
    lines.push(("source", m.source.to_string()));
    let text = block(&format!("{}: {}", m.name, m.about), &lines);
    let about = format!("{indices}, B–G {b_g:.4}, {density}: {}", m.about);
    CatalogueEntry { name: m.name.to_string(), about, text, facts: facts(m, b_g, colour) }
}

fn facts(m: &Material, b_g: f64, colour: Option<String>) -> Value {
    let [alpha, beta, gamma] = m.principal_indices(lines::D).map(round);
    let is_uniaxial = matches!(m.crystal, Some(Birefringence::Uniaxial { .. }));
    let is_biaxial = matches!(m.crystal, Some(Birefringence::Biaxial { .. }));
    let source = |a: &Absorption| json!({ "about": a.about, "source": a.source });
    let absorptions: serde_json::Map<String, Value> = absorptions(m)
        .into_iter()
        .filter(|(label, _)| *label != "absorption")
        .map(|(label, a)| (label.into(), source(a)))
        .collect();
    let colours = m.axis_colours(&Illuminant::daylight(), AXIS_DEPTH_MM).into_iter().map(|colour| {
        let lab = [colour.lab.l, colour.lab.a, colour.lab.b].map(|x| (f64::from(x) * 10.0).round() / 10.0);
        (colour.axis.to_owned(), json!({ "srgb": hex(colour.linear_srgb), "lab": lab }))
    });
    json!({
        "n_d": round(m.index_d()),
        "n_e": is_uniaxial.then_some(gamma),
        "n_alpha_beta_gamma": is_biaxial.then_some([alpha, beta, gamma]),
        "class": m.optical_class().to_string(),
        "birefringence": round(m.birefringence()),
        "optic_angle_2v_deg": m.optic_angle_deg().map(|angle| (angle * 10.0).round() / 10.0),
        "c_axis": m.crystal.as_ref().map(|_| m.orientation.to_string()),
        "dispersion_b_g": round(b_g),
        "valid_nm": valid_nm(m),
        "density_g_cm3": m.specific_gravity,
        "colour_10_mm": colour,
        "axis_colours_5_mm": (!m.is_clear()).then(|| colours.collect::<serde_json::Map<String, Value>>()),
        "absorption": m.absorption.as_ref().map(source),
        "axis_absorptions": (!absorptions.is_empty()).then_some(absorptions),
        "source": m.source,
    })
}

fn valid_nm(m: &Material) -> [f64; 2] {
    <[f64; 2]>::from(m.valid_nm).map(f64::round)
}

/// The indices at D by their names.
fn indices(m: &Material) -> String {
    let [alpha, beta, gamma] = m.principal_indices(lines::D);
    match &m.crystal {
        None => format!("n {beta:.4}"),
        Some(Birefringence::Uniaxial { .. }) => format!("n_o {beta:.4} n_e {gamma:.4}"),
        Some(Birefringence::Biaxial { .. }) => format!("n_α {alpha:.4} n_β {beta:.4} n_γ {gamma:.4}"),
    }
}

/// Class and sign, birefringence, and how the axes usually lie.
fn crystal(m: &Material) -> String {
    if m.crystal.is_none() {
        return m.optical_class().to_string();
    }
    let angle = m.optic_angle_deg().map_or_else(String::new, |angle| format!(", 2V {angle:.0}°"));
    let (class, difference) = (m.optical_class(), m.birefringence());
    format!("{class}, birefringence {difference:.4}{angle}, c-axis {}", m.orientation)
}

/// The colours along the axes of a pleochroic material.
fn pleochroism(m: &Material) -> String {
    if !m.is_pleochroic() {
        return String::new();
    }
    let colours = m.axis_colours(&Illuminant::daylight(), AXIS_DEPTH_MM);
    let named: Vec<String> =
        colours.iter().map(|colour| format!("{} {}", symbol(colour.axis), hex(colour.linear_srgb))).collect();
    format!("{} through {AXIS_DEPTH_MM} mm by daylight", named.join(", "))
}

fn symbol(axis: &str) -> &str {
    match axis {
        "alpha" => "α",
        "beta" => "β",
        "gamma" => "γ",
        other => other,
    }
}

/// What it absorbs, by the name of the file's table: first its own, then that of the other axes that have one.
fn absorptions(m: &Material) -> Vec<(&'static str, &Absorption)> {
    let others = match &m.crystal {
        None => vec![],
        Some(Birefringence::Uniaxial { extraordinary }) => vec![("extraordinary", extraordinary)],
        Some(Birefringence::Biaxial { alpha, gamma }) => vec![("alpha", alpha), ("gamma", gamma)],
    };
    let own = m.absorption.iter().map(|absorption| ("absorption", absorption));
    own.chain(others.into_iter().filter_map(|(name, axis)| Some((name, axis.absorption.as_ref()?)))).collect()
}

/// To six decimals, beyond which no index is known.
fn round(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

/// The colour of daylight through [`DEPTH_MM`] of a material that absorbs, as `#rrggbb`; its field across the axis, or
/// along β.
fn through(m: &Material) -> Option<String> {
    let absorption = m.absorption.as_ref()?;
    let left = |nm: f32| (-DEPTH_MM * absorption.per_mm(f64::from(nm))).exp() as f32;
    Some(hex(Illuminant::daylight().linear_srgb(left)))
}

/// A colour as `#rrggbb`.
fn hex(linear: Vec3) -> String {
    let [r, g, b] = linear.to_array().map(|x| (255.0 * cie::srgb_encode(x)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
