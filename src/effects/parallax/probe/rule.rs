//! The rule of several fetches: the formulas of [`TapRule`] in a shader's arithmetic.

use super::constant;
use crate::effects::parallax::TapRule;
use crate::effects::parallax::taps::expected::{EXPECTED_UP_TO, Expected};

/// Where the fetches lie and how wide they are, by z = `spread`, y = `skewed` and the lobe's
/// `width`; the constants by their names in [`TWO_NAMES`].
const TWO: &str = "
let skewed = (1.0 + A * width) * width * growth / max(spread + width, 1e-12);
let apart = spread * (C0 + C1 * spread) / (1.0 + C2 * width);
let wide = 1.0 + spread * (E0 + E1 * spread + E2 * width);
let leaning = skewed * (W0 + W1 * spread);
let lean = 0.5 * leaning / sqrt(max(spread * spread + leaning * leaning, 1e-20));
let raw_0 = -apart * width;
let raw_1 = apart * width;
let own_0 = max(wide + skewed * (N0 + N1 * spread), 0.1);
let own_1 = max(wide + skewed * (F0 + F1 * spread), 0.1);
let share_0 = 0.5 + lean;
let share_1 = 0.5 - lean;
";

const TWO_NAMES: [&str; 13] = ["A", "C0", "C1", "C2", "E0", "E1", "E2", "N0", "N1", "F0", "F1", "W0", "W1"];

const THREE: &str = "
let skewed = (1.0 + A * width) * width * growth / max(spread + width, 1e-12);
let over = skewed / max(spread, 1e-6);
let bent = min(max(over * (B0 + B1 * spread), 0.0), 1.5);
let root = sqrt(1.0 + bent * bent);
let apart = (C0 + C1 * spread) / (1.0 + C2 * width) * width;
let wide = E0 + E1 * spread + width * (E2 + E3 * spread);
let leaning = min(max(over * (W0 + W1 * spread), -1.5), 1.5);
let lean = sqrt(1.0 + leaning * leaning);
let outer = spread * spread * (H0 * spread + H1 * width);
let share_1 = 1.0 / (1.0 + 2.0 * outer * lean);
let raw_0 = -apart * (root - bent);
let raw_1 = skewed * (D0 + D1 * spread) * width;
let raw_2 = apart * (root + bent);
let own_0 = max(wide + skewed * (N0 + N1 * spread), 0.1);
let own_1 = max(1.0 + spread * (G0 + G1 * spread + G2 * width), 0.1);
let own_2 = max(wide + skewed * (F0 + F1 * spread), 0.1);
let share_0 = outer * (lean + leaning) * share_1;
let share_2 = outer * (lean - leaning) * share_1;
";

const THREE_NAMES: [&str; 23] = [
    "A", "B0", "B1", "C0", "C1", "C2", "D0", "D1", "E0", "E1", "E2", "E3", "N0", "N1", "F0", "F1", "G0",
    "G1", "G2", "W0", "W1", "H0", "H1",
];

/// The constants of a rule, as declarations.
pub(super) fn constants(rule: &TapRule) -> String {
    let named = names(rule).iter().zip(rule.constants());
    named.map(|(name, value)| constant(name, *value)).collect()
}

fn names(rule: &TapRule) -> &'static [&'static str] {
    match rule.count() {
        2 => &TWO_NAMES,
        _ => &THREE_NAMES,
    }
}

/// The statements that name, by `spread`, `growth`, `slope` and `width`, what the rule says of
/// every fetch: the tangent `tilt_i`, the width over that of the lobe `own_i`, the share `share_i`.
pub(super) fn statements(rule: &TapRule) -> String {
    let formulas = if rule.count() == 2 { TWO } else { THREE };
    let bent = |i: usize| format!("let tilt_{i} = raw_{i} / (1.0 + max(raw_{i} * slope, 0.0));\n");
    formulas.to_string() + &(0..rule.count()).map(bent).collect::<String>()
}

/// What the fetches are expected to be off by on one plane.
pub(super) fn expected(rule: &TapRule) -> Vec<String> {
    let Expected { constants: [p, s, q, r], off: [narrow, wide] } = rule.expectation();
    let [low, high] = EXPECTED_UP_TO;
    vec![
        format!("Expected total variation from the lobe's footprint on one plane, the root mean square error {narrow} for alpha"),
        format!("up to {low}, {wide} up to {high}: the root of ({p} l/(1 + {s} l))^2 + ({q} g/(1 + {r} g))^2,"),
        "  l the logarithm of the footprint's length over its width, g what the ratio of distances grows by over the".into(),
        "  width of the lobe; lobes that reach over an edge are off by more.".into(),
    ]
}
