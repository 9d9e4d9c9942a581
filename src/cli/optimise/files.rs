//! What `cutlab optimise` writes: designs, the table of the front, the page, and the progress from which it goes on.

use super::options::OptimiseArgs;
use super::page_file::OptimisedPageFile;
use crate::batch::fingerprint::Fingerprint;
use crate::batch::table::TableFormat;
use crate::cli::args::stone::display_name;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::limits::limits;
use crate::cli::outputs::Outputs;
use crate::design::Design;
use crate::design::edit::Editor;
use crate::optimise::{Optimisation, OptimiseRequest, Optimised};
use crate::progress::Progress;
use crate::render::record;
use crate::report::edited_file;
use crate::report::optimised_page::OptimisedPage;
use crate::report::target_format::TargetFormat;
use crate::search::Candidate;
use crate::stone::Stone;
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::journal::{Journal, JournalRemark};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The best design so far is written again when this has passed.
const PATIENCE: Duration = Duration::from_secs(1);

/// Where the results go.
pub struct OptimisedFiles<'a> {
    args: &'a OptimiseArgs,
    stone: &'a Stone,
    /// The first design's file; none if nothing is written.
    first: Option<PathBuf>,
    target: Option<TargetFormat>,
    table: Option<PathBuf>,
    /// In a folder.
    page: Option<OptimisedPageFile>,
    /// Of the request and of what its files hold.
    identity: String,
}

/// What stands beside the first design and says what it was made by.
#[derive(Serialize, Deserialize)]
struct Provenance {
    /// The command.
    command: String,
    /// Of the request and of what its files held.
    identity: String,
    /// The files that were made.
    files: Vec<String>,
}

/// Candidates as they come, kept for the next time.
pub struct KeptCandidates<'a> {
    files: &'a OptimisedFiles<'a>,
    state: Mutex<State>,
}

struct State {
    journal: Option<Journal>,
    next: u64,
    best: Option<Candidate>,
    written: Instant,
    failed: Option<WriteError>,
}

impl<'a> OptimisedFiles<'a> {
    /// Tries the place and the format before the work.
    pub fn new(
        args: &'a OptimiseArgs,
        request: &OptimiseRequest,
        stone: &'a Stone,
        console: &Console,
    ) -> Result<OptimisedFiles<'a>, CliError> {
        // what the stone is, not what it is called: its file, its material's and how it stands may change
        let planes = stone.design().map(Design::planes);
        let of_stone = format!("{} {planes:?} {:?}", display_name(&args.stone), stone.material());
        let identity = Fingerprint::of_request(&(request, of_stone)).hex();
        let usual = edited_file::usual_format(stone);
        let (first, target) = match &args.output {
            None => (None, None),
            Some(path) if atomic_write::is_stream(path) => {
                return Err(CliError::input(
                    "the designs of an optimisation go to files: name one, or a folder",
                ));
            }
            Some(path) if path.extension().is_none() || path.is_dir() => {
                let target = TargetFormat::by_name(usual)?;
                (Some(path.join(format!("best.{}", target.extension()))), Some(target))
            }
            Some(path) => (Some(path.clone()), Some(TargetFormat::from_path(path, None)?)),
        };
        let is_folder = first.is_some() && first != args.output;
        let in_folder = args.output.as_ref().filter(|_| is_folder).map(|folder| folder.join("front.csv"));
        let table = args.front.clone().or(in_folder);
        let folder = args.output.as_deref().filter(|_| is_folder);
        let page = OptimisedPageFile::new(folder, args.width, (request, &identity))?;
        if let Some(other) =
            args.front.as_ref().filter(|t| TableFormat::from_path(t).ok() != Some(TableFormat::Csv))
        {
            return Err(CliError::input(format!("{}: the table of the front is .csv", display_name(other))));
        }
        let files = OptimisedFiles { args, stone, first, target, table, page, identity };
        let mut outputs = Outputs::reading_stones([&args.stone], console);
        let is_begun = files.anchor().is_some_and(|path| {
            Journal::belongs_to(&Journal::path_for(path), &files.identity) || files.is_made_by_this(path)
        });
        let others = (2..=request.most_kept()).filter_map(|i| Some(numbered(files.first.as_ref()?, i)));
        for path in files.first.iter().chain(&files.table).cloned().chain(others) {
            outputs.claim(&path, |_| is_begun)?;
        }
        if let Some(page) = &files.page {
            page.claim(is_begun, &mut outputs)?;
        }
        Ok(files)
    }

    /// The file beside which progress and provenance are kept; none if nothing is written.
    fn anchor(&self) -> Option<&Path> {
        self.first.as_deref().or(self.table.as_deref())
    }

    /// Whether a file was made by this very request.
    fn is_made_by_this(&self, design: &Path) -> bool {
        let text = std::fs::read_to_string(provenance_path(design)).unwrap_or_default();
        serde_json::from_str::<Provenance>(&text).is_ok_and(|made| made.identity == self.identity)
    }

    /// What an earlier start has found, and where this one keeps what it finds.
    pub fn begin(&self, console: &Console) -> Result<(Vec<Candidate>, KeptCandidates<'_>), CliError> {
        let mut known: Vec<Candidate> = Vec::new();
        let mut journal = None;
        if let Some(anchor) = self.anchor() {
            if let Some(folder) = anchor.parent().filter(|p| !p.as_os_str().is_empty()) {
                std::fs::create_dir_all(folder)
                    .map_err(|cause| WriteError { path: folder.to_owned(), cause })?;
            }
            let tell = |remark| match remark {
                JournalRemark::Waiting => console.note("another process makes the same: waiting for it"),
                JournalRemark::Quarantined(to, why) => {
                    console.note(&format!("{why}: moved to {}", display_name(&to)));
                }
            };
            let mut opened = Journal::open(&Journal::path_for(anchor), &self.identity, &tell)?;
            opened.for_each(|payload| {
                known.push(serde_json::from_slice(payload)?);
                Ok(())
            })?;
            if !known.is_empty() {
                console.note(&format!("goes on after {} candidates", known.len()));
            }
            journal = Some(opened);
        }
        let next = known.len() as u64;
        let state =
            State { journal, next, best: best(known.iter()).cloned(), written: Instant::now(), failed: None };
        Ok((known, KeptCandidates { files: self, state: Mutex::new(state) }))
    }

    /// Writes the designs, the table of the front, the page and what they were made by; the names of the files.
    ///
    /// - `editor`: of the stone's design
    pub fn write(
        &self,
        found: &Optimised,
        (request, editor): (&OptimiseRequest, &Editor),
        kept: KeptCandidates<'_>,
        progress: &dyn Progress,
    ) -> Result<Vec<String>, CliError> {
        let mut files = Vec::new();
        if let Some(table) = &self.table {
            atomic_write::write(table, &super::text::front_table(found, request)?)?;
            files.push(display_name(table));
        }
        let Some(anchor) = self.anchor() else { return Ok(files) };
        let mut designs = Vec::new();
        for (i, finalist) in found.finalists.iter().enumerate() {
            let Some(first) = &self.first else { break };
            let path = if i == 0 { first.clone() } else { numbered(first, i + 1) };
            atomic_write::write(&path, &self.encoded(&finalist.edited.design)?)?;
            files.push(display_name(&path));
            designs.push(display_name(path.file_name().unwrap_or_default()));
        }
        // the last and the slowest: until it is there the journal stays, and the same command goes on
        if let Some(page) = self.page.as_ref().filter(|_| !designs.is_empty()) {
            let found = OptimisedPage::new(self.stone, request, editor, found);
            page.write(OptimisedPage { files: designs, ..found }, progress)?;
            files.push(display_name(page.path()));
        }
        let made = Provenance {
            command: record::own_command(),
            identity: self.identity.clone(),
            files: files.clone(),
        };
        let text = serde_json::to_string_pretty(&made).unwrap_or_default();
        atomic_write::write(&provenance_path(anchor), text.as_bytes())?;
        let state = kept.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(journal) = state.journal {
            journal.finish()?;
        }
        Ok(files)
    }

    fn encoded(&self, design: &Design) -> Result<Vec<u8>, CliError> {
        let Some(target) = self.target else { return Ok(Vec::new()) };
        let material = self.stone.given_material();
        let made = edited_file::encode((&self.args.stone, self.stone), design, material, target, limits())?;
        Ok(made.bytes)
    }
}

impl KeptCandidates<'_> {
    /// Keeps new candidates, and writes the best design so far if it is a new one.
    pub fn keep(&self, new: &[Candidate], optimisation: &Optimisation) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let State { journal, next, best: known, written, failed } = &mut *state;
        let Some(journal) = journal else { return };
        for candidate in new {
            let kept = serde_json::to_vec(candidate).unwrap_or_default();
            match journal.append(*next, &kept) {
                Ok(()) => *next += 1,
                Err(error) => *failed = Some(error),
            }
        }
        let found = best(new.iter().chain(known.iter())).cloned();
        if found == *known && *next > 1 {
            return;
        }
        *known = found;
        if *next == new.len() as u64 || written.elapsed() > PATIENCE {
            let design = known.as_ref().and_then(|best| {
                optimisation.candidates(&()).edited(&best.values).ok().map(|edited| edited.design)
            });
            let bytes = design.and_then(|design| self.files.encoded(&design).ok());
            if let (Some(bytes), Some(first)) = (bytes, &self.files.first) {
                *failed = failed.take().or(atomic_write::write(first, &bytes).err());
                *written = Instant::now();
            }
        }
    }

    /// Whether everything could be kept.
    pub fn ended(&self) -> Result<(), CliError> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.failed.take().map_or(Ok(()), |error| Err(error.into()))
    }
}

/// The best candidate for the first objective that breaks no bound.
fn best<'c>(candidates: impl Iterator<Item = &'c Candidate>) -> Option<&'c Candidate> {
    let feasible = candidates.filter(|c| c.outcome.is_feasible());
    feasible.reduce(|a, b| if b.outcome.objectives[0] > a.outcome.objectives[0] { b } else { a })
}

/// `best.asc` → `best-2.asc`.
fn numbered(first: &Path, number: usize) -> PathBuf {
    let mut name = first.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number}."));
    name.push(first.extension().unwrap_or_default());
    first.with_file_name(name)
}

/// `best.asc` → `best.asc.meta.json`.
fn provenance_path(design: &Path) -> PathBuf {
    let mut name = design.file_name().unwrap_or_default().to_owned();
    name.push(".meta.json");
    design.with_file_name(name)
}
