//! An entry of a catalogue, as `cutlab list` shows it.

use serde_json::Value;

/// Something to choose.
pub(super) struct CatalogueEntry {
    /// What it is called on the command line.
    pub(super) name: String,
    /// One line about it.
    pub(super) about: String,
    /// Everything about it, for people.
    pub(super) text: String,
    /// Everything about it but its name and the line, as a JSON object.
    pub(super) facts: Value,
}

impl CatalogueEntry {
    /// The entry as a JSON object.
    pub(super) fn json(&self) -> Value {
        let mut all = serde_json::Map::new();
        all.insert("name".into(), self.name.clone().into());
        all.insert("about".into(), self.about.clone().into());
        if let Value::Object(facts) = &self.facts {
            all.extend(facts.clone());
        }
        all.into()
    }
}
