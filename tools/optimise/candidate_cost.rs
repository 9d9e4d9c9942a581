//! What a candidate costs on one thread: settings applied, meets solved again, the solid.

use cutlab::advanced::design::edit::{Editor, Keep, Setting};
use cutlab::{Polyhedron, Stone};
use std::time::Instant;

fn main() {
    for name in std::env::args().skip(1) {
        let stone = Stone::parse(&name).expect("a stone");
        let design = stone.into_design().expect("convex");
        let editor = Editor::new(&design).expect("closed");
        let best = |f: &dyn Fn()| {
            (0..30)
                .map(|_| {
                    let t = Instant::now();
                    f();
                    t.elapsed().as_secs_f64()
                })
                .fold(f64::INFINITY, f64::min)
        };
        let set =
            |text: &str| -> Vec<Setting> { text.split(' ').map(|s| s.parse().expect("a setting")).collect() };
        let scales = set("crown.scale=0.97 pavilion.scale=1.01");
        let angles = set("P1.angle+=0.2 C1.angle-=0.2");
        let (_, solid) = (
            0,
            best(&|| {
                Polyhedron::from_planes(&design.planes()).expect("closed");
            }),
        );
        println!(
            "{name}: {} tiers, {} parts, {} facets, recover {:.3} ms, solid {:.3} ms, edit of scales {:.3} ms, of two angles {:.3} ms ({})",
            design.tiers.len(),
            editor.network.parts.len(),
            design.facets().count(),
            1e3 * best(&|| {
                Editor::new(&design).expect("closed");
            }),
            1e3 * solid,
            1e3 * best(&|| {
                let _ = editor.edit(&scales, Keep::Meets);
            }),
            1e3 * best(&|| {
                let _ = editor.edit(&angles, Keep::Angles);
            }),
            match editor.edit(&angles, Keep::Angles) {
                Ok(_) => "ok".into(),
                Err(e) => e.to_string(),
            }
        );
    }
}
