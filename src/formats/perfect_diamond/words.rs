//! The words of a pbrt scene: quoted texts, brackets, numbers, names; `#` starts a comment.

use crate::formats::input::{lines, number};

/// One word of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum PbrtWord<'t> {
    /// `"text"`, without its quotes.
    Text(&'t str),
    /// `[`
    Open,
    /// `]`
    Close,
    /// A number.
    Number(f64),
    /// A directive or any other bare word.
    Name(&'t str),
}

impl PbrtWord<'_> {
    /// The word as an error shows it.
    pub fn describe(&self) -> String {
        match self {
            PbrtWord::Text(t) => format!("\"{t}\""),
            PbrtWord::Open => "[".into(),
            PbrtWord::Close => "]".into(),
            PbrtWord::Number(x) => x.to_string(),
            PbrtWord::Name(n) => (*n).into(),
        }
    }
}

/// The words with the numbers of their lines, from 1. A quote ends at the end of its line.
pub fn words(text: &str) -> impl Iterator<Item = (usize, PbrtWord<'_>)> {
    lines(text).flat_map(|(at, line)| {
        let mut rest = line;
        std::iter::from_fn(move || {
            rest = rest.trim_start();
            let first = rest.chars().next().filter(|c| *c != '#')?;
            let word = match first {
                '[' | ']' => {
                    rest = &rest[1..];
                    if first == '[' { PbrtWord::Open } else { PbrtWord::Close }
                }
                '"' => {
                    let (text, after) = rest[1..].split_once('"').unwrap_or((&rest[1..], ""));
                    rest = after;
                    PbrtWord::Text(text)
                }
                _ => {
                    let end = rest
                        .find(|c: char| c.is_whitespace() || "[]\"#,".contains(c))
                        .unwrap_or(rest.len())
                        .max(first.len_utf8());
                    let (word, after) = rest.split_at(end);
                    rest = after;
                    number(word).map_or(PbrtWord::Name(word), PbrtWord::Number)
                }
            };
            Some((at, word))
        })
    })
}
