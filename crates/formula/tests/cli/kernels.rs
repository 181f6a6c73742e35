//! The kernel of a table in a file: fitted, and searched for.

use std::fs;

use crate::common;
use crate::kernel_support;

use common::{lobefit, stderr};
use kernel_support::{WIDTHS, phong, write};

#[test]
fn a_fit_takes_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "mine.json", &phong(&WIDTHS));
    fs::write(
        folder.path().join("f.wgsl"),
        "override k: f32 = 1.0;\nfn f(alpha: f32, rho: f32) -> f32 { return min(1.0, k * rho * alpha); }",
    )
    .expect("a file");
    let fit =
        ["fit", "f.wgsl", "--to", "parallax-alpha", "--fix", "kernel=mine.json", "--json", "--norm", "rms"];
    let output = lobefit(folder.path(), &fit, b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json = String::from_utf8(output.stdout).expect("text");
    assert!(json.contains("phong@") && json.contains("kernel=mine.json"), "{json}");
}

/// Functions that a search finds for a table are named by its name.
#[test]
fn a_search_takes_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "mine.json", &phong(&WIDTHS));
    let fix = ["--fix", "kernel=mine.json", "--max-ops", "3", "--width", "1", "--helpers", "none"];
    let output =
        lobefit(folder.path(), &[&["fit", "--search", "--to", "parallax-alpha"], &fix[..]].concat(), b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let told = String::from_utf8(output.stdout).expect("text");
    assert!(told.contains("parallax_alpha_alpha_adjusted_parallax_phong_"), "{told}");
}
