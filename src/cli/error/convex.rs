//! The error of a command that needs convex stones.

use super::CliError;
use crate::stone::StoneError;

impl CliError {
    /// A stone that cannot be opened, or that is not convex where `what` needs one that is: proportions, a cutting
    /// diagram and scenes are of convex stones alone.
    pub fn needs_convex(what: &str, error: StoneError) -> CliError {
        let is_mesh = matches!(error, StoneError::NotConvex(_));
        let mut error = CliError::from(error);
        if is_mesh {
            error.message += &format!(
                "; {what} needs one: cutlab show tells what it can of a mesh, cutlab score scores one with a dent"
            );
        }
        error
    }
}
