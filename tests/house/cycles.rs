//! The modules of the catalogue of effects, and those of an approximation: no module imports
//! another that leads back to it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::floors::{code, heads, sources};

/// Which siblings each module of a folder imports.
type Graph = BTreeMap<String, BTreeSet<String>>;

/// Item to module, of the `pub use` lines of a `mod.rs`.
fn exported(text: &str) -> BTreeMap<String, String> {
    let text = code(text);
    let uses = text.split(';').filter_map(|line| {
        let path = line.trim_start().strip_prefix("pub").and_then(|rest| rest.split_once(" use "))?.1;
        path.trim_start_matches("self::").split_once("::")
    });
    uses.flat_map(|(module, items)| heads(items).into_iter().map(|item| (item, module.to_owned()))).collect()
}

/// What a source at a depth below the folder `top` takes from the folder: module names, or items
/// that its `mod.rs` gives on.
fn taken(text: &str, top: &str, depth: usize) -> BTreeSet<String> {
    let text = code(text);
    let text = text.split("mod tests {").next().unwrap_or_default();
    let mut found = BTreeSet::new();
    let root = format!("crate::{top}::");
    for (at, _) in text.match_indices(&root) {
        found.extend(heads(&text[at + root.len()..]));
    }
    let mut at = 0;
    while let Some(next) = text[at..].find("super::") {
        at += next;
        let rest = text[at..].trim_start_matches("super::");
        if (text.len() - at - rest.len()) / "super::".len() == depth {
            found.extend(heads(rest));
        }
        at = text.len() - rest.len();
    }
    found
}

fn graph(top: &str) -> Graph {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(top);
    let modules: BTreeSet<String> = fs::read_dir(&root)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .filter(|name| name != "mod")
        .collect();
    let exported = exported(&fs::read_to_string(root.join("mod.rs")).unwrap());
    let mut graph = Graph::new();
    for path in sources(&root) {
        let inside = path.strip_prefix(&root).unwrap();
        let parts: Vec<&str> = inside.iter().map(|p| p.to_str().unwrap()).collect();
        if parts == ["mod.rs"] {
            continue;
        }
        let own = parts[0].trim_end_matches(".rs").to_owned();
        let depth = parts.len() - usize::from(parts.last() == Some(&"mod.rs"));
        let names = taken(&fs::read_to_string(&path).unwrap(), top, depth);
        let modules = names.iter().filter_map(|name| modules.get(name).or_else(|| exported.get(name)));
        let modules: Vec<String> = modules.filter(|to| **to != own).cloned().collect();
        graph.entry(own).or_default().extend(modules);
    }
    graph
}

/// Everything that a module leads to.
fn reached<'a>(graph: &'a Graph, from: &str) -> BTreeSet<&'a str> {
    let mut seen = BTreeSet::new();
    let mut open: Vec<&str> = vec![from];
    while let Some(module) = open.pop() {
        for to in graph.get(module).into_iter().flatten() {
            if seen.insert(to.as_str()) {
                open.push(to);
            }
        }
    }
    seen
}

/// The groups of modules of which each leads to every other.
fn cycles(graph: &Graph) -> BTreeSet<Vec<&str>> {
    let reach: BTreeMap<&str, BTreeSet<&str>> =
        graph.keys().map(|module| (module.as_str(), reached(graph, module))).collect();
    let group = |module: &&str| -> Vec<&str> {
        reach[module].iter().copied().filter(|to| reach.get(to).is_some_and(|r| r.contains(module))).collect()
    };
    let on_one = reach.keys().filter(|module| reach[*module].contains(*module));
    on_one.map(group).collect()
}

/// The edges between folders. The files beside them say what an effect is, and are one group.
fn folders(top: &str) -> Graph {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(top);
    let mut graph = graph(top);
    graph.retain(|module, _| root.join(module).is_dir());
    let names: BTreeSet<String> = graph.keys().cloned().collect();
    graph.values_mut().for_each(|to| to.retain(|module| names.contains(module)));
    graph
}

#[test]
fn effects_do_not_import_one_another() {
    let graph = folders("effects");
    assert!(graph.len() > 5 && graph["glass"].contains("table"), "{graph:?}");
    assert!(cycles(&graph).is_empty(), "{graph:#?}");
}

#[test]
fn the_steps_of_an_approximation_do_not_import_one_another() {
    let graph = graph("approximate");
    assert!(graph.len() > 5 && graph["run"].contains("target"), "{graph:?}");
    assert!(cycles(&graph).is_empty(), "{graph:#?}");
}

#[test]
fn planted_cycles_are_found() {
    let edge = |from: &str, to: &[&str]| (from.to_owned(), to.iter().map(|x| (*x).to_owned()).collect());
    let straight = Graph::from([edge("a", &["b", "c"]), edge("b", &["c"]), edge("c", &[])]);
    assert!(cycles(&straight).is_empty());
    let round = Graph::from([edge("a", &["b"]), edge("b", &["c"]), edge("c", &["a"]), edge("d", &["a"])]);
    assert_eq!(cycles(&round), BTreeSet::from([vec!["a", "b", "c"]]));
    let from = |text: &str, depth| taken(text, "effects", depth).into_iter().collect::<Vec<_>>();
    assert_eq!(from("use crate::effects::room::{Tap, Seen};\nuse crate::math::ops;", 2), ["room"]);
    assert_eq!(from("use super::super::room::Tap;\nuse super::one::Two;", 2), ["room"]);
    assert_eq!(from("use super::{Quantity, room};", 1), ["Quantity", "room"]);
    assert!(from("mod tests { use super::room::Tap; }", 1).is_empty());
    let given = exported("mod a;\npub use a::{B, C};\npub(crate) use d::E;\nuse f::G;\n");
    assert_eq!(given.into_keys().collect::<Vec<_>>(), ["B", "C", "E"]);
}
