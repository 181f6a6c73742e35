//! Tables and fits that cannot be made.

use super::{Case, case, refused, wants};
use crate::common::{lobefit, stderr};

fn table(value: &str) -> String {
    wants(&format!(r#"{{"tables":[{{{value}}}]}}"#))
}

fn fit(value: &str) -> String {
    wants(&format!(r#"{{"fit":{{{value}}}}}"#))
}

/// A material, and wants that cannot be met.
fn not_a_want() -> Vec<Case> {
    vec![
        case(wants("{}"), "materials[0].wants: wants neither `tables` nor `fit`"),
        case(wants("null"), "materials[0].wants: invalid type: null"),
        case(wants("[]"), "materials[0].wants: invalid type: sequence"),
        case(wants("\"both\""), "materials[0].wants: invalid type: string \"both\""),
        case(wants("{\"tables\":null}"), "materials[0].wants.tables: invalid type: null"),
        case(wants("{\"tables\":true}"), "materials[0].wants.tables: invalid type: boolean"),
        case(
            wants("{\"table\":{\"size\":[32,32]}}"),
            "materials[0].wants.table: the field is now an entry of the list `tables`: write \"tables\": [{ ... }]",
        ),
        case(wants("{\"texture\":{}}"), "unknown field `texture`, expected one of `tables`, `fit`"),
        case(wants("{\"fit\":{},\"fit\":{}}"), "duplicate field `fit`"),
        case(wants("{\"fit\":{\"pick\":\"all\"}}"), "; the scene itself has a field of that name"),
        case(
            table("\"size\":32"),
            "wants.tables[0].size: invalid type: integer `32`, expected a list in brackets, [...], of at most 5 entries",
        ),
        case(
            table("\"size\":[32]"),
            "wants.tables[0].size: 1 number where the homogeneous layout has 2 axes",
        ),
        case(
            table("\"size\":[0,32]"),
            "wants.tables[0].size[0]: 0 is outside [2, 1024] ([4, 256] with a third axis)",
        ),
        case(
            table("\"size\":[32,1]"),
            "wants.tables[0].size[1]: 1 is outside [2, 1024] ([4, 256] with a third axis)",
        ),
        case(
            table("\"size\":[32,1025]"),
            "wants.tables[0].size[1]: 1025 is outside [2, 1024] ([4, 256] with a third axis)",
        ),
        case(
            table("\"size\":[-1,32]"),
            "wants.tables[0].size[0]: -1 is outside [2, 1024] ([4, 256] with a third axis)",
        ),
        case(
            table("\"size\":[9223372036854775808,32]"),
            "wants.tables[0].size[0]: 9223372036854775808 is outside [2, 1024] ([4, 256] with a third axis)",
        ),
        case(table("\"size\":[32.5,32]"), "wants.tables[0].size[0]: invalid type: floating point"),
        case(
            table("\"size\":[99999999999999999999999,32]"),
            "wants.tables[0].size[0]: invalid type: floating point",
        ),
        case(table("\"size\":[\"32\",\"32\"]"), "wants.tables[0].size[0]: invalid type: string"),
        case(
            table("\"format\":\"f64\""),
            "wants.tables[0].format: unknown variant `f64`, expected one of `unorm8`, `unorm16`, `f16`, `f32`",
        ),
        case(table("\"layout\":\"cubic\""), "wants.tables[0].layout: unknown variant `cubic`"),
        case(
            table("\"serves\":\"E\""),
            "wants.tables[0].serves: unknown variant `E`, expected `albedo` or `split-sum`",
        ),
        case(table("\"max_error\":0"), "wants.tables[0].max_error: 0 is outside (0, 1]"),
        case(table("\"max_error\":\"1e-3\""), "wants.tables[0].max_error: invalid type: string"),
        case(table("\"size\":[32,32],\"size\":[32,32]"), "wants.tables[0]: duplicate field `size`"),
        case(fit("\"max_ops\":0"), "wants.fit.max_ops: 0 is outside [1, 1000]"),
        case(fit("\"max_ops\":1001"), "wants.fit.max_ops: 1001 is outside [1, 1000]"),
        case(fit("\"max_ops\":4294967297"), "wants.fit.max_ops: 4294967297 is outside [1, 1000]"),
        case(fit("\"norms\":[]"), "wants.fit.norms: the list is empty"),
        case(fit("\"norms\":[\"max\",\"max\"]"), "wants.fit.norms[1]: `max` is there twice"),
        case(fit("\"norms\":[\"l1\"]"), "wants.fit.norms[0]: unknown variant `l1`, expected `max` or `rms`"),
        case(fit("\"average\":1"), "wants.fit.average: invalid type: integer `1`, expected a boolean"),
        case(
            fit("\"hypotheses\":[\"/etc/x.wgsl\"]"),
            "wants.fit.hypotheses[0]: `/etc/x.wgsl` is an absolute path",
        ),
        case(
            fit("\"hypotheses\":[\"../x.wgsl\"]"),
            "wants.fit.hypotheses[0]: `../x.wgsl` holds an empty part",
        ),
        case(fit("\"hypotheses\":[\"a/./x.wgsl\"]"), "holds an empty part, `.` or `..`"),
        case(fit("\"hypotheses\":[\"a\\\\x.wgsl\"]"), "the path holds \\\\"),
        case(fit("\"hypotheses\":[\"C:x.wgsl\"]"), "the path holds :"),
        case(fit("\"hypotheses\":[\"x\\u0000.wgsl\"]"), "the path holds \\u{0}"),
        case(fit("\"hypotheses\":[\"x.glsl\"]"), "`x.glsl` does not end in .wgsl"),
        case(fit("\"hypotheses\":[\".wgsl\"]"), "`.wgsl` does not end in .wgsl"),
        case(
            fit("\"hypotheses\":[\"none.wgsl\"]"),
            "scene.json: materials[0].wants.fit.hypotheses[0]: none.wgsl: cannot read",
        ),
    ]
}

#[test]
fn wants_that_cannot_be_met_are_refused() {
    refused(not_a_want());
}

#[test]
fn a_hypothesis_that_is_not_text_or_too_large_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.json"), fit("\"hypotheses\":[\"h.wgsl\"]")).unwrap();
    for (bytes, expected) in [
        (b"fn f()\xff".to_vec(), "h.wgsl: byte 6 is not UTF-8"),
        (vec![b' '; (1 << 20) + 1], "h.wgsl: larger than 1048576 bytes"),
    ] {
        std::fs::write(folder.path().join("h.wgsl"), bytes).unwrap();
        let output = lobefit(folder.path(), &["bake", "scene.json", "--out", "out"], b"");
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
}
