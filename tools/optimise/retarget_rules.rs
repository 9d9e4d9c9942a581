//! What the rules of `cutlab retarget` are worth: every design of some folders made for other refractive indices by
//! each pair of rules, by its ISO (mean of 0° and 10° of tilt, about the x and the y axis; exact beams).
//!
//! ```sh
//! cargo run --release --example retarget_rules -- cuts ../shared/corpus/gemcad ../shared/corpus/pairs
//! ```
//!
//! Designs are taken with the index that they state, those of the library without one as for diamond, and of each
//! folder no more than `MOST`, evenly. The table has for every step from one range of indices to another and every
//! pair of rules:
//!
//! - `mean`, `median`: ISO of the designs made for the new index
//! - `gain`: mean gain over the design as it is, in the new index
//! - `worst`, `tenth`: the greatest loss, and that which one design in ten exceeds
//! - `worse`: how many designs lose more than 5 points
//! - `made`: how many designs the rules could make
//!
//! With `--rows` there is a line of CSV for each design, too.

use cutlab::advanced::design::edit::Editor;
use cutlab::advanced::design::retarget::{CrownRule, PavilionRule, RetargetRequest};
use cutlab::advanced::scoring::{Effort, Evaluator, Objective};
use cutlab::{Limits, Material, Polyhedron, Stone, StoneOptions, expand_stones};
use std::collections::BTreeMap;
use std::error::Error;
use std::ffi::OsString;

/// Designs of a folder.
const MOST: usize = 60;

/// A design loses much beyond so many points.
const MUCH: f64 = 5.0;

/// Ranges of indices that designs are for, by name, and the indices that those are made for.
const STEPS: [(&str, f64, f64, &[f64]); 4] = [
    ("quartz, beryl", 1.5, 1.6, &[1.62, 1.762, 2.16]),
    ("topaz, tourmaline", 1.6, 1.7, &[1.544, 1.762, 2.16]),
    ("spinel, corundum", 1.7, 1.85, &[1.544, 1.62, 2.16]),
    ("zirconia, diamond", 2.1, 2.5, &[1.544, 1.62, 1.762]),
];

/// What a pair of rules makes of a design: its ISO and that of the design as it is, in the new index.
struct Made {
    iso: f64,
    as_it_is: f64,
}

fn iso(solid: &Polyhedron, index: f64) -> Result<f64, Box<dyn Error>> {
    let objective = Objective::maximise("iso@0,10".parse()?).azimuths([0.0, 90.0]);
    let material = Material::from_index(index);
    let evaluator = Evaluator::new(vec![objective], Vec::new(), &material, Effort::default(), solid)?;
    Ok(evaluator.start().objectives[0].value)
}

/// Every pair of rules, with its name; none of a kind is the choice by score.
fn rules() -> Vec<(String, Option<PavilionRule>, Option<CrownRule>)> {
    let pavilions = [PavilionRule::Margin, PavilionRule::Range, PavilionRule::Keep];
    let crowns = [CrownRule::Prism, CrownRule::Index, CrownRule::Keep];
    let pairs = pavilions.into_iter().flat_map(|p| crowns.map(|c| (format!("{p} + {c}"), Some(p), Some(c))));
    let best = [("best".to_owned(), None, None)];
    pairs.chain(best).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let (options, places): (Vec<OsString>, Vec<OsString>) =
        std::env::args_os().skip(1).partition(|word| word == "--rows");
    let mut stones = Vec::new();
    for place in places {
        let all = expand_stones([place], Limits::default())?;
        let every = all.len().div_ceil(MOST);
        stones.extend(all.into_iter().step_by(every));
    }
    let mut table: BTreeMap<(usize, usize, usize), Vec<Made>> = BTreeMap::new();
    let mut before: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for stone in stones {
        let Ok(stone) = Stone::open(&stone, &StoneOptions::default()) else { continue };
        let Ok(design) = stone.convex_design() else { continue };
        let Ok(editor) = Editor::new(design) else { continue };
        let from = stone.material().index_d();
        let Some(step) = STEPS.iter().position(|(_, low, high, _)| (*low..*high).contains(&from)) else {
            continue;
        };
        let Ok(own) = iso(&editor.solid, from) else { continue };
        before.entry(step).or_default().push(own);
        for (target, &to) in STEPS[step].3.iter().enumerate() {
            let as_it_is = iso(&editor.solid, to)?;
            let mut line = format!("{}\t{from:.4}\t{to:.4}\t{own:.2}\t{as_it_is:.2}", stone.name());
            for (rule, (_, pavilion, crown)) in rules().into_iter().enumerate() {
                let mut request = RetargetRequest::new(to).from(from);
                (request.pavilion, request.crown) = (pavilion, crown);
                let scored = request.edit(&editor).map(|made| (iso(&made.edited.solid, to), made.figures));
                match scored {
                    Ok((Ok(iso), figures)) => {
                        table.entry((step, target, rule)).or_default().push(Made { iso, as_it_is });
                        line += &format!("\t{iso:.2} ({:.1})", figures.pavilion_angle_deg.after);
                    }
                    _ => line += "\t",
                }
            }
            if !options.is_empty() {
                println!("{line}");
            }
        }
    }
    for (step, own) in before {
        let (name, .., targets) = STEPS[step];
        for (target, to) in targets.iter().enumerate() {
            println!("\n{} designs for {name} (ISO {:.1}), made for n = {to}\n", own.len(), mean(&own));
            println!("| pavilion + crown | mean | median | gain | worst | tenth | worse | made |");
            println!("|---|---|---|---|---|---|---|---|");
            for (rule, (rule_name, ..)) in rules().iter().enumerate() {
                let Some(made) = table.get(&(step, target, rule)) else { continue };
                let isos: Vec<f64> = made.iter().map(|m| m.iso).collect();
                let gains: Vec<f64> = made.iter().map(|m| m.iso - m.as_it_is).collect();
                println!(
                    "| {rule_name} | {:.1} | {:.1} | {:+.1} | {:+.1} | {:+.1} | {} | {} |",
                    mean(&isos),
                    quantile(&isos, 0.5),
                    mean(&gains),
                    quantile(&gains, 0.0),
                    quantile(&gains, 0.1),
                    gains.iter().filter(|gain| **gain < -MUCH).count(),
                    made.len()
                );
            }
        }
    }
    Ok(())
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[(part * (sorted.len() - 1) as f64).round() as usize]
}
