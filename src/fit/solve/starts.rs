//! Starting points: the declared one, and low-discrepancy points around it.

/// `count` starting points. The first is `declared`; the others fill the box of half widths
/// `spread * max(|declared|, 1)` around it, by the additive recurrence of the generalised golden ratio g, the root of
/// g^(n+1) = g + 1 (Roberts 2018), which needs no table and no seed.
pub(super) fn starts(declared: &[f64], count: usize, spread: f64) -> Vec<Vec<f64>> {
    let n = declared.len();
    let mut golden = 1.5_f64;
    for _ in 0..64 {
        // g = (1 + g)^(1/(n+1)), a contraction
        golden = crate::math::ops::pow(1.0 + golden, 1.0 / (n as f64 + 1.0));
    }
    let mut strides = Vec::with_capacity(n);
    let mut stride = 1.0;
    for _ in 0..n {
        stride /= golden;
        strides.push(stride);
    }
    let point = |index: usize| -> Vec<f64> {
        let around = declared.iter().zip(&strides).map(|(x, stride)| {
            let u = 0.5 + index as f64 * stride;
            x + (2.0 * (u - u.floor()) - 1.0) * spread * x.abs().max(1.0)
        });
        around.collect()
    };
    std::iter::once(declared.to_vec()).chain((1..count.max(1)).map(point)).collect()
}
