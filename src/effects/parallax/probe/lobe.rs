//! The lobe of a surface that is fitted to GGX, as a script: the formulas of [`Shading::Fitted`](crate::effects::parallax::Shading) in f32.

use crate::effects::parallax::LobeFit;
use crate::effects::parallax::lookups::{LEAST_COSINE, NARROWEST};

/// `ray`, the axis, and `width` by the constants of [`LobeFit`]. The powers of |mu| share its logarithm; alpha is at least 1e-8 in its
/// own, where the share of the normal is below 1e-10. (1 - share) (2 mu n - v) + share n is a sum of n and v; its length is at least the root of 1/2,
/// as n and the mirror ray are at most at right angles: below the surface (mu < 0) that ray goes straight on, -v.
const AXIS: &str = "
mu = normal.x * view.x + normal.y * view.y + normal.z * view.z
log_mu = log2(min(max(abs(mu), LEAST), 1.0))
blend = min(A * exp2(B * log2(max(alpha, 0.00000001)) + C * log_mu), 1.0)
rest = 1.0 - blend
lifted = blend + 2.0 * rest * max(mu, 0.0)
axis = lifted * normal.x - rest * view.x | lifted * normal.y - rest * view.y | lifted * normal.z - rest * view.z
scaled = 1.0 / sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z)
ray = axis.x * scaled | axis.y * scaled | axis.z * scaled
narrow = alpha * max(exp2((D - E * alpha) * log_mu) * (1.0 - F * alpha), NARROWEST)
width = narrow / max(1.0 + alpha - narrow, narrow)
";

/// The half-axes of the lobe, `first` towards the normal and `second` across, by those of a round one, `base_1` and `base_2`. Normal and
/// view are on one side of the axis, and not both along it but head on and from straight below (within a sine of 1e-6), where the lobe is round and so
/// the half-axes are any.
const AXES: &str = "
squashed = min((G - H * SURFACE) * log_mu, 0.0)
longer = exp2(-0.5 * squashed)
shorter = 1.0 / longer
aside = normal.x + view.x | normal.y + view.y | normal.z + view.z
inward_1 = aside.x * base_1.x + aside.y * base_1.y + aside.z * base_1.z
inward_2 = aside.x * base_2.x + aside.y * base_2.y + aside.z * base_2.z
inward = sqrt(inward_1 * inward_1 + inward_2 * inward_2)
tiny = max(inward, 0.000001)
part_1 = choose(inward > 0.000001, inward_1 / tiny, 1.0)
part_2 = choose(inward > 0.000001, inward_2 / tiny, 0.0)
first = longer * (part_1 * base_1.x + part_2 * base_2.x) | longer * (part_1 * base_1.y + part_2 * base_2.y) | longer * (part_1 * base_1.z + part_2 * base_2.z)
second = shorter * (part_1 * base_2.x - part_2 * base_1.x) | shorter * (part_1 * base_2.y - part_2 * base_1.y) | shorter * (part_1 * base_2.z - part_2 * base_1.z)
";

/// The lines that name, by `normal`, `view` and `alpha`, the axis and the width of the lobe for a number of fetches, and after them a script of
/// a lobe of that `ray` and width, by the name `alpha`. Inside the script SURFACE is the alpha of the surface.
pub(super) fn of_this(taps: u32, script: &str) -> String {
    let narrowed = replaced(script, |word| (word == "alpha").then(|| "width".to_string()));
    with_constants(&(AXIS.to_string() + &narrowed), &LobeFit::of(taps))
}

/// The lines that name its half-axes, after those of a round lobe about it, inside such a script.
pub(super) fn axes() -> &'static str {
    AXES
}

/// Constants in the place of their names.
fn with_constants(script: &str, fit: &LobeFit) -> String {
    let constants = [&fit.lean[..], &fit.narrow, &fit.squash].concat();
    let text = replaced(script, |word| match word {
        "LEAST" => Some(format!("{:?}", LEAST_COSINE as f32)),
        "NARROWEST" => Some(format!("{:?}", NARROWEST as f32)),
        "SURFACE" => Some("alpha".into()),
        _ => {
            let place = ["A", "B", "C", "D", "E", "F", "G", "H"].iter().position(|name| *name == word)?;
            constants.get(place).map(|value| format!("{:?}", *value as f32))
        }
    });
    text.replace("- -", "+ ").replace("+ -", "- ")
}

/// A text with some of its words replaced.
fn replaced(text: &str, word: impl Fn(&str) -> Option<String>) -> String {
    let within = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let part = |part: &str| {
        let name = part.trim_end_matches(|c| !within(c));
        word(name).map_or_else(|| part.to_string(), |new| new + &part[name.len()..])
    };
    text.split_inclusive(|c| !within(c)).map(part).collect()
}

/// What the arguments are, and what the lobe is.
pub(super) fn lines(taps: u32) -> Vec<String> {
    let fit = LobeFit::of(taps);
    let [[a, b, c], [d, e, f]] = [fit.lean, fit.narrow];
    let [g, h] = fit.squash;
    let signed = |x: f64| if x < 0.0 { format!("+ {}", -x) } else { format!("- {x}") };
    let mut lines = vec![
        "normal and view, towards the viewer, are of unit length; mu is |normal.view|, at least 0.02. Seen from below,".into(),
        "normal.view < 0, the view counts as mirrored in the surface. The lobe is that of GGX, within 1 % of the error of".into(),
        "what study parallax fits for this many fetches at roughness 0.15 to 0.9 and mu from 0 to 1; as alpha goes to 0".into(),
        "it is the mirror ray:".into(),
        format!("  its axis has a share min({a} alpha^{b} mu^{c}, 1) of the normal, the rest of the mirror ray;"),
        format!("  its footprint is max(mu^({d} {} alpha) (1 {} alpha), {NARROWEST}) times as wide as a round one's.", signed(e), signed(f)),
    ];
    if taps > 1 {
        lines.push(format!(
            "  It is min(mu^({g} {} alpha), 1) times as wide across the plane of incidence as along it.",
            signed(h)
        ));
    }
    lines
}

/// What radiance is expected to be off by.
pub(super) fn expected(taps: u32) -> Vec<String> {
    let [ours, mirror] = LobeFit::expected(taps);
    vec![
        "Expected error against GGX over its albedo (relative L2, geometric mean over roughness 0.15 to 0.9 in the room of".into(),
        format!("  the fit, with smooth edges of a box, fetches integrated): {ours}; for the round lobe about the mirror ray {mirror}."),
    ]
}
