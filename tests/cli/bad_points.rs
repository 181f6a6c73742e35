//! Points that are refused: exit code 2, a message with line, row and column, and nothing written.

use crate::common;

use common::{lobefit, names, stderr};

#[test]
fn bad_points_are_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [
        (&b""[..], "points.csv:1: the file is empty"),
        (b"\n\r\n", "points.csv:1: the file is empty"),
        (b"alpha\n0.5\n", "column `mu` is missing"),
        (b"Alpha,mu\n0.5,1\n", "column `alpha` is missing"),
        (b"alpha;mu\n0.5;1\n", "columns `alpha`, `mu` are missing"),
        (b"alpha\tmu\n0.5\t1\n", "columns `alpha`, `mu` are missing"),
        (b"0.5,1\n", "columns `alpha`, `mu` are missing"),
        (b"alpha,mu,mu\n0.5,1,1\n", "column `mu` is there twice"),
        (b"alpha,mu,loss\n0.5,1,1\n", "column `loss` is one that ggx-reflection appends"),
        (b"alpha,mu\n0.5\n", "points.csv:2: row 1: 1 fields where the header has 2"),
        (b"alpha,mu\n0.5,1,2\n", "points.csv:2: row 1: 3 fields where the header has 2"),
        (b"alpha,mu\n1,1\n\n\n,1\n", "points.csv:5: row 2: column `alpha`: the field is empty"),
        (b"alpha,mu\nx,1\n", "column `alpha`: `x` is not a number"),
        (b"alpha,mu\n1,1_0\n", "column `mu`: `1_0` is not a number"),
        (b"alpha,mu\n1,0x1\n", "column `mu`: `0x1` is not a number"),
        (b"alpha,mu\n1,NaN\n", "column `mu`: `NaN` is not a finite number"),
        (b"alpha,mu\n1,-inf\n", "column `mu`: `-inf` is not a finite number"),
        (b"alpha,mu\n1e999,1\n", "column `alpha`: `1e999` is not a finite number"),
        (b"alpha,mu\n1,1.0000000000000002\n", "column `mu`: 1.0000000000000002 is outside [0, 1]"),
        (b"alpha,mu\n-0.1,1\n", "column `alpha`: -0.1 is outside [0, 1]"),
        (b"alpha,mu\n\x1b[2J,1\n", "column `alpha`: `\\u{1b}[2J` is not a number"),
        (b"alpha,mu\n\xff,1\n", "column `alpha`: "),
        (b"alpha,mu,note\n1,1,\"open\n", "points.csv:2: a double quote is not closed"),
        (b"a\0l\0p\0h\0a\0,\0m\0u\0\n\0", "columns `alpha`, `mu` are missing"),
    ] {
        std::fs::write(folder.path().join("points.csv"), text).unwrap();
        let arguments = ["eval", "ggx-reflection", "--points", "points.csv", "--out", "out.csv"];
        let output = lobefit(folder.path(), &arguments, b"");
        let (input, message) = (String::from_utf8_lossy(text), stderr(&output));
        assert_eq!(output.status.code(), Some(2), "{input}\n{message}");
        assert!(message.contains(expected), "{input}\nexpected: {expected}\nfound: {message}");
        assert!(message.contains("points.csv:"), "{message}");
        assert!(message.trim_end().chars().all(|c| !c.is_control()), "{message:?}");
        assert!(output.stdout.is_empty());
        assert_eq!(names(folder.path()), ["points.csv"]);
    }
}

#[test]
fn standard_input_is_named_in_messages() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["eval", "ggx-average", "--points", "-"], b"alpha\n2\n");
    assert_eq!(output.status.code(), Some(2));
    let message = stderr(&output);
    assert!(message.contains("<stdin>:2: row 1: column `alpha`: 2 is outside [0, 1]"), "{message}");
}

#[test]
fn values_that_a_method_cannot_take_are_named_with_the_quantity() {
    let folder = tempfile::tempdir().unwrap();
    for (quantity, method, points, expected) in [
        (
            "ggx-reflection",
            "quadrature",
            "alpha,mu\n1e-300,1\n",
            "row 1: ggx-reflection: alpha = 1e-300 is neither 0 nor in [1e-7, 1]",
        ),
        (
            "ggx-average",
            "quadrature",
            "alpha\n1e-8\n",
            "row 1: ggx-average: alpha = 1e-8 is neither 0 nor in [1e-7, 1]",
        ),
        (
            "ggx-average",
            "monte-carlo",
            "alpha\n0\n",
            "row 1: ggx-average: alpha = 0.0 is a limit that Monte Carlo cannot sample",
        ),
        (
            "ggx-reflection",
            "monte-carlo",
            "alpha,mu\n1,0\n",
            "row 1: ggx-reflection: mu = 0.0 is a limit that Monte Carlo cannot sample",
        ),
    ] {
        let arguments = ["eval", quantity, "--points", "-", "--method", method];
        let output = lobefit(folder.path(), &arguments, points.as_bytes());
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(expected), "{expected} in {}", stderr(&output));
    }
    let help = String::from_utf8(lobefit(folder.path(), &["eval", "--help"], b"").stdout).unwrap();
    for inputs in
        ["alpha (0, 1e-7 to 1), mu (0 to 1): E, A, B, loss, error", "mu (0 to 1), phi (any): E, loss"]
    {
        assert!(help.contains(inputs), "{help}");
    }
}
