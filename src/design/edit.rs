//! Changing a design: angles of tiers, tangent ratios of crown and pavilion, table, girdle, culet, indices,
//! parameters of families; what met still meets ([`super::meet_network`]). The words of a setting are the
//! grammar in [`crate::manual::editing`].

mod apply;
mod changes;
mod editor;
mod error;
mod flat_size;
pub mod meets;
mod setting;
mod tier_list;

pub use changes::{BeforeAfter, DesignChanges, MeasureChange, TierChange, TierState};
pub use editor::{Edited, Editor};
pub use error::EditError;
pub use setting::{EditTarget, Keep, Setting, SettingError, Side};
pub use tier_list::{EditableTier, TierList, places, places_of_tiers};

use super::tiers::Design;
use serde::{Deserialize, Serialize};

/// What to change about a design.
///
/// ```
/// use cutlab::{EditRequest, Stone};
///
/// let design = Stone::parse("classic")?.into_design()?;
/// let edited = EditRequest::new(["crown.scale=0.95", "P1.angle+=0.5"])?.run(&design)?;
/// assert_eq!(edited.design.facets().count(), design.facets().count());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct EditRequest {
    /// The settings; later ones find what earlier ones left.
    pub settings: Vec<Setting>,
    /// What stays as it is.
    pub keep: Keep,
}

impl EditRequest {
    /// A request of settings as they are typed: `P1.angle=41.5`.
    pub fn new<S: AsRef<str>>(settings: impl IntoIterator<Item = S>) -> Result<EditRequest, SettingError> {
        let settings = settings.into_iter().map(|s| s.as_ref().parse()).collect::<Result<_, _>>()?;
        Ok(EditRequest { settings, keep: Keep::default() })
    }

    /// With something else kept than meets.
    pub fn keep(mut self, keep: Keep) -> EditRequest {
        self.keep = keep;
        self
    }

    /// Changes the design. Errors name the setting, the tier or the meet.
    pub fn run(&self, design: &Design) -> Result<Edited, EditError> {
        Editor::new(design)?.edit(&self.settings, self.keep)
    }

    /// As [`EditRequest::run`], with what the change did to tiers and proportions.
    pub fn changes(&self, design: &Design) -> Result<(Edited, DesignChanges), EditError> {
        let editor = Editor::new(design)?;
        let edited = editor.edit(&self.settings, self.keep)?;
        let changes = DesignChanges::new(&editor, &edited);
        Ok((edited, changes))
    }
}
