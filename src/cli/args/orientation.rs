//! Which way up the stones of files stand, for every command that opens one.

use crate::cli::console::Console;
use crate::cli::exit_code::CliError;
use crate::design::orientation;
use crate::formats::Loaded;
use crate::geometry::ClosedMesh;
use crate::stone_spec::options::{Orientation, UpAxis};
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::{Mutex, OnceLock};

/// What is asked for on the command line.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct OrientationArgs {
    /// The axis of a stone's file that points up, through the table [z]
    #[arg(long, global = true, value_name = "x|y|z|-x|-y|-z", value_parser = axis, allow_hyphen_values = true,
        conflicts_with = "align", display_order = 999)]
    up: Option<UpAxis>,
    /// Stand the stone of a file upright: by its axis of symmetry, or else by its largest facet
    #[arg(long, global = true, display_order = 999)]
    align: bool,
}

/// Value parser of `--up`.
fn axis(text: &str) -> Result<UpAxis, String> {
    let text = text.to_lowercase();
    let found = UpAxis::ALL.iter().find(|(name, _)| *name == text.trim_start_matches('+'));
    Ok(found.ok_or("expected one of x, y, z, -x, -y, -z")?.1)
}

/// Set once, before the first stone is opened, with where remarks go.
static ASKED: OnceLock<(OrientationArgs, Console)> = OnceLock::new();

/// What all commands go by from here on.
pub fn set(standing: OrientationArgs, console: Console) {
    // only the first is kept, and there is one command line
    let _ = ASKED.set((standing, console));
}

fn asked() -> OrientationArgs {
    ASKED.get().map_or_else(OrientationArgs::default, |(standing, _)| *standing)
}

/// What was asked for, for a request.
pub fn requested() -> Orientation {
    let OrientationArgs { up, align } = asked();
    Orientation { up, align }
}

/// The stone as it is to stand; a stone of a file that nobody turned and that does not stand table up
/// gets a remark.
pub fn orient(mut imported: Loaded) -> Result<Loaded, CliError> {
    if imported.format == "library" {
        return Ok(imported);
    }
    let OrientationArgs { up, align } = asked();
    let solid = imported.design.solid()?;
    let up = match (up, align) {
        (Some(up), _) => up.direction(),
        (None, true) => orientation::up_of(&solid),
        (None, false) => {
            imported.warnings.extend(orientation::doubt(&solid));
            return Ok(imported);
        }
    };
    if up.distance(DVec3::Z) > 1e-9 {
        imported.design = imported.design.turned(orientation::turned_up(up));
    }
    Ok(imported)
}

/// A mesh with concavities, or in several parts, as it is to stand.
pub fn stood_body(failure: CliError) -> CliError {
    let OrientationArgs { up, align } = asked();
    failure.with_body(|body| {
        let up = match (up, align) {
            (Some(up), _) => up.direction(),
            (None, true) => orientation::up_of_body(&body),
            (None, false) => return body,
        };
        if up.distance(DVec3::Z) > 1e-9 { body.turned(orientation::turned_up(up)) } else { body }
    })
}

/// As [`note`], of a stone with concavities.
pub fn note_body(spec: &str, body: &ClosedMesh) {
    let OrientationArgs { up, align } = asked();
    if let (None, false, Some(said)) = (up, align, orientation::doubt_of_body(body)) {
        tell(spec, &said);
    }
}

/// Says once of each STONE that it does not stand table up, for commands that print no other remarks.
pub fn note(spec: &str, imported: &Loaded) {
    if let Some(said) =
        imported.warnings.iter().find(|w| w.starts_with(orientation::MAX_TRUSTED_DEVIATION_DEG))
    {
        tell(spec, said);
    }
}

/// Says something of a STONE, once.
fn tell(spec: &str, said: &str) {
    static TOLD: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if let (Some((_, console)), Ok(mut told)) = (ASKED.get(), TOLD.lock())
        && told.insert(spec.to_owned())
    {
        console.note(&format!("note: {spec}: {said}"));
    }
}
