//! The action and its workflows: the YAML is well formed, what one file names is in another, and
//! the script does on a desk what it does on a runner.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use yaml_rust2::{Yaml, YamlLoader};

fn root(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

fn text(file: &str) -> String {
    std::fs::read_to_string(root(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

fn yaml(what: &str, text: &str) -> Yaml {
    let mut documents = YamlLoader::load_from_str(text).unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(documents.len(), 1, "{what}");
    documents.remove(0)
}

fn keys(map: &Yaml) -> BTreeSet<&str> {
    map.as_hash().expect("a map").keys().map(|key| key.as_str().expect("a word")).collect()
}

fn set<const N: usize>(words: [&'static str; N]) -> BTreeSet<&'static str> {
    words.into()
}

/// The names after a context in the expressions of a text: `scene` of `${{ inputs.scene }}`.
fn named<'a>(text: &'a str, context: &str) -> BTreeSet<&'a str> {
    let expressions = text.split("${{ ").skip(1).filter_map(|rest| rest.split(" }}").next());
    expressions.filter_map(|e| e.strip_prefix(context)).collect()
}

/// A step runs a command in bash, or uses an action, and gives the runner nothing that it does not
/// know.
fn step(what: &str, step: &Yaml, shell: bool) {
    let known = set(["name", "uses", "with", "run", "shell", "env"]);
    assert!(keys(step).is_subset(&known), "{what}: {step:?}");
    assert!(step["uses"].is_badvalue() != step["run"].is_badvalue(), "{what}: {step:?}");
    assert!(
        !shell || step["run"].is_badvalue() || step["shell"].as_str() == Some("bash"),
        "{what}: {step:?}"
    );
    for word in step["run"].as_str().unwrap_or_default().split(['"', ' ', '\n']) {
        let Some(at) = word.find(".github/action/") else { continue };
        let script = root(&word[at..]);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode =
                std::fs::metadata(&script).unwrap_or_else(|e| panic!("{word}: {e}")).permissions().mode();
            assert!(mode & 0o111 != 0, "{word} cannot be run");
        }
        assert!(script.is_file(), "{what} runs {word}");
    }
}

#[test]
fn the_action_is_well_formed() {
    let text = text("action.yml");
    let action = yaml("action.yml", &text);
    assert_eq!(keys(&action), set(["name", "description", "inputs", "runs"]));
    assert_eq!(action["runs"]["using"].as_str(), Some("composite"));
    for step_of in action["runs"]["steps"].as_vec().expect("steps") {
        step("action.yml", step_of, true);
    }
    let inputs = keys(&action["inputs"]);
    assert_eq!(inputs, named(&text, "inputs."), "every input is used, and no other");
    for name in inputs {
        let input = &action["inputs"][name];
        assert_eq!(keys(input), set(["description", "default"]), "{name}");
        assert!(input["default"].as_str().is_some(), "{name}: a default that YAML takes for no text");
    }
    // What the script reads is what the step gives it.
    let script = self::text(".github/action/check.sh");
    for name in keys(&action["runs"]["steps"][1]["env"]) {
        assert!(script.contains(&format!("${{{name}:-")), "check.sh reads {name}");
    }
}

#[test]
fn the_release_workflow_is_well_formed() {
    let text = text(".github/workflows/release.yml");
    let workflow = yaml("release.yml", &text);
    assert_eq!(keys(&workflow), set(["name", "on", "permissions", "jobs"]));
    let jobs = keys(&workflow["jobs"]);
    for name in &jobs {
        let job = &workflow["jobs"][*name];
        assert!(keys(job).is_subset(&set(["needs", "runs-on", "strategy", "steps"])), "{name}");
        assert!(job["needs"].as_str().is_none_or(|needed| jobs.contains(needed)), "{name}");
        for step_of in job["steps"].as_vec().expect("steps") {
            step("release.yml", step_of, false);
        }
    }
    let systems = workflow["jobs"]["build"]["strategy"]["matrix"]["include"].as_vec().expect("systems");
    for system in systems {
        assert_eq!(keys(system), named(&text, "matrix."));
        // The action looks for each archive under the name that the release gives it.
        let target = system["target"].as_str().expect("a target");
        assert!(self::text(".github/action/install.sh").contains(target), "{target}");
    }
    for manifest in
        ["Cargo.toml", "crates/audit/Cargo.toml", "crates/formula/Cargo.toml", "crates/studies/Cargo.toml"]
    {
        let named = "/releases/download/v{ version }/lobefit-{ target }.tgz";
        assert!(self::text(manifest).contains(named), "{manifest}");
    }
}

/// The documented workflows: to check, of six lines at most, and of a bake in pieces.
#[test]
fn the_documented_workflows_are_well_formed() {
    let page = text("docs/ci.md");
    let blocks: Vec<&str> =
        page.split("```yaml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(blocks.len(), 3);
    assert!(blocks[..2].iter().all(|block| block.lines().count() <= 6), "six lines");
    let (github, gitlab) = (yaml("GitHub", blocks[0]), yaml("GitLab", blocks[1]));
    let steps = github["jobs"]["lobefit"]["steps"].as_vec().expect("steps");
    for step_of in steps {
        step("docs/ci.md", step_of, false);
    }
    let pieces = yaml("pieces", blocks[2]);
    assert_eq!(keys(&pieces["jobs"]), set(["bake", "merge"]));
    assert_eq!(pieces["jobs"]["merge"]["needs"].as_str(), Some("bake"));
    assert_eq!(keys(&pieces["jobs"]["bake"]["strategy"]["matrix"]), named(blocks[2], "matrix."));
    for job in ["bake", "merge"] {
        for step_of in pieces["jobs"][job]["steps"].as_vec().expect("steps") {
            step("docs/ci.md", step_of, false);
        }
    }
    let inputs = yaml("action.yml", &text("action.yml"))["inputs"].clone();
    assert!(keys(&steps[1]["with"]).is_subset(&keys(&inputs)));
    for input in keys(&inputs) {
        assert!(page.contains(&format!("| `{input}` |")), "the page tells of {input}");
    }
    assert!(
        gitlab["lobefit"]["script"]
            .as_vec()
            .is_some_and(|script| script.iter().all(|line| line.as_str().is_some()))
    );
}

/// A scene whose bake takes little.
const SCENE: &str = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":[0.4,1],
    "wants":{"tables":[{"size":[32,32],"layout":"plain"}]}}]}"#;

/// Whether a program is there that a test calls.
fn is_there(tool: &str) -> bool {
    let found = Command::new(tool).arg("--version").output().is_ok();
    let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
    assert!(found || !required, "{tool} is called for");
    if !found {
        eprintln!("skipped: no {tool}");
    }
    found
}

/// The scripts, as shellcheck reads them.
#[test]
fn the_scripts_are_without_findings() {
    let scripts = ["check", "install", "package"].map(|name| root(&format!(".github/action/{name}.sh")));
    if is_there("shellcheck") {
        let output = Command::new("shellcheck")
            .args(scripts)
            .args([".ci/run", ".ci/nightly"].map(root))
            .output()
            .expect("it runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    }
}

/// Runs the action's script in a folder as a runner does: exit code, annotations and summary.
#[cfg(unix)]
fn script(folder: &Path, environment: &[(&str, &str)]) -> Option<(i32, String, String)> {
    if !is_there("jq") {
        return None;
    }
    let summary = folder.join("summary.md");
    let _ = std::fs::remove_file(&summary);
    let output = Command::new(root(".github/action/check.sh"))
        .arg(env!("CARGO_BIN_EXE_lobefit"))
        .current_dir(folder)
        .env_remove("SCENE")
        .envs(environment.iter().copied())
        .env("GITHUB_STEP_SUMMARY", &summary)
        .output()
        .expect("the script runs");
    let annotations = String::from_utf8(output.stdout).expect("text");
    Some((
        output.status.code().expect("a code"),
        annotations,
        std::fs::read_to_string(summary).unwrap_or_default(),
    ))
}

/// A folder with a scene and its bake in `assets`.
#[cfg(unix)]
fn baked() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a scene.json"), SCENE).expect("written");
    let bake = Command::new(env!("CARGO_BIN_EXE_lobefit"))
        .args(["bake", "a scene.json", "--no-cache", "--out", "assets", "--quiet"])
        .current_dir(folder.path())
        .status();
    assert!(bake.expect("the binary runs").success());
    folder
}

/// Of another scene every file is another: the annotations are the change, once, and what a bake
/// of it would not mend.
#[cfg(unix)]
#[test]
fn the_script_names_a_change_of_the_scene_once() {
    let folder = baked();
    std::fs::write(folder.path().join("a scene.json"), SCENE.replace("[0.4,1]", "[0.5,1]")).expect("written");
    let environment = [("SCENE", "./a scene.json"), ("AGAINST", "assets")];
    let Some((code, annotations, summary)) = script(folder.path(), &environment) else { return };
    assert_eq!(code, 1, "{annotations}");
    let [line] = annotations.lines().collect::<Vec<_>>()[..] else { panic!("one line: {annotations}") };
    let change = "materials[0].roughness[0]: 0.4 became 0.5";
    let start = format!("::error file=a scene.json,title=lobefit check::{change}; numbers or code that a ");
    assert!(line.starts_with(&start), "{line}");
    let table = "tables/ggx-dfg-correlated-32x32-plain.exr";
    assert!(line.contains(&format!("shader reads changed in {table}; run ")), "and no other file: {line}");
    let bake = "lobefit bake ./a\\ scene.json --out assets";
    assert!(line.ends_with(&format!("; run {bake}")), "{line}");
    assert!(summary.contains(&format!("The scene changed:\n\n- {change}\n")), "{summary}");
    assert!(summary.contains(&format!("\nBake it again: `{bake}`\n")), "{summary}");
    assert!(!summary.contains("| file | what differs |"), "{summary}");

    let study = folder.path().join("assets/reports/gpu");
    std::fs::create_dir(&study).expect("a folder");
    std::fs::write(study.join("a.json"), "{").expect("written");
    let renamed = SCENE.replace("\"m\"", "\"n\"");
    std::fs::write(folder.path().join("a scene.json"), renamed).expect("written");
    let (_, annotations, summary) = script(folder.path(), &environment).expect("run before");
    let [change, record] = annotations.lines().collect::<Vec<_>>()[..] else { panic!("{annotations}") };
    assert!(change.contains("\"m\" became \"n\"; no number and no code that a shader reads changed; run "));
    assert!(record.starts_with("::error file=assets/reports/gpu/a.json,"), "{record}");
    assert!(summary.contains("| `reports/gpu/a.json` | "), "{summary}");

    // No number changed: the job passes, and nothing in it is red.
    std::fs::remove_file(study.join("a.json")).expect("removed");
    let by_values = [("SCENE", "./a scene.json"), ("AGAINST", "assets"), ("VALUES", "0")];
    let (code, annotations, _) = script(folder.path(), &by_values).expect("run before");
    assert_eq!((code, annotations.as_str()), (0, ""));
}

#[cfg(unix)]
#[test]
fn the_script_annotates_files_and_writes_the_summary() {
    let folder = baked();
    let environment = [("SCENE", "a scene.json"), ("AGAINST", "./assets/"), ("VALUES", "")];
    let Some((code, annotations, summary)) = script(folder.path(), &environment) else { return };
    assert_eq!((code, annotations.as_str()), (0, ""), "{summary}");
    assert!(summary.contains("Every file follows from its recipe."), "{summary}");
    assert!(summary.contains("| ggx-dfg-correlated-32x32-plain | ggx-reflection | 0.0"), "{summary}");

    let page = folder.path().join("assets/reports/index.html");
    std::fs::remove_file(&page).expect("removed");
    std::fs::write(folder.path().join("assets/fits/50%, a|b:c"), "x").expect("written");
    let (code, annotations, summary) = script(folder.path(), &environment).expect("run before");
    assert_eq!(code, 1);
    for line in [
        "::error file=assets/reports/index.html,title=lobefit check::missing: the recipe makes it",
        "::error file=assets/fits/50%25%2C a|b%3Ac,title=lobefit check::extra: the recipe does not make it",
    ] {
        assert!(annotations.lines().any(|found| found == line), "`{line}` in\n{annotations}");
    }
    assert!(summary.contains("| `reports/index.html` | missing: the recipe makes it |"), "{summary}");
    assert!(summary.contains("| `fits/50%, a b:c` | extra"), "{summary}");
    assert!(summary.contains("Bake it again: `lobefit bake a\\ scene.json --out ./assets/`"), "{summary}");
    // A file that is none of the bake's no bake takes away.
    std::fs::write(&page, "").expect("written");
    let only_extra = [&environment[..], &[("ONLY", "fits")]].concat();
    let (_, _, summary) = script(folder.path(), &only_extra).expect("run before");
    assert!(summary.contains("| extra") && !summary.contains("Bake it again"), "{summary}");

    // What the scene asks for now no table keeps: nothing follows from it that files could be held against.
    let strict = SCENE.replace(r#""layout":"plain""#, r#""layout":"plain","max_error":1e-6"#);
    std::fs::write(folder.path().join("strict.json"), strict).expect("written");
    let asked = [("SCENE", "strict.json"), ("AGAINST", "assets")];
    let (code, annotations, summary) = script(folder.path(), &asked).expect("run before");
    let [line, change] = annotations.lines().collect::<Vec<_>>()[..] else { panic!("{annotations}") };
    let start = "::error file=strict.json,title=lobefit check::promise not kept: table ggx-dfg-correlated-32x32-plain: ";
    assert!(code == 1 && line.starts_with(start), "{code} {line}");
    let field = "materials[0].wants.tables[0].max_error: 1e-6 is new";
    assert_eq!(change, format!("::error file=strict.json,title=lobefit check::the scene changed: {field}"));
    let nothing = "asks for what nothing keeps; no bake follows from it:\n\n- table ggx-";
    assert!(
        summary.contains(nothing) && summary.contains("\n  - measured, and not within it: "),
        "{summary}"
    );
    assert!(summary.contains(&format!("The scene changed:\n\n- {field}\n")), "{summary}");
    assert!(!summary.contains("Bake it again"), "{summary}");

    let tables = [&environment[..], &[("ONLY", "tables")]].concat();
    let (code, annotations, _) = script(folder.path(), &tables).expect("run before");
    assert_eq!((code, annotations.as_str()), (0, ""));

    let (code, annotations, _) = script(folder.path(), &[("SCENE", "none.json")]).expect("run before");
    assert_eq!(code, 2);
    assert!(annotations.starts_with("::error title=lobefit check::error: none.json"), "{annotations}");
}
