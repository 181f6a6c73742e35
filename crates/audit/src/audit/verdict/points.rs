//! The points of a verdict on a table or function of unknown make.

use super::reason::{only_plain_exceeds, reason};
use super::words::{listed, number, percent, place, reading, readings_differ};
use super::{Grade, Verdict, advice, defect, first_line, words};
use crate::audit::axis::Registration;
use crate::audit::convention::Convention;
use crate::audit::defects::Defect;
use crate::audit::plain::Plain;
use crate::audit::table::Source;
use crate::audit::truth::Beyond;
use crate::audit::{Audit, CLEAR, ChannelAudit, Fit, LookupErrors, Other, TwoLobes};

/// Ranks nearer than this are of conventions that are the same at the texels.
pub(super) const SAME: f64 = 1e-6;

/// How much worse the next convention must rank for the first to be likely.
pub(super) const LIKELY: f64 = 1.2;

/// The verdict; `limit` is the largest error that the user allows.
pub(in crate::audit) fn of(audit: &Audit, limit: Option<f64>) -> Verdict {
    let grade = grade(audit, limit);
    let mut errors = Vec::new();
    if grade != Grade::Pass {
        errors.push(format!("{} since {}.", grade.word(), reason(audit, limit)));
    }
    for (k, channel) in audit.channels.iter().filter(|c| c.column.is_some()).enumerate() {
        errors.extend(at_places(audit, channel, k == 0));
        let known = audit.fit != Fit::None && audit.two_lobes.is_none();
        let told = channel.defects.iter().filter(|d| known || matches!(d, Defect::Dead { .. }));
        errors.extend(told.map(|d| defect::sentence(d, &audit.axes)));
    }
    errors.dedup();
    errors.extend(untold(audit).filter(|_| limit.is_none_or(|limit| !only_plain_exceeds(audit, limit))));
    errors.extend(departure(audit));
    errors.extend(lookups(audit));
    errors.extend(limit.map(|limit| judged(audit, limit)));
    errors.extend(audit.remarks.iter().cloned());
    let named = audit.published.iter().map(|known| {
        format!("It has the values of a published formula, `{}`: {}.", known.name, known.publication)
    });
    let convention: Vec<String> = [opening(audit)].into_iter().chain(named).chain(idle(audit)).collect();
    Verdict {
        grade,
        headline: headline(audit, limit),
        convention: convention.join(" "),
        errors,
        furnace: furnace(audit),
        remedy: advice::advice(audit, limit),
        certainty: doubt(audit),
    }
}

fn grade(audit: &Audit, limit: Option<f64>) -> Grade {
    let unfit = audit.fit == Fit::None && audit.two_lobes.is_none() && audit.published.is_none();
    let sound = |d: &Defect| advice::mending(d, &audit.axes, audit.source).is_none();
    let read = audit.plain.as_ref().is_none_or(|plain| is_usual(audit.best(), &plain.convention));
    let plain = read && audit.channels.iter().flat_map(|c| &c.defects).all(sound);
    match limit {
        _ if unfit => Grade::Unknown,
        Some(limit) if audit.passes(Some(limit)) => Grade::Pass,
        Some(limit) if audit.fit == Fit::Whole && audit.worst_as_read() <= limit => Grade::Unknown,
        None if audit.fit == Fit::Whole && plain => Grade::Pass,
        _ => Grade::Fail,
    }
}

/// Whether a reading is the plain one but for the order of its axes or its shadowing, which many
/// files have of their own: only a limit fails them for it.
fn is_usual(best: &Convention, plain: &Convention) -> bool {
    let ordered = |convention: &Convention| {
        let mut axes = convention.axes.clone();
        axes.sort_by_key(|axis| axis.scale.input());
        axes
    };
    best.columns == plain.columns && ordered(best) == ordered(plain)
}

/// How far off it is under the quantity's own shadowing, where it is of another, or as it is stored,
/// where it is encoded.
fn of_another(audit: &Audit) -> String {
    let is_other = |plain: &&Plain| {
        plain.max.is_finite() && (plain.convention.lobe != audit.best().lobe || audit.encoding.is_some())
    };
    let plain = audit.plain.as_ref().filter(is_other);
    plain.map_or_else(String::new, |plain| {
        let (other, own) = (plain.untold.join(", "), readings_differ(audit, audit.best(), &plain.convention));
        format!(", if it is meant as {other}; read plainly ({own}) by {} at texels", number(plain.max))
    })
}

/// The end of a headline.
pub(in crate::audit) fn said_limit(limit: Option<f64>) -> String {
    limit.map_or_else(String::new, |limit| format!("; the limit is {}", number(limit)))
}

/// What it is, how far off it is where it is used, and the limit.
fn headline(audit: &Audit, limit: Option<f64>) -> String {
    let held = audit.channels.iter().filter_map(|c| Some(c.column?.name())).collect::<Vec<_>>();
    let what = format!("{} {}: ", audit.quantity, listed(&held));
    let line =
        |found: String, more: &[String], limit: &str| first_line([&what, &audit.what, &found], more, limit);
    let is_limited = limit.is_some();
    let limit = said_limit(limit);
    let worst = audit.channels.iter().filter_map(|c| Some((c.column?.name(), c.errors.as_ref()?)));
    let Some((of, worst)) = worst.reduce(|a, b| if b.1.max > a.1.max { b } else { a }) else {
        return first_line([&what, &audit.what, " is not judged"], &[], &limit);
    };
    let of = if held.len() > 1 { format!(" of {of}") } else { String::new() };
    let (max, at) = (number(worst.max) + &of, place(&worst.at));
    if audit.fit == Fit::None && audit.two_lobes.is_none() {
        let found = match (audit.source, &audit.published) {
            (Source::Table, _) => "fits no convention".into(),
            (Source::Function, None) => "is no approximation of it".into(),
            (Source::Function, Some(known)) => format!("is `{}`, no approximation of it", known.name),
        };
        return line(format!(" {found}; the nearest leaves {max} at {at}"), &[], &limit);
    }
    let other = of_another(audit);
    if let (Some(error), Some(furnace)) = (audit.furnace_error(), &audit.furnace) {
        let (error, at) = (number(error), place(&furnace.at));
        let found = format!(" leaves |E N - 1| of at most {error} at {at}");
        return line(found, &[other, format!(" ({} points sampled)", worst.judged)], &limit);
    }
    if audit.source == Source::Function {
        let found = format!(" is off by at most {max} at {at}");
        return line(found, &[other, format!(" ({} points sampled)", worst.judged)], &limit);
    }
    match largest_lookup(audit) {
        Some((of, lookup)) if lookup.max > worst.max => {
            let of = if held.len() > 1 { format!(" of {of}") } else { String::new() };
            // A limit is on the texels: the figure that is judged stands first.
            let worst_at = at;
            let at = match lookup.max > 1.01 * lookup.inner {
                true => format!("beyond the outermost texels, at {}", place(&lookup.at)),
                false => place(&lookup.at),
            };
            let lookup = number(lookup.max);
            let (texels, lookups) = (format!("{max} at texels"), format!("{lookup}{of} in lookups ({at})"));
            match is_limited {
                true => {
                    let found = format!(" is off by at most {texels} ({worst_at})");
                    line(found, &[other, format!(", {lookups}")], &limit)
                }
                false => {
                    line(format!(" is off by at most {lookups}"), &[other, format!(", {texels}")], &limit)
                }
            }
        }
        _ => line(format!(" is off by at most {max} at {at}"), &[other], &limit),
    }
}

/// The worst lookup and of what it is: of A alone no pixel is made where a shader blends f0 A + B.
fn largest_lookup(audit: &Audit) -> Option<(&'static str, &LookupErrors)> {
    let channels = audit.channels.iter().filter_map(|c| Some((c.column?.name(), c.lookup.as_ref()?)));
    let worst = channels.reduce(|a, b| if b.1.max > a.1.max { b } else { a });
    audit.blend.as_ref().map(|blend| ("f0 A + B", blend)).or(worst)
}

/// What it is best read as.
fn opening(audit: &Audit) -> String {
    let given = if audit.fixed { " of those that the options leave open" } else { "" };
    let reading = reading(audit);
    if let Some(parts) = &audit.two_lobes {
        return format!(
            "no convention{given} fits as a whole: {} Both parts are {reading}.",
            halves(audit, parts)
        );
    }
    if audit.source == Source::Function {
        return of_function(audit, &reading);
    }
    match audit.fit {
        Fit::Whole => format!("{reading}."),
        Fit::Part => {
            format!("no convention{given} fits as a whole; the nearest, which most of it fits, is {reading}.")
        }
        Fit::None => {
            format!("no convention{given} fits; the nearest, which it does not follow, is {reading}.")
        }
    }
}

/// The two parts of a table.
fn halves(audit: &Audit, parts: &TwoLobes) -> String {
    let [larger, smaller, all] = parts.texels;
    let place = match defect::extent(&audit.axes, &parts.range, &parts.size) {
        ranges if ranges.is_empty() => String::new(),
        ranges => format!(" (all at {ranges})"),
    };
    let same = match all - larger - smaller {
        0 => String::new(),
        n => format!("; the other {n} are the same in both"),
    };
    format!(
        "it was made in two parts. Of its {all} texels {larger} are of {}, and {smaller}{place} are of {}{same}.",
        audit.best().lobe.words(),
        parts.lobe.words()
    )
}

/// What a function is best read as.
fn of_function(audit: &Audit, reading: &str) -> String {
    let given = if audit.fixed { " that the options leave open" } else { "" };
    let quantity = audit.quantity;
    match audit.fit {
        Fit::Whole => format!("{reading}."),
        Fit::Part => format!("{reading}, but not everywhere."),
        Fit::None => format!(
            "no approximation of {quantity} under any reading of its arguments{given}; the nearest, which it does not follow, is {reading}."
        ),
    }
}

/// How sure the reading is.
fn doubt(audit: &Audit) -> String {
    if audit.fit == Fit::None {
        return String::new();
    }
    if audit.two_lobes.is_some() {
        return format!(
            "of one lobe throughout, the best convention fits {} times worse.",
            number(audit.margin)
        );
    }
    let next = if audit.source == Source::Table { "convention" } else { "reading" };
    let first = &audit.tried[0];
    let apart = |t: &&crate::audit::Tried| (t.rank / first.rank - 1.0).abs() >= SAME;
    let other = |convention: &Convention| readings_differ(audit, &first.convention, convention);
    let same = audit.tried[1..].iter().find(|t| !apart(t));
    let mut out = same.map_or(String::new(), |t| format!("with {} it is the same; ", other(&t.convention)));
    if let Some(second) = audit.tried[1..].iter().find(apart) {
        let (times, other) = (number(audit.margin), other(&second.convention));
        out += &match audit.margin {
            m if m >= CLEAR => {
                format!("in no doubt: the next {next} ({other}) fits {times} times worse.")
            }
            m if m >= LIKELY => {
                format!("likely: the next {next} ({other}) fits {times} times worse.")
            }
            m if m < 1.0 / LIKELY => format!(
                "the plain {next} is taken, since to change it would not lessen the error of lookups for certain; at its texels another ({other}) fits {} \
                 times better.",
                number(1.0 / m)
            ),
            _ => format!("open: another {next} ({other}) fits nearly as well."),
        };
    }
    out.trim_end().into()
}

/// Errors of a channel at its texels, or at points; of the first with how many are judged.
fn at_places(audit: &Audit, channel: &ChannelAudit, first: bool) -> Option<String> {
    let e = channel.errors.as_ref()?;
    let column = channel.column?.name();
    let part = if e.judged < e.all && first {
        let left = e.all - e.judged - e.unsampled;
        let points = if audit.source == Source::Table { "texels" } else { "points" };
        let told = [
            (left, beyond(audit)),
            (e.unsampled, format!("were not looked at, as the table is large: {}", judged_at(audit))),
        ];
        let told: Vec<String> =
            told.iter().filter(|(n, _)| *n > 0).map(|(n, why)| format!("{n} {why}")).collect();
        format!(" ({} of {} {points} judged; {})", e.judged, e.all, told.join(", "))
    } else {
        String::new()
    };
    let scope = match (audit.source, &audit.two_lobes) {
        (Source::Table, None) => "At its texels".to_string(),
        (Source::Table, Some(_)) => {
            format!("Held against {} throughout, at its texels", audit.best().lobe.words())
        }
        (Source::Function, _) => format!("Over {} evenly spaced points", e.judged),
    };
    if e.max <= 2.0 * audit.truth_error {
        return Some(format!(
            "{scope} {column} is exact to the accuracy of the truth, {}{part}.",
            number(audit.truth_error)
        ));
    }
    // Half the last place of a single.
    if e.max <= 6e-8 * e.value.abs().max(1.0) {
        return Some(format!("{scope} {column} is exact to single precision{part}."));
    }
    let texel = match audit.source {
        Source::Table => format!("texel {:?} ({})", e.texel, place(&e.at)),
        Source::Function => place(&e.at),
    };
    let scope = if first { scope + " " } else { String::new() };
    Some(format!(
        "{scope}{column} is off by at most {} (RMS {}){part}, worst at {texel}: {} for {}.",
        number(e.max),
        number(e.rms),
        words::long(e.value),
        words::long(e.truth),
    ))
}

/// Where the texels lie that are not judged.
fn beyond(audit: &Audit) -> String {
    let causes: Vec<String> = audit.beyond.iter().map(Beyond::to_string).collect();
    format!("lie {}", causes.join(", or "))
}

/// Which texels of a large table are judged.
fn judged_at(audit: &Audit) -> String {
    let along =
        |((name, at), n): ((&String, &Vec<usize>), &usize)| format!("{} of {n} along {name}", at.len());
    let all: Vec<String> = audit.axes.iter().zip(&audit.places).zip(&audit.size).map(along).collect();
    format!("judged are {}", all.join(", "))
}

/// What the plain reading makes of it.
fn untold(audit: &Audit) -> Option<String> {
    let plain = audit.plain.as_ref().filter(|_| audit.fit != Fit::None && audit.two_lobes.is_none())?;
    let other = readings_differ(audit, audit.best(), &plain.convention);
    let scope = match (audit.source, plain.texels) {
        (Source::Function, _) => String::new(),
        (Source::Table, [judged, all]) if judged < all => format!(" at {judged} of its {all} texels"),
        (Source::Table, _) => " at its texels".into(),
    };
    Some(format!(
        "Without options {} is not assumed unless the file says so: read plainly ({other}), it is off by at most {}{scope}.",
        plain.untold.join(", or "),
        number(plain.max),
    ))
}

/// How far it is from the lobe that the quantity's name stands for.
fn departure(audit: &Audit) -> Option<String> {
    // What the plain reading says already is not said again.
    let said = |max: f64| audit.plain.as_ref().is_some_and(|plain| plain.max == max);
    let (lobe, max) = audit.departure.as_ref().filter(|(_, max)| audit.fit != Fit::None && !said(*max))?;
    let (quantity, words, max) = (audit.quantity, lobe.words(), number(*max));
    Some(format!(
        "Held against {words}, which {quantity} is where nothing else is said, it is off by at most {max}."
    ))
}

/// Channels that hold nothing that is asked for.
fn idle(audit: &Audit) -> Option<String> {
    let idle = audit.channels.iter().filter(|c| c.column.is_none());
    let told = idle.map(|c| match (c.constant, &c.other) {
        (_, Some(Other::Quantity(other))) => {
            format!("Channel {} is of another quantity: {}.", c.name, headline(other, None))
        }
        (_, Some(Other::Unknown)) => {
            format!("Channel {} is left out: it follows nothing that is known.", c.name)
        }
        (_, Some(Other::Same(first))) => format!("Channel {} is the same as {first}.", c.name),
        (Some(value), _) => format!("Channel {} is constant ({}) and was not judged.", c.name, number(value)),
        (None, None) => format!("Channel {} is not asked for.", c.name),
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| told.join(" "))
}

/// Departures from white below this are not worth a sentence: in per cent, and in three digits,
/// they would be next to nothing.
const UNSEEN: f64 = 1e-5;

fn furnace(audit: &Audit) -> Option<String> {
    let f = audit.furnace.as_ref().filter(|_| audit.two_lobes.is_none())?;
    if f.dark > 0 {
        return Some(format!(
            "none can be compensated with it: its E is 0 or less at {} {}, the first at {}.",
            f.dark,
            if audit.source == Source::Table { "texels" } else { "points" },
            place(&f.at)
        ));
    }
    let seen = f.range[0].abs().max(f.range[1].abs());
    if f.range[1] - f.range[0] <= (4.0 * audit.truth_error).max(2e-7) || seen < UNSEEN {
        return None;
    }
    Some(format!(
        "compensated with it, it comes out {} to {} off white, worst at {}.",
        percent(f.range[0]),
        percent(f.range[1]),
        place(&f.at)
    ))
}

/// What a shader gets between texels: of every channel, and of f0 A + B.
fn lookups(audit: &Audit) -> Option<String> {
    if audit.fit == Fit::None || audit.two_lobes.is_some() {
        return None;
    }
    let centred = audit.best().axes.iter().all(|a| a.registration == Registration::Centre);
    let channels = || audit.channels.iter().filter_map(|c| Some((c.column?.name(), c)));
    let (name, worst) = largest_lookup(audit)?;
    let others = channels().filter(|(own, _)| *own != name);
    let others: Vec<String> =
        others.filter_map(|(own, c)| Some(format!("{own} by {}", number(c.lookup.as_ref()?.max)))).collect();
    let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
    let f0 = if audit.blend.is_some() { " at the worst f0" } else { "" };
    let where_they_are = if centred { "" } else { " at the coordinates that its texels have" };
    let mut text = format!(
        "Looked up with linear interpolation{where_they_are}, {name}{f0} is off by at most {} (RMS {}), worst at {}, and by {} between the \
         outermost texels{others}.",
        number(worst.max),
        number(worst.rms),
        place(&worst.at),
        number(worst.inner)
    );
    let plain = channels().filter_map(|(name, c)| Some((name, c.plain_lookup.as_ref()?)));
    if let Some((name, plain)) =
        plain.reduce(|a, b| if b.1.max > a.1.max { b } else { a }).filter(|_| !centred)
    {
        text += &format!(
            " A texture unit that takes them for centres, without a remap, is off by up to {} of {name} (RMS {}, mean {}).",
            number(plain.max),
            number(plain.rms),
            words::signed(plain.mean),
        );
    }
    Some(text)
}

/// Where a limit was judged, which a largest error alone does not tell: of a table or function
/// whose convention was found, at texels or points, and what lookups between them make of it.
fn judged(audit: &Audit, limit: f64) -> String {
    let limit_text = number(limit);
    if audit.furnace_error().is_some() {
        return format!("The limit {limit_text} is that of |E N - 1| at those points of the arguments.");
    }
    if audit.source == Source::Function {
        return format!("The limit {limit_text} is judged at those points of the arguments.");
    }
    match largest_lookup(audit) {
        Some((of, lookup)) if lookup.max > limit && audit.passes(Some(limit)) => format!(
            "The limit {limit_text} is judged at the texels, which keep it; lookups between them and beyond the outermost do not: they are off by up \
             to {} of {of} (at {}).",
            number(lookup.max),
            place(&lookup.at)
        ),
        _ => format!("The limit {limit_text} is judged at the texels, not at lookups between them."),
    }
}
