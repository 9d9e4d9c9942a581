//! Covering arrays: few cases that hold every pair of choices, but for pairs that are refused.

use crate::factors::Factor;
use std::collections::HashSet;

/// A level of a factor, both by number.
pub type Choice = (usize, usize);

/// One level for each factor.
pub type Row = Vec<usize>;

/// Two choices of different factors, the lower factor first.
pub fn pair(a: Choice, b: Choice) -> (Choice, Choice) {
    if a.0 < b.0 { (a, b) } else { (b, a) }
}

/// Every pair of choices.
pub fn pairs(factors: &[Factor]) -> HashSet<(Choice, Choice)> {
    let mut all = HashSet::new();
    for (a, first) in factors.iter().enumerate() {
        for (b, second) in factors.iter().enumerate().skip(a + 1) {
            for i in 0..first.levels.len() {
                all.extend((0..second.levels.len()).map(|j| ((a, i), (b, j))));
            }
        }
    }
    all
}

/// The pairs in a row.
pub fn pairs_in(row: &[usize]) -> impl Iterator<Item = (Choice, Choice)> {
    let at = |f: usize| (f, row[f]);
    (0..row.len()).flat_map(move |a| (a + 1..row.len()).map(move |b| (at(a), at(b))))
}

/// Whether the pair is in a row.
pub fn is_in(row: &[usize], pair: &(Choice, Choice)) -> bool {
    row[pair.0.0] == pair.0.1 && row[pair.1.0] == pair.1.1
}

/// Choices that no row may have together.
#[derive(Debug, Default)]
pub struct Refused {
    pairs: HashSet<(Choice, Choice)>,
    /// Three and more.
    larger: Vec<Vec<Choice>>,
}

impl Refused {
    /// Adds a pair; whether it is new.
    pub fn pair(&mut self, a: Choice, b: Choice) -> bool {
        self.pairs.insert(pair(a, b))
    }

    /// Adds two choices or more; whether they are new.
    pub fn all_of(&mut self, mut choices: Vec<Choice>) -> bool {
        choices.sort_unstable();
        if let [a, b] = choices[..] {
            return self.pair(a, b);
        }
        let new = !self.larger.contains(&choices);
        self.larger.extend(new.then_some(choices));
        new
    }

    /// Whether the pair alone is refused.
    pub fn has(&self, pair: &(Choice, Choice)) -> bool {
        self.pairs.contains(pair)
    }

    /// Whether a row has choices that are refused together.
    pub fn refuses(&self, row: &[usize]) -> bool {
        pairs_in(row).any(|p| self.has(&p))
            || self.larger.iter().any(|all| all.iter().all(|c| row[c.0] == c.1))
    }

    /// Whether `choice` may stand beside what is chosen.
    fn allows(&self, chosen: &[Option<usize>], choice: Choice) -> bool {
        let is_chosen = |c: &Choice| *c == choice || chosen[c.0] == Some(c.1);
        let mut others = chosen.iter().enumerate().filter_map(|(f, level)| level.map(|l| (f, l)));
        others.all(|o| !self.has(&pair(o, choice)))
            && !self.larger.iter().any(|all| all.contains(&choice) && all.iter().all(is_chosen))
    }
}

/// Rows that hold all of `open` together, none of which is refused. What no row can hold is left out.
///
/// Greedy: each row begins with the first open pair, and every further factor takes the level that
/// closes the most.
pub fn rows(factors: &[Factor], open: &HashSet<(Choice, Choice)>, refused: &Refused) -> Vec<Row> {
    let mut open = open.clone();
    let mut rows = Vec::new();
    while let Some(first) = open.iter().min().copied() {
        open.remove(&first);
        let Some(row) = row(factors, first, &open, refused) else { continue };
        open.retain(|p| !is_in(&row, p));
        rows.push(row);
    }
    rows
}

/// The row that begins with `first` and closes the most; none if every row with it is refused.
fn row(
    factors: &[Factor],
    first: (Choice, Choice),
    open: &HashSet<(Choice, Choice)>,
    refused: &Refused,
) -> Option<Row> {
    if refused.has(&first) {
        return None;
    }
    let mut chosen: Vec<Option<usize>> = vec![None; factors.len()];
    let mut order: Vec<usize> = vec![first.0.0, first.1.0];
    order.extend((0..factors.len()).filter(|f| *f != first.0.0 && *f != first.1.0));
    let gain = |chosen: &[Option<usize>], choice: Choice| {
        let other = |(f, level): (usize, &Option<usize>)| level.map(|l| (f, l));
        chosen.iter().enumerate().filter_map(other).filter(|o| open.contains(&pair(*o, choice))).count()
    };
    let mut at = 0;
    let mut steps = 0;
    let mut tried: Vec<Vec<usize>> = vec![Vec::new(); factors.len()];
    while at < order.len() {
        steps += 1;
        if steps > 20_000 {
            return None;
        }
        let factor = order[at];
        chosen[factor] = None;
        let fixed = [first.0, first.1].into_iter().find(|c| c.0 == factor).map(|c| c.1);
        let mut levels: Vec<usize> = match fixed {
            Some(level) => vec![level],
            None => (0..factors[factor].levels.len()).collect(),
        };
        levels.retain(|l| !tried[at].contains(l) && refused.allows(&chosen, (factor, *l)));
        let best = levels.into_iter().max_by_key(|l| (gain(&chosen, (factor, *l)), usize::MAX - l));
        match best {
            Some(level) => {
                tried[at].push(level);
                chosen[factor] = Some(level);
                at += 1;
            }
            None if at == 0 => return None,
            None => {
                tried[at].clear();
                at -= 1;
            }
        }
    }
    chosen.into_iter().collect()
}

#[test]
fn arrays_hold_every_pair_but_the_refused() {
    let factor = |id: &str, n: usize| Factor {
        id: id.into(),
        levels: (0..n).map(|l| vec![l.to_string()]).collect(),
        positional: false,
    };
    let factors = [factor("a", 3), factor("b", 2), factor("c", 4), factor("d", 2)];
    let all = pairs(&factors);
    assert_eq!(all.len(), 3 * 2 + 3 * 4 + 3 * 2 + 2 * 4 + 2 * 2 + 4 * 2);
    let mut refused = Refused::default();
    refused.pair((0, 1), (1, 0));
    refused.pair((2, 3), (1, 1));
    refused.all_of(vec![(3, 1), (2, 0), (0, 2)]);
    let open: HashSet<_> = all.iter().copied().filter(|p| !refused.has(p)).collect();
    let made = rows(&factors, &open, &refused);
    let held: HashSet<_> = made.iter().flat_map(|r| pairs_in(r)).collect();
    // the pairs of all the rows that are not refused, one row after another
    let of = |n: usize| -> Row { vec![n % 3, n / 3 % 2, n / 6 % 4, n / 24] };
    let allowed = (0..3 * 2 * 4 * 2).map(of).filter(|r| !refused.refuses(r));
    let possible: HashSet<_> = allowed.flat_map(|r| pairs_in(&r).collect::<Vec<_>>()).collect();
    // a = 1 leaves b = 1 alone and c = 3 leaves b = 0 alone, so that no row can hold both
    let impossible: HashSet<_> = open.difference(&possible).copied().collect();
    assert_eq!(impossible, HashSet::from([((0, 1), (2, 3))]));
    assert_eq!(held, possible);
    assert!(made.iter().all(|r| !refused.refuses(r)));
    // three are refused together, and each two of them are held
    assert!([((0, 2), (2, 0)), ((2, 0), (3, 1)), ((0, 2), (3, 1))].iter().all(|p| held.contains(p)));
    // each of the 11 pairs of a and c that are possible needs a row of its own
    assert!((11..=15).contains(&made.len()), "{}", made.len());
}
