//! What materials and probes call, as a table.

use std::collections::{BTreeMap, BTreeSet};

use super::columns::{self, Side::Left, Side::Right};
use crate::data::{Cost, Vendor, natural};
use crate::emit::call::{
    Around, Call, Callers, How, INVERSE, NAMED, OVER, ROUGH_BASE, SPLIT, SPLIT_OVER, TIMES, Uses, arounds,
    callers,
};
use crate::emit::header::short;
use crate::report::sections::words;
use crate::scene::{Kind, Scene};

/// Stands before the recommended function where a material or probe has a choice.
pub(super) const MARK: &str = "*";

/// What is called, a row for each function, with who calls it, and what it costs: operations, and by
/// the model of a vendor's GPUs. What is recommended to a material or probe that has a choice is
/// marked.
pub(super) fn table(calls: &[Call], vendor: Option<Vendor>, scene: &Scene) -> Vec<String> {
    let mut rows: Vec<(&Call, Vec<&str>)> = Vec::new();
    let preferred: Vec<&str> =
        calls.iter().filter(|call| call.is_preferred(calls)).map(|call| call.function.as_str()).collect();
    for call in calls {
        match rows
            .iter_mut()
            .find(|(known, _)| (&known.function, &known.cost) == (&call.function, &call.cost))
        {
            Some((_, names)) if names.contains(&call.of.as_str()) => {}
            Some((_, names)) => names.push(&call.of),
            None => rows.push((call, vec![&call.of])),
        }
    }
    if rows.is_empty() {
        return Vec::new();
    }
    let kinds = scene.materials.iter().map(|material| (material.name.as_str(), material.kind)).collect();
    let row = |(call, names): &(&Call, Vec<&str>)| {
        let Cost { ops, fetches, bytes } = call.cost;
        let price = call.price.filter(|_| vendor.is_some()).map_or_else(String::new, |x| format!("{x:.1}"));
        let figures = [ops.to_string(), fetches.to_string(), bytes.to_string(), short(call.max_error)];
        let [ops, fetches, bytes, error] = figures;
        let mark = match preferred[..] {
            [] => String::new(),
            _ => format!("{:2}", if preferred.contains(&call.function.as_str()) { MARK } else { "" }),
        };
        [mark + &call.function, ops, price, fetches, bytes, error, call.metric.clone(), who(names, &kinds)]
    };
    let priced = vendor.map_or_else(String::new, |vendor| format!("{} cost", vendor.title()));
    let header = [
        ("call", Left),
        ("operations", Right),
        (&*priced, Right),
        ("fetches", Right),
        ("bytes", Right),
        ("max error", Right),
        ("which error", Left),
        ("for", Left),
    ];
    let mut lines = columns::lines(header, &rows.iter().map(row).collect::<Vec<_>>());
    let own =
        rows.iter().map(|(call, _)| [format!("  {}", call.signature()), of_layers(&call.function, calls)]);
    let mut all: Vec<[String; 2]> = Vec::new();
    // Of another cost it is the same function.
    for line in own.chain(around(calls)) {
        if !all.contains(&line) {
            all.push(line);
        }
    }
    lines.extend(columns::lines([("arguments", Left), ("", Left)], &all));
    if rows.iter().any(|(_, names)| names.len() > NAMED) || calls.iter().any(|call| call.without.is_some()) {
        let taken = callers(calls).into_iter();
        lines.extend(taken.map(|Callers { names, calls, cost: Cost { ops, fetches, bytes } }| {
            let fetched = (fetches > 0).then(|| words::count(fetches as usize, "fetch", "fetches"));
            let held = (bytes > 0).then(|| format!("{bytes} bytes"));
            let all = [Some(words::operations(ops)), fetched, held].into_iter().flatten();
            let all = all.collect::<Vec<_>>().join(", ");
            format!("{}: {}; {all} in all", names.join(", "), calls.join(", "))
        }));
    }
    lines
}

/// Whose roughness a function takes: `of the coat`; nothing where that is of the specular lobe alone.
fn of_layers(function: &str, calls: &[Call]) -> String {
    let own = calls.iter().filter(|call| call.function == function);
    let layers: BTreeSet<&str> = own.map(|call| call.layer.as_deref().unwrap_or("lobe")).collect();
    if layers.iter().all(|layer| *layer == "lobe") {
        return String::new();
    }
    let named: Vec<String> = layers.iter().map(|layer| format!("the {layer}")).collect();
    format!("of {}", named.join(" and of "))
}

/// A row for each function about calls: what it does with which.
fn around(calls: &[Call]) -> Vec<[String; 2]> {
    let row = |(around, of): (&Around, Uses)| {
        let mut by_value: BTreeMap<Option<&str>, Vec<&str>> = BTreeMap::new();
        of.into_iter().for_each(|(function, value)| by_value.entry(value).or_default().push(function));
        by_value.values_mut().for_each(|functions| functions.sort_by(|a, b| natural(a, b)));
        let does = |(value, functions): (Option<&str>, Vec<&str>)| match (around.how, value) {
            (How::Calls, _) => format!("calls {}", functions.join(", ")),
            (How::TakesValue, Some(value)) => format!("{value} from {}", any_of(&functions)),
            (How::TakesValue, None) => format!("takes {}", any_of(&functions)),
        };
        [format!("  {}", around.signature()), by_value.into_iter().map(does).collect::<Vec<_>>().join(", ")]
    };
    // What no function does is written out: f is the lobe.
    let values = [
        (OVER, "E"),
        (SPLIT, "A and B"),
        (SPLIT_OVER, "E, A and B"),
        (TIMES, "N"),
        (ROUGH_BASE, "c"),
        (INVERSE, "E"),
    ];
    let written = values.into_iter().filter_map(|(how, value)| {
        let of: BTreeSet<&str> =
            calls.iter().filter(|c| c.then.as_deref() == Some(how)).map(|c| &*c.function).collect();
        let mut of: Vec<&str> = of.into_iter().collect();
        of.sort_by(|a, b| natural(a, b));
        (!of.is_empty()).then(|| {
            let lobe = if [SPLIT, INVERSE].contains(&how) { "" } else { ", f the lobe" };
            [format!("  {how}{lobe}"), format!("{value} from {}", any_of(&of))]
        })
    });
    written.chain(arounds(calls).into_iter().map(row)).collect()
}

/// One of functions that stand above: all of a few, or the first of many.
fn any_of(functions: &[&str]) -> String {
    match functions {
        [first, rest @ ..] if functions.len() > NAMED => format!("{first} or one of {} others", rest.len()),
        few => few.join(" or "),
    }
}

/// The cosines over which the errors of the functions of materials hold, where there are any.
pub(super) fn cosines(calls: &[Call], scene: &Scene) -> Option<String> {
    let of_material = |call: &Call| scene.materials.iter().any(|material| material.name == call.of);
    let [low, high] = scene.mu;
    calls.iter().any(|call| call.file.is_none() && of_material(call)).then(|| {
        format!("errors of functions without a table hold over n_dot_v {low} to {high}, the scene's `mu`")
    })
}

/// `steel, gold`, or of many `10 metals, 26 dielectrics`.
fn who(names: &[&str], of_materials: &BTreeMap<&str, Kind>) -> String {
    if names.len() <= NAMED {
        return names.join(", ");
    }
    let kinds = [
        (Some(Kind::Metal), "metal", "metals"),
        (Some(Kind::Dielectric), "dielectric", "dielectrics"),
        (Some(Kind::Glass), "glass", "glasses"),
        (None, "probe", "probes"),
    ];
    let counted = |(own, one, many): (Option<Kind>, &str, &str)| {
        let n = names.iter().filter(|name| of_materials.get(*name).copied() == own).count();
        (n > 0).then(|| words::count(n, one, many))
    };
    kinds.into_iter().filter_map(counted).collect::<Vec<_>>().join(", ")
}
