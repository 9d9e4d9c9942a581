//! The real program in a fresh folder.

use crate::tables::{self, Row};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// No case is so large that it takes longer.
const LONGEST: Duration = Duration::from_secs(300);

/// The files that cases name, made once by the program itself.
pub struct Inputs {
    files: Files,
}

/// Files by their names below a folder.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// How a command went.
pub struct Ran {
    /// Its exit code; none if it was killed for want of an end.
    pub code: Option<i32>,
    /// What it wrote to standard output.
    pub stdout: Vec<u8>,
    /// What it said.
    pub stderr: String,
    /// Files that are new, or hold something else.
    pub files: Files,
    /// Input files that are gone or hold something else.
    pub harmed: Vec<PathBuf>,
    /// How long it took.
    pub took: Duration,
}

/// What standard input is.
const STANDARD_INPUT: &str = "a.asc";

/// The whole of the table whose parts are `p1.csv`, `q1.jsonl`, `r1.json` and so on.
pub const WHOLE: &str = "s.csv";

/// A scene that is quick to take.
const SCENE: &str = "about = \"a cube under a dome\"\nunit = \"stone\"\npicture = [16, 16]\n\n\
    [camera]\nat = [0, 0, 12]\nwidth = 2.2\n\n[[stone]]\ncut = \"cube\"\npose = \"table-up\"\n\n\
    [[light]]\nkind = \"dome\"\nradiance = 0.9\n";

impl Inputs {
    /// Makes them.
    pub fn made() -> Inputs {
        let mut files = Files::new();
        files.insert("scene.toml".into(), SCENE.into());
        let folder = Bench::of(files);
        let make = |words: &[&str]| {
            let words: Vec<String> = words.iter().map(|w| w.to_string()).collect();
            let ran = folder.run(&words, 2);
            assert_eq!(ran.code, Some(0), "{words:?}: {}", ran.stderr);
        };
        fs::create_dir(folder.path().join("d")).expect("makes a folder");
        make(&["generate", "cube", "-o", "a.asc", "-o", "d/one.asc"]);
        make(&["generate", "classic", "-o", "b.gem", "-o", "d/two.obj"]);
        make(&["generate", "octahedron", "--size", "5", "-o", "o.stl"]);
        let scored = ["--metrics", "iso,spread", "--error", "0.05"];
        let table = |words: &[&str], output: &str| make(&[words, &scored, &["-o", output]].concat());
        let stones = ["score", "cube", "classic", "a.asc"];
        table(&stones, WHOLE);
        for (extension, number) in [("csv", "p"), ("jsonl", "q"), ("json", "r")] {
            for shard in ["1/2", "2/2"] {
                table(
                    &[&stones[..], &["--shard", shard]].concat(),
                    &format!("{number}{}.{extension}", &shard[..1]),
                );
            }
        }
        let sweep = ["sweep", "round-brilliant:facets=73", "--vary", "crown-angle=34:35:1"];
        table(&sweep, "w.csv");
        for shard in ["1/2", "2/2"] {
            table(&[&sweep[..], &["--shard", shard]].concat(), &format!("v{}.csv", &shard[..1]));
        }
        table(&["sweep", "oval", "--vary", "table=55:57:2", "--vary", "size=2:4:2"], "m.json");
        table(&["score", "cube", "--tilt", "-20:20:20", "--tilt-axis", "0,90"], "t.jsonl");
        let sky =
            image::ImageBuffer::<image::Rgb<f32>, Vec<f32>>::from_fn(8, 4, |x, _| image::Rgb([x as f32; 3]));
        sky.save(folder.path().join("sky.hdr")).expect("writes a panorama");
        let made = Inputs { files: read(folder.path()) };
        assert!(made.files.len() >= 30, "{:?}", made.files.keys());
        made
    }
}

impl Inputs {
    /// The rows of an input that is a table in CSV.
    pub fn rows(&self, name: &Path) -> Vec<Row> {
        tables::rows(self.files.get(name).map_or(&[], Vec::as_slice), "csv").expect("a table")
    }
}

/// The program: this one, or another build of it that the environment names.
fn program() -> PathBuf {
    std::env::var_os("PAIRS_PROGRAM").map_or_else(|| env!("CARGO_BIN_EXE_cutlab").into(), PathBuf::from)
}

/// A folder with the inputs in it.
pub struct Bench {
    folder: TempDir,
    before: Files,
}

impl Bench {
    /// A new one with the inputs that the words name, and what standard input is.
    pub fn new(inputs: &Inputs, words: &[String]) -> Bench {
        // of a pattern and of a stone with parameters the beginning
        let begins = |word: &String| word.split(['*', ':']).next().unwrap_or_default().to_owned();
        let begins: Vec<String> = words.iter().map(begins).filter(|w| !w.is_empty()).collect();
        let is_named = |name: &Path| {
            let name = name.to_string_lossy();
            name == STANDARD_INPUT || begins.iter().any(|begin| name.starts_with(begin))
        };
        let named = inputs.files.iter().filter(|(name, _)| is_named(name));
        Bench::of(named.map(|(name, bytes)| (name.clone(), bytes.clone())).collect())
    }

    fn of(files: Files) -> Bench {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for (name, bytes) in &files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("below the folder")).expect("makes a folder");
            fs::write(path, bytes).expect("writes an input");
        }
        Bench { folder, before: files }
    }

    /// Runs the program in a new folder with what the words name.
    pub fn once(inputs: &Inputs, words: &[String], threads: u32) -> Ran {
        Bench::new(inputs, words).run(words, threads)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Runs the program on so many threads; standard input is a design.
    pub fn run(&self, words: &[String], threads: u32) -> Ran {
        self.run_for(words, threads, LONGEST)
    }

    /// The same; it is stopped when that time is over.
    pub fn run_for(&self, words: &[String], threads: u32, longest: Duration) -> Ran {
        let said = tempfile::tempdir().expect("a temporary folder");
        let (out, err) = (said.path().join("out"), said.path().join("err"));
        let create = |path: &Path| fs::File::create(path).expect("a file for what is said");
        let stdin = match fs::File::open(self.path().join(STANDARD_INPUT)) {
            Ok(file) => Stdio::from(file),
            Err(_) => Stdio::null(), // while the inputs are made
        };
        let mut child = Command::new(program())
            .args(words)
            .current_dir(self.path())
            .env("RAYON_NUM_THREADS", threads.to_string())
            .env_remove("CUTLAB_CORPUS")
            .stdin(stdin)
            .stdout(create(&out))
            .stderr(create(&err))
            .spawn()
            .expect("the program starts");
        let start = Instant::now();
        let code = loop {
            if let Some(status) = child.try_wait().expect("the program is there") {
                break status.code();
            }
            if start.elapsed() > longest {
                child.kill().expect("the program is stopped");
                child.wait().expect("the program is there");
                break None;
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let took = start.elapsed();
        let now = read(self.path());
        let files = now.iter().filter(|(name, bytes)| self.before.get(*name) != Some(bytes));
        let harmed = self.before.iter().filter(|(name, bytes)| now.get(*name) != Some(bytes));
        Ran {
            code,
            took,
            stdout: fs::read(out).expect("what was said"),
            stderr: String::from_utf8_lossy(&fs::read(err).expect("what was said")).into_owned(),
            harmed: harmed.map(|(name, _)| name.clone()).collect(),
            files: files.map(|(name, bytes)| (name.clone(), bytes.clone())).collect(),
        }
    }
}

/// All files below a folder.
fn read(folder: &Path) -> Files {
    fn add(top: &Path, folder: &Path, files: &mut Files) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                add(top, &path, files);
            } else {
                let name = path.strip_prefix(top).expect("below the folder").to_owned();
                files.insert(name, fs::read(&path).unwrap_or_default());
            }
        }
    }
    let mut files = Files::new();
    add(folder, folder, &mut files);
    files
}
