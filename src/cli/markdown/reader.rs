//! A Markdown document, read part by part onto a page.

use super::page::Page;
use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Tag, TagEnd};

/// What is being read.
#[derive(Default)]
pub struct Reader {
    /// The page that is written.
    pub page: Page,
    /// The address of the link that is being read.
    link: String,
    /// The code that is being read; none outside of code.
    code: Option<String>,
    is_rust: bool,
    /// The rows of the table that is being read.
    rows: Vec<Vec<String>>,
}

impl Reader {
    /// Onto a page.
    pub fn new(page: Page) -> Reader {
        Reader { page, ..Reader::default() }
    }

    /// Takes the next part of the document.
    pub fn take(&mut self, event: Event) {
        match event {
            Event::Start(tag) => self.begin(tag),
            Event::End(tag) => self.end(tag),
            Event::Text(text) => match &mut self.code {
                Some(code) => *code += &text,
                None => self.page.inline += &text,
            },
            Event::Code(code) => self.page.inline += &format!("`{code}`"),
            Event::SoftBreak | Event::HardBreak => self.page.inline.push(' '),
            _ => (),
        }
    }

    fn begin(&mut self, tag: Tag) {
        match tag {
            Tag::Heading { .. } | Tag::Paragraph => self.page.gap(),
            Tag::List(_) => {
                self.page.fill(); // the text of the item that the list is in
                if self.page.depth == 0 {
                    self.page.gap();
                }
                self.page.depth += 1;
            }
            Tag::Item => self.page.bullet = true,
            Tag::CodeBlock(kind) => {
                self.page.fill();
                self.page.gap();
                self.is_rust =
                    matches!(&kind, CodeBlockKind::Fenced(language) if language.starts_with("rust"));
                self.code = Some(String::new());
            }
            Tag::Link { dest_url, .. } if dest_url.starts_with("http") => self.link = dest_url.into_string(),
            Tag::Table(_) => self.page.gap(),
            Tag::TableHead | Tag::TableRow => self.rows.push(Vec::new()),
            _ => (),
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Heading(level) => {
                let heading = std::mem::take(&mut self.page.inline);
                self.page.text += &if level == HeadingLevel::H1 { heading.to_uppercase() } else { heading };
                self.page.text.push('\n');
            }
            TagEnd::Paragraph | TagEnd::Item => self.page.fill(),
            TagEnd::List(_) => self.page.depth -= 1,
            TagEnd::CodeBlock => {
                let code = self.code.take().unwrap_or_default();
                let is_hidden = |line: &&str| self.is_rust && (*line == "#" || line.starts_with("# "));
                self.page.code(code.lines().filter(|line| !is_hidden(line)));
            }
            TagEnd::Link if !self.link.is_empty() => {
                self.page.inline += &format!(" ({})", std::mem::take(&mut self.link));
            }
            TagEnd::TableCell => {
                let cell = std::mem::take(&mut self.page.inline);
                self.rows.last_mut().into_iter().for_each(|row| row.push(cell.clone()));
            }
            TagEnd::Table => self.page.table(std::mem::take(&mut self.rows)),
            _ => (),
        }
    }
}
