//! What is written of what the materials and probes call for.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::value::{List, Word, distinct};
use crate::data::{Arguments, Pick, Vendor};
use lobefit_shade::code::{Float, Language};

/// What a bake writes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Output {
    /// Which approximations the include files hold.
    pub pick: Pick,
    /// How their functions take the width of the lobe.
    pub arguments: Arguments,
    /// The vendor whose GPUs the emitted formulas are to be cheap on; none: the operation model's.
    pub cost: Option<Vendor>,
    /// The most that a call may cost on them. No field of a file: `lobefit cost --budget` states it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<f64>,
    /// The error that every function is to keep, whatever it is for: `lobefit cost --max-error`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every_error: Option<f64>,
    /// The numbers that emitted formulas compute with.
    #[serde(rename = "precision", serialize_with = "float_name")]
    pub float: Float,
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
            cost: None,
            budget: None,
            every_error: None,
            float: Float::F32,
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

fn float_name<S: Serializer>(float: &Float, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(float.name())
}

fn names<S: Serializer>(languages: &[Language], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(languages.iter().map(|language| language.name()))
}

/// What a scene names by a word of ours.
pub(super) trait Named: Copy + 'static {
    /// What it is, in messages.
    const WHAT: &'static str;
    /// All of them.
    const ALL: &'static [Self];
    /// Its word.
    fn name(self) -> &'static str;
}

impl Named for Language {
    const WHAT: &'static str = "language";
    const ALL: &'static [Language] = &Language::ALL;
    fn name(self) -> &'static str {
        Language::name(self)
    }
}

impl Named for Float {
    const WHAT: &'static str = "precision";
    const ALL: &'static [Float] = &Float::ALL;
    fn name(self) -> &'static str {
        Float::name(self)
    }
}

/// A vendor, or none in particular.
impl Named for Option<Vendor> {
    const WHAT: &'static str = "cost";
    const ALL: &'static [Option<Vendor>] = &[
        None,
        Some(Vendor::Amd),
        Some(Vendor::Intel),
        Some(Vendor::Adreno),
        Some(Vendor::Mali),
        Some(Vendor::Nvidia),
    ];
    fn name(self) -> &'static str {
        self.map_or("neutral", Vendor::word)
    }
}

/// One of them by its word.
pub(super) struct OneOf<T>(pub T);

impl<'de, T: Named> Deserialize<'de> for OneOf<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = <Cow<str>>::deserialize(deserializer)?;
        let names: Vec<String> = T::ALL.iter().map(|one| format!("`{}`", one.name())).collect();
        let unknown = || format!("unknown {} `{word}`, expected one of {}", T::WHAT, names.join(", "));
        let found = T::ALL.iter().find(|one| one.name() == word);
        found.map(|one| OneOf(*one)).ok_or_else(unknown).map_err(serde::de::Error::custom)
    }
}

impl<T: Named> JsonSchema for OneOf<T> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        T::WHAT.into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = T::ALL.iter().map(|one| one.name()).collect();
        json_schema!({ "type": "string", "enum": names })
    }
}

/// The languages in their order; a list that is empty or names one twice is refused.
pub(super) fn languages(given: Option<List<Word<OneOf<Language>>, 6>>) -> Result<Vec<Language>, String> {
    let Some(List(words)) = given else { return Ok(Language::ALL.to_vec()) };
    if words.is_empty() {
        return Err("the list is empty; leave the field out for all".into());
    }
    distinct(words.into_iter().map(|Word(OneOf(language))| language), Language::name)
}
