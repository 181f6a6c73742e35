//! The same for the report.

use super::{Declared, Held};
use crate::audit::Fit;
use crate::audit::sample::spread;
use crate::audit::table::place;
use crate::audit::verdict::{number, passed};
use crate::report::{AuditAxis, AuditChannel, AuditConvention, AuditCurve, AuditFindings, AuditHeld};
use lobefit::report::{Field, Origin, Ruler};

/// Places of the third input that are shown, and curves.
const SLICES: usize = 3;
const CURVES: usize = 4;

/// The findings on a file that says what it is; `holds` says what the file is.
pub fn findings(
    found: &Declared,
    origin: Origin,
    file: &str,
    holds: &str,
    limit: Option<f64>,
) -> AuditFindings {
    let axes = found.axes.iter().map(|[letter, name, registration, formula]| AuditAxis {
        axis: letter.clone(),
        coordinate: format!("{name}, {formula}; {registration}"),
        reversed: false,
        registration: String::new(),
        clamp: None,
    });
    let held = |h: &Held| AuditHeld {
        channel: h.column.name().into(),
        holds: h.column.name().into(),
        max: h.figures.max,
        rms: h.figures.rms,
    };
    AuditFindings {
        origin,
        file: file.into(),
        holds: holds.into(),
        quantity: found.quantity.into(),
        verdict: found.verdict(limit),
        otherwise: None,
        fits: if found.holds() { Fit::Whole } else { Fit::None },
        figure: found.figure(limit),
        plain: None,
        encoding: None,
        slice: Default::default(),
        published: None,
        limit,
        passed: passed(limit, found.passes(limit)),
        margin: None,
        truth_error: found.truth_error,
        stated: true,
        conventions: vec![AuditConvention {
            axes: axes.collect(),
            lobe: found.lobe.clone(),
            channels: found.held.iter().map(held).collect(),
            rank: found.held.iter().map(|h| h.figures.rms).fold(0.0, f64::max),
        }],
        channels: found.held.iter().map(|h| channel(found, h)).collect(),
        blend: None,
        furnace: None,
        cost: None,
    }
}

fn channel(found: &Declared, held: &Held) -> AuditChannel {
    AuditChannel {
        name: held.column.name().into(),
        holds: held.column.words(),
        fits: if found.holds() { Fit::Whole } else { Fit::None },
        texels: held.figures.clone(),
        points: Vec::new(),
        defects: Vec::new(),
        lookup: None,
        plain_lookup: None,
        maps: maps(found, held),
        curves: curves(found, held),
    }
}

/// First input along columns, the second along rows, some places of the third.
fn maps(found: &Declared, held: &Held) -> Vec<Field> {
    let [(x, xs), (y, ys), ..] = found.places.as_slice() else { return Vec::new() };
    let plane = xs.len() * ys.len();
    let slices = held.errors.len() / plane.max(1);
    let field = |k: usize| Field {
        name: slice(found, held, k),
        unit: String::new(),
        signed: true,
        x: Ruler { name: (*x).into(), values: xs.clone() },
        y: Ruler { name: (*y).into(), values: ys.clone() },
        values: held.errors[k * plane..][..plane].iter().map(|e| *e as f32).collect(),
    };
    spread(slices, SLICES, false).into_iter().map(field).collect()
}

/// Name of a slice: its places along the inputs after the second.
fn slice(found: &Declared, held: &Held, k: usize) -> String {
    let after = found.places.iter().skip(2);
    let sizes: Vec<usize> = after.clone().map(|p| p.1.len()).collect();
    let at = place(k, &sizes);
    let told: Vec<String> =
        after.zip(at).map(|((name, list), i)| format!("{name} {}", number(list[i]))).collect();
    if told.is_empty() {
        format!("error of {}", held.column.name())
    } else {
        format!("error, {}", told.join(", "))
    }
}

/// Along the second input (mu of two inputs, alpha of three), for some places of the first.
fn curves(found: &Declared, held: &Held) -> Vec<AuditCurve> {
    let [(x, xs), (y, ys), ..] = found.places.as_slice() else { return Vec::new() };
    let one = |i: usize| {
        let line: Vec<usize> = (0..ys.len()).map(|j| j * xs.len() + i).collect();
        AuditCurve {
            title: format!("{x} {}", number(xs[i])),
            x: (*y).into(),
            at: ys.clone(),
            truth: line.iter().map(|k| held.truths[*k]).collect(),
            held: line.iter().map(|k| held.truths[*k] + held.errors[*k]).collect(),
        }
    };
    spread(xs.len(), CURVES, false).into_iter().map(one).collect()
}
