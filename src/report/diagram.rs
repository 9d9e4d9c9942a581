//! The cutting diagram that faceters print: two plans with the index wheel, two side views, the
//! table of tiers, ratios; one page, A4 or Letter, black on white.

mod facts;
mod labels;
pub mod projection;
mod rows;
mod sheet;
mod table;
mod views;
mod wheel;

pub use projection::DiagramView;
pub use sheet::Paper;

use crate::design::{Design, proportions};
use crate::geometry::SolidError;
use crate::report::svg_canvas::Anchor;
use glam::DVec2;
use sheet::Sheet;
use table::TypesetTable;
use views::StoneViews;

/// Edge of the page that stays white, in mm: what any printer reaches.
const MARGIN: f64 = 12.0;

/// Size of captions, and the height of their line, in mm.
const CAPTION: f64 = 2.4;
const CAPTION_LINE: f64 = 4.0;

/// Space between the parts of the page, in mm.
const SPACE: f64 = 3.0;

/// How large the drawings may be, the first choice first: width of a plan with its wheel, most
/// height of the side views, and the least print of the table at which it is still the choice.
const CHOICES: [(f64, f64, f64); 5] =
    [(92.0, 66.0, 2.5), (92.0, 48.0, 2.3), (84.0, 40.0, 2.2), (76.0, 32.0, 2.0), (68.0, 26.0, 1.8)];

/// The diagram of a design as an SVG document of one page.
///
/// - `index`: the index of refraction that the angles are for, if it is known
///
/// Facets carry the names of their tiers where those are short, else P1, G1, C1, T … in cutting
/// order; the table tells which is which. The pavilion is seen from below with the stone turned over
/// left to right: index 0 stays at the foot and the wheel runs clockwise. The same design gives the
/// same bytes. Errors are those of [`Design::solid`]. Checked in `tests/program/diagram.rs`.
pub fn draw(design: &Design, index: Option<f64>) -> Result<String, SolidError> {
    draw_on(design, index, Paper::A4)
}

/// As [`draw`], on that paper.
pub fn draw_on(design: &Design, index: Option<f64>, paper: Paper) -> Result<String, SolidError> {
    let page = paper.size_mm();
    let solid = design.solid()?;
    let measures = proportions::measure(&solid);
    let rows = rows::rows(design, &solid);
    let stone = StoneViews::new(&solid, &rows, design.gear);
    let wide = page.x - 2.0 * MARGIN;
    let above = facts::above(design, &measures, index, wide);
    let below = facts::below(design, &rows, wide);
    let top = MARGIN + above.height() + SPACE;
    let foot = page.y - MARGIN - below.height();

    let plans = |side: f64| side + CAPTION_LINE + SPACE;
    let set = |side: f64, most: f64, least: f64| {
        let (scale, height) = side_view(&stone, side, most);
        let start = top + plans(side) + height + CAPTION_LINE + SPACE;
        let room = DVec2::new(wide, foot - SPACE - start);
        let table = match least {
            0.0 => table::cut_short(&rows, design.gear, room),
            _ => table::fit(&rows, design.gear, room, least),
        };
        table.map(|table| PageLayout { side, scale, height, start, table })
    };
    let last = CHOICES[CHOICES.len() - 1];
    let layout = CHOICES.iter().find_map(|&(side, most, least)| set(side, most, least));
    let layout = layout.or_else(|| set(last.0, last.1, 0.0));

    let mut pen = Sheet::new(&design.name, paper);
    above.draw(&mut pen, DVec2::new(MARGIN, MARGIN));
    pen.rule(DVec2::new(MARGIN, top - 0.5 * SPACE), wide);
    if let Some(layout) = layout {
        layout.draw(&mut pen, &stone, top, page);
    }
    pen.rule(DVec2::new(MARGIN, foot - 0.3 * SPACE), wide);
    below.draw(&mut pen, DVec2::new(MARGIN, foot));
    Ok(pen.finish())
}

/// Where everything stands.
struct PageLayout {
    /// Width of a plan with its wheel.
    side: f64,
    /// Scale and height of the side views.
    scale: f64,
    height: f64,
    /// Top of the table.
    start: f64,
    table: TypesetTable,
}

/// Scale and height of the side views: the plans' scale, or less for a tall stone.
fn side_view(stone: &StoneViews, side: f64, most: f64) -> (f64, f64) {
    let tall = stone.extent(DiagramView::Side).y;
    let scale = stone.scale(side).min(most / tall);
    (scale, scale * tall)
}

impl PageLayout {
    fn draw(&self, pen: &mut Sheet, stone: &StoneViews, top: f64, page: DVec2) {
        let middles = [0.27 * page.x, 0.73 * page.x];
        let zero = wheel::index_name(stone.gear.offset, stone.gear);
        let quarter = wheel::index_name(stone.gear.offset + 0.25 * stone.gear.teeth, stone.gear);
        let runs = if stone.gear.teeth > 0.0 {
            ("counter-clockwise", "clockwise")
        } else {
            ("clockwise", "counter-clockwise")
        };
        let plan = top + 0.5 * self.side;
        let caption = top + self.side + CAPTION_LINE - 1.0;
        for (middle, view, said) in [
            (middles[0], DiagramView::Crown, format!("Crown, from above; indices {}", runs.0)),
            (
                middles[1],
                DiagramView::Pavilion,
                format!("Pavilion, from below, turned over left to right; indices {}", runs.1),
            ),
        ] {
            let nowhere = stone.plan(pen, view, DVec2::new(middle, plan), self.side);
            let small = if nowhere.is_empty() {
                String::new()
            } else {
                format!("; too small: {}", nowhere.join(", "))
            };
            let said = sheet::fitted(&format!("{said}{small}"), CAPTION, false, 0.5 * page.x - MARGIN);
            pen.text(DVec2::new(middle, caption), CAPTION, Anchor::Middle, false, &said);
        }
        let sides = caption + 1.0 + SPACE;
        let smaller = self.scale / stone.scale(self.side);
        let how = if smaller < 0.995 { format!(" (× {smaller:.2})") } else { String::new() };
        for (middle, view, index) in
            [(middles[0], DiagramView::Side, zero), (middles[1], DiagramView::End, quarter)]
        {
            stone.side(pen, view, DVec2::new(middle, sides + 0.5 * self.height), self.scale);
            let name = if view == DiagramView::Side { "Side" } else { "End" };
            let said = format!("{name}, from index {index}{how}");
            let at = DVec2::new(middle, sides + self.height + CAPTION_LINE - 0.6);
            pen.text(at, CAPTION, Anchor::Middle, false, &said);
        }
        self.table.draw(pen, DVec2::new(MARGIN, self.start));
    }
}
