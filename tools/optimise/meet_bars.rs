//! Bars 2 and 3 of issue J: the meet network over a folder of designs.

use cutlab::Stone;
use cutlab::advanced::design::Zone;
use cutlab::advanced::design::meet_network::{Change, MeetNetwork, NetworkError};

fn main() {
    let dir = std::env::args().nth(1).expect("folder");
    let mut files: Vec<_> = std::fs::read_dir(dir).expect("folder").flatten().map(|e| e.path()).collect();
    files.sort();
    let (mut n, mut same, mut cases, mut solved, mut followed, mut outline) = (0, 0, 0, 0, 0, 0);
    let mut kinds = std::collections::BTreeMap::<&str, usize>::new();
    let verbose = std::env::args().nth(2).is_some();
    let (mut t_solve, mut max_solve) = (0.0, 0.0f64);
    for file in files {
        let name = file.to_string_lossy().into_owned();
        let Ok(stone) = Stone::parse(&name) else { continue };
        let (Some(design), Some(solid)) = (stone.design(), stone.solid()) else { continue };
        let t0 = std::time::Instant::now();
        let network = MeetNetwork::recover(design, solid);
        let t_rec = t0.elapsed().as_secs_f64();
        n += 1;
        match network.solve(&Change::default()) {
            Ok(s) => {
                let worst = s
                    .planes
                    .iter()
                    .zip(design.planes())
                    .map(|(a, b)| {
                        (a.normal - b.normal).length().max((a.distance - b.distance).abs() / network.width)
                    })
                    .fold(0.0, f64::max);
                if worst < 1e-9 { same += 1 } else { println!("{name}: unchanged moves {worst:.1e}") }
            }
            Err(e) => println!("{name}: unchanged {e}"),
        }
        let mut bad = Vec::new();
        for (i, part) in network.parts.iter().enumerate() {
            if matches!(part.zone, Zone::Table | Zone::Culet | Zone::Girdle) {
                continue;
            }
            for by in [1.0f64, -1.0] {
                let mut change = Change { polars: vec![None; network.parts.len()], ..Change::default() };
                change.polars[i] = Some(part.polar + by.to_radians());
                cases += 1;
                let t0 = std::time::Instant::now();
                let r = network.solve(&change);
                let t = t0.elapsed().as_secs_f64();
                t_solve += t;
                max_solve = max_solve.max(t);
                match r {
                    Ok(s) => {
                        solved += 1;
                        if !s.followed.is_empty() {
                            followed += 1
                        }
                        if s.is_outline_changed {
                            outline += 1
                        }
                    }
                    Err(e) => {
                        *kinds
                            .entry(match e {
                                NetworkError::Opens { .. } => "opens",
                                NetworkError::CutAway { .. } => "cut away",
                                NetworkError::Lost { .. } => "lost",
                                NetworkError::Solid(_) => "solid",
                                _ => "other",
                            })
                            .or_default() += 1;
                        bad.push(format!(
                            "part {i} {:?} {:.2} {by:+}: {e}",
                            part.zone,
                            part.polar.to_degrees()
                        ));
                    }
                }
            }
        }
        if verbose || t_rec > 0.2 {
            println!(
                "{name}: {} parts, {} corners, {} meets, recovered in {:.1} ms, {} bad",
                network.parts.len(),
                network.corners.len(),
                network.meets().count(),
                1e3 * t_rec,
                bad.len()
            );
            bad.iter().take(6).for_each(|b| println!("   {b}"));
        }
    }
    println!(
        "{n} designs, unchanged same {same}; {cases} cases, {solved} solved ({:.1} %), {followed} with angles following, {outline} outlines; {kinds:?}; {:.2} ms a solve, worst {:.0} ms",
        100.0 * solved as f64 / cases as f64,
        1e3 * t_solve / cases as f64,
        1e3 * max_solve
    );
}
