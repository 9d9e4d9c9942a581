//! The companion of a table: what its columns mean and how it was made.

use super::batch::Summary;
use super::score::Plan;
use super::shard::Shard;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// What stands in `NAME.meta.json` beside the table `NAME.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Meta {
    /// Always `cutlab`.
    pub program: String,
    /// Its version.
    pub version: String,
    /// The command with every setting spelled out, without output and shard.
    pub command: String,
    /// Seed of the random streams: the same for every row.
    pub seed: u64,
    /// Digest of version, command and inputs: parts of one table have it in common.
    pub study: String,
    /// The table's columns.
    pub columns: Vec<String>,
    /// Rows of the whole table.
    pub total: u64,
    /// The part of it that this table is; none for the whole.
    pub shard: Option<Shard>,
    /// Rows, failures and sample counts of this table.
    #[serde(flatten)]
    pub summary: Summary,
    /// CRC-32 of this table's bytes, hexadecimal.
    pub crc32: String,
    /// What the scores mean.
    pub metrics: Vec<Definition>,
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
    /// The experiment that it reads.
    pub experiment: String,
    /// Illumination, observer, polarisation, wavelengths, what counts, normalisation.
    pub definition: String,
    /// Where the definition is from.
    pub source: String,
}

impl Meta {
    /// Where the companion of `table` is.
    pub fn beside(table: &Path) -> PathBuf {
        table.with_extension("meta.json")
    }

    /// The definitions of a plan's metrics.
    pub fn definitions(plan: &Plan) -> Vec<Definition> {
        plan.metrics
            .iter()
            .map(|m| Definition {
                name: m.name.into(),
                about: m.about.into(),
                unit: m.unit.into(),
                scale: m.scale,
                observer: m.observer.map(|own| plan.observer.unwrap_or(own)),
                experiment: m.reading.experiment().into(),
                definition: m.definition.into(),
                source: m.source.into(),
            })
            .collect()
    }

    /// As the bytes of the companion.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}
