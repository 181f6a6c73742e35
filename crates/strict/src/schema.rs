//! What each kind of value takes, as JSON Schema.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value;

use super::limits;
use super::number::{In, Interval, Numbers, Span, Whole};
use super::value::{List, Maybe, Text, Word};

impl<T: JsonSchema> JsonSchema for Maybe<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<T: JsonSchema> JsonSchema for Word<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

impl<R> JsonSchema for Text<R> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Text".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "minLength": 1, "maxLength": limits::STRING_BYTES })
    }
}

impl<T: JsonSchema, const MAX: usize> JsonSchema for List<T, MAX> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "List".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items: Value = generator.subschema_for::<T>().into();
        json_schema!({ "type": "array", "items": items, "maxItems": MAX })
    }
}

impl<I: Interval> JsonSchema for In<I> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let minimum = if I::OPEN { "exclusiveMinimum" } else { "minimum" };
        json_schema!({ "type": "number", minimum: I::MIN, "maximum": I::MAX })
    }
}

impl<I: Interval> JsonSchema for Whole<I> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Whole".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": I::MIN as i64, "maximum": I::MAX as i64 })
    }
}

impl<T: JsonSchema, const N: usize, const ONE: bool> JsonSchema for Numbers<T, N, ONE> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Numbers".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one: Value = generator.subschema_for::<T>().into();
        let list = json_schema!({ "type": "array", "items": one.clone(), "minItems": N, "maxItems": N });
        if ONE { json_schema!({ "anyOf": [one, Value::from(list)] }) } else { list }
    }
}

impl<I: Interval, const ONE: bool> JsonSchema for Span<I, ONE> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Span".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Numbers::<In<I>, 2, ONE>::json_schema(generator)
    }
}
