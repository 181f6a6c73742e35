//! Sums whose value does not depend on who computed which part.

/// Pairwise sum in a fixed tree over blocks of 128: rounding error grows with the logarithm of the
/// length.
pub fn pairwise(x: &[f64]) -> f64 {
    if x.len() <= 128 {
        return x.iter().sum();
    }
    let (left, right) = x.split_at(x.len() / 2);
    pairwise(left) + pairwise(right)
}

/// Mean by [`pairwise`]; NaN of nothing.
pub fn mean(x: &[f64]) -> f64 {
    pairwise(x) / x.len() as f64
}

/// Standard error of the mean of independent values: sqrt(sum (x - mean)^2 / (n (n-1))); NaN below
/// two values.
pub fn standard_error(x: &[f64]) -> f64 {
    let (n, centre) = (x.len() as f64, mean(x));
    let squares: Vec<f64> = x.iter().map(|v| (v - centre) * (v - centre)).collect();
    (pairwise(&squares) / (n * (n - 1.0))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairwise_keeps_what_a_running_sum_loses() {
        let values = vec![0.1; 1 << 20];
        let exact = 0.1 * f64::from(1 << 20);
        assert!((pairwise(&values) - exact).abs() < 1e-10 * exact);
        let running: f32 = std::iter::repeat_n(0.1_f32, 1 << 23).fold(0.0, |a, b| a + b);
        assert!((f64::from(running) / (0.1 * f64::from(1 << 23)) - 1.0).abs() > 1e-2, "the trap is real");
    }

    #[test]
    fn standard_error_of_known_values() {
        let se = standard_error(&[1.0, 2.0, 3.0, 4.0]);
        assert!((se - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
    }
}
