//! Text for a terminal as it is written: filled paragraphs, items of lists, code, tables.

use crate::cli::wrap;
use comfy_table::{ContentArrangement, LineStyle, Table, TableStyle};

/// Columns left of text.
const MARGIN: usize = 4;
/// Columns that a level of a list is further in.
const STEP: usize = 2;
/// A narrower terminal breaks lines itself.
const NARROWEST: usize = 40;

/// What has been written, and the text that is to be written next.
#[derive(Default)]
pub struct Page {
    width: usize,
    /// What has been written.
    pub text: String,
    /// The text of the paragraph, heading, item or cell that is being read.
    pub inline: String,
    /// Lists that are open.
    pub depth: usize,
    /// Whether the next line begins an item of a list.
    pub bullet: bool,
}

impl Page {
    /// An empty page.
    ///
    /// - `width`: characters of a line
    pub fn new(width: usize) -> Page {
        Page { width: width.max(NARROWEST), ..Page::default() }
    }

    fn indent(&self) -> usize {
        MARGIN + STEP * self.depth
    }

    /// An empty line, but at the top.
    pub fn gap(&mut self) {
        if !self.text.is_empty() && !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    /// Writes the text that has been read, in lines.
    pub fn fill(&mut self) {
        let inline = std::mem::take(&mut self.inline);
        let indent = self.indent();
        for line in wrap::lines(&inline, self.width - indent) {
            match std::mem::take(&mut self.bullet) {
                true => self.text += &format!("{:1$}- {line}\n", "", indent - STEP),
                false => self.text += &format!("{:indent$}{line}\n", ""),
            }
        }
    }

    /// Writes lines of code as they are.
    pub fn code<'a>(&mut self, lines: impl Iterator<Item = &'a str>) {
        for line in lines {
            self.text += format!("{:1$}{line}", "", self.indent() + MARGIN).trim_end();
            self.text.push('\n');
        }
    }

    /// Writes a table; its first row is the head, which may be empty.
    pub fn table(&mut self, rows: Vec<Vec<String>>) {
        let mut rows = rows.into_iter();
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
