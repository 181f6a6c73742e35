//! `lobefit furnace` from the command line: exit codes, streams, files.

use crate::common::{lobefit, names, stderr};

/// A Lambert surface as bright as it is asked for.
const SOURCE: &str = "#include \"pi.glsl\"
float surface(float NdotL, float NdotV, float brightness) { return brightness / PI; }
float surface(vec3 dir, vec3 eye, float brightness) { return brightness / PI + 0.0 * dir.z * eye.z; }
";

#[test]
fn a_whole_brdf_is_measured_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("lib")).unwrap();
    std::fs::write(folder.path().join("lib/pi.glsl"), "#define PI 3.14159265\n").unwrap();
    std::fs::write(folder.path().join("brdf.glsl"), SOURCE).unwrap();
    let run = |words: &[&str]| {
        // The package's program takes what follows its verb.
        let all =
            [&["audit", "furnace", "brdf.glsl", "--function", "surface", "--include", "lib"], words].concat();
        let output = lobefit(folder.path(), &all, b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let (code, said, error) = run(&["--set", "brightness=0.5", "--limit", "0.01", "--out", "report"]);
    let left_out = "brdf.glsl: left out: `surface(vec3, vec3, float)` (no argument is known as the light)\n";
    assert!(code == Some(0) && error == left_out, "{said}{error}");
    assert!(said.starts_with("PASS white furnace: surface (brdf.glsl)"), "{said}");
    assert!(said.contains("\nroughness") && said.lines().count() < 10, "{said}");
    assert_eq!(names(&folder.path().join("report")), ["brdf.glsl.furnace.html", "brdf.glsl.furnace.json"]);
    let figures = std::fs::read_to_string(folder.path().join("report/brdf.glsl.furnace.json")).unwrap();
    let page = std::fs::read_to_string(folder.path().join("report/brdf.glsl.furnace.html")).unwrap();
    assert!(
        page.contains("<a href=\"brdf.glsl.furnace.json\" title") && page.contains("<a href=\"#energy\">")
    );
    // A bar and two caps for each of 8 views, drawn as a path.
    let paths = page.split("<path").map(|path| path.split('>').next().unwrap_or(""));
    let mut bars = paths.filter(|path| path.contains("#222222") && path.matches('M').count() == 3 * 8);
    assert!(bars.next().is_some(), "error bars");
    for threads in ["1", "2"] {
        let again = ["--set", "brightness=0.5", "--limit", "0.01", "--json", "--threads", threads];
        assert_eq!(run(&again).1, figures, "the same bytes for any number of threads");
    }
    let found: serde_json::Value = serde_json::from_str(&figures).unwrap();
    assert_eq!(found["judgement"]["grade"], "PASS");
    // What sends back half of the light, where so much may be lost.
    for (most, code) in [("0.4", 1), ("0.6", 0)] {
        let (found, said, _) = run(&["--set", "brightness=0.5", "--max-loss", most]);
        assert!(found == Some(code) && said.contains("loses energy") == (code == 1), "{most}: {said}");
        // The line says what failed, and by how much.
        let decides = [("; the limit is 0.005", 0), ("the largest loss sampled is 0.5 \u{b1} ", 1)];
        assert!(
            decides.iter().all(|(part, of)| *of != code || said.lines().next().unwrap().contains(part)),
            "{said}"
        );
    }
    let energy = found["furnace"]["most"][0]["energy"][0]["value"].as_f64().unwrap();
    assert!((energy - 0.5).abs() < 1e-3, "{energy}");
    let command =
        "lobefit furnace brdf.glsl --function surface --include lib --set brightness=0.5 --roughness";
    assert!(found["origin"]["command"].as_str().unwrap().starts_with(command), "{}", found["origin"]);
    // Over the limit is exit 1; without a limit a verdict is no failure.
    let bright = ["--set", "brightness=1.2"];
    assert_eq!(run(&[&bright[..], &["--limit", "0.1"]].concat()).0, Some(1));
    let (code, said, _) = run(&bright);
    assert!(
        code == Some(0) && said.starts_with("FAIL white furnace: surface (brdf.glsl) gains energy"),
        "{said}"
    );
    // Roles choose among overloads.
    let (code, said, error) = run(&["--set", "brightness=0.5", "--role", "dir=l"]);
    assert!(
        code == Some(0) && said.contains("Arguments: dir = l, eye = v, brightness = 0.5."),
        "{said}{error}"
    );
    let (code, _, error) = run(&[]);
    assert!(
        code == Some(2) && error.contains("`surface(float, float, float)`, `surface(vec3, vec3, float)`"),
        "{error}"
    );
    for (words, part) in [
        (&["--role", "brightness"][..], "NAME=ROLE"),
        (&["--role", "brightness=glow"], "a role is n, v, l"),
        (&["--set", "brightness=0.5", "--cosine", "maybe"], "included, absent"),
    ] {
        let (code, _, error) = run(words);
        assert!(code == Some(2) && error.contains(part), "{words:?}: {error}");
    }
}
