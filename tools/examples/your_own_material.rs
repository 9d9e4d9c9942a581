//! A material of your own: a glass with a published dispersion and a colour, as a TOML text.
//!
//! `cargo run --release --example your_own_material`

use cutlab::prelude::*;

/// `cutlab help materials` has the grammar.
const MATERIAL: &str = r#"
name = "my-glass"
about = "a dense flint of pale green"
specific-gravity = 3.6

[index]
cauchy = [1.596, 0.0087, 1e-4]    # of the wavelength in µm

[absorption]
about = "one band in the red, drawn"

[[absorption.band]]
name = "red"
centre-nm = 680
half-widths-per-cm = [1500, 1500]
peak-per-mm = 0.05
"#;

pub fn main() -> Result<(), Error> {
    let folder = std::env::temp_dir().join(format!("cutlab-material-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let file = folder.join("my-glass.toml");
    std::fs::write(&file, MATERIAL).expect("can be written");
    let options = StoneOptions::default().material(file.display().to_string());
    let stone = Stone::open("emerald", &options)?;
    println!("{}: n {:.4} at the D line", stone.material().name, stone.material().index_d());
    let scores = ScoreRequest::new(["light_return", "absorbed"]).samples(1 << 11).run(&stone)?;
    println!("light return {}, absorbed {}", scores["light_return"], scores["absorbed"]);
    assert!(scores["absorbed"].value > 0.01);
    std::fs::remove_dir_all(folder).expect("can be removed");
    Ok(())
}
