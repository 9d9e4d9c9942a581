//! A folder of its own for a test, and the program run in it.

#![allow(dead_code)] // each test file uses its part

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

pub struct Bench(tempfile::TempDir);

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

impl Bench {
    pub fn new() -> Bench {
        Bench(tempfile::tempdir().expect("a temporary folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cutlab"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// Runs a command that must end with `code`; standard output and standard error.
    pub fn ends(&self, code: i32, arguments: &[&str]) -> (String, String) {
        let out = self.run(arguments);
        let said = text(&out.stderr);
        assert_eq!(out.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{said}");
        (text(&out.stdout), said)
    }

    /// As [`Bench::ends`], by a user to whom modes of files apply: to root they do not, and another user
    /// takes root's place. None, said in the test's output, where that cannot be.
    #[cfg(unix)]
    pub fn ends_for_a_user(&self, code: i32, arguments: &[&str]) -> Option<(String, String)> {
        use std::os::unix::fs::{MetadataExt, PermissionsExt};
        use std::os::unix::process::CommandExt;
        /// The user called nobody.
        const NOBODY: u32 = 65534;
        let mine = self.path(".mine");
        std::fs::write(&mine, "").expect("writes");
        let is_root = mine.metadata().expect("is there").uid() == 0;
        std::fs::remove_file(&mine).expect("removes");
        if !is_root {
            return Some(self.ends(code, arguments));
        }
        let program = self.path(".cutlab");
        std::fs::copy(env!("CARGO_BIN_EXE_cutlab"), &program).expect("copies");
        std::fs::set_permissions(self.path(""), PermissionsExt::from_mode(0o755)).expect("opens");
        let mut command = Command::new(&program);
        command.args(arguments).current_dir(self.0.path()).uid(NOBODY).gid(NOBODY);
        let out = command.output();
        std::fs::remove_file(&program).expect("removes");
        let out = match out {
            Ok(out) => out,
            Err(why) => {
                println!("skipped: root cannot run a program as another user here ({why})");
                return None;
            }
        };
        assert_eq!(out.status.code(), Some(code), "{arguments:?}: {}", text(&out.stderr));
        Some((text(&out.stdout), text(&out.stderr)))
    }

    /// Runs a command that must end well; standard error.
    pub fn good(&self, arguments: &[&str]) -> String {
        self.ends(0, arguments).1
    }

    pub fn start(&self, arguments: &[&str]) -> Child {
        self.command(arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts")
    }

    /// Starts a command and kills it after `wait`; whether it was still at work.
    pub fn kill_after(&self, wait: Duration, arguments: &[&str]) -> bool {
        let mut child = self.start(arguments);
        std::thread::sleep(wait);
        let at_work = child.try_wait().expect("can be asked").is_none();
        let _ = child.kill();
        child.wait().expect("ends");
        at_work
    }

    /// Runs a command to its end; the most memory that it had at a time, in kB.
    #[cfg(target_os = "linux")]
    pub fn peak_kb(&self, arguments: &[&str]) -> u64 {
        let mut child = self.start(arguments);
        let status = format!("/proc/{}/status", child.id());
        let mut peak = 0;
        let code = loop {
            if let Some(code) = child.try_wait().expect("can be asked") {
                break code;
            }
            let text = std::fs::read_to_string(&status).unwrap_or_default();
            let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
            let kb = line.and_then(|l| l.trim().trim_end_matches(" kB").parse().ok());
            peak = kb.unwrap_or(0u64).max(peak);
            std::thread::sleep(Duration::from_millis(2));
        };
        assert!(code.success(), "{arguments:?}");
        peak
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// All names in the folder, hidden ones too.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("can be listed");
        let mut names: Vec<String> =
            entries.map(|e| e.expect("can be listed").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Every file in the folder and its folders, hidden ones too, with what it holds.
    pub fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        fn gather(folder: &Path, top: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
            for entry in std::fs::read_dir(folder).expect("can be listed") {
                let path = entry.expect("can be listed").path();
                if path.is_dir() {
                    gather(&path, top, files);
                } else {
                    let bytes = std::fs::read(&path).expect("can be read");
                    files.insert(path.strip_prefix(top).expect("is inside").to_owned(), bytes);
                }
            }
        }
        let mut files = BTreeMap::new();
        gather(self.0.path(), self.0.path(), &mut files);
        files
    }

    pub fn exists(&self, name: &str) -> bool {
        Path::new(&self.path(name)).exists()
    }
}
