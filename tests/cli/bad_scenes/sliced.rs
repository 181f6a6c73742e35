//! Tables of three axes that cannot be made.

use super::{ANISOTROPIC, Case, GLASS, case, material, refused, wants};

/// Tables of three axes that cannot be made.
fn not_a_sliced_table() -> Vec<Case> {
    let of = |fields: &str, wants: &str| material(&format!(r#"{fields},"wants":{{{wants}}}"#));
    let tables = |fields: &str, tables: &str| of(fields, &format!("\"tables\":{tables}"));
    let exact = |tables: &str| {
        of(
            r#""kind":"dielectric","ior":1.5,"roughness":1"#,
            &format!(r#""exact_fresnel":{{"tables":{tables}}}"#),
        )
    };
    vec![
        case(
            wants("{\"tables\":[{\"layout\":\"optimised\"}]}"),
            "materials[0].wants.tables[0].layout: `optimised` is for anisotropic materials and for glass; give `anisotropy`, or \
             one of `homogeneous`, `plain`, `plain-squared`",
        ),
        case(
            tables(r#""kind":"metal","f0":1,"roughness":1,"anisotropy":0"#, "[{\"layout\":\"azimuth\"}]"),
            "wants.tables[0].layout: `azimuth` is for anisotropic materials; give `anisotropy`",
        ),
        case(
            tables(GLASS, "[{\"layout\":\"plain\"}]"),
            "materials[0].wants.tables[0].layout: `plain` is of lobes that only reflect; of glass give `optimised`",
        ),
        case(
            of(GLASS, "\"fit\":{\"blend\":true}"),
            "materials[0].wants.fit.blend: it is of lobes that only reflect",
        ),
        case(
            of(GLASS, "\"fit\":{\"average\":true},\"tables\":[{}]"),
            "materials[0].wants.fit.average: it is of",
        ),
        case(
            of(&format!("{GLASS},\"anisotropy\":0.5"), "\"fit\":{}"),
            "materials[0].wants.fit: of anisotropic glass there are tables alone",
        ),
        case(
            of(&format!("{GLASS},\"distribution\":\"beckmann\""), "\"fit\":{\"blend\":true}"),
            "materials[0].wants.fit.blend: it is of lobes that only reflect",
        ),
        case(
            tables(GLASS, "[{},{\"layout\":\"azimuth\"}]"),
            "materials[0].wants.tables[1].layout: `azimuth` is for anisotropic materials",
        ),
        case(
            tables(r#""kind":"glass","ior":[1, 2.5],"roughness":1"#, "[{\"layout\":\"path-tracer\"}]"),
            "materials[0].wants.tables[0]: the path-tracer layout ends at ior 2, the material's at 2.5",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"path-tracer\",\"size\":[64,64,32]}]"),
            "materials[0].wants.tables[0].size: the path-tracer layout has its own; leave it out",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"path-tracer\",\"max_error\":1}]"),
            "materials[0].wants.tables[0].max_error: the error of the path-tracer layout is reported, not chosen",
        ),
        case(tables(ANISOTROPIC, "[]"), "materials[0].wants.tables: the list is empty"),
        case(tables(ANISOTROPIC, "{}"), "materials[0].wants.tables: invalid type: map"),
        case(tables(ANISOTROPIC, "[null]"), "materials[0].wants.tables[0]: invalid type: null"),
        case(tables(ANISOTROPIC, "[[]]"), "materials[0].wants.tables[0]: invalid type: sequence"),
        case(tables(ANISOTROPIC, "[{},{},{},{},{}]"), "materials[0].wants.tables: more than 4 entries"),
        case(
            tables(ANISOTROPIC, "[{},{\"size\":[64,64,32],\"format\":\"f16\"}]"),
            "materials[0].wants.tables[1]: it has the layout, size, format and use of wants.tables[0]",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"cubic\"}]"),
            "wants.tables[0].layout: unknown variant `cubic`, expected one of `homogeneous`, `plain`, `plain-squared`",
        ),
        case(
            tables(ANISOTROPIC, "[{\"serves\":\"split-sum\"}]"),
            "wants.tables[0].serves: the optimised layout serves the albedo; for `split-sum` give `homogeneous`",
        ),
        case(
            tables(ANISOTROPIC, "[{\"format\":\"bc6h\"}]"),
            "wants.tables[0].format: unknown variant `bc6h`",
        ),
        case(tables(ANISOTROPIC, "[{\"max_error\":0}]"), "wants.tables[0].max_error: 0 is outside (0, 1]"),
        case(
            tables(r#""kind":"glass","ior":[1.3,1.5],"roughness":1"#, "[{\"size\":[64,64]}]"),
            "materials[0].wants.tables[0].size: 2 numbers where the optimised layout has 3 axes: an axis less is for one \
             value of `ior`, which is 1.3 to 1.5 of the materials and coats that call for it",
        ),
        case(
            tables(ANISOTROPIC, "[{\"size\":[64,3]}]"),
            "materials[0].wants.tables[0].size[1]: 3 is outside [4, 256]",
        ),
        case(
            tables(ANISOTROPIC, "[{\"size\":[64,64,32,2]}]"),
            "wants.tables[0].size: 4 numbers where the optimised layout has 3 axes",
        ),
        case(
            tables(GLASS, "[{\"layout\":\"dielectric\"}]"),
            "materials[0].wants.tables[0].layout: `dielectric` is of the exact Fresnel term; list it in \
             `wants.exact_fresnel.tables`",
        ),
        case(
            exact("[{\"layout\":\"optimised\"}]"),
            "materials[0].wants.exact_fresnel.tables[0].layout: `optimised` is of other lobes; of the exact Fresnel term \
             give `dielectric`",
        ),
        case(
            exact("[{},{\"format\":\"unorm16\"}]"),
            "materials[0].wants.exact_fresnel.tables[1].format: `unorm16` holds [0, 1], and texels of the dielectric layout are \
             signed",
        ),
        case(
            exact("[{},{}]"),
            "materials[0].wants.exact_fresnel.tables[1]: it has the layout, size, format and use of \
             tables[0]",
        ),
        case(tables(ANISOTROPIC, "[{\"size\":64}]"), "expected a list in brackets, [...], of at most 5"),
        case(tables(ANISOTROPIC, "[{\"size\":[64,64,3]}]"), "wants.tables[0].size[2]: 3 is outside [4, 256]"),
        case(
            tables(ANISOTROPIC, "[{\"size\":[256,256,256]}]"),
            "materials[0].wants.tables[0].size: 256x256x256 is more than 4194304 texels",
        ),
        case(
            tables(GLASS, "[{\"layout\":\"five-axis\"}]"),
            "materials[0].wants.tables[0].layout: `five-axis` is for glass with `anisotropy`",
        ),
        case(
            tables(&format!("{GLASS},\"anisotropy\":0.5"), "[{\"size\":[8,4,16,16,16]}]"),
            "materials[0].wants.tables[0].size: 4096 slices, where a texture has at most 2048",
        ),
    ]
}

#[test]
fn tables_of_three_axes_that_cannot_be_made_are_refused() {
    refused(not_a_sliced_table());
}
