//! What `cutlab show` draws of a stone: its cutting diagram, its virtual facets.

use super::options::ShowArgs;
use crate::cli::args::stone;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::outputs::{self, Outputs};
use crate::report::drawing_format::DrawingFormat;
use crate::report::target_format::TargetFormat;
use crate::report::virtual_facets;
use crate::storage::atomic_write;
use crate::trace::ConvexStone;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A virtual facet that holds less than this share of the light on the stone is not divided
/// further: in a drawing 800 units wide it is a point.
const LEAST_POWER: f64 = 1e-6;

/// Draws something of the only stone for a file.
type DrawFn = fn(&ShowArgs, &Path) -> Result<Drawn, CliError>;

/// What is drawn beside the numbers: every drawing is made and every place taken before the first is written.
pub struct Drawings(Vec<Drawn>);

impl Drawings {
    /// Those that were asked for.
    pub fn make(args: &ShowArgs) -> Result<Drawings, CliError> {
        let all = [(&args.diagram, draw_diagram as DrawFn), (&args.beams, draw_beams)];
        let given = all.into_iter().filter_map(|(path, draw)| Some((path.as_ref()?, draw)));
        Ok(Drawings(given.map(|(path, draw)| draw(args, path)).collect::<Result<_, _>>()?))
    }

    /// Writes them and says so.
    pub fn write(&self, outputs: &mut Outputs, console: &Console) -> Result<(), CliError> {
        for Drawn { path, bytes, .. } in &self.0 {
            outputs.claim(path, |there| outputs::has_bytes(there, bytes))?;
        }
        for Drawn { path, bytes, said } in &self.0 {
            atomic_write::write(path, bytes)?;
            console.note(said);
        }
        Ok(())
    }

    /// Whether standard output is one of them.
    pub fn take_stdout(&self) -> bool {
        self.0.iter().any(|drawn| atomic_write::is_stdout(&drawn.path))
    }
}

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
    let drawing = match DrawingFormat::from_path(path) {
        Some(drawing) => drawing,
        None if atomic_write::is_stream(path) => DrawingFormat::Svg,
        None => {
            let path = stone::display_name(path);
            return Err(CliError::input(format!("{path}: --diagram draws .svg, .pdf or .png")));
        }
    };
    let stone = args.stone_args.open(spec)?;
    let design = stone.convex_design()?;
    let target = TargetFormat::Drawing(drawing);
    let bytes = target.encoded(design, stone.given_material(), args.paper)?.bytes;
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
