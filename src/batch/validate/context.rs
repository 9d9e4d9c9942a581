//! Context of the checks: seed, corpus, limits, scores as the reference figures have them.

use crate::design::CutError;
use crate::design::Design;
use crate::design::design_file::DocumentError;
use crate::design::library;
use crate::estimators::EstimatorError;
use crate::formats::FormatError;
use crate::geometry::SolidError;
use crate::limits::Limits;
use crate::materials::Material;
use crate::metrics::Metric;
use crate::sampling::stats::Estimate;
use crate::scoring::score::{ScoreInput, ScoreRequest, Target, score};
use crate::storage::text;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Seed and files, and the limits within which these are read.
#[derive(Debug, Clone)]
pub struct CheckContext {
    /// Seed of the random streams.
    pub seed: u64,
    /// Folder of real files, if there is one.
    pub corpus: Option<PathBuf>,
    /// Limits on what is read of them.
    pub limits: Limits,
}

/// A check that gives no numbers.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// What it needs is not there.
    #[error("{0}")]
    Missing(String),
    /// A name that no catalogue has.
    #[error("nothing is called '{0}'")]
    Unknown(String),
    /// A stone that could not be scored.
    #[error("{0}")]
    Score(String),
    /// Parameters that give no stone.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A cut of the library that gives no stone.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// Planes that bound no solid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A stone that cannot be lit.
    #[error(transparent)]
    Light(#[from] EstimatorError),
    /// A file of the corpus that could not be read.
    #[error(transparent)]
    Format(#[from] FormatError),
}

impl CheckContext {
    /// Scores of a stone face-up, unpolarised at every facet as the reference figures are.
    pub fn scores(
        &self,
        design: &Design,
        material: &Material,
        metrics: &[&str],
        samples: u64,
    ) -> Result<Vec<Estimate>, CheckError> {
        self.planned(
            design,
            material,
            metrics,
            ScoreRequest { target: Target::Samples(samples), ..ScoreRequest::default() },
        )
    }

    /// The same with more to be chosen: effort, observer, beams.
    pub fn planned(
        &self,
        design: &Design,
        material: &Material,
        metrics: &[&str],
        plan: ScoreRequest,
    ) -> Result<Vec<Estimate>, CheckError> {
        let named = |name: &&str| Metric::by_name(name).ok_or_else(|| CheckError::Unknown(name.to_string()));
        let metrics = metrics.iter().map(named).collect::<Result<_, _>>()?;
        let plan = ScoreRequest { metrics, polarised: false, seed: self.seed, ..plan };
        let shape = Ok(design.solid()?.into());
        let subject =
            ScoreInput { stone: design.name.clone(), material: material.clone(), shape, tilt: None };
        let row = score(&subject, &plan);
        if let Some(error) = row.error {
            return Err(CheckError::Score(error));
        }
        let all: Option<Vec<Estimate>> = row.scores.into_iter().collect();
        all.ok_or_else(|| CheckError::Score("a score does not apply".into()))
    }

    /// A file of the corpus.
    pub fn file(&self, name: &str) -> Result<PathBuf, CheckError> {
        let missing = || CheckError::Missing("no corpus: set CUTLAB_CORPUS to its folder".into());
        let path = self.corpus.as_ref().ok_or_else(missing)?.join(name);
        let here = path.is_file();
        if here { Ok(path) } else { Err(CheckError::Missing(format!("no {}", text::display_name(path)))) }
    }
}

/// A cut of the library.
pub fn cut(name: &str) -> Result<Design, CheckError> {
    let unknown = || CheckError::Unknown(name.into());
    Ok(library::design(name, &BTreeMap::new()).ok_or_else(unknown)??)
}

/// A material of the catalogue.
pub fn material(name: &str) -> Result<&'static Material, CheckError> {
    Material::by_name(name).ok_or_else(|| CheckError::Unknown(name.into()))
}
