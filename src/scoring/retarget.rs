//! The choice among the rules by which a design is made for another refractive index: what scores best.

use super::effort::Effort;
use super::evaluator::Evaluator;
use super::objective::{Objective, TiltedMetric};
use crate::design::Design;
use crate::design::edit::Editor;
use crate::design::retarget::{
    CrownRule, PavilionRule, RetargetError, RetargetRequest, Retargeted, RuleTrial,
};
use crate::materials::Material;
use crate::metrics::Metric;

/// The pavilion's rules that are tried.
const PAVILIONS: [PavilionRule; 3] = [PavilionRule::Margin, PavilionRule::Range, PavilionRule::Keep];

/// The crown's rules that are tried.
const CROWNS: [CrownRule; 3] = [CrownRule::Prism, CrownRule::Index, CrownRule::Keep];

/// The metric by which rules are chosen.
const METRIC: &str = "iso";

/// Its tilts, in degrees, about each of [`AZIMUTHS`].
const TILTS: [f64; 2] = [0.0, 10.0];

/// Azimuths of the axes, in degrees.
const AZIMUTHS: [f64; 2] = [0.0, 90.0];

impl RetargetRequest {
    /// Makes the design for its new index. Errors name the limit, the tier or the meet.
    pub fn run(&self, design: &Design) -> Result<Retargeted, RetargetError> {
        self.edit(&Editor::new(design)?)
    }

    /// As [`RetargetRequest::run`], of a design made ready to be changed.
    ///
    /// Where a rule is not asked for, every rule is tried (the pavilion as far above the critical angle, at the same
    /// place in its range, as it is; the crown by (n − 1)/(n' − 1), by n/n', as it is), and of the stones of the new
    /// index the one is taken with the greatest mean of ISO at 0° and 10°, about the x and the y axis, by exact
    /// beams (± 0.1 points). As "as it is" is among them, that score of the design is never made worse.
    pub fn edit(&self, editor: &Editor) -> Result<Retargeted, RetargetError> {
        if let (Some(pavilion), Some(crown)) = (self.pavilion, self.crown) {
            return self.by_rules(editor, pavilion, crown);
        }
        let (one_pavilion, one_crown) = (self.pavilion.map(|p| [p]), self.crown.map(|c| [c]));
        let pavilions = one_pavilion.as_ref().map_or(&PAVILIONS[..], |p| p);
        let crowns = one_crown.as_ref().map_or(&CROWNS[..], |c| c);
        let mut best: Option<(f64, Retargeted)> = None;
        let (mut trials, mut first_error) = (Vec::new(), None);
        for &pavilion in pavilions {
            for &crown in crowns {
                let made = self.by_rules(editor, pavilion, crown);
                let made = made.and_then(|made| Ok((self.score(&made)?, made)));
                let (score, why) = match &made {
                    Ok((score, _)) => (Some(*score), None),
                    Err(error) => (None, Some(error.to_string())),
                };
                trials.push(RuleTrial { pavilion, crown, score, why });
                match made {
                    Ok(made) if best.as_ref().is_none_or(|(score, _)| made.0 > *score) => best = Some(made),
                    Ok(_) => {}
                    Err(error) => first_error = first_error.or(Some(error)),
                }
            }
        }
        match (best, first_error) {
            (Some((_, made)), _) => Ok(Retargeted { trials, ..made }),
            (None, error) => Err(error.unwrap_or(RetargetError::NoPavilion)),
        }
    }

    /// The mean of ISO over the tilts, in a clear stone of the new index.
    fn score(&self, made: &Retargeted) -> Result<f64, RetargetError> {
        let failed = |error: &dyn ToString| RetargetError::Score(error.to_string());
        let metric = TiltedMetric::new(Metric::named(METRIC).map_err(|e| failed(&e))?);
        let objective = Objective::maximise(metric).tilts(TILTS).azimuths(AZIMUTHS);
        let material = Material::from_index(self.to);
        let solid = &made.edited.solid;
        let evaluator = Evaluator::new(vec![objective], Vec::new(), &material, Effort::default(), solid);
        Ok(evaluator.map_err(|e| failed(&e))?.start().objectives[0].value)
    }
}
