//! Priority queue of beams, the strongest first, to a quarter of an octave.

use glam::DVec2;

/// Levels: quarters of an octave down to 2⁻⁶⁴ of the light.
const LEVELS: usize = 256;

/// Beams of about the same power and their footprints, last in first out.
#[derive(Debug)]
struct QueueLevel<B> {
    beams: Vec<(B, usize)>,
    corners: Vec<DVec2>,
}

impl<B> QueueLevel<B> {
    fn new() -> Self {
        QueueLevel { beams: Vec::new(), corners: Vec::new() }
    }
}

/// A priority queue of beams.
#[derive(Debug)]
pub struct Queue<B> {
    levels: Vec<QueueLevel<B>>,
    /// No level before this one has a beam.
    strongest: usize,
    /// What levels that have become empty were stored in, for levels that have not begun: to let each level grow
    /// from nothing takes a good part of the time of a stone that is not followed far.
    spare: Vec<QueueLevel<B>>,
}

impl<B> Queue<B> {
    /// An empty queue; one that is not `sorted` is a stack, which stays short.
    pub fn new(sorted: bool) -> Self {
        let levels = (0..if sorted { LEVELS } else { 1 }).map(|_| QueueLevel::new()).collect();
        Queue { levels, strongest: 0, spare: Vec::new() }
    }

    /// The level of a power: exponent and first two bits of the mantissa, counted down from 1.
    #[inline]
    fn level(&self, power: f64) -> usize {
        let one = 1.0f64.to_bits() >> 50;
        (one.saturating_sub(power.to_bits() >> 50) as usize).min(self.levels.len() - 1)
    }

    /// Puts a beam in.
    pub fn push(&mut self, beam: B, power: f64, corners: &[DVec2]) {
        let level = self.level(power);
        self.strongest = self.strongest.min(level);
        if self.levels[level].beams.capacity() == 0
            && let Some(spare) = self.spare.pop()
        {
            self.levels[level] = spare;
        }
        let QueueLevel { beams, corners: all } = &mut self.levels[level];
        all.extend_from_slice(corners);
        beams.push((beam, corners.len()));
    }

    /// Takes one of the strongest out, its footprint into `corners`.
    pub fn pop(&mut self, corners: &mut Vec<DVec2>) -> Option<B> {
        corners.clear();
        loop {
            let last = self.strongest + 1 == self.levels.len();
            let level = &mut self.levels[self.strongest];
            if let Some((beam, count)) = level.beams.pop() {
                let from = level.corners.len() - count;
                corners.extend_from_slice(&level.corners[from..]);
                level.corners.truncate(from);
                return Some(beam);
            }
            if last {
                return None;
            }
            if level.beams.capacity() > 0 {
                self.spare.push(std::mem::replace(level, QueueLevel::new()));
            }
            self.strongest += 1;
        }
    }

    /// Whether a beam of this power would be the next: it need not be put in.
    #[inline]
    pub fn is_next(&self, power: f64) -> bool {
        self.level(power) <= self.strongest
    }
}
