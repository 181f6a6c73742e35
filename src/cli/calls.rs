//! What materials and probes call, as a table.

use super::columns::{self, Side::Left, Side::Right};
use crate::data::Vendor;
use crate::emit::call::Call;
use crate::emit::header::short;
use crate::emit::manifest::CostEntry;
use crate::scene::{Kind, Scene};

/// Stands before the recommended function where a material or probe has a choice.
pub(super) const MARK: &str = "*";

/// Most names that stand in a row; more are a group.
const NAMED: usize = 3;

/// What is called, a row for each function, with who calls it, and what it costs: operations, or by
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
            Some((_, names)) => names.push(&call.of),
            None => rows.push((call, vec![&call.of])),
        }
    }
    if rows.is_empty() {
        return Vec::new();
    }
    let mut groups: Vec<(String, &[&str])> = Vec::new();
    for (_, names) in &rows {
        if names.len() > NAMED && groups.iter().all(|(_, known)| known != names) {
            groups.push((label(names, scene, &groups), names));
        }
    }
    let row = |(call, names): &(&Call, Vec<&str>)| {
        let CostEntry { ops, fetches, bytes } = call.cost;
        let cost = call.price.filter(|_| vendor.is_some());
        let cost = cost.map_or_else(|| ops.to_string(), |price| format!("{price:.1}"));
        let figures = [cost, fetches.to_string(), bytes.to_string(), short(call.max_error)];
        let [cost, fetches, bytes, error] = figures;
        let mark = match preferred[..] {
            [] => String::new(),
            _ => format!("{:2}", if preferred.contains(&call.function.as_str()) { MARK } else { "" }),
        };
        [mark + &call.function, cost, fetches, bytes, error, call.metric.clone(), listed(names, &groups)]
    };
    let header = [
        ("call", Left),
        (if vendor.is_some() { "cost" } else { "operations" }, Right),
        ("fetches", Right),
        ("bytes", Right),
        ("max error", Right),
        ("which error", Left),
        ("for", Left),
    ];
    let mut lines = columns::lines(header, &rows.iter().map(row).collect::<Vec<_>>());
    lines.extend(groups.iter().map(|(label, names)| format!("{label}: {}", names.join(", "))));
    lines
}

/// The cosines over which the errors of the functions of materials hold, where there are any.
pub(super) fn cosines(calls: &[Call], scene: &Scene) -> Option<String> {
    let of_material = |call: &Call| scene.materials.iter().any(|material| material.name == call.of);
    let [low, high] = scene.mu;
    calls.iter().any(|call| call.file.is_none() && of_material(call)).then(|| {
        format!("errors of functions without a table hold over n_dot_v {low} to {high}, the scene's `mu`")
    })
}

/// `18 dielectrics`, or where that says two things or too little `group 1 (18)`.
fn label(names: &[&str], scene: &Scene, known: &[(String, &[&str])]) -> String {
    let kind = |name: &&str| {
        let material = scene.materials.iter().find(|material| material.name == **name);
        material.map_or("probes", |material| match material.kind {
            Kind::Metal => "metals",
            Kind::Dielectric => "dielectrics",
            Kind::Glass => "glasses",
        })
    };
    let mut kinds: Vec<&str> = names.iter().map(kind).collect();
    kinds.dedup();
    let label = format!("{} {}", names.len(), kinds.concat());
    match kinds.len() == 1 && known.iter().all(|(other, _)| *other != label) {
        true => label,
        false => format!("group {} ({})", known.len() + 1, names.len()),
    }
}

/// `steel, gold`, or the label of a group.
fn listed(names: &[&str], groups: &[(String, &[&str])]) -> String {
    match groups.iter().find(|(_, group)| *group == names) {
        Some((label, _)) => label.clone(),
        None => names.join(", "),
    }
}
