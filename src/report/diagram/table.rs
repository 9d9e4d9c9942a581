//! The table of tiers, set as large as the room allows: in one column or two, wrapped, and cut short
//! with a word on what is missing if even the smallest print is too large.

use super::rows::DiagramRow;
use super::sheet::{Sheet, fitted, width, wrapped};
use crate::design::{Gear, Zone};
use crate::report::svg_canvas::Anchor;
use glam::DVec2;

/// Font sizes from the largest to the smallest that a cutter still reads, in mm (9.1 to 5.1 points).
const SIZES: [f64; 15] = [3.2, 3.1, 3.0, 2.9, 2.8, 2.7, 2.6, 2.5, 2.4, 2.3, 2.2, 2.1, 2.0, 1.9, 1.8];

/// From this size on one column is better than two of larger print.
const EASY: f64 = 2.5;

/// Distance of lines, and of columns within a row, in units of the font size.
const LEAD: f64 = 1.36;
const GAP: f64 = 1.1;

/// Space between two halves of the table, in mm.
const GUTTER: f64 = 7.0;

/// Heads of the columns.
const HEADS: [&str; 5] = ["Facet", "Angle", "n", "Index", "Notes"];

/// A row as lines of text.
struct TableBlock {
    /// Pavilion or crown.
    side: &'static str,
    cells: [Vec<String>; 5],
}

/// Lines that a head takes, with the space above it.
const HEAD: usize = 2;

impl TableBlock {
    fn lines(&self) -> usize {
        self.cells.iter().map(Vec::len).max().unwrap_or_default()
    }
}

/// The table set at one size.
pub struct TypesetTable {
    size: f64,
    /// Left edges of the five columns, from the left edge of a half.
    lefts: [f64; 5],
    /// Width of a half.
    width: f64,
    halves: Vec<Vec<TableBlock>>,
    /// Tiers that had no room.
    pub left_out: usize,
}

/// Sets the table into a box of `room` mm at the largest size of at least `least` mm at which all of
/// it fits; none if it does not.
pub fn fit(rows: &[DiagramRow], gear: Gear, room: DVec2, least: f64) -> Option<TypesetTable> {
    let sizes = SIZES.iter().filter(|size| **size >= least);
    let one = sizes.clone().filter(|size| **size >= EASY).map(|size| (*size, 1));
    one.chain(sizes.flat_map(|size| [1, 2].map(|halves| (*size, halves))))
        .filter_map(|(size, halves)| set(rows, gear, room, size, halves))
        .find(|set| set.left_out == 0)
}

/// As [`fit`] at the smallest size, as many rows as there is room for.
pub fn cut_short(rows: &[DiagramRow], gear: Gear, room: DVec2) -> Option<TypesetTable> {
    set(rows, gear, room, SIZES[SIZES.len() - 1], 2)
}

fn set(rows: &[DiagramRow], gear: Gear, room: DVec2, size: f64, halves: usize) -> Option<TypesetTable> {
    let wide = (room.x - GUTTER * (halves - 1) as f64) / halves as f64;
    let texts: Vec<[String; 5]> = rows
        .iter()
        .map(|r| {
            let angle = format!("{:.2}°", r.angle_deg);
            [r.code.clone(), angle, r.count.to_string(), r.index_text(gear), r.notes.clone()]
        })
        .collect();
    let widest = |c: usize| {
        let cells = texts.iter().map(|t| width(&t[c], size, c == 0));
        let used = cells.fold(0.0, f64::max);
        if used > 0.0 { used.max(width(HEADS[c], size, true)) } else { 0.0 }
    };
    let mut widths: [f64; 5] = std::array::from_fn(widest);
    widths[0] = widths[0].min(0.2 * wide);
    let gap = GAP * size;
    let left = wide - widths[..3].iter().sum::<f64>() - 4.0 * gap;
    // notes take what the indices leave them, and at least two fifths if they need it
    widths[4] = widths[4].min((left - widths[3]).max(0.4 * left));
    widths[3] = widths[3].min(left - widths[4]);
    if left < 8.0 * size {
        return None;
    }
    let mut lefts = [0.0; 5];
    for c in 1..5 {
        lefts[c] = lefts[c - 1] + widths[c - 1] + gap;
    }
    let blocks = texts.into_iter().zip(sides(rows)).map(|(texts, side)| {
        let mut c = 0;
        let cells = texts.map(|text| {
            c += 1;
            match c {
                1 => vec![fitted(&text, size, true, widths[0])],
                4 | 5 => wrapped(&text, size, widths[c - 1]),
                _ => vec![text],
            }
        });
        TableBlock { side, cells }
    });
    let blocks: Vec<TableBlock> = blocks.collect();
    let most = (room.y / (LEAD * size)).floor() as usize;
    let (halves, left_out) = distribute(blocks, halves, most.checked_sub(2)?);
    Some(TypesetTable { size, lefts, width: wide, halves, left_out })
}

/// For each row whether it is the pavilion's or the crown's. The girdle goes with what is cut before
/// it, or after it if it is the first.
fn sides(rows: &[DiagramRow]) -> Vec<&'static str> {
    let side = |r: &DiagramRow| match r.zone {
        Zone::Pavilion | Zone::Culet => Some("PAVILION"),
        Zone::Crown | Zone::Table => Some("CROWN"),
        Zone::Girdle => None,
    };
    let mut now = rows.iter().find_map(side).unwrap_or("GIRDLE");
    let mut sides = Vec::with_capacity(rows.len());
    for row in rows {
        now = side(row).unwrap_or(now);
        sides.push(now);
    }
    sides
}

/// Pours the blocks into halves of at most `most` lines, as even as it goes; the second figure is
/// how many blocks had no room.
fn distribute(blocks: Vec<TableBlock>, halves: usize, most: usize) -> (Vec<Vec<TableBlock>>, usize) {
    let lines: Vec<usize> = blocks.iter().map(TableBlock::lines).collect();
    let head = |at: usize, first: bool| {
        if first || at == 0 || blocks[at].side != blocks[at - 1].side { HEAD } else { 0 }
    };
    // lengths of the halves for a height, and what is left
    let split = |height: usize| {
        let (mut at, mut ends) = (0, Vec::new());
        for _ in 0..halves {
            let (mut used, start) = (0, at);
            while at < lines.len() && used + head(at, at == start) + lines[at] <= height {
                used += head(at, at == start) + lines[at];
                at += 1;
            }
            ends.push(at);
        }
        (ends, lines.len() - at)
    };
    let even = lines.iter().sum::<usize>().div_ceil(halves);
    let height = (even.min(most)..=most).find(|h| split(*h).1 == 0).unwrap_or(most);
    // a line for saying what is missing
    let (ends, left_out) = match split(height) {
        (_, left) if left > 0 => split(height.saturating_sub(1)),
        all => all,
    };
    let mut blocks = blocks.into_iter();
    let mut start = 0;
    let mut poured = Vec::new();
    for end in ends {
        poured.push(blocks.by_ref().take(end - start).collect());
        start = end;
    }
    (poured, left_out)
}

impl TypesetTable {
    /// Draws it with its upper left corner at `corner`.
    pub fn draw(&self, pen: &mut Sheet, corner: DVec2) {
        let (size, lead) = (self.size, self.size * LEAD);
        let mut lowest = corner.y;
        for (half, blocks) in self.halves.iter().filter(|b| !b.is_empty()).enumerate() {
            let left = corner.x + half as f64 * (self.width + GUTTER);
            let mut y = corner.y + lead;
            for (c, head) in HEADS.iter().enumerate() {
                if blocks.iter().any(|b| b.cells[c].iter().any(|line| !line.is_empty())) {
                    self.cell(pen, left, y, c, true, head);
                }
            }
            pen.rule(DVec2::new(left, y + 0.35 * size), self.width);
            y += 0.35 * size;
            let mut side = "";
            for block in blocks {
                if block.side != side {
                    side = block.side;
                    y += 1.5 * lead;
                    pen.text(DVec2::new(left, y), size, Anchor::Start, true, side);
                    y += 0.25 * lead;
                }
                for (c, lines) in block.cells.iter().enumerate() {
                    for (i, line) in lines.iter().enumerate() {
                        self.cell(pen, left, y + (i + 1) as f64 * lead, c, c == 0, line);
                    }
                }
                y += lead * block.lines() as f64;
            }
            lowest = lowest.max(y);
        }
        if self.left_out > 0 {
            let said = format!("… and {} more tiers, which `cutlab show` lists", self.left_out);
            pen.text(DVec2::new(corner.x, lowest + lead), size, Anchor::Start, true, &said);
        }
    }

    fn cell(&self, pen: &mut Sheet, left: f64, y: f64, column: usize, bold: bool, text: &str) {
        // angle and number stand to the right
        let right = matches!(column, 1 | 2);
        let x = if right { self.lefts[column + 1] - GAP * self.size } else { self.lefts[column] };
        let anchor = if right { Anchor::End } else { Anchor::Start };
        pen.text(DVec2::new(left + x, y), self.size, anchor, bold, text);
    }
}
