//! The file of progress, byte by byte: torn, broken, someone else's.

use cutlab::advanced::storage::journal::{Journal, JournalRemark};
use std::cell::RefCell;
use std::path::Path;

/// Opens the file; what it says on the way.
fn open(path: &Path, identity: &str) -> (Journal, Vec<JournalRemark>) {
    let said = RefCell::new(Vec::new());
    let progress = Journal::open(path, identity, &|remark| said.borrow_mut().push(remark)).expect("opens");
    (progress, said.into_inner())
}

fn rows(progress: &mut Journal) -> Vec<String> {
    let mut rows = Vec::new();
    progress
        .for_each(|row| {
            rows.push(String::from_utf8_lossy(row).into_owned());
            Ok(())
        })
        .expect("reads");
    rows
}

const ROWS: [(u64, &str); 4] = [(0, "first"), (2, "third,\n\"quoted\""), (1, "second"), (3, "")];

fn filled(path: &Path) -> Vec<u8> {
    let (mut progress, said) = open(path, "work");
    assert!(said.is_empty());
    ROWS.iter().for_each(|(at, row)| progress.append(*at, row.as_bytes()).expect("appends"));
    assert_eq!(rows(&mut progress), ["first", "second", "third,\n\"quoted\"", ""]);
    std::fs::read(path).expect("reads")
}

/// Cut off at any byte, the file gives the whole records before it, and goes on from there.
#[test]
fn a_torn_file_keeps_its_whole_records() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(".x.progress");
    let bytes = filled(&path);
    let mut counts = Vec::new();
    for cut in 0..=bytes.len() {
        std::fs::write(&path, &bytes[..cut]).expect("writes");
        let (mut progress, said) = open(&path, "work");
        assert!(said.is_empty(), "cut at {cut}: {said:?}");
        counts.push(progress.count());
        let done = progress.count();
        for (at, row) in ROWS.iter().skip(done as usize) {
            progress.append(*at, row.as_bytes()).expect("appends");
        }
        drop(progress);
        assert_eq!(std::fs::read(&path).expect("reads"), bytes, "cut at {cut}");
    }
    assert!(counts.is_sorted() && counts.first() == Some(&0) && counts.last() == Some(&4));
}

/// One wrong byte anywhere: no wrong record is ever given.
#[test]
fn a_broken_file_gives_no_wrong_record() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(".x.progress");
    let bytes = filled(&path);
    let mut aside = 0;
    for at in 0..bytes.len() {
        let mut broken = bytes.clone();
        broken[at] ^= 0x11;
        std::fs::write(&path, &broken).expect("writes");
        let (mut progress, said) = open(&path, "work");
        let kept = rows(&mut progress);
        assert!(
            ["first", "second", "third,\n\"quoted\"", ""]
                .starts_with(&kept.iter().map(String::as_str).collect::<Vec<_>>()),
            "byte {at}: {kept:?}"
        );
        if let [JournalRemark::Quarantined(file, _)] = &said[..] {
            aside += 1;
            assert_eq!(std::fs::read(file).expect("kept"), broken);
        }
    }
    assert!(aside > bytes.len() * 8 / 10, "{aside} of {} are seen to be broken", bytes.len());
}

#[test]
fn another_identity_starts_anew_and_the_old_file_is_kept() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(".x.progress");
    let bytes = filled(&path);
    let (progress, said) = open(&path, "other work");
    assert_eq!(progress.count(), 0);
    let [JournalRemark::Quarantined(file, why)] = &said[..] else { panic!("{said:?}") };
    assert!(why.contains("another command"));
    assert_eq!(std::fs::read(file).expect("kept"), bytes);
    progress.finish().expect("ends");
    assert!(!path.exists());
}

#[test]
fn one_at_a_time_has_it() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join(".x.progress");
    let (mut first, _) = open(&path, "work");
    first.append(0, b"row").expect("appends");
    std::thread::scope(|scope| {
        let second = scope.spawn(|| {
            let (second, said) = open(&path, "work");
            (second.count(), said)
        });
        std::thread::sleep(std::time::Duration::from_millis(100));
        first.finish().expect("ends");
        let (count, said) = second.join().expect("ends");
        assert_eq!((count, said), (0, vec![JournalRemark::Waiting]), "it was finished: the next starts anew");
    });
}
