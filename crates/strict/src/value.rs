//! The kinds of value that a field can hold. Each refuses what it is not while the reader still stands
//! at it, so that the error has the place; each says in the JSON Schema what it takes.

use std::collections::BTreeSet;
use std::fmt;
use std::marker::PhantomData;

use serde::de::value::StrDeserializer;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};

/// Between a field and the message about it, on their way through the reader's errors, which have
/// no place for the first.
const ABOUT: char = '\u{1f}';

/// A message about a field inside of the object that is refused, `lookups[1]`; one about a field
/// inside of that field goes on from there, one about a place in that list without a dot.
pub fn about(field: impl fmt::Display, message: impl fmt::Display) -> String {
    let message = message.to_string();
    let (inner, text) = told(&message);
    let dot = if inner.is_empty() || inner.starts_with('[') { "" } else { "." };
    format!("{field}{dot}{inner}{ABOUT}{text}")
}

/// The field that a message is [`about`], empty for the whole object, and the message. The text of
/// a scene, which a message may hold, names no field.
pub fn told(message: &str) -> (&str, &str) {
    let named = |field: &str| field.chars().all(|c| c.is_ascii_alphanumeric() || "_.[]".contains(c));
    message.split_once(ABOUT).filter(|(field, _)| named(field)).unwrap_or(("", message))
}

/// What a list holds, in the order of its kind.
///
/// # Errors
/// Something that is there twice, with its second place.
pub fn distinct<T: Ord + Copy>(
    given: impl IntoIterator<Item = T>,
    name: impl Fn(T) -> &'static str,
) -> Result<Vec<T>, String> {
    let mut all = BTreeSet::new();
    for (i, one) in given.into_iter().enumerate() {
        if !all.insert(one) {
            return Err(about(format!("[{i}]"), format!("`{}` is there twice", name(one))));
        }
    }
    Ok(all.into_iter().collect())
}

/// An optional field: absent, or a value. `null` is neither.
pub struct Maybe<T>(pub Option<T>);

impl<T> Default for Maybe<T> {
    fn default() -> Self {
        Maybe(None)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Maybe<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(|value| Maybe(Some(value)))
    }
}

/// One of the words of an enum, as a JSON string and nothing else.
pub struct Word<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WordVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for WordVisitor<T> {
            type Value = Word<T>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a word in quotes")
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Word<T>, E> {
                T::deserialize(StrDeserializer::new(text)).map(Word)
            }
        }
        deserializer.deserialize_str(WordVisitor(PhantomData))
    }
}

/// Strings with a rule: what the rule asks for, and the check.
pub trait TextRule {
    /// What a message says is called for.
    const EXPECTED: &'static str;
    /// The check.
    ///
    /// # Errors
    /// What the text breaks.
    fn check(text: &str) -> Result<(), String>;
}

/// A string that follows a rule.
pub struct Text<R>(pub String, PhantomData<R>);

impl<'de, R: TextRule> Deserialize<'de> for Text<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TextVisitor<R>(PhantomData<R>);
        impl<R: TextRule> Visitor<'_> for TextVisitor<R> {
            type Value = Text<R>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(R::EXPECTED)
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Text<R>, E> {
                R::check(text).map_err(E::custom)?;
                Ok(Text(text.to_owned(), PhantomData))
            }
        }
        deserializer.deserialize_str(TextVisitor(PhantomData))
    }
}

/// A list of at most `MAX` values.
pub struct List<T, const MAX: usize>(pub Vec<T>);

impl<'de, T: Deserialize<'de>, const MAX: usize> Deserialize<'de> for List<T, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ListVisitor<T, const MAX: usize>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const MAX: usize> Visitor<'de> for ListVisitor<T, MAX> {
            type Value = List<T, MAX>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "a list in brackets, [...], of at most {MAX} entries")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
                let mut items = Vec::new();
                while items.len() < MAX
                    && let Some(item) = seq.next_element()?
                {
                    items.push(item);
                }
                if items.len() == MAX && seq.next_element::<IgnoredAny>()?.is_some() {
                    return Err(A::Error::custom(format!("more than {MAX} entries")));
                }
                Ok(List(items))
            }
        }
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

/// A deserialiser for structs that takes objects only: serde's derived structs would also take
/// their fields as an array in the order of declaration, which no reader of the scene would see
/// through.
pub struct ObjectOnly<D>(pub D);

impl<'de, D: Deserializer<'de>> Deserializer<'de> for ObjectOnly<D> {
    type Error = D::Error;
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, D::Error> {
        self.0.deserialize_map(visitor)
    }
    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

/// Gives the public type of a scene object the reader and the schema of the struct that mirrors the
/// file.
#[macro_export]
macro_rules! from_file {
    ($public:ty, $file:ty) => {
        impl<'de> serde::Deserialize<'de> for $public {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let file = <$file>::deserialize($crate::value::ObjectOnly(deserializer))?;
                Self::try_from(file).map_err(serde::de::Error::custom)
            }
        }
        impl schemars::JsonSchema for $public {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                <$file>::schema_name()
            }
            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                <$file>::json_schema(generator)
            }
        }
    };
}
pub use crate::from_file;
