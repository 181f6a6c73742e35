//! Points that aim at trouble: crowded within twelve decades of either end of a range, on the ends and
//! beside them by an ulp, below the least normal number, equal to another input or beside it, and at the
//! critical angle from both sides.

use lobefit_math::ops;
use lobefit_promises::Range;
use rand::RngExt;
use rand_pcg::Pcg64;

/// Decades towards an end.
const DECADES: f64 = 12.0;

/// Values of all inputs.
pub fn draw(random: &mut Pcg64, inputs: &[Range]) -> Vec<f64> {
    let mut x: Vec<f64> = inputs.iter().map(|range| one(random, range)).collect();
    if random.random_range(0..4) == 0 {
        critical(random, inputs, &mut x);
    }
    // One input beside another, as mu beside alpha: an ulp above, an ulp below or the same.
    if x.len() > 1 && random.random_range(0..4) == 0 {
        let (from, to) = (random.random_range(0..x.len()), random.random_range(0..x.len()));
        x[to] = beside(random, x[from]);
    }
    x.iter().zip(inputs).map(|(x, Range(_, low, high))| x.clamp(*low, *high)).collect()
}

/// Moves a cosine next to that of the critical angle, within some ulp or some decades.
fn critical(random: &mut Pcg64, inputs: &[Range], x: &mut [f64]) {
    let named = |names: &[&str]| inputs.iter().position(|Range(name, ..)| names.contains(&name.as_str()));
    let (Some(index), Some(cosine)) = (named(&["ior", "eta"]), named(&["mu", "cosine"])) else { return };
    let [inside, outside] = [x[index].max(1.0 / x[index]), x[index].min(1.0 / x[index])];
    let at = (outside * (inside - outside)).sqrt();
    x[cosine] = match random.random_range(0..3) {
        0 => beside(random, at),
        side => {
            let near = ops::pow(10.0, -DECADES * random.random::<f64>());
            at + near * if side == 1 { 1.0 - at } else { -at }
        }
    };
}

fn one(random: &mut Pcg64, Range(_, low, high): &Range) -> f64 {
    let span = high - low;
    let near = ops::pow(10.0, -DECADES * random.random::<f64>());
    match random.random_range(0..8) {
        0 | 1 => low + span * random.random::<f64>(),
        2 | 3 => low + span * near,
        4 => high - span * near,
        5 if *low > 0.0 => low * ops::pow(high / low, random.random()),
        5 => {
            let end = if random.random() { *low } else { *high };
            beside(random, end)
        }
        6 if *low == 0.0 => match random.random_range(0..3) {
            0 => -0.0,
            1 => f64::from_bits(random.random_range(1..1 << 52)),
            _ => f64::MIN_POSITIVE,
        },
        6 => *low,
        _ => *high,
    }
}

fn beside(random: &mut Pcg64, x: f64) -> f64 {
    match random.random_range(0..3) {
        0 => x.next_down(),
        1 => x.next_up(),
        _ => x,
    }
}
