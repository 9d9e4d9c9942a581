//! Local stand-in until branch `formats` lands.
use super::FormatError;
use crate::cut::{Design, library};
pub struct Imported {
    pub design: Design,
    pub format: &'static str,
    pub warnings: Vec<String>,
}
pub fn open(spec: &str) -> Result<Imported, FormatError> {
    let (name, own) = spec.split_once(':').unwrap_or((spec, ""));
    let mut over = std::collections::BTreeMap::new();
    for item in own.split(',').filter(|s| !s.is_empty()) {
        let (k, v) = item.split_once('=').unwrap_or((item, "nan"));
        over.insert(k.to_string(), v.parse().unwrap_or(f64::NAN));
    }
    match library::design(name, &over) {
        Some(Ok(design)) => Ok(Imported { design, format: "library", warnings: vec![] }),
        Some(Err(e)) => Err(FormatError(e.to_string())),
        None => Err(FormatError(format!("no cut '{name}', nearest {}", library::nearest(name)))),
    }
}
