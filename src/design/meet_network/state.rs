//! One attempt at solving: Newton's method with some distances and angles free.

use super::change::Change;
use super::corners::Corner;
use super::equations::{Columns, Rows, Target};
use super::least_squares::in_order;
use super::network::MeetNetwork;
use super::parts::FacetOfPart;
use crate::design::tiers::Zone;
use crate::geometry::Plane;
use glam::DVec3;

/// Meets are kept to this part of the width.
const KEPT: f64 = 1e-10;

/// Steps of Newton's method; from a degree away it takes four.
const STEPS: usize = 12;

/// What may change in one attempt.
#[derive(Debug, Clone)]
pub(super) struct Freedom {
    /// Parts whose angles may follow.
    pub angles: Vec<usize>,
    /// Whether distances of vertical facets may.
    pub outline: bool,
}

/// The state of one attempt.
pub(super) struct State<'n> {
    network: &'n MeetNetwork,
    facets: Vec<FacetOfPart>,
    pub polars: Vec<f64>,
    pub distances: Vec<f64>,
}

impl<'n> State<'n> {
    /// The network with what is set.
    pub fn of(network: &'n MeetNetwork, change: &Change) -> State<'n> {
        let turned = |f: &FacetOfPart| match change.turns.get(f.part) {
            Some(angle) if *angle != 0.0 => f.turned(*angle),
            _ => *f,
        };
        let set = |i: usize| change.polars.get(i).copied().flatten();
        State {
            network,
            facets: network.facets.iter().map(turned).collect(),
            polars: network.parts.iter().enumerate().map(|(i, p)| set(i).unwrap_or(p.polar)).collect(),
            distances: network.parts.iter().map(|p| p.distance).collect(),
        }
    }

    pub fn planes(&self) -> Vec<Plane> {
        self.facets.iter().map(|f| f.plane(&self.polars, &self.distances)).collect()
    }

    /// The targets that are asked for, and those that hold what is.
    pub fn targets(&self, change: &Change) -> (Vec<Target>, Vec<Target>, Vec<Target>) {
        let Self { network, .. } = self;
        let up = |corner: usize, value: f64| Target { corner, direction: DVec3::Z, value };
        let size = |corner: usize, factor: f64| {
            let at = network.corners[corner].position;
            let direction = at.truncate().normalize_or_zero().extend(0.0);
            Target { corner, direction, value: factor * direction.dot(at) }
        };
        let (mut asked, mut girdle, mut table) = (Vec::new(), Vec::new(), Vec::new());
        if let Some([top, bottom]) = network.holds.girdle {
            let of_girdle = if change.girdle == 0.0 { &mut girdle } else { &mut asked };
            of_girdle.push(up(top, network.corners[top].position.z + change.girdle));
            of_girdle.push(up(bottom, network.corners[bottom].position.z));
        }
        if let Some(corner) = network.holds.outline {
            let at = network.corners[corner].position;
            girdle.extend([DVec3::X, DVec3::Y, DVec3::Z].map(|direction| Target {
                corner,
                direction,
                value: direction.dot(at),
            }));
        }
        for (corner, factor) in [(network.holds.table, change.table), (network.holds.culet, change.culet)] {
            match (corner, factor) {
                (Some(corner), Some(factor)) => asked.push(size(corner, factor)),
                (Some(corner), None) => table.push(size(corner, 1.0)),
                (None, _) => {}
            }
        }
        (asked, girdle, table)
    }

    /// Newton's method; the corner whose equation is missed most, if one is.
    pub fn settle(&mut self, change: &Change, freedom: &Freedom, equations: &[usize]) -> Result<(), usize> {
        let network = self.network;
        let is_free = |p: &usize| freedom.outline || network.parts[*p].zone != Zone::Girdle;
        let is_given = |p: &usize| change.distances.get(*p).is_some_and(Option::is_some);
        for (p, given) in change.distances.iter().enumerate() {
            self.distances[p] = network.parts[p].distance + given.unwrap_or(0.0);
        }
        let free: Vec<usize> = (0..network.parts.len()).filter(|p| is_free(p) && !is_given(p)).collect();
        let columns = Columns::new(network.parts.len(), &free, &freedom.angles);
        let base = network.own_planes();
        let (asked, girdle, table) = self.targets(change);
        let radius = 0.5 * network.width;
        for step in 0..STEPS {
            let planes = self.planes();
            let mut meets = Rows::new(&columns);
            let mut worst: Option<(usize, f64)> = None;
            let mut note = |corner: usize, miss: f64| {
                if worst.is_none_or(|(_, m)| miss.abs() > m) {
                    worst = Some((corner, miss.abs()));
                }
            };
            for &number in equations {
                self.meet_rows(number, &planes, &mut meets, &mut note);
            }
            for target in &asked {
                let miss = self.target_row(target, &planes, &mut meets);
                note(target.corner, miss);
            }
            if let Some((corner, miss)) = worst.filter(|(_, miss)| *miss > KEPT * network.width || step == 0)
            {
                if (step > 0 && freedom.angles.is_empty()) || step + 1 == STEPS || !miss.is_finite() {
                    return Err(corner); // equations of distances alone are linear: one step says it
                }
            } else if step > 0 {
                return Ok(());
            }
            let mut levels = vec![meets.level()];
            if !freedom.angles.is_empty() {
                let mut rows = Rows::new(&columns);
                for &p in &freedom.angles {
                    rows.add(&[(columns.angle[p], 1.0)], radius * (network.parts[p].polar - self.polars[p]));
                }
                levels.push(rows.level());
            }
            if freedom.outline {
                let mut rows = Rows::new(&columns);
                for &p in free.iter().filter(|p| network.parts[**p].zone == Zone::Girdle) {
                    rows.add(&[(columns.distance[p], 1.0)], network.parts[p].distance - self.distances[p]);
                }
                levels.push(rows.level());
            }
            for targets in [&girdle, &table] {
                let mut rows = Rows::new(&columns);
                targets.iter().for_each(|t| {
                    self.target_row(t, &planes, &mut rows);
                });
                levels.push(rows.level());
            }
            let mut hinges = Rows::new(&columns);
            for (p, (facet, place)) in network.holds.hinges.iter().enumerate() {
                let turning = self.facets[*facet].turning(&self.polars).dot(*place) / radius;
                let miss = planes[*facet].signed_distance(*place) - base[*facet].signed_distance(*place);
                hinges.add(&[(columns.distance[p], -1.0), (columns.angle[p], turning)], -miss);
            }
            levels.push(hinges.level());
            let x = in_order(&levels, columns.unknowns);
            for p in 0..network.parts.len() {
                if let Some(i) = columns.distance[p] {
                    self.distances[p] += x[i];
                }
                if let Some(i) = columns.angle[p] {
                    self.polars[p] += x[i] / radius;
                }
            }
        }
        Ok(())
    }

    /// The equations of a meet: each facet beyond the three that fix the corner misses it as before.
    pub fn meet_rows(
        &self,
        number: usize,
        planes: &[Plane],
        rows: &mut Rows,
        note: &mut impl FnMut(usize, f64),
    ) {
        let radius = 0.5 * self.network.width;
        let corner = &self.network.corners[number];
        let (place, moves) = corner.moved(planes);
        for (&facet, &miss_before) in corner.facets.iter().zip(&corner.misses).skip(3) {
            let normal = planes[facet].normal;
            let miss = planes[facet].signed_distance(place) - miss_before;
            note(number, miss);
            let part = self.facets[facet].part;
            let turning = self.facets[facet].turning(&self.polars).dot(place) / radius;
            let mut row = vec![(rows.columns.distance[part], -1.0), (rows.columns.angle[part], turning)];
            for (i, &basis) in corner.facets[..3].iter().enumerate() {
                let along = normal.dot(moves.col(i));
                let part = self.facets[basis].part;
                let turning = self.facets[basis].turning(&self.polars).dot(place) / radius;
                row.push((rows.columns.distance[part], along));
                row.push((rows.columns.angle[part], -along * turning));
            }
            rows.add(&row, -miss);
        }
    }

    /// The equation of a target; what it is missed by.
    pub fn target_row(&self, target: &Target, planes: &[Plane], rows: &mut Rows) -> f64 {
        let radius = 0.5 * self.network.width;
        let corner = &self.network.corners[target.corner];
        let (place, moves) = corner.moved(planes);
        let mut row = Vec::new();
        for (i, &basis) in corner.facets[..3].iter().enumerate() {
            let along = target.direction.dot(moves.col(i));
            let part = self.facets[basis].part;
            let turning = self.facets[basis].turning(&self.polars).dot(place) / radius;
            row.push((rows.columns.distance[part], along));
            row.push((rows.columns.angle[part], -along * turning));
        }
        let miss = target.value - target.direction.dot(place);
        rows.add(&row, miss);
        miss
    }

    /// A corner that opened though its image did not.
    pub fn opened(&self, equations: &[usize]) -> Option<usize> {
        let planes = self.planes();
        let opens = |corner: &Corner| {
            let (place, _) = corner.moved(&planes);
            let miss = |(f, before): (&usize, &f64)| (planes[*f].signed_distance(place) - before).abs();
            corner.facets.iter().zip(&corner.misses).map(miss).fold(0.0, f64::max)
                > 10.0 * KEPT * self.network.width
        };
        let corners = self.network.corners.iter().enumerate();
        corners.filter(|(i, _)| !equations.contains(i)).find(|(_, c)| opens(c)).map(|(i, _)| i)
    }
}
