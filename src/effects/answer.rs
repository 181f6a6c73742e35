//! What a reader takes from an effect: of everything that its bake measured, up to three choices
//! for each purpose.

use std::cmp::Reverse;

use super::made::Limited;
use super::table::BakedTable;
use super::{BakeError, Made};
use crate::approximate::{Emission, Fit};
use crate::data::{Approximation, Axis, Cost, Form, Layout, Source, Table, Use, Warp};
use crate::emit::call::{Call, LookupFunction, SPLIT, TIMES};
use crate::emit::manifest::Entries;
use crate::report::numbers::{brief, grouped, significant};
use crate::report::sections::words::{self, operations};
use crate::report::{Answer, Furnace, FurnaceRow, Measured, Offer, Purpose, Role};
use crate::scene::limits::TABLE_MU;
use lobefit_shade::code::{self, Language};

/// What happens where planes of a proxy meet, as the manifest has it, the most accurate first; a hit, which
/// has none, leaves the wall to the engine.
const EDGES: [&str; 3] = ["smooth", "sharp", "none"];

/// Every how many of the cosines of spheres a strip is drawn from.
const EVERY: usize = 3;

/// The purposes of the fits of a job: those of which any is emitted.
///
/// # Errors
/// A formula that cannot be printed.
pub(super) fn of_fits(fits: &[Fit], languages: &[Language]) -> Result<Vec<Purpose>, BakeError> {
    let groups = lobefit_math::groups(fits, |fit| {
        let a = &fit.approximation;
        (&a.quantity, &a.column, a.used_as, a.side)
    });
    groups.iter().filter_map(|(_, group)| of_group(group, languages).transpose()).collect()
}

fn of_group(group: &[&Fit], languages: &[Language]) -> Result<Option<Purpose>, BakeError> {
    let best = group.iter().find(|fit| fit.emitted && fit.recommended);
    let Some(best) = best else { return Ok(None) };
    let mut choices = vec![offer(Role::Recommended, best, languages)?];
    if let Some(cheap) = cheap(group, best) {
        choices.push(offer(Role::Cheap, cheap, languages)?);
    }
    let a = &best.approximation;
    let smith = a.smith.map_or_else(String::new, |smith| format!(", {} Smith", smith.name()));
    let side = a.side.map_or_else(String::new, |side| format!(", from {}", side.name()));
    let about = match a.used_as.name {
        "value" => format!("{} of {}{smith}{side}.", a.column, a.quantity),
        _ if a.used_as.meaning.contains(&a.quantity) => {
            sentence(&format!("{}{smith}{side}.", a.used_as.meaning))
        }
        _ => format!("{}: {}{smith}{side}.", a.quantity, a.used_as.meaning),
    };
    Ok(Some(Purpose {
        name: best.hypothesis.name().into(),
        about,
        metric: metric(a),
        choices,
        measured: group.iter().map(|fit| measured(&fit.approximation)).collect(),
        ..Purpose::default()
    }))
}

/// A text with a capital at its beginning.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The most accurate of ours for at most half the operations; if there is none, for fewer.
fn cheap<'a>(group: &[&'a Fit], best: &Fit) -> Option<&'a Fit> {
    let ops = |fit: &Fit| fit.approximation.cost.ops;
    let within = |most: u32| {
        let ours = group.iter().copied().filter(|fit| fit.approximation.source == Source::Fitted);
        ours.filter(|fit| ops(fit) <= most).min_by(|a, b| error(a).total_cmp(&error(b)))
    };
    within(ops(best) / 2).or_else(|| within(ops(best).saturating_sub(1)))
}

fn error(fit: &Fit) -> f64 {
    fit.approximation.certificate.max_abs
}

fn offer(role: Role, fit: &Fit, languages: &[Language]) -> Result<Offer, BakeError> {
    let a = &fit.approximation;
    let print = |language: &Language| {
        let printed = code::print(*language, &fit.hypothesis, &fit.coefficients(), &[])?;
        Ok((language.title().to_string(), printed.text.trim_end().to_string()))
    };
    let printed = languages.iter().map(print).collect::<Result<Vec<_>, BakeError>>();
    let function = fit.emitted.then(|| fit.hypothesis.name().to_string());
    let code = if fit.emitted { Vec::new() } else { printed? };
    Ok(Offer { code, ..Offer::new(role, &a.name, function, (a.cost, Some(errors(a)))) })
}

fn errors(a: &Approximation) -> [f64; 2] {
    [a.certificate.max_abs, a.certificate.rms]
}

fn measured(a: &Approximation) -> Measured {
    Measured {
        name: a.name.clone(),
        ops: a.cost.ops,
        error: errors(a),
        limited: None,
        published: matches!(a.source, Source::Published(_)),
        table: a.cost.fetches > 0,
    }
}

fn of_table(role: Role, table: &BakedTable, purpose: &str) -> Offer {
    let a = &table.approximation;
    let own = metric(a);
    let metric = if own == purpose { String::new() } else { own };
    let function = Some(table.names.lookup.clone());
    let note = a.certificate.domain.get("mu").map_or_else(String::new, part);
    Offer { metric, note, ..Offer::new(role, &a.name, function, (a.cost, Some(errors(a)))) }
}

/// What a card says of a table that is judged over a part of the views.
fn part(mu: &[f64; 2]) -> String {
    let [low, high] = mu.map(|x| f64::from(x as f32));
    let all = TABLE_MU.map(|x| f64::from(x as f32));
    if low <= all[0] && high >= all[1] {
        return String::new();
    }
    let [low, high] = mu.map(|x| brief(x, 3));
    format!("Its error is that over n_dot_v {low} to {high}; beyond it nothing is drawn of it.")
}

/// What the error of an approximation is; of a table it is that of its lookup.
pub(super) fn metric(a: &Approximation) -> String {
    match a.form {
        Form::Formula(_) => a.used_as.metric.into(),
        Form::Table(_) if a.used_as == Use::F0_BLEND => "lookup error of f0 A + B, for the worst f0".into(),
        Form::Table(ref table) => format!("lookup error of {}{}", a.column, mean(table)),
    }
}

/// What a table is a mean of, where its truth depends on more than its axes.
fn mean(table: &Table) -> &'static str {
    let has = |axis: &Axis| axis.name == "anisotropy";
    let is_resolved = |axis: &Axis| axis.warp == Warp::HomogeneousAzimuth || axis.name == "cos2_phi";
    let is_mean = table.axes.iter().any(has) && !table.axes.iter().any(is_resolved);
    if is_mean { " in the mean over the azimuth" } else { "" }
}

/// Adds tables: to the fits of the same column the most accurate, the others as purposes of their
/// own, each with the most accurate of a layout of ours and the one that takes least beside it.
fn add_tables(purposes: &mut Vec<Purpose>, fits: &[Fit], tables: &[BakedTable]) {
    let same = |a: &Approximation, b: &Approximation| a.quantity == b.quantity && a.column == b.column;
    let by_error = |a: &&BakedTable, b: &&BakedTable| {
        errors(&a.approximation)[0].total_cmp(&errors(&b.approximation)[0])
    };
    let mut rest: Vec<&BakedTable> = tables.iter().collect();
    for purpose in purposes.iter_mut() {
        let known = |name: &str| purpose.choices.iter().any(|choice| choice.name == name);
        let Some(fit) = fits.iter().find(|fit| known(&fit.approximation.name)) else { continue };
        let (own, others): (Vec<_>, Vec<_>) =
            rest.into_iter().partition(|t| same(&t.approximation, &fit.approximation));
        rest = others;
        purpose.measured.extend(own.iter().map(|t| measured(&t.approximation)));
        if let Some(best) = own.into_iter().min_by(by_error) {
            purpose.choices.push(of_table(Role::Table, best, &purpose.metric));
        }
    }
    let mut groups = lobefit_math::groups(rest, |t| {
        let a = &t.approximation;
        (&a.quantity, &a.column, t.side, t.layout == Layout::Azimuth)
    });
    // What is resolved goes before its mean.
    groups.sort_by_key(|(_, group)| group.iter().all(|table| table.layout != Layout::Azimuth));
    let mut last = None;
    for (_, group) in groups {
        let ours = group.iter().copied().filter(|t| t.layout != Layout::PathTracer);
        let Some(best) = ours.min_by(by_error).or_else(|| group.iter().copied().min_by(by_error)) else {
            continue;
        };
        // A surface is met from both of its sides.
        let of = (best.side.is_some(), &best.approximation.quantity);
        let is_other_side = best.side.is_some() && last == Some(of);
        last = Some(of);
        purposes.push(Purpose { is_other_side, ..of_tables(&group, best) });
    }
}

fn of_tables(group: &[&BakedTable], best: &BakedTable) -> Purpose {
    let a = &best.approximation;
    let cost = |t: &&&BakedTable| (t.approximation.cost.bytes, t.approximation.cost.ops);
    let metric = metric(a);
    let mut choices = vec![of_table(Role::Recommended, best, &metric)];
    let cheaper = group.iter().filter(|t| t.approximation.name != a.name && cost(t) < cost(&&best));
    if let Some(cheap) = cheaper.min_by_key(cost) {
        choices.push(of_table(Role::Cheap, cheap, &metric));
    }
    let side = best.side.map_or_else(String::new, |side| format!(", from {}", side.name()));
    Purpose {
        name: best.names.lookup.clone(),
        about: format!("Table of {} of {}{side}.", a.column, a.quantity),
        metric,
        choices,
        measured: group.iter().map(|t| measured(&t.approximation)).collect(),
        ..Purpose::default()
    }
}

/// The order in which lookups of probes are taken: by edges, then by fetches and by operations, of which more
/// are for those who ask for them.
fn preference(lookup: &LookupFunction) -> (Option<usize>, u32, u32) {
    let edges = EDGES.iter().position(|edges| lookup.edges == *edges);
    (edges, lookup.cost.fetches, lookup.cost.ops)
}

/// The lookup of a probe that is taken before the others.
pub(crate) fn preferred(lookups: &[LookupFunction]) -> Option<&LookupFunction> {
    lookups.iter().min_by_key(|lookup| preference(lookup))
}

/// Of lookups within a limit the most accurate: more fetches are nearer to the lobe.
pub(crate) fn most_accurate<'a>(
    lookups: impl Iterator<Item = &'a LookupFunction>,
) -> Option<&'a LookupFunction> {
    lookups.min_by_key(|lookup| {
        let (edges, fetches, ops) = preference(lookup);
        (edges, Reverse(fetches), ops)
    })
}

/// Lookups of probes: the fewest operations, the preferred, and the most operations. The error of a
/// lookup is that of the width that it fetches.
fn of_lookups(lookups: &[LookupFunction], fits: &[Fit]) -> Option<Purpose> {
    let ops = |lookup: &&LookupFunction| lookup.cost.ops;
    let best = preferred(lookups)?;
    let width =
        |lookup: &LookupFunction| fits.iter().map(|fit| &fit.approximation).find(|a| a.name == lookup.width);
    let offer = |role: Role, lookup: &LookupFunction| {
        let function = Some(lookup.function.clone());
        Offer::new(role, &lookup.function, function, (lookup.cost, width(lookup).map(errors)))
    };
    let mut choices = vec![offer(Role::Recommended, best)];
    let cheap = lookups.iter().min_by_key(ops).filter(|lookup| ops(lookup) < ops(&best));
    let dear = lookups.iter().max_by_key(ops).filter(|lookup| ops(lookup) > ops(&best));
    choices.extend(cheap.map(|lookup| offer(Role::Cheap, lookup)));
    choices.extend(dear.map(|lookup| offer(Role::Accurate, lookup)));
    Some(Purpose {
        name: best.function.clone(),
        about: format!("Lookup of a probe through a proxy of its room. {}", best.arguments),
        metric: width(best).map_or_else(String::new, metric),
        choices,
        ..Purpose::default()
    })
}

/// The strip of a purpose: the first row of the furnace, and one for each choice that has one.
fn strip(purpose: &Purpose, furnaces: &[Furnace]) -> Option<Furnace> {
    let row = |furnace: &Furnace, offer: &Offer| {
        let own = furnace.rows.iter().find(|row| row.of == offer.name)?;
        Some(FurnaceRow { name: offer.role.name().into(), ..own.clone() })
    };
    // Spheres of other choices alone would say nothing of what is recommended.
    let best = purpose.choices.first()?;
    let furnace = furnaces.iter().find(|f| row(f, best).is_some())?;
    // What there is without a choice: nothing, or the first published factor.
    let offered = |row: &&FurnaceRow| purpose.choices.iter().any(|choice| choice.name == row.of);
    let before = furnace.rows.first().filter(|row| !offered(row)).cloned().map(|row| match row.of.as_str() {
        "" => FurnaceRow { name: "uncompensated".into(), ..row },
        _ => row,
    });
    let rows = before.into_iter().chain(purpose.choices.iter().filter_map(|choice| row(furnace, choice)));
    let last = furnace.mu.len().saturating_sub(1);
    let kept = |values: &[f64]| -> Vec<f64> {
        let all = values.iter().enumerate();
        all.filter(|(k, _)| (last - k).is_multiple_of(EVERY) || *k == 0).map(|(_, x)| *x).collect()
    };
    let thinned = |row: FurnaceRow| FurnaceRow {
        factors: row.factors.iter().map(|f| kept(f)).collect(),
        of: String::new(),
        ..row
    };
    Some(Furnace {
        roughness: furnace.roughness.clone(),
        mu: kept(&furnace.mu),
        rows: rows.map(thinned).collect(),
        amplification: furnace.amplification,
    })
}

/// The answer of an effect that was baked.
pub(super) fn answer(made: &Made) -> Answer {
    let (mut purposes, entries) = (made.purposes.clone(), &made.part.entries);
    add_tables(&mut purposes, &made.fits, &made.tables);
    purposes.splice(0..0, of_lookups(&entries.lookups, &made.fits));
    for purpose in &mut purposes {
        let beside = made.beside.iter().filter(|(function, _)| *function == purpose.name);
        for (_, offer) in beside {
            if purpose.choices.iter().all(|choice| choice.role != offer.role) {
                purpose.choices.push(offer.clone());
            }
        }
        if let Some(limited) = &made.limited {
            limit(purpose, limited, &entries.lookups);
        }
        purpose.choices.iter_mut().for_each(|offer| offer.coloured = coloured(offer, entries));
        purpose.furnace = strip(purpose, &made.furnaces);
        let caution = made.cautions.iter().find(|(function, _)| *function == purpose.name);
        purpose.caution = caution.map(|(_, text)| text.clone()).unwrap_or_default();
    }
    // What has no error of its own, a lookup say, is followed by what it is made of.
    let judged = |purpose: &Purpose| !purpose.measured.is_empty();
    let first = purposes.iter().position(judged).map_or(purposes.len(), |i| i + 1);
    let last = first + purposes[first..].iter().take_while(|purpose| purpose.is_other_side).count();
    let conclusion = purposes[..last].iter().map(self::conclusion).collect::<Vec<_>>().join(" ");
    let also = purposes[last..].iter().map(self::conclusion).collect();
    Answer { effect: made.part.by.name().into(), conclusion, also, purposes }
}

impl Limited {
    /// The error of a function; for a lookup, the error of its width.
    fn of(&self, name: &str, lookups: &[LookupFunction]) -> Option<f64> {
        let width = lookups.iter().find(|lookup| lookup.function == name).map(|lookup| &lookup.width);
        self.errors.get(width.map_or(name, String::as_str)).copied()
    }
}

/// Notes the error that the scene limits.
fn limit(purpose: &mut Purpose, limited: &Limited, lookups: &[LookupFunction]) {
    purpose.limited.clone_from(&limited.metric);
    for offer in &mut purpose.choices {
        offer.limited = limited.of(&offer.name, lookups).or(offer.limited);
    }
    for measured in &mut purpose.measured {
        measured.limited = limited.of(&measured.name, lookups);
    }
}

/// Puts the error that the scene limits into each call, in place of the certificate's.
pub(super) fn limit_calls(entries: &mut Entries, limited: &Limited) {
    for call in &mut entries.calls {
        if let Some(max) = limited.of(&call.name, &entries.lookups) {
            (call.max_error, call.metric) = (max, limited.metric.clone());
        }
    }
}

/// Operations of the form of an offer for three channels, where a material calls that.
fn coloured(offer: &Offer, entries: &Entries) -> Option<u32> {
    let function = offer.function.as_ref()?;
    let rgb = entries.fits.iter().find(|fit| fit.function == *function)?.rgb.as_ref()?;
    entries.calls.iter().find(|call| call.function == *rgb).map(|call| call.cost.ops)
}

/// Notes of each call what for it is, and whether it is the one that its material or probe is to
/// take for that: what is recommended, or where the material has not asked for that, the most
/// accurate, and of lookups the preferred.
pub(super) fn mark(entries: &mut Entries, purposes: &[Purpose]) {
    let Entries { calls, lookups, tables, .. } = entries;
    let lookup = |name: &str| lookups.iter().find(|lookup| lookup.function == name);
    let serves = |purpose: &Purpose, call: &Call| match lookup(&call.function) {
        Some(_) => lookup(&purpose.name).is_some(),
        None => purpose.measured.iter().any(|measured| measured.name == call.name),
    };
    for purpose in purposes {
        let offered = |call: &Call| {
            let name = if lookup(&call.function).is_some() { &call.function } else { &call.name };
            purpose.choices.iter().any(|offer| offer.role == Role::Recommended && offer.name == *name)
        };
        let of_purpose: Vec<usize> = (0..calls.len()).filter(|&i| serves(purpose, &calls[i])).collect();
        for &i in &of_purpose {
            calls[i].purpose.clone_from(&purpose.name);
        }
        for &i in &of_purpose {
            let same = || of_purpose.iter().map(|&k| &calls[k]).filter(|call| call.stands_for(&calls[i]));
            let best = same().find(|call| offered(call)).or_else(|| {
                same().min_by(|a, b| {
                    let rank = |call: &Call| lookup(&call.function).map(preference);
                    a.max_error.total_cmp(&b.max_error).then(rank(a).cmp(&rank(b)))
                })
            });
            calls[i].recommended = best.is_some_and(|best| best.function == calls[i].function);
        }
    }
    // A lobe is compensated once: a table of A and B beside a function N is for f0 A + B.
    for i in 0..calls.len() {
        let (of, layer, purpose) = (&calls[i].of, &calls[i].layer, &calls[i].purpose);
        let own = calls.iter().filter(|call| (&call.of, &call.layer) == (of, layer));
        let is_factor = |call: &Call| call.then.as_deref() == Some(TIMES) && call.purpose != *purpose;
        if calls[i].file.is_some() && own.into_iter().any(is_factor) {
            let own = tables.iter().find(|table| calls[i].file.as_ref() == Some(&table.file));
            let is_split = own.is_some_and(|table| table.decode.contains_key("B"));
            calls[i].then = is_split.then(|| SPLIT.into());
        }
    }
}

/// Which functions to take where materials or probes have a choice, and why: for an include file.
pub(super) fn recommendations(calls: &[Call]) -> Vec<String> {
    let mut purposes: Vec<&str> = Vec::new();
    let chosen: Vec<&Call> = calls.iter().filter(|call| call.is_preferred(calls)).collect();
    for call in &chosen {
        if !purposes.contains(&call.purpose.as_str()) {
            purposes.push(&call.purpose);
        }
    }
    let lines = |purpose: &str| {
        let of_purpose = || chosen.iter().filter(|call| call.purpose == purpose);
        let mut functions: Vec<&str> = Vec::new();
        for call in of_purpose() {
            if !functions.contains(&call.function.as_str()) {
                functions.push(&call.function);
            }
        }
        let rule = of_purpose().next().map(|call| rule(call)).unwrap_or_default();
        let mut lines = vec![format!("Recommended: {}:", functions.join(", "))];
        lines.extend(rule.split_inclusive(", ").map(|part| format!("  {}", part.trim_end())));
        lines
    };
    purposes.into_iter().flat_map(lines).collect()
}

/// Why a call is recommended before others for its purpose.
pub(crate) fn rule(call: &Call) -> String {
    match (&call.file, call.cost.fetches) {
        (Some(_), _) => "the most accurate table".into(),
        (None, 0) => Emission::rule(),
        _ => "the lookup with smooth edges before sharp ones, a traced hit last, and of these the fewest fetches and operations"
            .into(),
    }
}

/// One sentence: what the recommended choice takes and keeps, and what stands beside it.
fn conclusion(purpose: &Purpose) -> String {
    let of = |role: Role| purpose.choices.iter().find(|choice| choice.role == role);
    let Some(best) = of(Role::Recommended) else { return String::new() };
    let kept = |offer: &Offer| {
        let metric = if offer.metric.is_empty() { purpose.kept() } else { &offer.metric };
        offer.kept().map_or_else(String::new, |max| format!(", {metric} at most {}", words::max(max)))
    };
    let in_colour = best.coloured.map_or_else(String::new, |ops| format!(" ({ops} for three channels)"));
    let formula = Some(&best.name).filter(|name| best.cost.fetches == 0 && **name != purpose.name);
    let formula = formula.map_or_else(String::new, |name| format!(" ({name})"));
    let mut text = format!("{}{formula}: {}{in_colour}{}", purpose.name, taken(&best.cost), kept(best));
    let published = purpose.measured.iter().filter(|m| m.published && m.ops <= best.cost.ops);
    let error = |m: &Measured| m.limited.unwrap_or(m.error[0]);
    let theirs = published.min_by(|a, b| error(a).total_cmp(&error(b)));
    if let (Some(theirs), Some(ours)) = (theirs, best.kept()) {
        let (ratio, name) = (error(theirs) / ours, &theirs.name);
        if ratio > 1.0 {
            let times = significant(ratio, 2);
            text +=
                &format!(", {times} times less than the best published formula that costs no more ({name})");
        }
    }
    let as_table = of(Role::Table).map(|offer| ("as a table", offer));
    if let Some((how, offer)) = as_table.or_else(|| Some(("cheaper", of(Role::Cheap)?))) {
        let is_same = offer.error == best.error;
        let error = if is_same { ", at the same error".into() } else { kept(offer) };
        text += &format!("; {how}: {}{error}", taken(&offer.cost));
    }
    text.push('.');
    if !purpose.caution.is_empty() {
        text += &format!(" {}", purpose.caution);
    }
    text
}

/// `15 operations`, `20 operations and a fetch from 2 048 bytes`.
fn taken(cost: &Cost) -> String {
    let bytes = if cost.bytes > 0 { format!(" from {} bytes", grouped(cost.bytes)) } else { String::new() };
    match cost.fetches {
        0 => operations(cost.ops),
        1 => format!("{} and a fetch{bytes}", operations(cost.ops)),
        n => format!("{} and {n} fetches{bytes}", operations(cost.ops)),
    }
}
