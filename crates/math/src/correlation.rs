//! Whether two costs put functions in the same order.

/// Correlation of pairs of costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Of the values (Pearson).
    pub values: f64,
    /// Of the ranks (Spearman); equal values share the mean of their ranks.
    pub ranks: f64,
    /// Pairs.
    pub count: usize,
}

impl Correlation {
    /// Of pairs; none of fewer than three, or where one side is constant.
    pub fn of(pairs: &[(f64, f64)]) -> Option<Correlation> {
        let (first, second): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
        let values = pearson(&first, &second)?;
        Some(Correlation { values, ranks: pearson(&ranks(&first), &ranks(&second))?, count: pairs.len() })
    }
}

fn pearson(first: &[f64], second: &[f64]) -> Option<f64> {
    if first.len() < 3 {
        return None;
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (a, b) = (mean(first), mean(second));
    let products = |x: &[f64], y: &[f64], [a, b]: [f64; 2]| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - a) * (y - b)).sum()
    };
    let scale = (products(first, first, [a, a]) * products(second, second, [b, b])).sqrt();
    (scale > 0.0).then(|| products(first, second, [a, b]) / scale)
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |x: &f64| {
        let below = values.iter().filter(|y| *y < x).count();
        let equal = values.iter().filter(|y| *y == x).count();
        below as f64 + 0.5 * (equal as f64 - 1.0)
    };
    values.iter().map(rank).collect()
}
