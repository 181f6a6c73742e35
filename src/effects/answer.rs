//! What a reader takes from an effect: of everything that its bake measured, up to three choices
//! for each purpose.

use super::table::BakedTable;
use super::{BakeError, Made};
use crate::approximate::Fit;
use crate::data::{Approximation, Cost, Form, Layout, Norm, Source, Use};
use crate::emit::call::LookupFunction;
use crate::report::numbers::{grouped, significant};
use crate::report::sections::words::{self, operations};
use crate::report::{Answer, Furnace, FurnaceRow, Measured, Offer, Purpose, Role};
use lobefit_shade::code::{self, Language};

/// The error that a recommended fit keeps where the scene states none.
const USUAL_ERROR: f64 = 0.02;

/// What is recommended.
pub(crate) const RECOMMENDED: &str =
    "It is the cheapest within the stated error (0.02 where none is stated), or the most accurate.";

/// Spheres of a strip, and every how many of their cosines it is drawn from.
const SPHERES: usize = 6;
const EVERY: usize = 3;

/// The purposes of the fits of a job: those of which any is emitted.
///
/// # Errors
/// A formula that cannot be printed.
pub(super) fn of_fits(
    fits: &[Fit],
    limit: Option<f64>,
    languages: &[Language],
) -> Result<Vec<Purpose>, BakeError> {
    let mut groups: Vec<Vec<&Fit>> = Vec::new();
    let key = |fit: &Fit| {
        let a = &fit.approximation;
        (a.quantity.clone(), a.column.clone(), a.used_as)
    };
    for fit in fits {
        match groups.iter_mut().find(|group| key(group[0]) == key(fit)) {
            Some(group) => group.push(fit),
            None => groups.push(vec![fit]),
        }
    }
    groups.iter().filter_map(|group| of_group(group, limit, languages).transpose()).collect()
}

fn of_group(
    group: &[&Fit],
    limit: Option<f64>,
    languages: &[Language],
) -> Result<Option<Purpose>, BakeError> {
    let Some(best) = recommended(group, limit.unwrap_or(USUAL_ERROR)) else { return Ok(None) };
    let mut choices = vec![offer(Role::Recommended, best, languages)?];
    if let Some(cheap) = cheap(group, best) {
        choices.insert(0, offer(Role::Cheap, cheap, languages)?);
    }
    let a = &best.approximation;
    let smith = a.smith.map_or_else(String::new, |smith| format!(", {} Smith", smith.name()));
    let about = match a.used_as.name {
        "value" => format!("{} of {}{smith}.", a.column, a.quantity),
        _ => format!("{}: {}{smith}.", a.quantity, a.used_as.meaning),
    };
    Ok(Some(Purpose {
        name: best.hypothesis.name().into(),
        about,
        caution: String::new(),
        metric: metric(a),
        choices,
        measured: group.iter().map(|fit| measured(&fit.approximation)).collect(),
        furnace: None,
    }))
}

/// Of a purpose with several emitted fits, which to take, in words.
pub(super) fn recommends(purpose: &Purpose) -> Option<String> {
    let offer = purpose.choices.iter().find(|offer| offer.role == Role::Recommended)?;
    Some(format!("Recommended: {}. {RECOMMENDED}", offer.function.as_ref()?))
}

/// The cheapest of the emitted fits that keeps the limit, else the most accurate.
fn recommended<'a>(group: &[&'a Fit], limit: f64) -> Option<&'a Fit> {
    let emitted = || group.iter().copied().filter(|fit| fit.emitted);
    let keeping = emitted().filter(|fit| error(fit) <= limit);
    let cheapest = keeping.min_by_key(|fit| (fit.approximation.cost.ops, fit.norm() != Norm::Max.name()));
    cheapest.or_else(|| emitted().min_by(|a, b| error(a).total_cmp(&error(b))))
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
    Ok(Offer {
        role,
        name: a.name.clone(),
        function: fit.emitted.then(|| fit.hypothesis.name().to_string()),
        error: Some(errors(a)),
        metric: String::new(),
        cost: a.cost,
        code: if fit.emitted { Vec::new() } else { printed? },
    })
}

fn errors(a: &Approximation) -> [f64; 2] {
    [a.certificate.max_abs, a.certificate.rms]
}

fn measured(a: &Approximation) -> Measured {
    Measured {
        name: a.name.clone(),
        ops: a.cost.ops,
        error: errors(a),
        published: matches!(a.source, Source::Published(_)),
        table: a.cost.fetches > 0,
    }
}

fn of_table(role: Role, table: &BakedTable, purpose: &str) -> Offer {
    let a = &table.approximation;
    let own = metric(a);
    let metric = if own == purpose { String::new() } else { own };
    let (function, error) = (Some(table.names.lookup.clone()), Some(errors(a)));
    Offer { role, name: a.name.clone(), function, error, metric, cost: a.cost, code: Vec::new() }
}

/// What the error of an approximation is; of a table it is that of its lookup.
pub(super) fn metric(a: &Approximation) -> String {
    match a.form {
        Form::Formula(_) => a.used_as.metric.into(),
        Form::Table(_) if a.used_as == Use::F0_BLEND => "lookup error of f0 A + B, for the worst f0".into(),
        Form::Table(_) => format!("lookup error of {}", a.column),
    }
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
    let key = |t: &BakedTable| {
        let a = &t.approximation;
        (a.quantity.clone(), a.column.clone(), t.side, t.layout == Layout::Azimuth)
    };
    let mut groups: Vec<Vec<&BakedTable>> = Vec::new();
    for table in rest {
        match groups.iter_mut().find(|group| key(group[0]) == key(table)) {
            Some(group) => group.push(table),
            None => groups.push(vec![table]),
        }
    }
    for group in groups {
        let ours = group.iter().copied().filter(|t| t.layout != Layout::PathTracer);
        let Some(best) = ours.min_by(by_error).or_else(|| group.iter().copied().min_by(by_error)) else {
            continue;
        };
        purposes.push(of_tables(&group, best));
    }
}

fn of_tables(group: &[&BakedTable], best: &BakedTable) -> Purpose {
    let a = &best.approximation;
    let cost = |t: &&&BakedTable| (t.approximation.cost.bytes, t.approximation.cost.ops);
    let metric = metric(a);
    let mut choices = vec![of_table(Role::Recommended, best, &metric)];
    let cheaper = group.iter().filter(|t| t.approximation.name != a.name && cost(t) < cost(&&best));
    if let Some(cheap) = cheaper.min_by_key(cost) {
        choices.insert(0, of_table(Role::Cheap, cheap, &metric));
    }
    let side = best.side.map_or_else(String::new, |side| format!(", from {}", side.name()));
    Purpose {
        name: best.names.lookup.clone(),
        about: format!("Table of {} of {}{side}.", a.column, a.quantity),
        caution: String::new(),
        metric,
        choices,
        measured: group.iter().map(|t| measured(&t.approximation)).collect(),
        furnace: None,
    }
}

/// Lookups of probes: the fewest operations, the fewest of those with the most fetches, and the
/// most operations. The error of a lookup is that of the width that it fetches.
fn of_lookups(lookups: &[LookupFunction], fits: &[Fit]) -> Option<Purpose> {
    let ops = |lookup: &&LookupFunction| lookup.cost.ops;
    let most = lookups.iter().map(|lookup| lookup.cost.fetches).max()?;
    let best = lookups.iter().filter(|lookup| lookup.cost.fetches == most).min_by_key(ops)?;
    let width =
        |lookup: &LookupFunction| fits.iter().map(|fit| &fit.approximation).find(|a| a.name == lookup.width);
    let offer = |role: Role, lookup: &LookupFunction| Offer {
        role,
        name: lookup.function.clone(),
        function: Some(lookup.function.clone()),
        error: width(lookup).map(errors),
        metric: String::new(),
        cost: Cost { ops: lookup.cost.ops, fetches: lookup.cost.fetches, bytes: lookup.cost.bytes },
        code: Vec::new(),
    };
    let mut choices = vec![offer(Role::Recommended, best)];
    let cheap = lookups.iter().min_by_key(ops).filter(|lookup| ops(lookup) < ops(&best));
    let dear = lookups.iter().max_by_key(ops).filter(|lookup| ops(lookup) > ops(&best));
    choices.splice(0..0, cheap.map(|lookup| offer(Role::Cheap, lookup)));
    choices.extend(dear.map(|lookup| offer(Role::Accurate, lookup)));
    Some(Purpose {
        name: best.function.clone(),
        about: format!("Lookup of a probe through a proxy of its room. {}", arguments(&best.inputs)),
        caution: String::new(),
        metric: width(best).map_or_else(String::new, metric),
        choices,
        measured: Vec::new(),
        furnace: None,
    })
}

/// What the arguments of a lookup are, in one sentence; the comment of the function says more.
fn arguments(inputs: &[String]) -> String {
    let meaning = |input: &String| {
        let meaning = match input.as_str() {
            "place" => "the shaded point",
            "ray" => "the reflected ray, of unit length",
            "normal" => "the surface's, of unit length",
            "view" => "towards the viewer, of unit length",
            "alpha" => "the lobe's width",
            "low" => "lowest corner of the box",
            "high" => "its highest corner",
            "planes" => "those of the proxy",
            "probe" => "where the cubemap was taken",
            "offset" => "from the probe to what the ray hits",
            "distance" => "from the shaded point to there",
            _ => return input.clone(),
        };
        format!("{input} ({meaning})")
    };
    format!("Arguments: {}.", inputs.iter().map(meaning).collect::<Vec<_>>().join(", "))
}

/// The strip of a purpose: the first row of the furnace, and one for each choice that has one.
fn strip(purpose: &Purpose, furnaces: &[Furnace]) -> Option<Furnace> {
    let row = |furnace: &Furnace, offer: &Offer| {
        let own = furnace.rows.iter().find(|row| row.of == offer.name)?;
        Some(FurnaceRow { name: offer.role.name().into(), ..own.clone() })
    };
    let furnace = furnaces.iter().find(|f| purpose.choices.iter().any(|choice| row(f, choice).is_some()))?;
    // What there is without a choice: nothing, or the first published factor.
    let offered = |row: &&FurnaceRow| purpose.choices.iter().any(|choice| choice.name == row.of);
    let before = furnace.rows.first().filter(|row| !offered(row)).cloned().map(|row| match row.of.as_str() {
        "" => FurnaceRow { name: "uncompensated".into(), ..row },
        _ => row,
    });
    let rows = before.into_iter().chain(purpose.choices.iter().filter_map(|choice| row(furnace, choice)));
    let n = furnace.roughness.len();
    let columns: Vec<usize> = if n <= SPHERES {
        (0..n).collect()
    } else {
        (0..SPHERES).map(|i| ((i + 1) * n).div_ceil(SPHERES) - 1).collect()
    };
    let last = furnace.mu.len().saturating_sub(1);
    let kept = |values: &[f64]| -> Vec<f64> {
        let all = values.iter().enumerate();
        all.filter(|(k, _)| (last - k).is_multiple_of(EVERY) || *k == 0).map(|(_, x)| *x).collect()
    };
    let thinned = |row: FurnaceRow| FurnaceRow {
        factors: columns.iter().filter_map(|&j| row.factors.get(j)).map(|f| kept(f)).collect(),
        of: String::new(),
        ..row
    };
    Some(Furnace {
        roughness: columns.iter().map(|&j| furnace.roughness[j]).collect(),
        mu: kept(&furnace.mu),
        rows: rows.map(thinned).collect(),
        amplification: furnace.amplification,
    })
}

/// The answer of an effect that was baked.
pub(super) fn answer(made: &Made) -> Answer {
    let mut purposes = made.purposes.clone();
    add_tables(&mut purposes, &made.fits, &made.tables);
    purposes.splice(0..0, of_lookups(&made.part.entries.lookups, &made.fits));
    for purpose in &mut purposes {
        purpose.furnace = strip(purpose, &made.furnaces);
        let caution = made.cautions.iter().find(|(function, _)| *function == purpose.name);
        purpose.caution = caution.map(|(_, text)| text.clone()).unwrap_or_default();
    }
    // What has no error of its own is followed by what it is made of.
    let judged = |purpose: &Purpose| purpose.choices.iter().any(|choice| choice.error.is_some());
    let last = purposes.iter().position(judged).map_or(purposes.len(), |i| i + 1);
    let conclusion = purposes[..last].iter().map(conclusion).collect::<Vec<_>>().join(" ");
    Answer { effect: made.part.by.name().into(), conclusion, purposes }
}

/// One sentence: what the recommended choice takes and keeps, and what stands beside it.
fn conclusion(purpose: &Purpose) -> String {
    let of = |role: Role| purpose.choices.iter().find(|choice| choice.role == role);
    let Some(best) = of(Role::Recommended) else { return String::new() };
    let kept = |offer: &Offer| {
        let metric = if offer.metric.is_empty() { &purpose.metric } else { &offer.metric };
        offer.error.map_or_else(String::new, |[max, _]| format!(", {metric} at most {}", words::max(max)))
    };
    let mut text = format!("{}: {}{}", purpose.name, taken(&best.cost), kept(best));
    let published = purpose.measured.iter().filter(|m| m.published && m.ops <= best.cost.ops);
    let theirs = published.min_by(|a, b| a.error[0].total_cmp(&b.error[0]));
    if let (Some(theirs), Some([ours, _])) = (theirs, best.error) {
        let (ratio, name) = (theirs.error[0] / ours, &theirs.name);
        if ratio > 1.0 {
            let times = significant(ratio, 2);
            text +=
                &format!(", {times} times less than the best published formula that costs no more ({name})");
        }
    }
    text.push('.');
    if !purpose.caution.is_empty() {
        text += &format!(" {}", purpose.caution);
    }
    let beside = [Role::Table, Role::Cheap].into_iter().find_map(of);
    if let Some(offer) = beside {
        text += &format!(" {}: {}{}.", titled(offer.role), taken(&offer.cost), kept(offer));
    }
    text
}

/// A role as it begins a sentence.
fn titled(role: Role) -> &'static str {
    match role {
        Role::Cheap => "Cheaper",
        Role::Recommended => "Recommended",
        Role::Accurate => "More accurate",
        Role::Table => "As a table",
    }
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
