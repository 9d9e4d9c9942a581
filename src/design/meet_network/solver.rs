//! Solving the network: distances, and angles where they must follow, so that what met still meets.

use super::MeetNetwork;
use super::error::NetworkError;
use super::least_squares::{Level, in_order, left_open};
use super::parts::FacetOfPart;
use crate::design::tiers::Zone;
use crate::geometry::Plane;
use glam::DVec3;
use nalgebra::{DMatrix, DVector};

/// What is to change about a network's parts.
#[derive(Debug, Clone, Default)]
pub struct Change {
    /// Of each part the polar angle that it is to have, in radians; none leaves it, and lets it follow where
    /// the meets ask for that. Empty changes none.
    pub polars: Vec<Option<f64>>,
    /// Of each part the angle by which it is turned about the axis, in radians, counter-clockwise seen from
    /// +z. Empty turns none.
    pub turns: Vec<f64>,
    /// What the size of the table is multiplied by; none leaves it, as far as the meets do.
    pub table: Option<f64>,
    /// The same of the culet.
    pub culet: Option<f64>,
    /// What is added to the thickness of the girdle, in the design's unit; the crown moves.
    pub girdle: f64,
    /// Of each part what is added to its distance, in the design's unit, in place of its meets' choice.
    pub distances: Vec<Option<f64>>,
    /// Whether only distances may follow: no angle that is not set changes.
    pub angles_stay: bool,
}

/// A network solved.
#[derive(Debug, Clone)]
pub struct Solved {
    /// Planes in the order of the design's facets, in its frame.
    pub planes: Vec<Plane>,
    /// Polar angle of each part, in radians.
    pub polars: Vec<f64>,
    /// Parts whose angles followed though nobody asked for it.
    pub followed: Vec<usize>,
    /// Whether the outline had to change.
    pub is_outline_changed: bool,
}

/// Meets are kept to this part of the width.
const KEPT: f64 = 1e-10;

/// Steps of Newton's method; from a degree away it takes four.
const STEPS: usize = 12;

/// What may change in one attempt.
#[derive(Debug, Clone)]
struct Freedom {
    /// Parts whose angles may follow.
    angles: Vec<usize>,
    /// Whether distances of vertical facets may.
    outline: bool,
}

/// The state of one attempt.
struct State<'n> {
    network: &'n MeetNetwork,
    facets: Vec<FacetOfPart>,
    polars: Vec<f64>,
    distances: Vec<f64>,
}

/// An equation that must hold: a direction in which a corner is to be at a place.
struct Target {
    corner: usize,
    direction: DVec3,
    value: f64,
}

impl MeetNetwork {
    /// Solves the network after a change.
    ///
    /// First only distances change. Where no distances keep every meet, angles of the facets around the meet
    /// that opens follow by as little as they can, then those of facets further away, last the outline. Where
    /// a meet would be cut away, or all that is not enough, the other angles of the same side follow by the
    /// tangent ratio, which keeps every meet of that side. Errors name the meet, or the facet that would be
    /// lost, of the first attempt.
    pub fn solve(&self, change: &Change) -> Result<Solved, NetworkError> {
        let first = match self.attempt(change) {
            Ok(state) => return Ok(self.solved(&state, change)),
            Err(error) => error,
        };
        if change.angles_stay {
            return Err(first);
        }
        let Ok(scaled) = self.with_sides_following(change) else { return Err(first) };
        scaled.attempt(change).map(|state| self.solved(&state, change)).map_err(|_| first)
    }

    /// Parts whose distance neither a meet nor the girdle fixes: a cutter may choose how deep to cut them.
    pub fn free_parts(&self) -> Vec<usize> {
        let state = self.start(&Change::default());
        let free: Vec<usize> =
            (0..self.parts.len()).filter(|p| self.parts[*p].zone != Zone::Girdle).collect();
        let columns = Columns::new(self.parts.len(), &free, &[]);
        let planes = state.planes();
        let mut meets = Rows::new(&columns);
        self.representatives.iter().for_each(|c| state.meet_rows(*c, &planes, &mut meets, &mut |_, _| ()));
        let (_, girdle, _) = state.targets(&Change::default());
        let mut holds = Rows::new(&columns);
        girdle.iter().for_each(|t| {
            state.target_row(t, &planes, &mut holds);
        });
        let open = left_open(&[meets.level(), holds.level()], columns.unknowns);
        let is_open = |p: &usize| columns.distance[*p].is_some_and(|i| open.row(i).norm() > 1e-6);
        free.into_iter().filter(is_open).collect()
    }

    /// Solves with as much freedom as it takes.
    fn attempt(&self, change: &Change) -> Result<State<'_>, NetworkError> {
        let mut freedom = Freedom { angles: Vec::new(), outline: false };
        let mut equations = self.representatives.clone();
        let mut first = None;
        loop {
            let mut state = self.start(change);
            match state.settle(change, &freedom, &equations) {
                Ok(()) => match state.opened(&equations) {
                    Some(corner) => equations.push(corner), // an image that is none when angles change
                    None => return self.checked(&state.planes()).map(|()| state),
                },
                Err(corner) => {
                    let error = first.get_or_insert_with(|| self.cannot_meet(corner, &state.planes()));
                    match self.widened(&freedom, change, corner) {
                        Some(wider) if !change.angles_stay => freedom = wider,
                        _ => return Err(error.clone()),
                    }
                }
            }
        }
    }

    /// The network whose crown and pavilion follow the angles that are set there, by the tangent ratio.
    fn with_sides_following(&self, change: &Change) -> Result<MeetNetwork, NetworkError> {
        let ratio = |zone: Zone| {
            let of_zone = self.parts.iter().enumerate().filter(|(_, p)| p.zone == zone);
            let set = |(i, p): (usize, &super::Part)| {
                let polar = change.polars.get(i).copied().flatten()?;
                Some((polar.tan() / p.polar.tan()).ln())
            };
            let logs: Vec<f64> = of_zone.filter_map(set).collect();
            (logs.iter().sum::<f64>() / logs.len().max(1) as f64).exp()
        };
        let (crown, pavilion) = (ratio(Zone::Crown), ratio(Zone::Pavilion));
        self.scaled(crown, pavilion)
    }

    fn solved(&self, state: &State, change: &Change) -> Solved {
        let followed = |(i, part): (usize, &super::Part)| {
            let is_set = change.polars.get(i).is_some_and(Option::is_some);
            (!is_set && (state.polars[i] - part.polar).abs() > 1e-9).then_some(i)
        };
        let outline = |(i, part): (usize, &super::Part)| {
            part.zone == Zone::Girdle && (state.distances[i] - part.distance).abs() > 1e-9 * self.width
        };
        let parts = || self.parts.iter().enumerate();
        Solved {
            planes: state.planes().iter().map(|p| self.frame.from(p)).collect(),
            followed: parts().filter_map(followed).collect(),
            is_outline_changed: parts().any(outline),
            polars: state.polars.clone(),
        }
    }

    fn start(&self, change: &Change) -> State<'_> {
        let turned = |f: &FacetOfPart| match change.turns.get(f.part) {
            Some(angle) if *angle != 0.0 => f.turned(*angle),
            _ => *f,
        };
        let set = |i: usize| change.polars.get(i).copied().flatten();
        State {
            network: self,
            facets: self.facets.iter().map(turned).collect(),
            polars: self.parts.iter().enumerate().map(|(i, p)| set(i).unwrap_or(p.polar)).collect(),
            distances: self.parts.iter().map(|p| p.distance).collect(),
        }
    }

    /// Parts of which a facet shares an edge with a facet of this part.
    fn beside(&self, part: usize) -> Vec<usize> {
        let own: Vec<usize> = self.parts[part].facets.clone();
        let shares_edge = |facet: usize| {
            let both =
                |c: &&super::Corner| c.facets.contains(&facet) && c.facets.iter().any(|f| own.contains(f));
            self.corners.iter().filter(both).count() > 1
        };
        let others = (0..self.parts.len()).filter(|p| *p != part);
        others.filter(|p| self.parts[*p].facets.iter().any(|f| shares_edge(*f))).collect()
    }

    /// The next freedom: angles of the parts around the corner that opened, of those around these, and so on;
    /// then the outline. None if everything is free already.
    fn widened(&self, was: &Freedom, change: &Change, opened: usize) -> Option<Freedom> {
        let may_follow = |part: &usize| {
            let is_set = change.polars.get(*part).is_some_and(Option::is_some);
            !is_set && matches!(self.parts[*part].zone, Zone::Crown | Zone::Pavilion)
        };
        let of_corner = |corner: &super::Corner| -> Vec<usize> {
            corner.facets.iter().map(|f| self.facets[*f].part).collect()
        };
        let mut angles = was.angles.clone();
        if angles.is_empty() {
            let flat = |p: &usize| matches!(self.parts[*p].zone, Zone::Table | Zone::Culet);
            let around = of_corner(&self.corners[opened]);
            // beside a table or a culet what shares an edge with it, not the corner alone
            let beside = around.iter().copied().find(flat).map(|flat| self.beside(flat));
            let beside = beside.filter(|parts| parts.iter().any(may_follow));
            angles.extend(beside.unwrap_or(around).iter().filter(|p| may_follow(p)));
            angles.sort_unstable();
            angles.dedup();
            if angles.is_empty() {
                angles.extend((0..self.parts.len()).filter(may_follow));
            }
        } else {
            for corner in &self.corners {
                let around = of_corner(corner);
                if around.iter().any(|p| was.angles.contains(p)) {
                    angles.extend(around.iter().filter(|p| may_follow(p)));
                }
            }
            angles.sort_unstable();
            angles.dedup();
        }
        match (angles != was.angles, was.outline) {
            (true, _) => Some(Freedom { angles, outline: was.outline }),
            (false, false) => Some(Freedom { angles, outline: true }),
            (false, true) => None,
        }
    }
}

impl State<'_> {
    fn planes(&self) -> Vec<Plane> {
        self.facets.iter().map(|f| f.plane(&self.polars, &self.distances)).collect()
    }

    /// The targets that are asked for, and those that hold what is.
    fn targets(&self, change: &Change) -> (Vec<Target>, Vec<Target>, Vec<Target>) {
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
    fn settle(&mut self, change: &Change, freedom: &Freedom, equations: &[usize]) -> Result<(), usize> {
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
    fn meet_rows(&self, number: usize, planes: &[Plane], rows: &mut Rows, note: &mut impl FnMut(usize, f64)) {
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
    fn target_row(&self, target: &Target, planes: &[Plane], rows: &mut Rows) -> f64 {
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
    fn opened(&self, equations: &[usize]) -> Option<usize> {
        let planes = self.planes();
        let opens = |corner: &super::Corner| {
            let (place, _) = corner.moved(&planes);
            let miss = |(f, before): (&usize, &f64)| (planes[*f].signed_distance(place) - before).abs();
            corner.facets.iter().zip(&corner.misses).map(miss).fold(0.0, f64::max)
                > 10.0 * KEPT * self.network.width
        };
        let corners = self.network.corners.iter().enumerate();
        corners.filter(|(i, _)| !equations.contains(i)).find(|(_, c)| opens(c)).map(|(i, _)| i)
    }
}

/// Which unknown is a part's distance, and which its angle times the stone's radius.
struct Columns {
    distance: Vec<Option<usize>>,
    angle: Vec<Option<usize>>,
    unknowns: usize,
}

impl Columns {
    /// - `distances`, `angles`: parts whose distances and angles are unknown
    fn new(parts: usize, distances: &[usize], angles: &[usize]) -> Columns {
        let (mut distance, mut angle) = (vec![None; parts], vec![None; parts]);
        distances.iter().enumerate().for_each(|(i, p)| distance[*p] = Some(i));
        angles.iter().enumerate().for_each(|(i, p)| angle[*p] = Some(distances.len() + i));
        Columns { distance, angle, unknowns: distances.len() + angles.len() }
    }
}

/// Equations of one rank as they come.
struct Rows<'c> {
    columns: &'c Columns,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl<'c> Rows<'c> {
    fn new(columns: &'c Columns) -> Rows<'c> {
        Rows { columns, matrix: Vec::new(), right: Vec::new() }
    }

    /// Adds one; rows without an unknown are left out.
    fn add(&mut self, terms: &[(Option<usize>, f64)], right: f64) {
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

    fn level(self) -> Level {
        Level {
            matrix: DMatrix::from_row_slice(self.right.len(), self.columns.unknowns, &self.matrix),
            right: DVector::from_vec(self.right),
        }
    }
}
