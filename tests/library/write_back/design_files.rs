//! Design files: comments stay, and rules and parameters where they still hold.

use super::{assert_same_texts, data, distance, read, written};
use cutlab::advanced::design::Design;
use cutlab::advanced::formats::Input;
use cutlab::advanced::formats::write_back::Change;
use cutlab::advanced::limits::Limits;

fn toml(text: &str) -> Design {
    read("odd.toml", text.as_bytes())
}

#[test]
fn a_design_file_keeps_its_comments_and_its_rules() {
    let text = String::from_utf8(data("odd.toml")).expect("text");
    let before = toml(&text);
    let after = |change: &dyn Fn(&mut Design)| {
        let mut design = before.clone();
        change(&mut design);
        let out = written("odd.toml", text.as_bytes(), &design);
        let new = String::from_utf8(out.bytes).expect("text");
        let again = toml(&new);
        assert!(distance(&again, &design) < 1e-12, "{new}");
        assert_same_texts("odd.toml", &again, &design);
        (new, out.remarks)
    };
    assert_eq!(after(&|_| ()), (text.clone(), Vec::new()));
    // what is built with another angle is written as that angle, and the rules stay
    let steeper = text.replace("angle = -43 ", "angle = -42.5 ");
    let (new, remarks) = after(&|design| *design = toml(&steeper));
    assert_eq!(new, steeper);
    assert_eq!(remarks, ["the proportions under [expect] stay as they were"]);
    // a table of no rule is written by distance, its comment kept
    let (new, remarks) = after(&|design| design.tiers[3].facets[0].plane.distance = 0.5);
    assert_eq!(new, text.replace("table = 0.55 #", "distance = 0.5\nnames = [\"table\"] #"));
    assert!(remarks[1].contains("tier 'table': its rule gives other planes"), "{remarks:?}");
    // both lines of a rule go, and the rule of the tier after it still holds
    let crown = |design: &mut Design| {
        let distance = design.tiers[2].facets[0].plane.distance + 0.01;
        design.tiers[2].facets.iter_mut().for_each(|f| f.plane.distance = distance);
    };
    let table = |design: &mut Design| {
        let mut built = text.clone();
        let distance = design.tiers[2].facets[0].plane.distance;
        let rule = "meets = \"pavilion main@0 & pavilion main@24 & girdle@0\"";
        built = built.replace(rule, &format!("distance = {distance}")).replace("girdle = 0.02\n", "");
        *design = toml(&built);
    };
    let (new, remarks) = after(&|design| {
        crown(design);
        table(design);
    });
    assert!(new.contains("# the corner\ninstructions") && new.contains("table = 0.55 # of W"), "{new}");
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    // a tier that came apart, and the index of refraction
    let (new, remarks) = after(&|design| {
        let more = &mut design.tiers[0].facets[2..];
        more.iter_mut().for_each(|f| f.plane.distance = 1.01);
        let apart = design.tiers[0].facets.split_off(2);
        let part = cutlab::advanced::design::Tier { facets: apart, ..design.tiers[0].clone() };
        design.tiers.insert(1, part);
        design.refractive_index = Some(1.76);
    });
    assert!(new.starts_with("# a square of four mains, by hand\nrefractive-index = 1.76\n"), "{new}");
    assert!(new.contains("# the table last") && remarks.iter().any(|r| r.contains("written anew")), "{new}");
}

#[test]
fn families_take_parameters_and_explicit_planes_stay_explicit() {
    let family = "# mine\nname = \"x\"\nfamily = \"round-brilliant\"\n\n[parameters]\ntable = 57 # wide\n";
    let built = toml(&family.replace("57", "58").replace("# wide", "# wide\ncrown-angle = 33.5"));
    let file = Input { name: "x.toml", bytes: family.as_bytes(), folder: None, limits: Limits::default() };
    let parameters = [("table", 58.0), ("crown-angle", 33.5)].map(|(k, v)| (k.to_owned(), v)).into();
    let out = Change { design: &built, parameters }.write_back(&file).expect("is written");
    let new = String::from_utf8(out.bytes).expect("text");
    assert!(new.contains("table = 58 # wide") && new.contains("crown-angle = 33.5"), "{new}");
    assert!(distance(&toml(&new), &built) < 1e-15);
    // other facets too
    let step = "family = \"step-cut\"\n";
    let more = toml(&format!("{step}[parameters]\ncrown-steps = 4\n"));
    let file = Input { name: "y.toml", bytes: step.as_bytes(), ..file };
    let parameters: std::collections::BTreeMap<_, _> = [("crown-steps".to_owned(), 4.0)].into();
    let out = Change { design: &more, parameters: parameters.clone() }.write_back(&file).expect("is written");
    let new = String::from_utf8(out.bytes).expect("text");
    assert!(new.starts_with(step) && distance(&toml(&new), &more) < 1e-15, "{new}");
    // which are a design file's alone
    let asc = data("odd.asc");
    let design = read("odd.asc", &asc);
    let file = Input { name: "odd.asc", bytes: &asc, folder: None, limits: Limits::default() };
    assert!(Change { design: &design, parameters }.write_back(&file).is_err());
    // planes alone are not the family's
    let out = written("x.toml", family.as_bytes(), &built);
    assert!(out.remarks[0].contains("family"), "{:?}", out.remarks);
    assert!(distance(&toml(&String::from_utf8(out.bytes).expect("text")), &built) < 1e-15);

    let cube = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/good/cube.toml"));
    let cube = cube.expect("is there");
    let mut taller = toml(&cube);
    taller.tiers[2].facets[0].plane.distance = 3.5;
    let out = written("cube.toml", cube.as_bytes(), &taller).bytes;
    let new = String::from_utf8(out).expect("text");
    let last = cube.rfind("3.0").expect("the culet's");
    assert_eq!(new, format!("{}3.5{}", &cube[..last], &cube[last + 3..]));
}
