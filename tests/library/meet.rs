//! The meet-point solver against corners derived by hand, the closed form of the round brilliant,
//! and its errors.

use cutlab::advanced::design::Design;
use cutlab::advanced::design::design_file::{DesignFile, DocumentError};
use cutlab::advanced::design::families::{self, round_brilliant::derived_angles};
use cutlab::advanced::design::meet_points::MeetError;
use std::collections::BTreeMap;

fn tried(text: &str) -> Result<Design, DocumentError> {
    DesignFile::parse(text).expect("well written").design(&BTreeMap::new())
}

fn solved(text: &str) -> Design {
    tried(text).unwrap_or_else(|e| panic!("{e}"))
}

fn distance(design: &Design, tier: &str) -> f64 {
    let tier = design.tiers.iter().find(|t| t.name == tier).expect("the tier exists");
    let distance = tier.facets[0].plane.distance;
    assert!(tier.facets.iter().all(|f| f.plane.distance == distance));
    distance
}

fn assert_near(value: f64, expected: f64, what: &str) {
    assert!((value - expected).abs() < 1e-12, "{what}: {value} against {expected}");
}

/// A square stone of width 2, pavilion 45° from the girdle at height 0.
const SQUARE: &str = r#"
[[tier]]
name = "girdle"
angle = 90
indices = [0]
repeat = 4
width = 2
[[tier]]
name = "level"
angle = 0.0
indices = [0]
guide = true
distance = 0
[[tier]]
name = "pavilion"
angle = -45.0
indices = [0]
repeat = 4
meets = "girdle@0 & girdle@24 & level"
"#;

#[test]
fn hand_derived_distances() {
    let stone = solved(&format!(
        "{SQUARE}{}",
        r#"
[[tier]]
name = "crown"
angle = 45.0
indices = [0]
repeat = 4
meets = "girdle@0 & girdle@24 & pavilion@0 & pavilion@24"
girdle = 0.1
[[tier]]
name = "corner"
angle = 30.0
indices = [12]
repeat = 4
meets = "crown 1 & crown 2 & girdle@0"
[[tier]]
name = "table"
angle = 0.0
indices = [0]
table = 0.5
"#
    ));
    let half = 0.5f64.sqrt();
    // walls at 1; 45° through (·, 1, 0) and through (·, 1, 0.2): (1 + 0.2)/√2
    assert_near(distance(&stone, "girdle"), 1.0, "girdle");
    assert_near(distance(&stone, "pavilion"), half, "pavilion");
    assert_near(distance(&stone, "crown"), 1.2 * half, "crown");
    // 30° toward the corner at √2, height 0.2: √2 sin 30° + 0.2 cos 30°
    assert_near(distance(&stone, "corner"), half + 0.1 * 3f64.sqrt(), "corner");
    // half as wide as the stone: the crown has come in by 0.5 and up by 0.5
    assert_near(distance(&stone, "table"), 0.7, "table");
    assert_eq!(stone.solid().expect("closed").faces.len(), 4 + 4 + 4 + 4 + 1);
    assert!(stone.facets().any(|f| f.name == "crown 4"));
}

#[test]
fn two_corners_give_the_angle_too() {
    // from the girdle's corner to the middle of the axis 2 below: atan(2/√2) toward the corner
    let stone = solved(&format!(
        "{SQUARE}{}",
        r#"
[[tier]]
name = "low"
angle = 0.0
indices = [0]
guide = true
distance = -0.5
[[tier]]
name = "east"
angle = 90.0
indices = [24]
guide = true
distance = 0
[[tier]]
name = "south"
angle = 90.0
indices = [0]
guide = true
distance = 0
[[tier]]
name = "corner"
indices = [12]
repeat = 4
meets = ["girdle@0 & girdle@24 & level", "east & south & low"]
"#
    ));
    let corner = stone.tiers.iter().find(|t| t.name == "corner").expect("it exists");
    let angle = (0.5 / 2f64.sqrt()).atan();
    assert_near(corner.angle_deg.expect("solved").to_radians(), -angle, "angle");
    assert_near(distance(&stone, "corner"), 2f64.sqrt() * angle.sin(), "distance");
}

/// The reference brilliant cut by meets, as a faceter would who knows its angles: every plane is
/// the closed form's.
#[test]
fn the_round_brilliant_comes_out_of_its_meets() {
    let closed = families::build("round-brilliant", &BTreeMap::from([("size".into(), 2.0)])).expect("builds");
    let a = derived_angles(0.56, 34.0, 40.5, 0.5, 0.75);
    let text = format!(
        r#"
tier = [
  {{ name = "bottom", angle = 0.0, indices = [0], guide = true, distance = -0.03 }},
  {{ name = "top", angle = 0.0, indices = [0], guide = true, distance = 0.03 }},
  {{ name = "axis", angle = 90.0, indices = [24, 30], guide = true, distance = 0 }},
  {{ name = "girdle", angle = 90, indices = [0], repeat = 96, distance = 1 }},
  {{ name = "pavilion main", angle = -40.5, indices = [0], repeat = 8, meets = "girdle@0 & axis@24 & bottom" }},
  {{ name = "lower half", angle = -{lower:?}, indices = [3], repeat = 8, mirror = true, meets = "girdle@0 & axis@24 & pavilion main@0" }},
  {{ name = "crown main", angle = 34.0, indices = [0], repeat = 8, meets = "girdle@0 & axis@24 & top" }},
  {{ name = "upper half", angle = {upper:?}, indices = [3], repeat = 8, mirror = true, meets = "crown main@0 & girdle@0 & axis@24" }},
  {{ name = "star", angle = {star:?}, indices = [6], repeat = 8, meets = "crown main@0 & crown main@12 & upper half@3 & upper half@9" }},
  {{ name = "table", angle = 0.0, indices = [0], meets = "crown main@0 & star@6 & star@90" }},
]
"#,
        lower = a.lower_half,
        upper = a.upper_half,
        star = a.star
    );
    let met = solved(&text);
    assert_eq!(met.facets().count(), 153);
    for facet in closed.facets() {
        let near = |p: &cutlab::advanced::geometry::Plane| {
            (p.normal - facet.plane.normal).length().max((p.distance - facet.plane.distance).abs())
        };
        let off = met.planes().iter().map(near).fold(f64::INFINITY, f64::min);
        assert!(off < 1e-12, "{}: {off:e}", facet.name);
    }
}

fn refused(tier: &str) -> (usize, MeetError, String) {
    match tried(&format!("{SQUARE}{tier}")).expect_err("refused") {
        error @ DocumentError::Meet { .. } => {
            let text = error.to_string();
            assert!(!text.contains('\n'), "{text}");
            let DocumentError::Meet { number, cause, .. } = error else { unreachable!() };
            (number, cause, text)
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_tier_that_cannot_be_cut_is_named_with_the_reason() {
    let with = |angle: &str, rule: &str| {
        format!("[[tier]]\nname = \"crown\"\nindices = [0]\nrepeat = 4\n{angle}\n{rule}\n")
    };
    let at = "angle = 40.0";
    for (tier, word) in [
        (with(at, r#"meets = "girdle@0 & girdle@24 & culet""#), "'culet'"),
        (with(at, r#"meets = "girdle@0 & girdle@24 & girdle@13""#), "girdle@13"),
        (with(at, r#"meets = "girdle@0 & girdle & level""#), "4 facets"),
        (with(at, r#"meets = "girdle@0 & girdle@24""#), "needs three"),
        (with(at, r#"meets = "girdle@0 & girdle@48 & level""#), "do not meet"),
        (with(at, r#"meets = "pavilion@0 & pavilion@24 & girdle@48""#), "cuts it away"),
        (with(at, r#"meets = "girdle@0 & girdle@24 & level & pavilion@48""#), "miss it by"),
        (with("", r#"meets = "girdle@0 & girdle@24 & level""#), "needs an angle"),
        (
            with(at, r#"meets = ["girdle@0 & girdle@24 & level", "girdle@48 & girdle@24 & level"]"#),
            "two corners",
        ),
        (
            with("", r#"meets = ["girdle@0 & girdle@24 & level", "girdle@0 & girdle@72 & level"]"#),
            "passes through both",
        ),
        (with(at, "table = 0.5"), "horizontal"),
        (with(at, "width = 2"), "vertical"),
        (with("angle = -0.0", "table = 1.5"), "1.5000 W"),
    ] {
        let (number, _, text) = refused(&tier);
        assert_eq!(number, 4, "{text}");
        assert!(text.starts_with("tier 4 (crown): ") && text.contains(word), "{word}: {text}");
    }
    let early = tried("[[tier]]\nname = \"table\"\nangle = 0.0\nindices = [0]\ntable = 0.5\n")
        .expect_err("no girdle");
    assert!(early.to_string().contains("no girdle"), "{early}");
    for (rule, word) in [
        ("", "need a distance"),
        ("distance = 1\ntable = 0.5", "two rules"),
        ("distance = 1\ngirdle = 0.1", "girdle needs meets"),
    ] {
        let error = tried(&format!("{SQUARE}{}", with(at, rule))).expect_err("refused").to_string();
        assert!(error.contains(word), "{error}");
    }
}
