//! The page about one stone: one HTML file that needs nothing beside it.

mod scores;
mod tiers;

pub use scores::{PageScore, Section};

use super::html::{HtmlPage, data_uri, svg_uri};
use super::references::STONES;
use super::tilt_curves::TiltPlot;
use super::viewer_images::ViewerPicture;
use crate::design::proportions::Proportions;
use crate::scoring::Attribution;
use maud::{Markup, html};

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
    /// What the tiers do to scores, or why that is left out.
    pub attribution: &'a Result<Attribution, String>,
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

/// A picture through a scope, with its legend and shares.
pub(super) fn scope_figure(picture: &ViewerPicture) -> Markup {
    let scope = picture.scope;
    let keys = scope.legend.iter().zip(&picture.shares);
    html! {
        figure {
            img src=(data_uri(&picture.png)) alt={ (scope.name) ", seen from above" };
            figcaption {
                b { (scope.name) } ": " (scope.about)
                ul class="legend" {
                    @for (key, share) in keys {
                        @let [r, g, b] = key.colour;
                        li {
                            i style={ "background:rgb(" (r) "," (g) "," (b) ")" } {}
                            span data-name=(key.name) { (key.about) }
                            b { (format!("{:.1} %", 100.0 * share)) }
                        }
                    }
                }
            }
        }
        "\n"
    }
}

/// The plots of scores against the tilt.
pub(super) fn tilt_section(plots: &[TiltPlot]) -> Markup {
    html! {
        section {
            h2 { "Tilted" }
            p class="note" {
                "Scores of the stone as it is tilted about the x axis before a viewer who stays with the light; \
                 the band holds the value 95 times in 100."
            }
            div class="plots" {
                @for plot in plots {
                    figure {
                        img src=(svg_uri(&plot.svg)) alt={ (plot.metric.name) " against tilt (°)" };
                        figcaption { (plot.metric.about) }
                    }
                    "\n"
                }
            }
        }
        "\n"
    }
}

impl Page<'_> {
    /// The whole page.
    pub fn html(&self) -> String {
        let content = html! {
            (self.tiles())
            (self.pictures())
            (self.proportions())
            (self.scores())
            (tiers::tier_section(self.attribution))
            (tilt_section(self.tilts))
            (self.map())
        };
        let footer = html! {
            p {
                "Beside this page: "
                @for (i, file) in self.files.iter().enumerate() {
                    @if i > 0 { ", " }
                    a href=(file) { (file) }
                }
            }
            "\n"
        };
        let subtitle = format!("{} facets · {} · {}", self.proportions.facets, self.weight, self.material);
        let command = &self.command;
        HtmlPage { title: self.name, subtitle: &subtitle, style: "", content, footer, command }.html()
    }

    fn tiles(&self) -> Markup {
        html! {
            section class="tiles" {
                @for section in self.sections.iter().filter(|s| s.large > 0) {
                    div class="tile" {
                        h2 { (section.head) }
                        dl {
                            @for score in section.scores.iter().take(section.large) {
                                div { dt { (score.name) } dd { (score.value_html()) } }
                            }
                        }
                    }
                    "\n"
                }
            }
            "\n"
        }
    }

    fn pictures(&self) -> Markup {
        html! {
            @if let Some((png, caption)) = &self.picture {
                section {
                    figure class="wide-picture" {
                        img src=(data_uri(png)) alt="the stone on a grey table";
                        figcaption { (caption) }
                    }
                }
                "\n"
            }
            section {
                h2 { "Seen straight from above" }
                div class="scopes" { @for picture in self.scopes { (scope_figure(picture)) } }
            }
            "\n"
        }
    }

    fn proportions(&self) -> Markup {
        html! {
            section {
                h2 { "Proportions" }
                table class="facts" {
                    tbody {
                        @for (label, value) in self.facts() {
                            tr { th scope="row" { (label) } td { (value) } } "\n"
                        }
                    }
                }
                @if let Some(note) = &self.weight_note { p class="note" { "Weight: " (note) } }
                @if !self.source.is_empty() { p class="note" { "Source: " (self.source) } }
            }
            "\n"
            section {
                h2 { "Cutting diagram" }
                figure class="sheet" {
                    a href="diagram.svg" {
                        img src=(svg_uri(self.diagram))
                            alt="cutting diagram: crown, pavilion and sides, the tiers";
                    }
                }
            }
            "\n"
        }
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

    fn scores(&self) -> Markup {
        html! {
            @for section in self.sections {
                section class="head" {
                    h2 { (section.head) }
                    p class="note" { (section.about) }
                    table class="scores" {
                        thead {
                            tr {
                                th {} th { "this stone" }
                                @for (name, proportions, _) in STONES {
                                    th { (name) " " span class="se" { (proportions) } }
                                }
                            }
                        }
                        "\n"
                        tbody { @for score in &section.scores { (score.row()) } }
                    }
                    @if let Some(said) = section.omissions() { p class="note" { (said) "." } }
                }
                "\n"
            }
            section {
                p class="note" {
                    (self.traced) " After ± stands one standard error. The five reference stones are round \
                     brilliants (table/crown/pavilion) in " (self.references) "."
                }
            }
            "\n"
        }
    }

    fn map(&self) -> Markup {
        html! {
            @if let Some((svg, caption)) = &self.map {
                section {
                    h2 { "Among round brilliants" }
                    figure class="map" {
                        img src=(svg_uri(svg)) alt="map of wlr over crown and pavilion angle";
                        figcaption { (caption) }
                    }
                }
                "\n"
            }
        }
    }
}
