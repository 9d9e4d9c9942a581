//! Sidecar of a table: the file beside it that says what its columns mean and how it was made.
//!
//! The sidecar of `NAME.csv` is `NAME.csv.meta.json`, its own; versions before it shared
//! `NAME.meta.json` among the tables of one name, which is still read.

use super::fingerprint::{BUILD, canonical};
use super::request::TableRequest;
use super::shard::Shard;
use super::table::TableFormat;
use super::table_job::TableSummary;
use crate::limits::{self, Limits};
use crate::scoring::score::ScoreRequest;
use crate::storage::atomic_write::{self, WriteError};
use crate::storage::{bounded_read, text};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// What a sidecar's name has after its table's.
const ENDING: &str = ".meta.json";

/// What stands in `NAME.csv.meta.json` beside the table `NAME.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TableMeta {
    /// Always `cutlab`.
    pub program: String,
    /// Its version.
    pub version: String,
    /// Its build ([`super::fingerprint::BUILD`]); empty in sidecars older than that.
    #[serde(default)]
    pub build: String,
    /// The command with every setting spelled out, without output and shard.
    pub command: String,
    /// The same as data: the canonical request. Absent in sidecars of versions before 0.2.
    #[serde(skip_serializing_if = "Value::is_null", default)]
    pub request: Value,
    /// Seed of the random streams: the same for every row.
    pub seed: u64,
    /// Digest of build, request and inputs: parts of one table have it in common.
    pub study: String,
    /// The table's columns.
    pub columns: Vec<String>,
    /// What its scores can be drawn against; none for a table of stones as they are.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub layout: Option<TableLayout>,
    /// Rows of the whole table.
    pub total: u64,
    /// The part of it that this table is; none for the whole.
    pub shard: Option<Shard>,
    /// Rows, failures and sample counts of this table.
    #[serde(flatten)]
    pub summary: TableSummary,
    /// CRC-32 of this table's bytes, hexadecimal.
    pub crc32: String,
    /// What the scores mean.
    pub metrics: Vec<Definition>,
}

/// What the scores of a table can be drawn against.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TableLayout {
    /// The stone that is varied, for titles; empty if the table has several.
    pub stone: String,
    /// Columns along the axes: one for curves, two for a map.
    pub axes: Vec<String>,
    /// Columns that tell the curves of one plot apart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curves: Vec<String>,
    /// Whether the points are spread over the axes and form no grid.
    #[serde(default)]
    pub scattered: bool,
    /// Whether the stone is of diamond at every point.
    #[serde(default)]
    pub is_diamond: bool,
}

/// One metric of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Definition {
    /// Its name: the column; `NAME_se` is its standard error.
    pub name: String,
    /// One line for people.
    pub about: String,
    /// Its unit; empty for a fraction.
    pub unit: String,
    /// What an error asked for is measured against.
    pub scale: f64,
    /// Half-angle in degrees of the observer's dark cone as used, if it has one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub observer: Option<f64>,
    /// The estimator that it reads.
    pub experiment: String,
    /// Illumination, observer, polarisation, wavelengths, what counts, normalisation.
    pub definition: String,
    /// Where the definition is from.
    pub source: String,
}

impl TableMeta {
    /// The sidecar of a whole table of a plan's scores, without rows, layout and checksum.
    ///
    /// - `study`: digest of build, request and inputs
    pub fn new(request: &TableRequest, study: String, columns: Vec<String>) -> TableMeta {
        let plan = request.scores();
        TableMeta {
            program: "cutlab".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            build: BUILD.into(),
            command: request.command(),
            request: canonical(request),
            seed: plan.seed,
            study,
            columns,
            layout: None,
            total: 0,
            shard: None,
            summary: TableSummary::default(),
            crc32: String::new(),
            metrics: TableMeta::definitions(plan),
        }
    }

    /// Where the sidecar of `table` is written.
    pub fn path_for(table: &Path) -> PathBuf {
        let mut name = table.as_os_str().to_owned();
        name.push(ENDING);
        name.into()
    }

    /// Where the sidecar of `table` is read: as [`TableMeta::path_for`], or where versions before it put
    /// it if there alone is one.
    pub fn find_for(table: &Path) -> PathBuf {
        let (own, old) = (TableMeta::path_for(table), table.with_extension("meta.json"));
        if own.symlink_metadata().is_err() && old.symlink_metadata().is_ok() { old } else { own }
    }

    /// Whether a file has a sidecar's name.
    pub fn is_sidecar(path: &Path) -> bool {
        path.file_name().is_some_and(|name| name.as_encoded_bytes().ends_with(ENDING.as_bytes()))
    }

    /// Whether a file is a table that has its sidecar.
    pub fn exists_for(table: &Path) -> bool {
        TableFormat::from_path(table).is_ok()
            && table.extension().is_some()
            && TableMeta::find_for(table).is_file()
    }

    /// Whether the file at `table` is the table, or the part of it, whose sidecar `is_of`, with nothing
    /// changed since.
    pub fn belongs_to(
        table: &Path,
        is_of: &dyn Fn(&TableMeta) -> bool,
        shard: Option<Shard>,
        limits: Limits,
    ) -> bool {
        let sum = || bounded_read::open_regular(table).and_then(checksum).ok();
        TableMeta::read(&TableMeta::find_for(table), limits).is_ok_and(|meta| {
            is_of(&meta) && meta.shard == shard && sum().is_some_and(|sum| meta.crc32 == sum)
        })
    }

    /// Whether it is a sidecar of the table of another, or of a part of it.
    pub fn is_table_of(&self, other: &TableMeta) -> bool {
        self.command == other.command && self.request == other.request
    }

    /// Whether it is a sidecar of the table that a request made; older ones are known by their command.
    pub fn is_of(&self, request: &TableRequest) -> bool {
        match self.request {
            Value::Null => self.command == request.command(),
            _ => self.request == canonical(request),
        }
    }

    /// The sidecar in the file at `path`.
    pub fn read(path: &Path, limits: Limits) -> std::io::Result<TableMeta> {
        let bytes = bounded_read::read_regular(path, limits, &limits::SIDECAR)?;
        let bytes = bytes.map_err(std::io::Error::other)?;
        Ok(serde_json::from_str(&text::decode(&bytes))?)
    }

    /// The definitions of a plan's metrics.
    pub fn definitions(plan: &ScoreRequest) -> Vec<Definition> {
        plan.metrics
            .iter()
            .map(|m| Definition {
                name: m.name.into(),
                about: m.about.into(),
                unit: m.unit.into(),
                scale: m.scale,
                observer: m.observer.map(|own| plan.observer.unwrap_or(own)),
                experiment: m.estimator.name().into(),
                definition: m.definition(),
                source: m.source.into(),
            })
            .collect()
    }

    /// Writes the sidecar of `table`.
    pub fn write_for(&self, table: &Path) -> Result<(), WriteError> {
        let path = TableMeta::path_for(table);
        let fail = |cause: serde_json::Error| WriteError { path: path.clone(), cause: cause.into() };
        let bytes = self.bytes().map_err(fail)?;
        atomic_write::write(&path, &bytes)
    }

    /// As the bytes of the sidecar.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// CRC-32 of a file's bytes, as sidecars have it.
pub fn checksum(mut file: File) -> std::io::Result<String> {
    let (mut sum, mut piece) = (crc32fast::Hasher::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(format!("{:08x}", sum.finalize())),
            n => sum.update(&piece[..n]),
        }
    }
}
