//! Where a ray meets a proxy, as scripts: the formulas of [`crate::effects::parallax::room::proxies`], in f32.

use super::script::{Kind, Routine};
use crate::data::ProbeLookup;
use crate::effects::parallax::room::proxies::Tie;

/// [`NEAREST`](crate::effects::parallax::room::proxies::NEAREST) as scripts write it.
pub(super) const NEAREST: &str = "0.0001";

/// Least share of the nearest plane's inverse distance that counts: pow(0, p) is undefined in some languages, and a smaller one is that of a
/// ray along the plane.
const LEAST_SHARE: &str = "0.00000001";

/// The name of the function of a proxy.
pub(super) fn name(lookup: ProbeLookup) -> String {
    format!("parallax_meet_{}_{}", lookup.shape(), lookup.edges())
}

/// The arguments that describe a proxy.
pub(super) fn body(lookup: ProbeLookup) -> Vec<(&'static str, Kind)> {
    let place = Kind::Numbers(3);
    match lookup.planes {
        None => vec![("low", place), ("high", place), ("probe", place)],
        Some(n) => vec![("planes", Kind::Planes(n)), ("probe", place)],
    }
}

/// The function of a proxy: unit normal, then the distance along the ray.
pub(super) fn routine(lookup: ProbeLookup) -> Routine {
    let power = lookup.smooth.then_some(("bend", Kind::Numbers(1)));
    let start = [("place", Kind::Numbers(3)), ("ray", Kind::Numbers(3))];
    let arguments = start.into_iter().chain(power).chain(body(lookup)).collect();
    let script = match (lookup.planes, lookup.smooth) {
        (None, smooth) => of_box(smooth),
        (Some(_), true) => powered(SMOOTH_PLANES).replace("NEAREST", NEAREST).replace("LEAST", LEAST_SHARE),
        (Some(_), false) => SHARP_PLANES.replace("NEAREST", NEAREST),
    };
    Routine { name: name(lookup), header: header(lookup), arguments, result: Kind::Numbers(4), body: script }
}

fn header(lookup: ProbeLookup) -> Vec<String> {
    let shape = match lookup.planes {
        None => {
            "a box between the corners low and high, which are along the axes; probe is inside.".to_string()
        }
        Some(n) => format!(
            "{n} planes about the probe: xyz the outward unit normal, w > 0 the distance from the probe."
        ),
    };
    let mut lines = vec![
        "Where a ray of unit length from a place meets the proxy of a room: its unit normal (xyz) and the distance (w).".into(),
        format!("The proxy is {shape}"),
    ];
    if lookup.planes.is_some() {
        lines.push("Fill up with (0, 0, 0, 1).".into());
    }
    if lookup.smooth {
        lines.push("Edges are smooth: t = (sum t_i^-p)^(-1/p) over the planes ahead, with that body's normal; p = 1/(bend s) within".into());
        lines.push(format!(
            "[{}, {}], s twice the standard deviation of n_i/max(n_i.ray, {}) with weights t_i^-4.",
            Tie::LEAST,
            Tie::MOST,
            Tie::GRAZING
        ));
    }
    lines.push(format!(
        "A plane ahead that the place is on or outside of counts as {NEAREST} of the probe's distance to it away."
    ));
    lines
}

/// Nearness is 1 over a plane's distance from the place, with the normal's sign; its product with the ray is 1 over the distance along it.
fn of_box(smooth: bool) -> String {
    let mut script = String::new();
    for k in ["x", "y", "z"] {
        script += &format!(
            "ahead_{k} = choose(ray.{k} > 0.0, high.{k} - place.{k}, low.{k} - place.{k})
            least_{k} = choose(ray.{k} > 0.0, high.{k} - probe.{k}, low.{k} - probe.{k})
            side_{k} = choose(ray.{k} > 0.0, 1.0, -1.0)
            nearness_{k} = side_{k} / max(side_{k} * ahead_{k}, {NEAREST} * side_{k} * least_{k})
            along_{k} = nearness_{k} * ray.{k}\n"
        );
    }
    script += "steepest = max(max(along_x, along_y), along_z)\n";
    script + &if smooth { powered(SMOOTH_BOX).replace("LEAST", LEAST_SHARE) } else { SHARP_BOX.into() }
}

/// A script with the power of the blend by the sums of [`crate::effects::parallax::room::proxies::Tied`] over the planes.
fn powered(script: &str) -> String {
    let [least, most] = [1.0 / Tie::MOST, 1.0 / Tie::LEAST].map(|x| format!("{:?}", x as f32));
    script.replace("GRAZING", &format!("{:?}", Tie::GRAZING as f32)).replace(
        "POWER",
        &format!(
            "variance = second / whole - (first.x * first.x + first.y * first.y + first.z * first.z) / (whole * whole)
            power = 1.0 / min(max(2.0 * bend * sqrt(max(variance, 0.0)), {least}), {most})"
        ),
    )
}

const SMOOTH_BOX: &str = "
scale = 1.0 / steepest
square_x = along_x * scale * along_x * scale
square_y = along_y * scale * along_y * scale
square_z = along_z * scale * along_z * scale
steep_x = square_x * square_x / max(side_x * ray.x, GRAZING)
steep_y = square_y * square_y / max(side_y * ray.y, GRAZING)
steep_z = square_z * square_z / max(side_z * ray.z, GRAZING)
whole = square_x * square_x + square_y * square_y + square_z * square_z
first = steep_x | steep_y | steep_z
second = steep_x / max(side_x * ray.x, GRAZING) + steep_y / max(side_y * ray.y, GRAZING) + steep_z / max(side_z * ray.z, GRAZING)
POWER
weight_x = choose(along_x * scale > LEAST, pow(max(along_x * scale, LEAST), power - 1.0), 0.0)
weight_y = choose(along_y * scale > LEAST, pow(max(along_y * scale, LEAST), power - 1.0), 0.0)
weight_z = choose(along_z * scale > LEAST, pow(max(along_z * scale, LEAST), power - 1.0), 0.0)
sum = (weight_x * along_x + weight_y * along_y + weight_z * along_z) * scale
normal = weight_x * nearness_x * scale | weight_y * nearness_y * scale | weight_z * nearness_z * scale
unit = 1.0 / sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z)
give normal.x * unit | normal.y * unit | normal.z * unit | scale / pow(sum, 1.0 / power)";

const SHARP_BOX: &str = "
is_x = choose(along_x >= max(along_y, along_z), 1.0, 0.0)
is_y = choose(along_y >= along_z, 1.0 - is_x, 0.0)
give side_x * is_x | side_y * is_y | side_z * (1.0 - is_x - is_y) | 1.0 / steepest";

const SMOOTH_PLANES: &str = "
offset = place.x - probe.x | place.y - probe.y | place.z - probe.z
var steepest = 0.0
each
    depth = max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    set steepest = max(steepest, (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) / depth)
end
scale = 1.0 / steepest
var whole = 0.0
var second = 0.0
var first_x = 0.0
var first_y = 0.0
var first_z = 0.0
each
    approach = plane.x * ray.x + plane.y * ray.y + plane.z * ray.z
    portion = max(approach, 0.0) * scale / max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    square = portion * portion
    over = 1.0 / max(approach, GRAZING)
    set whole = whole + square * square
    set second = second + square * square * over * over
    set first_x = first_x + square * square * over * plane.x
    set first_y = first_y + square * square * over * plane.y
    set first_z = first_z + square * square * over * plane.z
end
first = first_x | first_y | first_z
POWER
var sum = 0.0
var normal_x = 0.0
var normal_y = 0.0
var normal_z = 0.0
each
    nearness = scale / max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    share = (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) * nearness
    weight = choose(share > LEAST, pow(max(share, LEAST), power - 1.0), 0.0)
    set sum = sum + weight * share
    set normal_x = normal_x + weight * nearness * plane.x
    set normal_y = normal_y + weight * nearness * plane.y
    set normal_z = normal_z + weight * nearness * plane.z
end
unit = 1.0 / sqrt(normal_x * normal_x + normal_y * normal_y + normal_z * normal_z)
give normal_x * unit | normal_y * unit | normal_z * unit | scale / pow(sum, 1.0 / power)";

const SHARP_PLANES: &str = "
offset = place.x - probe.x | place.y - probe.y | place.z - probe.z
var steepest = 0.0
var normal_x = 0.0
var normal_y = 0.0
var normal_z = 0.0
each
    depth = max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    along = (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) / depth
    set normal_x = choose(along > steepest, plane.x, normal_x)
    set normal_y = choose(along > steepest, plane.y, normal_y)
    set normal_z = choose(along > steepest, plane.z, normal_z)
    set steepest = max(steepest, along)
end
give normal_x | normal_y | normal_z | 1.0 / steepest";
