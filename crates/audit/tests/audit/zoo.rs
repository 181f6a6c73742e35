//! `docs/audits/zoo.json`, the list of audited artefacts, against its page and against the options of
//! the program.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn word<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("no word `{key}` in {value}"))
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("no list `{key}` in {value}"))
}

/// The projects, in the order of the list.
fn projects() -> Vec<Value> {
    let zoo: Value = serde_json::from_str(&text("audits/zoo.json")).expect("JSON");
    list(&zoo, "projects").to_vec()
}

/// The rows of the page that begin an artefact, by its name, in their order.
fn rows(page: &str) -> Vec<String> {
    let cells = page.lines().filter_map(|line| line.strip_prefix("| `"));
    cells.map(|cell| cell.split('`').next().expect("a name").to_string()).collect()
}

#[test]
fn the_page_has_a_row_for_each_artefact_of_the_list_and_no_other() {
    let projects = projects();
    let names: Vec<String> = projects
        .iter()
        .flat_map(|project| list(project, "artefacts").iter().map(|a| word(a, "id").to_string()))
        .collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "a name stands twice in {names:?}");
    assert_eq!(rows(&text("audits.md")), names);
}

#[test]
fn the_page_has_the_places_the_commands_and_the_issues_of_the_list() {
    let page = text("audits.md");
    for project in projects() {
        let heading = format!("## {}", word(&project, "project"));
        let section = page.split(&format!("{heading}\n")).nth(1).unwrap_or_else(|| panic!("no `{heading}`"));
        let section = section.split("\n## ").next().expect("a section");
        let holds = |what: &str| assert!(section.contains(what), "`{heading}` does not hold `{what}`");
        holds(word(&project, "at"));
        for issue in list(&project, "issues") {
            holds(&format!("> **{}**\n>\n> {}\n", word(issue, "title"), word(issue, "text")));
        }
        for artefact in list(&project, "artefacts") {
            holds(&format!("| `{}` {} |", word(artefact, "id"), word(artefact, "what")));
            holds(&format!("--as {}", word(artefact, "quantity")));
            assert!(
                !artefact["ours"].is_null(),
                "{}: nothing of ours beside it, nor why",
                word(artefact, "id")
            );
            holds(&format!("# {}, {}\n", word(artefact, "id"), word(artefact, "file")));
        }
    }
}

/// The first table has the verdict of every artefact in a word, and a row for each pair of tables of area
/// lights, which have a table of their own below.
#[test]
fn the_first_table_has_a_verdict_for_each_artefact() {
    let page = text("audits.md");
    let first = page.split("\n## ").next().expect("the first part");
    let cells = |what: &str| -> Vec<String> {
        let row = first.lines().find(|line| line.contains(&format!(" | {what} | ")));
        let row = row.unwrap_or_else(|| panic!("no row of `{what}`"));
        row.split(" | ").map(|cell| cell.trim_end_matches(" |").to_string()).collect()
    };
    for project in projects() {
        for artefact in list(&project, "artefacts") {
            let row = cells(word(artefact, "what"));
            assert!(["PASS", "FAIL", "UNKNOWN"].contains(&row[2].as_str()), "{row:?}");
        }
        for pair in project["area_lights"].as_array().into_iter().flatten() {
            let row = cells(word(pair, "what"));
            assert!(row[2] == "no limit" && row[3].starts_with("a square light 0."), "{row:?}");
            let command = format!("# {}, {}\nlobefit audit ", word(pair, "what"), word(pair, "file"));
            assert!(page.contains(&command), "no `{command}`");
            // Ours stands below it, and is no worse: read by wrong channels it was off by 1.
            let section = page.split(&format!("\n| {} | 0.", word(pair, "what"))).nth(1).expect("its table");
            let ours = section.split("\n| ours, 64 x 64 halves | ").nth(1).expect("ours");
            let most =
                |text: &str| text.split(',').next().and_then(|x| x.parse::<f64>().ok()).expect("a number");
            assert!(most(ours) <= most(&format!("0.{section}")), "{row:?}");
        }
    }
}

/// `recomputed.json`, which a script of its own integration writes, against the list and the page.
#[test]
fn a_second_integration_agrees_with_each_audit_or_the_page_says_where_it_does_not() {
    let page = text("audits.md");
    let done: Value = serde_json::from_str(&text("audits/recomputed.json")).expect("JSON");
    let entries = list(&done, "artefacts");
    let projects = projects();
    let artefacts = projects.iter().flat_map(|project| list(project, "artefacts"));
    let names: Vec<&str> = artefacts.map(|a| word(a, "id")).collect();
    assert_eq!(entries.iter().map(|e| word(e, "id")).collect::<Vec<_>>(), names);
    let figure =
        |channel: &Value, key: &str| channel[key].as_f64().unwrap_or_else(|| panic!("{key}: {channel}"));
    for entry in entries {
        let name = word(entry, "id");
        assert_eq!(word(entry, "sha256").len(), 64, "{name}");
        assert!(!list(entry, "channels").is_empty(), "{name}");
        for channel in list(entry, "channels") {
            assert!(figure(channel, "points") >= 16.0, "{name}: {channel}");
            if channel["agrees"] == true {
                let most = figure(channel, "audit_max") + 4.0 * figure(channel, "standard_error");
                assert!(figure(channel, "max") <= most * (1.0 + 1e-3), "{name}: {channel}");
            } else {
                let why = word(channel, "why");
                assert!(page.contains(&format!("differs: {why}")), "{name}: the page does not say `{why}`");
            }
        }
    }
}

/// The file of an artefact is `owner/name: path`: no address, no path of a machine.
#[test]
fn artefacts_are_named_by_repository_and_path() {
    let page = text("audits.md");
    assert!(!page.contains("://"), "the page holds an address");
    for project in projects() {
        for artefact in list(&project, "artefacts") {
            let file = word(artefact, "file");
            let (repository, path) = file.split_once(": ").unwrap_or_else(|| panic!("{file}"));
            assert!(repository == "lobefit" || repository.split('/').count() == 2, "{file}");
            assert!(!path.starts_with('/') && !path.contains(".."), "{file}");
        }
    }
}

/// The options of the list are options of the program: what fails is the file, which is not there.
#[test]
fn the_program_knows_the_options_of_the_list() {
    for project in projects() {
        for artefact in list(&project, "artefacts") {
            let mut command = Command::new(env!("CARGO_BIN_EXE_lobefit-audit"));
            command.args(["not-there.bin", "--as", word(artefact, "quantity")]);
            command.args(list(artefact, "options").iter().map(|o| o.as_str().expect("a word")));
            let output = command.output().expect("the program");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let name = word(artefact, "id");
            assert_eq!(output.status.code(), Some(2), "{name}: {said}");
            assert!(said.contains("not-there.bin") && !said.contains("Usage"), "{name}: {said}");
        }
    }
}
