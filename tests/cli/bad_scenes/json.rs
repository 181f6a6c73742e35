//! What is not text, or not JSON.

use super::{Case, case, material, refused, top};

fn utf16(text: &str) -> Vec<u8> {
    text.encode_utf16().flat_map(u16::to_le_bytes).collect()
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
        case("hello", "scene.json:1:1: expected a value: a number such as 0.9"),
        case("{", "the file ends inside an object"),
        case(&top("\"name\":\"n\"")[..30], "the file ends inside"),
        case(top("\"name\":\"n"), "the file ends inside a string"),
        case(top("\"name\":\"n\"") + " {}", "the object has ended before this: is there a bracket too many?"),
        case(top("\"name\":\"n\"") + "\n,", "scene.json:2:1: the object has ended before this"),
        case(top("\"name\":\"n\","), "trailing comma"),
        case("{'schema_version':1}", "scene.json:1:2: object keys must be strings in double quotes"),
        case(material("3:4"), "materials[0]: object keys must be strings in double quotes"),
        case(
            "// a comment\n{}",
            "scene.json:1:1: `//` begins a comment; a scene is strict JSON, without comments: delete it",
        ),
        case(top("\"name\":\"n\"") + "\n  /* note */", "scene.json:2:3: `/*` begins a comment"),
        case("# note\n{}", "scene.json:1:1: `#` begins a comment"),
        // In a string they are text.
        case(top("\"name\":\"# // /*\",\"x\":1"), "unknown field `x`"),
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

#[test]
fn what_is_not_json_is_refused() {
    refused(not_json());
}
