//! Probes whose kernel is a table in a file: from the scene to emitted code, in `eval`, and files
//! that are refused.

use std::fs;
use std::path::Path;

use crate::common;
use crate::kernel_support;

use common::{lobefit, names, stderr};
use kernel_support::{WIDTHS, phong, write};
use serde_json::{Value, json};

fn scene(kernel: &str) -> Value {
    json!({"schema_version": 1, "pick": "all", "materials": [], "probes": [
        {"name": "hall", "kernel": kernel, "roughness": [0.2, 1], "rho": [0.125, 2], "max_ops": 9, "norms": ["max"],
         "lookups": [{}]},
        {"name": "foyer", "max_ops": 9, "norms": ["max"]}]})
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The example is what it says: cos^n to its digits.
#[test]
fn the_example_is_a_power_of_the_cosine() {
    let file: Value = serde_json::from_str(include_str!("../../examples/kernels/phong.json")).expect("JSON");
    for lobe in file["lobes"].as_array().expect("lobes") {
        let number = |value: &Value| value.as_f64().expect("a number");
        let alpha = number(&lobe["alpha"]);
        let power = 0.5 / (alpha * alpha) - 0.5;
        let pairs = lobe["theta"]
            .as_array()
            .expect("angles")
            .iter()
            .zip(lobe["density"].as_array().expect("densities"));
        for (theta, density) in pairs.map(|(theta, density)| (number(theta), number(density))) {
            let cosine = lobefit_math::ops::pow(lobefit_math::ops::cos(theta), power);
            assert!(
                (density - cosine).abs() <= 1e-5 * cosine + 1e-300,
                "{alpha}, {theta}: {density} {cosine}"
            );
        }
    }
}

/// The fits, functions and heads of a bake name the table; the same bake follows wherever the files
/// lie, and another table is another bake.
#[test]
fn a_table_is_baked_under_its_name_and_hash() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("kernels")).expect("a folder");
    write(folder.path(), "kernels/mine.json", &phong(&WIDTHS));
    write(folder.path(), "scene.json", &scene("kernels/mine.json"));
    let bake =
        |extra: &[&str]| lobefit(folder.path(), &[&["bake", "scene.json", "--quiet"], extra].concat(), b"");
    let output = bake(&["--out", "out"]);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let manifest: Value =
        serde_json::from_str(&text(folder.path(), "out/manifest.json")).expect("a manifest");
    let word = manifest["lookups"][0]["kernel"].as_str().expect("a word");
    assert!(word.starts_with("phong@") && word.len() == "phong@".len() + 12, "{word}");
    assert_eq!(manifest["lookups"][0]["function"], "parallax_phong_lookup_box_smooth_1");
    let kernels: Vec<&str> =
        manifest["fits"].as_array().expect("fits").iter().filter_map(|fit| fit["kernel"].as_str()).collect();
    assert!(kernels.contains(&word) && kernels.contains(&"half-cosine"), "{kernels:?}");
    let code = text(folder.path(), "out/fits/lobefit.wgsl");
    assert!(code.contains("fn parallax_phong_lookup_box_smooth_1("), "{code}");
    assert!(
        code.contains(&format!("for chains prefiltered with the {word} lobe tabulated at 6 widths, blake3 "))
    );
    let page = text(folder.path(), "out/reports/parallax.html");
    assert!(page.contains("phong chains"), "the page tells the kernel");

    fs::create_dir(folder.path().join("elsewhere")).expect("a folder");
    write(folder.path(), "elsewhere/same.json", &phong(&WIDTHS));
    write(folder.path(), "elsewhere/scene.json", &scene("same.json"));
    let checked = lobefit(folder.path(), &["check", "elsewhere/scene.json", "--against", "out"], b"");
    assert_eq!(checked.status.code(), Some(0), "{}", String::from_utf8_lossy(&checked.stdout));
    let planned = || {
        let output = lobefit(folder.path(), &["plan", "elsewhere/scene.json"], b"");
        String::from_utf8(output.stdout).expect("text")
    };
    assert!(planned().contains(word), "{}", planned());
    write(folder.path(), "elsewhere/same.json", &phong(&[0.04, 0.1, 0.2, 0.4, 0.66, 1.0]));
    assert!(planned().contains("phong@") && !planned().contains(word), "{}", planned());
}

#[test]
fn eval_takes_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "mine.json", &phong(&WIDTHS));
    let points = "alpha,rho\n0.2,1\n0.2,0.5\n0.5,4\n";
    let eval = |arguments: &[&str], points: &str| {
        lobefit(
            folder.path(),
            &[&["eval", "parallax-alpha", "--points", "-"], arguments].concat(),
            points.as_bytes(),
        )
    };
    let output = eval(&["--kernel", "mine.json"], points);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let csv = String::from_utf8(output.stdout).expect("text");
    let rows: Vec<Vec<f64>> = csv
        .lines()
        .skip(1)
        .map(|row| row.split(',').map(|x| x.parse().expect("a number")).collect())
        .collect();
    assert!((rows[0][2] - 0.2).abs() < 1e-4 && rows[1][2] > 0.09 && rows[1][2] < 0.11, "{csv}");
    assert_eq!(rows[2][2..5], [1.0, rows[2][3], 1.0], "{csv}");
    // the word of a formula for all points is the column of it
    let [option, column] =
        [eval(&["--kernel", "ndf"], "alpha,rho\n0.3,0.5\n"), eval(&[], "alpha,rho,kernel\n0.3,0.5,ndf\n")]
            .map(|output| String::from_utf8(output.stdout).expect("text"));
    assert_eq!(
        option.lines().nth(1).map(|row| row.replacen("0.5,", "0.5,ndf,", 1)).as_deref(),
        column.lines().nth(1)
    );
}

#[test]
fn kernels_that_are_no_kernels_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "scene.json", &scene("mine.json"));
    let with = |change: &dyn Fn(&mut Value)| {
        let mut file = phong(&WIDTHS);
        change(&mut file);
        file.to_string()
    };
    let set = |pointer: &'static str, value: Value| {
        with(&move |file| *file.pointer_mut(pointer).expect("a place") = value.clone())
    };
    for (file, expected) in [
        (String::new(), "mine.json:1:1: the file is empty"),
        ("{}".into(), "missing field `schema_version`"),
        (set("/schema_version", json!(2)), "schema_version: "),
        (set("/name", json!("Mine")), "name: `Mine` is no name for functions"),
        (set("/name", json!("a--b")), "name: `a--b` is no name for functions"),
        (set("/name", json!("half")), "name: `half` is the name of a lobe that has a formula"),
        (set("/lobes", json!([])), "lobes[0]: is missing"),
        (set("/lobes/1/alpha", json!(0)), "lobes[1].alpha: 0 is outside (0, 1]"),
        (set("/lobes/1/alpha", json!(0.03)), "lobes[1].alpha: 0.03 does not follow 0.04; widths rise"),
        (
            set("/lobes/5/alpha", json!(0.9)),
            "lobes[5].alpha: 0.9 is the widest; the last lobe is that of alpha 1",
        ),
        (set("/lobes/2/theta/0", json!(0.001)), "lobes[2].theta: the first angle is 0.001"),
        (set("/lobes/2/theta/4", json!(1.5)), "lobes[2].theta: "),
        (set("/lobes/2/theta/47", json!(1.6)), "lobes[2].theta[47]: 1.6 is outside [0, pi/2], in radians"),
        (set("/lobes/2/theta/1", json!(1e-9)), "lobes[2].theta: 0.000000001 is too close to 0"),
        (set("/lobes/2/theta", json!([0, 1])), "lobes[2].theta: 2 angles where at least 8 are called for"),
        (set("/lobes/3/density", json!([1, 1])), "lobes[3].density: 2 densities at 48 angles"),
        (set("/lobes/3/density/7", json!(-1)), "lobes[3].density[7]: -1 is outside"),
        (set("/lobes/3/density", json!(vec![0; 48])), "lobes[3].density: the lobe's energy is 0e0"),
        (
            set("/lobes/3/density/0", json!(1e31)),
            "lobes[3].density[0]: 10000000000000000000000000000000 is outside [0, 1e30]",
        ),
        (
            with(
                &|file| file["lobes"][3] = json!({"alpha": 0.4, "theta": file["lobes"][1]["theta"], "density": file["lobes"][1]["density"]}),
            ),
            "lobes[3].density: half of the energy is within",
        ),
        (with(&|file| file["lobes"][0]["width"] = json!(1)), "lobes[0].width: unknown field `width`"),
    ] {
        fs::write(folder.path().join("mine.json"), &file).expect("a file");
        let output = lobefit(folder.path(), &["bake", "scene.json", "--out", "out"], b"");
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{file}: {told}");
        assert!(told.contains(expected) && told.contains("mine.json"), "{expected} in {told}");
    }
    assert_eq!(names(folder.path()), ["mine.json", "scene.json"]);
}

#[test]
fn kernels_that_cannot_be_had_are_told_by_field() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "a.json", &phong(&WIDTHS));
    write(folder.path(), "b.json", &phong(&WIDTHS[1..]));
    let probe = |name: &str, kernel: &str, more: &str| {
        format!(r#"{{"name": "{name}", "kernel": "{kernel}", "roughness": [0.2, 1]{more}}}"#)
    };
    for (probes, expected) in [
        (
            probe("p", "phong", ""),
            "probes[0].kernel: `phong` is none of ndf, half and half-cosine, and no path",
        ),
        (probe("p", "../a.json", ""), "probes[0].kernel: `../a.json` holds an empty part"),
        (probe("p", "/a.json", ""), "probes[0].kernel: `/a.json` is an absolute path"),
        (probe("p", "none.json", ""), "probes[0].kernel: "),
        (
            format!("{}, {}", probe("p", "a.json", ""), probe("q", "b.json", "")),
            "probes[1].kernel: the table calls its kernel `phong`, as another one of probes[0] does",
        ),
        (
            probe("p", "a.json", r#", "lookups": [{}, {"taps": 2}]"#),
            "probes[0].lookups[1].taps: 2 fetches: rules of several fetches are fitted for ndf, half and half-cosine chains",
        ),
    ] {
        let scene =
            format!(r#"{{"schema_version": 1, "pick": "all", "materials": [], "probes": [{probes}]}}"#);
        let output = lobefit(folder.path(), &["plan", "-"], scene.as_bytes());
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{probes}: {told}");
        assert!(told.contains(expected), "{expected} in {told}");
    }
    for (arguments, expected) in [
        (
            ["eval", "ggx-average", "--kernel", "ndf"],
            "--kernel: ggx-average has no kernel; parallax-alpha has",
        ),
        (
            ["eval", "parallax-alpha", "--kernel", "phong"],
            "one of ndf, half, half-cosine, or the path of a .json",
        ),
    ] {
        let points: &[u8] =
            if arguments[1] == "ggx-average" { b"alpha\n0.5\n" } else { b"alpha,rho\n0.5,1\n" };
        let output = lobefit(folder.path(), &[&arguments[..], &["--points", "-"]].concat(), points);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
    let output = lobefit(
        folder.path(),
        &["eval", "parallax-alpha", "--kernel", "a.json", "--points", "-"],
        b"alpha,rho,kernel\n0.5,1,ndf\n",
    );
    assert!(stderr(&output).contains("the points have a column `kernel` too"), "{}", stderr(&output));
}
