//! The rows of a table, as a function of their number.

use super::sidecar::TableLayout;
use super::table::{TableError, TableFormat};
use super::table_job::{FinishedRow, Order};

/// Column of a stone's tilt, degrees.
pub const TILT: &str = "tilt_deg";

/// Column of the azimuth of the axis that a stone is tilted about, degrees.
pub const TILT_AXIS: &str = "tilt_axis_deg";

/// The rows of a table: a function of their number, the same whenever and wherever it is called.
pub trait TableRows: Sync {
    /// What the table is a function of: see [`super::fingerprint`].
    fn identity(&self) -> &str;

    /// Its columns.
    fn columns(&self) -> &[String];

    /// How many rows the whole table has.
    fn total(&self) -> u64;

    /// How they are sorted, if they are.
    fn order(&self) -> Option<Order>;

    /// What its scores can be drawn against.
    fn layout(&self) -> Option<TableLayout>;

    /// Makes row number `i`, from 0.
    fn row(&self, i: u64, form: TableFormat) -> Result<FinishedRow, TableError>;
}
