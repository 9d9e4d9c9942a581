//! `cutlab show`: what a cutter or a grader reads off a stone.

mod measured;
mod mesh;
mod sheet;
mod tiers;

use super::args::stone::{self, StoneArgs};
use super::console::Console;
use super::diagram_output::{self, DiagramFormat};
use super::exit_code::{CliError, ExitStatus, MeshFacts};
use super::outputs::{self, Outputs};
use super::weight;
use crate::batch::stone_files::expand_stones;
use crate::cli::limits::limits;
use crate::design::gia_envelopes;
use crate::design::proportions::{self, Ratios};
use crate::design::round_brilliant_measures::FacetLengths;
use crate::design::symmetry::Symmetry;
use crate::design::{Design, LengthUnit};
use crate::formats;
use crate::geometry::Polyhedron;
use crate::materials::Material;
use crate::materials::weight::Weight;
use crate::optics::fresnel::critical_angle_deg;
use crate::report::diagram::Paper;
use crate::report::virtual_facets;
use crate::stone::Stone;
use crate::storage::atomic_write;
use crate::storage::terminal::in_line;
use crate::trace::ConvexStone;
use measured::{MeasuredProportions, figure, symmetry};
use mesh::MeshSheet;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use tiers::TierRow;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Every measure follows from the planes alone, so that a stone measures alike in every file format.
Percentages are of the girdle width, the least distance of two parallel lines around the outline.
Crown and pavilion angle are those of the main facet across the width. Main facets are those that span the
greatest height of their side: the mains of a brilliant, the first step of a step cut. Of these the one
counts that faces along the width most nearly, and of several that do so alike the steepest.
The weight is that of --material. A design drawn for an index is weighed as the known material nearest to
it, if one lies within 0.01; a stone without either is weighed as diamond.")]
pub struct ShowArgs {
    /// Stones: names from `cutlab list cuts`, with parameters or not, files, folders of files, patterns
    #[arg(required = true, value_name = "STONE")]
    stones: Vec<OsString>,
    /// Girdle width in millimetres, for volume in mm³ and weight
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    /// Weight in carats, in place of --size: the width follows from the material's density
    #[arg(long, value_name = "CT", value_parser = weight::carats, conflicts_with = "size")]
    carat: Option<f64>,
    #[command(flatten)]
    stone_args: StoneArgs,
    /// Also draw the virtual facets of the stone, face-up: by exact beams, shaded by where the
    /// strongest light of each point comes from; SVG (one stone only)
    #[arg(long, value_name = "PATTERN.svg")]
    beams: Option<PathBuf>,
    /// Also draw the cutting diagram, one page: SVG, PDF or PNG by its extension (one stone only)
    #[arg(long, value_name = "DIAGRAM.svg")]
    diagram: Option<PathBuf>,
    /// Paper of the cutting diagram
    #[arg(long, value_name = "a4|letter", default_value = "a4", value_parser = diagram_output::paper)]
    paper: Paper,
}

/// A virtual facet that holds less than this share of the light on the stone is not divided
/// further: in a drawing 800 units wide it is a point.
const LEAST_POWER: f64 = 1e-6;

/// One stone as JSON. Lengths are in `unit`, percentages of the girdle width.
#[derive(Debug, Serialize)]
struct StoneSheet {
    file: String,
    format: String,
    name: String,
    facets: usize,
    closed: bool,
    convex: bool,
    /// In the file's own unit cubed.
    volume: f64,
    unit: &'static str,
    /// Length of the unit in the text's, which is millimetres where the file has one.
    #[serde(skip)]
    unit_mm: f64,
    facets_by_kind: BTreeMap<&'static str, usize>,
    #[serde(flatten)]
    measured: MeasuredProportions,
    /// The faceter's ratios, W as GemCad takes it: corner to corner in a round stone.
    ratios: Ratios,
    symmetry: Symmetry,
    #[serde(skip_serializing_if = "Option::is_none")]
    brilliant: Option<FacetLengths>,
    /// Whether the envelopes apply: they are for diamonds.
    #[serde(skip)]
    graded: bool,
    /// The proportion envelope of a round brilliant of diamond; no grade.
    #[serde(skip_serializing_if = "Option::is_none")]
    proportion_envelope: Option<&'static str>,
    tiers: Vec<TierRow>,
    material: String,
    refractive_index: f64,
    critical_angle_deg: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// What is shown of a file.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Shown {
    Stone(Box<StoneSheet>),
    Mesh(MeshSheet),
}

/// A file that holds no stone, as JSON.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum BadStone {
    /// Understood, but open.
    NoStone {
        file: String,
        format: &'static str,
        facets: Option<usize>,
        closed: bool,
        convex: Option<bool>,
        volume: Option<f64>,
        reason: String,
    },
    Error {
        file: String,
        error: String,
    },
}

impl BadStone {
    fn new(file: &str, failure: &CliError) -> BadStone {
        let (file, why) = (file.to_string(), failure.message());
        match failure.shape() {
            Some(&MeshFacts { format, facets, closed, convex, .. }) => {
                BadStone::NoStone { file, format, facets, closed, convex, volume: None, reason: why }
            }
            None => BadStone::Error { file, error: why },
        }
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum ShownEntry<'a> {
    Good(&'a Shown),
    Bad(BadStone),
}

/// Shows every stone.
pub fn run(args: &ShowArgs, console: &Console) -> Result<ExitStatus, CliError> {
    if [&args.beams, &args.diagram].into_iter().flatten().filter(|p| atomic_write::is_stdout(p)).count() > 1 {
        return Err(CliError::input(
            "one drawing at a time goes to standard output: name a file for the other",
        ));
    }
    let stones = expand_stones(&args.stones, limits())?;
    let mut outputs = Outputs::reading_stones(&stones, console);
    let drawings = [(&args.diagram, draw_diagram as DrawFn), (&args.beams, draw_beams)];
    let given = drawings.into_iter().filter_map(|(path, draw)| Some((path.as_ref()?, draw)));
    // every drawing is made and every place taken before the first is written
    let drawn: Vec<Drawn> = given.map(|(path, draw)| draw(args, path)).collect::<Result<_, _>>()?;
    for Drawn { path, bytes, .. } in &drawn {
        outputs.claim(path, |there| outputs::has_bytes(there, bytes))?;
    }
    for Drawn { path, bytes, said } in &drawn {
        atomic_write::write(path, bytes)?;
        console.note(said);
    }
    if drawn.iter().any(|d| atomic_write::is_stdout(&d.path)) {
        return Ok(ExitStatus::Done); // standard output is the drawing
    }
    let results = stone::open_each(&stones, console, "reading", |spec| shown(spec, args));
    let names = stones.iter().map(stone::display_name);
    let pairs = names.zip(&results);
    if console.json {
        let entries: Vec<ShownEntry> = pairs
            .map(|(file, result)| match result {
                Ok(sheet) => ShownEntry::Good(sheet),
                Err(failure) => ShownEntry::Bad(BadStone::new(&file, failure)),
            })
            .collect();
        console.print_json(&entries)?;
    } else {
        let mut text = String::new();
        for shown in results.iter().flatten() {
            if !text.is_empty() {
                text.push('\n');
            }
            text += &match shown {
                Shown::Stone(sheet) => sheet.text(),
                Shown::Mesh(mesh) => mesh.text(),
            };
        }
        if !text.is_empty() {
            console.print(&text)?;
        }
        results.iter().filter_map(|r| r.as_ref().err()).for_each(|f| console.complain(&f.message()));
    }
    Ok(stone::code(&results))
}

/// Draws something of the only stone for a file.
type DrawFn = fn(&ShowArgs, &Path) -> Result<Drawn, CliError>;

/// A drawing, where it goes, and what is said of it.
struct Drawn {
    path: PathBuf,
    bytes: Vec<u8>,
    said: String,
}

/// The only stone, for what draws one.
fn only<'a>(args: &'a ShowArgs, option: &str) -> Result<&'a OsStr, CliError> {
    match &args.stones[..] {
        [spec] => Ok(spec),
        _ => Err(CliError::input(format!("{option} draws one stone: name one"))),
    }
}

/// Draws the cutting diagram of the only stone.
fn draw_diagram(args: &ShowArgs, path: &Path) -> Result<Drawn, CliError> {
    let spec = only(args, "--diagram")?;
    let drawing = match DiagramFormat::from_path(path) {
        Some(drawing) => drawing,
        None if atomic_write::is_stream(path) => DiagramFormat::Svg,
        None => {
            let path = stone::display_name(path);
            return Err(CliError::input(format!("{path}: --diagram draws .svg, .pdf or .png")));
        }
    };
    let stone = args.stone_args.open(spec)?;
    let design = stone.convex_design()?;
    let asked = stone.given_material().map(Material::index_d);
    let bytes = drawing.bytes(design, asked.or(design.refractive_index), args.paper)?;
    Ok(Drawn { path: path.into(), bytes, said: format!("wrote {}", stone::display_name(path)) })
}

/// Draws the virtual facets of the only stone.
fn draw_beams(args: &ShowArgs, path: &Path) -> Result<Drawn, CliError> {
    let spec = only(args, "--beams")?;
    if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("svg")) && !atomic_write::is_stream(path) {
        return Err(CliError::input(format!("{}: --beams draws SVG alone", stone::display_name(path))));
    }
    let stone = args.stone_args.open(spec)?;
    let solid = stone.convex_design()?.solid()?;
    let pattern = virtual_facets::draw(&ConvexStone::new(solid), stone.material().index_d(), LEAST_POWER);
    let said = format!("{}: {} virtual facets", stone::display_name(path), pattern.polygons);
    Ok(Drawn { path: path.into(), bytes: pattern.svg.into_bytes(), said })
}

fn shown(spec: &OsStr, args: &ShowArgs) -> Result<Shown, CliError> {
    let stone = args.stone_args.open(spec)?;
    match (stone.design(), stone.solid()) {
        (Some(design), Some(solid)) => Ok(Shown::Stone(Box::new(sheet(&stone, design, solid, args)?))),
        _ => MeshSheet::new(&stone).map(Shown::Mesh).ok_or_else(|| CliError::input("neither solid nor mesh")),
    }
}

fn sheet(
    stone: &Stone,
    design: &Design,
    solid: &Polyhedron,
    args: &ShowArgs,
) -> Result<StoneSheet, CliError> {
    let index = stone.material().index_d();
    let p = proportions::measure(solid);
    // a glTF too wide for metres has its own numbers
    let in_mm = design.unit == LengthUnit::Millimetre;
    let unit_mm = formats::unit_mm(stone.format()).filter(|_| in_mm).unwrap_or(1.0);
    let weight = Weight::new(stone.material());
    let size = match args.carat {
        Some(carats) => Some(weight::width_mm(&weight, design, carats)?),
        None => args.size,
    };
    Ok(StoneSheet {
        file: stone.name().into(),
        format: stone.format().into(),
        name: design.name.clone(),
        facets: p.facets,
        closed: true,
        convex: true, // what the readers let through is the solid of its planes
        volume: p.volume / unit_mm.powi(3),
        unit: measured::unit_name(design.unit, stone.format()),
        unit_mm,
        facets_by_kind: p.by_zone.iter().copied().collect(),
        measured: MeasuredProportions::new(&p, design, size, &weight).in_unit_of(unit_mm),
        tiers: TierRow::all(design, solid),
        brilliant: p.brilliant,
        proportion_envelope: gia_envelopes::envelope(&p).filter(|_| weight.is_diamond()),
        graded: weight.is_diamond(),
        ratios: Ratios { w: p.ratios.w / unit_mm, ..p.ratios },
        symmetry: p.symmetry,
        material: stone.material().name.to_string(),
        refractive_index: index,
        critical_angle_deg: critical_angle_deg(index),
        warnings: stone.warnings().to_vec(),
    })
}

impl StoneSheet {
    fn text(&self) -> String {
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
        format!("{} ({})\n{}", in_line(&self.file), self.format, sheet::text(lines))
    }
}
