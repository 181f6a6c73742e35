//! Every public function of numbers has its promise or a reason why not, every quantity and every formula
//! too, with tests that exist; `docs/promises.md` is what the list prints.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lobefit_promises::{Range, formula, page, promises};
use lobefit_truth::quantity::{QUANTITIES, Variant};
use quote::ToTokens;
use syn::{ImplItem, Item, Signature, UseTree, Visibility};

/// What the name of an exception begins with that is of a formula.
const FORMULA: &str = "formula ";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Functions of a module that its users can call, by path.
fn functions(path: &str, file: &Path, folder: &Path, found: &mut BTreeSet<String>) {
    let text = fs::read_to_string(file).expect("a module");
    let items = syn::parse_file(&text).expect("Rust").items;
    // A private module is public through what its parent gives on.
    let given: BTreeSet<String> = items.iter().filter_map(given_on).collect();
    let public = |seen: &Visibility| matches!(seen, Visibility::Public(_));
    for item in &items {
        match item {
            Item::Fn(f) if public(&f.vis) && is_numeric(&f.sig) => {
                found.insert(format!("{path}::{}", f.sig.ident));
            }
            Item::Impl(block) if block.trait_.is_none() => {
                let owner = block.self_ty.to_token_stream().to_string();
                let owner = owner.split_whitespace().next().expect("a type").to_owned();
                for item in &block.items {
                    if let ImplItem::Fn(f) = item
                        && public(&f.vis)
                        && is_numeric(&f.sig)
                    {
                        found.insert(format!("{path}::{owner}::{}", f.sig.ident));
                    }
                }
            }
            Item::Mod(module) if module.content.is_none() => {
                let name = module.ident.to_string();
                if public(&module.vis) || given.contains(&name) {
                    let below = folder.join(&name);
                    let alone = folder.join(format!("{name}.rs"));
                    let file = if alone.exists() { alone } else { below.join("mod.rs") };
                    functions(&format!("{path}::{name}"), &file, &below, found);
                }
            }
            _ => {}
        }
    }
}

/// The module of a `pub use module::...`.
fn given_on(item: &Item) -> Option<String> {
    let Item::Use(used) = item else { return None };
    let Visibility::Public(_) = used.vis else { return None };
    let UseTree::Path(path) = &used.tree else { return None };
    Some(path.ident.to_string())
}

/// Whether it gives numbers: f64, arrays and pairs of them, lanes, directions.
fn is_numeric(signature: &Signature) -> bool {
    let given = signature.output.to_token_stream().to_string().replace(' ', "");
    let given = given.strip_prefix("->").unwrap_or_default();
    let plain = |text: &str| ["f64", "F8", "Vec3", "Estimate"].contains(&text) || text.starts_with("[f64;");
    let inner = given.trim_matches(['(', ')']);
    inner.split(',').all(plain) || plain(inner) || inner == "[Vec3;2]" || inner == "Vec3,f64"
}

fn all_functions() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for name in ["math", "truth", "shade", "fit", "ltc", "occlusion", "surface"] {
        let folder = root().join("crates").join(name).join("src");
        functions(name, &folder.join("lib.rs"), &folder, &mut found);
    }
    found
}

#[test]
fn every_public_function_of_numbers_has_its_promise_or_a_reason() {
    let found = all_functions();
    let promised: BTreeSet<&str> = promises().functions.iter().map(|f| f.name.as_str()).collect();
    let unknown: Vec<&&str> = promised.iter().filter(|name| !found.contains(**name)).collect();
    assert!(unknown.is_empty(), "promised, but no function: {unknown:#?}");
    let excused = |name: &str| promises().exceptions.iter().find(|e| name.starts_with(&e.name));
    let open: Vec<&String> =
        found.iter().filter(|name| !promised.contains(name.as_str()) && excused(name).is_none()).collect();
    assert!(open.is_empty(), "functions without a promise: {open:#?}");
    for exception in promises().exceptions.iter().filter(|e| !e.name.starts_with(FORMULA)) {
        let of: Vec<&String> = found.iter().filter(|name| name.starts_with(&exception.name)).collect();
        assert!(!of.is_empty(), "{}: no function needs this exception", exception.name);
        let both = of.iter().find(|name| promised.contains(name.as_str()));
        assert!(both.is_none(), "{}: {both:?} has its promise", exception.name);
        assert!(exception.reason.len() > 10, "{}: why?", exception.name);
    }
}

#[test]
fn every_quantity_has_its_promise_within_its_domain() {
    let named: BTreeSet<&str> = promises().quantities.iter().map(|q| q.name.as_str()).collect();
    let there: BTreeSet<&str> = QUANTITIES.iter().map(|q| q.name()).collect();
    assert_eq!(named, there);
    // What is accepted where nobody asks for a tolerance.
    let of = |q: &lobefit_promises::Quantity| (q.name.clone(), q.absolute);
    let stated: Vec<_> = promises().quantities.iter().map(of).collect();
    let kept: Vec<_> =
        QUANTITIES.iter().map(|q| (q.name().to_owned(), q.tolerance(&Variant::default()))).collect();
    assert_eq!(stated, kept);
    for promise in &promises().quantities {
        let quantity = lobefit_truth::quantity::find(&promise.name).expect("a quantity");
        assert_eq!(promise.inputs.len(), quantity.inputs().len(), "{}", promise.name);
        for (Range(name, low, high), input) in promise.inputs.iter().zip(quantity.inputs()) {
            assert_eq!(name, input.name, "{}", promise.name);
            assert!(input.domain[0] <= *low && *high <= input.domain[1], "{}: {name}", promise.name);
        }
        let has_loss = quantity.outputs().contains(&"loss");
        assert!(promise.loss_relative.is_none() || has_loss, "{}", promise.name);
        assert!(!promise.oracles.is_empty(), "{}: beside what?", promise.name);
    }
}

#[test]
fn every_formula_has_its_promise() {
    let folder = root().join("fits/hypotheses");
    let stem = |entry: std::io::Result<fs::DirEntry>| {
        let path = entry.expect("an entry").path();
        path.is_file().then(|| path.file_stem().expect("a name").to_string_lossy().into_owned())
    };
    let there: BTreeSet<String> = fs::read_dir(folder).expect("formulas").filter_map(stem).collect();
    let promised: BTreeSet<String> = promises().formulas.iter().map(|f| f.name.clone()).collect();
    let mut open: BTreeSet<&String> = there.difference(&promised).collect();
    for excused in promises().exceptions.iter().filter_map(|e| e.name.strip_prefix(FORMULA)) {
        let before = open.len();
        open.retain(|name| !name.starts_with(excused));
        assert!(open.len() < before, "{excused}: no formula needs this exception");
    }
    assert!(open.is_empty(), "formulas without a promise: {open:?}");
    let gone: Vec<&String> = promised.difference(&there).collect();
    assert!(gone.is_empty(), "promised, but no formula: {gone:?}");
}

#[test]
fn the_committed_manifest_keeps_what_is_promised() {
    let text = fs::read_to_string(root().join("manifest.json")).expect("the manifest");
    let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let list = |name: &str| manifest[name].as_array().expect("a list").clone();
    let word = |value: &serde_json::Value| value.as_str().expect("a word").to_owned();
    let axis =
        |axis: &serde_json::Value| Range(word(&axis["name"]), number(&axis["min"]), number(&axis["max"]));
    let table = |table: &serde_json::Value| {
        let of = |pass: &str, figure: &str| number(&table["error"][pass][figure]);
        let errors = [of("lookup", "max"), of("lookup", "max_rel"), of("lookup_8_bit_weights", "max")];
        let axes: Vec<Range> = table["axes"].as_array().expect("a list").iter().map(axis).collect();
        (word(&table["name"]), axes, word(&table["format"]), errors)
    };
    let stated: Vec<_> = list("tables").iter().map(table).collect();
    let of = |t: &lobefit_promises::Table| {
        let errors = [t.max_error, t.relative, t.max_error_8_bit_weights];
        (t.name.clone(), t.inputs.clone(), t.format.clone(), errors)
    };
    assert_eq!(stated, promises().tables.iter().map(of).collect::<Vec<_>>());
    for fit in list("fits") {
        let name = fit["hypothesis"].as_str().expect("a name");
        if fit["source"] == "fitted" {
            let (stated, promised) = (number(&fit["certificate"]["max_abs"]), formula(name).max_error);
            assert!(stated <= promised, "{name}: {stated} of {promised}");
        }
    }
}

#[test]
fn the_tests_that_hold_a_promise_exist() {
    let list = promises();
    let of_quantities = list.quantities.iter().flat_map(|q| q.oracles.iter().map(|oracle| &oracle.test));
    let of_conduct = list.conduct.iter().flat_map(|conduct| &conduct.tests);
    let all = list.formulas.iter().map(|f| &f.test).chain(of_quantities).chain(of_conduct);
    for test in all.collect::<BTreeSet<_>>() {
        let (file, name) = test.split_once("::").unwrap_or((test, ""));
        let path = root().join(file);
        assert!(path.exists(), "{test}");
        let has =
            name.is_empty() || fs::read_to_string(&path).expect("a test").contains(&format!("fn {name}()"));
        assert!(has, "{test}");
    }
}

#[test]
fn the_page_is_what_the_list_prints() {
    let there = fs::read_to_string(root().join("docs/promises.md")).expect("the page");
    let differs = there.lines().zip(page().lines()).find(|(a, b)| a != b).map(|(a, b)| format!("{a}\n{b}"));
    assert!(there == page(), "cargo run --release -p lobefit-promises > docs/promises.md\n{differs:?}");
}

#[test]
fn the_defects_to_plant_have_their_places() {
    let list = fs::read_to_string(root().join("tests/planted/defects.json")).expect("the list");
    let list: Vec<serde_json::Value> = serde_json::from_str(&list).expect("JSON");
    let caught = fs::read_to_string(root().join("tests/planted/caught.md")).expect("the record");
    assert!(list.len() >= 40, "{}", list.len());
    for defect in list {
        let of = |key: &str| defect[key].as_str().unwrap_or_else(|| panic!("{defect}: {key}"));
        let (before, rest) = of("from").split_once("[[").expect("an expression");
        let (expression, after) = rest.rsplit_once("]]").expect("an expression");
        let text = fs::read_to_string(root().join(of("file"))).expect("a file");
        let times = text.matches(&format!("{before}{expression}{after}")).count();
        assert!(times == 1 && expression != of("to"), "{}: {times} places", of("name"));
        let row = format!("| {} | `{}` | ", of("name"), of("file"));
        let rest = caught.split(&row).nth(1).unwrap_or_else(|| panic!("no row {row}"));
        let tests = rest.split(' ').next().and_then(|number| number.parse::<u32>().ok());
        assert!(tests >= Some(2), "{}: caught by {tests:?}", of("name"));
    }
}
