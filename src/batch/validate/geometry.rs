//! Angles, heights, ratios and volumes of stones.

use super::context::{cut, material};
use super::stones::brilliant;
use super::{Check, CheckError, Figure, FigureSource, Measured, SourceKind, TRACER};
use crate::design::{Design, proportions};
use crate::formats;
use crate::parallel;

const SUBJECT: &str = "geometry";

const FORMULA: FigureSource =
    FigureSource { kind: SourceKind::Derived, name: "closed formulas of the round brilliant" };
const DIAMCALC: FigureSource =
    FigureSource { kind: SourceKind::Published, name: "DiamCalc values on PriceScope" };
const IDEAL: FigureSource =
    FigureSource { kind: SourceKind::Published, name: "gemcad.blogspot.com, 2015-08-04" };
const GUILD: FigureSource = FigureSource { kind: SourceKind::Published, name: "usfacetersguild.org" };

/// Two decimals are printed of most figures.
const ROUNDING: f64 = 0.005;

/// Table, crown, pavilion, star, lower half; then star, upper and lower half angle.
const ANGLES: [([f64; 5], [f64; 3], FigureSource, f64); 4] = [
    ([56.0, 34.0, 40.5, 50.0, 75.0], [21.50, 40.44, 41.76], FORMULA, ROUNDING),
    ([53.0, 34.5, 40.75, 50.0, 75.0], [23.07, 40.58, 42.01], FORMULA, ROUNDING),
    ([57.0, 34.5, 40.8, 50.0, 77.0], [21.43, 41.11, 41.99], FORMULA, ROUNDING),
    ([56.0, 34.0, 41.0, 54.8, 76.8], [22.493, 41.20, 42.20], IDEAL, 0.01),
];

const KEYS: [&str; 5] = ["table", "crown-angle", "pavilion-angle", "star", "lower-half"];
const TIERS: [&str; 3] = ["star", "upper half", "lower half"];

/// T/W, P/W, C/W, Vol/W³; three decimals are printed, four of one volume.
const RATIOS: [(&str, [f64; 4], FigureSource); 3] = [
    ("ideal-brilliant", [0.560, 0.443, 0.157, 0.206], IDEAL),
    ("classic", [0.516, 0.466, 0.218, 0.236], GUILD),
    ("first-stone", [0.546, 0.435, 0.121, 0.1865], GUILD),
];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = ANGLES.into_iter().map(angles).collect();
    checks.extend([(41.15, 42.24), (41.25, 42.34)].map(|(pavilion, lower)| {
        let name = format!("lower half of 56/35/{pavilion}, ℓ 80");
        let figure = Figure::near(name, DIAMCALC, lower, ROUNDING).unit("°");
        Check::new(SUBJECT, vec![figure], move |_| {
            let stone =
                brilliant(&[("crown-angle", 35.0), ("pavilion-angle", pavilion), ("lower-half", 80.0)])?;
            Ok(Measured::exact([angle(&stone, "lower half")?]))
        })
    }));
    checks.push(heights());
    checks.extend(RATIOS.into_iter().map(ratios));
    checks.push(counts());
    checks.push(corpus());
    checks
}

/// Angle of a tier from the girdle plane, in degrees, as the finished solid has it.
fn angle(design: &Design, tier: &str) -> Result<f64, CheckError> {
    let unknown = || CheckError::Unknown(tier.into());
    let name = format!("{tier} 1");
    let number = design.facets().position(|f| f.name == name).ok_or_else(unknown)?;
    let solid = design.solid()?;
    let face = solid.faces.iter().position(|f| f.plane == number).ok_or_else(unknown)?;
    let n = solid.area_vector(face);
    Ok(n.truncate().length().atan2(n.z.abs()).to_degrees())
}

fn angles((given, expected, source, tolerance): ([f64; 5], [f64; 3], FigureSource, f64)) -> Check {
    let [table, crown, pavilion, ..] = given;
    let figure = |(tier, expected)| {
        let name = format!("{tier} angle of {table}/{crown}/{pavilion}");
        Figure::near(name, source, expected, tolerance).unit("°")
    };
    Check::new(SUBJECT, TIERS.into_iter().zip(expected).map(figure).collect(), move |_| {
        let stone = brilliant(&std::array::from_fn::<_, 5, _>(|i| (KEYS[i], given[i])))?;
        let angles: Result<Vec<f64>, CheckError> = TIERS.iter().map(|t| angle(&stone, t)).collect();
        Ok(Measured::exact(angles?))
    })
}

fn heights() -> Check {
    // R (1 − cos 11.25°) (tan upper half + tan lower half), of a diameter of 100
    let dip = 50.0
        * (1.0 - 11.25f64.to_radians().cos())
        * (40.44f64.to_radians().tan() + 41.76f64.to_radians().tan());
    let figures = vec![
        Figure::near("crown height of the reference", FORMULA, 14.84, ROUNDING).unit("%"),
        Figure::near("pavilion depth of the reference", FORMULA, 42.70, ROUNDING).unit("%"),
        Figure::near("depth of the reference", FORMULA, 60.54, ROUNDING).unit("%"),
        Figure::near("girdle at the valleys of the reference", FORMULA, 3.0 - dip, 1e-3).unit("%"),
        Figure::near("volume of the reference over its diameter cubed", TRACER, 0.2085, 5e-5),
        Figure::near("weight of the reference at 6.5 mm", TRACER, 1.008, 5e-4).unit("ct"),
    ];
    Check::new(SUBJECT, figures, |_| {
        let stone = brilliant(&[])?.sized(6.5)?;
        let p = proportions::of_design(&stone)?;
        let solid = stone.solid()?;
        // the flats at the valleys are the lowest: halves above and below are level with them
        let upright = (0..solid.faces.len()).filter(|&f| solid.area_vector(f).normalize().z.abs() < 1e-9);
        let extent = |f: usize| {
            let range = |(lo, hi): (f64, f64), z: f64| (lo.min(z), hi.max(z));
            let (lo, hi) = solid.polygon(f).map(|v| v.z).fold((f64::INFINITY, f64::NEG_INFINITY), range);
            hi - lo
        };
        let valley = upright.map(extent).fold(f64::INFINITY, f64::min);
        let carats = material("diamond")?.carats(p.volume).unwrap_or(f64::NAN);
        Ok(Measured::exact([
            p.crown_height_percent,
            p.pavilion_depth_percent,
            p.depth_percent,
            100.0 * valley / p.width,
            p.volume / p.width.powi(3),
            carats,
        ]))
    })
}

fn ratios((name, expected, source): (&'static str, [f64; 4], FigureSource)) -> Check {
    let figure = |(ratio, value): (&str, f64)| {
        let tolerance = if value == 0.1865 { 5e-5 } else { 5e-4 };
        Figure::near(format!("{ratio} of {name}"), source, value, tolerance)
    };
    let figures = ["T/W", "P/W", "C/W", "Vol/W³"].into_iter().zip(expected).map(figure).collect();
    Check::new(SUBJECT, figures, move |_| {
        let p = proportions::of_design(&cut(name)?)?;
        let r = &p.ratios;
        Ok(Measured::exact([r.t_w.unwrap_or(f64::NAN), r.p_w, r.c_w, p.volume / r.w.powi(3)]))
    })
}

fn counts() -> Check {
    const MAKEUP: FigureSource =
        FigureSource { kind: SourceKind::Derived, name: "33 + 24 facets, girdle and culet" };
    type GivenKeys = &'static [(&'static str, f64)];
    const ROWS: [(&str, GivenKeys, f64); 3] = [
        ("with a girdle of 96", &[], 153.0),
        ("with a girdle of 96 and a culet", &[("culet", 2.0)], 154.0),
        ("with a girdle of 16", &[("girdle-facets", 16.0)], 73.0),
    ];
    let figure = |(name, _, count)| Figure::near(format!("facets {name}"), MAKEUP, count, 0.0);
    Check::new(SUBJECT, ROWS.map(figure).into(), |_| {
        let count = |(_, given, _): (_, GivenKeys, _)| Ok(brilliant(given)?.solid()?.faces.len() as f64);
        Ok(Measured::exact(ROWS.into_iter().map(count).collect::<Result<Vec<_>, CheckError>>()?))
    })
}

/// Every closed design of the corpus against the volume that an independent program found.
fn corpus() -> Check {
    const OTHER: FigureSource = FigureSource {
        kind: SourceKind::CrossChecked,
        name: "independent half-space program (geometry.csv)",
    };
    let figure = |name| Figure::near(name, OTHER, 0.0, 0.0);
    let figures = vec![
        figure("closed corpus designs that could not be read"),
        figure("closed corpus designs whose volume is off by more than 1e-6"),
    ];
    Check::new(SUBJECT, figures, |lab| {
        let table = lab.file("geometry.csv")?;
        let folder = table.parent().unwrap_or(&table).to_path_buf();
        let missing = |e: csv::Error| CheckError::Missing(e.to_string());
        let mut rows = csv::ReaderBuilder::new().flexible(true).from_path(&table).map_err(missing)?;
        let heads = rows.headers().map_err(missing)?.clone();
        let column = |name: &str| heads.iter().position(|h| h == name).unwrap_or(usize::MAX);
        let [file, closed, volume] = ["file", "closed", "volume"].map(column);
        let known: Vec<(String, f64)> = rows
            .records()
            .filter_map(Result::ok)
            .filter(|row| row.get(closed) == Some("1"))
            .filter_map(|row| Some((row.get(file)?.to_string(), row.get(volume)?.parse().ok()?)))
            .collect();
        let volume = |name: &str| {
            let read = formats::read_content(&folder.join(name), lab.limits).ok()?.into_design().ok()?;
            Some(read.design.solid().ok()?.volume())
        };
        let volumes = parallel::map(known.len(), |i| (volume(&known[i].0), known[i].1));
        if volumes.is_empty() {
            return Err(CheckError::Missing("geometry.csv lists no closed design".into()));
        }
        let unread = volumes.iter().filter(|(v, _)| v.is_none()).count();
        let off = volumes.iter().filter(|(v, k)| v.is_some_and(|v| (v / k - 1.0).abs() > 1e-6)).count();
        Ok(Measured::exact([unread, off].map(|n| n as f64)))
    })
}
