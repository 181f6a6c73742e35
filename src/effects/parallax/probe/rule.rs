//! The rule of several fetches, as a script: the formulas of [`TapRule`] in f32, with its constants.

use crate::effects::parallax::TapRule;
use crate::effects::parallax::taps::expected::{EXPECTED_UP_TO, Expected};

/// Where the fetches lie and how wide they are, by z = `spread`, y = `skewed` and alpha; the constants by their names in [`TWO_NAMES`].
const TWO: &str = "
skewed = (1.0 + A * alpha) * alpha * growth / max(spread + alpha, 0.000000000001)
apart = spread * (C0 + C1 * spread) / (1.0 + C2 * alpha)
wide = 1.0 + spread * (E0 + E1 * spread + E2 * alpha)
leaning = skewed * (W0 + W1 * spread)
lean = 0.5 * leaning / sqrt(max(spread * spread + leaning * leaning, 0.00000000000000000001))
raw_0 = -apart * alpha
raw_1 = apart * alpha
own_0 = max(wide + skewed * (N0 + N1 * spread), 0.1)
own_1 = max(wide + skewed * (F0 + F1 * spread), 0.1)
share_0 = 0.5 + lean
share_1 = 0.5 - lean
";

const TWO_NAMES: [&str; 13] = ["A", "C0", "C1", "C2", "E0", "E1", "E2", "N0", "N1", "F0", "F1", "W0", "W1"];

const THREE: &str = "
skewed = (1.0 + A * alpha) * alpha * growth / max(spread + alpha, 0.000000000001)
over = skewed / max(spread, 0.000001)
bent = min(max(over * (B0 + B1 * spread), 0.0), 1.5)
root = sqrt(1.0 + bent * bent)
apart = (C0 + C1 * spread) / (1.0 + C2 * alpha) * alpha
wide = E0 + E1 * spread + alpha * (E2 + E3 * spread)
leaning = min(max(over * (W0 + W1 * spread), -1.5), 1.5)
lean = sqrt(1.0 + leaning * leaning)
outer = spread * spread * (H0 * spread + H1 * alpha)
share_1 = 1.0 / (1.0 + 2.0 * outer * lean)
raw_0 = -apart * (root - bent)
raw_1 = skewed * (D0 + D1 * spread) * alpha
raw_2 = apart * (root + bent)
own_0 = max(wide + skewed * (N0 + N1 * spread), 0.1)
own_1 = max(1.0 + spread * (G0 + G1 * spread + G2 * alpha), 0.1)
own_2 = max(wide + skewed * (F0 + F1 * spread), 0.1)
share_0 = outer * (lean + leaning) * share_1
share_2 = outer * (lean - leaning) * share_1
";

const THREE_NAMES: [&str; 23] = [
    "A", "B0", "B1", "C0", "C1", "C2", "D0", "D1", "E0", "E1", "E2", "E3", "N0", "N1", "F0", "F1", "G0",
    "G1", "G2", "W0", "W1", "H0", "H1",
];

/// The lines that name, by `spread`, `growth`, `slope` and `alpha`, what the rule says of every fetch: the tangent `tilt_i`, the width over
/// that of the lobe `own_i`, the share `share_i`.
pub(super) fn lines(rule: &TapRule) -> String {
    let (script, names) = match rule.count() {
        2 => (TWO, &TWO_NAMES[..]),
        _ => (THREE, &THREE_NAMES[..]),
    };
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut lines = String::new();
    for (i, part) in script.split_inclusive(|c| !word(c)).enumerate() {
        let name = part.trim_end_matches(|c| !word(c));
        let constant = names.iter().position(|known| *known == name).and_then(|k| rule.constants().get(k));
        match constant {
            // a sum of a negative constant is a difference
            Some(value) if *value < 0.0 && i > 0 && lines.ends_with("+ ") => {
                lines.truncate(lines.len() - 2);
                lines += &format!("- {:?}{}", -*value as f32, &part[name.len()..]);
            }
            Some(value) => lines += &format!("{:?}{}", *value as f32, &part[name.len()..]),
            None => lines += part,
        }
    }
    let bent = |i: usize| format!("tilt_{i} = raw_{i} / (1.0 + max(raw_{i} * slope, 0.0))\n");
    lines + &(0..rule.count()).map(bent).collect::<String>()
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
