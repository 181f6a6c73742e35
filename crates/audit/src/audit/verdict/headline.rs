//! The first line: what it is, the figure that the verdict is on, and where.

use super::defect::{LINES, extent};
use super::first_line;
use super::words::{listed, long, number, place, readings_differ};
use crate::audit::table::Source;
use crate::audit::{Audit, Defect, Fit, LookupErrors};

/// The end of a headline.
pub(in crate::audit) fn said_limit(limit: Option<f64>) -> String {
    limit.map_or_else(String::new, |limit| format!("; the limit is {}", number(limit)))
}

/// What it is, how far off it is by what the verdict is on, and the limit.
pub(super) fn headline(audit: &Audit, limit: Option<f64>) -> String {
    headline_of(&audit.what, audit, limit)
}

/// The same of what is called so.
pub(super) fn headline_of(called: &str, audit: &Audit, limit: Option<f64>) -> String {
    let held = audit.channels.iter().filter_map(|c| Some(c.column?.name())).collect::<Vec<_>>();
    let what = format!("{} {}: ", audit.quantity, listed(&held));
    let (found, more) = found(audit, limit);
    first_line([&what, called, &found], &more, &said_limit(limit))
}

/// ` of A`, of several columns.
fn of(audit: &Audit, column: &str) -> String {
    let several = audit.channels.iter().filter(|c| c.column.is_some()).count() > 1;
    if several { format!(" of {column}") } else { String::new() }
}

/// What was found, and what the line says besides where there is room.
fn found(audit: &Audit, limit: Option<f64>) -> (String, Vec<String>) {
    let worst = audit.channels.iter().filter_map(|c| Some((c.column?.name(), c.errors.as_ref()?)));
    let Some((column, worst)) = worst.reduce(|a, b| if b.1.max > a.1.max { b } else { a }) else {
        return (" is not judged".into(), Vec::new());
    };
    let (max, at) = (number(worst.max) + &of(audit, column), place(&worst.at));
    if audit.fit == Fit::None && audit.two_lobes.is_none() {
        let found = match (audit.source, &audit.published) {
            (Source::Table, _) => "fits no convention".into(),
            (Source::Function, None) => "is no approximation of it".into(),
            (Source::Function, Some(known)) => format!("is `{}`, no approximation of it", known.name),
        };
        return (format!(" {found}; the nearest leaves {max} at {at}"), Vec::new());
    }
    if let Some(plain) = audit.misread(limit) {
        let place = if plain.at.is_empty() { String::new() } else { format!(", at {}", place(&plain.at)) };
        let read = readings_differ(audit, audit.best(), &plain.convention);
        let other = format!("; by {max} with {}", briefly(&plain.untold.join(", ")));
        return (
            format!(" is off by at most {} read plainly{place}", number(plain.max)),
            vec![format!(" ({read})"), other],
        );
    }
    let points = format!(" ({} points sampled)", worst.judged);
    if let (Some(error), Some(furnace)) = (audit.furnace_error(), &audit.furnace) {
        let at = place(&furnace.at);
        let found = format!(" leaves |E N - 1| of at most {} at {at}", number(error));
        return (found, vec![of_another(audit), points]);
    }
    if audit.source == Source::Function {
        return (format!(" is off by at most {max} at {at}"), vec![of_another(audit), points]);
    }
    let wrong = wrong(audit).filter(|_| limit.is_none() || audit.fit != Fit::Whole);
    let lookup = largest_lookup(audit).filter(|(_, lookup)| lookup.inner > worst.max);
    let lookup = lookup.map(|(column, lookup)| {
        (format!("{}{} in lookups", number(lookup.inner), of(audit, column)), place(&lookup.inner_at))
    });
    let other = of_another(audit);
    match (wrong, lookup) {
        (Some(wrong), _) => (wrong, Vec::new()),
        (None, None) => (format!(" is off by at most {max}{other} at {at}"), Vec::new()),
        // A limit is on the texels: the figure that is judged stands first.
        (None, Some((lookup, place))) if limit.is_some() => (
            format!(" is off by at most {max} at texels ({at})"),
            vec![other, format!(", {lookup} ({place})")],
        ),
        (None, Some((lookup, place))) if other.is_empty() => {
            (format!(" is off by at most {lookup} ({place})"), vec![format!(", {max} at texels")])
        }
        (None, Some((lookup, _))) => (format!(" is off by at most {lookup}{other}"), Vec::new()),
    }
}

/// Words without what stands behind them in brackets.
fn briefly(words: &str) -> &str {
    words.split_once(" (").map_or(words, |(words, _)| words)
}

/// How far off it is under the quantity's own shadowing, where it is of another.
fn of_another(audit: &Audit) -> String {
    let plain = audit.plain.as_ref().filter(|plain| plain.is_of_another_lobe(audit.best()));
    plain.map_or_else(String::new, |plain| {
        let (own, other) = (audit.best().lobe.words(), plain.convention.lobe.words());
        let max = number(plain.max);
        format!(" as {}, and by {max} as {}", briefly(&own), briefly(&other))
    })
}

/// What about a table is to be mended: of several the worst.
pub(super) fn wrong(audit: &Audit) -> Option<String> {
    if let Some(parts) = &audit.two_lobes {
        let (range, lobe) = (extent(&audit.axes, &parts.range, &parts.size), parts.lobe.words());
        let at = if range.is_empty() { String::new() } else { format!(" at {range}") };
        return Some(format!(
            " is of two lobes: {} of its texels{at} are of {lobe}, off by {} as the others are",
            parts.texels[1],
            number(audit.worst())
        ));
    }
    let channels = audit.channels.iter().filter_map(|c| Some((of(audit, c.column?.name()), &c.defects)));
    let all = channels.flat_map(|(of, defects)| defects.iter().map(move |d| (of.clone(), d)));
    let said = all.filter_map(|(of, defect)| what(audit, &of, defect));
    said.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, text)| text)
}

/// By how much a defect is wrong, in words too; none of one that is in the nature of the format.
fn what(audit: &Audit, of: &str, defect: &Defect) -> Option<(f64, String)> {
    Some(match defect {
        Defect::Part { texels, most, rest, range, size, .. } => {
            let at = match extent(&audit.axes, range, size) {
                at if at.is_empty() => format!("{} texels", texels[0]),
                at => at,
            };
            let rest = number(*rest);
            (*most, format!(" is off by at most {}{of} at {at}, elsewhere by RMS {rest}", number(*most)))
        }
        Defect::Gain { albedo, texel } => (
            albedo - 1.0,
            format!(" gains energy: {} of the light comes back at texel {texel:?}", long(*albedo)),
        ),
        Defect::Dead { line: [axis, index], value } => {
            let (line, name) = (LINES[*axis], &audit.axes[*axis]);
            (
                f64::INFINITY,
                format!(" was never filled at {line} {name} = {index}: it holds {}", number(*value)),
            )
        }
        Defect::Clamped { value, truth, .. } => {
            let (held, truth_text) = (number(*value), number(*truth));
            ((truth - value).abs(), format!(" stands at {held}{of} where the truth goes on to {truth_text}"))
        }
        Defect::MissingLoss { worst: [held, truth], texel, .. } => {
            let text = format!(" holds {} of a loss of {} at texel {texel:?}", number(*held), number(*truth));
            (truth - held, text)
        }
        _ => return None,
    })
}

/// The worst lookup and of what it is: of A alone no pixel is made where a shader blends f0 A + B.
pub(super) fn largest_lookup(audit: &Audit) -> Option<(&'static str, &LookupErrors)> {
    let channels = audit.channels.iter().filter_map(|c| Some((c.column?.name(), c.lookup.as_ref()?)));
    let worst = channels.reduce(|a, b| if b.1.inner > a.1.inner { b } else { a });
    audit.blend.as_ref().map(|blend| ("f0 A + B", blend)).or(worst)
}
