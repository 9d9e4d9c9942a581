//! One of several interleaved parts of a table, for machines that share the work.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The part `number` of `of`: rows number − 1, number − 1 + of, …
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "StatedShard")]
pub struct Shard {
    /// Which part, from 1.
    pub number: u64,
    /// How many parts there are.
    pub of: u64,
}

/// As a file says it.
#[derive(Deserialize)]
struct StatedShard {
    number: u64,
    of: u64,
}

impl TryFrom<StatedShard> for Shard {
    type Error = String;

    fn try_from(StatedShard { number, of }: StatedShard) -> Result<Shard, String> {
        Shard::checked(number, of)
    }
}

/// No table is shared by more machines.
const MOST: u64 = 1_000_000;

impl Shard {
    fn checked(number: u64, of: u64) -> Result<Shard, String> {
        if (1..=of).contains(&number) && of <= MOST {
            Ok(Shard { number, of })
        } else {
            Err("a shard is I/N with I from 1 to N, e.g. 3/8".into())
        }
    }

    /// The whole table.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// How many rows of `total` are in it.
    pub fn rows(self, total: u64) -> u64 {
        total.saturating_add(self.of - self.number) / self.of
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
        let (number, of) = parts.unwrap_or_default();
        Shard::checked(number, of)
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
        for bad in [(0, 3), (4, 3), (1, 0), (1, u64::MAX)] {
            let text = format!("{{\"number\":{},\"of\":{}}}", bad.0, bad.1);
            assert!(serde_json::from_str::<Shard>(&text).is_err(), "{text}");
        }
        assert_eq!(Shard { number: 1, of: 3 }.rows(u64::MAX), u64::MAX / 3);
        assert_eq!("2/3".parse::<Shard>().map(|s| s.to_string()), Ok("2/3".into()));
    }
}
