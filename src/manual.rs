//! The manual, one topic a module: how stones are named, scenes and designs written, scores defined.
//!
//! Each topic is a Markdown file in `src/manual/`. `cutlab help TOPIC` prints it, the module of its name
//! shows it in this documentation, and the tests run its examples: those in Rust as tests of the
//! documentation, the commands of the shell in `tests/program/manual.rs`.

/// A topic of the manual.
#[derive(Debug)]
pub struct Topic {
    /// Its name in `cutlab help NAME`.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Its text, in Markdown.
    pub text: &'static str,
}

/// Every key of a scene file, by example.
pub static SCENE_GRAMMAR: &str = include_str!("manual/scene-grammar.toml");

/// The catalogue of topics, and a module for each: `NAME: "one line about it", TEXT;`
macro_rules! topics {
    ($($name:ident: $about:literal, $text:expr;)*) => {
        $(
            #[doc = $text]
            pub mod $name {}
        )*

        /// Every topic, in the order of reading.
        pub static TOPICS: &[Topic] =
            &[$(Topic { name: stringify!($name), about: $about, text: $text }),*];
    };
}

topics! {
    stones: "how a stone is named: cuts, parameters, files, folders, sizes", include_str!("manual/stones.md");
    designs: "design files: a cut of your own, tier by tier", include_str!("manual/designs.md");
    editing: "changing a design: angles, meets, sizes; what to change first", include_str!("manual/editing.md");
    optimising: "optimise: variables, objectives, bounds, noise", include_str!("manual/optimising.md");
    materials: "refractive index, dispersion, colour, density", include_str!("manual/materials.md");
    scenes: "scene files: camera, stones, surfaces, lights",
        concat!(include_str!("manual/scenes.md"), "\n```toml\n", include_str!("manual/scene-grammar.toml"), "```\n");
    pictures: "render: pictures, animations, tone curve, progressive rendering", include_str!("manual/pictures.md");
    scores: "what the scores mean, their errors, comparisons", include_str!("manual/scores.md");
    sweeps: "tables of scores, grids of parameters, shards, merging, plots", include_str!("manual/sweeps.md");
    reports: "measures, cutting diagrams, pages, validation", include_str!("manual/reports.md");
    formats: "file formats of designs and meshes, and what is read of them", include_str!("manual/formats.md");
    outputs: "what is written where, what is overwritten, exit codes", include_str!("manual/outputs.md");
    limits: "how much a file may hold, and how to raise it", include_str!("manual/limits.md");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_lines_fit_a_list() {
        for topic in TOPICS {
            assert!(topic.about.len() <= 75 && !topic.about.ends_with('.'), "{}", topic.about);
            assert!(topic.text.starts_with("# "), "{} has no heading", topic.name);
        }
    }
}
