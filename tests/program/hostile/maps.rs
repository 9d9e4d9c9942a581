//! Stored photon maps on the command line: what is damaged, old or of something else is refused with the
//! reason, and left as it is.

use super::cutlab;
use super::limits::refused;
use cutlab::advanced::photons::map_file::VERSION;
use std::fs;

const RENDER: &str =
    "render octahedron --width 8 --height 6 --spp 1 --photons 40 --nearest 5 -o p.png --force";

#[test]
fn maps_that_do_not_fit_are_refused_with_the_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("kept.map");
    let render = format!("{RENDER} --photon-map kept.map");
    let made = cutlab(folder.path(), &render);
    assert!(String::from_utf8_lossy(&made.stderr).contains("made the photon map"), "{made:?}");
    let used = cutlab(folder.path(), &render);
    assert!(String::from_utf8_lossy(&used.stderr).contains("used the photon map"), "{used:?}");
    let good = fs::read(&path).expect("was written");
    let all = good.len();
    let changed = |at: usize, value: u8| {
        let mut bytes = good.clone();
        bytes[at] = value;
        bytes
    };
    let flipped = |at: usize, bit: u8| changed(at, good[at] ^ 1 << bit);
    let old = VERSION as u8 - 1;
    // an old file is sound in itself: its checksum fits
    let mut sound = changed(8, old);
    let sum = crc32fast::hash(&sound[..all - 4]);
    sound[all - 4..].copy_from_slice(&sum.to_le_bytes());
    let older = format!("its version is {old}, this program reads {VERSION}");
    for (what, bytes, says) in [
        ("a bit of a photon", flipped(all - 30, 3), "its checksum does not match"),
        ("a bit of the header", flipped(40, 0), "its checksum does not match"),
        ("a bit of the checksum", flipped(all - 1, 7), "its checksum does not match"),
        ("cut off", good[..all - 26].to_vec(), "its checksum does not match"),
        ("cut off early", good[..10].to_vec(), "cut short"),
        ("empty", Vec::new(), "it does not begin as one"),
        ("another file", b"solid stone".to_vec(), "it does not begin as one"),
        ("older", sound, &older),
    ] {
        fs::write(&path, &bytes).expect("written");
        refused(folder.path(), &render, says);
        refused(folder.path(), &render, "delete it to have it made anew");
        assert_eq!(fs::read(&path).expect("still there"), bytes, "{what}");
    }
    fs::write(&path, &good).expect("written");
    for (other, what) in
        [("--seed 2", "--seed"), ("--material ruby", "the material"), ("--scene spot", "the scene")]
    {
        refused(folder.path(), &format!("{render} {other}"), what);
    }
}
