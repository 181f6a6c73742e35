//! The verdict in one paragraph, for somebody who writes shaders.

mod advice;
mod defect;
mod words;

pub(super) use defect::sentence;
pub(crate) use words::place;
pub(super) use words::{along, long, number};

use super::axis::Registration;
use super::convention::Convention;
use super::table::Source;
use super::{Audit, CLEAR, ChannelAudit, Fit, Other, TwoLobes};
use words::{axes, percent, reading, readings_differ};

/// Ranks nearer than this are of conventions that are the same at the texels.
const SAME: f64 = 1e-6;

/// All of it.
pub(super) fn paragraph(audit: &Audit) -> String {
    let mut out = vec![opening(audit), doubt(audit)];
    for channel in audit.channels.iter().filter(|c| c.column.is_some()) {
        out.extend(errors(audit, channel));
        if audit.fit != Fit::None && audit.two_lobes.is_none() {
            out.extend(channel.defects.iter().map(|d| sentence(d, &audit.axes)));
        }
    }
    out.extend(untold(audit));
    out.extend(departure(audit));
    out.extend(idle(audit));
    out.extend(furnace(audit));
    out.extend(lookups(audit));
    out.extend(advice::advice(audit));
    out.retain(|s| !s.is_empty());
    out.join(" ")
}

/// What it is best read as.
pub(super) fn opening(audit: &Audit) -> String {
    let given = if audit.fixed { " of those that the options leave open" } else { "" };
    let (name, reading) = (&audit.what, reading(audit));
    if let Some(parts) = &audit.two_lobes {
        return format!(
            "{name} fits no convention{given} as a whole: {} Both parts are {reading}.",
            halves(audit, parts)
        );
    }
    if audit.source == Source::Function {
        return of_function(audit, &reading);
    }
    match audit.fit {
        Fit::Whole => format!("{name} is best read as {reading}."),
        Fit::Part => format!(
            "{name} fits no convention{given} as a whole. It is nearest to {reading}, which most of it fits."
        ),
        Fit::None => {
            format!("{name} fits no convention{given}. The nearest, which it does not follow, is {reading}.")
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
    let (name, quantity) = (&audit.what, audit.quantity);
    match audit.fit {
        Fit::Whole => format!("{name} is best read as {reading}."),
        Fit::Part => format!("{name} follows {reading}, but not everywhere."),
        Fit::None => format!(
            "{name} is no approximation of {quantity} under any reading of its arguments{given}. The nearest, which it does not follow, is {reading}."
        ),
    }
}

fn doubt(audit: &Audit) -> String {
    if audit.fit == Fit::None {
        return String::new();
    }
    if audit.two_lobes.is_some() {
        return format!(
            "Of one lobe throughout, the best convention fits {} times worse.",
            number(audit.margin)
        );
    }
    let next = if audit.source == Source::Table { "convention" } else { "reading" };
    let first = &audit.tried[0];
    let apart = |t: &&super::Tried| (t.rank / first.rank - 1.0).abs() >= SAME;
    let other = |convention: &Convention| readings_differ(audit, &first.convention, convention);
    let same = audit.tried[1..].iter().find(|t| !apart(t));
    let mut out = same.map_or(String::new(), |t| format!("With {} it is the same. ", other(&t.convention)));
    if let Some(second) = audit.tried[1..].iter().find(apart) {
        let (times, other) = (number(audit.margin), other(&second.convention));
        out += &match audit.margin {
            m if m >= CLEAR => {
                format!("This is in no doubt: the next {next} ({other}) fits {times} times worse.")
            }
            m if m >= 1.2 => {
                format!("This is likely: the next {next} ({other}) fits {times} times worse.")
            }
            _ => format!("This is open: another {next} ({other}) fits nearly as well."),
        };
    }
    out.trim_end().into()
}

fn errors(audit: &Audit, channel: &ChannelAudit) -> Option<String> {
    let e = channel.errors.as_ref()?;
    let column = channel.column?.name();
    let part = if e.judged < e.all {
        let beyond = e.all - e.judged - e.unsampled;
        let points = if audit.source == Source::Table { "texels" } else { "points" };
        let told = [
            (beyond, "lie where the truth is not had".to_string()),
            (
                e.unsampled,
                format!(
                    "were not looked at, for the table is too large to judge each texel: {}",
                    judged_at(audit)
                ),
            ),
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
    Some(format!(
        "{scope} {column} is off by at most {} (RMS {}){part}, worst at {texel}, where it is {} and {} is true.",
        number(e.max),
        number(e.rms),
        words::long(e.value),
        words::long(e.truth),
    ))
}

/// Which texels of a large table are judged.
fn judged_at(audit: &Audit) -> String {
    let along =
        |((name, at), n): ((&String, &Vec<usize>), &usize)| format!("{} of {n} along {name}", at.len());
    let all: Vec<String> = audit.axes.iter().zip(&audit.places).zip(&audit.size).map(along).collect();
    format!("judged are {}, evenly spaced, both ends among them", all.join(", "))
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
        "No reader assumes {} unless the file says so: read plainly ({other}), it is off by at most {}{scope}.",
        plain.untold.join(", or "),
        number(plain.max),
    ))
}

/// How far it is from the lobe that the quantity's name stands for.
fn departure(audit: &Audit) -> Option<String> {
    let (lobe, max) = audit.departure.as_ref().filter(|_| audit.fit != Fit::None)?;
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
            format!("Channel {} is of another quantity: {}", c.name, other.verdict)
        }
        (_, Some(Other::Unknown)) => {
            format!("Channel {} is left out: it follows nothing that is known.", c.name)
        }
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
            "No white furnace can be compensated with it: its E is 0 or less at {} {}, the first at {}.",
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
        "A white furnace compensated with it comes out {} to {} off white, worst at {}.",
        percent(f.range[0]),
        percent(f.range[1]),
        place(&f.at)
    ))
}

/// What a shader gets between texels.
fn lookups(audit: &Audit) -> Option<String> {
    if audit.fit == Fit::None || audit.two_lobes.is_some() {
        return None;
    }
    let channel = audit.channels.iter().find(|c| c.lookup.is_some())?;
    let (own, plain) = (channel.lookup.as_ref()?, channel.plain_lookup.as_ref()?);
    let column = channel.column?.name();
    let centred = audit.best().axes.iter().all(|a| a.registration == Registration::Centre);
    let mut text = format!(
        "Looked up with linear interpolation{}, {column} is off by at most {} (RMS {}), worst at {}; by {} between the outermost texels.",
        if centred { "" } else { " at the coordinates that its texels have" },
        number(own.max),
        number(own.rms),
        place(&own.at),
        number(own.inner),
    );
    if !centred {
        text += &format!(
            " A texture unit that takes them for centres, without a remap, is off by up to {} (RMS {}, mean {}).",
            number(plain.max),
            number(plain.rms),
            words::signed(plain.mean),
        );
    }
    Some(text)
}

/// Every axis of the best convention in words.
fn axes_of(audit: &Audit) -> String {
    axes(audit, audit.best())
}

/// Where a limit was judged, which a largest error alone does not tell: of a table or function
/// whose convention was found, at texels or points, and what lookups between them make of it.
pub fn limit_judged(audit: &Audit, limit: f64) -> String {
    let limit_text = number(limit);
    if audit.source == Source::Function {
        return format!("The limit {limit_text} is judged at those points of the arguments.");
    }
    let worst = audit.channels.iter().filter_map(|c| c.lookup.as_ref());
    let worst = worst.reduce(|a, b| if b.max > a.max { b } else { a });
    match worst {
        Some(lookup) if lookup.max > limit && audit.passes(Some(limit)) => format!(
            "The limit {limit_text} is judged at the texels, which keep it; lookups between them and beyond the outermost do not: they are off by up \
             to {} (at {}).",
            number(lookup.max),
            place(&lookup.at)
        ),
        _ => format!("The limit {limit_text} is judged at the texels, not at lookups between them."),
    }
}
