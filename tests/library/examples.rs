//! The programs in `tools/examples/` run, and what they assert holds.

use std::collections::BTreeSet;
use std::path::Path;

#[path = "../../tools/examples/rank_a_folder.rs"]
mod rank_a_folder;
#[path = "../../tools/examples/request_as_json.rs"]
mod request_as_json;
#[path = "../../tools/examples/score_a_brilliant.rs"]
mod score_a_brilliant;
#[path = "../../tools/examples/sweep_angles.rs"]
mod sweep_angles;
#[path = "../../tools/examples/take_a_picture.rs"]
mod take_a_picture;
#[path = "../../tools/examples/your_own_material.rs"]
mod your_own_material;
#[path = "../../tools/examples/your_own_metric.rs"]
mod your_own_metric;
#[path = "../../tools/examples/your_own_scene.rs"]
mod your_own_scene;

#[test]
fn every_example_runs() {
    type Main = fn() -> Result<(), cutlab::Error>;
    let all: [(&str, Main); 8] = [
        ("score_a_brilliant", score_a_brilliant::main),
        ("rank_a_folder", rank_a_folder::main),
        ("sweep_angles", sweep_angles::main),
        ("take_a_picture", take_a_picture::main),
        ("your_own_scene", your_own_scene::main),
        ("your_own_material", your_own_material::main),
        ("your_own_metric", your_own_metric::main),
        ("request_as_json", request_as_json::main),
    ];
    for (name, main) in all {
        main().unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/examples");
    let files = std::fs::read_dir(folder).expect("the folder is there");
    let stem = |f: std::fs::DirEntry| f.path().file_stem().map(|s| s.to_string_lossy().into_owned());
    let files: BTreeSet<String> = files.filter_map(|f| stem(f.ok()?)).collect();
    assert_eq!(files, all.iter().map(|(name, _)| name.to_string()).collect());
}
