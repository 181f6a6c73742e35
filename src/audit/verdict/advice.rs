//! What to change.

use crate::audit::axis::{Input, Siting};
use crate::audit::shipped::Source;
use crate::audit::{Audit, Column, Defect, Fit};

/// The steps that mend it; none where there is nothing to mend.
pub(super) fn advice(audit: &Audit) -> Option<String> {
    if audit.fit == Fit::None {
        return Some("Do not ship it as this quantity: make it again, or name what it holds.".into());
    }
    let mut steps = Vec::new();
    for (name, axis) in audit.axes.iter().zip(&audit.best().axes) {
        if audit.source == Source::Table {
            steps.extend(registration(name, axis.siting));
        }
        if axis.reversed && axis.scale.input() == Input::Alpha {
            steps.push(format!("pass 1 - {} as {name}", axis.scale.name()));
        }
    }
    steps.extend(audit.channels.iter().flat_map(|c| &c.defects).filter_map(mending).map(String::from));
    if audit.channels.iter().any(|c| matches!(c.column, Some(Column::Normal | Column::NormalLoss))) {
        steps.push("average over the cosine, E_avg = 2 int E mu dmu, if an average is meant".into());
    }
    steps.dedup();
    (!steps.is_empty()).then(|| format!("To mend it: {}.", steps.join("; ")))
}

fn mending(defect: &Defect) -> Option<&'static str> {
    match defect {
        Defect::Part { .. } => Some(
            "make the table again: a part made by other code, at another time or with too few samples looks like this",
        ),
        Defect::Clamped { .. } => Some("store it in a format that holds values beyond the clamp"),
        Defect::MissingLoss { .. } => {
            Some("make the loss again by quadrature or by sampling visible normals")
        }
        _ => None,
    }
}

/// What a reader or maker should do about an axis.
fn registration(axis: &str, siting: Siting) -> Option<String> {
    let again = format!("compute the texels along {axis} at (i + 1/2)/n");
    Some(match siting {
        Siting::Centre => return None,
        Siting::Endpoint => format!("sample {axis} at (u (n - 1) + 1/2)/n"),
        Siting::Left => format!("{again}, or sample at u + 1/(2n)"),
        Siting::Right => format!("{again}, or sample at u - 1/(2n)"),
        Siting::OneHigh => format!("{again}: they are one texel too far"),
        Siting::OneLow => format!("{again}: they are one texel too near"),
    })
}
