//! What is said of a text that differs, and of a table's promise.

use lobefit::bake::{Baked, Difference, Kind, Silent, compare};
use lobefit::store::Files;

/// What is said of a file of a bake.
fn different(file: &str, expected: &[u8], found: &[u8]) -> Difference {
    let of = |bytes: &[u8]| Files::from([(file.to_string(), bytes.to_vec())]);
    let baked = Baked { files: of(expected), ..Baked::default() };
    compare(&baked, &of(found), &[], None, &Silent).remove(0)
}

#[test]
fn numbers_differ_by_their_distance() {
    let d = different("a.rs", b"x1 = 0.5;\ny = -2.5e-3\n", b"x1 = 0.5;\ny = -2.25e-3\n");
    assert_eq!(d.at.as_deref(), Some("line 2"));
    assert!((d.max_abs.expect("numbers") - 2.5e-4).abs() < 1e-18, "{d:?}");
    // In an include file code is a constant and a comment is a figure, however far off.
    let of = |file: &str, found: &str| different(file, b"// max 0.5\nx = 1.0f;\n", found.as_bytes());
    let d = of("fits/a.h", "// max 9.5\nx = 1.25f;\n");
    assert_eq!((d.at.as_deref(), d.max_abs), (Some("line 2"), None), "{d:?}");
    assert_eq!(of("fits/a.h", "// max 9.5\nx = 1.0f;\n").max_abs, Some(9.0));
}

#[test]
fn names_and_lines_are_not_numbers() {
    let d = different("a.rs", b"fn q13()\n", b"fn q14()\n");
    assert_eq!(
        (d.max_abs, d.detail.as_str()),
        (None, "line 1: `fn q14()` where the recipe gives `fn q13()`")
    );
    let d = different("a.rs", b"one\ntwo\n", b"one\n");
    assert!(d.detail.contains("(end of file)"), "{d:?}");
    assert!(different("a.rs", b"\xff", b"a").detail.contains("not text"));
}

#[test]
fn line_ends_are_no_lines() {
    for (expected, found, line, words) in [
        ("a\nb\n", "a\nb", 2, "no final newline where the recipe gives LF"),
        ("a\nb", "a\nb\n", 2, "LF where the recipe gives no final newline"),
        ("a\nb\n", "a\r\nb\r\n", 1, "CR LF where the recipe gives LF"),
        ("a 1\nb 2\n", "a 1\nb 2\r\n", 2, "CR LF where the recipe gives LF"),
        ("a\nb\n", "a\nb\r\n", 2, "CR LF where the recipe gives LF"),
    ] {
        let d = different("a.rs", expected.as_bytes(), found.as_bytes());
        assert_eq!(d.detail, format!("line {line}: only line ends differ: {words}"), "{found:?}");
        assert_eq!((d.at.as_deref(), d.max_abs), (Some(format!("line {line}").as_str()), None));
    }
    // A bare CR ends no line; an empty line more is a line.
    let d = different("a.rs", b"a\n", b"a\n\n");
    assert_eq!(d.detail, "line 2: `` where the recipe gives `(end of file)`");
}

#[test]
fn a_promise_is_kept_only_where_it_is_measured() {
    let judged = |measured: Result<f64, String>| {
        let mut difference = Difference::plain("tables/t.exr", Kind::Different, "texels differ");
        difference.judge(0.5, &[], |_| measured.clone());
        difference
    };
    assert_eq!(judged(Ok(0.5)).promise_kept, Some(true));
    for broken in [Ok(0.6), Ok(f64::NAN), Err("a channel is missing".to_string())] {
        let difference = judged(broken.clone());
        assert_eq!(difference.promise_kept, Some(false), "{broken:?}");
    }
    let says = judged(Err("a channel is missing".into())).detail;
    assert!(
        says.ends_with("; promise broken: its lookup cannot be measured: a channel is missing"),
        "{says}"
    );
}
