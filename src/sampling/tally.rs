//! Tallies: the sums of one batch, in named columns.

use super::histogram::Histogram;
use super::stats::Accumulate;
use std::ops::{Index, IndexMut};

/// Most columns of a tally; a column beyond it does not compile.
pub const MAX_COLUMNS: usize = 24;

/// A column of a tally: a sum over the samples of an estimator. Declared by [`crate::columns`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    number: usize,
    /// Its name, in capitals.
    pub name: &'static str,
}

impl Column {
    /// The column number `number` of an estimator; for [`crate::columns`].
    pub const fn new(number: usize, name: &'static str) -> Column {
        assert!(number < MAX_COLUMNS, "a tally has no more than MAX_COLUMNS columns");
        Column { number, name }
    }
}

/// Declares the columns of an estimator as constants, and `COLUMNS`, the list of them all.
///
/// ```
/// use cutlab::advanced::sampling::tally::Tally;
///
/// cutlab::columns! {
///     /// Rays.
///     RAYS,
///     /// Power that leaves upward.
///     UP,
/// }
/// let mut tally = Tally::default();
/// tally[RAYS] += 2.0;
/// tally[UP] += 1.5;
/// assert_eq!(tally[UP] / tally[RAYS], 0.75);
/// assert_eq!(COLUMNS.map(|column| column.name), ["RAYS", "UP"]);
/// ```
#[macro_export]
macro_rules! columns {
    ($($(#[$about:meta])* $name:ident),* $(,)?) => {
        /// Numbers of the columns, in the order in which they are declared.
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
        enum ColumnNumber { $($name),* }
        $(
            $(#[$about])*
            pub const $name: $crate::advanced::sampling::tally::Column =
                $crate::advanced::sampling::tally::Column::new(ColumnNumber::$name as usize, stringify!($name));
        )*
        /// Every column of the tally.
        #[allow(dead_code)] // an estimator that is in no catalogue lists none
        pub const COLUMNS: [$crate::advanced::sampling::tally::Column; [$(stringify!($name)),*].len()] = [$($name),*];
    };
}

/// The sums of a batch: one a [`Column`], and a histogram for an estimator that has a median.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    sums: [f64; MAX_COLUMNS],
    /// Weights of a quantity by its size; empty unless the estimator fills it.
    pub histogram: Histogram,
}

impl Tally {
    /// A tally of the sums given; the others are 0.
    pub fn of(sums: &[(Column, f64)]) -> Tally {
        let mut tally = Tally::default();
        sums.iter().for_each(|(column, sum)| tally[*column] = *sum);
        tally
    }

    /// The same with `power` added to each of some columns.
    pub fn with(&self, columns: &[Column], power: f64) -> Tally {
        let mut tally = self.clone();
        columns.iter().for_each(|column| tally[*column] += power);
        tally
    }
}

impl Index<Column> for Tally {
    type Output = f64;

    #[inline(always)]
    fn index(&self, column: Column) -> &f64 {
        &self.sums[column.number]
    }
}

impl IndexMut<Column> for Tally {
    #[inline(always)]
    fn index_mut(&mut self, column: Column) -> &mut f64 {
        &mut self.sums[column.number]
    }
}

impl Accumulate for Tally {
    fn accumulate(&mut self, other: &Tally) {
        self.sums.accumulate(&other.sums);
        self.histogram.accumulate(&other.histogram);
    }
}
