//! Markdown as text for a terminal: headings to the left, text indented and filled, code and tables kept.

mod page;
mod reader;

use page::Page;
use pulldown_cmark::{Options, Parser};
use reader::Reader;

/// The text of a Markdown document, in lines of up to `width` characters but for code.
///
/// Inline code keeps its backticks; links show their address if it is one of the web. Of Rust code the lines that
/// the documentation hides (`# …`) are left out.
pub fn for_terminal(markdown: &str, width: usize) -> String {
    let mut reader = Reader::new(Page::new(width));
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES) {
        reader.take(event);
    }
    reader.page.text
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
