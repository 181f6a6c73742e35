//! Tables that say themselves what they are: the statement is read, held against the truth, and found out if it is not so.

mod common;

use common::{lobefit, stderr};
use lobefit::audit::{AuditError, Column, Declared, Shipped, declared};
use lobefit::effects::Quantity;
use lobefit::foreign::{ForeignTable, Hints, read_table};

const DFG: &[u8] = include_bytes!("../tables/ggx-dfg-correlated-32x32.exr");
const SPLIT: &[u8] = include_bytes!("../tables/ggx-dfg-correlated-64x64-split-sum.exr");

fn read(bytes: &[u8]) -> ForeignTable {
    read_table(bytes, "own.exr", &Hints::default()).unwrap().remove(0)
}

fn run(bytes: &[u8], wanted: Option<Column>) -> Declared {
    let table = read(bytes);
    let found =
        declared(&Shipped::from(&table), Quantity::find("ggx-reflection").unwrap(), wanted, &table.note)
            .unwrap();
    eprintln!("{}", found.verdict);
    found
}

/// The bytes with one text for another as long.
fn patched(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let at = bytes.windows(from.len()).position(|w| w == from.as_bytes()).expect("the text is there");
    let mut out = bytes.to_vec();
    out[at..at + to.len()].copy_from_slice(to.as_bytes());
    out
}

#[test]
fn a_table_is_what_it_says() {
    let found = run(DFG, None);
    assert!(found.holds() && found.worst() > 1e-4, "{}", found.worst());
    assert!(found.worst() <= 1.02 * found.claimed, "{} claims {}", found.worst(), found.claimed);
    assert!(found.verdict.contains("says what it is") && found.verdict.contains("sqrt(mu * (1 + alpha)"));
    assert!(found.passes(Some(1e-3)) && !found.passes(Some(1e-5)));
    let split = run(SPLIT, None);
    let columns: Vec<Column> = split.held.iter().map(|h| h.column).collect();
    assert_eq!(columns, [Column::E, Column::B, Column::A]);
    assert!(split.holds(), "{} claims {}", split.worst(), split.claimed);
    assert_eq!(run(SPLIT, Some(Column::B)).held.len(), 1);
}

#[test]
fn a_lie_is_found_out() {
    let smith = run(&patched(DFG, "smith: correlated;", "smith: separable ;"), None);
    assert!(
        !smith.holds() && smith.instead.as_deref() == Some("height-correlated Smith"),
        "{:?}",
        smith.instead
    );
    assert!(smith.verdict.contains("it is not so"), "{}", smith.verdict);
    let warp = run(&patched(DFG, "(1 + alpha) / (mu + alpha)", "(1 + 0.500) / (mu + 0.500)"), None);
    assert!(!warp.holds() && warp.instead.is_none() && warp.worst() > 0.01, "{}", warp.worst());
    let decode = run(&patched(DFG, "decode: E = 1 - loss", "decode: E = 0 + loss"), None);
    assert!(decode.worst() > 0.5);
    let claim = run(&patched(DFG, "max 0.000691,", "max 0.000091,"), None);
    assert!(!claim.holds(), "an error that is claimed too small is a lie");
}

#[test]
fn a_statement_that_cannot_be_followed_is_named() {
    let refused = |bytes: &[u8], quantity: &str| {
        let table = read(bytes);
        declared(&Shipped::from(&table), Quantity::find(quantity).unwrap(), None, &table.note).unwrap_err()
    };
    let other = refused(DFG, "ggx-glass");
    assert!(
        matches!(&other, AuditError::Option { reason, .. } if reason.contains("ggx-reflection")),
        "{other:?}"
    );
    for (from, to, told) in [
        ("32 texels", "16 texels", "texels"),
        ("sqrt(mu *", "sqrt(nu *", "no value"),
        ("sqrt(mu *", "sqxt(mu *", "sqxt"),
        ("decode:", "decade:", "decode"),
        ("domain:", "domane:", "domain"),
    ] {
        let error = refused(&patched(DFG, from, to), "ggx-reflection");
        assert!(
            matches!(&error, AuditError::Statement { reason, .. } if reason.contains(told)),
            "{from}: {error:?}"
        );
    }
}

#[test]
fn the_command_line_reads_it_unless_told_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("own.exr", DFG);
    write("lie.exr", &patched(DFG, "smith: correlated;", "smith: separable ;"));
    write("odd.exr", &patched(DFG, "sqrt(mu *", "sqxt(mu *"));
    let with = |file: &str, more: &[&str]| {
        let all = [&["audit", file, "--as", "ggx-reflection"], more].concat();
        let output = lobefit(folder.path(), &all, b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let (code, out, err) = with("own.exr", &["--limit", "0.001", "--out", "report"]);
    assert!(code == Some(0) && out.contains("is so") && err.is_empty(), "{code:?} {out} {err}");
    let (code, _, err) = with("own.exr", &["--limit", "0.0001"]);
    assert!(code == Some(1) && err.contains("the limit 1e-4"), "{err}");
    let (code, out, err) = with("lie.exr", &[]);
    assert!(
        code == Some(1) && out.contains("Without its statement") && err.contains("not what it says"),
        "{out} {err}"
    );
    let (code, out, err) = with("odd.exr", &[]);
    assert!(code == Some(0) && !out.contains("says what it is") && err.contains("sqxt"), "{out} {err}");
    let (_, out, _) = with("own.exr", &["--registration", "endpoint"]);
    assert!(!out.contains("says what it is"), "{out}");
    let (code, _, err) = with("own.exr", &["--limit", "1"]);
    assert_eq!(code, Some(0), "{err}");
}
