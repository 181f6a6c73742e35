//! Tables that a terminal or a file has: columns of results, and points that gain columns.

use std::path::{Path, PathBuf};

use lobefit::cli::columns::{Side, lines};
use lobefit::cli::input::load;
use lobefit::cli::options::{SceneOption, TexturesOption, quantity_of as from_name};
use lobefit::cli::points::{Points, shortest};

#[test]
fn columns_are_as_wide_as_their_widest_cell() {
    let rows = [["a name".to_string(), "1".into()], ["\u{b5}".into(), "12345678".into()]];
    let found = lines([("what", Side::Left), ("bytes", Side::Right)], &rows);
    assert_eq!(found, ["what       bytes", "a name         1", "\u{b5}       12345678"]);
    assert!(lines::<1>([("what", Side::Left)], &[]).is_empty());
}

fn parse(text: &str) -> Result<Points, String> {
    let quantity = from_name("ggx-reflection").unwrap();
    Points::parse(text.as_bytes().to_vec(), "p.csv", quantity).map_err(|e| e.to_string())
}

#[test]
fn rows_keep_their_bytes_and_order() {
    let text = "\u{feff}note, mu ,alpha\r\n\"a,\"\"b\",0.50,1\r\n\r\n  x ,1e-3,0.250000000000000001\r\n\"two\nlines\",.5,-0";
    let points = parse(text).unwrap();
    let inputs: Vec<&[f64]> = (0..points.len()).map(|i| points.row(i).inputs).collect();
    assert_eq!(inputs, [[1.0, 0.5], [0.25, 1e-3], [0.0, 0.5]]);
    assert!(inputs[2][0].is_sign_positive());
    let values = [1.0, 0.1, 1e-17, 0.30000000000000004, 0.0].repeat(3);
    let out = points.with_columns(from_name("ggx-reflection").unwrap(), &values).unwrap();
    let tail = ",1,0.1,1e-17,0.30000000000000004,0\n";
    let expected = format!(
        "note, mu ,alpha,E,A,B,loss,error\n\"a,\"\"b\",0.50,1{tail}  x ,1e-3,0.250000000000000001{tail}\"two\nlines\",.5,-0{tail}"
    );
    assert_eq!(String::from_utf8(out).unwrap(), expected);
}

#[test]
fn a_row_can_be_refused_later() {
    let points = parse("alpha,mu\r\n1,1\r\n\r\n0.5,1\r\n").unwrap();
    assert_eq!(points.refuse(1, "no").to_string(), "p.csv:4: row 2: no");
}

#[test]
fn a_header_alone_is_fine() {
    let points = parse("alpha,mu").unwrap();
    let out = points.with_columns(from_name("ggx-reflection").unwrap(), &[]).unwrap();
    assert_eq!(out, b"alpha,mu,E,A,B,loss,error\n");
}

#[test]
fn values_that_are_not_numbers_are_never_printed() {
    let points = parse("alpha,mu\n1,1\n").unwrap();
    let quantity = from_name("ggx-reflection").unwrap();
    for values in [&[][..], &[1.0, f64::NAN, 0.0, 0.0, 0.0], &[1.0]] {
        assert!(points.with_columns(quantity, values).is_err());
    }
}

#[test]
fn errors_name_line_row_and_column() {
    for (text, expected) in [
        ("", "p.csv:1: the file is empty; a header with `alpha` and `mu` is called for"),
        ("\n\n", "p.csv:1: the file is empty; a header with `alpha` and `mu` is called for"),
        ("alpha\n1\n", "p.csv:1: column `mu` is missing, which ggx-reflection needs; the header has `alpha`"),
        ("alpha,mu,alpha\n", "p.csv:1: column `alpha` is there twice"),
        ("alpha,mu,x,x\n", "p.csv:1: column `x` is there twice"),
        ("alpha,mu,E\n", "p.csv:1: column `E` is one that ggx-reflection appends; rename it"),
        ("alpha,mu\n1,1\n\n1\n", "p.csv:4: row 2: 1 fields where the header has 2"),
        ("alpha,mu\n1,1,1\n", "p.csv:2: row 1: 3 fields where the header has 2"),
        ("alpha,mu\r\n1,\r\n", "p.csv:2: row 1: column `mu`: the field is empty"),
        ("alpha,mu\n1,abc\n", "p.csv:2: row 1: column `mu`: `abc` is not a number"),
        ("alpha,mu\n1,NaN\n", "p.csv:2: row 1: column `mu`: `NaN` is not a finite number"),
        ("alpha,mu\ninf,1\n", "p.csv:2: row 1: column `alpha`: `inf` is not a finite number"),
        ("alpha,mu\n1e999,1\n", "p.csv:2: row 1: column `alpha`: `1e999` is not a finite number"),
        ("alpha,mu\n1,1\n1,1.5\n", "p.csv:3: row 2: column `mu`: 1.5 is outside [0, 1]"),
        ("alpha,mu\n-1e-300,1\n", "p.csv:2: row 1: column `alpha`: -1e-300 is outside [0, 1]"),
        ("alpha,mu\n0,5,1\n", "p.csv:2: row 1: 3 fields where the header has 2"),
        ("alpha,mu,n\n1,1,\"x\n1,1,y\n", "p.csv:2: a double quote is not closed"),
        (
            "alpha;mu\n1;1\n",
            "p.csv:1: columns `alpha`, `mu` are missing, which ggx-reflection needs; the header has `alpha;mu`",
        ),
    ] {
        assert_eq!(parse(text).unwrap_err(), expected, "{text:?}");
    }
}

#[test]
fn digits_are_the_shortest_that_read_back() {
    for (x, text) in [
        (1.0, "1"),
        (0.1, "0.1"),
        (1e-7, "1e-7"),
        (1e22, "1e22"),
        (0.0, "0"),
        (0.1 + 0.2, "0.30000000000000004"),
    ] {
        assert_eq!(shortest(x), text);
        assert_eq!(text.parse::<f64>().unwrap(), x);
    }
}

/// The name of a foreign file in the command of a baked file's header.
fn named(file: &Path, textures: bool, quantile: Option<f64>) -> String {
    let option = SceneOption { scene: Some(file.into()), textures: TexturesOption { textures, quantile } };
    load(&option).expect("a scene").scene.made_of.expect("a foreign file")
}

#[test]
fn a_header_names_a_foreign_file_and_stays_a_line() {
    let examples = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples");
    assert_eq!(named(&examples.join("game.glb"), false, None), "game.glb");
    let images = named(&examples.join("gltf/painted.glb"), true, Some(0.01));
    assert_eq!(images, "painted.glb --textures --quantile 0.01");
    let folder = tempfile::tempdir().unwrap();
    let copied = |from: &str, to: &str| {
        let path = folder.path().join(to);
        std::fs::copy(examples.join(from), &path).unwrap();
        named(&path, false, None)
    };
    for hostile in ["a\nb.glb", "-x.glb", "a;b.glb", "a b.glb", "\u{e4}.glb"] {
        assert_eq!(copied("game.glb", hostile), "SCENE.glb");
    }
    assert_eq!(copied("surfaces.mtlx", "-"), "SCENE.mtlx");
}
