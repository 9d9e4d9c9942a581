//! One of several interleaved parts of a table, for machines that share the work.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The part `number` of `of`: rows number − 1, number − 1 + of, …
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Shard {
    /// Which part, from 1.
    pub number: u64,
    /// How many parts there are.
    pub of: u64,
}

impl Shard {
    /// The whole table.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// How many rows of `total` are in it.
    pub fn rows(self, total: u64) -> u64 {
        (total + self.of - self.number) / self.of
    }

    /// Number of the whole table's row that is its row `position`, both from 0.
    pub fn index(self, position: u64) -> u64 {
        position * self.of + self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((number, of)) if (1..=of).contains(&number) && of <= 1_000_000 => Ok(Shard { number, of }),
            _ => Err("a shard is I/N with I from 1 to N, as 3/8".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_every_row_once() {
        for (total, of) in [(0, 3), (2, 3), (10, 3), (12, 4), (7, 1)] {
            let mut rows: Vec<u64> = (1..=of)
                .map(|number| Shard { number, of })
                .flat_map(|s| (0..s.rows(total)).map(move |p| s.index(p)))
                .collect();
            rows.sort_unstable();
            assert_eq!(rows, (0..total).collect::<Vec<_>>(), "{total} in {of}");
        }
        for bad in ["", "3", "0/3", "4/3", "1/0", "a/b", "1/2/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
        assert_eq!("2/3".parse::<Shard>().map(|s| s.to_string()), Ok("2/3".into()));
    }
}
