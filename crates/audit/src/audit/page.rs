//! What an audit found out, for the report.

use super::axis::{AxisReading, Input, Registration};
use super::sample::spread;
use super::table::{Source, flat, place};
use super::verdict::{number, passed, sentence};
use super::{Audit, ChannelAudit, Convention, Defect, Tried};
use crate::report::{
    AuditAxis, AuditChannel, AuditConvention, AuditCurve, AuditDefect, AuditFindings, AuditFurnace,
    AuditHeld, AuditPlain, AuditPublished,
};
use lobefit::report::{Field, Origin, Ruler};

/// Curves of a channel.
const CURVES: usize = 4;

/// Slices of a table of three axes that are shown.
const SLICES: usize = 6;

/// The findings of an audit of a file; `holds` says what the file is.
pub fn findings(audit: &Audit, origin: Origin, file: &str, holds: &str, limit: Option<f64>) -> AuditFindings {
    AuditFindings {
        origin,
        file: file.into(),
        holds: holds.into(),
        quantity: audit.quantity.into(),
        verdict: audit.verdict(limit),
        otherwise: None,
        fits: audit.fit,
        figure: audit.figure(limit),
        plain: audit.plain.as_ref().map(|p| AuditPlain {
            untold: p.untold.clone(),
            max: Some(p.max).filter(|m| m.is_finite()),
            options: p.options.clone(),
        }),
        encoding: audit.encoding.map(|encoding| encoding.name.into()),
        slice: audit.at.iter().map(|(input, x)| (input.name().to_string(), *x)).collect(),
        published: audit.published.as_ref().map(|known| AuditPublished {
            name: known.name,
            publication: known.publication,
            made_for: known.made_for.map(|form| form.word),
        }),
        limit,
        passed: passed(limit, audit.passes(limit)),
        margin: Some(audit.margin).filter(|m| m.is_finite()),
        truth_error: audit.truth_error,
        stated: false,
        conventions: audit.tried.iter().map(|t| convention(audit, t)).collect(),
        channels: audit.channels.iter().filter_map(|c| channel(audit, c)).collect(),
        blend: audit.blend.clone(),
        furnace: audit.furnace.as_ref().filter(|f| f.dark == 0).map(|f| AuditFurnace {
            least: f.range[0],
            most: f.range[1],
            at: f.at.clone(),
        }),
        cost: None,
    }
}

fn convention(audit: &Audit, tried: &Tried) -> AuditConvention {
    let held = audit.channels.iter().zip(&tried.convention.columns).zip(&tried.misfits);
    AuditConvention {
        axes: audit
            .axes
            .iter()
            .zip(&tried.convention.axes)
            .map(|(name, a)| axis(audit.source, name, a))
            .collect(),
        lobe: tried.convention.lobe.words(),
        channels: held
            .filter_map(|((c, column), misfit)| {
                let (column, misfit) = column.zip(*misfit)?;
                Some(AuditHeld {
                    channel: c.name.clone(),
                    holds: column.name().into(),
                    max: misfit.max,
                    rms: misfit.rms,
                })
            })
            .collect(),
        rank: tried.rank,
    }
}

fn axis(source: Source, name: &str, a: &AxisReading) -> AuditAxis {
    AuditAxis {
        axis: name.into(),
        coordinate: a.scale.name().into(),
        reversed: a.reversed,
        registration: if source == Source::Table { a.registration.name().into() } else { String::new() },
        clamp: Some(a.floor).filter(|f| *f > 0.0),
    }
}

fn channel(audit: &Audit, c: &ChannelAudit) -> Option<AuditChannel> {
    let (column, e) = (c.column?, c.errors.as_ref()?);
    Some(AuditChannel {
        name: c.name.clone(),
        holds: column.words(),
        fits: c.fit,
        texels: e.clone(),
        points: c.points.clone(),
        defects: c
            .defects
            .iter()
            .map(|d| AuditDefect { kind: kind(d).into(), text: sentence(d, &audit.axes) })
            .collect(),
        lookup: c.lookup.clone(),
        plain_lookup: c.plain_lookup.clone(),
        maps: maps(audit, c),
        curves: curves(audit, c),
    })
}

fn kind(defect: &Defect) -> &'static str {
    match defect {
        Defect::Part { .. } => "part",
        Defect::Optimised { .. } => "optimised",
        Defect::Gain { .. } => "gain",
        Defect::Dead { .. } => "dead",
        Defect::Factor { .. } => "factor",
        Defect::Flipped { .. } => "flipped",
        Defect::ChannelLobe { .. } => "channel-lobe",
        Defect::Bias { .. } => "bias",
        Defect::Clamped { .. } => "clamped",
        Defect::Noise { .. } => "noise",
        Defect::Steps { .. } => "steps",
        Defect::Sampled { .. } => "sampled",
        Defect::MissingLoss { .. } => "missing-loss",
        Defect::OtherLobe(_) => "other-lobe",
        Defect::Enlarged(_) => "enlarged",
    }
}

/// Error maps over columns and rows, of some slices; none of a table of one axis.
fn maps(audit: &Audit, c: &ChannelAudit) -> Vec<Field> {
    let dims: Vec<usize> = audit.places.iter().map(Vec::len).collect();
    if dims.len() < 2 {
        return Vec::new();
    }
    let plane = dims[0] * dims[1];
    let slices = c.map.len() / plane.max(1);
    let worst = |k: usize| c.map[k * plane..(k + 1) * plane].iter().map(|e| e.abs()).fold(0.0, f64::max);
    let mut shown: Vec<usize> = spread(slices, SLICES, false);
    if let Some(k) = (0..slices).max_by(|a, b| worst(*a).total_cmp(&worst(*b)).then(b.cmp(a)))
        && !shown.contains(&k)
    {
        shown.push(k);
        shown.sort_unstable();
    }
    let ruler = |axis: usize| {
        let (scale, places) = (audit.best().axes[axis].scale.name(), &audit.places[axis]);
        match audit.source {
            Source::Table => Ruler {
                name: format!("{} ({scale})", ["column", "row"][axis]),
                values: places.iter().map(|i| *i as f64).collect(),
            },
            Source::Function => Ruler {
                name: format!("{} (given {scale})", audit.axes[axis]),
                values: places
                    .iter()
                    .map(|i| Registration::Centre.coordinate(*i, audit.size[axis]))
                    .collect(),
            },
        }
    };
    let name = |k: usize| match audit.places.get(2) {
        Some(z) => format!("error, slice {}", z[k]),
        None => format!("error of {}", c.column.map_or("", |c| c.name())),
    };
    shown
        .into_iter()
        .map(|k| Field {
            name: name(k),
            unit: String::new(),
            signed: true,
            x: ruler(0),
            y: ruler(1),
            values: c.map[k * plane..(k + 1) * plane].iter().map(|e| *e as f32).collect(),
        })
        .collect()
}

/// Channel and truth along the axis of mu (or the first), for some places along the others.
fn curves(audit: &Audit, c: &ChannelAudit) -> Vec<AuditCurve> {
    let best = audit.best();
    let dims: Vec<usize> = audit.places.iter().map(Vec::len).collect();
    let along = best.axes.iter().position(|a| a.scale.input() == Input::Mu).unwrap_or(0);
    let Some(worst) = c.errors.as_ref().map(|e| &e.texel) else { return Vec::new() };
    // The lines run through the worst texel, but for one axis in which they are spread.
    let other = (0..dims.len()).find(|k| *k != along);
    let nearest = |k: usize| audit.places[k].iter().position(|i| *i >= worst[k]).unwrap_or(0);
    let fixed: Vec<usize> = (0..dims.len()).map(nearest).collect();
    let lines: Vec<Vec<usize>> = match other {
        None => vec![fixed],
        Some(k) => {
            let mut shown = spread(dims[k], CURVES, false);
            if !shown.contains(&fixed[k]) {
                shown.push(fixed[k]);
                shown.sort_unstable();
            }
            let line =
                |i: usize| (0..dims.len()).map(|axis| if axis == k { i } else { fixed[axis] }).collect();
            shown.into_iter().map(line).collect()
        }
    };
    lines.iter().map(|line| curve(audit, c, best, along, line)).collect()
}

fn curve(audit: &Audit, c: &ChannelAudit, best: &Convention, along: usize, line: &[usize]) -> AuditCurve {
    let dims: Vec<usize> = audit.places.iter().map(Vec::len).collect();
    let node = |axis: usize, i: usize| best.axes[axis].node(audit.places[axis][i], audit.size[axis]);
    let texel = |i: usize| {
        let mut at = line.to_vec();
        at[along] = i;
        flat(&at, &dims)
    };
    let fixed = (0..dims.len())
        .filter(|k| *k != along)
        .map(|k| format!("{} {}", best.axes[k].scale.input().name(), number(node(k, line[k]))));
    let texels: Vec<usize> = (0..dims[along]).map(texel).collect();
    let drawn = |t: usize| node(along, place(t, &dims)[along]).is_finite() && c.truth[t].is_finite();
    // An index without a bound has no place on a page.
    let texels: Vec<usize> = texels.into_iter().filter(|t| drawn(*t)).collect();
    AuditCurve {
        title: fixed.collect::<Vec<_>>().join(", "),
        x: best.axes[along].scale.input().name().into(),
        at: texels.iter().map(|t| node(along, place(*t, &dims)[along])).collect(),
        truth: texels.iter().map(|t| c.truth[*t]).collect(),
        held: texels.iter().map(|t| c.truth[*t] + c.map[*t]).collect(),
    }
}
