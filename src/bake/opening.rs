//! What the include files say first of all: of the effects that they hold, and of no others.

use super::part::Part;
use crate::data::{AlphaMap, Smith};
use crate::plan::EffectName;

/// A note, and what of the code it is said of: any of these texts in it.
type Note = (&'static [&'static str], &'static [&'static str]);

/// The notes, in their order.
const NOTES: [Note; 11] = [
    (&["path_tracer_"], &["(`path_tracer_*` have a form and a map of their own, which their heads tell.)"]),
    (&["f0"], &["f0 is the reflectance at normal incidence."]),
    (&["ggx_norm_"], &["`ggx_norm_*` is N with E N = 1: multiply the specular lobe by it."]),
    (
        &["_saturating"],
        &["`*_saturating` is 1 + f0 (N - 1): multiply a metal's lobe by that, per colour channel."],
    ),
    (&["_lookup("], &["`*_lookup` is E from a table; `*_compensate_*` take it."]),
    (
        &["ior: f32", "float ior"],
        &["ior is the index of refraction, inside over outside, for rays from either side."],
    ),
    (
        &["anisotropy"],
        &[
            "anisotropy a in [0, 1] makes alpha_x = alpha/s and alpha_y = alpha s with s = sqrt(1 - 0.9 a); cos2_phi is the",
            "squared cosine of the view's azimuth from the alpha_x axis.",
        ],
    ),
    (
        &["coupling_"],
        &[
            "`coupling_*` is the factor of a white diffuse base below a specular lobe, for `diffuse_coupled_*`.",
        ],
    ),
    (
        &["charlie_"],
        &["`charlie_*` is E, the albedo of the sheen lobe, by which the layers below it are dimmed."],
    ),
    (
        &["parallax_"],
        &[
            "`parallax_*` is the width of a fetch from a prefiltered probe, of the lobe that its head names and no other; rho is the",
            "distance of the shading point over that of the probe from the point of the proxy that both see, mip a level of the chain.",
        ],
    ),
    (
        &["parallax_lookup_"],
        &[
            "`parallax_lookup_*` is what to fetch from a probe through a proxy of its room; `parallax_meet_*`, where a ray meets that, and",
            "`parallax_fetch_*`, one fetch along a ray, are its parts.",
        ],
    ),
];

/// The lines, of the parts that a bake has.
pub(super) fn opening(smith: Smith, alpha: AlphaMap, parts: &[Part]) -> Vec<String> {
    let names: Vec<&str> = parts.iter().map(|p| p.effect.name()).collect();
    let mut out = vec![String::new(), format!("Effects: {}", names.join(", "))];
    let sheen = |part: &&Part| part.effect == EffectName::Sheen;
    let smith_less = |part: &Part| matches!(part.effect, EffectName::Sheen | EffectName::Parallax);
    if parts.iter().any(|part| !smith_less(part)) {
        out.push(format!("GGX lobe, smith: {}; alpha = {}", smith.name(), alpha.name()));
    }
    if parts.iter().any(|part| sheen(&part)) {
        out.push(format!("Charlie sheen lobe; alpha = {}", alpha.name()));
    }
    if parts.iter().any(|part| part.effect == EffectName::Parallax) {
        out.push(format!("Prefiltered probes; alpha = {}", alpha.name()));
    }
    if parts.iter().any(|part| part.effect != EffectName::Parallax) {
        out.push("Inputs: alpha is the width of the lobe, roughness the parameter it is made from, mu the cosine between normal".into());
        out.push("and view.".into());
    } else {
        out.push("Inputs: alpha is the width of the lobe, roughness the parameter it is made from.".into());
    }
    let holds = |text: &&str| parts.iter().flat_map(|p| p.code.values()).any(|code| code.contains(*text));
    let told = NOTES.iter().filter(|(of, _)| of.iter().any(&holds));
    out.extend(told.flat_map(|(_, lines)| lines.iter().map(ToString::to_string)));
    out.push("Operations: add, mul, fma, min, max, compare, select 1; rcp, sqrt, exp2 4; division rcp + mul; exp 5, pow 9;".into());
    out.push("sin, cos, log2 4; log 5.".into());
    out
}
