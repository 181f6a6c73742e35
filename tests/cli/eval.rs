//! `lobefit eval` where it succeeds: columns, bytes of the rows, values against closed forms, both
//! methods.

use crate::common;

use std::path::Path;

use common::{lobefit, names, stderr};

/// Output of `eval` on points from standard input; it must succeed and say nothing else.
fn eval(quantity: &str, options: &[&str], points: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        lobefit(folder.path(), &[&["eval", quantity, "--points", "-"], options].concat(), points.as_bytes());
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{options:?} on {points}");
    assert!(names(folder.path()).is_empty());
    String::from_utf8(output.stdout).expect("text")
}

/// The last `n` columns of every row, as numbers.
fn appended(csv: &str, n: usize) -> Vec<Vec<f64>> {
    let number = |text: &str| -> f64 {
        let x: f64 = text.parse().unwrap_or_else(|_| panic!("`{text}` in\n{csv}"));
        assert!(x.is_finite(), "{csv}");
        x
    };
    let columns = |line: &str| -> Vec<f64> {
        let fields: Vec<&str> = line.split(',').collect();
        fields[fields.len() - n..].iter().copied().map(number).collect()
    };
    csv.lines().skip(1).map(columns).collect()
}

/// Cosines from the grazing end to the pole.
const COSINES: [f64; 9] = [0.0, 1e-6, 1e-3, 0.01, 0.1, 0.25, 0.5, 0.9, 1.0];

/// `alpha,mu` rows with alpha = 1 at [`COSINES`].
fn roughest() -> String {
    COSINES.iter().fold("alpha,mu\n".to_string(), |text, mu| format!("{text}1,{mu}\n"))
}

/// ln(x) of the same library that the program uses.
fn ln(x: f64) -> f64 {
    lobefit_math::ops::log(x)
}

/// Rows in need of care: smooth, grazing, in the layer mu ~ alpha, easy.
const POINTS: &str =
    "alpha,mu\n0,0.5\n1e-4,1\n0.001,0.001\n0.04,0.01\n0.25,0.5\n0.5,0.9\n0.7,0.05\n1,1\n0.3,0\n";

#[test]
fn the_columns_of_the_contract_are_appended_in_order() {
    for (quantity, given, columns) in [
        ("ggx-reflection", "alpha,mu", "E,A,B,loss,error"),
        ("ggx-reflection", "mu,alpha", "E,A,B,loss,error"),
        ("ggx-average", "alpha", "E_avg,loss_avg,error"),
    ] {
        let row = given.split(',').map(|_| "0.5").collect::<Vec<_>>().join(",");
        let csv = eval(quantity, &[], &format!("{given}\n{row}\n"));
        let (header, values) = csv.split_once('\n').expect("lines");
        assert_eq!(header, format!("{given},{columns}"));
        assert!(values.starts_with(&format!("{row},")) && values.ends_with('\n'), "{values}");
        assert_eq!(values.trim_end().split(',').count(), header.split(',').count());
    }
    assert_eq!(eval("ggx-average", &[], "alpha\n"), "alpha,E_avg,loss_avg,error\n");
}

#[test]
fn rows_keep_their_text_and_order_and_other_columns_are_kept() {
    let rows = ["\"a, b\",0.50,1e0,", " x ,+.5,0.250,\"2\"", ",1.0,0.9999999999999999999,-"];
    let points = format!("\u{feff}note,mu,alpha,weight\r\n{}\r\n\r\n{}\n{}", rows[0], rows[1], rows[2]);
    let csv = eval("ggx-reflection", &[], &points);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "note,mu,alpha,weight,E,A,B,loss,error");
    assert_eq!(lines.len(), 4, "{csv}");
    let plain = eval("ggx-reflection", &[], "alpha,mu\n1,0.5\n0.25,0.5\n1,1\n");
    for ((line, row), plain) in lines[1..].iter().zip(rows).zip(plain.lines().skip(1)) {
        let tail = line.strip_prefix(row).unwrap_or_else(|| panic!("`{row}` begins\n{line}"));
        assert!(plain.ends_with(tail), "`{tail}` ends\n{plain}");
    }
}

#[test]
fn numbers_have_the_shortest_digits_that_read_back() {
    let csv = eval("ggx-reflection", &[], POINTS);
    for field in csv.lines().skip(1).flat_map(|line| line.split(',').skip(2)) {
        // `{:e}` prints the fewest significant digits that read back.
        let x: f64 = field.parse().expect("a number");
        let digits = |text: &str| -> String {
            let mantissa = text.split('e').next().expect("a mantissa").replace('.', "");
            mantissa.trim_matches('0').to_string()
        };
        assert_eq!(digits(field), digits(&format!("{x:e}")), "{field}");
    }
    assert!(csv.starts_with("alpha,mu,E,A,B,loss,error\n0,0.5,1,0.96875,0.03125,0,"), "{csv}");
}

#[test]
fn the_roughest_lobe_has_its_closed_forms() {
    let csv = eval("ggx-reflection", &[], &roughest());
    for (row, mu) in appended(&csv, 5).iter().zip(COSINES) {
        let [e, a, b, loss, error] = row[..] else { panic!("{row:?}") };
        let exact = if mu == 0.0 { 0.0 } else { mu * ln(1.0 + 1.0 / mu) };
        assert!((loss - exact).abs() <= error.min(1e-6 * exact), "mu {mu}: loss {loss}, not {exact}");
        assert!((e - (1.0 - exact)).abs() <= error, "mu {mu}: E {e}");
        assert!((a + b - e).abs() <= 1e-15 && b >= 0.0, "mu {mu}: A {a} + B {b} = E {e}");
        assert!((0.0..1e-6).contains(&error), "mu {mu}: error {error}");
    }
    let csv = eval("ggx-reflection", &["--smith", "separable"], &roughest());
    for (row, mu) in appended(&csv, 5).iter().zip(COSINES) {
        let exact = 2.0 * (1.0 - ln(2.0)) / (1.0 + mu);
        assert!(
            (row[0] - exact).abs() <= row[4],
            "separable, mu {mu}: E {} where {exact} is called for",
            row[0]
        );
        assert!((row[3] - (1.0 - exact)).abs() <= row[4], "separable, mu {mu}: loss {}", row[3]);
    }
}

#[test]
fn the_averages_have_their_closed_forms() {
    let exact = 4.0 / 3.0 * (1.0 - ln(2.0));
    let rows = appended(&eval("ggx-average", &[], "alpha\n1\n0\n"), 3);
    assert!((rows[0][0] - exact).abs() <= rows[0][2], "{:?}, not {exact}", rows[0]);
    assert!((rows[0][1] - (1.0 - exact)).abs() <= rows[0][2], "{:?}", rows[0]);
    assert_eq!(rows[1][..2], [1.0, 0.0]);
    // 2 int 2 (1 - ln 2)/(1 + mu) mu dmu = 4 (1 - ln 2)^2
    let exact = 4.0 * (1.0 - ln(2.0)) * (1.0 - ln(2.0));
    let rows = appended(&eval("ggx-average", &["--smith", "separable"], "alpha\n1\n"), 3);
    assert!((rows[0][0] - exact).abs() <= rows[0][2], "{:?}, not {exact}", rows[0]);
}

#[test]
fn negative_zero_and_any_line_end_are_read() {
    let values = |csv: &str| appended(csv, 5);
    let csv = eval("ggx-reflection", &[], "alpha,mu\r\n-0,0.5\r\n1,-0.0\r\n");
    assert!(csv.contains("\n-0,0.5,") && csv.contains("\n1,-0.0,") && !csv.contains('\r'), "{csv}");
    assert_eq!(values(&csv), values(&eval("ggx-reflection", &[], "alpha,mu\n0,0.5\n1,0")));
    for text in csv.lines().skip(1).flat_map(|line| line.split(',').skip(2)) {
        assert!(!text.starts_with('-'), "{csv}");
    }
}

#[test]
fn threads_change_no_byte_and_a_file_holds_what_is_printed() {
    let sampled = ["--method", "monte-carlo", "--samples", "4096"];
    // Monte Carlo cannot sample the limits.
    let inner: String = POINTS
        .lines()
        .filter(|l| !l.starts_with("0,") && !l.ends_with(",0"))
        .fold(String::new(), |text, line| text + line + "\n");
    for (method, points) in [(&[][..], POINTS), (&sampled, &inner)] {
        let printed = eval("ggx-reflection", method, points);
        for threads in ["1", "2", "7"] {
            let options = [method, &["--threads", threads]].concat();
            assert_eq!(eval("ggx-reflection", &options, points), printed, "{threads} threads");
        }
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("in.csv"), points).expect("written");
        let arguments = ["eval", "ggx-reflection", "--points", "in.csv", "--out", "out.csv"];
        let output = lobefit(folder.path(), &[&arguments, method].concat(), b"");
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
        assert!(output.stdout.is_empty());
        assert_eq!(names(folder.path()), ["in.csv", "out.csv"]);
        assert_eq!(std::fs::read_to_string(folder.path().join("out.csv")).expect("text"), printed);
    }
}

/// A device would be gone for every other program.
#[cfg(unix)]
#[test]
fn devices_stay_what_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let _socket = std::os::unix::net::UnixListener::bind(at("socket")).expect("a socket");
    std::os::unix::fs::symlink("socket", at("link")).expect("a link");
    for name in ["socket", "link"] {
        let arguments = ["eval", "ggx-reflection", "--points", "-", "--out", name];
        let output = lobefit(folder.path(), &arguments, POINTS.as_bytes());
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(3), "{said}");
        assert!(said.starts_with(&format!("error: {name}: a device is in the way; ")), "{said}");
        assert!(!at(name).symlink_metadata().expect("it is there").is_file(), "{name}");
    }
}

fn refused(folder: &Path, points: &str, options: &[&str], expected: &str) {
    let arguments = ["eval", "ggx-reflection", "--points", "-", "--out", "out.csv"];
    let output = lobefit(folder, &[&arguments, options].concat(), points.as_bytes());
    assert_eq!(output.status.code(), Some(2), "{options:?}: {}", stderr(&output));
    assert!(stderr(&output).contains(expected), "{options:?}: {}", stderr(&output));
    assert!(output.stdout.is_empty() && names(folder).is_empty(), "{options:?}");
}

#[test]
fn a_tolerance_that_cannot_be_met_is_exit_2_with_the_row() {
    let folder = tempfile::tempdir().expect("a folder");
    // The limit alpha = 0 is exact; the second row is not.
    let points = "alpha,mu,note\n0,1,exact\n\n0.5,0.5,x\n";
    refused(folder.path(), points, &["--tolerance", "1e-300"], "<stdin>:4: row 2: ");
    let sampled = ["--method", "monte-carlo", "--samples", "1024", "--tolerance", "1e-12"];
    let points = "alpha,mu\n0.5,0.5\n";
    refused(folder.path(), points, &sampled, "<stdin>:2: row 1: error ");
    refused(folder.path(), points, &sampled, "above the tolerance 1e-12; give more --samples");
    let csv = eval("ggx-reflection", &["--tolerance", "1e-6"], POINTS);
    assert!(appended(&csv, 5).iter().all(|row| row[4] <= 1e-6), "{csv}");
}

/// A promise that a row misses fails the verb and loses nothing: each value has its error.
#[test]
fn a_row_beyond_the_promise_is_written_and_is_exit_1() {
    let points = b"alpha,rho\n0.5,0.5\n1,0.7015467286109924\n";
    let output = lobefit(
        tempfile::tempdir().expect("a folder").path(),
        &["eval", "parallax-alpha", "--points", "-"],
        points,
    );
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("<stdin>:3: row 2: error 1.0") && said.contains("promise of parallax-alpha"),
        "{said}"
    );
    let rows = String::from_utf8(output.stdout).expect("UTF-8");
    assert_eq!(rows.lines().count(), 3, "{rows}");
}

#[test]
fn monte_carlo_is_reproducible_and_agrees_within_its_error() {
    let sampled = |samples: &str, seed: &str, points: &str| {
        eval("ggx-reflection", &["--method", "monte-carlo", "--samples", samples, "--seed", seed], points)
    };
    let points = "alpha,mu\n1,0.5\n0.5,0.8\n0.25,0.3\n0.1,0.05\n0.7,1\n1,0.02\n";
    let first = sampled("65536", "0", points);
    assert_eq!(first, sampled("65536", "0", points));
    assert_ne!(first, sampled("65536", "1", points));
    // Seed 0 is what is used where none is given.
    let options = ["--method", "monte-carlo", "--samples", "65536"];
    assert_eq!(first, eval("ggx-reflection", &options, points));
    let truth = eval("ggx-reflection", &[], points);
    for (estimate, truth) in appended(&first, 5).iter().zip(appended(&truth, 5)) {
        let bound = estimate[4] + truth[4];
        assert!((1e-12..1e-2).contains(&estimate[4]), "error {}", estimate[4]);
        for (found, exact) in estimate[..4].iter().zip(&truth[..4]) {
            assert!((found - exact).abs() <= bound, "{found} and {exact} are not within {bound}");
        }
    }
    let folder = tempfile::tempdir().expect("a folder");
    let limit = "<stdin>:3: row 2: ggx-reflection: alpha = 0.0 is a limit that Monte Carlo cannot sample";
    refused(folder.path(), "alpha,mu\n1,1\n0,1\n", &["--method", "monte-carlo", "--samples", "64"], limit);
    let average = ["--method", "monte-carlo", "--samples", "65536", "--seed", "0"];
    let estimate = &appended(&eval("ggx-average", &average, "alpha\n1\n"), 3)[0];
    let exact = 4.0 / 3.0 * (1.0 - ln(2.0));
    assert!((estimate[0] - exact).abs() <= estimate[2] && estimate[2] < 1e-2, "{estimate:?}");
    let errors = |csv: &str| appended(csv, 5).iter().map(|row| row[4]).sum::<f64>();
    assert!(errors(&sampled("1048576", "0", points)) < errors(&first), "more samples, smaller error");
}

/// Equal alphas are the isotropic lobe at any azimuth and in the mean; the azimuth's column may be
/// absent.
#[test]
fn anisotropy_contains_the_isotropic_lobe() {
    let isotropic = appended(&eval("ggx-reflection", &[], "alpha,mu\n0.3,0.5\n"), 5);
    let at = eval("ggx-reflection-aniso", &[], "phi,alpha_x,mu,alpha_y\n0.7,0.3,0.5,0.3\n");
    assert!(at.starts_with("phi,alpha_x,mu,alpha_y,E,loss,error\n"), "{at}");
    let mean = eval("ggx-reflection-aniso", &[], "alpha_x,alpha_y,mu\n0.3,0.3,0.5\n");
    for csv in [at, mean] {
        let row = &appended(&csv, 3)[0];
        assert!(
            (row[0] - isotropic[0][0]).abs() < 1e-11 && (row[1] - isotropic[0][3]).abs() < 1e-11,
            "{csv}"
        );
    }
}

/// Smooth glass is Fresnel's; the side is a word; Monte Carlo agrees within its error.
#[test]
fn glass_is_seen_from_a_named_side() {
    let points =
        "alpha,mu,ior,side\n0,1,1.5,outside\n0,0.1,1.5,inside\n0.3,0.5,1.5,inside\n0.3,0.5,1,outside\n";
    let csv = eval("ggx-glass", &[], points);
    assert!(csv.starts_with("alpha,mu,ior,side,R,T,E,loss,error\n"), "{csv}");
    let rows = appended(&csv, 5);
    assert!((rows[0][0] - 0.04).abs() < 1e-15 && rows[1][0] == 1.0, "{csv}");
    assert!(rows[3][0] == 0.0 && rows.iter().all(|r| (r[2] + r[3] - 1.0).abs() < 1e-12), "{csv}");
    let options = ["--method", "monte-carlo", "--samples", "65536", "--seed", "0"];
    let sampled = appended(&eval("ggx-glass", &options, "alpha,mu,ior,side\n0.3,0.5,1.5,inside\n"), 5);
    for column in 0..4 {
        assert!((sampled[0][column] - rows[2][column]).abs() <= sampled[0][4], "{sampled:?} {:?}", rows[2]);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let wrong = "alpha,mu,ior,side\n0.3,0.5,1.5,above\n";
    let output = lobefit(folder.path(), &["eval", "ggx-glass", "--points", "-"], wrong.as_bytes());
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("column `side`: `above` is not one of outside, inside"),
        "{}",
        stderr(&output)
    );
}

/// The sheen's albedo is given above 1; the factor of a white diffuse base is 1 less the specular
/// albedo; both have a second opinion.
#[test]
fn sheen_and_diffuse_coupling_are_given() {
    let csv = eval("sheen-charlie", &[], "alpha,mu\n1,1\n0.001,0.001\n1e-6,0\n");
    assert!(csv.starts_with("alpha,mu,E,error\n"), "{csv}");
    let rows = appended(&csv, 2);
    assert!((rows[0][0] - 0.2 / 2.0_f64.sqrt()).abs() <= rows[0][1], "{csv}");
    assert!(rows[1][0] > 11.4 && rows[2][0] > 398.0 && rows.iter().all(|row| row[1] <= 1e-10), "{csv}");
    let options = ["--method", "monte-carlo", "--samples", "65536"];
    let sampled = appended(&eval("sheen-charlie", &options, "alpha,mu\n1,1\n0.001,0.001\n1e-6,0\n"), 2);
    assert!(rows.iter().zip(&sampled).all(|(row, s)| (row[0] - s[0]).abs() <= s[1]), "{csv} {sampled:?}");

    let points =
        "alpha,mu,f0,specular\n0.3,0.4,0.04,single\n0.3,0.4,0.04,normalised\n0.3,0.4,0.04,compensated\n";
    let csv = eval("diffuse-coupling", &[], points);
    assert!(csv.starts_with("alpha,mu,f0,specular,factor,error\n"), "{csv}");
    let lobe = &appended(&eval("ggx-reflection", &[], "alpha,mu\n0.3,0.4\n"), 5)[0];
    let (e, bare) = (lobe[0], 0.04 * lobe[1] + lobe[2]);
    let rows = appended(&csv, 2);
    for (row, albedo) in rows.iter().zip([bare, bare / e, bare * (1.0 + 0.04 * (1.0 / e - 1.0))]) {
        assert!((row[0] - (1.0 - albedo)).abs() <= row[1] + 1e-12 && row[1] <= 1e-9, "{csv}");
    }
    let sampled = appended(&eval("diffuse-coupling", &options, points), 2);
    assert!(rows.iter().zip(&sampled).all(|(row, s)| (row[0] - s[0]).abs() <= s[1]), "{csv} {sampled:?}");
    let folder = tempfile::tempdir().expect("a folder");
    for (quantity, points, message) in [
        ("sheen-charlie", "alpha,mu\n0,0.5\n", "column `alpha`: 0 is outside [0.000001, 1]"),
        (
            "diffuse-coupling",
            "alpha,mu,f0,specular\n1,1,1,double\n",
            "`double` is not one of single, normalised, compensated",
        ),
        ("diffuse-coupling", "alpha,mu,f0,specular\n1,1,2,single\n", "column `f0`: 2 is outside [0, 1]"),
    ] {
        let output = lobefit(folder.path(), &["eval", quantity, "--points", "-"], points.as_bytes());
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}
