//! Solving the network: distances, and angles where they must follow, so that what met still meets.

use super::change::{Change, Solved};
use super::corners::Corner;
use super::equations::{Columns, Rows};
use super::error::NetworkError;
use super::least_squares::left_open;
use super::network::MeetNetwork;
use super::parts::Part;
use super::state::{Freedom, State};
use crate::design::tiers::Zone;

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
        let state = State::of(self, &Change::default());
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
            let mut state = State::of(self, change);
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
            let set = |(i, p): (usize, &Part)| {
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
        let followed = |(i, part): (usize, &Part)| {
            let is_set = change.polars.get(i).is_some_and(Option::is_some);
            (!is_set && (state.polars[i] - part.polar).abs() > 1e-9).then_some(i)
        };
        let outline = |(i, part): (usize, &Part)| {
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

    /// Parts of which a facet shares an edge with a facet of this part.
    fn beside(&self, part: usize) -> Vec<usize> {
        let own: Vec<usize> = self.parts[part].facets.clone();
        let shares_edge = |facet: usize| {
            let both = |c: &&Corner| c.facets.contains(&facet) && c.facets.iter().any(|f| own.contains(f));
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
        let of_corner =
            |corner: &Corner| -> Vec<usize> { corner.facets.iter().map(|f| self.facets[*f].part).collect() };
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
