//! Gauss rules on [0, 1], plain and graded towards the ends.

use lobefit_math::gauss::Gauss;

/// Most nodes of a rule.
pub(super) const MOST: usize = 96;

/// How fast nodes gather at the two ends of a piece: the variable is u = beta(z) with beta' ~
/// z^(p-1) (1-z)^(q-1), so that an integrand in powers of (distance to the end)^(1/p) is analytic
/// in z; beta is about linear away from the ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grade {
    /// p = q = 1.
    Plain,
    /// p = 2, q = 1.
    Low,
    /// p = 1, q = 2.
    High,
    /// p = q = 2.
    Both,
    /// p = 1, q = 4.
    Steep,
    /// p = 2, q = 4.
    BothSteep,
}

const GRADES: [Grade; 6] =
    [Grade::Plain, Grade::Low, Grade::High, Grade::Both, Grade::Steep, Grade::BothSteep];

impl Grade {
    /// beta(z) and beta'(z).
    fn map(self, z: f64) -> [f64; 2] {
        let [low, low_slope] = match self {
            Grade::Plain | Grade::High | Grade::Steep => [z, 1.0],
            Grade::Low | Grade::Both | Grade::BothSteep => soft(z),
        };
        let [high, high_slope] = match self {
            Grade::Plain | Grade::Low => [1.0 - low, 1.0],
            Grade::High | Grade::Both => soft(1.0 - low),
            Grade::Steep | Grade::BothSteep => steep(1.0 - low),
        };
        [1.0 - high, low_slope * high_slope]
    }

    /// 2 z - 1 at beta(z) = t in [0, 1], for the grades of which the inverse is elementary; the
    /// others are not asked for.
    pub fn inverse(self, t: f64) -> f64 {
        let z = match self {
            Grade::Low => root(t),
            Grade::High => 1.0 - root((1.0 - t).max(0.0)),
            _ => t,
        };
        2.0 * z - 1.0
    }

    /// The same without what it does at the low end.
    pub fn high_only(self) -> Grade {
        match self {
            Grade::Plain | Grade::Low => Grade::Plain,
            Grade::High | Grade::Both => Grade::High,
            Grade::Steep | Grade::BothSteep => Grade::Steep,
        }
    }

    /// The same without what it does at the high end.
    pub fn low_only(self) -> Grade {
        match self {
            Grade::Plain | Grade::High | Grade::Steep => Grade::Plain,
            Grade::Low | Grade::Both | Grade::BothSteep => Grade::Low,
        }
    }
}

/// Where y^2 turns into y: see [`soft`].
const BEND: f64 = 0.25;

/// y^2 (1 + b)/(y + b) and its slope on [0, 1]: y^2 near 0 but about linear beyond b, so that the
/// nodes' density at the other end falls by 1/6 only, not to the half. The pole at -b costs
/// nothing: its Bernstein ellipse is 1 + 2 b + 2 sqrt(b + b^2) = 2.6.
fn soft(y: f64) -> [f64; 2] {
    let over = 1.0 / (y + BEND);
    [y * y * (1.0 + BEND) * over, (1.0 + BEND) * y * over * (2.0 - y * over)]
}

/// Inverse of the first of [`soft`]: y^2 (1 + b) - t y - t b = 0.
fn root(t: f64) -> f64 {
    let lead = 1.0 + BEND;
    (t + (t * t + 4.0 * lead * BEND * t).sqrt()) / (2.0 * lead)
}

/// [`soft`] twice: y^4 near 0.
pub(super) fn steep(y: f64) -> [f64; 2] {
    let [inner, inner_slope] = soft(y);
    let [outer, outer_slope] = soft(inner);
    [outer, outer_slope * inner_slope]
}

/// Inverse of the first of [`steep`], for t in [0, 1].
pub(super) fn fourth_root(t: f64) -> f64 {
    root(root(t))
}

/// A rule: nodes in (0, 1) ascending, weights that add up to 1, and beta' at the nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Rule {
    pub nodes: Vec<f64>,
    pub weights: Vec<f64>,
    pub slopes: Vec<f64>,
}

/// Every rule of 1 to [`MOST`] nodes, made once.
#[derive(Debug)]
pub(super) struct Rules {
    /// By number of nodes, then by grade.
    rules: Vec<Vec<Rule>>,
    /// The plain rules on [-1, 1].
    gauss: Vec<Gauss>,
}

impl Rules {
    pub fn new() -> Rules {
        let gauss: Vec<Gauss> = (1..=MOST).map(Gauss::new).collect();
        let rules = gauss.iter().map(|g| GRADES.iter().map(|grade| graded(g, *grade)).collect()).collect();
        Rules { rules, gauss }
    }

    /// The rule of `n` nodes, `n` forced into [1, MOST].
    pub fn rule(&self, n: usize, grade: Grade) -> &Rule {
        &self.rules[n.clamp(1, MOST) - 1][grade as usize]
    }

    /// The matrix from values at the `n` plain nodes to the coefficients of the Legendre series
    /// through them, a row a node: exact, because the rule is exact for products of the
    /// polynomials.
    pub fn series(&self, n: usize) -> Vec<Vec<f64>> {
        let gauss = &self.gauss[n.clamp(1, MOST) - 1];
        let row = |(x, w): (&f64, &f64)| {
            let (mut previous, mut current) = (0.0, 1.0);
            let mut row = Vec::with_capacity(n);
            for k in 0..n {
                let k = k as f64;
                row.push((k + 0.5) * w * current);
                (previous, current) = (current, ((2.0 * k + 1.0) * x * current - k * previous) / (k + 1.0));
            }
            row
        };
        gauss.nodes.iter().zip(&gauss.weights).map(row).collect()
    }
}

fn graded(gauss: &Gauss, grade: Grade) -> Rule {
    let mut rule = Rule::default();
    for (x, w) in gauss.nodes.iter().zip(&gauss.weights) {
        let [node, slope] = grade.map(0.5 * (1.0 + x));
        rule.nodes.push(node);
        rule.weights.push(0.5 * w * slope);
        rule.slopes.push(slope);
    }
    rule
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobefit_math::ops;

    /// Polynomials, and powers of the distance to an end that is graded for them: geometric
    /// convergence, as the maps' pole at -b allows.
    #[test]
    fn every_rule_integrates_what_it_is_for() {
        let rules = Rules::new();
        for n in [8, 13, 24, 40, MOST] {
            for grade in GRADES {
                let rule = rules.rule(n, grade);
                let error = |f: &dyn Fn(f64) -> f64, exact: f64| {
                    let sum: f64 = rule.nodes.iter().zip(&rule.weights).map(|(x, w)| w * f(*x)).sum();
                    (sum - exact).abs()
                };
                let bound = 1e-13 + 10.0 / ops::pow(2.0, 2.0 * n as f64);
                assert!(error(&|_| 1.0, 1.0) < bound, "{n} {grade:?}");
                assert!(error(&|x| x * x, 1.0 / 3.0) < bound, "{n} {grade:?}");
                let low = matches!(grade, Grade::Low | Grade::Both | Grade::BothSteep);
                if low {
                    assert!(error(&|x| x * x.sqrt(), 0.4) < bound, "{n} {grade:?}");
                }
                if !matches!(grade, Grade::Plain | Grade::Low) {
                    assert!(error(&|x| (1.0 - x) * (1.0 - x).sqrt(), 0.4) < bound, "{n} {grade:?}");
                }
                if matches!(grade, Grade::Steep | Grade::BothSteep) {
                    assert!(error(&|x| (1.0 - x).sqrt().sqrt(), 0.8) < bound, "{n} {grade:?}");
                }
            }
        }
    }

    #[test]
    fn maps_are_inverted() {
        for t in [0.0, 1e-9, 0.1, 0.5, 0.999, 1.0] {
            assert!((steep(fourth_root(t))[0] - t).abs() < 1e-15);
            for grade in [Grade::Plain, Grade::Low, Grade::High] {
                let z = 0.5 * (1.0 + grade.inverse(t));
                assert!((grade.map(z)[0] - t).abs() < 1e-15, "{grade:?} {t}");
            }
        }
    }

    #[test]
    fn the_series_is_the_polynomial_through_the_values() {
        let rules = Rules::new();
        let matrix = rules.series(5);
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (3.0 - 4.0 * x));
        let values = rules.gauss[4].nodes.iter().map(|x| cubic(*x));
        let mut series = [0.0; 5];
        for (row, value) in matrix.iter().zip(values) {
            for (sum, weight) in series.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
        // 4 x^3 - 3 x^2 + 2 x + 1 = (8/5) P3 - 2 P2 + (22/5) P1 + 0 P0
        for (got, want) in series.iter().zip([0.0, 4.4, -2.0, 1.6, 0.0]) {
            assert!((got - want).abs() < 1e-14, "{series:?}");
        }
    }
}
