//! SVG drawings: elements with attributes. Their markup is written here alone: text escaped, coordinates
//! rounded.

use glam::DVec2;
use maud::{Escaper, Render};
use std::fmt::Write;

/// Decimals of the coordinates of a drawing that asks for no others.
const DECIMALS: usize = 1;

/// Decimals of the angle of a turned text, in degrees.
const ANGLE_DECIMALS: usize = 1;

/// Which point of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// The value of an attribute.
#[derive(Debug, Clone)]
enum Value {
    /// Coordinates or lengths in units of the drawing, rounded to the decimals of the element.
    Lengths(Vec<f64>),
    /// A number that is not rounded: the width of a line, an opacity.
    Number(f64),
    /// Words.
    Text(String),
    /// The transform that puts the origin at a place and turns clockwise by an angle in degrees.
    Turn(DVec2, f64),
}

/// An SVG element: its attributes, its text, the elements inside it.
#[derive(Debug, Clone)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, Value)>,
    text: String,
    children: Vec<Element>,
    decimals: Option<usize>,
}

impl Element {
    /// An element without attributes.
    pub fn new(name: &'static str) -> Element {
        Element { name, attributes: Vec::new(), text: String::new(), children: Vec::new(), decimals: None }
    }

    /// A drawing, the root of all other elements.
    ///
    /// - `corner`, `size`: the box that is seen, y downward, in the units of the drawing
    pub fn drawing(corner: impl Into<DVec2>, size: impl Into<DVec2>) -> Element {
        let (corner, size) = (corner.into(), size.into());
        Element::new("svg")
            .attribute("xmlns", "http://www.w3.org/2000/svg")
            .value("viewBox", Value::Lengths(vec![corner.x, corner.y, size.x, size.y]))
    }

    /// The title of a drawing, for those who do not see it.
    pub fn title(title: &str) -> Element {
        Element { text: title.into(), ..Element::new("title") }
    }

    /// A group: its attributes count for all that is inside.
    pub fn group() -> Element {
        Element::new("g")
    }

    /// A region that other elements are cut to by its name: [`Element::clip`].
    pub fn clip_region(id: &str, region: Element) -> Element {
        Element::new("clipPath").id(id).with(region)
    }

    /// A rectangle.
    pub fn rect(corner: impl Into<DVec2>, size: impl Into<DVec2>) -> Element {
        let (corner, size) = (corner.into(), size.into());
        let rect = Element::new("rect").length("x", corner.x).length("y", corner.y);
        rect.length("width", size.x).length("height", size.y)
    }

    /// A circle.
    pub fn circle(centre: impl Into<DVec2>, radius: f64) -> Element {
        let centre = centre.into();
        Element::new("circle").length("cx", centre.x).length("cy", centre.y).length("r", radius)
    }

    /// Lines and areas, filled black unless [`Element::fill`] says otherwise.
    pub fn path(data: PathData) -> Element {
        Element::new("path").attribute("d", data.text)
    }

    /// A line of text; `at` is on its base line.
    pub fn text(at: impl Into<DVec2>, text: &str) -> Element {
        let at = at.into();
        Element { text: text.into(), ..Element::new("text") }.length("x", at.x).length("y", at.y)
    }

    /// A line of text turned clockwise about `at`, which is on its base line.
    ///
    /// - `degrees`: 0 for a level line that is read to the right
    pub fn turned_text(at: impl Into<DVec2>, degrees: f64, text: &str) -> Element {
        let turn = Value::Turn(at.into(), degrees);
        Element { text: text.into(), ..Element::new("text") }.value("transform", turn)
    }

    fn value(mut self, name: &'static str, value: Value) -> Element {
        self.attributes.push((name, value));
        self
    }

    /// With an attribute of words.
    pub fn attribute(self, name: &'static str, text: impl Into<String>) -> Element {
        self.value(name, Value::Text(text.into()))
    }

    /// With an attribute that is a coordinate or a length, rounded when it is written.
    pub fn length(self, name: &'static str, length: f64) -> Element {
        self.value(name, Value::Lengths(vec![length]))
    }

    /// With an attribute that is a number as it stands.
    pub fn number(self, name: &'static str, number: f64) -> Element {
        self.value(name, Value::Number(number))
    }

    /// With coordinates of so many decimals, inside it too.
    pub fn decimals(mut self, decimals: usize) -> Element {
        self.decimals = Some(decimals);
        self
    }

    /// With a name of its own in the drawing.
    pub fn id(self, id: &str) -> Element {
        self.attribute("id", id)
    }

    /// Filled with a colour, or not with `none`.
    pub fn fill(self, colour: impl Into<String>) -> Element {
        self.attribute("fill", colour)
    }

    /// With lines of a colour and a width.
    pub fn stroke(self, colour: &str, width: f64) -> Element {
        self.attribute("stroke", colour).number("stroke-width", width)
    }

    /// With round corners of its lines.
    pub fn round_joins(self) -> Element {
        self.attribute("stroke-linejoin", "round")
    }

    /// A text with a line of a colour around its letters and behind them, so that it is read on any ground.
    pub fn halo(self, colour: &str, width: f64) -> Element {
        self.stroke(colour, width).attribute("paint-order", "stroke")
    }

    /// A text with the height of its font.
    pub fn font_size(self, size: f64) -> Element {
        self.length("font-size", size)
    }

    /// A text in bold letters.
    pub fn bold(self) -> Element {
        self.attribute("font-weight", "bold")
    }

    /// A text with that point of it at its place; without this, its start.
    pub fn anchor(self, anchor: Anchor) -> Element {
        match anchor {
            Anchor::Start => self,
            Anchor::Middle => self.attribute("text-anchor", "middle"),
            Anchor::End => self.attribute("text-anchor", "end"),
        }
    }

    /// Cut to the region of that name.
    pub fn clip(self, id: &str) -> Element {
        self.attribute("clip-path", format!("url(#{id})"))
    }

    /// With another element inside, above those that are there.
    pub fn with(mut self, child: Element) -> Element {
        self.children.push(child);
        self
    }

    /// Puts an element inside, above those that are there.
    pub fn push(&mut self, child: Element) {
        self.children.push(child);
    }

    /// The element as an SVG document.
    pub fn document(&self) -> String {
        let mut out = String::new();
        self.write(DECIMALS, &mut out);
        out.push('\n');
        out
    }

    fn write(&self, decimals: usize, out: &mut String) {
        let decimals = self.decimals.unwrap_or(decimals);
        out.push('<');
        out.push_str(self.name);
        for (name, value) in &self.attributes {
            out.push(' ');
            out.push_str(name);
            out.push_str("=\"");
            out.push_str(&escaped(&value.text(decimals)));
            out.push('"');
        }
        if self.text.is_empty() && self.children.is_empty() {
            out.push_str("/>");
            return;
        }
        out.push('>');
        out.push_str(&escaped(&self.text));
        for child in &self.children {
            out.push('\n');
            child.write(decimals, out);
        }
        if !self.children.is_empty() {
            out.push('\n');
        }
        out.push_str("</");
        out.push_str(self.name);
        out.push('>');
    }
}

/// The drawing as a part of a page.
impl Render for Element {
    fn render_to(&self, buffer: &mut String) {
        self.write(DECIMALS, buffer);
    }
}

impl Value {
    fn text(&self, decimals: usize) -> String {
        match self {
            Value::Lengths(lengths) => {
                let lengths: Vec<String> = lengths.iter().map(|x| rounded(*x, decimals)).collect();
                lengths.join(" ")
            }
            Value::Number(number) => number.to_string(),
            Value::Text(text) => text.clone(),
            Value::Turn(at, degrees) => format!(
                "translate({} {}) rotate({})",
                rounded(at.x, decimals),
                rounded(at.y, decimals),
                rounded(*degrees, ANGLE_DECIMALS)
            ),
        }
    }
}

/// Text as it stands in SVG and HTML, also within quotes. XML has no control characters: they are blanks.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    // writing into a string does not fail
    let _ = Escaper::new(&mut out).write_str(&text.replace(char::is_control, " "));
    out
}

/// A number rounded to so many decimals, without zeros at its end.
fn rounded(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// Path data: where the lines of a path run, y downward.
#[derive(Debug, Clone, Default)]
pub struct PathData {
    text: String,
    decimals: usize,
}

impl PathData {
    /// A path without lines.
    ///
    /// - `decimals`: of its coordinates
    pub fn new(decimals: usize) -> PathData {
        PathData { text: String::new(), decimals }
    }

    /// Whether there are no lines.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    fn command(&mut self, letter: char, numbers: &[f64]) {
        self.text.push(letter);
        for (i, number) in numbers.iter().enumerate() {
            self.text.push_str(if i == 0 { "" } else { " " });
            self.text.push_str(&rounded(*number, self.decimals));
        }
    }

    /// Lines through points.
    pub fn line<P: Into<DVec2>>(mut self, points: impl IntoIterator<Item = P>) -> PathData {
        for (i, point) in points.into_iter().enumerate() {
            let point = point.into();
            self.command(if i == 0 { 'M' } else { 'L' }, &[point.x, point.y]);
        }
        self
    }

    /// Lines through points and back to the first.
    pub fn polygon<P: Into<DVec2>>(self, corners: impl IntoIterator<Item = P>) -> PathData {
        let before = self.text.len();
        let mut path = self.line(corners);
        if path.text.len() > before {
            path.text.push('Z');
        }
        path
    }

    /// A level line, to the right if `length` is positive.
    pub fn across(mut self, from: impl Into<DVec2>, length: f64) -> PathData {
        let from = from.into();
        self.command('M', &[from.x, from.y]);
        self.command('h', &[length]);
        self
    }

    /// An upright line, downward if `length` is positive.
    pub fn down(mut self, from: impl Into<DVec2>, length: f64) -> PathData {
        let from = from.into();
        self.command('M', &[from.x, from.y]);
        self.command('v', &[length]);
        self
    }

    /// A circle.
    pub fn circle(mut self, centre: impl Into<DVec2>, radius: f64) -> PathData {
        let centre = centre.into();
        self.command('M', &[centre.x - radius, centre.y]);
        self.command('a', &[radius, radius, 0.0, 1.0, 0.0, 2.0 * radius, 0.0]);
        self.command('a', &[radius, radius, 0.0, 1.0, 0.0, -2.0 * radius, 0.0]);
        self.text.push('Z');
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped_wherever_they_stand() {
        let text = Element::text((1.0, 2.0), "<b> & \"c\"\u{1}").id("a\"><b>");
        let svg = Element::drawing((0.0, 0.0), (9.0, 9.0)).with(text.clone()).document();
        let read = roxmltree::Document::parse(&svg).expect("XML");
        let node = read.descendants().find(|n| n.has_tag_name("text")).expect("a text");
        assert_eq!((node.text(), node.attribute("id")), (Some("<b> & \"c\" "), Some("a\"><b>")));
        assert_eq!(text.render().into_string().lines().count(), 1);
    }

    #[test]
    fn coordinates_are_rounded_and_widths_of_lines_are_not() {
        let inner = Element::circle((-0.004, 1.255), 2.0).stroke("#000", 0.125);
        let fine = Element::group().decimals(2).with(inner.clone());
        let svg = Element::drawing((0.0, 0.0), (10.0, 20.5)).with(inner).with(fine).document();
        assert!(svg.contains("viewBox=\"0 0 10 20.5\""), "{svg}");
        let circles: Vec<&str> = svg.lines().filter(|l| l.starts_with("<circle")).collect();
        let rest = "r=\"2\" stroke=\"#000\" stroke-width=\"0.125\"/>";
        assert_eq!(circles[0], format!("<circle cx=\"0\" cy=\"1.3\" {rest}"));
        assert_eq!(circles[1], format!("<circle cx=\"0\" cy=\"1.25\" {rest}"));
    }

    #[test]
    fn paths_run_where_they_are_told() {
        let path =
            PathData::new(1).polygon([(0.0, 0.0), (100.0, 0.04), (0.0, 9.96)]).across((1.0, 2.0), -5.0);
        assert_eq!(path.text, "M0 0L100 0L0 10ZM1 2h-5");
        let circle = PathData::new(2).circle((5.0, 5.0), 2.0).down((5.0, 0.0), 1.255);
        assert_eq!(circle.text, "M3 5a2 2 0 1 0 4 0a2 2 0 1 0 -4 0ZM5 0v1.25");
        assert!(PathData::new(1).is_empty() && !circle.is_empty());
    }
}
