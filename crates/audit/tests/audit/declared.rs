//! Tables that say themselves what they are: the statement is read, held against the truth, and
//! found out if it is not so.

use crate::common;

use std::sync::Arc;

use common::{lobefit, stderr};
use lobefit_audit::audit::{AuditError, AuditedTable, Column, Declared, declared, stated_quantity};
use lobefit_audit::foreign::{ForeignTable, Hints, read_table};
use lobefit_truth::quantity;

const DFG: &[u8] = include_bytes!("../../../../tables/ggx-dfg-correlated-32x32.exr");
const AZIMUTH: &[u8] = include_bytes!("../../../../tables/ggx-aniso-azimuth-correlated-64x16x16.exr");
const SPLIT: &[u8] = include_bytes!("../../../../tables/ggx-dfg-correlated-64x64-split-sum.exr");

/// The verdict as it is printed.
fn said(found: &Declared) -> String {
    found.verdict(None).to_string()
}

fn read(bytes: &[u8]) -> ForeignTable {
    read_table(bytes, "own.exr", &Hints::default()).unwrap().remove(0)
}

fn run(bytes: &[u8], wanted: Option<Column>) -> Declared {
    let table = read(bytes);
    let found =
        declared(&AuditedTable::from(&table), quantity::find("ggx-reflection").unwrap(), wanted, &table.note)
            .unwrap();
    eprintln!("{}", said(&found));
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
    assert!(said(&found).contains("is what it says") && said(&found).contains("sqrt(mu * (1 + alpha)"));
    assert!(found.passes(Some(1e-3)) && !found.passes(Some(1e-5)));
    let split = run(SPLIT, None);
    let columns: Vec<Column> = split.held.iter().map(|h| h.column).collect();
    assert_eq!(columns, [Column::E, Column::B, Column::A]);
    assert!(split.holds(), "{} claims {}", split.worst(), split.claimed);
    assert_eq!(run(SPLIT, Some(Column::B)).held.len(), 1);
}

#[test]
fn a_table_of_the_azimuth_is_what_it_says() {
    let quantity = quantity::find("ggx-reflection-aniso").unwrap();
    let table = read(AZIMUTH);
    let run = |note: &str| declared(&AuditedTable::from(&table), quantity, None, note);
    let found = run(&table.note).unwrap();
    eprintln!("{}", said(&found));
    assert!(found.holds() && found.size == [64, 16, 16], "{}", said(&found));
    assert!(
        found.worst() > 0.3 * found.claimed && found.worst() <= 1.05 * found.claimed,
        "{}",
        found.worst()
    );
    let names: Vec<&str> = found.places.iter().map(|p| p.0).collect();
    assert_eq!(names, ["mu", "alpha", "anisotropy", "cos2_phi"]);
    assert!(said(&found).contains("cos2_phi 0 to 1"), "{}", said(&found));
    assert!(found.passes(Some(0.005)) && !found.passes(Some(0.001)));
    // The azimuth turned by a quarter, and another power of t.
    let turned = table.note.replace(
        "t = log2(cos2_phi / q + (1 - cos2_phi) * q)",
        "t = log2(cos2_phi * q + (1 - cos2_phi) / q)",
    );
    for lie in [turned, table.note.replace("t * (c1 + t", "t * (c1 - t")] {
        assert!(lie != table.note);
        let found = run(&lie).unwrap();
        assert!(!found.holds() && found.worst() > 0.02, "{}", said(&found));
    }
    let odd = |from: &str, to: &str| run(&table.note.replace(from, to)).unwrap_err().to_string();
    assert!(odd("(t = 0 at anisotropy 0)", "(t at anisotropy 0)").contains("is no exception"));
    assert!(odd("(t = 0 at anisotropy 0)", "").contains("gives NaN"));
}

#[test]
fn a_lie_is_found_out() {
    let smith = run(&patched(DFG, "smith: correlated;", "smith: separable ;"), None);
    assert!(!smith.holds() && said(&smith).contains("it is not so"), "{}", said(&smith));
    let warp = run(&patched(DFG, "(1 + alpha) / (mu + alpha)", "(1 + 0.500) / (mu + 0.500)"), None);
    assert!(!warp.holds() && warp.worst() > 0.01, "{}", warp.worst());
    let decode = run(&patched(DFG, "decode: E = 1 - loss", "decode: E = 0 + loss"), None);
    assert!(decode.worst() > 0.5);
    let claim = run(&patched(DFG, "max 0.0006919,", "max 0.0000909,"), None);
    assert!(!claim.holds(), "an error that is claimed too small is a lie");
}

#[test]
fn a_statement_that_cannot_be_followed_is_named() {
    let refused = |bytes: &[u8], quantity: &str| {
        let table = read(bytes);
        declared(&AuditedTable::from(&table), quantity::find(quantity).unwrap(), None, &table.note)
            .unwrap_err()
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
    write("part.exr", &patched(DFG, "alpha [0.0004, 1]", "alpha [0.2500, 1]"));
    let huge = patched(DFG, "max 0.0006919,", "max 1000.0000,");
    write("huge.exr", &patched(&huge, "decode: E = 1 - loss", "decode: E = 7-9*loss"));
    write("odd.exr", &patched(DFG, "sqrt(mu *", "sqxt(mu *"));
    let with = |file: &str, more: &[&str]| {
        let all = [&["audit", file, "--as", "ggx-reflection"], more].concat();
        let output = lobefit(folder.path(), &all, b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let (code, out, err) = with("own.exr", &["--limit", "0.001", "--out", "report"]);
    assert!(code == Some(0) && out.contains("is what it says") && err.is_empty(), "{code:?} {out} {err}");
    let (code, out, err) = with("own.exr", &["--limit", "0.0001"]);
    assert!(code == Some(1) && out.contains("; the limit is 1e-4") && err.is_empty(), "{out} {err}");
    let (code, out, err) = with("lie.exr", &[]);
    assert!(code == Some(1) && out.contains("is not what it says") && err.is_empty(), "{out} {err}");
    let (code, out, err) = with("huge.exr", &["--limit", "1000"]);
    assert!(code == Some(1) && out.contains("it is not so: no table of this"), "{out} {err}");
    let (code, out, _) = with("part.exr", &["--limit", "1"]);
    assert!(code == Some(0) && out.contains("alpha below 0.25"), "{out}");
    let (code, out, _) = with("part.exr", &["--limit", "0.00069"]);
    let decides = out.lines().next().is_some_and(|line| line.contains(" claims an error of 6.92e-4 at most"));
    assert!(code == Some(1) && decides, "{out}");
    // The fields have the figure of the first line: the claim, or the lookups of what is not what it says.
    for (file, more, figure) in
        [("part.exr", &["--limit", "0.00069"][..], "claim"), ("lie.exr", &[], "lookup")]
    {
        let (_, out, _) = with(file, &[more, &["--json"]].concat());
        let found: serde_json::Value = serde_json::from_str(&out).unwrap();
        let most = format!("{:.2e}", found["max_error"].as_f64().unwrap()).parse::<f64>().unwrap();
        let line = found["verdict"]["headline"].as_str().unwrap();
        let said = if most < 1e-3 { format!("{most:e}") } else { format!("{most}") };
        assert!(found["figure"] == figure && line.contains(&said), "{said}: {line}");
    }
    let (code, out, err) = with("odd.exr", &[]);
    assert!(code == Some(0) && !out.contains("is what it says") && err.is_empty(), "{out} {err}");
    assert!(out.contains("what it says of itself is not followed (") && out.contains("sqxt"), "{out}");
    // Its coordinate is none of those that are tried.
    let (code, out, err) = with("own.exr", &["--registration", "endpoint"]);
    assert!(code == Some(1) && !out.contains("is what it says") && err.is_empty(), "{code:?} {out} {err}");
    // What is asked of texels says nothing of lookups.
    for option in ["--samples", "--points"] {
        let (code, out, err) = with("own.exr", &[option, "64"]);
        assert!(code == Some(2) && out.is_empty(), "{out}");
        assert!(err.contains(option) && err.contains("own.exr says itself how it is looked up"), "{err}");
    }
    let (code, _, err) = with("own.exr", &["--limit", "1"]);
    assert_eq!(code, Some(0), "{err}");
}

/// The 32 x 32 table under its statement with one text for another.
fn restated(pairs: &[(&str, &str)]) -> Result<Declared, AuditError> {
    let table = read(DFG);
    let mut note = table.note.clone();
    for (from, to) in pairs {
        assert!(note.contains(from), "{from}");
        note = note.replace(from, to);
    }
    declared(&AuditedTable::from(&table), quantity::find("ggx-reflection").unwrap(), None, &note)
}

#[test]
fn a_claim_of_any_error_holds_for_nothing() {
    let claim = ("max 0.0006919,", "max 1000,");
    let found = restated(&[claim, ("E = 1 - loss", "E = 7 - 9 * loss")]).unwrap();
    assert!(found.keeps() && !found.holds() && !found.passes(None) && !found.passes(Some(1e4)));
    assert!(said(&found).contains("no table of this quantity is so far off"), "{}", said(&found));
    let modest = restated(&[claim]).unwrap();
    assert!(modest.holds() && modest.passes(Some(1e3)), "{}", said(&modest));
}

#[test]
fn a_limit_is_judged_where_the_file_claims_something_and_the_verdict_says_what_its_axes_cover_beyond() {
    let whole = restated(&[]).unwrap();
    assert!(whole.beyond.is_empty() && whole.cut.is_empty(), "{:?} {:?}", whole.beyond, whole.cut);
    assert!(
        said(&whole).contains("mu 0.001 to 1") && said(&whole).contains("alpha 4e-4 to 1"),
        "{}",
        said(&whole)
    );
    let part = restated(&[("alpha [0.0004, 1], mu [0.001, 1]", "alpha [0.25, 0.5], mu [-1, 1.5]")]).unwrap();
    assert_eq!(part.beyond, ["alpha below 0.25", "alpha above 0.5"]);
    assert_eq!(part.cut, ["mu below 0", "mu above 1"]);
    assert!(said(&part).contains("Its axes cover alpha below 0.25 and alpha above 0.5"), "{}", said(&part));
    let most = part.worst().max(part.claimed);
    assert!(part.passes(Some(most)) && !part.passes(Some(0.99 * most)));
    assert!(!part.passes(Some(0.99 * part.claimed)), "its own claim is a limit too");
}

#[test]
fn statements_that_would_take_for_ever_or_lead_nowhere_are_refused() {
    let many = |n: usize| (0..n).map(|k| format!(", v{k} = v{}", k + 1)).collect::<String>();
    let axis = "u = (roughness - 0.02) / (1 - 0.02)";
    let of_roughness = |text: String| (axis.to_string(), text);
    let decode = |text: &str| ("E = 1 - loss".to_string(), text.to_string());
    let domain = |text: &str| ("alpha [0.0004, 1]".to_string(), text.to_string());
    for ((from, to), told) in [
        (of_roughness(format!("u = roughness{}", many(16))), "more than 16 definitions"),
        (of_roughness(format!("u = v0{}", many(15))), "no value"),
        (of_roughness("u = v, v = u".into()), "no value"),
        (("alpha = roughness^2".into(), "alpha = log2(0 - roughness)".into()), "no value"),
        (decode(&format!("E = 1 - loss{}", many(100_000))), "more than 16 definitions"),
        (decode("E = sqrt(0 - 1 - loss)"), "gives NaN"),
        (decode("E = 1 / (loss - loss)"), "gives inf"),
        (decode("E = s * 0, t = 1"), "names what is not there"),
        (domain("alpha [0.25, 0.25]"), "no range of alpha"),
        (domain("alpha [0.5, 0.25]"), "is no range"),
        (domain("alpha [2, 3]"), "no range of alpha"),
        (domain("alpha [0.25, 0.2500000000000001]"), "no range of alpha"),
        (("roughness in [0.02, 1]".into(), "roughness in [1, 1]".into()), "an axis is"),
    ] {
        let error = restated(&[(&from, &to)]).unwrap_err();
        let named = matches!(&error, AuditError::Statement { reason, .. } if reason.contains(told));
        assert!(named, "{to:.60}: {error:?}");
    }
}

/// One texel of a table of this tool's own that is off shows whole, though no place between the texels
/// shows it.
#[test]
fn a_single_wrong_texel_of_a_table_of_our_own_is_found() {
    let bytes = include_bytes!("../../../../tables/ggx-dfg-correlated-32x32.exr");
    let read = read_table(bytes, "own.exr", &Hints::default()).unwrap().remove(0);
    let mut table = AuditedTable::from(&read);
    let quantity = quantity::find("ggx-reflection").unwrap();
    let sound = declared(&table, quantity, None, &read.note).unwrap();
    assert!(sound.passes(Some(0.002)) && sound.verdict(None).to_string().contains("sampled"));
    Arc::make_mut(&mut table.channels[0].values)[17 * 32 + 9] += 0.003;
    let found = declared(&table, quantity, None, &read.note).unwrap();
    eprintln!("{}", found.verdict(Some(0.002)));
    assert!(found.worst() > 0.0023 && !found.passes(Some(0.002)), "{}", found.worst());
}

/// Formulas of a statement have their values: other ways to write a decoding change nothing.
#[test]
fn formulas_have_their_values() {
    let worst = |decode: &str| restated(&[("E = 1 - loss", decode)]).map(|found| found.worst());
    let own = worst("E = 1 - loss").unwrap();
    for text in [
        "E = -(loss - 1)",
        "E = (1 - loss) * (2^2 - 1^2) / 3",
        "E = l, l = 2 - loss * 1 - 1^4",
        "E = sqrt((1 - loss)^2) + log2(4) - 2 * --1",
    ] {
        let found = worst(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!((found - own).abs() < 1e-12, "{text}: {found}, not {own}");
    }
    let deep = [&"(".repeat(200), &"-".repeat(200), &"1+".repeat(900)].map(|s| s.to_string());
    let bad =
        ["", "loss +", "(loss", "loss)", "exp(loss)", "1.2.3", "loss $ 1", "loss^loss"].map(String::from);
    for text in bad.into_iter().chain(deep) {
        let error = worst(&format!("E = {text}")).unwrap_err();
        assert!(matches!(error, AuditError::Statement { .. }), "{text:.20}: {error:?}");
    }
}

#[test]
fn the_quantity_of_a_statement_is_read_alone() {
    let note = "Generated by lobefit 0.1.0. DO NOT EDIT\nTable base-8x8 of eon-single\nalpha = roughness^2; texels: f16";
    assert_eq!(stated_quantity(note), Ok(Some("eon-single")));
    assert_eq!(stated_quantity(""), Ok(None));
    assert!(stated_quantity("Table of everything").is_err());
    assert!(stated_quantity("nothing").unwrap_err().contains("no line `Table"));
    let without = restated(&[("smith: correlated; alpha = roughness^2; ", "")]).unwrap_err();
    assert!(without.to_string().contains("alpha = "), "{without}");
}
