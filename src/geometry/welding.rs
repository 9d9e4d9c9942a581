//! Welding: corners that are one but for rounding become one.

use glam::DVec3;
use std::collections::HashMap;

/// For each corner the number of the first corner within `distance` of it that is not welded itself.
///
/// - `order`: numbers of the corners, in the order in which they are taken; each that no earlier one is near
///   stands for those that come later
/// - `low`, `high`: the box of the corners that matter; those outside stay as they are
pub fn weld(
    vertices: &[DVec3],
    order: impl IntoIterator<Item = usize>,
    (low, high): (DVec3, DVec3),
    distance: f64,
) -> Vec<usize> {
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut first: Vec<usize> = (0..vertices.len()).collect();
    for i in order {
        let v = &vertices[i];
        // all far ones would share the last cell
        if !(v.cmpge(low) & v.cmple(high)).all() {
            continue;
        }
        let cell = ((*v - low) / distance).floor().to_array().map(|c| c as i64);
        let around = (0..27i64).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
        let twin = around
            .filter_map(|d| cells.get(&[0, 1, 2].map(|a| cell[a].saturating_add(d[a]))))
            .flatten()
            .copied()
            .find(|&j| vertices[j].distance(*v) <= distance);
        match twin {
            Some(twin) => first[i] = twin,
            None => cells.entry(cell).or_default().push(i),
        }
    }
    first
}

/// Which corners have another one within `distance`: [`weld`] leaves all others as they are. A few that
/// have none may be among them.
pub fn crowded(vertices: &[DVec3], distance: f64) -> Vec<bool> {
    /// Along a line in which no stone's symmetry lies, few corners are near each other by chance.
    const LINE: DVec3 = DVec3::new(0.619_7, 0.533_1, 0.576_1);
    /// So many corners next to one on the line are looked at; beyond that all are taken for crowded.
    const MOST: usize = 32;
    let mut along: Vec<(f64, usize)> = vertices.iter().enumerate().map(|(i, v)| (LINE.dot(*v), i)).collect();
    along.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut crowded = vec![false; vertices.len()];
    for (place, (at, i)) in along.iter().enumerate() {
        // LINE is a unit vector but for a part in a thousand
        let reach = at + 1.01 * distance + 1e-15 * at.abs();
        for (number, (_, j)) in along[place + 1..].iter().take_while(|(next, _)| *next <= reach).enumerate() {
            if number == MOST {
                return vec![true; vertices.len()];
            }
            if vertices[*i].distance(vertices[*j]) <= distance {
                (crowded[*i], crowded[*j]) = (true, true);
            }
        }
    }
    crowded
}

/// The ring without repeated corners and without spikes (`a b a`).
pub fn without_repeats<T: PartialEq>(corners: impl Iterator<Item = T>) -> Vec<T> {
    let mut ring: Vec<T> = Vec::new();
    for c in corners {
        ring.push(c);
        loop {
            let n = ring.len();
            if n >= 2 && ring[n - 1] == ring[n - 2] {
                ring.pop();
            } else if n >= 3 && ring[n - 1] == ring[n - 3] {
                ring.truncate(n - 2);
            } else {
                break;
            }
        }
    }
    let mut start = 0;
    loop {
        let n = ring.len();
        if n - start >= 2 && ring[start] == ring[n - 1] {
            ring.pop();
        } else if n - start >= 3 && ring[start] == ring[n - 2] {
            ring.truncate(n - 2);
        } else if n - start >= 3 && ring[start + 1] == ring[n - 1] {
            start += 1;
            ring.pop();
        } else {
            ring.drain(..start);
            return ring;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_one_place_become_one_and_rings_lose_their_dead_edges() {
        let corners = [0.0, 1.0, 4e-10, 1.0 + 2e-9].map(|x| DVec3::new(x, 0.3, 0.1));
        let all = (DVec3::splat(-2.0), DVec3::splat(2.0));
        assert_eq!(weld(&corners, 0..4, all, 1e-9), [0, 1, 0, 3]);
        assert_eq!(weld(&corners, [2, 1, 0, 3], all, 1e-9), [2, 1, 2, 3]);
        assert_eq!(weld(&corners, 0..4, (DVec3::splat(0.05), all.1), 1e-9), [0, 1, 2, 3], "outside the box");
        assert_eq!(crowded(&corners, 1e-9), [true, false, true, false]);
        assert_eq!(crowded(&[DVec3::ONE; 40], 1e-9), [true; 40]);
        assert_eq!(without_repeats([3, 3, 5, 7, 7, 3].into_iter()), [3, 5, 7]);
        assert_eq!(without_repeats([1, 2, 3, 2, 4].into_iter()), [1, 2, 4]);
        assert_eq!(without_repeats([1, 1, 2].into_iter()), [1, 2]);
    }
}
