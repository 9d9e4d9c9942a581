//! Text that no terminal obeys: names and files of strangers may hold any character.

use std::io::{Result, Write};

/// Whether a terminal would obey the character, or show what follows it in another order.
fn is_obeyed(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The text with control characters, but line ends, and marks of direction escaped as Rust writes them:
/// `\u{1b}`.
pub fn printable(text: &str) -> String {
    let shown = |c: char| if is_obeyed(c) && c != '\n' { c.escape_default().to_string() } else { c.into() };
    text.chars().map(shown).collect()
}

/// The text in one line: as [`printable`], with line ends escaped too.
pub fn in_line(text: &str) -> String {
    printable(text).replace('\n', "\\n")
}

/// The text with its lines joined by semicolons, as [`printable`]: for errors, which are one line.
pub fn one_line(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|l| !l.is_empty()).collect();
    printable(&lines.join("; "))
}

/// JSON text with the same characters escaped as JSON has it. What stands outside of strings holds none
/// but line ends.
pub fn printable_json(text: &str) -> String {
    let shown =
        |c: char| if is_obeyed(c) && c != '\n' { format!("\\u{:04x}", u32::from(c)) } else { c.into() };
    text.chars().map(shown).collect()
}

/// Standard output as a terminal: bytes that are written are text, whose control characters, but tabs and
/// line ends, are escaped.
pub struct Terminal<W> {
    inner: W,
    /// The beginning of a character that the last write ended in.
    begun: Vec<u8>,
}

impl<W: Write> Terminal<W> {
    /// Writes on to `inner`.
    pub fn new(inner: W) -> Terminal<W> {
        Terminal { inner, begun: Vec::new() }
    }
}

impl<W: Write> Write for Terminal<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let mut all = std::mem::take(&mut self.begun);
        all.extend_from_slice(bytes);
        let mut text = String::new();
        for chunk in all.utf8_chunks() {
            text += chunk.valid();
            let rest = chunk.invalid();
            let is_last = std::ptr::eq(rest.as_ptr_range().end, all.as_ptr_range().end);
            // as long as a whole character may follow, it is waited for
            let unended = is_last && std::str::from_utf8(rest).is_err_and(|e| e.error_len().is_none());
            if unended && !rest.is_empty() {
                self.begun = rest.to_vec();
            } else if !rest.is_empty() {
                text.push(char::REPLACEMENT_CHARACTER);
            }
        }
        let shown: Vec<String> = text.split('\t').map(printable).collect();
        self.inner.write_all(shown.join("\t").as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        assert_eq!(printable("a\x1b[31mb\u{9b}1m\r\nc\u{202e}"), "a\\u{1b}[31mb\\u{9b}1m\\r\nc\\u{202e}");
        let json = serde_json::to_string("a\x1b\u{9b}\u{7f}").expect("JSON");
        let shown = printable_json(&json);
        assert_eq!(serde_json::from_str::<String>(&shown).expect("JSON"), "a\x1b\u{9b}\u{7f}");
        assert!(shown.chars().all(|c| !is_obeyed(c)), "{shown}");
    }

    #[test]
    fn a_terminal_gets_text_however_it_is_cut_into_pieces() {
        let bytes = "name,\t±\u{9b}31m\x1b]0;x\x07\n".as_bytes();
        for cut in 0..=bytes.len() {
            let mut terminal = Terminal::new(Vec::new());
            terminal.write_all(&bytes[..cut]).expect("writes");
            terminal.write_all(&bytes[cut..]).expect("writes");
            let shown = String::from_utf8(terminal.inner).expect("UTF-8");
            assert_eq!(shown, "name,\t±\\u{9b}31m\\u{1b}]0;x\\u{7}\n", "{cut}");
        }
        let mut terminal = Terminal::new(Vec::new());
        terminal.write_all(b"a\xff\x1b").expect("writes");
        assert_eq!(terminal.inner, "a\u{fffd}\\u{1b}".as_bytes());
    }
}
