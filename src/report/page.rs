//! The page about one stone: one HTML file that needs nothing beside it.

mod scores;

pub use super::html::escaped;
pub(super) use super::html::{data_uri, svg_uri};
pub use scores::{PageScore, Section};

use super::references::STONES;
use super::tilt_curves::TiltPlot;
use super::viewer_images::ViewerPicture;
use crate::design::proportions::Proportions;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");

/// Everything the page shows.
#[derive(Debug)]
pub struct Page<'a> {
    /// Name of the stone.
    pub name: &'a str,
    /// How its facets are made up.
    pub made_up_of: &'a str,
    /// Where its proportions are from; may be empty.
    pub source: &'a str,
    /// Material and index, in words.
    pub material: String,
    /// Width and weight, in words.
    pub weight: String,
    /// What must be known about the weight.
    pub weight_note: Option<String>,
    /// Its proportions.
    pub proportions: &'a Proportions,
    /// The picture on the table as PNG, and a line under it.
    pub picture: Option<(&'a [u8], String)>,
    /// The pictures through scopes.
    pub scopes: &'a [ViewerPicture],
    /// The cutting diagram as SVG.
    pub diagram: &'a str,
    /// The scores.
    pub sections: &'a [Section],
    /// Scores against the tilt.
    pub tilts: &'a [TiltPlot],
    /// The stone on the contour map as SVG, and a line under it; for round brilliants.
    pub map: Option<(String, String)>,
    /// What the reference stones are of.
    pub references: &'a str,
    /// How the scores were traced, in words.
    pub traced: String,
    /// The command that made the page.
    pub command: String,
    /// Files beside the page.
    pub files: &'a [String],
}

/// The beginning of a page, up to its content.
pub(super) fn head(title: &str, style: &str, sub: &str) -> String {
    let title = escaped(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title} · cutlab</title>\n<style>\n{STYLE}{style}</style>\n</head>\n<body>\n<main>\n\
         <header>\n<h1>{title}</h1>\n<p class=\"sub\">{}</p>\n</header>\n",
        escaped(sub)
    )
}

/// A picture through a scope, with its legend and shares.
pub(super) fn scope_figure(picture: &ViewerPicture) -> String {
    let scope = picture.scope;
    let mut out = format!(
        "<figure><img src=\"{}\" alt=\"{name}, seen from above\"><figcaption><b>{name}</b>: {}\
         <ul class=\"legend\">",
        data_uri(&picture.png),
        escaped(scope.about),
        name = escaped(scope.name),
    );
    for (key, share) in scope.legend.iter().zip(&picture.shares) {
        let [r, g, b] = key.colour;
        let _ = write!(
            out,
            "<li><i style=\"background:rgb({r},{g},{b})\"></i><span data-name=\"{}\">{}</span><b>{:.1} %</b></li>",
            key.name,
            escaped(key.about),
            100.0 * share
        );
    }
    out + "</ul></figcaption></figure>\n"
}

/// The plots of scores against the tilt.
pub(super) fn tilt_section(plots: &[TiltPlot]) -> String {
    let mut out = String::from(
        "<section>\n<h2>Tilted</h2>\n<p class=\"note\">Scores of the stone as it is tilted about the x axis before a viewer \
         who stays with the light; the band holds the value 95 times in 100.</p>\n<div class=\"plots\">\n",
    );
    for plot in plots {
        let _ = writeln!(
            out,
            "<figure><img src=\"{}\" alt=\"{} against tilt (°)\"><figcaption>{}</figcaption></figure>",
            svg_uri(&plot.svg),
            plot.metric.name,
            escaped(plot.metric.about)
        );
    }
    out + "</div>\n</section>\n"
}

impl Page<'_> {
    /// The whole page.
    pub fn html(&self) -> String {
        let sub = format!("{} facets · {} · {}", self.proportions.facets, self.weight, self.material);
        let mut out = head(self.name, "", &sub);
        self.tiles(&mut out);
        self.pictures(&mut out);
        self.proportions(&mut out);
        self.scores(&mut out);
        out += &tilt_section(self.tilts);
        self.map(&mut out);
        self.footer(&mut out);
        out + "</main>\n</body>\n</html>\n"
    }

    fn tiles(&self, out: &mut String) {
        *out += "<section class=\"tiles\">\n";
        for section in self.sections.iter().filter(|s| s.large > 0) {
            let _ = write!(out, "<div class=\"tile\"><h2>{}</h2><dl>", section.head);
            for score in section.scores.iter().take(section.large) {
                let _ = write!(
                    out,
                    "<div><dt>{}</dt><dd>{}</dd></div>",
                    escaped(&score.name),
                    score.value_html()
                );
            }
            *out += "</dl></div>\n";
        }
        *out += "</section>\n";
    }

    fn pictures(&self, out: &mut String) {
        if let Some((png, caption)) = &self.picture {
            let _ = writeln!(
                out,
                "<section>\n<figure class=\"wide-picture\"><img src=\"{}\" alt=\"the stone on a grey table\">\
                 <figcaption>{}</figcaption></figure>\n</section>",
                data_uri(png),
                escaped(caption)
            );
        }
        *out += "<section>\n<h2>Seen straight from above</h2>\n<div class=\"scopes\">\n";
        self.scopes.iter().for_each(|p| *out += &scope_figure(p));
        *out += "</div>\n</section>\n";
    }

    fn proportions(&self, out: &mut String) {
        *out += "<section>\n<h2>Proportions</h2>\n<table class=\"facts\"><tbody>\n";
        for (label, value) in self.facts() {
            let _ = writeln!(out, "<tr><th scope=\"row\">{label}</th><td>{}</td></tr>", escaped(&value));
        }
        *out += "</tbody></table>\n";
        if let Some(note) = &self.weight_note {
            let _ = writeln!(out, "<p class=\"note\">Weight: {}</p>", escaped(note));
        }
        if !self.source.is_empty() {
            let _ = writeln!(out, "<p class=\"note\">Source: {}</p>", escaped(self.source));
        }
        let _ = writeln!(
            out,
            "</section>\n<section>\n<h2>Cutting diagram</h2>\n<figure class=\"sheet\"><a href=\"diagram.svg\">\
             <img src=\"{}\" alt=\"cutting diagram: crown, pavilion and sides, the tiers\"></a></figure>\n</section>",
            svg_uri(self.diagram)
        );
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        let p = self.proportions;
        let percent = |x: f64| format!("{x:.2} %");
        let angle = |a: Option<f64>| a.map_or("no facets".into(), |a| format!("{a:.2}°"));
        vec![
            ("facets", self.made_up_of.to_string()),
            ("table", p.table_percent.map_or("none".into(), percent)),
            ("crown", format!("{}, height {}", angle(p.crown_angle_deg), percent(p.crown_height_percent))),
            (
                "pavilion",
                format!("{}, depth {}", angle(p.pavilion_angle_deg), percent(p.pavilion_depth_percent)),
            ),
            ("girdle", format!("{} at its thick places", percent(p.girdle_percent))),
            ("culet", if p.culet_percent > 0.0 { percent(p.culet_percent) } else { "pointed".into() }),
            ("depth", percent(p.depth_percent)),
            ("length to width", format!("{:.3}", p.length / p.width)),
        ]
    }

    fn scores(&self, out: &mut String) {
        for section in self.sections {
            let _ = write!(
                out,
                "<section class=\"head\">\n<h2>{}</h2>\n<p class=\"note\">{}</p>\n<table class=\"scores\">\n\
                 <thead><tr><th></th><th>this stone</th>",
                section.head,
                escaped(section.about)
            );
            for (name, proportions, _) in STONES {
                let _ = write!(out, "<th>{name} <span class=\"se\">{proportions}</span></th>");
            }
            *out += "</tr></thead>\n<tbody>\n";
            section.scores.iter().for_each(|score| *out += &score.row());
            *out += "</tbody></table>\n";
            if let Some(said) = section.omissions() {
                let _ = writeln!(out, "<p class=\"note\">{}.</p>", escaped(&said));
            }
            *out += "</section>\n";
        }
        let _ = writeln!(
            out,
            "<section><p class=\"note\">{} After ± stands one standard error. The five reference stones are round brilliants \
             (table/crown/pavilion) in {}.</p></section>",
            escaped(&self.traced),
            escaped(self.references)
        );
    }

    fn map(&self, out: &mut String) {
        if let Some((svg, caption)) = &self.map {
            let _ = writeln!(
                out,
                "<section>\n<h2>Among round brilliants</h2>\n<figure class=\"map\"><img src=\"{}\" \
                 alt=\"map of wlr over crown and pavilion angle\"><figcaption>{}</figcaption></figure>\n</section>",
                svg_uri(svg),
                escaped(caption)
            );
        }
    }

    fn footer(&self, out: &mut String) {
        let links: Vec<String> =
            self.files.iter().map(|f| format!("<a href=\"{0}\">{0}</a>", escaped(f))).collect();
        let _ = write!(
            out,
            "<footer>\n<p>Beside this page: {}</p>\n<p>Made by cutlab {} with <code>{}</code></p>\n</footer>\n",
            links.join(", "),
            env!("CARGO_PKG_VERSION"),
            escaped(&self.command)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_the_page() {
        assert_eq!(escaped("<b>&\"x\"\u{1}"), "&lt;b&gt;&amp;&quot;x&quot; ");
    }
}
