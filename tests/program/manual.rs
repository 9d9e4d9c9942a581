//! The manual and the README: their commands run, their TOML is understood, their options exist; and what
//! prints the manual, man pages and completions.

use crate::bench::{Bench, text};
use clap::error::ErrorKind;
use cutlab::advanced::color::Illuminant;
use cutlab::advanced::design::design_file::DesignFile;
use cutlab::advanced::materials::Material;
use cutlab::advanced::scene::SceneFile;
use cutlab::manual::{SCENE_GRAMMAR, TOPICS};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Every document with examples: its name and its Markdown.
fn documents() -> Vec<(&'static str, &'static str)> {
    let topics = TOPICS.iter().map(|topic| (topic.name, topic.text));
    topics.chain([("README", include_str!("../../README.md"))]).collect()
}

/// The fenced blocks of a language.
fn blocks(markdown: &str, language: &str) -> Vec<String> {
    let begin = format!("```{language}\n");
    let after = markdown.split(&begin).skip(1);
    after.map(|rest| rest.split("```").next().expect("a block ends").to_owned()).collect()
}

/// The code in the text, outside of blocks.
fn inline_code(markdown: &str) -> Vec<String> {
    let prose: String = markdown.split("```").step_by(2).collect();
    prose.split('`').skip(1).step_by(2).map(|code| code.replace('\n', " ")).collect()
}

/// A folder with the files that the examples name.
fn folder() -> Bench {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("designs")).expect("makes a folder");
    bench.good(&["generate", "classic", "-q", "-o", "my.asc", "-o", "designs/one.asc", "-o", "ring.stl"]);
    bench.good(&["generate", "emerald", "-q", "-o", "designs/two.gem"]);
    bench.good(&["generate", "oval", "-q", "-o", "designs/three.asc"]);
    let sky =
        image::ImageBuffer::<image::Rgb<f32>, Vec<f32>>::from_fn(8, 4, |x, _| image::Rgb([x as f32; 3]));
    sky.save(bench.path("garden.hdr")).expect("writes a panorama");
    bench
}

/// Pages, which take half a minute each and have tests of their own.
const LONG: [&str; 2] = ["cutlab report", "-o side-by-side"];

/// The commands of a block, a line each.
fn commands(block: &str) -> Vec<String> {
    let joined = block.replace("\\\n", " ");
    joined.lines().filter(|line| line.contains("cutlab ")).map(str::to_owned).collect()
}

/// The command with less work to do, unless it says itself how much.
fn tamed(line: &str) -> String {
    let mut line = line.to_owned();
    for command in ["score", "compare", "sweep", "retarget", "attribute"] {
        if !line.contains("--error") {
            line = line.replacen(&format!("cutlab {command}"), &format!("cutlab {command} --error 0.05"), 1);
        }
    }
    line.replacen("cutlab render", "cutlab render --width 16 --height 16 --spp 1 --photons 100", 1)
}

#[cfg(unix)]
#[test]
fn every_command_of_the_examples_runs() {
    let program = Path::new(env!("CARGO_BIN_EXE_cutlab")).parent().expect("it lies in a folder");
    let path = format!("{}:{}", program.display(), std::env::var("PATH").expect("a PATH"));
    let mut ran = 0;
    for (document, markdown) in documents() {
        let bench = folder();
        for line in blocks(markdown, "sh").iter().flat_map(|block| commands(block)) {
            if LONG.iter().any(|long| line.contains(long)) {
                let words: Vec<&str> = line.split_whitespace().collect();
                let read = cutlab::advanced::cli::command().try_get_matches_from(words);
                assert!(read.is_ok(), "{document}: {line}: {:?}", read.err());
                continue;
            }
            let shell = std::process::Command::new("sh")
                .args(["-c", &tamed(&line)])
                .current_dir(bench.path(""))
                .env("PATH", &path)
                .output()
                .expect("the shell starts");
            assert!(shell.status.success(), "{document}: {line}: {}", String::from_utf8_lossy(&shell.stderr));
            ran += 1;
        }
    }
    assert!(ran > 50, "{ran}");
}

#[test]
fn commands_and_options_in_the_text_exist() {
    let mut command = cutlab::advanced::cli::command();
    command.build();
    let all = command.get_subcommands().chain([&command]).flat_map(clap::Command::get_arguments);
    let known: BTreeSet<String> = all.filter_map(|arg| arg.get_long().map(|l| format!("--{l}"))).collect();
    let mut seen = 0;
    for (document, markdown) in documents() {
        for code in inline_code(markdown) {
            let options = if code.starts_with("cargo ") { "" } else { &code };
            for option in options.split([' ', '=']).filter(|word| word.len() > 2 && word.starts_with("--")) {
                assert!(known.contains(option), "{document}: {option} in `{code}`");
                seen += 1;
            }
            let is_placeholder = |word: &str| word.chars().any(|c| c.is_uppercase() || c == '…');
            if !code.starts_with("cutlab ") || code.split(' ').any(is_placeholder) {
                continue;
            }
            if let Err(error) = cutlab::advanced::cli::command().try_get_matches_from(code.split_whitespace())
            {
                let kinds = [ErrorKind::DisplayHelp, ErrorKind::MissingRequiredArgument];
                assert!(kinds.contains(&error.kind()), "{document}: `{code}`: {error}");
            }
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

#[test]
fn toml_in_the_manual_is_understood() {
    let topic = |name: &str| TOPICS.iter().find(|topic| topic.name == name).expect("a topic").text;
    let designs = blocks(topic("designs"), "toml");
    assert!(designs.len() >= 2);
    for text in designs {
        let design = DesignFile::parse(&text).and_then(|file| file.design(&BTreeMap::new()));
        let solid = design.unwrap_or_else(|e| panic!("{e}: {text}")).solid();
        assert!(solid.is_ok(), "{text}: {:?}", solid.err());
    }
    let no_table = |_: &str| Err("it names no table".into());
    let materials = blocks(topic("materials"), "toml");
    assert!(materials.len() >= 2);
    for text in materials {
        let material = Material::parse("manual", &text, &no_table).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert!(!material.is_clear() && material.is_dispersive(), "{text}");
    }
    let scenes = blocks(topic("scenes"), "toml");
    assert!(scenes.iter().any(|block| block == SCENE_GRAMMAR));
    for text in scenes.iter().filter(|block| *block != SCENE_GRAMMAR) {
        let lamp = Illuminant::parse("manual", text, &no_table).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert!(lamp.power(450.0) > lamp.power(500.0), "{text}");
        // what stands in comments is understood too
        for other in text.lines().filter_map(|line| line.strip_prefix("# ")) {
            let other = format!("name = \"other\"\n[power]\n{other}");
            assert!(Illuminant::parse("manual", &other, &no_table).is_ok(), "{other}");
        }
    }
    let grammar = SceneFile::parse("grammar", "grammar", SCENE_GRAMMAR, Path::new(""));
    assert!(grammar.is_ok(), "{:?}", grammar.err());
}

/// What a command that ends well prints.
fn shown(bench: &Bench, arguments: &[&str]) -> String {
    bench.ends(0, arguments).0
}

#[test]
fn help_shows_topics_and_the_help_of_commands() {
    let bench = Bench::new();
    let help = shown(&bench, &["help"]);
    assert_eq!(help, shown(&bench, &["--help"]));
    let mut command = cutlab::advanced::cli::command();
    command.build();
    for sub in command.get_subcommands().map(clap::Command::get_name) {
        assert_eq!(shown(&bench, &["help", sub]), shown(&bench, &[sub, "--help"]), "{sub}");
        assert!(TOPICS.iter().all(|topic| topic.name != sub), "{sub} is a command and a topic");
    }
    for topic in TOPICS {
        assert!(help.contains(&format!("  {} ", topic.name)) && help.contains(topic.about), "{}", topic.name);
        let page = shown(&bench, &["help", topic.name]);
        assert!(page.starts_with(&topic.name.to_uppercase()), "{page}");
        let markup = ["\n#", "```", "](", "|--"].iter().find(|markup| page.contains(**markup));
        // comments of TOML and of the shell stand further in
        assert_eq!(markup, None, "{}: {page}", topic.name);
        let long = page.lines().find(|line| line.chars().count() > 110);
        assert_eq!(long, None, "{}", topic.name);
    }
    assert_eq!(shown(&bench, &["help", "STONES"]), shown(&bench, &["help", "stones"]));
    let listed: serde_json::Value = serde_json::from_str(&shown(&bench, &["help", "--json"])).expect("JSON");
    assert_eq!(listed.as_array().map(Vec::len), Some(TOPICS.len()));
    let (_, said) = bench.ends(2, &["help", "sceens"]);
    assert!(said.contains("did you mean 'scenes'?") && said.contains("stones, designs"), "{said}");
    let (_, said) = bench.ends(2, &["help", "xyz"]);
    assert!(!said.contains("did you mean") && said.lines().count() == 1, "{said}");
}

#[test]
fn completions_know_every_command() {
    let bench = Bench::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = shown(&bench, &["completions", shell]);
        for word in ["score", "completions", "material", "metrics"] {
            assert!(script.contains(word), "{shell} lacks {word}");
        }
    }
    // where there is a bash it can read its script
    std::fs::write(bench.path("c.bash"), shown(&bench, &["completions", "bash"])).expect("writes");
    if let Ok(read) = std::process::Command::new("bash").arg("-n").arg(bench.path("c.bash")).output() {
        assert!(read.status.success(), "{}", text(&read.stderr));
    }
    let (_, said) = bench.ends(2, &["completions", "tcsh"]);
    assert!(said.contains("bash") && said.lines().count() == 1, "{said}");
}

#[test]
fn man_pages_are_written_by_the_rule_of_outputs() {
    let bench = Bench::new();
    let main = shown(&bench, &["man"]);
    assert!(main.contains(".TH cutlab 1") && main.contains("cutlab\\-score(1)"), "{main}");
    // examples keep their lines
    let score = shown(&bench, &["man", "-o", "pages", "--json"]);
    let files: Vec<String> = serde_json::from_str(&score).expect("JSON");
    assert_eq!(files.len(), cutlab::advanced::cli::command().get_subcommands().count() + 1);
    let page = text(&bench.read("pages/cutlab-score.1"));
    assert!(page.contains(".nf\n") && page.contains("\\-\\-metrics"), "{page}");
    // the same command replaces its pages, whatever they hold; another's are not replaced
    let old = page.replace("score", "old");
    std::fs::write(bench.path("pages/cutlab-score.1"), &old).expect("writes");
    shown(&bench, &["man", "-o", "pages"]);
    assert_eq!(text(&bench.read("pages/cutlab-score.1")), page);
    std::fs::write(bench.path("pages/cutlab-score.1"), "mine").expect("writes");
    let (_, said) = bench.ends(3, &["man", "-o", "pages"]);
    assert!(said.contains("--force"), "{said}");
    assert_eq!(bench.read("pages/cutlab-score.1"), b"mine");
    shown(&bench, &["man", "-o", "pages", "--force"]);
    assert_eq!(text(&bench.read("pages/cutlab-score.1")), page);
}
