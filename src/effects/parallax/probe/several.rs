//! Two or three fetches along the axis that the proxy stretches, as a script: the formulas of [`lobefit_truth::optics::footprint::Stretch`] and of
//! the rule of fetches, in f32.

use super::script::{Kind, Routine};
use super::{Wanted, lobe, rule, single};
use crate::effects::parallax::taps::horizon::{FADE, LEAST};

/// Axes of a round lobe about the ray: those of Duff et al. 2017.
const ROUND: &str = "
upright = choose(ray.z < 0.0, -1.0, 1.0)
turned = -1.0 / (upright + ray.z)
mixed = ray.x * ray.y * turned
FIRST = 1.0 + upright * ray.x * ray.x * turned | upright * mixed | -upright * ray.x
SECOND = mixed | upright + ray.y * ray.y * turned | -ray.y
";

/// The map of a lobe of half-axes `first` and `second` to the probe, as [`lobefit_truth::optics::footprint::Stretch`] has it. M^T M
/// over the root of its determinant, `shrunk` (d_s/d_p)^2, is the form [[mean + skew, form_12], [form_12, mean - skew]]; `shrunk` is
/// (n.w_p)/(n.w_s), but where a grazing cosine counts as 0.02. With the growth over the lobe's width added, its larger eigenvalue is `large`
/// and the difference of both 2 `off`, so that z^2 = 1 - small/large, `spread` squared, is 2 off/large without a difference.
const STRETCH: &str = "
slope_1 = -(met.x * first.x + met.y * first.y + met.z * first.z) / here
slope_2 = -(met.x * second.x + met.y * second.y + met.z * second.z) / here
between = towards.x * ray.x + towards.y * ray.y + towards.z * ray.z
seen_1 = towards.x * first.x + towards.y * first.y + towards.z * first.z + between * slope_1
seen_2 = towards.x * second.x + towards.y * second.y + towards.z * second.z + between * slope_2
growth_1 = slope_1 - met.w / away * seen_1
growth_2 = slope_2 - met.w / away * seen_2
a = first.x + ray.x * slope_1 - towards.x * seen_1 | first.y + ray.y * slope_1 - towards.y * seen_1 | first.z + ray.z * slope_1 - towards.z * seen_1
b = second.x + ray.x * slope_2 - towards.x * seen_2 | second.y + ray.y * slope_2 - towards.y * seen_2 | second.z + ray.z * slope_2 - towards.z * seen_2
wide_1 = a.x * a.x + a.y * a.y + a.z * a.z
wide_2 = b.x * b.x + b.y * b.y + b.z * b.z
shrunk = abs(facing / here + between * (1.0 - straight / here))
unit = 1.0 / max(shrunk, 0.0002 * (wide_1 + wide_2))
form_1 = unit * wide_1
form_2 = unit * wide_2
form_12 = unit * (a.x * b.x + a.y * b.y + a.z * b.z)
skew = 0.5 * (form_1 - form_2)
mean = 0.5 * (form_1 + form_2)
v = alpha * growth_1
w = alpha * growth_2
along = skew + 0.5 * (v * v - w * w)
across = form_12 + v * w
off = max(sqrt(along * along + across * across), 0.0000000001)
large = mean + 0.5 * (v * v + w * w) + off
turn = sqrt(0.5 + 0.5 * abs(along) / off)
beside = 0.5 * across / (off * turn)
cosine = choose(along >= 0.0, turn, abs(beside))
sine = choose(along >= 0.0, beside, choose(across >= 0.0, turn, -turn))
grown = cosine * growth_1 + sine * growth_2
ending = choose(grown < 0.0, -1.0, 1.0)
growth = abs(grown)
slope = ending * (cosine * slope_1 + sine * slope_2)
spread = sqrt(2.0 * off / large)
major = ending * (cosine * first.x + sine * second.x) | ending * (cosine * first.y + sine * second.y) | ending * (cosine * first.z + sine * second.z)
";

/// The square of the length of `major`, which for a lobe that is not round is not 1.
const REACH: &str = "
reach = cosine * cosine * longer * longer + sine * sine * shorter * shorter
";

/// The lookup by several fetches.
pub(super) fn lookup(wanted: &Wanted) -> Routine {
    let n = wanted.lookup.taps as usize;
    let kept: Vec<String> = (0..n).map(|i| format!("share_{i} * kept_{i}")).collect();
    let list = |name: &str| (0..n).map(|i| format!("{name}_{i}")).collect::<Vec<_>>().join(" | ");
    let weight = |i: usize| {
        format!("weight_{i} = share_{i} * (1.0 - ruled + kept_{i} / max(whole, {:?}))\n", LEAST as f32)
    };
    let body = [
        single::power(wanted),
        single::seen(wanted),
        axes(wanted),
        STRETCH.into(),
        if wanted.lookup.is_fitted() { REACH.into() } else { String::new() },
        rule::lines(&wanted.rule),
        RISING.into(),
        (0..n).map(|i| kept_share(wanted, i)).collect(),
        format!("whole = {}\nruled = min({:?} * whole, 1.0)\n", kept.join(" + "), (1.0 / LEAST) as f32),
        (0..n).map(|i| tap(wanted, i)).collect(),
        (0..n).map(weight).collect(),
        format!("give {} | {}", list("fetch"), list("weight")),
    ];
    Routine {
        name: wanted.name.clone(),
        header: wanted.header.clone(),
        arguments: single::arguments(wanted, true),
        result: Kind::Taps(n),
        body: single::of_lobe(wanted, &body.concat()),
    }
}

/// The half-axes of the lobe.
fn axes(wanted: &Wanted) -> String {
    let named = |first: &str, second: &str| ROUND.replace("FIRST", first).replace("SECOND", second);
    if wanted.lookup.is_fitted() {
        named("base_1", "base_2") + lobe::axes()
    } else {
        named("first", "second")
    }
}

/// 1 and the square of a tilt: that of the length of a ray tilted along `major`.
fn tilted(wanted: &Wanted, tilt: &str) -> String {
    let reach = if wanted.lookup.is_fitted() { " * reach" } else { "" };
    format!("1.0 + {tilt} * {tilt}{reach}")
}

/// The cosines of the ray and of the axis that fetches are tilted along with the surface's normal.
const RISING: &str = "
upward = ray.x * normal.x + ray.y * normal.y + ray.z * normal.z
rising = major.x * normal.x + major.y * normal.y + major.z * normal.z
";

/// What share of its weight a fetch keeps above the surface, as [`horizon`](crate::effects::parallax::taps::horizon) has it.
fn kept_share(wanted: &Wanted, i: usize) -> String {
    let steep = (1.0 / FADE) as f32;
    let square = tilted(wanted, &format!("tilt_{i}"));
    format!("kept_{i} = min(max({steep:?} * (upward + tilt_{i} * rising) / sqrt({square}), 0.0), 1.0)\n")
}

/// A fetch of the rule: its ray tilted along `major`, which is at right angles to the ray.
fn tap(wanted: &Wanted, i: usize) -> String {
    let fetch = single::name(wanted);
    let passed = single::passed(wanted, &format!("place, ray_{i}, alpha_{i}"));
    let square = tilted(wanted, &format!("bend_{i}"));
    format!(
        "bend_{i} = kept_{i} * tilt_{i}
        unit_{i} = 1.0 / sqrt({square})
        ray_{i} = (ray.x + bend_{i} * major.x) * unit_{i} | (ray.y + bend_{i} * major.y) * unit_{i} | (ray.z + bend_{i} * major.z) * unit_{i}
        alpha_{i} = alpha * (1.0 + kept_{i} * (own_{i} - 1.0))
        fetch_{i} :4 = {fetch}({passed})\n"
    )
}
