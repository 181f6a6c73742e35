//! Cuts of an interval into panels, graded geometrically towards an end where the integrand varies
//! on a small scale.

/// Ratio of neighbouring graded panels. On a panel [x, 3x] an integrand that is singular at 0 has
/// its Bernstein ellipse at (3+1)/(3-1) = 2, so n Gauss nodes leave an error of (2 + sqrt 3)^-2n:
/// 2e-14 for n = 12.
const RATIO: f64 = 3.0;

/// Appends the cuts of [from, to] to `cuts`, `to` last and `from` left out (it is the cut that came
/// before). No panel is longer than `longest`; panels shrink geometrically towards `to`, down to
/// `scale`.
///
/// # Panics
/// If `scale` is not positive: the grading would not end.
pub fn towards_end(cuts: &mut Vec<f64>, from: f64, to: f64, longest: f64, scale: f64) {
    assert!(scale > 0.0, "a grading scale of {scale}");
    let length = to - from;
    let mut distances = Vec::new();
    let mut distance = scale;
    while distance < length && distance * (RATIO - 1.0) <= longest {
        distances.push(distance);
        distance *= RATIO;
    }
    let graded = distances.last().copied().unwrap_or(0.0).min(length);
    let plain = ((length - graded) / longest).ceil().max(1.0) as usize;
    for i in 1..=plain {
        if i < plain || graded > 0.0 {
            cuts.push(from + (length - graded) * i as f64 / plain as f64);
        }
    }
    for d in distances.iter().rev().skip(1) {
        cuts.push(to - d);
    }
    cuts.push(to);
}

/// Appends the cuts of [from, to], graded towards both ends, `from` left out.
pub fn towards_both(cuts: &mut Vec<f64>, from: f64, to: f64, longest: f64, scales: [f64; 2]) {
    let middle = 0.5 * (from + to);
    let mut mirrored = vec![-middle];
    towards_end(&mut mirrored, -middle, -from, longest, scales[0]);
    cuts.extend(mirrored.iter().rev().skip(1).map(|x| -x));
    towards_end(cuts, middle, to, longest, scales[1]);
}

/// The cuts of [0, to], graded towards 0 down to `scale`, both ends included.
///
/// # Panics
/// If `scale` is not positive.
pub fn from_zero(to: f64, scale: f64) -> Vec<f64> {
    assert!(scale > 0.0, "a grading scale of {scale}");
    let mut cuts = vec![0.0];
    let mut x = scale;
    while x * 1.5 < to {
        cuts.push(x);
        x *= RATIO;
    }
    cuts.push(to);
    cuts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_ascend_cover_and_respect_the_limits() {
        for (from, to, longest, scale) in
            [(-1.0, 4.0, 2.0, 1e-4), (0.0, 0.5, 2.0, 1e-6), (0.0, 1.0, 2.0, 10.0), (-9.0, 9.0, 2.5, 0.3)]
        {
            let mut cuts = vec![from];
            towards_end(&mut cuts, from, to, longest, scale);
            assert_eq!(*cuts.last().expect("an end"), to);
            for pair in cuts.windows(2) {
                let length = pair[1] - pair[0];
                assert!(length > 0.0 && length <= longest * 1.5 + 1e-12, "{pair:?} of {cuts:?}");
            }
            let last = to - cuts[cuts.len() - 2];
            assert!(last <= scale * 1.0001 || last <= longest, "{cuts:?}");
        }
    }

    #[test]
    fn zero_graded_cuts_reach_the_scale() {
        let cuts = from_zero(1.0, 1e-4);
        assert_eq!((cuts[0], cuts[1], *cuts.last().expect("an end")), (0.0, 1e-4, 1.0));
        assert!(cuts.windows(2).all(|p| p[1] > p[0]), "{cuts:?}");
    }
}
