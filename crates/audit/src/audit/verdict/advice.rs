//! What to change.

use std::collections::BTreeSet;

use super::defect::{LINES, extent};
use super::drop_in::drop_in;
use super::headline::briefly;
use super::points::{LIKELY, SAME, is_loose};
use super::words::{excluded, listed, long, names, readings_differ};
use crate::audit::axis::{AxisReading, Input, Registration};
use crate::audit::convention::NAMES;
use crate::audit::enlarged::Enlarged;
use crate::audit::plain::Plain;
use crate::audit::table::Source;
use crate::audit::{Audit, Column, Defect, Fit, Tried, TwoLobes};
use crate::foreign::words;

/// The steps that mend it; none where there is nothing to mend.
pub(super) fn advice(audit: &Audit, limit: Option<f64>) -> Vec<String> {
    if audit.fit == Fit::None {
        let told = match audit.source {
            Source::Table => "make it again, or audit it as what it holds",
            Source::Function => "fit its constants to this quantity, or audit it as what it computes",
        };
        let dead =
            audit.channels.iter().flat_map(|c| &c.defects).filter(|d| matches!(d, Defect::Dead { .. }));
        let mut steps = vec![match excluded(audit) {
            Some(_) if audit.excluded == Some(NAMES) => {
                let names = audit.axes.iter().map(String::as_str).collect::<Vec<_>>();
                format!("{} stand in the wrong order, in it or where it calls another", listed(&names))
            }
            Some(said) => format!("read it as it is, or make it again as {said}"),
            None if let Some(made_for) = audit.made_for() => format!(
                "use a fit of {}, or if {} is meant, say so (`--smith {}`)",
                audit.best().lobe.words(),
                briefly(made_for.words),
                made_for.word
            ),
            None => format!("do not ship it as this quantity: {told}"),
        }];
        steps.extend(dead.filter_map(|d| mending(d, &audit.axes, audit.source)));
        let is_average = audit.best().axes.iter().all(|axis| axis.scale.input() != Input::Mu);
        if audit.source == Source::Table && is_average && audit.size.len() == 2 {
            steps.push("if it is a slice of one index of refraction, say of which (`--at ior=1.5`)".into());
        }
        steps.dedup();
        // What follows another convention is as good as another.
        steps.extend(drop_in(audit).filter(|_| audit.source == Source::Table && audit.excluded.is_none()));
        return steps;
    }
    if limit.is_none() && audit.source == Source::Table && is_loose(audit) {
        return Vec::new();
    }
    let mut steps: Vec<String> = audit.two_lobes.iter().map(|parts| one_lobe(audit, parts)).collect();
    steps.extend(audit.plain.iter().flat_map(|plain| readings(audit, plain)));
    // What is too much by a factor is mended with it.
    let is_scaled =
        audit.channels.iter().flat_map(|c| &c.defects).any(|d| matches!(d, Defect::Factor { .. }));
    let is_gain = |d: &Defect| is_scaled && matches!(d, Defect::Gain { .. });
    let defects = audit.channels.iter().flat_map(|c| &c.defects).filter(|d| !is_gain(d));
    steps.extend(defects.filter_map(|d| mending(d, &audit.axes, audit.source)));
    steps.extend(audit.plain.as_ref().and_then(|plain| unassumed(audit, plain, limit)));
    let mut said = BTreeSet::new();
    steps.retain(|step| said.insert(step.clone()));
    let is_poor = |d: &Defect| matches!(d, Defect::Gain { .. } | Defect::MissingLoss { .. });
    let is_poor = !is_scaled && audit.channels.iter().flat_map(|c| &c.defects).any(is_poor);
    steps.extend(drop_in(audit).filter(|_| is_poor && audit.source == Source::Table));
    steps
}

/// What to do about an encoding, axes and an average of which nobody said that they are meant.
fn readings(audit: &Audit, plain: &Plain) -> Vec<String> {
    let mut steps: Vec<String> = plain.encoding.iter().map(|encoding| encoding.remedy.to_string()).collect();
    let best = audit.best();
    if audit.source == Source::Table && !is_open(audit) {
        steps.extend(registrations(audit));
    }
    let axes = audit.axes.iter().zip(LINES).zip(best.axes.iter().zip(&plain.convention.axes));
    for ((name, line), (axis, plain)) in axes {
        if axis.reversed && !plain.reversed && axis.scale.input() == Input::Alpha {
            let pass = format!("pass 1 - {} as {name}", axis.scale.name());
            steps.push(match audit.source {
                Source::Table => format!("{pass}, or store the {line}s in the other order"),
                Source::Function => pass,
            });
        }
    }
    if best.columns != plain.convention.columns
        && best.columns.iter().flatten().any(|c| matches!(c, Column::Normal | Column::NormalLoss))
    {
        steps.push("average over the cosine, E_avg = 2 int E mu dmu, if an average is meant".into());
    }
    steps
}

/// What to do about a reading that no reader assumes, or for which a limit is not kept; a registration and an
/// encoding have steps of their own.
fn unassumed(audit: &Audit, plain: &Plain, limit: Option<f64>) -> Option<String> {
    let (own, misread) = (audit.best(), audit.misread(limit).is_some());
    let meant = format!("if it is meant so, say so (`{}`)", plain.options);
    let same = |(a, b): (&AxisReading, &AxisReading)| a.scale == b.scale && a.reversed == b.reversed;
    let axes = own.axes.iter().zip(&plain.convention.axes).all(same);
    let lobe = !(misread && limit.is_some()) || own.lobe == plain.convention.lobe;
    if axes && lobe && own.columns == plain.convention.columns {
        return misread.then_some(meant);
    }
    let plainly = readings_differ(audit, own, &plain.convention);
    Some(format!("{meant}; if not, make it again with {plainly}"))
}

/// What to do about a table of two lobes.
fn one_lobe(audit: &Audit, parts: &TwoLobes) -> String {
    let which = match extent(&audit.axes, &parts.extent) {
        ranges if ranges.is_empty() => "those texels".to_string(),
        ranges => format!("the texels at {ranges}"),
    };
    let (larger, smaller) = (audit.best().lobe.words(), parts.lobe.words());
    format!("if the shader has {larger}, make {which} again with that; if it has {smaller}, all the others")
}

/// How a defect is mended; none of those that are in the nature of the format.
pub(super) fn mending(defect: &Defect, axes: &[String], source: Source) -> Option<String> {
    let step = match defect {
        Defect::Part { extent: part, .. } => {
            let which = match extent(axes, part) {
                ranges if ranges.is_empty() => "those texels".to_string(),
                ranges => format!("the texels at {ranges}"),
            };
            return Some(format!(
                "make {which} again: they are of other code, of another time or of too few samples"
            ));
        }
        Defect::Dead { line: [axis, index], .. } => {
            let (line, name) = (LINES[*axis], &axes[*axis]);
            return Some(format!(
                "fill {line} {name} = {index}: take a coordinate near that end, by 0.001, where the end itself has no value"
            ));
        }
        Defect::Enlarged(Enlarged { from, .. }) => {
            let from = words(from);
            return Some(format!(
                "store the {from} texels that it was made from, or make it at its own size"
            ));
        }
        Defect::Factor { factor, column, .. } => {
            return Some(format!("divide {} by {}", column.name(), long(*factor)));
        }
        Defect::Flipped { axes: flipped, column, .. } => {
            return Some(format!("turn {} round along {}", column.name(), names(axes, flipped)));
        }
        Defect::ChannelLobe { lobe, column, .. } => {
            return Some(format!(
                "make {} again with the shadowing of the others, or if the shader has {}, make the others again",
                column.name(),
                lobe.words()
            ));
        }
        Defect::Clamped { .. } if source == Source::Function => {
            "the function saturates there: let it go on beyond that value, or clamp what becomes of it"
        }
        Defect::Clamped { .. } => "store it in a format that holds values beyond the clamp",
        Defect::Gain { .. } => "make it again, so that no more energy leaves than comes in",
        Defect::MissingLoss { .. } => "make the loss again by quadrature or by sampling visible normals",
        _ => return None,
    };
    Some(step.to_string())
}

/// Whether another registration fits as well or better at the texels: then no remedy of it is sure.
fn is_open(audit: &Audit) -> bool {
    let registrations = |t: &Tried| t.convention.axes.iter().map(|a| a.registration).collect::<Vec<_>>();
    let second = audit.tried.iter().skip(1).find(|t| (t.rank / audit.tried[0].rank - 1.0).abs() >= SAME);
    audit.margin < LIKELY && second.is_some_and(|t| registrations(t) != registrations(&audit.tried[0]))
}

/// What to do about the axes, those of the same registration together.
fn registrations(audit: &Audit) -> Vec<String> {
    let axes: Vec<(&str, Registration, bool)> = audit
        .axes
        .iter()
        .zip(&audit.best().axes)
        .map(|(n, a)| (n.as_str(), a.registration, a.reversed))
        .collect();
    let mut told: Vec<(Registration, bool)> = Vec::new();
    let mut steps = Vec::new();
    for (_, registration, reversed) in &axes {
        if !told.contains(&(*registration, *reversed)) {
            told.push((*registration, *reversed));
            let same = axes.iter().filter(|a| (a.1, a.2) == (*registration, *reversed)).map(|a| a.0);
            steps.extend(step(&listed(&same.collect::<Vec<_>>()), *registration, *reversed));
        }
    }
    steps
}

/// What a reader or maker should do about an axis.
fn step(axis: &str, registration: Registration, reversed: bool) -> Option<String> {
    // The registration is that of the rising coordinate; a reader counts along the texels.
    let registration = match registration {
        Registration::Centre | Registration::Endpoint => registration,
        shifted if reversed => shifted.mirrored(),
        shifted => shifted,
    };
    let (centres, ends) = ("texel i at (i + 1/2)/n", "texel i at i/(n - 1)");
    let after = "it holds the value of the place after its own, that of texel i + 1";
    let before = "it holds the value of the place before its own, that of texel i - 1";
    Some(match registration {
        Registration::Centre | Registration::Endpoint => return None,
        Registration::Left => {
            format!("along {axis}, compute {centres}, or sample at u + 1/(2n) for a coordinate u")
        }
        Registration::Right => {
            format!("along {axis}, compute {centres}, or sample at u - 1/(2n) for a coordinate u")
        }
        Registration::OneHigh => format!("along {axis}, compute {centres}: now {after}"),
        Registration::OneLow => format!("along {axis}, compute {centres}: now {before}"),
        Registration::EndHigh => format!("along {axis}, compute {ends}: now {after}"),
        Registration::EndLow => format!("along {axis}, compute {ends}: now {before}"),
    })
}
