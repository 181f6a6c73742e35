//! The files that a manifest lists. Nothing else of it is kept, for anybody may have written it.

use std::collections::BTreeSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// Every string under a key `file`, and in the lists under a key `files`.
///
/// # Errors
/// What is no manifest of a bake, in words.
pub(super) fn listed(bytes: &[u8]) -> Result<BTreeSet<String>, String> {
    let mut found = Found::default();
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let walked = Walk { found: &mut found, under: Under::Nothing }.deserialize(&mut json);
    walked.and_then(|()| json.end()).map_err(|e| e.to_string())?;
    if found.is_bake { Ok(found.files) } else { Err("it lists no tables, fits or includes".into()) }
}

#[derive(Default)]
struct Found {
    files: BTreeSet<String>,
    /// Whether it has one of the lists that every bake has.
    is_bake: bool,
}

/// Where a value stands.
#[derive(Clone, Copy, PartialEq)]
enum Under {
    /// It is the whole.
    Nothing,
    /// Under a key of the whole that names a list of every bake.
    List,
    /// Under the key `file`, or in a list under `files`.
    File,
    /// Under the key `files`.
    Files,
    /// Elsewhere.
    Other,
}

/// Looks through a value.
struct Walk<'a> {
    found: &'a mut Found,
    under: Under,
}

impl<'de> DeserializeSeed<'de> for Walk<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Walk<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<(), E> {
        Ok(())
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<(), E> {
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Ok(())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        if self.under == Under::File {
            self.found.files.insert(text.to_owned());
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        self.found.is_bake |= self.under == Under::List;
        let under = if self.under == Under::Files { Under::File } else { Under::Other };
        while list.next_element_seed(Walk { found: self.found, under })?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            let under = match key.as_str() {
                "tables" | "fits" | "includes" if self.under == Under::Nothing => Under::List,
                "file" => Under::File,
                "files" => Under::Files,
                _ => Under::Other,
            };
            map.next_value_seed(Walk { found: self.found, under })?;
        }
        Ok(())
    }
}
