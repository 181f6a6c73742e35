//! Options of shader files, from the command line.

use crate::common::{lobefit, stderr};

/// Two overloads, one under a condition, with a helper in another file.
const SOURCE: &str = "#include <helpers.glsl>
float albedo(float alpha, float mu) { return 1.0 - 0.48 * square(alpha); }
vec3 albedo(vec3 f0, float alpha, float mu) { return f0 * albedo(alpha, mu); }
#if EXACT
float exact(float alpha, float mu) { return 1.0 - 0.5 * alpha; }
#endif
";

#[test]
fn macros_folders_overloads_and_domains_are_options() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("lib")).unwrap();
    std::fs::write(folder.path().join("lib/helpers.glsl"), "float square(float x) { return x * x; }\n")
        .unwrap();
    std::fs::write(folder.path().join("brdf.glsl"), SOURCE).unwrap();
    std::fs::write(folder.path().join("brdf.png"), "").unwrap();
    let run = |words: &[&str]| {
        let output = lobefit(
            folder.path(),
            &[&["audit", "brdf.glsl", "--as", "ggx-reflection:E"], words].concat(),
            b"",
        );
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap() + &stderr(&output))
    };
    let one = ["--function", "albedo(float, float)"];
    let (code, said) = run(&[&one[..], &["--include", "lib", "--domain", "mu=0.5..1"]].concat());
    assert_eq!(code, Some(0), "{said}");
    let of = |domain: &str| run(&[&one[..], &["--include", "lib", "--domain", domain]].concat());
    assert_eq!(of("roughness=0.5..1"), of("alpha=0.25..1"));
    assert_ne!(of("roughness=0.5..1"), of("alpha=0.5..1"));
    let (code, said) = run(&one);
    assert!(code == Some(2) && said.contains("`#include <helpers.glsl>` at brdf.glsl: 1:1"), "{said}");
    let (code, said) = run(&["--function", "albedo", "--include", "lib"]);
    let both = "`albedo(float, float)`, `albedo(vec3, float, float)`; choose one by --function";
    assert!(code == Some(2) && said.contains(both), "{said}");
    let (code, said) = run(&["--function", "exact"]);
    assert!(code == Some(2) && said.contains("`#if EXACT` at brdf.glsl: 4:1"), "{said}");
    assert_eq!(run(&["--function", "exact", "--define", "EXACT"]).0, Some(0));
    for (words, part) in [
        (&["--domain", "mu=1..0"][..], "INPUT=LOW..HIGH"),
        (&["--domain", "nu=0..1"], "alpha, mu, ior, anisotropy, roughness"),
        (&["--domain", "roughness=-1..1"], "no negative number"),
        (&["--function", "exact", "--samples", "9"], "a function is judged follows from what it costs"),
        (&["--define", "=2", "--function", "exact"], "NAME=VALUE"),
        (&["--include", "nowhere", "--function", "exact"], "nowhere"),
    ] {
        let (code, said) = run(words);
        assert!(code == Some(2) && said.contains(part), "{words:?}: {said}");
    }
    let table =
        lobefit(folder.path(), &["audit", "brdf.png", "--as", "ggx-reflection", "--define", "A"], b"");
    assert!(table.status.code() == Some(2) && stderr(&table).contains("--define"), "{}", stderr(&table));
}
