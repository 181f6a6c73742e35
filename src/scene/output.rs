//! What is written of what the materials and probes call for.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::value::{List, Word};
use crate::data::{Arguments, Pick};
use lobefit_shade::code::Language;

/// What a bake writes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Output {
    /// Which approximations the include files hold.
    pub pick: Pick,
    /// How their functions take the width of the lobe.
    pub arguments: Arguments,
    /// Languages of the include files, each once, in the order of [`Language::ALL`].
    #[serde(serialize_with = "names")]
    pub languages: Vec<Language>,
    /// Whether pages and their data are written.
    pub reports: bool,
}

impl Default for Output {
    fn default() -> Self {
        Output {
            pick: Pick::default(),
            arguments: Arguments::default(),
            languages: Language::ALL.to_vec(),
            reports: true,
        }
    }
}

impl Output {
    /// Whether nothing of it was asked for: the hash of such a scene does not know of it.
    pub fn is_default(&self) -> bool {
        *self == Output::default()
    }
}

fn names<S: Serializer>(languages: &[Language], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(languages.iter().map(|language| language.name()))
}

/// A language by its name.
pub(super) struct LanguageName(Language);

impl<'de> Deserialize<'de> for LanguageName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = <Cow<str>>::deserialize(deserializer)?;
        let names: Vec<String> = Language::ALL.iter().map(|l| format!("`{}`", l.name())).collect();
        let unknown = || format!("unknown language `{name}`, expected one of {}", names.join(", "));
        Language::parse(&name).map(LanguageName).ok_or_else(unknown).map_err(serde::de::Error::custom)
    }
}

impl JsonSchema for LanguageName {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Language".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = Language::ALL.iter().map(|language| language.name()).collect();
        json_schema!({ "type": "string", "enum": names })
    }
}

/// The languages in their order; a list that is empty or names one twice is refused.
pub(super) fn languages(given: Option<List<Word<LanguageName>, 6>>) -> Result<Vec<Language>, String> {
    let Some(List(words)) = given else { return Ok(Language::ALL.to_vec()) };
    if words.is_empty() {
        return Err("the list is empty; leave the field out for all".into());
    }
    for (i, Word(LanguageName(language))) in words.iter().enumerate() {
        if words[..i].iter().any(|Word(other)| other.0 == *language) {
            return Err(format!("`{}` is there twice", language.name()));
        }
    }
    Ok(Language::ALL.into_iter().filter(|language| words.iter().any(|Word(w)| w.0 == *language)).collect())
}
