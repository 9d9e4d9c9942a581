//! Equations of the network in its unknowns: distances of parts, and angles times the stone's radius.

use super::least_squares::Level;
use glam::DVec3;
use nalgebra::{DMatrix, DVector};

/// An equation that must hold: a direction in which a corner is to be at a place.
pub(super) struct Target {
    pub corner: usize,
    pub direction: DVec3,
    pub value: f64,
}

/// Which unknown is a part's distance, and which its angle times the stone's radius.
pub(super) struct Columns {
    pub distance: Vec<Option<usize>>,
    pub angle: Vec<Option<usize>>,
    pub unknowns: usize,
}

impl Columns {
    /// - `distances`, `angles`: parts whose distances and angles are unknown
    pub fn new(parts: usize, distances: &[usize], angles: &[usize]) -> Columns {
        let (mut distance, mut angle) = (vec![None; parts], vec![None; parts]);
        distances.iter().enumerate().for_each(|(i, p)| distance[*p] = Some(i));
        angles.iter().enumerate().for_each(|(i, p)| angle[*p] = Some(distances.len() + i));
        Columns { distance, angle, unknowns: distances.len() + angles.len() }
    }
}

/// Equations of one rank as they come.
pub(super) struct Rows<'c> {
    pub columns: &'c Columns,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl<'c> Rows<'c> {
    pub fn new(columns: &'c Columns) -> Rows<'c> {
        Rows { columns, matrix: Vec::new(), right: Vec::new() }
    }

    /// Adds one; rows without an unknown are left out.
    pub fn add(&mut self, terms: &[(Option<usize>, f64)], right: f64) {
        let start = self.matrix.len();
        self.matrix.resize(start + self.columns.unknowns, 0.0);
        for (column, factor) in terms {
            if let Some(column) = column {
                self.matrix[start + column] += factor;
            }
        }
        let largest = self.matrix[start..].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if largest < 1e-12 {
            self.matrix.truncate(start);
        } else {
            self.right.push(right);
        }
    }

    pub fn level(self) -> Level {
        Level {
            matrix: DMatrix::from_row_slice(self.right.len(), self.columns.unknowns, &self.matrix),
            right: DVector::from_vec(self.right),
        }
    }
}
