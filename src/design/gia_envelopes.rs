//! Envelopes of proportions within which grading reports put round brilliants.

use super::proportions::Proportions;

/// GIA's cut-grade proportion envelopes for round brilliants: table, crown, pavilion, star, lower
/// half, girdle, crown height, depth, each from and to. Necessary, not sufficient: the joint tables
/// decide, so this is never a grade. Source: GIA's published cut-grade tables as collected in the
/// project's physics notes, §1.
type GradeEnvelope = (&'static str, [(f64, f64); 8]);

const ANY: (f64, f64) = (0.0, 100.0);

static ENVELOPES: &[GradeEnvelope] = &[
    (
        "Excellent",
        [
            (52.0, 62.0),
            (31.5, 36.5),
            (40.6, 41.8),
            (45.0, 65.0),
            (70.0, 85.0),
            (2.5, 4.5),
            (12.5, 17.0),
            (57.5, 63.0),
        ],
    ),
    (
        "Very good",
        [
            (50.0, 66.0),
            (26.5, 38.5),
            (39.8, 42.4),
            (40.0, 70.0),
            (65.0, 90.0),
            (0.0, 5.5),
            (10.5, 18.0),
            (56.0, 64.5),
        ],
    ),
    ("Good", [(47.0, 69.0), (22.0, 40.0), (38.8, 43.0), ANY, ANY, (0.0, 7.5), (9.0, 19.5), (53.0, 66.5)]),
    ("Fair", [(44.0, 72.0), (20.0, 41.5), (37.4, 44.0), ANY, ANY, (0.0, 10.5), (7.0, 21.0), (51.9, 70.9)]),
];

/// The parameters of the round brilliant that an envelope bounds, in the order of its bounds.
const BOUNDED: [&str; 6] = ["table", "crown-angle", "pavilion-angle", "star", "lower-half", "girdle"];

/// What each envelope asks of the parameter `key` of the family round-brilliant: its name, from and
/// to, the narrowest first; nothing for a parameter that none bounds.
pub fn bounds(key: &str) -> impl Iterator<Item = (&'static str, f64, f64)> {
    let at = BOUNDED.iter().position(|k| *k == key);
    ENVELOPES.iter().filter_map(move |(name, bounds)| Some((*name, bounds[at?].0, bounds[at?].1)))
}

/// The narrowest envelope that a round brilliant lies in: `Excellent`, `Very good`, `Good`, `Fair`;
/// none outside all of them, or for another cut.
pub fn envelope(p: &Proportions) -> Option<&'static str> {
    let lengths = p.brilliant?;
    let values = [
        p.table_percent?,
        p.crown_angle_deg?,
        p.pavilion_angle_deg?,
        lengths.star_percent,
        lengths.lower_half_percent,
        p.girdle_percent,
        p.crown_height_percent,
        p.depth_percent,
    ];
    /// A stone made to a bound lies within it whatever digits its file keeps; far below what is graded.
    const LAST_DIGIT: f64 = 1e-3;
    let within =
        |(value, (from, to)): (&f64, &(f64, f64))| (from - LAST_DIGIT..=to + LAST_DIGIT).contains(value);
    ENVELOPES.iter().find(|(_, bounds)| values.iter().zip(bounds).all(within)).map(|(name, _)| *name)
}
