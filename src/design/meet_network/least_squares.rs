//! Least squares in order of rank: what comes first is met as well as it can be, what comes after decides
//! about what that leaves open.

use nalgebra::{DMatrix, DVector};

/// Linear equations `matrix · x = right` of one rank.
pub struct Level {
    pub matrix: DMatrix<f64>,
    pub right: DVector<f64>,
}

/// Singular values below this part of the largest (or of 1) are rounding.
const RANK: f64 = 1e-9;

/// The `x` that meets each level in the sense of least squares as far as those before leave it open; of
/// several the shortest.
///
/// - `unknowns`: length of `x`
pub fn in_order(levels: &[Level], unknowns: usize) -> DVector<f64> {
    solved(levels, unknowns).0
}

/// Directions, as columns, in which `x` may change without any level being met worse.
pub fn left_open(levels: &[Level], unknowns: usize) -> DMatrix<f64> {
    solved(levels, unknowns).1
}

fn solved(levels: &[Level], unknowns: usize) -> (DVector<f64>, DMatrix<f64>) {
    let mut x = DVector::zeros(unknowns);
    let mut open = DMatrix::identity(unknowns, unknowns);
    for level in levels {
        if level.matrix.nrows() == 0 || open.ncols() == 0 {
            continue;
        }
        let free = open.ncols();
        let rows = level.matrix.nrows().max(free);
        // rows of zeros make the matrix tall, so that its decomposition spans what it leaves open
        let mut within = DMatrix::zeros(rows, free);
        within.rows_mut(0, level.matrix.nrows()).copy_from(&(&level.matrix * &open));
        let mut right = DVector::zeros(rows);
        right.rows_mut(0, level.matrix.nrows()).copy_from(&(&level.right - &level.matrix * &x));
        let svd = within.svd(true, true);
        let (Some(u), Some(v_t)) = (&svd.u, &svd.v_t) else { continue };
        let least = RANK * svd.singular_values.max().max(1.0);
        let mut y = DVector::zeros(free);
        let mut left = Vec::new();
        for (i, &s) in svd.singular_values.iter().enumerate() {
            let direction = v_t.row(i).transpose();
            if s > least {
                y += &direction * (u.column(i).dot(&right) / s);
            } else {
                left.push(direction);
            }
        }
        x += &open * y;
        open =
            if left.is_empty() { DMatrix::zeros(unknowns, 0) } else { &open * DMatrix::from_columns(&left) };
    }
    (x, open)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_levels_decide_about_what_earlier_ones_leave_open() {
        let level = |rows: &[f64], right: &[f64]| Level {
            matrix: DMatrix::from_row_slice(right.len(), 3, rows),
            right: DVector::from_row_slice(right),
        };
        // x + y = 2 twice over; then x = 5, z = 1; then y = 100 has nothing left to say
        let levels = [
            level(&[1.0, 1.0, 0.0, 2.0, 2.0, 0.0], &[2.0, 4.0]),
            level(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0], &[5.0, 1.0]),
            level(&[0.0, 1.0, 0.0], &[100.0]),
        ];
        let x = in_order(&levels, 3);
        assert!((x - DVector::from_row_slice(&[5.0, -3.0, 1.0])).norm() < 1e-12);
        // of what contradicts itself the mean
        let x = in_order(&[level(&[1.0, 0.0, 0.0, 1.0, 0.0, 0.0], &[1.0, 3.0])], 3);
        assert!((x - DVector::from_row_slice(&[2.0, 0.0, 0.0])).norm() < 1e-12);
    }
}
