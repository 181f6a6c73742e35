//! The lobe of a surface that is fitted to GGX: the formulas of
//! [`Shading::Fitted`](crate::effects::parallax::Shading) in a shader's arithmetic.

use super::constant;
use crate::effects::parallax::LobeFit;
use crate::effects::parallax::lookups::{LEAST_COSINE, NARROWEST};

/// `ray`, the axis, and `width` by the constants of [`LobeFit`]. The powers of |mu| share its
/// logarithm; alpha is at least 1e-8 in its own, where the share of the normal is below 1e-10.
/// (1 - share) (2 mu n - v) + share n is a sum of n and v; its length is at least the root of 1/2,
/// as n and the mirror ray are at most at right angles: below the surface (mu < 0) the mirror ray
/// goes straight on, -v.
pub(super) const AXIS: &str = "
let mu = dot(normal, view);
let log_mu = log2(min(max(abs(mu), LEAST_COSINE), 1.0));
let blend = min(LEAN_0 * exp2(LEAN_1 * log2(max(alpha, 1e-8)) + LEAN_2 * log_mu), 1.0);
let rest = 1.0 - blend;
let lifted = blend + 2.0 * rest * max(mu, 0.0);
let axis = lifted * normal - rest * view;
let scaled = 1.0 / sqrt(dot(axis, axis));
let ray = axis * scaled;
let narrow = alpha * max(exp2((NARROW_0 - NARROW_1 * alpha) * log_mu) * (1.0 - NARROW_2 * alpha), NARROWEST);
let width = narrow / max(1.0 + alpha - narrow, narrow);
";

/// The half-axes of the lobe, `first` towards the normal and `second` across, by those of a round
/// one, `base_1` and `base_2`. Normal and view are on one side of the axis, and not both along it
/// but head on and from straight below (within a sine of 1e-6), where the lobe is round and so the
/// half-axes are any.
pub(super) const AXES: &str = "
let squashed = min((SQUASH_0 - SQUASH_1 * alpha) * log_mu, 0.0);
let longer = exp2(-0.5 * squashed);
let shorter = 1.0 / longer;
let aside = normal + view;
let inward_1 = dot(aside, base_1);
let inward_2 = dot(aside, base_2);
let inward = sqrt(inward_1 * inward_1 + inward_2 * inward_2);
let tiny = max(inward, 1e-6);
let part_1 = select(1.0, inward_1 / tiny, inward > 1e-6);
let part_2 = select(0.0, inward_2 / tiny, inward > 1e-6);
let first = longer * (part_1 * base_1 + part_2 * base_2);
let second = shorter * (part_1 * base_2 - part_2 * base_1);
";

/// The constants of the lobe for a number of fetches, as declarations.
pub(super) fn constants(taps: u32) -> String {
    let fit = LobeFit::of(taps);
    let rows = [("LEAN", &fit.lean[..]), ("NARROW", &fit.narrow), ("SQUASH", &fit.squash)];
    let declared = |(name, values): (&str, &[f64])| -> String {
        values.iter().enumerate().map(|(i, value)| constant(&format!("{name}_{i}"), *value)).collect()
    };
    let limits = constant("LEAST_COSINE", LEAST_COSINE) + &constant("NARROWEST", NARROWEST);
    limits + &rows.map(declared).concat()
}

/// What the lobe is.
pub(super) fn lines(taps: u32) -> Vec<String> {
    let fit = LobeFit::of(taps);
    let [[a, b, c], [d, e, f]] = [fit.lean, fit.narrow];
    let [g, h] = fit.squash;
    let signed = |x: f64| if x < 0.0 { format!("+ {}", -x) } else { format!("- {x}") };
    let mut lines = vec![
        "mu is |normal.view|, at least 0.02. Seen from below, normal.view < 0, the view counts as mirrored in the surface.".into(),
        "The lobe is that of GGX, within 1 % of the error of what study parallax fits for this many fetches at roughness".into(),
        "0.15 to 0.9 and mu from 0 to 1; as alpha goes to 0 it is the mirror ray:".into(),
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
