//! The overview: what was called for, what was made, and where to read on.

use std::collections::BTreeSet;

use serde_json::Value;

use super::{called_for, words};
use crate::data::Cost;
use crate::emit::call::{Call, Callers, NAMED, callers};
use crate::emit::manifest::{FitEntry, Manifest, TableEntry};
use crate::report::{Block, Names, Section, TextTable, figures_of, numbers, place_of};

const COLUMNS: &str = "effect|name|quantity|use|smith|max error>|ops>|fetches>|bytes>";

/// The column of names.
const NAME: usize = 1;

const CALLS: &str = "call|recommended|effect|for|max error>|which error|ops>|fetches>|bytes>";

pub(super) fn sections(manifest: &Manifest) -> Vec<Section> {
    let mut called_for = called_for::of(&manifest.effects, &manifest.left_out);
    called_for.blocks.extend(called_for::notes(&manifest.notes));
    if manifest.effects.is_empty() {
        return vec![called_for];
    }
    called_for = behind("Materials, ranges, and what was left out", called_for);
    let call = Section::new(
        "call",
        "Who calls what",
        "What each material and probe calls, then each emitted function once.",
        vec![of_callers(manifest), calls(manifest)],
    );
    let made = Section::new(
        "made",
        "What was made",
        "Tables and formulas in the order of the manifest, which has all their figures. The page of an effect has \
               its truth, its errors and its pictures, and every formula that was measured.",
        vec![rows(manifest)],
    );
    vec![behind("All functions", call), behind("All tables and formulas", made), called_for]
}

/// A section behind a line, its lead too: on the overview it stands below what there is to take.
fn behind(summary: &str, section: Section) -> Section {
    let lead = Block::Text { text: section.lead };
    let blocks = std::iter::once(lead).chain(section.blocks).collect();
    let fold = Block::Fold { summary: summary.into(), blocks };
    Section { lead: String::new(), blocks: vec![fold], ..section }
}

/// What came of the scene, in one sentence.
pub(super) fn conclusion(manifest: &Manifest) -> String {
    let calls = &manifest.entries.calls;
    let different = |of: fn(&Call) -> &str| calls.iter().map(of).collect::<BTreeSet<_>>().len();
    if calls.is_empty() {
        return "The scene calls for no function and no table.".into();
    }
    let functions = words::count(different(|call| &call.function), "function serves", "functions serve");
    let all: BTreeSet<&str> = calls.iter().map(|call| call.of.as_str()).collect();
    let named = |list: &str| {
        let list = manifest.made_from[list].as_array().into_iter().flatten();
        list.filter(|one| one["name"].as_str().is_some_and(|name| all.contains(name))).count()
    };
    let kinds = [(named("materials"), "material", "materials"), (named("probes"), "probe", "probes")];
    let kinds = kinds.into_iter().filter(|(n, ..)| *n > 0).map(|(n, one, many)| words::count(n, one, many));
    let culling = !manifest.entries.masks.is_empty();
    let users = kinds.chain(culling.then(|| "culling".into())).collect::<Vec<_>>().join(" and ");
    format!("{functions} {users}; {}", kept(manifest))
}

/// What holds of the errors that the scene states: formulas that are emitted for who compares keep none.
fn kept(manifest: &Manifest) -> String {
    let beside = |call: &Call| !call.recommended && call.file.is_none() && call.cost.fetches == 0;
    let calls = &manifest.entries.calls;
    if !states_error(&manifest.made_from) {
        let worst = calls.iter().filter(|call| call.recommended);
        let worst = worst.max_by(|a, b| a.max_error.total_cmp(&b.max_error));
        let worst = worst.map_or_else(String::new, |Call { function, max_error, metric, .. }| {
            format!(
                ", and the largest of what is recommended is {} ({function}, {metric})",
                words::max(*max_error)
            )
        });
        return format!("the scene states no limit on an error{worst}.");
    }
    match calls.iter().any(beside) {
        true => {
            "what is recommended keeps every error that the scene states, and the other functions state their own."
                .into()
        }
        false => "every error that the scene states is kept.".into(),
    }
}

/// Whether any part of a scene has a limit on its error.
fn states_error(scene: &Value) -> bool {
    match scene {
        Value::Object(fields) => {
            fields.iter().any(|(key, value)| key == "max_error" && !value.is_null() || states_error(value))
        }
        Value::Array(items) => items.iter().any(states_error),
        _ => false,
    }
}

/// A row for all that call the same at the same cost.
fn of_callers(manifest: &Manifest) -> Block {
    let columns = "materials and probes|call|operations|fetches|bytes";
    let row = |Callers { names, calls, cost }: Callers| {
        let figures = [cost.ops, cost.fetches].map(|n| n.to_string());
        let words = [names.join(", "), calls.join(", ")].into_iter();
        words.chain(figures).chain([numbers::grouped(cost.bytes)]).collect()
    };
    let rows = callers(&manifest.entries.calls).into_iter().map(row).collect();
    let caption = "Of functions that stand for one another the recommended one comes first; it is what counts in operations, fetches and bytes, which are in all.";
    Block::Table(words::table(columns, rows, caption))
}

/// A row for each function, with who calls it.
fn calls(manifest: &Manifest) -> Block {
    let all = &manifest.entries.calls;
    let found = lobefit_math::groups(all, |call| (&call.function, &call.layer));
    let is_preferred =
        |call: &Call| all.iter().any(|one| one.function == call.function && one.is_preferred(all));
    let row = |(_, calls): &(_, Vec<&Call>)| {
        let (call, names) = (calls[0], calls.iter().map(|call| call.of.as_str()).collect::<Vec<_>>());
        let Cost { ops, fetches, bytes } = call.cost;
        let figures = [ops, fetches].map(|n| n.to_string()).into_iter().chain([numbers::grouped(bytes)]);
        let words = [
            call.signature() + &call.of_layer(),
            if is_preferred(call) {
                "yes"
            } else if call.recommended {
                "the only one"
            } else {
                "no"
            }
            .into(),
            call.effect.clone(),
            numbers::shortened(&some(&names)),
            words::max(call.max_error),
            call.metric.clone(),
        ];
        words.into_iter().chain(figures).collect()
    };
    let links = found.iter().map(|(_, calls)| place(manifest, &calls[0].effect, &calls[0].name)).collect();
    let caption =
        "Errors are rounded up. The functions stand in fits/, in each language; their comments say more.";
    let rows = found.iter().map(row).collect();
    let names = Some(Names { column: 0, places: Vec::new(), links });
    Block::Table(TextTable { names, ..words::table(CALLS, rows, caption) })
}

/// The first names, and how many more there are: [`of_callers`] has all.
pub(super) fn some(names: &[&str]) -> String {
    match names.len().saturating_sub(NAMED) {
        0 | 1 => names.join(", "),
        more => format!("{} and {more} more", names[..NAMED].join(", ")),
    }
}

/// Where the page of an effect has the approximation of a name; none of what is neither a table nor a
/// fit.
fn place(manifest: &Manifest, effect: &str, name: &str) -> Option<String> {
    let is_table = manifest.entries.tables.iter().any(|table| table.effect == effect && table.name == name);
    let is_fit = manifest.entries.fits.iter().any(|fit| fit.effect == effect && fit.name == name);
    let at = if is_table { figures_of(name) } else { place_of(name) };
    (is_table || is_fit).then(|| format!("{effect}.html#{at}"))
}

/// Tables and fits by effect, in the order of the effects.
fn rows(manifest: &Manifest) -> Block {
    let of_effect = |effect: &str| {
        let entries = manifest.entries.of(effect);
        let tables = entries.tables.iter().map(table).collect::<Vec<_>>();
        tables.into_iter().chain(entries.fits.iter().map(fit)).collect::<Vec<_>>()
    };
    let rows: Vec<Vec<String>> = manifest.effects.iter().flat_map(|e| of_effect(&e.effect)).collect();
    let links = rows.iter().map(|row| place(manifest, &row[0], &row[NAME])).collect();
    let caption = "The largest error of the use (lookup error of a table, furnace error of a normalisation), rounded up.";
    let names = Some(Names { column: NAME, places: Vec::new(), links });
    Block::Table(TextTable { names, ..words::table(COLUMNS, rows, caption) })
}

fn table(t: &TableEntry) -> Vec<String> {
    let smith = t.smith.as_deref().unwrap_or_default();
    let [effect, name, quantity, used_as] = [&t.effect, &t.name, &t.quantity, &t.used_as].map(String::as_str);
    row([effect, name, quantity, used_as, smith], t.error.lookup.max, &t.cost)
}

fn fit(f: &FitEntry) -> Vec<String> {
    let smith = f.smith.as_deref().unwrap_or_default();
    let names = [&f.effect, &f.name, &f.quantity, &f.used_as].map(String::as_str);
    let [effect, name, quantity, used_as] = names;
    row([effect, name, quantity, used_as, smith], f.certificate.max_abs, &f.cost)
}

fn row(names: [&str; 5], max: f64, cost: &Cost) -> Vec<String> {
    let figures =
        [words::max(max), cost.ops.to_string(), cost.fetches.to_string(), numbers::grouped(cost.bytes)];
    names.into_iter().map(String::from).chain(figures).collect()
}
