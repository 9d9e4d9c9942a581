//! The designs that methods of search and fronts are measured on, all of them of the library, so that anybody can
//! repeat it; and what the measurements share.

use cutlab::advanced::optimise::{Degree, Optimisation};
use cutlab::advanced::scoring::{Effort, Objective};
use cutlab::advanced::search::{Problem, ProblemError};
use cutlab::{Material, OptimiseRequest, Stone, Variable};
use std::error::Error;
use std::path::{Path, PathBuf};

/// A design to optimise.
pub struct Subject {
    /// As `cutlab list cuts` has it.
    pub stone: &'static str,
    /// As `cutlab list materials` has it.
    pub material: &'static str,
    /// What varies; nothing for the two tangent ratios.
    pub vary: &'static [&'static str],
}

/// From two variables to five: parametric brilliant, design by meet points, oval, step cut, and a design of twelve
/// tiers whose outline is no circle.
pub const SUBJECTS: [Subject; 5] = [
    Subject {
        stone: "round-brilliant",
        material: "diamond",
        vary: &["crown-angle=25:40", "pavilion-angle=38:43", "table=50:65"],
    },
    Subject { stone: "classic", material: "quartz", vary: &[] },
    Subject { stone: "oval", material: "spinel", vary: &["crown.scale", "pavilion.scale", "table"] },
    Subject {
        stone: "emerald",
        material: "beryl",
        vary: &[
            "crown-angle=20:45",
            "crown-spread=2:20",
            "pavilion-angle=36:50",
            "pavilion-spread=2:20",
            "table=45:70",
        ],
    },
    Subject {
        stone: "barion-emerald",
        material: "spinel",
        vary: &["P2.angle", "P7.angle", "crown.scale", "table=52:70"],
    },
];

/// Points of the hemisphere and the view for scores that have noise: a quarter of the usual number. All candidates
/// of a design have the same random numbers, and for `fire_streak` these leave less than a thousandth of it in doubt.
const SAMPLES: u64 = 1 << 15;

impl Subject {
    /// The stone in its material.
    pub fn stone(&self) -> Result<Stone, Box<dyn Error>> {
        Ok(Stone::parse(self.stone)?.with_material(Material::named(self.material)?))
    }

    /// A request for the subject's variables.
    pub fn request(&self, objectives: Vec<Objective>) -> Result<OptimiseRequest, Box<dyn Error>> {
        let vary: Vec<Variable> = self.vary.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
        let mut request = OptimiseRequest::new(objectives).vary(vary);
        request.effort = Effort::default().samples(SAMPLES);
        Ok(request)
    }

    /// Its name and material.
    pub fn title(&self) -> String {
        format!("{} in {}", self.stone, self.material)
    }
}

/// Objectives to maximise, as they are typed.
pub fn objectives(names: &[&str]) -> Result<Vec<Objective>, Box<dyn Error>> {
    names.iter().map(|name| Ok(Objective::maximise(name.parse()?))).collect()
}

/// The box that an optimisation searches, for other points than its own search asks for.
pub fn problem(optimisation: &Optimisation, objectives: usize) -> Result<Problem, ProblemError> {
    let of = |degree: &Degree| degree.range.clone();
    let start = optimisation.degrees.iter().map(|degree| degree.start).collect();
    Problem::new(optimisation.degrees.iter().map(of).collect(), start, objectives)
}

/// The middle one of some values; of an even number the upper of the two.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The least and the greatest of some values.
pub fn ends(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let wider = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), wider)
}

/// A file for what is measured in pieces.
pub fn kept_file(name: &str) -> Result<PathBuf, std::io::Error> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/optimise");
    std::fs::create_dir_all(&folder)?;
    Ok(folder.join(format!("{name}.json")))
}

/// The folder of the corpus: the first argument, else that of `CUTLAB_CORPUS`.
pub fn corpus(arguments: &[String]) -> Result<String, Box<dyn Error>> {
    let corpus = arguments.first().cloned().or_else(|| std::env::var("CUTLAB_CORPUS").ok());
    corpus.ok_or_else(|| "the corpus is needed: name its folder, or set CUTLAB_CORPUS".into())
}
