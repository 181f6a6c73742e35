//! JSON that is no scene.

use super::{Case, case, refused, top};

/// JSON, and not a scene.
fn not_a_scene() -> Vec<Case> {
    vec![
        case("null", "scene.json:1:4: invalid type: null, expected an object that describes a scene"),
        case("[]", "expected an object that describes a scene"),
        case("[1,\"n\"]", "expected an object that describes a scene"),
        case("3", "expected an object that describes a scene"),
        case("{}", "missing field `schema_version`"),
        case("{\"schema_version\":1}", "missing field `materials`"),
        case("{\"schema_version\":2,\"materials\":[]}", "schema_version: 2 is outside"),
        case("{\"schema_version\":\"1\",\"materials\":[]}", "schema_version: invalid type: string"),
        case("{\"schema_version\":1.5,\"materials\":[]}", "schema_version: invalid type: floating point"),
        case("{\"schema_version\":-1,\"materials\":[]}", "schema_version: -1 is outside"),
        case(top("\"materials\":[]"), "duplicate field `materials`"),
        case(top("\"n\\u0061me\":\"a\",\"name\":\"b\""), "duplicate field `name`"),
        case(top("\"Name\":\"a\""), "unknown field `Name`"),
        case(top("\"na\\u001b[2Jme\":1"), "unknown field `na\\u{1b}[2Jme`"),
        case(top("\"na\\u001fme\":1"), "unknown field `na\\u{1f}me`"),
        case(top("\"name\":null"), "name: invalid type: null, expected a name in quotes"),
        case(top("\"name\":\"\""), "name: the name is empty"),
        case(top("\"name\":\"  \""), "name: the name is empty"),
        case(top("\"name\":\"a\\nb\""), "name: the name holds the control character \\u{a}"),
        case(top("\"name\":\"\\u0000\""), "name: the name holds the control character \\u{0}"),
        case(
            top("\"smith\":\"Correlated\""),
            "smith: unknown variant `Correlated`, expected `correlated` or `separable`",
        ),
        case(top("\"smith\":{\"correlated\":null}"), "smith: invalid type: map"),
        case(top("\"alpha\":2"), "alpha: invalid type: integer `2`, expected a word in quotes"),
        case(top("\"alpha\":\"roughness^3\""), "alpha: unknown variant `roughness^3`"),
        case(top("\"mu\":0.5"), "mu: invalid type: floating point `0.5`, expected a list of 2 numbers"),
        case(top("\"mu\":[0,1]"), "mu[0]: 0 is outside [0.0001, 1]"),
        case(top("\"mu\":[0.5,0.5]"), ": mu: the range is a single cosine"),
        case(top("\"mu\":[0.5,0.4]"), "mu: the range [0.5, 0.4] is upside down"),
        case(top("\"mu\":[0.5]"), "mu: 1 number where 2 are called for"),
        case(top("\"mu\":[0.1,0.5,1]"), "mu: more than 2 numbers"),
        case("{\"schema_version\":1,\"materials\":{}}", "materials: invalid type: map"),
        case(
            "{\"schema_version\":1,\"materials\":[[\"m\",\"metal\",1]]}",
            "materials[0]: invalid type: sequence",
        ),
    ]
}

#[test]
fn what_is_not_a_scene_is_refused() {
    refused(not_a_scene());
}
