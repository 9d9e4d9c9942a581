//! One file of an import: read, and written in another format.

use super::options::{GenerateSettings, ImportArgs};
use super::rows::{ImportRow, PASSED_OVER, THERE, WRITTEN};
use crate::batch::output_places::Job;
use crate::cli::args::stone::{self, StoneArgs};
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::outputs::{self, Outputs};
use crate::cli::weight;
use crate::formats::{self, Encoded};
use crate::materials::weight::Weight;
use crate::report::diagram::Paper;
use crate::report::target_format::TargetFormat;
use crate::stone::{Stone, grammar};
use crate::storage::{atomic_write, output_path};

/// Imports one file.
///
/// - `outputs`: knows the files that are read, which are never written
pub fn import(
    job: &Job,
    args: &ImportArgs,
    form: TargetFormat,
    outputs: &Outputs,
    console: &Console,
) -> Result<ImportRow, CliError> {
    let file = stone::display_name(&job.stone);
    if job.by_chance {
        return Ok(ImportRow { file, outcome: PASSED_OVER, ..ImportRow::default() });
    }
    let to_stream = atomic_write::is_stream(&job.target);
    if !to_stream {
        outputs.check_inputs(&job.target)?;
        if console.force {
            output_path::check_writable(&job.target)?;
        }
    }
    let GenerateSettings { carat, stone_args, .. } = args.made.clone();
    let stone = StoneArgs { orientation: args.orientation, ..stone_args }.open(&job.stone)?;
    let size = match (carat, stone.design()) {
        (Some(carats), Some(design)) => {
            Some(weight::width_mm(&Weight::new(stone.material()), design, carats)?)
        }
        _ => args.size,
    };
    let stone = match size {
        Some(mm) => stone.with_width(mm)?,
        None => stone,
    };
    let (bytes, warnings) = encoded(&stone, job, args, form)?;
    let (format, facets) = (Some(stone.format()), Some(stone.facets()));
    let read = ImportRow { format, facets, warnings, ..ImportRow::default() };
    if to_stream || console.force {
        atomic_write::write(&job.target, &bytes)?;
    } else if job.target.symlink_metadata().is_ok() || !atomic_write::create(&job.target, &bytes)? {
        // an import that was interrupted, started again
        if !outputs::has_bytes(&job.target, &bytes) {
            return Err(CliError::exists(&file, &job.target));
        }
        return Ok(ImportRow { file, outcome: THERE, ..read });
    }
    Ok(ImportRow { file, outcome: WRITTEN, wrote: Some(stone::display_name(&job.target)), ..read })
}

/// The bytes of the file that is written, and what is to be said of it: of a mesh with concavities the mesh.
fn encoded(
    stone: &Stone,
    job: &Job,
    args: &ImportArgs,
    form: TargetFormat,
) -> Result<(Vec<u8>, Vec<String>), CliError> {
    let mut warnings = stone.warnings().to_vec();
    let bytes = match (stone.mesh(), form) {
        (Some(mesh), TargetFormat::Format(format)) if args.made.carat.is_none() => {
            let (file, name) =
                (stone::display_name(&job.stone), stone::display_name(grammar::file_stem(&job.stone)));
            let why = stone.why_not_convex().map_or_else(String::new, ToString::to_string);
            warnings = vec![why.strip_prefix(&format!("{file}: ")).unwrap_or(&why).to_owned()];
            formats::encode_mesh(&name, mesh, stone.unit(), format.name)?
        }
        _ => {
            let design = stone.convex_design()?;
            let paper = args.made.paper.unwrap_or(Paper::A4);
            let Encoded { bytes, remarks } = form.encoded(design, stone.given_material(), paper)?;
            warnings.extend(remarks);
            bytes
        }
    };
    Ok((bytes, warnings))
}
