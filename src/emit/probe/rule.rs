//! The rule of several fetches, as a script: [`crate::effects::parallax::TapRule`] in f32, by its own table.

use crate::effects::parallax::taps::rule::{CENTRE, Columns, STRETCHES, THREE, TWO};
use crate::math::ops;

/// The lines that name, by `kappa`, `growth` and `alpha`, what the rule says of every fetch: the tangent `tilt_i`, the width over that of the
/// lobe `own_i`, the share `share_i`.
pub(super) fn lines(taps: usize) -> String {
    let mut lines = steps();
    let columns: &Columns = if taps == 2 { &TWO } else { &THREE };
    for (name, column) in ["tilt_near", "own_near", "tilt_far", "own_far"].iter().zip(columns) {
        lines += &interpolated(name, column);
    }
    lines += "lean = min(growth / sqrt(max(kappa * kappa - 1.0, 0.0000000001)), 1.0)
        apart = 0.5 * (tilt_far - tilt_near)
        shift = 0.5 * lean * (tilt_far + tilt_near)
        wide = 0.5 * (own_far + own_near)
        more = 0.5 * lean * (own_far - own_near)\n";
    let last = taps - 1;
    lines += &format!(
        "tilt_0 = (shift - apart) * alpha\nown_0 = wide - more\ntilt_{last} = (shift + apart) * alpha\nown_{last} = wide + more\n"
    );
    if taps == 3 {
        lines += &format!("tilt_1 = 0.0\n{}", interpolated("own_1", &CENTRE));
    }
    lines + &(0..taps).map(|i| format!("share_{i} = {:?}\n", 1.0 / taps as f32)).collect::<String>()
}

/// How far ln kappa is through each step between the table's columns, in [0, 1].
fn steps() -> String {
    let log2 = |x: f64| ops::log(x) / std::f64::consts::LN_2;
    let step = |(i, pair): (usize, &[f64])| {
        let [from, to] = [log2(pair[0]), log2(pair[1])];
        let [from, scale] = [from as f32, (1.0 / (to - from)) as f32];
        format!("step_{i} = min(max((stretched - {from:?}) * {scale:?}, 0.0), 1.0)\n")
    };
    "stretched = log2(kappa)\n".to_string() + &STRETCHES.windows(2).enumerate().map(step).collect::<String>()
}

/// A column between its values.
fn interpolated(name: &str, column: &[f64; 6]) -> String {
    let terms = column.windows(2).enumerate().map(|(i, pair)| {
        let rise = (pair[1] - pair[0]) as f32;
        format!(" {} {:?} * step_{i}", if rise < 0.0 { "-" } else { "+" }, rise.abs())
    });
    format!("{name} = {:?}{}\n", column[0] as f32, terms.collect::<String>())
}
