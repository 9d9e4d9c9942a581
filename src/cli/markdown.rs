//! Markdown as text for a terminal: headings to the left, text indented and filled, code and tables kept.

use super::wrap;
use comfy_table::{ContentArrangement, LineStyle, Table, TableStyle};
use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Options, Parser, Tag, TagEnd};

/// The text of a Markdown document, in lines of up to `width` characters but for code.
///
/// Inline code keeps its backticks; links show their address if it is one of the web. Of Rust code the lines that
/// the documentation hides (`# …`) are left out.
pub fn for_terminal(markdown: &str, width: usize) -> String {
    let mut page = Page { width: width.max(NARROWEST), ..Page::default() };
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES) {
        page.take(event);
    }
    page.text
}

/// Columns left of text.
const MARGIN: usize = 4;
/// Columns that a level of a list is further in.
const STEP: usize = 2;
/// A narrower terminal breaks lines itself.
const NARROWEST: usize = 40;

/// What has been written, and what is being read.
#[derive(Default)]
struct Page {
    width: usize,
    text: String,
    /// The text of the paragraph, heading, item or cell that is being read.
    inline: String,
    /// Lists that are open.
    depth: usize,
    /// Whether the next line begins an item of a list.
    bullet: bool,
    /// The address of the link that is being read.
    link: String,
    /// The code that is being read; none outside of code.
    code: Option<String>,
    is_rust: bool,
    rows: Vec<Vec<String>>,
}

impl Page {
    fn take(&mut self, event: Event) {
        match event {
            Event::Start(tag) => self.begin(tag),
            Event::End(tag) => self.end(tag),
            Event::Text(text) => match &mut self.code {
                Some(code) => *code += &text,
                None => self.inline += &text,
            },
            Event::Code(code) => self.inline += &format!("`{code}`"),
            Event::SoftBreak | Event::HardBreak => self.inline.push(' '),
            _ => (),
        }
    }

    fn begin(&mut self, tag: Tag) {
        match tag {
            Tag::Heading { .. } | Tag::Paragraph => self.gap(),
            Tag::List(_) => {
                self.fill(); // the text of the item that the list is in
                if self.depth == 0 {
                    self.gap();
                }
                self.depth += 1;
            }
            Tag::Item => self.bullet = true,
            Tag::CodeBlock(kind) => {
                self.fill();
                self.gap();
                self.is_rust =
                    matches!(&kind, CodeBlockKind::Fenced(language) if language.starts_with("rust"));
                self.code = Some(String::new());
            }
            Tag::Link { dest_url, .. } if dest_url.starts_with("http") => self.link = dest_url.into_string(),
            Tag::Table(_) => self.gap(),
            Tag::TableHead | Tag::TableRow => self.rows.push(Vec::new()),
            _ => (),
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Heading(level) => {
                let heading = std::mem::take(&mut self.inline);
                self.text += &if level == HeadingLevel::H1 { heading.to_uppercase() } else { heading };
                self.text.push('\n');
            }
            TagEnd::Paragraph | TagEnd::Item => self.fill(),
            TagEnd::List(_) => self.depth -= 1,
            TagEnd::CodeBlock => {
                let code = self.code.take().unwrap_or_default();
                let is_hidden = |line: &&str| self.is_rust && (*line == "#" || line.starts_with("# "));
                for line in code.lines().filter(|line| !is_hidden(line)) {
                    self.text += format!("{:1$}{line}", "", self.indent() + MARGIN).trim_end();
                    self.text.push('\n');
                }
            }
            TagEnd::Link if !self.link.is_empty() => {
                self.inline += &format!(" ({})", std::mem::take(&mut self.link));
            }
            TagEnd::TableCell => {
                let cell = std::mem::take(&mut self.inline);
                self.rows.last_mut().into_iter().for_each(|row| row.push(cell.clone()));
            }
            TagEnd::Table => self.table(),
            _ => (),
        }
    }

    fn indent(&self) -> usize {
        MARGIN + STEP * self.depth
    }

    /// An empty line, but at the top.
    fn gap(&mut self) {
        if !self.text.is_empty() && !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    /// Writes the text that has been read, in lines.
    fn fill(&mut self) {
        let inline = std::mem::take(&mut self.inline);
        let indent = self.indent();
        for line in wrap::lines(&inline, self.width - indent) {
            match std::mem::take(&mut self.bullet) {
                true => self.text += &format!("{:1$}- {line}\n", "", indent - STEP),
                false => self.text += &format!("{:indent$}{line}\n", ""),
            }
        }
    }

    /// Writes the table that has been read; its first row is the head, which may be empty.
    fn table(&mut self) {
        let mut rows = std::mem::take(&mut self.rows).into_iter();
        let mut table = Table::new();
        table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─')));
        table.set_content_arrangement(ContentArrangement::Dynamic);
        table.set_width(u16::try_from(self.width - MARGIN).unwrap_or(u16::MAX));
        if let Some(head) = rows.next().filter(|head| head.iter().any(|cell| !cell.is_empty())) {
            table.set_header(head);
        }
        rows.for_each(|row| _ = table.add_row(row));
        for column in table.column_iter_mut() {
            column.set_padding((0, 2));
        }
        for line in table.lines() {
            self.text += format!("{:MARGIN$}{line}", "").trim_end();
            self.text.push('\n');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_filled_and_code_is_kept() {
        let markdown = "# A cut\n\nOne two three four five six seven eight `nine ten` and\neleven, see \
                        [here](https://example.org).\n\n- an item that is longer than a line of forty letters\n  \
                        - inner\n- last\n\n```rust\n# use x;\nlet a = 1;\n```\n\n```toml\n# kept\n```\n\n## Next\n";
        let text = for_terminal(markdown, 40);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines,
            [
                "A CUT",
                "",
                "    One two three four five six seven",
                "    eight `nine ten` and eleven, see",
                "    here (https://example.org).",
                "",
                "    - an item that is longer than a line",
                "      of forty letters",
                "      - inner",
                "    - last",
                "",
                "        let a = 1;",
                "",
                "        # kept",
                "",
                "Next",
            ]
        );
    }

    #[test]
    fn tables_are_as_wide_as_the_terminal_at_most() {
        let markdown =
            "| key | what it is |\n|---|---|\n| `a` | a long text that has to be broken into lines |\n";
        for width in [40, 60] {
            let text = for_terminal(markdown, width);
            assert!(text.lines().all(|line| line.chars().count() <= width), "{text}");
            let words: Vec<&str> = text.split_whitespace().filter(|w| !w.contains(['─', '═'])).collect();
            assert_eq!(
                words.join(" "),
                "key what it is `a` a long text that has to be broken into lines".to_owned()
            );
        }
        assert!(for_terminal(markdown, 60).lines().count() < for_terminal(markdown, 40).lines().count());
    }
}
