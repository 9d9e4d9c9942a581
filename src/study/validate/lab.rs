//! What trials are made with: seed, corpus, scores as the reference figures have them.

use crate::cut::CutError;
use crate::cut::Design;
use crate::cut::document::DocumentError;
use crate::cut::library;
use crate::experiments::ExperimentError;
use crate::formats::FormatError;
use crate::math::stats::Estimate;
use crate::metrics::Metric;
use crate::optics::Material;
use crate::solid::SolidError;
use crate::store::text;
use crate::study::score::{Effort, Plan, Subject, score};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Seed and files.
#[derive(Debug, Clone)]
pub struct Lab {
    /// Seed of the random streams.
    pub seed: u64,
    /// Folder of real files, if there is one.
    pub corpus: Option<PathBuf>,
}

/// A trial that gives no numbers.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
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
    Light(#[from] ExperimentError),
    /// A file of the corpus that could not be read.
    #[error(transparent)]
    Format(#[from] FormatError),
}

impl Lab {
    /// Scores of a stone face-up, unpolarised at every facet as the reference figures are.
    pub fn scores(
        &self,
        design: &Design,
        material: &Material,
        metrics: &[&str],
        samples: u64,
    ) -> Result<Vec<Estimate>, TrialError> {
        self.planned(design, material, metrics, Plan { effort: Effort::Samples(samples), ..Plan::default() })
    }

    /// The same with more to be chosen: effort, observer, beams.
    pub fn planned(
        &self,
        design: &Design,
        material: &Material,
        metrics: &[&str],
        plan: Plan,
    ) -> Result<Vec<Estimate>, TrialError> {
        let named = |name: &&str| Metric::named(name).ok_or_else(|| TrialError::Unknown(name.to_string()));
        let metrics = metrics.iter().map(named).collect::<Result<_, _>>()?;
        let plan = Plan { metrics, polarised: false, seed: self.seed, ..plan };
        let shape = Ok(design.solid()?.into());
        let subject = Subject { stone: design.name.clone(), material: material.clone(), shape, tilt: None };
        let row = score(&subject, &plan);
        if let Some(error) = row.error {
            return Err(TrialError::Score(error));
        }
        let all: Option<Vec<Estimate>> = row.scores.into_iter().collect();
        all.ok_or_else(|| TrialError::Score("a score does not apply".into()))
    }

    /// A file of the corpus.
    pub fn file(&self, name: &str) -> Result<PathBuf, TrialError> {
        let missing = || TrialError::Missing("no corpus: set CUTLAB_CORPUS to its folder".into());
        let path = self.corpus.as_ref().ok_or_else(missing)?.join(name);
        let here = path.is_file();
        if here { Ok(path) } else { Err(TrialError::Missing(format!("no {}", text::shown(path)))) }
    }
}

/// A cut of the library.
pub fn cut(name: &str) -> Result<Design, TrialError> {
    let unknown = || TrialError::Unknown(name.into());
    Ok(library::design(name, &BTreeMap::new()).ok_or_else(unknown)??)
}

/// A material of the catalogue.
pub fn material(name: &str) -> Result<&'static Material, TrialError> {
    Material::named(name).ok_or_else(|| TrialError::Unknown(name.into()))
}
