//! The verdict in one paragraph, for somebody who writes shaders.

use super::axis::{Input, Siting};
use super::convention::Convention;
use super::{Audit, CLEAR, ChannelAudit, Defect, Fit};
use crate::data::Place;

/// Ranks nearer than this are of conventions that are the same at the texels.
const SAME: f64 = 1e-6;

/// All of it.
pub(super) fn paragraph(audit: &Audit) -> String {
    let mut out = vec![opening(audit), doubt(audit)];
    for channel in audit.channels.iter().filter(|c| c.column.is_some()) {
        out.extend(errors(audit, channel));
        if audit.fit != Fit::None {
            out.extend(channel.defects.iter().map(sentence));
        }
    }
    out.extend(idle(audit));
    out.extend(furnace(audit));
    out.extend(lookups(audit));
    out.extend(advice(audit));
    out.retain(|s| !s.is_empty());
    out.join(" ")
}

/// What it is best read as.
fn opening(audit: &Audit) -> String {
    let given = if audit.pinned { " of those that the options leave open" } else { "" };
    let reading = reading(audit);
    let name = &audit.what;
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

/// `ggx-reflection, R = A, ...: mu along x, ...`.
fn reading(audit: &Audit) -> String {
    let best = audit.best();
    let holds: Vec<String> = audit
        .channels
        .iter()
        .filter_map(|c| Some((c, c.column?)))
        .map(|(c, column)| match audit.channels.len() {
            1 => format!("holding {}", column.words()),
            _ => format!("channel {} = {}", c.name, column.words()),
        })
        .collect();
    let lobe = best.lobe.words();
    let lobe = if lobe.is_empty() { String::new() } else { format!(", of {lobe}") };
    format!("{} {}{lobe}, with {}", audit.quantity, holds.join(", "), axes(best))
}

/// Name of an axis of the table.
pub(super) fn axis_name(k: usize) -> &'static str {
    ["x", "y", "z"][k.min(2)]
}

/// Every axis in words.
pub(super) fn axes(convention: &Convention) -> String {
    let one = |(k, a): (usize, &super::AxisReading)| {
        let floor = if a.floor > 0.0 {
            format!(", {} clamped to {:?}", a.scale.input().name(), a.floor)
        } else {
            String::new()
        };
        format!("{} along {} at {}{floor}", a.words(), axis_name(k), a.siting.words())
    };
    let all: Vec<String> = convention.axes.iter().enumerate().map(one).collect();
    all.join(", and ")
}

fn doubt(audit: &Audit) -> String {
    if audit.fit == Fit::None {
        return String::new();
    }
    let (first, mut out) = (&audit.tried[0], String::new());
    let same = audit.tried[1..].iter().find(|t| (t.rank / first.rank - 1.0).abs() < SAME);
    if let Some(same) = same {
        out = format!("At these texels it is the same with {}. ", difference(audit.best(), &same.convention));
    }
    let Some(second) = audit.tried[1..].iter().find(|t| (t.rank / first.rank - 1.0).abs() >= SAME) else {
        return out.trim_end().into();
    };
    let times = number(audit.margin);
    let other = difference(audit.best(), &second.convention);
    match audit.margin {
        m if m >= CLEAR => {
            format!("This is in no doubt: the next convention ({other}) fits {times} times worse.")
        }
        m if m >= 1.2 => format!("This is likely: the next convention ({other}) fits {times} times worse."),
        _ => format!("This is open: another convention ({other}) fits as well."),
    }
}

/// What a convention has that the best one has not.
fn difference(best: &Convention, other: &Convention) -> String {
    let mut parts = Vec::new();
    if best.lobe != other.lobe {
        parts.push(other.lobe.words());
    }
    for (k, (a, b)) in best.axes.iter().zip(&other.axes).enumerate() {
        if (a.scale, a.reversed) != (b.scale, b.reversed) {
            parts.push(format!("{} along {}", b.words(), axis_name(k)));
        }
        if a.siting != b.siting {
            parts.push(format!("{} along {}", b.siting.words(), axis_name(k)));
        }
    }
    for (a, b) in best.columns.iter().zip(&other.columns) {
        if let (true, Some(b)) = (a != b, b) {
            parts.push(b.name().to_string());
        }
    }
    if parts.is_empty() { "other clamps".into() } else { parts.join(", ") }
}

fn errors(audit: &Audit, channel: &ChannelAudit) -> Option<String> {
    let e = channel.errors.as_ref()?;
    let column = channel.column?.name();
    let part = if e.texels[0] < e.texels[1] {
        format!(
            " ({} of {} texels judged, the rest lies where the truth is not to be had)",
            e.texels[0], e.texels[1]
        )
    } else {
        String::new()
    };
    if e.max <= 2.0 * audit.truth_error {
        return Some(format!(
            "At its texels {column} is exact to the accuracy of the truth, {}{part}.",
            number(audit.truth_error)
        ));
    }
    Some(format!(
        "At its texels {column} is off by at most {} (RMS {}){part}, worst at texel {:?} ({}), which holds {} where {} is true.",
        number(e.max),
        number(e.rms),
        e.texel,
        place(&e.at),
        number_long(e.value),
        number_long(e.truth),
    ))
}

/// A defect in a sentence.
pub(super) fn sentence(defect: &Defect) -> String {
    match defect {
        Defect::Part { texels: [off, all], over, mean, range, size } => {
            let along = |(k, (r, n)): (usize, (&[usize; 2], &usize))| {
                let whole = r[0] == 0 && r[1] + 1 == *n;
                (!whole).then(|| match r[0] == r[1] {
                    true => format!("{} = {}", axis_name(k), r[0]),
                    false => format!("{} = {} to {}", axis_name(k), r[0], r[1]),
                })
            };
            let ranges: Vec<String> = range.iter().zip(size).enumerate().filter_map(along).collect();
            let place =
                if ranges.is_empty() { String::new() } else { format!(", all at {}", ranges.join(", ")) };
            let way = if *mean > 0.0 { "too high" } else { "too low" };
            format!(
                "{off} of {all} texels are off by more than {}, on average {} {way}{place}; the others are not.",
                number(*over),
                number(mean.abs())
            )
        }
        Defect::Bias { mean } => {
            let way = if *mean > 0.0 { "high" } else { "low" };
            format!("The error is mostly a bias: values are {} too {way} on average.", number(mean.abs()))
        }
        Defect::Clamped { value, texels, truth } => format!(
            "{texels} texels stand at {} where the truth goes on to {}: clamped.",
            number(*value),
            number(*truth)
        ),
        Defect::Noise { rms, share } => format!(
            "{} % of the error jumps from texel to texel, as sampling noise does (RMS {}).",
            (100.0 * share.min(1.0)).round(),
            number(*rms)
        ),
        Defect::Steps { step, rms } => {
            format!("That is what rounding to {} leaves (RMS {}).", step.text(), number(*rms))
        }
        Defect::MissingLoss { stored, alpha, worst, texel } => format!(
            "For smooth surfaces (alpha up to {}) it holds only {} % of the true loss, {} where {} is true at texel {texel:?}: a sampling that \
             misses the tail of the lobe does this.",
            number(*alpha),
            (100.0 * stored.max(0.0)).round(),
            number(worst[0]),
            number(worst[1])
        ),
    }
}

/// Channels that hold nothing.
fn idle(audit: &Audit) -> Option<String> {
    let names: Vec<&str> =
        audit.channels.iter().filter(|c| c.column.is_none()).map(|c| c.name.as_str()).collect();
    let noun = if names.len() == 1 { "Channel" } else { "Channels" };
    (!names.is_empty()).then(|| format!("{noun} {} not judged.", names.join(", ")))
}

fn furnace(audit: &Audit) -> Option<String> {
    let f = audit.furnace.as_ref().filter(|f| f.range[1] - f.range[0] > 4.0 * audit.truth_error)?;
    let percent = |x: f64| {
        let sign = if x < 0.0 { "\u{2212}" } else { "+" };
        if x.abs() < 1e-6 { "0 %".into() } else { format!("{sign}{} %", number(100.0 * x.abs())) }
    };
    Some(format!(
        "A white furnace compensated with it comes out {} to {} off white at the texels (worst at {}).",
        percent(f.range[0]),
        percent(f.range[1]),
        place(&f.at)
    ))
}

/// What a shader gets between texels.
fn lookups(audit: &Audit) -> Option<String> {
    if audit.fit == Fit::None {
        return None;
    }
    let channel = audit.channels.iter().find(|c| c.lookup.is_some())?;
    let (own, plain) = (channel.lookup.as_ref()?, channel.plain_lookup.as_ref()?);
    let column = channel.column?.name();
    let mut text = format!(
        "Looked up with linear interpolation{}, {column} is off by at most {} (RMS {}), worst at {}; {} between the outermost texels.",
        if centred(audit.best()) { "" } else { " at the coordinates that its texels have" },
        number(own.max),
        number(own.rms),
        place(&own.at),
        number(own.inner),
    );
    if !centred(audit.best()) {
        text += &format!(
            " A texture unit that takes them for centres, without a remap, gets up to {} (RMS {}, mean {}{}).",
            number(plain.max),
            number(plain.rms),
            if plain.mean < 0.0 { "\u{2212}" } else { "+" },
            number(plain.mean.abs()),
        );
    }
    Some(text)
}

fn centred(convention: &Convention) -> bool {
    convention.axes.iter().all(|a| a.siting == Siting::Centre)
}

/// What to change.
fn advice(audit: &Audit) -> Option<String> {
    let best = audit.best();
    if audit.fit == Fit::None {
        return Some("Do not ship it as this quantity: make it again, or name what it holds.".into());
    }
    let mut steps = Vec::new();
    for (k, axis) in best.axes.iter().enumerate() {
        steps.extend(registration(axis_name(k), axis.siting));
        if axis.reversed && axis.scale.input() == Input::Alpha {
            steps.push(format!("pass 1 - {} along {}", axis.scale.name(), axis_name(k)));
        }
    }
    for defect in audit.channels.iter().flat_map(|c| &c.defects) {
        steps.extend(match defect {
            Defect::Part { .. } if audit.fit == Fit::Part => Some(
                "make the table again, since a part made by other code or at another time looks like this"
                    .into(),
            ),
            Defect::Clamped { .. } => Some("store it in a format that holds values beyond the clamp".into()),
            Defect::MissingLoss { .. } => {
                Some("make the loss again by quadrature or by sampling visible normals".into())
            }
            _ => None,
        });
    }
    for channel in &audit.channels {
        if channel.column == Some(super::Column::Normal) || channel.column == Some(super::Column::NormalLoss)
        {
            steps.push("average over the cosine, E_avg = 2 int E mu dmu, if an average is meant".into());
        }
    }
    steps.dedup();
    (!steps.is_empty()).then(|| format!("To mend it: {}.", steps.join("; ")))
}

/// What a reader or maker should do about an axis.
fn registration(axis: &str, siting: Siting) -> Option<String> {
    Some(match siting {
        Siting::Centre => return None,
        Siting::Endpoint => format!("sample {axis} at (u (n - 1) + 1/2)/n"),
        Siting::Left => format!("compute the texels along {axis} at (i + 1/2)/n, or sample at u + 1/(2n)"),
        Siting::Right => format!("compute the texels along {axis} at (i + 1/2)/n, or sample at u - 1/(2n)"),
        Siting::OneHigh => {
            format!("compute the texels along {axis} at (i + 1/2)/n: they are one texel too far")
        }
        Siting::OneLow => {
            format!("compute the texels along {axis} at (i + 1/2)/n: they are one texel too near")
        }
    })
}

/// `alpha 0.25, mu 0.1`.
pub(super) fn place(at: &Place) -> String {
    at.iter().map(|(k, v)| format!("{k} {}", number(*v))).collect::<Vec<_>>().join(", ")
}

/// Three significant digits.
pub(super) fn number(x: f64) -> String {
    digits(x, 2)
}

fn number_long(x: f64) -> String {
    digits(x, 4)
}

fn digits(x: f64, after: usize) -> String {
    if !x.is_finite() {
        return "any number of".into();
    }
    let rounded: f64 = format!("{x:.after$e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}
