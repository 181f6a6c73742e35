//! The space of forms of a target.

use super::SearchJob;
use crate::fitting::{Demand, FittingError};
use lobefit::approximate::Memo;
use lobefit::approximate::target::{Target, TargetError, TargetSpec};
use lobefit::data::Use;
use lobefit_fit::search::{Anchor, SearchAxis, SearchSamples, Space};
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::{Specular, Variant};

/// Highest powers of roughness (alpha^4) and of the other inputs in a term.
const DEGREES: [u8; 2] = [8, 5];

/// How far values at an edge may differ and be one.
const SAME: f64 = 1e-6;

/// The target of a spec, for a formula of all its inputs.
pub(super) fn target(spec: &TargetSpec) -> Result<Target, FittingError> {
    let mut arguments = Vec::new();
    for input in spec.quantity.inputs().iter().filter(|input| !input.optional) {
        if input.name == "alpha" {
            arguments.push("roughness");
        }
        arguments.push(input.name);
    }
    if spec.used_as.is_some_and(|used_as| used_as.blends) {
        arguments.push("f0");
    }
    let declared: Vec<String> = arguments.iter().map(|name| format!("{name}: f32")).collect();
    let source = format!("fn form({}) -> f32 {{ return {}; }}", declared.join(", "), arguments.join(" + "));
    Ok(Target::new(spec, &Hypothesis::parse("form.wgsl", &source)?)?)
}

/// `ggx_reflection_e_normalisation`: quantity, column, use.
pub(super) fn name(target: &Target) -> String {
    let Variant { side, specular, kernel, .. } = &target.variant;
    // Of a kernel's table the name: the hash in its word does not belong into the name of a
    // function.
    let words = [side.map(Side::name), specular.map(Specular::name), kernel.as_ref().map(Kernel::name)];
    let words = words.into_iter().flatten().map(String::from);
    let parts = [target.quantity.name(), target.column, target.used_as.name].map(String::from);
    let parts = parts.into_iter().chain(words);
    parts.collect::<Vec<_>>().join("_").replace('-', "_").to_lowercase()
}

/// The axes that have a range, by their index among the target's.
fn spanned(target: &Target) -> Vec<usize> {
    (0..target.axes.len()).filter(|k| target.axes[*k].is_spanned()).collect()
}

/// Where forms are exact. Asked for: the one value of the truth, or the value given, where an input
/// is 0; not asked for: the truth at alpha = 0 if it has one value there.
pub(super) fn anchor(target: &Target, demands: &[Demand]) -> Result<Option<Anchor>, FittingError> {
    let refuse =
        |input: &str, reason: String| TargetError::Edge { setting: "exact", input: input.into(), reason };
    let mut anchor: Option<Anchor> = None;
    for demand in demands {
        let Demand::Exact { input, at, value } = demand else {
            let reason =
                "a search keeps to --exact alone; fit one of its forms with the other constraints".into();
            return Err(refuse(&demand.words(), reason).into());
        };
        if *at != 0.0 {
            return Err(refuse(input, "forms of a search are exact where an input is 0".into()).into());
        }
        let (axis, found) = edge(target, input, *value)?;
        let Some(found) = found else {
            return Err(refuse(input, "the truth has more than one value there".into()).into());
        };
        match &mut anchor {
            Some(anchor) if f64::from(anchor.value) != f64::from(found) => {
                return Err(refuse(input, "its value there is not that of the other edge".into()).into());
            }
            Some(anchor) => anchor.zeros.push(axis),
            None => anchor = Some(Anchor { value: found, zeros: vec![axis] }),
        }
    }
    let mirror = target.has_alpha() && target.axes.iter().any(|a| a.name == "roughness" && a.is_spanned());
    if demands.is_empty() && mirror {
        // A quantity that is not defined at alpha = 0 is not anchored there.
        if let Ok((axis, Some(value))) = edge(target, "alpha", None) {
            anchor = Some(Anchor { value, zeros: vec![axis] });
        }
    }
    Ok(anchor)
}

/// The axis of an input among those with a range, and the one value at its 0.
fn edge(target: &Target, input: &str, value: Option<f64>) -> Result<(usize, Option<f32>), FittingError> {
    let (_, values) = target.edge(&[], "form", (input, 0.0), value)?;
    let name = if input == "alpha" && target.has_alpha() { "roughness" } else { input };
    let axis = spanned(target).into_iter().position(|k| target.axes[k].name == name);
    let axis = axis.ok_or_else(|| TargetError::Edge {
        setting: "exact",
        input: input.into(),
        reason: "its range is one value".into(),
    })?;
    let one = values.first().copied().filter(|first| values.iter().all(|v| (v - first).abs() <= SAME));
    // 1 - 1e-12 is 1.
    Ok((axis, one.map(|v| if (v - v.round()).abs() <= SAME { v.round() as f32 } else { v as f32 })))
}

/// The anchor in words.
pub(super) fn words(target: &Target, anchor: Option<&Anchor>) -> String {
    let Some(anchor) = anchor else { return String::new() };
    let axes = spanned(target);
    let zero = |k: &usize| format!("{} = 0", target.axes[axes[*k]].name);
    format!("{} at {}", anchor.value, anchor.zeros.iter().map(zero).collect::<Vec<_>>().join(" and at "))
}

/// The space: powers of every input, alpha free where roughness is.
pub(super) fn space(target: &Target, anchor: Option<Anchor>, job: &SearchJob) -> Result<Space, FittingError> {
    let mut space = Space::new(&format!("{}_", name(target)), axes(target), job.max_ops);
    space.title = title(target);
    space.prices = job.prices()?;
    space.anchor = anchor;
    space.width = job.width.unwrap_or(space.width);
    space.domain = Some(target.domain()?);
    Ok(space)
}

/// The axes with a range.
pub(super) fn axes(target: &Target) -> Vec<SearchAxis> {
    let power = target.alpha_map.power();
    let axis = |k: &usize| {
        let name = target.axes[*k].name.clone();
        let rough = name == "roughness" && target.has_alpha();
        let mut arguments = vec![(name, 1)];
        if rough && power > 1 {
            arguments.push(("alpha".to_string(), power));
        }
        SearchAxis { arguments, degree: if rough { DEGREES[0] } else { DEGREES[1] } }
    };
    spanned(target).iter().map(axis).collect()
}

pub(super) fn place(axes: &[SearchAxis], name: &str) -> Option<u8> {
    axes.iter().position(|a| a.arguments[0].0 == name).map(|k| k as u8)
}

/// The power of roughness that is of one order with mu where a lobe changes.
pub(super) fn order(target: &Target) -> u8 {
    if target.quantity.changes_at_alpha() { target.alpha_map.power() as u8 } else { 1 }
}

/// What a formula is, in a sentence.
pub(super) fn title(target: &Target) -> String {
    let what = match target.used_as {
        Use::NORMALISATION => {
            format!("Normalisation of {}: N with {} N = 1", target.quantity.name(), target.column)
        }
        Use::F0_BLEND => format!("f0 A + B of {}", target.quantity.name()),
        _ => format!("{} of {}", target.column, target.quantity.name()),
    };
    let words: Vec<String> = target.words().iter().map(|(k, v)| format!(", {k} {v}")).collect();
    let smith = crate::fitting::words::smith(target);
    format!("{what}{}{smith}, alpha = {}.", words.concat(), target.alpha_map.name())
}

/// The samples, one column per axis with a range.
pub(super) fn samples(target: &Target) -> Result<SearchSamples, FittingError> {
    let sampled = target.edged(&Memo::default())?;
    let names: Vec<String> = spanned(target).into_iter().map(|k| target.axes[k].name.clone()).collect();
    let axes = sampled.samples("form", &names, None)?.inputs;
    Ok(SearchSamples { axes, scale: sampled.scale, target: sampled.target })
}
