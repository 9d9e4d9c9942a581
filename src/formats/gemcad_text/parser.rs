//! The parser of GemCad text files: tiers as the file gives them, each word with its place in the text.

use super::tier_line::{AscIndex, TierLine};
use super::words::{AscWord, AscWords, append, is_keyword_line, keyword, order};
use crate::design::Gear;
use crate::formats::error::{FormatError, quoted_excerpt};
use crate::formats::input::{Input, MINUS_SIGNS, number};
use crate::limits;
use std::ops::Range;

/// A file of other text has remarks on every line: nobody reads more of them.
const MOST_REMARKS: usize = 50;

/// What the words that come next belong to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum OpenItem {
    Nothing,
    /// Indices of the last tier.
    Tier,
    /// As `Tier`, after instructions: these may go on in an indented line.
    Instructions,
    Header,
    Footer,
}

/// A file as it is written.
pub struct AscFile<'s> {
    pub source: &'s Input<'s>,
    pub gear: Option<Gear>,
    pub symmetry: Option<(u32, bool)>,
    pub refractive_index: Option<f64>,
    /// Where that stands.
    pub refractive_index_at: Option<Range<usize>>,
    pub headers: Vec<String>,
    pub footers: Vec<String>,
    pub tiers: Vec<TierLine>,
    facet_count: usize,
    /// The line of the first facet over the limit.
    too_many_at: Option<usize>,
    open: OpenItem,
    pub warnings: Vec<String>,
}

/// The file whose decoded text this is; places count the text's bytes.
pub fn parse<'s>(source: &'s Input<'s>, text: &str) -> Result<AscFile<'s>, FormatError> {
    let mut file = AscFile {
        source,
        gear: None,
        symmetry: None,
        refractive_index: None,
        refractive_index_at: None,
        headers: Vec::new(),
        footers: Vec::new(),
        tiers: Vec::new(),
        facet_count: 0,
        too_many_at: None,
        open: OpenItem::Nothing,
        warnings: Vec::new(),
    };
    let mut words = AscWords::new(text);
    while let Some(word) = words.next() {
        file.word(word, &mut words)?;
    }
    if let Some(line) = file.too_many_at {
        source.has_at_most_at(line, &limits::FACETS, file.facet_count)?;
    }
    file.through_the_centre();
    if file.tiers.is_empty() {
        return Err(source.at_line(words.line(), "tiers (lines 'a ANGLE DISTANCE INDEX …')", ""));
    }
    file.complete()?;
    Ok(file)
}

impl AscFile<'_> {
    fn word(&mut self, word: AscWord, words: &mut AscWords) -> Result<(), FormatError> {
        if word.first && self.continues_text(&word) {
            words.end_line(word.line);
            return Ok(());
        }
        if word.is_comment() || self.is_title(&word) {
            if !word.first {
                self.remark(|| {
                    format!("line {}: taken as a comment: {}", word.line, quoted_excerpt(&word.onward()))
                });
            }
            words.end_line(word.line);
            return Ok(());
        }
        let in_tier = matches!(self.open, OpenItem::Tier | OpenItem::Instructions);
        match (keyword(word.text), word.text) {
            (Some((letter, value)), _) => self.keyword(word, letter, value, words),
            (None, "n") if in_tier => self.name(word, words),
            (None, "G") if in_tier => {
                if let Some(tier) = self.tiers.last_mut() {
                    append(&mut tier.instructions, word.rest);
                }
                self.open = OpenItem::Instructions;
                words.end_line(word.line);
                Ok(())
            }
            (None, text) => match number(text) {
                Some(index) if in_tier => {
                    self.facet(&word, index);
                    Ok(())
                }
                // `96 0.0`, as some writer leaves the letter out
                Some(_) if self.gear.is_none() && self.tiers.is_empty() => self.gear(word, text, words),
                _ if in_tier && (!word.first || loses_facets(&word)) => {
                    Err(self.source.at_line(word.line, "an index, 'n NAME' or 'G'", text))
                }
                _ => {
                    self.leave_out(&word, words);
                    Ok(())
                }
            },
        }
    }

    /// Takes the line as one more of the open text, if that is what it is: any indented text but a line of
    /// a keyword.
    fn continues_text(&mut self, word: &AscWord) -> bool {
        let line = word.onward();
        let is_of_the_tier = number(word.text).is_some() || matches!(word.text, "n" | "G");
        let text = match self.open {
            _ if !word.indented || is_keyword_line(&line) => None,
            OpenItem::Header => self.headers.last_mut(),
            OpenItem::Footer => self.footers.last_mut(),
            OpenItem::Instructions if !is_of_the_tier => self.tiers.last_mut().map(|t| &mut t.instructions),
            _ => None,
        };
        text.map(|text| append(text, &line)).is_some()
    }

    /// `GemCad 5.0` on the first line.
    fn is_title(&self, word: &AscWord) -> bool {
        let is_start = word.first && self.gear.is_none() && self.tiers.is_empty();
        is_start && word.text.get(..6).is_some_and(|k| k.eq_ignore_ascii_case("gemcad"))
    }

    /// Keeps a remark on a line, if it is one of the first.
    fn remark(&mut self, remark: impl FnOnce() -> String) {
        match self.warnings.len() {
            0..MOST_REMARKS => self.warnings.push(remark()),
            MOST_REMARKS => self.warnings.push("more lines like these are not told of".into()),
            _ => {}
        }
    }

    fn leave_out(&mut self, word: &AscWord, words: &mut AscWords) {
        self.remark(|| {
            format!("line {}: not understood and left out: {}", word.line, quoted_excerpt(&word.onward()))
        });
        words.end_line(word.line);
    }

    fn keyword(
        &mut self,
        word: AscWord,
        letter: char,
        glued: &str,
        words: &mut AscWords,
    ) -> Result<(), FormatError> {
        let text = |open| (open, word.rest.to_owned());
        let (open, said) = match letter {
            'H' => text(OpenItem::Header),
            'F' => text(OpenItem::Footer),
            _ => {
                let (value, at) = match glued {
                    "" => words.peek(0).map_or((String::new(), 0..0), |w| (w.text.to_owned(), w.place())),
                    glued => (glued.to_owned(), word.place().end - glued.len()..word.place().end),
                };
                let counts = if letter == 'y' { order(&value).is_some() } else { number(&value).is_some() };
                if !counts {
                    return self.no_value(word, letter, words);
                }
                if glued.is_empty() {
                    words.next();
                }
                match letter {
                    'a' => return self.tier(word, &value, at, words),
                    'g' => return self.gear(word, &value, words),
                    'y' => self.symmetry(word, &value, words),
                    _ => self.index(word, &value, at),
                }
                self.open = OpenItem::Nothing;
                return Ok(());
            }
        };
        self.open = open;
        if open == OpenItem::Header {
            self.headers.push(said)
        } else {
            self.footers.push(said)
        }
        words.end_line(word.line);
        Ok(())
    }

    /// A keyword without its number: a tier or a gear that would be lost, or a word like others.
    fn no_value(&mut self, word: AscWord, letter: char, words: &mut AscWords) -> Result<(), FormatError> {
        let found = words.peek(0).filter(|w| w.line == word.line).map_or("", |w| w.text);
        let meant = word.rest.split_whitespace().nth(1).is_some_and(|w| number(w).is_some());
        match letter {
            'a' if word.first
                && (meant || found.starts_with(|c: char| "+-.".contains(c) || MINUS_SIGNS.contains(&c))) =>
            {
                Err(self.source.at_line(word.line, "an angle from -90 to 90 degrees", found))
            }
            'g' if word.first && self.gear.is_none() => {
                Err(self.source.at_line(word.line, "the number of gear teeth, not 0", found))
            }
            _ if matches!(self.open, OpenItem::Tier | OpenItem::Instructions) && !word.first => {
                Err(self.source.at_line(word.line, "an index, 'n NAME' or 'G'", word.text))
            }
            _ => {
                self.leave_out(&word, words);
                Ok(())
            }
        }
    }

    fn gear(&mut self, word: AscWord, teeth: &str, words: &mut AscWords) -> Result<(), FormatError> {
        let teeth = number(teeth)
            .filter(|t| *t != 0.0)
            .ok_or_else(|| self.source.at_line(word.line, "the number of gear teeth, not 0", teeth))?;
        let offset = words.peek(0).filter(|w| w.line == word.line);
        let offset = match offset.map(|w| (w, number(w.text))) {
            Some((_, Some(offset))) => {
                words.next();
                offset
            }
            Some((w, None)) if !w.is_comment() && keyword(w.text).is_none() => {
                return Err(self.source.at_line(word.line, "the gear's offset in teeth", w.text));
            }
            _ => 0.0,
        };
        if self.gear.is_some() {
            self.remark(|| format!("line {}: a second gear; it counts for the tiers after it", word.line));
        }
        self.gear = Some(Gear { teeth, offset });
        self.open = OpenItem::Nothing;
        Ok(())
    }

    /// For information: no facet depends on it.
    fn symmetry(&mut self, word: AscWord, value: &str, words: &mut AscWords) {
        let Some((order, mirror)) = order(value) else { return };
        let next = words.peek(0).filter(|w| mirror.is_none() && w.line == word.line);
        let next = next.filter(|w| w.text.eq_ignore_ascii_case("y") || w.text.eq_ignore_ascii_case("n"));
        if next.is_some() {
            words.next();
        }
        let mirror = mirror.unwrap_or(next.is_some_and(|w| w.text.eq_ignore_ascii_case("y")));
        self.symmetry = Some((order, mirror));
    }

    /// For information: no facet depends on it.
    fn index(&mut self, word: AscWord, value: &str, at: Range<usize>) {
        let Some(index) = number(value) else { return };
        if !(index > 1.0 && index <= 3.5) {
            let done = if index < 1.0 { "left out" } else { "kept" };
            self.remark(|| {
                format!("line {}: index of refraction {index} is not that of any gem; {done}", word.line)
            });
        }
        self.refractive_index = Some(index).filter(|n| *n >= 1.0);
        self.refractive_index_at = Some(at);
    }

    fn tier(
        &mut self,
        word: AscWord,
        angle: &str,
        angle_at: Range<usize>,
        words: &mut AscWords,
    ) -> Result<(), FormatError> {
        let angle_deg = number(angle)
            .filter(|a| a.abs() <= 90.0)
            .ok_or_else(|| self.source.at_line(word.line, "an angle from -90 to 90 degrees", angle))?;
        let second = words.next();
        let at = second.map_or(word.line, |w| w.line);
        let rho_at = second.map_or(0..0, |w| w.place());
        let second = second.map_or("", |w| w.text);
        let rho =
            number(second).ok_or_else(|| self.source.at_line(at, "the distance of the facets", second))?;
        if rho < 0.0 && angle_deg != 0.0 {
            self.remark(|| {
                format!("line {at}: a distance of {rho}, below 0, is not documented; taken as {}", -rho)
            });
        }
        let (indices, name, instructions) = Default::default();
        let (line, start, gear) = (word.line, word.at, self.gear);
        self.tiers.push(TierLine {
            line,
            start,
            gear,
            angle_deg,
            angle_at,
            rho,
            rho_at,
            indices,
            name,
            instructions,
        });
        self.open = OpenItem::Tier;
        Ok(())
    }

    fn facet(&mut self, word: &AscWord, index: f64) {
        self.facet_count += 1;
        match self.source.limits.check(&limits::FACETS, self.facet_count) {
            Ok(()) => self.tiers.last_mut().map_or((), |t| {
                t.indices.push(AscIndex { value: index, name: String::new(), at: Some(word.place()) })
            }),
            // counted on, for the error to say how many there are
            Err(_) => self.too_many_at = self.too_many_at.or(Some(word.line)),
        }
    }

    /// The name after `n`, of the index before it: any word at all, as facets are called G, n, a or 12, and
    /// more words up to the next number or keyword.
    fn name(&mut self, word: AscWord, words: &mut AscWords) -> Result<(), FormatError> {
        let expected = "a facet name after 'n'";
        let Some(first) = words.next() else {
            return Err(self.source.at_line(words.line(), expected, ""));
        };
        if first.first && !first.indented && is_keyword_line(&first.onward()) {
            return Err(self.source.at_line(first.line, expected, &first.onward()));
        }
        let mut name = first.text.to_owned();
        while let Some(more) = words.peek(0).filter(|w| w.line == first.line) {
            let ends = number(more.text).is_some() || matches!(more.text, "n" | "G") || more.is_comment();
            if ends
                || keyword(more.text).is_some_and(|(k, _)| "HF".contains(k))
                || is_keyword_line(&more.onward())
            {
                break;
            }
            append(&mut name, more.text);
            words.next();
        }
        if name.len() > first.text.len() {
            self.remark(|| format!("line {}: a name of several words: {}", word.line, quoted_excerpt(&name)));
        }
        if let Some(tier) = self.tiers.last_mut() {
            if tier.name.is_empty() {
                tier.name.clone_from(&name);
            }
            if let Some(of_index) = tier.indices.last_mut() {
                of_index.name = name;
            }
        }
        Ok(())
    }

    /// Leaves out tiers at distance 0, as GemCad's author's reader does: they would halve the stone.
    fn through_the_centre(&mut self) {
        let lines: Vec<usize> = self.tiers.iter().filter(|t| t.rho == 0.0).map(|t| t.line).collect();
        for line in lines {
            self.remark(|| {
                format!("line {line}: a tier at distance 0, through the stone's centre; left out")
            });
        }
        self.tiers.retain(|t| t.rho != 0.0);
    }

    /// Gives flat tiers without an index one: a table lies at any. Other tiers must have one.
    fn complete(&mut self) -> Result<(), FormatError> {
        for flat in self.tiers.iter_mut().filter(|t| t.angle_deg == 0.0 && t.indices.is_empty()) {
            let value = self.gear.map_or(0.0, |g| g.teeth.abs());
            flat.indices.push(AscIndex { value, name: flat.name.clone(), at: None });
        }
        match self.tiers.iter().find(|t| t.indices.is_empty()) {
            Some(tier) => Err(self.source.at_line(tier.line, "at least one index in the tier", "")),
            None => Ok(()),
        }
    }
}

/// Whether a line that does not begin as one of a tier would lose facets: it is indented as such lines are,
/// and has numbers.
fn loses_facets(word: &AscWord) -> bool {
    word.indented && word.rest.split_whitespace().any(|w| number(w).is_some())
}
