//! Scenes that are refused: exit code 2, a message with place and field, and nothing written.

use crate::common;

use common::{lobefit, names, stderr};

/// A scene whose only material has these fields beside its name.
fn material(fields: &str) -> String {
    format!("{{\"schema_version\":1,\n\"materials\":[\n{{\"name\":\"m\",{fields}}}]}}")
}

/// A metal with this roughness.
fn roughness(value: &str) -> String {
    material(&format!(r#""kind":"metal","f0":1,"roughness":{value}"#))
}

/// A metal that wants this.
fn wants(value: &str) -> String {
    material(&format!(r#""kind":"metal","f0":1,"roughness":1,"wants":{value}"#))
}

fn table(value: &str) -> String {
    wants(&format!(r#"{{"table":{{{value}}}}}"#))
}

fn fit(value: &str) -> String {
    wants(&format!(r#"{{"fit":{{{value}}}}}"#))
}

/// A scene without materials and with these fields.
fn top(fields: &str) -> String {
    format!(r#"{{"schema_version":1,"materials":[],{fields}}}"#)
}

fn utf16(text: &str) -> Vec<u8> {
    text.encode_utf16().flat_map(u16::to_le_bytes).collect()
}

/// Bytes of a scene, and what the message must hold.
type Case = (Vec<u8>, &'static str);

fn case(text: impl Into<String>, expected: &'static str) -> Case {
    (text.into().into_bytes(), expected)
}

/// Not text, or not JSON.
fn not_json() -> Vec<Case> {
    let with_bom = [b"\xef\xbb\xbf".as_slice(), top("\"name\":\"n\"").as_bytes()].concat();
    let utf16_bom = [b"\xff\xfe".as_slice(), &utf16("{}")].concat();
    vec![
        case("", "scene.json:1:1: the file is empty"),
        case(" \r\n\t", "scene.json:1:1: the file is empty"),
        (with_bom, "scene.json:1:1: the file begins with a byte order mark"),
        (utf16_bom, "scene.json:1:1: the file looks like UTF-16"),
        (utf16("{}"), "scene.json:1:1: the file looks like UTF-16"),
        (b"{\"name\":\n\"\xff\"}".to_vec(), "scene.json:2:2: this byte is not UTF-8"),
        (vec![0; 100], "looks like UTF-16"),
        case("hello", "scene.json:1:1: expected value"),
        case("{", "EOF while parsing"),
        case(&top("\"name\":\"n\"")[..30], "EOF while parsing"),
        case(top("\"name\":\"n"), "EOF while parsing a string"),
        case(top("\"name\":\"n\"") + " {}", "trailing characters"),
        case(top("\"name\":\"n\"") + "\n,", "scene.json:2:1: trailing characters"),
        case(top("\"name\":\"n\","), "trailing comma"),
        case("{'schema_version':1}", "scene.json:1:2: object keys must be strings in double quotes"),
        case(material("3:4"), "materials[0]: object keys must be strings in double quotes"),
        case("// a comment\n{}", "scene.json:1:1: expected value"),
        case("[".repeat(65), "scene.json:1:65: nested deeper than 64 levels"),
        case("[".repeat(100_000), "nested deeper than 64 levels"),
        case(top(&format!("\"x\":{}", "{\"a\":".repeat(100))), "nested deeper than 64 levels"),
        case(top(&format!("\"{}\":1", "k".repeat(4097))), "a string longer than 4096 bytes"),
        case(top("\"name\":\"\\ud800\""), "name: "),
        case(top("\"name\":\"\\udc00x\""), "name: "),
        case(top("\"name\":\"a\nb\""), "name: control character"),
        case(top("\"name\":\"\\q\""), "name: invalid escape"),
    ]
}

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
        case("{\"schema_version\":1.0,\"materials\":[]}", "schema_version: invalid type: floating point"),
        case("{\"schema_version\":-1,\"materials\":[]}", "schema_version: -1 is outside"),
        case(top("\"materials\":[]"), "duplicate field `materials`"),
        case(top("\"n\\u0061me\":\"a\",\"name\":\"b\""), "duplicate field `name`"),
        case(top("\"Name\":\"a\""), "unknown field `Name`"),
        case(top("\"na\\u001b[2Jme\":1"), "unknown field `na\\u{1b}[2Jme`"),
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
        case(top("\"mu\":[0.5,0.5]"), "scene.json: mu: the range is a single cosine"),
        case(top("\"mu\":[0.5,0.4]"), "mu: the range [0.5, 0.4] is upside down"),
        case(top("\"mu\":[0.5]"), "mu: 1 number where 2 are called for"),
        case(top("\"mu\":[0.1,0.5,1]"), "mu: more than 2 numbers"),
        case(top("\"probes\":[{\"name\":\"p\",\"kind\":\"box\"}]"), "probes[0].kind: unknown field `kind`"),
        case(top("\"probes\":[{}]"), "probes[0]: missing field `name`"),
        case(
            top("\"probes\":[{\"name\":\"p\"},{\"name\":\"p\"}]"),
            "probes[1].name: `p` is already the name of probes[0]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"kernel\":\"ggx\"}]"),
            "probes[0].kernel: unknown variant `ggx`",
        ),
        case(top("\"probes\":[{\"name\":\"p\",\"rho\":0}]"), "probes[0].rho: 0 is outside [0.000001, 1000]"),
        case(
            top("\"probes\":[{\"name\":\"p\",\"rho\":[2,1]}]"),
            "probes[0].rho: the range [2, 1] is upside down",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"roughness\":1,\"rho\":[2,4]}]"),
            "probes[0].rho: every fetch is saturated there",
        ),
        case(top("\"probes\":[{\"name\":\"p\",\"norms\":[]}]"), "probes[0]: norms: the list is empty"),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[]}]"),
            "probes[0]: lookups: an empty list; leave the field out where none is wanted",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{},{\"taps\":1}]}]"),
            "probes[0]: lookups[1]: a box with smooth edges, 1 fetch is in the list already",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"taps\":4}]}]"),
            "probes[0].lookups[0].taps: 4 is outside [1, 3]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"kernel\":\"ndf\",\"lookups\":[{},{\"taps\":2}]}]"),
            "probes[0].lookups[1].taps: 2 fetches: rules of several fetches are fitted for half-cosine chains",
        ),
        case(
            top(
                "\"probes\":[{\"name\":\"p\"},{\"name\":\"q\",\"kernel\":\"half\",\"lookups\":[{\"taps\":3}]}]",
            ),
            "probes[1].lookups[0].taps: 3 fetches: rules of several fetches are fitted for half-cosine chains",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"kernel\":\"ndf\",\"lookups\":[{},{\"lobe\":\"fitted\"}]}]"),
            "probes[0].lookups[1].lobe: the lobe is fitted for half-cosine chains, and this probe's is of the kernel `ndf`; give `mirror`",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"lobe\":\"ggx\"}]}]"),
            "probes[0].lookups[0].lobe: unknown variant `ggx`, expected `mirror` or `fitted`",
        ),
        case(
            top(
                "\"probes\":[{\"name\":\"p\",\"lookups\":[{\"lobe\":\"fitted\"},{\"taps\":1,\"lobe\":\"fitted\"}]}]",
            ),
            "probes[0]: lookups[1]: a box with smooth edges, 1 fetch of the fitted lobe is in the list already",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"lookups\":[{\"planes\":3}]}]"),
            "probes[0].lookups[0].planes: 3 is outside [4, 64]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"linear\"}}]"),
            "probes[0].mips: give `map` with `count`, or `levels` alone",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"log\",\"count\":2}}]"),
            "probes[0].mips: count: a logarithmic chain",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"map\":\"linear\",\"count\":17}}]"),
            "probes[0].mips.count: 17 is outside [2, 16]",
        ),
        case(
            top("\"probes\":[{\"name\":\"p\",\"mips\":{\"levels\":[0,0.5,0.5]}}]"),
            "probes[0].mips: levels: 0.5 does not follow 0.5 by 0.0001 or more",
        ),
        case(top("\"probes\":{}"), "probes: invalid type: map"),
        case("{\"schema_version\":1,\"materials\":{}}", "materials: invalid type: map"),
        case(
            "{\"schema_version\":1,\"materials\":[[\"m\",\"metal\",1]]}",
            "materials[0]: invalid type: sequence",
        ),
    ]
}

/// A scene, and a material that is none.
fn not_a_material() -> Vec<Case> {
    vec![
        case(material(r#""kind":"metal","f0":1"#), "materials[0]: missing field `roughness`"),
        case(material(r#""f0":1,"roughness":1"#), "materials[0]: missing field `kind`"),
        case(material(r#""kind":"wood","f0":1,"roughness":1"#), "materials[0].kind: unknown variant `wood`"),
        case(material(r#""kind":"metal","roughness":1"#), "materials[0]: a metal needs `f0`"),
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
            "materials[0]: ior: 1 is outside (1, 4], where a dielectric's lies",
        ),
        case(
            material(r#""kind":"dielectric","ior":4.0000001,"roughness":1"#),
            "materials[0].ior: 4.0000001 is outside [1, 4]",
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
        case(
            material(r#""name":"n","kind":"metal","f0":1,"roughness":1"#),
            "materials[0]: duplicate field `name`",
        ),
        case(roughness("[0.5, 1.5]"), "materials[0].roughness[1]: 1.5 is outside [0, 1]"),
        case(roughness("[0.6, 0.5]"), "materials[0].roughness: the range [0.6, 0.5] is upside down"),
        case(roughness("[]"), "materials[0].roughness: 0 numbers where 2 are called for"),
        case(roughness("[0.5]"), "materials[0].roughness: 1 number where 2 are called for"),
        case(roughness("[[0.5]]"), "materials[0].roughness[0]: invalid type: sequence"),
        case(roughness("NaN"), "materials[0].roughness: expected value"),
        case(roughness("Infinity"), "materials[0].roughness: expected value"),
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
        case(roughness(".5"), "materials[0].roughness: expected value"),
        case(roughness("0x1"), "scene.json:3:"),
        case(roughness("01"), "materials[0].roughness: invalid number"),
        case(roughness("null"), "materials[0].roughness: invalid type: null"),
        case(roughness("{\"lo\":0,\"hi\":1}"), "materials[0].roughness: invalid type: map"),
        case(
            roughness("1").replace("}]", "},\n{\"name\":\"m\",\"kind\":\"metal\",\"f0\":1,\"roughness\":1}]"),
            "scene.json: materials[1].name: `m` is already the name of materials[0]",
        ),
    ]
}

/// Fields of an anisotropic metal and of glass beside their names.
const ANISOTROPIC: &str = r#""kind":"metal","f0":1,"roughness":1,"anisotropy":[0,1]"#;
const GLASS: &str = r#""kind":"glass","ior":1.5,"roughness":1"#;

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
            "materials[0]: `f0` is for metals and dielectrics; give the glass's `ior`",
        ),
        case(
            material(r#""kind":"glass","ior":1.5,"f0":0.04,"roughness":1"#),
            "`f0` is for metals and dielectrics",
        ),
        case(glass("3.0000001"), "materials[0]: ior: 3.0000001 is outside [1, 3], where that of glass lies"),
        case(glass("[1, 3.5]"), "materials[0]: ior: 3.5 is outside [1, 3]"),
        case(glass("[1, 4.5]"), "materials[0].ior[1]: 4.5 is outside [1, 4]"),
        case(glass("0.99"), "materials[0].ior: 0.99 is outside [1, 4]"),
        case(glass("[2, 1]"), "materials[0].ior: the range [2, 1] is upside down"),
        case(dielectric("[1.4, 1.5]"), "materials[0]: ior: a dielectric has one index of refraction"),
        case(
            material(&format!(r#"{GLASS},"anisotropy":0"#)),
            "materials[0]: `anisotropy` is for metals and dielectrics; leave it out of glass",
        ),
        case(anisotropy("1.5"), "materials[0].anisotropy: 1.5 is outside [0, 1]"),
        case(anisotropy("-0"), "materials[0].anisotropy: -0 is negative zero"),
        case(anisotropy("-0.5"), "materials[0].anisotropy: -0.5 is outside [0, 1]"),
        case(anisotropy("[0.6, 0.5]"), "materials[0].anisotropy: the range [0.6, 0.5] is upside down"),
        case(anisotropy("[0, 0.5, 1]"), "materials[0].anisotropy: more than 2 numbers"),
        case(anisotropy("null"), "materials[0].anisotropy: invalid type: null"),
        case(top("\"formats\":[]"), "scene.json: formats: the list is empty"),
        case(top("\"formats\":\"dds\""), "formats: invalid type: string \"dds\""),
        case(top("\"formats\":[\"dds\",\"dds\"]"), "scene.json: formats: `dds` is there twice"),
        case(
            top("\"formats\":[\"ktx2\"]"),
            "formats[0]: unknown variant `ktx2`, expected one of `exr`, `dds`, `npy`, `raw`",
        ),
        case(top("\"formats\":[\"exr\",\"dds\",\"npy\",\"raw\",\"exr\"]"), "formats: more than 4 entries"),
    ]
}

/// Tables of three axes that cannot be made.
fn not_a_volume() -> Vec<Case> {
    let of = |fields: &str, wants: &str| material(&format!(r#"{fields},"wants":{{{wants}}}"#));
    let tables = |fields: &str, tables: &str| of(fields, &format!("\"tables\":{tables}"));
    vec![
        case(
            wants("{\"tables\":[{}]}"),
            "materials[0]: wants.tables: they are for anisotropic materials and for glass; give `anisotropy`, or ask for \
             `wants.table`",
        ),
        case(
            tables(r#""kind":"metal","f0":1,"roughness":1,"anisotropy":0"#, "[{}]"),
            "wants.tables: they are for anisotropic materials and for glass",
        ),
        case(
            of(GLASS, "\"table\":{}"),
            "materials[0]: wants.table: it is of lobes that only reflect; of glass ask for `wants.tables`",
        ),
        case(of(GLASS, "\"fit\":{}"), "materials[0]: wants.fit: it is of lobes that only reflect"),
        case(of(GLASS, "\"fit\":{},\"tables\":[{}]"), "materials[0]: wants.fit: it is of lobes that only"),
        case(
            tables(GLASS, "[{},{\"layout\":\"azimuth\"}]"),
            "materials[0]: wants.tables[1]: layout: `azimuth` is for anisotropic materials",
        ),
        case(
            tables(r#""kind":"glass","ior":[1, 2.5],"roughness":1"#, "[{\"layout\":\"path-tracer\"}]"),
            "materials[0]: wants.tables[0]: the path-tracer layout ends at ior 2, the material's at 2.5",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"path-tracer\",\"size\":[64,64,32]}]"),
            "materials[0].wants.tables[0]: size: the path-tracer layout has its own; leave it out",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"path-tracer\",\"max_error\":1}]"),
            "materials[0].wants.tables[0]: max_error: the error of the path-tracer layout is reported, not chosen",
        ),
        case(tables(ANISOTROPIC, "[]"), "materials[0].wants: tables: the list is empty"),
        case(tables(ANISOTROPIC, "{}"), "materials[0].wants.tables: invalid type: map"),
        case(tables(ANISOTROPIC, "[null]"), "materials[0].wants.tables[0]: invalid type: null"),
        case(tables(ANISOTROPIC, "[[]]"), "materials[0].wants.tables[0]: invalid type: sequence"),
        case(tables(ANISOTROPIC, "[{},{},{},{},{}]"), "materials[0].wants.tables: more than 4 entries"),
        case(
            tables(ANISOTROPIC, "[{},{\"size\":[64,64,32],\"format\":\"f16\"}]"),
            "materials[0]: wants.tables[1]: it has the layout, size and format of wants.tables[0]",
        ),
        case(
            tables(ANISOTROPIC, "[{\"layout\":\"plain\"}]"),
            "wants.tables[0].layout: unknown variant `plain`, expected one of `optimised`, `path-tracer`, `azimuth`",
        ),
        case(
            tables(ANISOTROPIC, "[{\"serves\":\"albedo\"}]"),
            "wants.tables[0].serves: unknown field `serves`, expected one of `layout`, `size`, `format`, `max_error`",
        ),
        case(
            tables(ANISOTROPIC, "[{\"format\":\"bc6h\"}]"),
            "wants.tables[0].format: unknown variant `bc6h`",
        ),
        case(tables(ANISOTROPIC, "[{\"max_error\":0}]"), "wants.tables[0].max_error: 0 is outside (0, 1]"),
        case(
            tables(ANISOTROPIC, "[{\"size\":[64,64]}]"),
            "wants.tables[0].size: 2 numbers where 3 are called for",
        ),
        case(tables(ANISOTROPIC, "[{\"size\":64}]"), "expected a list of 3 numbers in [4, 256]"),
        case(tables(ANISOTROPIC, "[{\"size\":[64,64,3]}]"), "wants.tables[0].size[2]: 3 is outside [4, 256]"),
        case(
            tables(ANISOTROPIC, "[{\"size\":[256,256,256]}]"),
            "materials[0].wants.tables[0]: size: 256x256x256 is more than 4194304 texels",
        ),
    ]
}

/// A material, and wants that cannot be met.
fn not_a_want() -> Vec<Case> {
    vec![
        case(wants("{}"), "materials[0].wants: wants neither `table` nor `fit`"),
        case(wants("null"), "materials[0].wants: invalid type: null"),
        case(wants("[]"), "materials[0].wants: invalid type: sequence"),
        case(wants("\"both\""), "materials[0].wants: invalid type: string \"both\""),
        case(wants("{\"table\":null}"), "materials[0].wants.table: invalid type: null"),
        case(wants("{\"table\":true}"), "materials[0].wants.table: invalid type: boolean"),
        case(wants("{\"texture\":{}}"), "unknown field `texture`, expected one of `table`, `fit`, `tables`"),
        case(wants("{\"fit\":{},\"fit\":{}}"), "duplicate field `fit`"),
        case(
            table("\"size\":32"),
            "wants.table.size: invalid type: integer `32`, expected a list of 2 numbers in [2, 1024]",
        ),
        case(table("\"size\":[32]"), "wants.table.size: 1 number where 2 are called for"),
        case(table("\"size\":[0,32]"), "wants.table.size[0]: 0 is outside [2, 1024]"),
        case(table("\"size\":[32,1]"), "wants.table.size[1]: 1 is outside [2, 1024]"),
        case(table("\"size\":[32,1025]"), "wants.table.size[1]: 1025 is outside [2, 1024]"),
        case(table("\"size\":[-1,32]"), "wants.table.size[0]: -1 is outside [2, 1024]"),
        case(
            table("\"size\":[9223372036854775808,32]"),
            "wants.table.size[0]: 9223372036854775808 is outside [2, 1024]",
        ),
        case(table("\"size\":[1e3,32]"), "wants.table.size[0]: invalid type: floating point"),
        case(
            table("\"size\":[99999999999999999999999,32]"),
            "wants.table.size[0]: invalid type: floating point",
        ),
        case(table("\"size\":[\"32\",\"32\"]"), "wants.table.size[0]: invalid type: string"),
        case(
            table("\"format\":\"f64\""),
            "wants.table.format: unknown variant `f64`, expected `f16` or `f32`",
        ),
        case(table("\"layout\":\"cubic\""), "wants.table.layout: unknown variant `cubic`"),
        case(
            table("\"serves\":\"E\""),
            "wants.table.serves: unknown variant `E`, expected `albedo` or `split-sum`",
        ),
        case(table("\"max_error\":0"), "wants.table.max_error: 0 is outside (0, 1]"),
        case(table("\"max_error\":\"1e-3\""), "wants.table.max_error: invalid type: string"),
        case(table("\"size\":[32,32],\"size\":[32,32]"), "wants.table: duplicate field `size`"),
        case(fit("\"max_ops\":0"), "wants.fit.max_ops: 0 is outside [1, 1000]"),
        case(fit("\"max_ops\":1001"), "wants.fit.max_ops: 1001 is outside [1, 1000]"),
        case(fit("\"max_ops\":4294967297"), "wants.fit.max_ops: 4294967297 is outside [1, 1000]"),
        case(fit("\"norms\":[]"), "wants.fit: norms: the list is empty"),
        case(fit("\"norms\":[\"max\",\"max\"]"), "wants.fit: norms: `max` is there twice"),
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

fn refused(cases: Vec<Case>) {
    let folder = tempfile::tempdir().unwrap();
    for (bytes, expected) in cases {
        std::fs::write(folder.path().join("scene.json"), &bytes).unwrap();
        let output = lobefit(folder.path(), &["bake", "scene.json", "--out", "out"], b"");
        let message = stderr(&output);
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).into_owned();
        assert_eq!(output.status.code(), Some(2), "{start}\n{message}");
        assert!(message.starts_with("error: "), "{start}\n{message}");
        assert!(message.contains(expected), "{start}\nexpected: {expected}\nfound: {message}");
        assert!(message.trim_end().chars().all(|c| !c.is_control()), "{message:?}");
        assert!(message.contains("scene.json") || message.contains("none.wgsl"), "{message}");
        assert!(output.stdout.is_empty(), "{start}");
        assert_eq!(names(folder.path()), ["scene.json"], "{start}");
    }
}

#[test]
fn what_is_not_json_is_refused() {
    refused(not_json());
}

#[test]
fn what_is_not_a_scene_is_refused() {
    refused(not_a_scene());
}

#[test]
fn what_is_not_a_material_is_refused() {
    refused(not_a_material());
}

#[test]
fn what_is_not_glass_nor_anisotropic_is_refused() {
    refused(not_glass_nor_anisotropic());
}

#[test]
fn tables_of_three_axes_that_cannot_be_made_are_refused() {
    refused(not_a_volume());
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

#[test]
fn endless_and_oversized_scenes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["plan", "-"], &vec![b' '; (16 << 20) + 1]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("<stdin>: larger than 16777216 bytes"), "{}", stderr(&output));
    if cfg!(target_os = "linux") {
        let output = lobefit(folder.path(), &["plan", "/dev/zero"], b"");
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("/dev/zero: larger than 16777216 bytes"), "{}", stderr(&output));
    }
}
