//! Materials that contradict themselves.

use super::{Case, GLASS, case, material, refused, roughness, top};

/// A scene, and a material that is none.
fn not_a_material() -> Vec<Case> {
    vec![
        case(material(r#""kind":"metal","f0":1"#), "materials[0]: missing field `roughness`"),
        case(material(r#""f0":1,"roughness":1"#), "materials[0]: missing field `kind`"),
        case(material(r#""kind":"wood","f0":1,"roughness":1"#), "materials[0].kind: unknown variant `wood`"),
        case(material(r#""kind":"metal","roughness":1"#), "materials[0]: a metal needs `f0`"),
        case(
            "{ \"schema_version\": 1, \"materials\": [\n  {\n    \"name\": \"a\", \"kind\": \"metal\",\n    \"roughness\": 1\n  },\n  7]}".to_string(),
            "scene.json:2:3: materials[0]: a metal needs `f0`",
        ),
        case(material(r#""kind":"metal","ior":1.5,"roughness":1"#), "materials[0]: `ior` is for dielectrics"),
        case(
            material(r#""kind":"dielectric","roughness":1"#),
            "materials[0]: a dielectric needs `ior` or `f0`",
        ),
        case(
            material(r#""kind":"dielectric","ior":1.5,"f0":0.04,"roughness":1"#),
            "`ior` and `f0` are both given",
        ),
        case(
            material(r#""kind":"dielectric","ior":1,"roughness":1"#),
            "materials[0].ior: 1 is outside (1, 4], where a dielectric's lies",
        ),
        case(
            material(r#""kind":"dielectric","ior":4.0000001,"roughness":1"#),
            "materials[0].ior: 4.0000001 is outside [1, 4], of glass [1, 3]",
        ),
        case(
            material(r#""kind":"metal","f0":[1,1],"roughness":1"#),
            "materials[0].f0: 2 numbers where 3 are called for",
        ),
        case(
            material(r#""kind":"metal","f0":[1,1,1,1],"roughness":1"#),
            "materials[0].f0: more than 3 numbers",
        ),
        case(
            material(r#""kind":"metal","f0":[1,1.01,1],"roughness":1"#),
            "scene.json:3:39: materials[0].f0[1]: 1.01 is outside [0, 1]",
        ),
        case(
            material(r#""kind":"metal","f0":true,"roughness":1"#),
            "materials[0].f0: invalid type: boolean `true`",
        ),
        case(material(r#""kind":"metal","f0":1,"f0":1,"roughness":1"#), "materials[0]: duplicate field `f0`"),
        case(material(r#""kind":"metal","fo":1,"roughness":1"#), "materials[0].fo: unknown field `fo`"),
        case(material(r#""kind":"metal","f0":1,"rougness":1"#), "`wants`; did you mean `roughness`?"),
        case(
            material(r#""name":"n","kind":"metal","f0":1,"roughness":1"#),
            "materials[0]: duplicate field `name`",
        ),
        case(roughness("[0.5, 1.5]"), "materials[0].roughness[1]: 1.5 is outside [0, 1]"),
        case(roughness("[0.6, 0.5]"), "materials[0].roughness: the range [0.6, 0.5] is upside down"),
        case(roughness("[]"), "materials[0].roughness: 0 numbers where 2 are called for"),
        case(roughness("[0.5]"), "materials[0].roughness: 1 number where 2 are called for"),
        case(roughness("[[0.5]]"), "materials[0].roughness[0]: invalid type: sequence"),
        case(roughness("NaN"), "materials[0].roughness: expected a value: a number such as 0.9"),
        case(roughness("Infinity"), "materials[0].roughness: expected a value: a number such as 0.9"),
        case(roughness("-Infinity"), "materials[0].roughness: invalid number"),
        case(roughness("\"NaN\""), "materials[0].roughness: invalid type: string \"NaN\""),
        case(roughness("1e999"), "materials[0].roughness: number out of range"),
        case(roughness("-1e999"), "materials[0].roughness: number out of range"),
        case(roughness("1e308"), "is outside [0, 1]"),
        case(roughness("-0"), "materials[0].roughness: -0 is negative zero; write 0"),
        case(roughness("-0.0"), "materials[0].roughness: -0 is negative zero; write 0"),
        case(roughness("-1e-999"), "materials[0].roughness: -0 is negative zero; write 0"),
        case(roughness("-1"), "materials[0].roughness: -1 is outside [0, 1]"),
        case(roughness("1.0000000000000002"), "materials[0].roughness: 1.0000000000000002 is outside [0, 1]"),
        case(roughness(".5"), "materials[0].roughness: expected a value: a number such as 0.9"),
        case(roughness("0x1"), "scene.json:3:"),
        case(roughness("01"), "materials[0].roughness: invalid number"),
        case(roughness("null"), "materials[0].roughness: invalid type: null"),
        case(roughness("{\"lo\":0,\"hi\":1}"), "materials[0].roughness: invalid type: map"),
        case(
            roughness("1").replace("}]", "},\n{\"name\":\"m\",\"kind\":\"metal\",\"f0\":1,\"roughness\":1}]"),
            "scene.json:4:11: materials[1].name: `m` is already the name of materials[0]",
        ),
    ]
}

/// Glass, anisotropy and file formats that contradict themselves.
fn not_glass_nor_anisotropic() -> Vec<Case> {
    let dielectric = |ior: &str| material(&format!(r#""kind":"dielectric","ior":{ior},"roughness":1"#));
    let glass = |ior: &str| material(&format!(r#""kind":"glass","ior":{ior},"roughness":1"#));
    let anisotropy =
        |value: &str| material(&format!(r#""kind":"metal","f0":1,"roughness":1,"anisotropy":{value}"#));
    vec![
        case(material(r#""kind":"glass","roughness":1"#), "materials[0]: glass needs `ior`"),
        case(
            material(r#""kind":"glass","f0":0.04,"roughness":1"#),
            "materials[0]: `f0` is for metals and dielectrics; of glass give `ior` alone",
        ),
        case(
            material(r#""kind":"glass","ior":1.5,"f0":0.04,"roughness":1"#),
            "`f0` is for metals and dielectrics",
        ),
        case(glass("3.0000001"), "materials[0].ior: 3.0000001 is outside [1, 3], where that of glass lies"),
        case(glass("[1, 3.5]"), "materials[0].ior: 3.5 is outside [1, 3]"),
        case(glass("[1, 4.5]"), "materials[0].ior[1]: 4.5 is outside [1, 4], of glass [1, 3]"),
        case(glass("0.99"), "materials[0].ior: 0.99 is outside [1, 4], of glass [1, 3]"),
        case(glass("[2, 1]"), "materials[0].ior: the range [2, 1] is upside down"),
        case(dielectric("[1.4, 1.5]"), "materials[0].ior: a dielectric has one index of refraction"),
        case(
            material(&format!(r#"{GLASS},"anisotropy":0.5,"wants":{{"tables":[{{"layout":"optimised"}}]}}"#)),
            "materials[0].wants.tables[0].layout: `optimised` does not know the anisotropy of glass; give `five-axis`",
        ),
        case(
            material(&format!(r#"{GLASS},"coat":{{}}"#)),
            "materials[0]: `coat` is for dielectrics; leave it out of glass",
        ),
        case(
            material(r#""kind":"dielectric","f0":0.04,"roughness":1,"coat":{"ior":3.5}"#),
            "materials[0].coat.ior: 3.5 is outside [1, 3]",
        ),
        case(
            material(r#""kind":"metal","f0":1,"roughness":1,"wants":{"refracted_width":{}}"#),
            "materials[0].wants.refracted_width: it is of glass without anisotropy, which refracts",
        ),
        case(
            material(r#""kind":"metal","f0":1,"roughness":1,"wants":{"widened":{"coat":true}}"#),
            "materials[0].wants.widened.coat: the material has no `coat`",
        ),
        case(
            material(r#""kind":"metal","f0":1,"roughness":1,"wants":{"widened":{"mean_length":0.4}}"#),
            "materials[0].wants.widened.mean_length: 0.4 is outside [0.5, 1]",
        ),
        case(
            material(r#""kind":"metal","f0":1,"roughness":1,"wants":{"widened":{"coat":false}}"#),
            "materials[0].wants.widened: nothing widens the lobe; give `mean_length`, `light_radius` or `\"coat\": true`",
        ),
        case(anisotropy("1.5"), "materials[0].anisotropy: 1.5 is outside [0, 1]"),
        case(anisotropy("-0"), "materials[0].anisotropy: -0 is negative zero"),
        case(anisotropy("-0.5"), "materials[0].anisotropy: -0.5 is outside [0, 1]"),
        case(anisotropy("[0.6, 0.5]"), "materials[0].anisotropy: the range [0.6, 0.5] is upside down"),
        case(anisotropy("[0, 0.5, 1]"), "materials[0].anisotropy: more than 2 numbers"),
        case(anisotropy("null"), "materials[0].anisotropy: invalid type: null"),
        case(top("\"formats\":[]"), ": formats: the list is empty"),
        case(top("\"formats\":\"dds\""), "formats: invalid type: string \"dds\""),
        case(top("\"formats\":[\"dds\",\"dds\"]"), ": formats[1]: `dds` is there twice"),
        case(
            top("\"formats\":[\"tga\"]"),
            "formats[0]: unknown variant `tga`, expected one of `exr`, `dds`, `ktx2`, `npy`, `raw`",
        ),
        case(
            top("\"formats\":[\"exr\",\"dds\",\"ktx2\",\"npy\",\"raw\",\"exr\"]"),
            "formats: more than 5 entries",
        ),
    ]
}

#[test]
fn what_is_not_a_material_is_refused() {
    refused(not_a_material());
}

#[test]
fn what_is_not_glass_nor_anisotropic_is_refused() {
    refused(not_glass_nor_anisotropic());
}
