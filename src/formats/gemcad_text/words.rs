//! The words of a GemCad text file, one after the other, with a look ahead and to the line's end; and which
//! of them are keywords.

use crate::formats::input::{lines, number};
use std::collections::VecDeque;
use std::ops::Range;

/// One word and where it stands.
#[derive(Debug, Clone, Copy)]
pub struct AscWord<'t> {
    /// The line, from 1.
    pub line: usize,
    /// Where it begins in the text, in bytes.
    pub at: usize,
    /// The word itself.
    pub text: &'t str,
    /// What follows it on its line.
    pub rest: &'t str,
    /// Whether it is the first of its line.
    pub first: bool,
    /// Whether its line begins with white space.
    pub indented: bool,
}

impl<'t> AscWord<'t> {
    /// The line from this word on.
    pub fn onward(&self) -> String {
        format!("{} {}", self.text, self.rest).trim_end().to_owned()
    }

    /// Its place in the text, in bytes.
    pub fn place(&self) -> Range<usize> {
        self.at..self.at + self.text.len()
    }

    /// Whether it begins a comment.
    pub fn is_comment(&self) -> bool {
        self.text.starts_with([';', '#'])
    }
}

/// The words that are still to be read.
pub struct AscWords<'t> {
    whole: &'t str,
    lines: Box<dyn Iterator<Item = (usize, &'t str)> + 't>,
    ahead: VecDeque<AscWord<'t>>,
    /// What is left of the line whose words are looked at, and its number.
    line: (usize, &'t str),
    first: bool,
    indented: bool,
}

impl<'t> AscWords<'t> {
    pub fn new(text: &'t str) -> AscWords<'t> {
        let (ahead, line) = (VecDeque::new(), (1, ""));
        AscWords { whole: text, lines: Box::new(lines(text)), ahead, line, first: false, indented: false }
    }

    /// The number of the line that was looked at last.
    pub fn line(&self) -> usize {
        self.line.0
    }

    /// The word after the next `k`.
    pub fn peek(&mut self, k: usize) -> Option<AscWord<'t>> {
        while self.ahead.len() <= k {
            let word = self.split()?;
            self.ahead.push_back(word);
        }
        self.ahead.get(k).copied()
    }

    /// Passes over the rest of that line.
    pub fn end_line(&mut self, line: usize) {
        while self.ahead.front().is_some_and(|w| w.line == line) {
            self.ahead.pop_front();
        }
        if self.line.0 == line {
            self.line.1 = "";
        }
    }

    fn split(&mut self) -> Option<AscWord<'t>> {
        while self.line.1.trim_start().is_empty() {
            self.line = self.lines.next()?;
            self.first = true;
            self.indented = self.line.1.starts_with(char::is_whitespace);
        }
        let (line, left) = (self.line.0, self.line.1.trim_start());
        let (text, rest) = left.split_at(left.find(char::is_whitespace).unwrap_or(left.len()));
        self.line.1 = rest;
        Some(AscWord {
            line,
            // a part of the whole text: its address tells its place
            at: text.as_ptr() as usize - self.whole.as_ptr() as usize,
            text,
            rest: rest.trim(),
            first: std::mem::take(&mut self.first),
            indented: self.indented,
        })
    }
}

impl<'t> Iterator for AscWords<'t> {
    type Item = AscWord<'t>;

    fn next(&mut self) -> Option<AscWord<'t>> {
        self.peek(0)?;
        self.ahead.pop_front()
    }
}

/// The keyword that a word is, and the value that is glued to it as in `g96`, `I1.54`, `y4n`; whether a
/// value follows is not looked at.
pub fn keyword(word: &str) -> Option<(char, &str)> {
    let letter = word.chars().next().filter(|c| "agyIHF".contains(*c))?;
    let value = &word[1..];
    let glued = match letter {
        _ if value.is_empty() => true,
        'y' => order(value).is_some(),
        'H' | 'F' => false,
        _ => number(value).is_some(),
    };
    glued.then_some((letter, value))
}

/// The order of symmetry of `4`, `4n` or `4y`, and whether a letter that is there says `y`.
pub fn order(word: &str) -> Option<(u32, Option<bool>)> {
    let end = word.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(word.len());
    let mirror = match &word[end..] {
        "" => None,
        letter => Some(letter.eq_ignore_ascii_case("y")),
    };
    let order = number(&word[..end]).filter(|n| n.fract() == 0.0 && n.abs() <= 1e4)?;
    Some((order.abs() as u32, mirror))
}

/// Whether a line of running text is none: it has the form of a keyword's line from its first word to its
/// last. Prose may begin with the word a or I, and even with a number after it.
pub fn is_keyword_line(line: &str) -> bool {
    let mut words = line.split_whitespace();
    let Some((letter, glued)) = words.next().and_then(keyword) else { return false };
    let mut values = (!glued.is_empty()).then_some(glued).into_iter().chain(words);
    let next_is_number = |w: Option<&str>| w.and_then(number).is_some();
    match letter {
        'a' => next_is_number(values.next()) && next_is_number(values.next()),
        'y' => values.next().and_then(order).is_some() && values.count() < 2,
        'g' | 'I' => next_is_number(values.next()) && values.count() < 2,
        _ => true,
    }
}

/// Whether text is that of a design without its title: a gear first, and a tier after it, wherever lines end.
pub fn begins(text: &str) -> bool {
    let mut words = AscWords::new(text);
    let is_gear = |word: AscWord, next: &str| match keyword(word.text) {
        Some(('g', "")) => number(next).is_some(),
        Some(('g', _)) => true,
        _ => false,
    };
    let (Some(first), second) = (words.next(), words.next()) else { return false };
    if !is_gear(first, second.map_or("", |w| w.text)) {
        return false;
    }
    let said: Vec<&str> = words.map(|w| w.text).collect();
    let is_tier = |words: &[&str]| words[0].starts_with('a') && is_keyword_line(&words.join(" "));
    said.windows(3).any(is_tier)
}

/// Adds words to a text, after a blank if it has some.
pub fn append(text: &mut String, more: &str) {
    if !text.is_empty() && !more.is_empty() {
        text.push(' ');
    }
    *text += more;
}
