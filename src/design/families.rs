//! The catalogue of parametric families, one a file.

mod bipyramid;
mod cushion;
mod facet_summary;
mod family;
pub(super) mod fancy_brilliant;
pub mod heights;
mod marquise;
mod oval;
mod pear;
mod prism;
pub mod round_brilliant;
mod step_cut;

use super::tiers::{Design, FamilyValues};
use crate::parse;
use crate::parse::NumberUnit;
pub use facet_summary::facet_summary;
pub use family::{CutError, Family, Parameter, ParameterValues};
use family::{check_every_facet_stands, whole_number};
use std::collections::BTreeMap;

/// Every family.
pub static FAMILIES: &[&Family] = &[
    &round_brilliant::FAMILY,
    &oval::FAMILY,
    &cushion::FAMILY,
    &marquise::FAMILY,
    &pear::FAMILY,
    &step_cut::FAMILY,
    &prism::FAMILY,
    &bipyramid::FAMILY,
];

/// The family called `name`.
pub fn family(name: &str) -> Result<&'static Family, CutError> {
    FAMILIES.iter().copied().find(|f| parse::is_name(f.name, name)).ok_or_else(|| CutError::UnknownFamily {
        name: name.into(),
        known: FAMILIES.iter().map(|f| f.name).collect(),
    })
}

/// The unit of the parameter or height `key`, which all families have alike.
pub fn parameter_unit(key: &str) -> NumberUnit {
    let mut keys = FAMILIES.iter().flat_map(|f| f.keys());
    keys.find(|p| p.key == key).map_or(NumberUnit::None, |p| NumberUnit::from_sign(p.unit))
}

/// Builds a design of a family from the given values and the defaults of the rest.
///
/// The key `facets` asks for an exact total, which families with a free count (the girdle flats of
/// a brilliant) are fitted to.
pub fn build(name: &str, given: &BTreeMap<String, f64>) -> Result<Design, CutError> {
    build_from(name, &BTreeMap::new(), given)
}

/// As [`build`], with the values of a design file in place of the family's defaults.
///
/// - `own`: the file's values
/// - `given`: what was asked for; a height among them replaces what the file has in its place
pub fn build_from(
    name: &str,
    own: &BTreeMap<String, f64>,
    given: &BTreeMap<String, f64>,
) -> Result<Design, CutError> {
    let family = family(name)?;
    let own = heights::resolved(family, &BTreeMap::new(), own)?;
    let mut given = heights::resolved(family, &own, given)?;
    let Some(asked) = given.remove("facets") else {
        return build_exactly(family, &given);
    };
    let asked = whole_number("facets", asked)?;
    let design = build_exactly(family, &given)?;
    let total = design.solid()?.faces.len();
    if total == asked {
        return Ok(design);
    }
    let fitted = match family.total {
        Some((key, step)) if !given.contains_key(key) => fit_total(family, &given, key, step, total, asked)?,
        _ => design,
    };
    let (counts, nearest) = facet_summary(&fitted)?;
    if nearest == asked {
        return Ok(fitted);
    }
    Err(CutError::Total { name: name.into(), asked, nearest, made_up: counts })
}

/// The design whose count `key` brings the total nearest to `asked`.
fn fit_total(
    family: &'static Family,
    given: &BTreeMap<String, f64>,
    key: &str,
    step: usize,
    total: usize,
    asked: usize,
) -> Result<Design, CutError> {
    let Some(parameter) = family.parameters.iter().find(|p| p.key == key) else {
        return build_exactly(family, given);
    };
    let others = total as f64 - parameter.default;
    let steps = ((asked as f64 - others) / step as f64).round() * step as f64;
    let mut given = given.clone();
    given.insert(key.into(), steps.clamp(parameter.range.0, parameter.range.1));
    build_exactly(family, &given)
}

fn build_exactly(family: &'static Family, given: &BTreeMap<String, f64>) -> Result<Design, CutError> {
    if let Some(key) = given.keys().find(|k| !family.keys().any(|p| p.key == *k)) {
        return Err(CutError::UnknownParameter {
            family: family.name,
            key: key.clone(),
            known: family.keys().map(|p| p.key).collect(),
        });
    }
    let values = family.parameters.iter().map(|p| p.checked(given.get(p.key).copied().unwrap_or(p.default)));
    let values = values.collect::<Result<_, _>>()?;
    let mut design = (family.build)(&ParameterValues { family, values })?;
    design.family = Some(FamilyValues { name: family.name.into(), given: given.clone() });
    Ok(design)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(pairs: &[(&str, f64)]) -> BTreeMap<String, f64> {
        pairs.iter().map(|(k, v)| (k.to_string(), *v)).collect()
    }

    fn facets(pairs: &[(&str, f64)]) -> Result<usize, CutError> {
        Ok(build("round-brilliant", &given(pairs))?.solid()?.faces.len())
    }

    #[test]
    fn totals_are_exact_or_name_the_nearest() {
        assert_eq!(facets(&[]), Ok(153));
        assert_eq!(facets(&[("facets", 153.0)]), Ok(153));
        assert_eq!(facets(&[("facets", 73.0)]), Ok(73));
        assert_eq!(facets(&[("facets", 154.0), ("culet", 1.0)]), Ok(154));
        assert!(matches!(
            facets(&[("facets", 153.0), ("culet", 1.0)]),
            Err(CutError::Total { nearest: 154, .. })
        ));
        assert!(matches!(facets(&[("facets", 58.0)]), Err(CutError::Total { nearest: 73, .. })));
        // without a crown its 33 planes merge into one table
        assert_eq!(facets(&[("crown-angle", 0.0)]), Ok(1 + 24 + 96));
    }

    #[test]
    fn impossible_stones_name_the_bound() {
        for (pairs, word) in [
            (vec![("star", 5.0)], "stars"),
            (vec![("girdle", 1.0)], "girdle"),
            (vec![("girdle-facets", 90.0)], "multiple of 16"),
            (vec![("pavilion-angle", 90.0)], "pavilion-angle"),
            (vec![("table", f64::NAN)], "table"),
            (vec![("tabel", 50.0)], "tabel"),
        ] {
            let error = facets(&pairs).expect_err("impossible").to_string();
            assert!(error.contains(word), "{error}");
            assert!(!error.contains('\n'));
        }
    }
}
