//! What to change.

use super::defect::extent;
use super::words::listed;
use crate::audit::axis::{Input, Siting};
use crate::audit::shipped::Source;
use crate::audit::{Audit, Column, Defect, Fit, Mixed};

/// The steps that mend it; none where there is nothing to mend.
pub(super) fn advice(audit: &Audit) -> Option<String> {
    if audit.fit == Fit::None {
        let told = match audit.source {
            Source::Table => "make it again, or audit it as what it holds",
            Source::Function => "fit its constants to this quantity, or audit it as what it computes",
        };
        return Some(format!("Do not ship it as this quantity: {told}."));
    }
    let mut steps: Vec<String> = audit.mixed.iter().map(|parts| one_lobe(audit, parts)).collect();
    if audit.source == Source::Table {
        steps.extend(registrations(audit));
    }
    for (name, axis) in audit.axes.iter().zip(&audit.best().axes) {
        if axis.reversed && axis.scale.input() == Input::Alpha {
            steps.push(format!("pass 1 - {} as {name}", axis.scale.name()));
        }
    }
    steps.extend(
        audit
            .channels
            .iter()
            .flat_map(|c| &c.defects)
            .filter_map(|d| mending(d, audit.source))
            .map(String::from),
    );
    if audit.channels.iter().any(|c| matches!(c.column, Some(Column::Normal | Column::NormalLoss))) {
        steps.push("average over the cosine, E_avg = 2 int E mu dmu, if an average is meant".into());
    }
    steps.dedup();
    (!steps.is_empty()).then(|| format!("To mend it: {}.", steps.join("; ")))
}

/// What to do about a table of two lobes.
fn one_lobe(audit: &Audit, parts: &Mixed) -> String {
    let which = match extent(&audit.axes, &parts.range, &parts.size) {
        ranges if ranges.is_empty() => "those texels".to_string(),
        ranges => format!("the texels at {ranges}"),
    };
    let (larger, smaller) = (audit.best().lobe.words(), parts.lobe.words());
    format!("if the shader has {larger}, make {which} again with that; if it has {smaller}, all the others")
}

fn mending(defect: &Defect, source: Source) -> Option<&'static str> {
    match defect {
        Defect::Part { .. } => Some(
            "make the table again: a part made by other code, at another time or with too few samples looks like this",
        ),
        Defect::Clamped { .. } if source == Source::Function => {
            Some("the function saturates there: let it go on beyond that value, or clamp what becomes of it")
        }
        Defect::Clamped { .. } => Some("store it in a format that holds values beyond the clamp"),
        Defect::MissingLoss { .. } => {
            Some("make the loss again by quadrature or by sampling visible normals")
        }
        _ => None,
    }
}

/// What to do about the axes, those of the same siting together.
fn registrations(audit: &Audit) -> Vec<String> {
    let axes: Vec<(&str, Siting, bool)> =
        audit.axes.iter().zip(&audit.best().axes).map(|(n, a)| (n.as_str(), a.siting, a.reversed)).collect();
    let mut told: Vec<(Siting, bool)> = Vec::new();
    let mut steps = Vec::new();
    for (_, siting, reversed) in &axes {
        if !told.contains(&(*siting, *reversed)) {
            told.push((*siting, *reversed));
            let same = axes.iter().filter(|a| (a.1, a.2) == (*siting, *reversed)).map(|a| a.0);
            steps.extend(registration(&listed(&same.collect::<Vec<_>>()), *siting, *reversed));
        }
    }
    steps
}

/// What a reader or maker should do about an axis.
fn registration(axis: &str, siting: Siting, reversed: bool) -> Option<String> {
    // The siting is that of the rising coordinate; a reader counts along the texels.
    let siting = match siting {
        Siting::Left if reversed => Siting::Right,
        Siting::Right if reversed => Siting::Left,
        Siting::OneHigh if reversed => Siting::OneLow,
        Siting::OneLow if reversed => Siting::OneHigh,
        Siting::EndHigh if reversed => Siting::EndLow,
        Siting::EndLow if reversed => Siting::EndHigh,
        other => other,
    };
    let (centres, ends) = ("texel i at (i + 1/2)/n", "texel i at i/(n - 1)");
    let after = "it holds the value of the place after its own, that of texel i + 1";
    let before = "it holds the value of the place before its own, that of texel i - 1";
    Some(match siting {
        Siting::Centre => return None,
        Siting::Endpoint => format!("along {axis}, sample at (u (n - 1) + 1/2)/n for a coordinate u"),
        Siting::Left => {
            format!("along {axis}, compute {centres}, or sample at u + 1/(2n) for a coordinate u")
        }
        Siting::Right => {
            format!("along {axis}, compute {centres}, or sample at u - 1/(2n) for a coordinate u")
        }
        Siting::OneHigh => format!("along {axis}, compute {centres}: now {after}"),
        Siting::OneLow => format!("along {axis}, compute {centres}: now {before}"),
        Siting::EndHigh => format!("along {axis}, compute {ends}: now {after}"),
        Siting::EndLow => format!("along {axis}, compute {ends}: now {before}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_falling_axis_is_shifted_the_other_way() {
        for (siting, mirrored) in [
            (Siting::Left, Siting::Right),
            (Siting::OneHigh, Siting::OneLow),
            (Siting::EndHigh, Siting::EndLow),
        ] {
            assert_eq!(registration("x", siting, true), registration("x", mirrored, false));
            assert_eq!(registration("x", mirrored, true), registration("x", siting, false));
        }
        assert_ne!(registration("x", Siting::Left, true), registration("x", Siting::Left, false));
    }

    #[test]
    fn a_function_is_stored_in_no_format() {
        let clamped = Defect::Clamped { value: 1.0, texels: 3, truth: 1.2 };
        let [of_table, of_function] = [Source::Table, Source::Function].map(|s| mending(&clamped, s));
        assert!(of_table.is_some_and(|t| t.contains("format")), "{of_table:?}");
        assert!(of_function.is_some_and(|t| t.contains("saturates")), "{of_function:?}");
    }
}
