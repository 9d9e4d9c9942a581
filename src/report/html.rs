//! HTML: what every page has in common, and pictures inside pages as data URIs.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("page.css");

/// A whole page, which needs nothing beside it.
#[derive(Debug)]
pub(super) struct HtmlPage<'a> {
    /// Its title.
    pub title: &'a str,
    /// A line below the title.
    pub subtitle: &'a str,
    /// Its own style, behind the style of all pages.
    pub style: &'a str,
    /// What it shows.
    pub content: Markup,
    /// Paragraphs of the footer, above the one with the command.
    pub footer: Markup,
    /// The command that made it.
    pub command: &'a str,
}

impl HtmlPage<'_> {
    /// The text of the page. HTML has no control characters: they are blanks.
    pub fn html(&self) -> String {
        let page = html! {
            (DOCTYPE) "\n"
            html lang="en" {
                "\n"
                head {
                    meta charset="utf-8"; "\n"
                    meta name="viewport" content="width=device-width, initial-scale=1"; "\n"
                    title { (self.title) " · cutlab" } "\n"
                    style { "\n" (PreEscaped(STYLE)) (PreEscaped(self.style)) }
                }
                "\n"
                body {
                    main {
                        header { h1 { (self.title) } p class="sub" { (self.subtitle) } } "\n"
                        (self.content)
                        footer {
                            (self.footer)
                            p { "Made by cutlab " (env!("CARGO_PKG_VERSION")) " with " code { (self.command) } }
                        }
                    }
                    "\n"
                }
            }
            "\n"
        };
        page.into_string().replace(|c: char| c.is_control() && c != '\n', " ")
    }
}

/// A PNG picture inside the page.
pub(super) fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// A drawing inside the page; as a picture of its own, so that no name in it meets another's.
pub(super) fn svg_uri(svg: &str) -> String {
    format!("data:image/svg+xml;base64,{}", STANDARD.encode(svg))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_the_page() {
        let name = "<b>&\"x\"\u{1}\n";
        let content = html! { img alt=(name); };
        let page =
            HtmlPage { title: name, subtitle: name, style: "", content, footer: html! {}, command: name };
        let page = page.html();
        assert!(!page.contains("<b>") && !page.contains('\u{1}'), "{page}");
        assert_eq!(page.matches("&lt;b&gt;&amp;&quot;x&quot; \n").count(), 5, "{page}");
    }
}
