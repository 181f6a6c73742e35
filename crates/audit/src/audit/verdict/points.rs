//! The points of a verdict on a table or function of unknown make.

use super::figure::largest_lookup;
use super::headline::{briefly, headline, headline_of};
use super::reason::reason;
use super::words::{listed, number, percent, place, reading, readings_differ};
use super::{Grade, Verdict, advice, defect, words};
use crate::audit::axis::Registration;
use crate::audit::best::CLOSE;
use crate::audit::convention::Convention;
use crate::audit::defects::Defect;
use crate::audit::errors::spread;
use crate::audit::table::Source;
use crate::audit::truth::Beyond;
use crate::audit::{Audit, CLEAR, ChannelAudit, Column, FITS, Fit, Other, Tried, TwoLobes};

/// Ranks nearer than this are of conventions that are the same at the texels.
pub(super) const SAME: f64 = 1e-6;

/// How much worse the next convention must rank for the first to be likely.
pub(super) const LIKELY: f64 = 1.2;

/// The verdict; `limit` is the largest error that the user allows.
pub(in crate::audit) fn of(audit: &Audit, limit: Option<f64>) -> Verdict {
    let remedy = advice::advice(audit, limit);
    let grade = grade(audit, limit, &remedy);
    let mut errors = Vec::new();
    if grade != Grade::Pass {
        errors.extend(reason(audit, limit).map(|why| format!("{} since {why}.", grade.word())));
    }
    for (k, channel) in audit.channels.iter().filter(|c| c.column.is_some()).enumerate() {
        errors.extend(at_places(audit, channel, k == 0));
        let known = audit.fit != Fit::None && audit.two_lobes.is_none();
        let told = channel.defects.iter().filter(|d| known || matches!(d, Defect::Dead { .. }));
        // Of a table that was enlarged all channels were.
        let told = told.filter(|d| k == 0 || !matches!(d, Defect::Enlarged(_)));
        errors.extend(told.map(|d| defect::sentence(d, &audit.axes)));
    }
    errors.dedup();
    // Where the verdict is on it the first line says so, and the remedy.
    errors.extend(untold(audit).filter(|_| audit.misread(limit).is_none()));
    errors.extend(departure(audit));
    errors.extend(lookups(audit));
    errors.extend(limit.map(|limit| judged(audit, limit)));
    errors.extend(audit.remarks.iter().cloned());
    let named = audit.published.iter().map(|known| {
        let made_for = known.made_for.map_or_else(String::new, |form| format!(", made for {}", form.words));
        format!(
            "It has the values of a published formula, `{}`: {}{made_for}.",
            known.name, known.publication
        )
    });
    let convention: Vec<String> =
        [opening(audit)].into_iter().chain(audit.shipped.clone()).chain(named).chain(idle(audit)).collect();
    Verdict {
        grade,
        headline: headline(audit, limit),
        convention: convention.join(" "),
        errors,
        furnace: furnace(audit),
        // What passes calls for nothing.
        remedy: if grade == Grade::Pass { Vec::new() } else { remedy },
        certainty: doubt(audit),
    }
}

fn grade(audit: &Audit, limit: Option<f64>, remedy: &[String]) -> Grade {
    let unfit = audit.fit == Fit::None && audit.two_lobes.is_none() && audit.published.is_none();
    match limit {
        // It is known, and is not what the options say.
        _ if audit.excluded.is_some() => Grade::Fail,
        _ if unfit => Grade::Unknown,
        None if is_ambiguous(audit) || is_loose(audit) || has_unknown(audit) => Grade::Unknown,
        Some(limit) if audit.passes(Some(limit)) => Grade::Pass,
        Some(limit) if audit.keeps(limit) => Grade::Unknown,
        None if audit.fit == Fit::Whole && audit.misread(None).is_none() && remedy.is_empty() => Grade::Pass,
        _ => Grade::Fail,
    }
}

/// Whether a channel follows nothing that is known, or is constant where the other half of a split sum is
/// called for, and the user did not say which are meant.
pub(super) fn has_unknown(audit: &Audit) -> bool {
    let is_half = audit.channels.iter().filter_map(|c| c.column).any(Column::is_part);
    let is_open = |c: &ChannelAudit| {
        c.other == Some(Other::Unknown) || is_half && c.constant.is_some() && !audit.pads(c)
    };
    !audit.excused && audit.channels.iter().any(is_open)
}

/// What a function may be off by at most without a limit, of what its truth spans: published approximations
/// are by a fifth in the corner of grazing and smooth, formulas of something else by a third.
const LOOSE: f64 = 0.3;

/// What may be [`ChannelAudit::left`] of a table without a limit: published tables that are what they say
/// leave 0.009, those of another exponent in Fresnel's term, or with a factor of 0.98, 0.012 and more.
const FOLLOWS: f64 = 0.01;

/// Whether a function that is no published formula is farther off than approximations of its quantity are; or
/// a table than what follows its convention is.
pub(in crate::audit) fn is_loose(audit: &Audit) -> bool {
    let far = |c: &ChannelAudit| {
        c.errors.as_ref().is_some_and(|errors| errors.max > LOOSE * spread(c.truth.iter().copied()))
    };
    if audit.fit != Fit::Whole || audit.published.is_some() {
        return false;
    }
    let misread = audit.misread(None);
    match audit.source {
        Source::Function if misread.is_some() || audit.furnace_error().is_some() => false,
        Source::Function => audit.channels.iter().any(far),
        // What is to be mended has a name, and so has a reading that is clearly better than the plain one.
        Source::Table if misread.is_some_and(|plain| plain.max > CLEAR * audit.worst()) => false,
        Source::Table => audit.channels.iter().any(|c| c.left > FOLLOWS) && !has_remedy(audit),
    }
}

/// Whether a defect says what is to be mended.
fn has_remedy(audit: &Audit) -> bool {
    let mended = |d: &Defect| advice::mending(d, &audit.axes, audit.source).is_some();
    audit.channels.iter().flat_map(|c| &c.defects).any(mended)
}

/// Whether a function follows another reading nearly as well, and its own not as closely as a table has to;
/// or a table another lobe or other columns, where neither noise nor rounding explains its errors.
pub(super) fn is_ambiguous(audit: &Audit) -> bool {
    let is_table = audit.source == Source::Table;
    let close = if is_table { CLOSE } else { FITS };
    let (best, nearly) = (audit.best(), if is_table { 1.0 / LIKELY } else { 1.0 / CLEAR });
    let is_open = |t: &Tried| {
        let (times, read) = (t.rank / audit.tried[0].rank, &t.convention);
        // Where its texels lie is said and changes no verdict.
        let of = |read: &Convention| (read.lobe, read.columns.clone());
        let differs = !is_table || of(read) != of(best) && read.axes == best.axes;
        differs && (times - 1.0).abs() >= SAME && (nearly..LIKELY).contains(&times)
    };
    let is_read = audit.fit == Fit::Whole && audit.misread(None).is_none();
    is_read && audit.tried[1..].iter().any(is_open) && audit.channels.iter().any(|c| c.left > close)
}

/// The next convention that is not the same at the texels.
fn next(audit: &Audit) -> Option<&Tried> {
    audit.tried[1..].iter().find(|t| (t.rank / audit.tried[0].rank - 1.0).abs() >= SAME)
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
        Fit::Whole => format!("{reading}.{}", at_ends(audit)),
        Fit::Part => {
            format!("no convention{given} fits as a whole; the nearest, which most of it fits, is {reading}.")
        }
        Fit::None => {
            format!("no convention{given} fits; the nearest, which it does not follow, is {reading}.")
        }
    }
}

/// How a table of end points is sampled.
fn at_ends(audit: &Audit) -> String {
    let axes = audit.axes.iter().zip(&audit.best().axes);
    let ends: Vec<&str> = axes
        .filter(|(_, a)| a.registration == Registration::Endpoint)
        .map(|(name, _)| name.as_str())
        .collect();
    match ends.is_empty() {
        true => String::new(),
        false => format!(" Along {} sample at (u (n - 1) + 1/2)/n for a coordinate u.", listed(&ends)),
    }
}

/// The two parts of a table.
fn halves(audit: &Audit, parts: &TwoLobes) -> String {
    let [larger, smaller, all] = parts.texels;
    let place = match defect::extent(&audit.axes, &parts.extent) {
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
        Fit::None if audit.misfit().is_some() => {
            format!("no approximation of {quantity}: it is held against {reading}.")
        }
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
    let what = if audit.source == Source::Table { "convention" } else { "reading" };
    let first = &audit.tried[0];
    let apart = |t: &&Tried| (t.rank / first.rank - 1.0).abs() >= SAME;
    let other = |convention: &Convention| readings_differ(audit, &first.convention, convention);
    let same = audit.tried[1..].iter().find(|t| !apart(t));
    let mut out = same.map_or(String::new(), |t| format!("with {} it is the same; ", other(&t.convention)));
    if let Some(second) = next(audit) {
        let (times, other) = (number(audit.margin), other(&second.convention));
        out += &match audit.margin {
            m if m >= CLEAR => {
                format!("in no doubt: the next {what} ({other}) fits {times} times worse.")
            }
            m if m >= LIKELY => {
                format!("likely: the next {what} ({other}) fits {times} times worse.")
            }
            m if m < 1.0 / LIKELY && audit.source == Source::Table => format!(
                "the plain {what} is taken, since to change it would not lessen the error of lookups for certain; at its texels another ({other}) fits {} \
                 times better.",
                number(1.0 / m)
            ),
            _ => format!("open: another {what} ({other}) fits nearly as well."),
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
    let name = |c: &ChannelAudit| audit.channel(&c.name);
    let idle = audit.channels.iter().filter(|c| c.column.is_none());
    let told = idle.map(|c| match (c.constant, &c.other) {
        (_, Some(Other::Quantity(other))) => {
            let found = headline_of("it", other, None);
            format!("Channel {} is of another quantity: {found}.", name(c))
        }
        (_, Some(Other::Unknown)) => {
            format!("Channel {} is left out: it follows nothing that is known.", name(c))
        }
        (_, Some(Other::Same(first))) => {
            format!("Channel {} is the same as {}.", name(c), audit.channel(first))
        }
        (Some(value), _) => {
            format!("Channel {} is constant ({}) and was not judged.", name(c), number(value))
        }
        (None, None) => format!("Channel {} is not asked for.", name(c)),
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
    let another = audit.departure.is_some()
        || audit.plain.as_ref().is_some_and(|plain| plain.convention.lobe != audit.best().lobe);
    let lobe = audit.best().lobe.words();
    let what = if another { format!("a white metal of {}", briefly(&lobe)) } else { "it".into() };
    Some(format!(
        "compensated with it, {what} comes out {} to {} off white, worst at {}.",
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
    let others: Vec<String> = others
        .filter_map(|(own, c)| Some(format!("{own} by {}", number(c.lookup.as_ref()?.inner))))
        .collect();
    let others = if others.is_empty() { String::new() } else { format!("; {}", others.join(", ")) };
    let f0 = if audit.blend.is_some() { " at the worst f0" } else { "" };
    let where_they_are = if centred { "" } else { " at the coordinates that its texels have" };
    let beyond = match worst.is_beyond() {
        true => format!(", and by {} beyond those ({})", number(worst.max), place(&worst.at)),
        false => String::new(),
    };
    let mut text = format!(
        "Looked up with linear interpolation{where_they_are}, {name}{f0} is off by at most {} between the outermost texels ({}){beyond} \
         (RMS {}){others}.",
        number(worst.inner),
        place(&worst.inner_at),
        number(worst.rms),
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
