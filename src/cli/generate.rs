//! `cutlab generate`: a stone from its parameters.

mod folder;
mod made;
mod options;

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::outputs::{self, Outputs};
use crate::design::families;
use crate::formats::Encoded;
use crate::report::target_format::TargetFormat;
use crate::stone::grammar;
use crate::storage::atomic_write;
pub use options::GenerateArgs;
use options::USUAL_FORMAT;
use std::path::{Path, PathBuf};

/// What was made, for `--json`.
#[derive(serde::Serialize)]
struct GeneratedStone {
    name: String,
    facets: usize,
    made_up_of: String,
    files: Vec<String>,
}

/// Makes the stone and writes it.
pub fn run(args: &GenerateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    if Path::new(&args.stone).is_dir() {
        return folder::run(args, console);
    }
    // refused before the work, and before anything is said
    let usual = TargetFormat::by_name(args.to.as_deref().unwrap_or(USUAL_FORMAT))?;
    let mut forms = forms(args)?;
    let (stone, mut notes) = made::stone(args)?;
    let design = stone.convex_design()?;
    let (made_up_of, facets) = families::facet_summary(design)?;

    let mut files = args.output.clone();
    if files.is_empty() {
        let mut name = grammar::file_stem(&args.stone);
        name.push(format!("-{facets}.{}", usual.extension()));
        files.push(name.into());
        forms.push(usual);
    }
    let mut encoded: Vec<Vec<u8>> = Vec::new();
    for form in forms {
        let Encoded { bytes, remarks } = form.encoded(design, stone.given_material(), args.paper)?;
        notes.extend(remarks.iter().map(|said| format!("note: {}: {said}", form.extension())));
        encoded.push(bytes);
    }
    write(args, (&files, &encoded), &notes, console)?;
    let summary = format!("{}: {facets} facets = {made_up_of}", design.name);
    if files.iter().any(|f| atomic_write::is_stdout(f)) {
        console.note(&summary);
    } else if console.json {
        let files = files.iter().map(stone::display_name).collect();
        console.print_json(&GeneratedStone { name: design.name.clone(), facets, made_up_of, files })?;
    } else {
        console.tell(&summary)?;
    }
    Ok(ExitStatus::Done)
}

/// What each file of `-o` is written as.
fn forms(args: &GenerateArgs) -> Result<Vec<TargetFormat>, CliError> {
    let to = args.to.as_deref();
    let to_stream = args.output.iter().any(|file| atomic_write::is_stream(file));
    let form = |file: &PathBuf| match atomic_write::is_stream(file) {
        true => TargetFormat::for_stream(file, to, USUAL_FORMAT),
        // beside a stream --to is the stream's
        false => TargetFormat::from_path(file, to.filter(|_| !to_stream)),
    };
    Ok(args.output.iter().map(form).collect::<Result<_, _>>()?)
}

/// Takes the place of every file, says the notes, and writes.
fn write(
    args: &GenerateArgs,
    (files, encoded): (&[PathBuf], &[Vec<u8>]),
    notes: &[String],
    console: &Console,
) -> Result<(), CliError> {
    let mut outputs = Outputs::reading_stones([&args.stone], console);
    for (file, bytes) in files.iter().zip(encoded) {
        outputs.claim(file, |there| outputs::has_bytes(there, bytes))?;
    }
    notes.iter().for_each(|note| console.note(note));
    for (file, bytes) in files.iter().zip(encoded) {
        atomic_write::write(file, bytes)?;
        if !atomic_write::is_stdout(file) {
            console.note(&format!("wrote {}", stone::display_name(file)));
        }
    }
    Ok(())
}
