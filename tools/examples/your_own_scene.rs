//! A scene of your own: a stone on a white sheet below one lamp, written as TOML and rendered.
//!
//! `cargo run --release --example your_own_scene`

use cutlab::prelude::*;

/// `cutlab help scenes` has the grammar.
const SCENE: &str = r#"
about = "a loose stone on a white sheet below one lamp"
unit = "stone"
picture = [64, 48]

[camera]
at = [0.0, -6.0, 5.0]
field = 30

[[stone]]
pose = "lying"

[[surface]]
corner = [-20, -20, 0]
u = [40, 0, 0]
v = [0, 40, 0]
reflectance = 0.8

[[light]]
kind = "square"
at = [2.0, -1.0, 8.0]
to = [0, 0, 0]
side = 3.0
radiance = 8
"#;

pub fn main() -> Result<(), Error> {
    let folder = std::env::temp_dir().join(format!("cutlab-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    let file = folder.join("sheet.toml");
    std::fs::write(&file, SCENE).expect("can be written");
    let request = RenderRequest::scene(file.display().to_string())?.samples_per_pixel(2).photons(2_000);
    let picture = request.stone(&Stone::parse("tolkowsky")?).run()?;
    picture.save(folder.join("sheet.png"))?;
    println!("{}", folder.join("sheet.png").display());
    assert!(picture.film.linear(None).iter().any(|colour| colour.max_element() > 0.1), "it is dark");
    std::fs::remove_dir_all(folder).expect("can be removed");
    Ok(())
}
