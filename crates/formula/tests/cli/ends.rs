//! `lobefit fit` at its edges: what is 0 in the end, what stays broken, ranges and starts that make
//! no sense.

use crate::common;

use std::path::Path;
use std::process::Output;

use common::{lobefit, stderr};
use serde_json::Value;

fn fit(folder: &Path, source: &str, options: &[&str]) -> Output {
    std::fs::write(folder.join("mine.wgsl"), source).expect("written");
    let all: Vec<&str> = ["fit", "mine.wgsl"].into_iter().chain(options.iter().copied()).collect();
    lobefit(folder, &all, b"")
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// E is 1 at roughness 0, which leaves nothing to `a`.
#[test]
fn a_coefficient_that_is_nothing_is_0_and_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 0.3;\noverride b: f32 = -0.2;\noverride c: f32 = 0.1;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + a + alpha * (b + c * mu); }\n";
    let options = ["--to", "ggx-reflection:E", "--exact", "alpha=0:1"];
    let output = fit(folder.path(), source, &options);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    let text = stdout(&output);
    assert!(text.contains("`a` is 0: drop it from the formula"), "{text}");
    assert!(text.lines().any(|line| line.trim_end() == "  a            0"), "{text}");
    let output = fit(folder.path(), source, &[&options[..], &["--json"]].concat());
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let fitted = &document["fits"][0];
    assert_eq!(fitted["coefficients"]["a"].as_f64(), Some(0.0), "{fitted}");
    assert_eq!(fitted["notes"].as_array().map(Vec::len), Some(1), "{fitted}");
}

/// A spike between the places of the lattice, which no constant can lower: found by the finer
/// places, and not hidden.
#[test]
fn a_range_that_stays_broken_between_its_places_ends_with_1() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override c: f32 = 0.5;\nfn mine(alpha: f32, mu: f32) -> f32 {\n\
        let x = mu - 0.4321;\nreturn c * x * x + 1.5 * exp2(-1.0e6 * x * x) + 0.0 * alpha;\n}\n";
    let output = fit(folder.path(), source, &["--to", "ggx-reflection:E", "--range", "..1", "--out", "out"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let told = stderr(&output);
    assert!(told.contains("constraint `at most 1` is missed by 5.0e-1"), "{told}");
    assert!(told.contains("mu = 0.432") && told.contains("nothing written"), "{told}");
    assert!(!folder.path().join("out/mine.wgsl").exists());
}

#[test]
fn ranges_without_a_truth_are_refused_with_the_range_to_give() {
    let folder = tempfile::tempdir().expect("a folder");
    let source =
        "override c: f32 = 1.0;\nfn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c * alpha * mu; }\n";
    for (options, words) in [
        (
            &["--to", "ggx-reflection:E", "--domain", "roughness=0..1"][..],
            &[
                "--domain roughness=0..1",
                "between alpha = 0 and alpha = 1e-7",
                "roughness=0.000317..1",
                "--exact alpha=0",
            ][..],
        ),
        (
            &["--to", "ggx-reflection:E", "--domain", "alpha=0..0.5"],
            &["--domain alpha=0..0.5", "alpha=0.0000001..0.5"],
        ),
        (
            &["--to", "sheen-charlie:E", "--domain", "roughness=0..1"],
            &["--domain roughness=0..1", "is not inside [0.001, 1]", "give --domain roughness=0.001..1"],
        ),
        (
            &["--to", "ggx-glass:R", "--fix", "side=inside", "--fix", "ior=9"],
            &["--fix ior=9", "is not inside [1, 4]"],
        ),
        (
            &["--to", "ggx-reflection:E", "--exact", "alpha=1e-9"],
            &["--exact alpha", "neither 0 nor in", "alpha=AT:VALUE"],
        ),
    ] {
        let output = fit(folder.path(), source, options);
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {told}");
        assert!(words.iter().all(|w| told.contains(w)), "{options:?}: {told}");
    }
    let mirror =
        fit(folder.path(), source, &["--to", "ggx-reflection:E", "--domain", "roughness=0.000317..1"]);
    assert_eq!(mirror.status.code(), Some(0), "{}", stderr(&mirror));
}

#[test]
fn starts_with_a_pole_are_no_obstacle_to_a_quotient_and_named_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let quotient = "override a: f32 = 1.0;\noverride b: f32 = -20.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return (1.0 + a * alpha) / (1.0 + b * alpha * mu); }\n";
    let output = fit(folder.path(), quotient, &["--to", "ggx-reflection:E"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("the global minimum, by proof"), "{}", stdout(&output));
    let general = quotient.replace("b * alpha", "b * b * b * alpha");
    let output = fit(folder.path(), &general, &["--to", "ggx-reflection:E"]);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("mine.wgsl:3:") && told.contains("declared starts"), "{told}");
}

/// The visibility of a sheen has no Smith form, so the output names no form. Where E is 0 it states
/// no relative error.
#[test]
fn a_sheen_is_printed_without_a_smith_form() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 0.5;\noverride b: f32 = 0.2;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return a * alpha + b * (1.0 - mu); }\n";
    let output = fit(folder.path(), source, &["--to", "sheen-charlie", "--out", "out", "--language", "wgsl"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).expect("written");
    for text in [stdout(&output), read("mine.html"), read("mine.wgsl")] {
        assert!(text.contains("sheen-charlie E") || text.contains("sheen-charlie, column E"), "{text}");
        assert!(!text.to_lowercase().contains("smith"), "{text}");
    }
    let document: Value = serde_json::from_str(&read("mine.json")).expect("JSON");
    assert!(document["fits"][0]["certificate"]["max_rel"].is_number(), "{}", document["fits"][0]);
}

#[test]
fn what_was_not_searched_for_is_not_called_a_minimum() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 0.5;\noverride b: f32 = 0.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return a * alpha + b * (1.0 - mu); }\n";
    let point = ["--to", "ggx-reflection:E", "--fix", "mu=0.5", "--fix", "roughness=0.5"];
    let output = fit(folder.path(), source, &point);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("optimality   none: nothing was searched for"), "{text}");
    assert!(!text.contains("is 0: drop it"), "{text}");
}

#[test]
fn a_parameter_that_does_not_matter_is_told_of_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 0.5;\noverride b: f32 = 0.1;\noverride k: f32 = 0.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return a * alpha + b * mu + 0.0 * k; }\n";
    let output = fit(folder.path(), source, &["--to", "ggx-reflection:E", "--allow-undetermined"]);
    let text = stdout(&output);
    let told: Vec<&str> =
        text.lines().filter(|line| line.starts_with("  parameters") && line.contains("`k`")).collect();
    assert_eq!(told, ["  parameters   `k` does not matter"], "{text}");
}

/// A step has no derivative to follow: that is said of it, and not that what it stands at is a
/// minimum.
#[test]
fn a_parameter_without_a_derivative_is_told_as_such() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "// fn mine(gamma)\noverride a: f32 = 1.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + alpha * mu + 1e-5 * floor(a); }\n";
    let output = fit(folder.path(), source, &["--to", "ggx-reflection:E"]);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for words in ["mine.wgsl:2:10", "`a` moves the formula in steps", "0 of 1 parameters determined (rank 0)"]
    {
        assert!(said.contains(words), "{words}: {said}");
    }
    let normalisation = ["--to", "ggx-reflection:E", "--use", "normalisation", "--allow-undetermined"];
    let text = stdout(&fit(folder.path(), source, &normalisation));
    assert!(!text.contains("a minimum") && text.contains("derivative by every parameter is 0"), "{text}");
    let renamed = source.replace("mu", "nv");
    let said = stderr(&fit(folder.path(), &renamed, &["--to", "ggx-reflection:E"]));
    assert!(said.contains("mine.wgsl:3:21: argument `nv` is not one of"), "{said}");
}

/// The output names the norm that a weight is taken in where it is another than the weight's own,
/// and what was minimised.
#[test]
fn a_perceptual_weight_tells_its_norm_and_its_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let source =
        "override a: f32 = 0.5;\nfn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + a * alpha * mu; }\n";
    let options = ["--to", "ggx-reflection:E", "--use", "normalisation", "--weight", "perceptual"];
    let told = |more: &[&str]| stdout(&fit(folder.path(), source, &[&options[..], more].concat()));
    let (largest, square) = (told(&[]), told(&["--norm", "rms"]));
    let hint = "is least with --norm rms";
    assert!(
        largest.contains("the largest error, weighted by perceptual") && largest.contains(hint),
        "{largest}"
    );
    assert!(
        square.contains("mean square error, weighted by perceptual") && !square.contains(hint),
        "{square}"
    );
    let rms = |text: &str| -> f64 {
        let line = text.lines().find(|line| line.starts_with("  weighted ")).expect("the weighted error");
        let figure = line.split_once("rms ").and_then(|(_, rest)| rest.split(',').next());
        figure.and_then(|figure| figure.parse().ok()).expect("a number")
    };
    assert!(rms(&square) > 0.0 && rms(&square) < rms(&largest), "{square} {largest}");
}

/// Exponents are declared positive and come out negative: their signs are tried.
#[test]
fn the_sign_of_an_exponent_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override c: f32 = 1.0;\noverride p: f32 = 1.0;\noverride q: f32 = 1.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c * pow(alpha, p) * pow(mu, q); }\n";
    let output = fit(folder.path(), source, &["--to", "sheen-charlie", "--json"]);
    let document: Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    let max = document["fits"][0]["certificate"]["max_abs"].as_f64().expect("a number");
    assert!(max < 1.5, "{max}");
}

#[test]
fn ends_within_constraints_are_claimed_to_first_order_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 0.1;\noverride b: f32 = 0.1;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 - a * alpha * exp2(-b * mu); }\n";
    for (norm, range) in [("max", "..1"), ("rms", "..1"), ("rms", "..2")] {
        let output =
            fit(folder.path(), source, &["--to", "ggx-reflection:E", "--norm", norm, "--range", range]);
        let text = stdout(&output);
        assert_eq!(output.status.code(), Some(0), "{norm} {range}: {}", stderr(&output));
        assert!(
            text.contains("gains anything to first order") && !text.contains("a minimum"),
            "{norm} {range}: {text}"
        );
    }
}

/// A pole that no sample meets and one point of the certificate does: as any pole that is not
/// excluded.
#[test]
fn a_pole_met_by_the_certificate_alone_is_told_as_a_pole() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override c: f32 = 0.1;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c*alpha/(mu - 0.333333); }\n";
    let options = ["--to", "ggx-reflection:E", "--use", "normalisation", "--out", "out"];
    let output = fit(folder.path(), source, &options);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    for words in ["not proven finite in its domain: mine.wgsl:2:", "may divide by zero near", "mu = 0.333"] {
        assert!(told.contains(words), "{words}: {told}");
    }
    assert!(!told.contains("sample") && !folder.path().join("out/mine.wgsl").exists(), "{told}");
}

#[test]
fn what_half_precision_cannot_hold_is_told_with_its_place_and_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let to = ["--to", "ggx-reflection:E", "--precision", "f32", "--precision", "f16"];
    let small = "override c: f32 = 0.1;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { let s = alpha * alpha * alpha; return 1.0 + c * s / (s * mu); }\n";
    let output = fit(folder.path(), small, &to);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    for words in
        ["in f16: mine.wgsl:2:", "is not a number in f16 at alpha = ", "mu = ", "or measure it in f32"]
    {
        assert!(told.contains(words), "{words}: {told}");
    }
    let large = small.replace("s * mu", "s * mu + 100000.0");
    let told = stderr(&fit(folder.path(), &large, &to));
    assert!(told.contains("mine: at 2:") && told.contains("the literal 100000 is infinite in f16"), "{told}");
    assert!(told.contains("65504; scale the formula, or measure it in f32"), "{told}");
}

#[test]
fn refusals_say_what_to_give_instead() {
    let folder = tempfile::tempdir().expect("a folder");
    let mine =
        "override c: f32 = 1.0;\nfn mine(alpha: f32, mu: f32) -> f32 { return 1.0 + c * alpha * mu; }\n";
    let albedo = ["--to", "ggx-reflection:E"];
    for (source, options, words) in [
        (
            mine,
            &["--to", "ggx-reflection:B", "--use", "normalisation"][..],
            "give --to ggx-reflection:E or leave",
        ),
        (
            mine,
            &["--to", "ggx-glass:R", "--fix", "side=outside", "--use", "normalisation"],
            "give --to ggx-glass:E or",
        ),
        (
            mine,
            &["--to", "diffuse-coupling", "--use", "normalisation"],
            "give --to ggx-reflection:E or --to ggx-reflection-aniso:E or",
        ),
        (mine, &["--to", "diffuse-coupling"], "--fix specular=single"),
        (mine, &["--to", "ggx-glass"], "--fix side=outside"),
        (
            mine,
            &["--to", "ggx-reflection:E", "--max-ops", "3"],
            "'[HYPOTHESIS]' cannot be used with '--max-ops <N>'",
        ),
        (
            mine,
            &["--to", "ggx-reflection:E", "--width", "3"],
            "'[HYPOTHESIS]' cannot be used with '--width <N>'",
        ),
        (
            mine,
            &["--to", "ggx-reflection:E", "--helpers", "none"],
            "'[HYPOTHESIS]' cannot be used with '--helpers <H>'",
        ),
        (&mine.replace("mu", "NdotV"), &albedo, "roughness, mu, alpha; rename it in the formula"),
        (
            &mine.replace("1.0 + c", "1.0"),
            &albedo,
            "parameter c is not used: use it in the formula or remove its override",
        ),
    ] {
        let output = fit(folder.path(), source, options);
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{options:?}: {told}");
        assert!(told.contains(words), "{options:?}: {told}");
    }
    let root = "override c: f32 = 1.0;\nfn mine(mu: f32) -> f32 { return c + sqrt(mu - 0.5); }\n";
    let output = fit(folder.path(), root, &albedo);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(
        told.contains("`sqrt(mu - 0.5)` is not a number at mu = ") && !told.contains("declare"),
        "{told}"
    );
    assert!(told.contains("narrow the domain to where it is defined"), "{told}");
}

/// Least squares sees nothing of a pole between its samples: the values are bound, which keeps it
/// out.
#[test]
fn a_pole_between_samples_is_kept_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let source = "override a: f32 = 1.0;\noverride b: f32 = 1.0;\noverride p: f32 = 1.0;\n\
        fn mine(alpha: f32, mu: f32) -> f32 { return (a * alpha * mu + b * mu) / (mu + p * alpha); }\n";
    let options = ["--to", "ggx-reflection:E", "--weight", "mu", "--norm", "p=8", "--norm", "rms", "--json"];
    let output = fit(folder.path(), source, &options);
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{}", stdout(&output));
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    for fitted in document["fits"].as_array().expect("a list") {
        let max = fitted["certificate"]["max_abs"].as_f64().expect("a number");
        assert!(max < 2.0, "{fitted}");
        assert_eq!(fitted["problems"].as_array().map(Vec::len), Some(0), "{fitted}");
    }
}
