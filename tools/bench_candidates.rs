//! draft
mod timing;

use cutlab::advanced::estimators::viewer_lighting::ObserverDome;
use cutlab::advanced::estimators::{TraceOptics, ViewFrame, beam_tallies, faceter_view};
use cutlab::advanced::geometry::AxialSymmetry;
use cutlab::advanced::materials::Material;
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::beams::*;
use cutlab::{Polyhedron, Stone};
use std::error::Error;
use timing::best_of;

fn main() -> Result<(), Box<dyn Error>> {
    let runs = 50;
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global()?;
    println!("cpu: {}", timing::machine());
    let corpus = "/work/shared/corpus/gemcad";
    let names: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    for name in names {
        let stone = Stone::parse(format!("{corpus}/{name}"))?;
        let planes: Vec<_> = stone.design().unwrap().facets().map(|f| f.plane).collect();
        let index = stone.design().unwrap().refractive_index.unwrap();
        let material = Material::from_index(index);
        let (t0, solid) = best_of(runs, || Polyhedron::from_planes(&planes).unwrap());
        let (t1, convex) = best_of(runs, || ConvexStone::new(solid.clone()));
        let (t2, beams) = best_of(runs, || Beams::new(&convex));
        let (t3, sym) = best_of(runs, || Beams::by_symmetry(&convex));
        println!(
            "\n{name} {} tiers {} planes n={index}: solid {:.3} ms, convex {:.3}, beams {:.3} with symmetry {:.3} {:?}",
            stone.design().unwrap().tiers.len(),
            planes.len(),
            t0 * 1e3,
            t1 * 1e3,
            t2 * 1e3,
            t3 * 1e3,
            AxialSymmetry::of_planes(&planes)
        );
        let optics = TraceOptics { material: &material, polarised: false };
        let dome = ObserverDome::with_observer(10.0);
        for (which, b) in [("all", &beams), ("sector", &sym)] {
            for untraced in [0.02, 0.01, 0.005, 0.002, 0.0] {
                let (t, y) = best_of(if untraced > 0.0 { runs } else { 5 }, || {
                    beam_tallies::iso(b, &optics, ViewFrame::FACE_UP, dome, untraced).unwrap()
                });
                println!(
                    "  {which} {untraced}: {:.3} ms iso {:.5} ± {:.4}",
                    t * 1e3,
                    100.0 * y[faceter_view::ISO],
                    100.0 * y[faceter_view::UNTRACED]
                );
            }
        }
    }
    Ok(())
}
