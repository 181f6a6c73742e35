//! Two or three fetches along the axis that the proxy stretches: the formulas of
//! [`lobefit_truth::optics::footprint::Stretch`] and of the rule of fetches in a shader's
//! arithmetic.

use super::{Wanted, lobe, rule, single};
use crate::effects::parallax::taps::horizon::{FADE, LEAST};

/// Axes of a round lobe about the ray: those of Duff et al. 2017.
const ROUND: &str = "
let upright = select(1.0, -1.0, ray.z < 0.0);
let turned = -1.0 / (upright + ray.z);
let mixed = ray.x * ray.y * turned;
let FIRST = vec3f(1.0 + upright * ray.x * ray.x * turned, upright * mixed, -upright * ray.x);
let SECOND = vec3f(mixed, upright + ray.y * ray.y * turned, -ray.y);
";

/// The map of a lobe of half-axes `first` and `second` to the probe, as
/// [`lobefit_truth::optics::footprint::Stretch`] has it. M^T M over the root of its determinant,
/// `shrunk` (d_s/d_p)^2, is the form [[mean + skew, form_12], [form_12, mean - skew]]; `shrunk` is
/// (n.w_p)/(n.w_s), but where a grazing cosine counts as 0.02. With the growth over the lobe's
/// width added, its larger eigenvalue is `large` and the difference of both 2 `off`, so that
/// z^2 = 1 - small/large, `spread` squared, is 2 off/large without a difference.
const STRETCH: &str = "
let straight = inverseSqrt(dot(met.xyz, met.xyz));
let wall = met.xyz * straight;
let facing = dot(wall, towards);
let here = max(straight, 0.02);
let slope_1 = -dot(wall, first) / here;
let slope_2 = -dot(wall, second) / here;
let between = dot(towards, ray);
let seen_1 = dot(towards, first) + between * slope_1;
let seen_2 = dot(towards, second) + between * slope_2;
let growth_1 = slope_1 - ratio * seen_1;
let growth_2 = slope_2 - ratio * seen_2;
let a = first + ray * slope_1 - towards * seen_1;
let b = second + ray * slope_2 - towards * seen_2;
let wide_1 = dot(a, a);
let wide_2 = dot(b, b);
let shrunk = abs(facing / here + between * (1.0 - straight / here));
let unit = 1.0 / max(shrunk, 0.0002 * (wide_1 + wide_2));
let form_1 = unit * wide_1;
let form_2 = unit * wide_2;
let form_12 = unit * dot(a, b);
let skew = 0.5 * (form_1 - form_2);
let mean = 0.5 * (form_1 + form_2);
let v = width * growth_1;
let w = width * growth_2;
let along = skew + 0.5 * (v * v - w * w);
let across = form_12 + v * w;
let off = max(sqrt(along * along + across * across), 1e-10);
let large = mean + 0.5 * (v * v + w * w) + off;
let turn = sqrt(0.5 + 0.5 * abs(along) / off);
let beside = 0.5 * across / (off * turn);
let cosine = select(abs(beside), turn, along >= 0.0);
let sine = select(select(-turn, turn, across >= 0.0), beside, along >= 0.0);
let grown = cosine * growth_1 + sine * growth_2;
let ending = select(1.0, -1.0, grown < 0.0);
let growth = abs(grown);
let slope = ending * (cosine * slope_1 + sine * slope_2);
let spread = sqrt(2.0 * off / large);
let major = ending * (cosine * first + sine * second);
";

/// The square of the length of `major`, which for a lobe that is not round is not 1.
const REACH: &str = "
let reach = cosine * cosine * longer * longer + sine * sine * shorter * shorter;
";

/// The lookup by several fetches.
pub(super) fn lookup(wanted: &Wanted) -> String {
    let n = wanted.lookup.taps as usize;
    let each = |line: &dyn Fn(usize) -> String| -> String { (0..n).map(line).collect() };
    let list = |name: &str| (0..n).map(|i| format!("{name}_{i}")).collect::<Vec<_>>().join(", ");
    let shares: Vec<String> = (0..n).map(|i| format!("share_{i} * kept_{i}")).collect();
    let (least, steepest) = (LEAST as f32, (1.0 / LEAST) as f32);
    let body = [
        single::about(wanted),
        single::seen(wanted),
        axes(wanted),
        STRETCH.into(),
        if wanted.lookup.is_fitted() { REACH.into() } else { String::new() },
        rule::statements(&wanted.rule),
        RISING.into(),
        each(&|i| kept_share(wanted, i)),
        format!("let whole = {};\nlet ruled = min({steepest:?} * whole, 1.0);\n", shares.join(" + ")),
        each(&|i| tap(wanted, i)),
        each(&|i| {
            format!("let weight_{i} = share_{i} * (1.0 - ruled + kept_{i} / max(whole, {least:?}));\n")
        }),
        format!("return parallax_taps_{n}({}, {});\n", list("fetch"), list("weight")),
    ];
    let (result, body) = (format!("parallax_taps_{n}"), body.concat());
    single::function(&wanted.name, single::points(wanted), false, wanted, [&result, &body])
}

/// Documentation of the structure.
const STRUCTURE: &str = "/// Fetches from a probe: directions (xyz), with widths or levels (w); weights are their shares, which sum to 1.\n";

/// The structure of so many fetches.
pub(super) fn structure(taps: u32) -> String {
    let fields = |name: &str, kind: &str| -> String {
        (0..taps).map(|i| format!("    {name}_{i}: {kind},\n")).collect()
    };
    format!(
        "{STRUCTURE}struct parallax_taps_{taps} {{\n{}{}}}\n",
        fields("fetch", "vec4f"),
        fields("weight", "f32")
    )
}

/// The half-axes of the lobe.
fn axes(wanted: &Wanted) -> String {
    let named = |first: &str, second: &str| ROUND.replace("FIRST", first).replace("SECOND", second);
    if wanted.lookup.is_fitted() { named("base_1", "base_2") + lobe::AXES } else { named("first", "second") }
}

/// 1 and the square of a tilt: that of the length of a ray tilted along `major`.
fn tilted(wanted: &Wanted, tilt: &str) -> String {
    let reach = if wanted.lookup.is_fitted() { " * reach" } else { "" };
    format!("1.0 + {tilt} * {tilt}{reach}")
}

/// The cosines of the ray and of the axis that fetches are tilted along with the surface's normal.
const RISING: &str = "
let upward = dot(ray, normal);
let rising = dot(major, normal);
";

/// What share of its weight a fetch keeps above the surface, as
/// [`horizon`](crate::effects::parallax::taps::horizon) has it.
fn kept_share(wanted: &Wanted, i: usize) -> String {
    let steep = (1.0 / FADE) as f32;
    let square = tilted(wanted, &format!("tilt_{i}"));
    format!("let kept_{i} = min(max({steep:?} * (upward + tilt_{i} * rising) / sqrt({square}), 0.0), 1.0);\n")
}

/// A fetch of the rule: its ray tilted along `major`, which is at right angles to the ray.
fn tap(wanted: &Wanted, i: usize) -> String {
    let passed = single::passed(wanted, &format!("place, ray_{i}, alpha_{i}"));
    let (fetch, square) = (&wanted.fetch, tilted(wanted, &format!("bend_{i}")));
    format!(
        "let bend_{i} = kept_{i} * tilt_{i};
        let unit_{i} = 1.0 / sqrt({square});
        let ray_{i} = (ray + bend_{i} * major) * unit_{i};
        let alpha_{i} = width * (1.0 + kept_{i} * (own_{i} - 1.0));
        let fetch_{i} = {fetch}({passed});\n"
    )
}
