//! A defect in a sentence.

use super::words::{listed, long, names, number};
use crate::audit::{Defect, Extent};

/// The sentence; `axes` names the table's axes.
pub(in crate::audit) fn sentence(defect: &Defect, axes: &[String]) -> String {
    match defect {
        Defect::Part { texels: [off, all], over, mean, rest, extent: part, .. } => {
            let ranges = extent(axes, part);
            let place = if ranges.is_empty() { String::new() } else { format!(", all at {ranges}") };
            let (over, mean_text, way, rest) = (number(*over), number(mean.abs()), way(*mean), number(*rest));
            match off {
                1 => format!(
                    "1 of {all} texels, at {ranges}, is {mean_text} {way}; the others leave RMS {rest}."
                ),
                _ => format!(
                    "{off} of {all} texels are off by more than {over}, on average {mean_text} {way}{place}; the others leave RMS {rest}."
                ),
            }
        }
        Defect::Optimised { texels, lookups: [own, mended] } => format!(
            "{texels} texels are off for the sake of lookups, which at even places are off by at most {}, and with true texels by {}.",
            number(*own),
            number(*mended)
        ),
        Defect::Gain { albedo, texel, .. } => {
            format!("It gains energy: {} of the light comes back at texel {texel:?}.", long(*albedo))
        }
        Defect::Dead { line: [axis, index], value } => format!(
            "Its {} {} = {index} holds {} throughout, far from what lies beside it: it was never filled, and is not judged.",
            LINES[*axis],
            axes[*axis],
            number(*value)
        ),
        Defect::OtherLobe(parts) => {
            let [_, smaller, all] = parts.texels;
            let (lobe, ranges) = (parts.lobe.words(), extent(axes, &parts.extent));
            let place = if ranges.is_empty() { String::new() } else { format!(", all at {ranges},") };
            format!(
                "{smaller} of {all} texels{place} are of {lobe}, off by at most {} of it.",
                number(parts.max)
            )
        }
        Defect::Enlarged(from) => {
            format!("It is a table of {from}, and holds no more than that.")
        }
        Defect::Factor { factor, column, .. } => {
            format!("All of its values are {} times those of {}.", long(*factor), column.name())
        }
        Defect::Flipped { axes: flipped, .. } => {
            format!("All of its values stand the other way round along {}.", names(axes, flipped))
        }
        Defect::ChannelLobe { lobe, .. } => {
            format!("Its values are of {}, not of the lobe that the others are of.", lobe.words())
        }
        Defect::Bias { mean } => {
            format!(
                "The error is mostly a bias: values are {} {} on average.",
                number(mean.abs()),
                way(*mean)
            )
        }
        Defect::Clamped { value, texels, truth, .. } => format!(
            "{texels} values stand at {} where the truth goes on to {}: clamped.",
            number(*value),
            number(*truth)
        ),
        Defect::Noise { rms, share, step, apart } => {
            let cause = step.map_or("as sampling noise does".into(), |step| {
                format!("as rounding to {} does", step.text())
            });
            let (share, rms) = ((100.0 * share.min(1.0)).round(), number(*rms));
            let rest = if *apart { " of the others" } else { "" };
            format!("{share} % of the error{rest} jumps from texel to texel, {cause} (RMS {rms}).")
        }
        Defect::Steps { step, rms } => {
            format!("That is what rounding to {} leaves (RMS {}).", step.text(), number(*rms))
        }
        Defect::Sampled { samples, left, texels: [0, _] } => {
            format!("No texel is off by more than {samples} samples leave ({}).", number(*left))
        }
        Defect::Sampled { samples, left, texels: [over, all] } => {
            format!(
                "{over} of {all} texels are off by more than {samples} samples leave ({}).",
                number(*left)
            )
        }
        Defect::MissingLoss { column, stored, alpha, worst, texel } => format!(
            "Of {} a quarter of the texels of smooth surfaces (alpha up to {}) hold less than {} % of the true loss; worst at texel {texel:?}, {} \
             where {} is true: a sampling that misses the tail of the lobe does this.",
            column.name(),
            number(*alpha),
            (100.0 * stored.max(0.0)).ceil(),
            number(worst[0]),
            number(worst[1])
        ),
    }
}

/// What lies at one index along each axis.
pub(super) const LINES: [&str; 3] = ["column", "row", "slice"];

/// Single texels that are listed.
const LISTED: usize = 4;

/// Where texels lie: `y = 16 to 31`, `slice z = 3`; nothing said of an axis along which they lie
/// everywhere. Of several that stand alone, `[3, 5] and [9, 1]`, the first [`LISTED`].
pub(super) fn extent(axes: &[String], extent: &Extent) -> String {
    let Extent { range, alone, size } = extent;
    if alone.len() > 1 {
        let mut texels: Vec<String> = alone.iter().take(LISTED).map(|texel| format!("{texel:?}")).collect();
        texels.extend((alone.len() > LISTED).then(|| format!("{} more", alone.len() - LISTED)));
        return listed(&texels.iter().map(String::as_str).collect::<Vec<_>>());
    }
    let along = |((name, r), n): ((&String, &[usize; 2]), &usize)| {
        let whole = r[0] == 0 && r[1] + 1 == *n;
        (!whole).then(|| match r[0] == r[1] {
            true if name == "z" => format!("slice z = {}", r[0]),
            true => format!("{name} = {}", r[0]),
            false => format!("{name} = {} to {}", r[0], r[1]),
        })
    };
    axes.iter().zip(range).zip(size).filter_map(along).collect::<Vec<_>>().join(", ")
}

fn way(mean: f64) -> &'static str {
    if mean > 0.0 { "too high" } else { "too low" }
}
