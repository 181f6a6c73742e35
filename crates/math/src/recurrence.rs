//! A low-discrepancy sequence in any number of dimensions, without tables or seeds.

/// The additive recurrence x_i = frac(1/2 + (i + 1) a) with a_k = g^-(k+1), g the root of
/// g^(d+1) = g + 1 (Roberts 2018): the golden ratio in one dimension. Every stretch of indices is
/// spread evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Recurrence {
    strides: Vec<f64>,
}

impl Recurrence {
    /// The sequence in so many dimensions.
    pub fn new(dimensions: usize) -> Recurrence {
        let mut golden = 1.5_f64;
        for _ in 0..64 {
            // g = (1 + g)^(1/(d+1)), a contraction
            golden = super::ops::pow(1.0 + golden, 1.0 / (dimensions as f64 + 1.0));
        }
        let strides = (0..dimensions).scan(1.0, |stride, _| {
            *stride /= golden;
            Some(*stride)
        });
        Recurrence { strides: strides.collect() }
    }

    /// Coordinate of a point along a dimension, in [0, 1).
    pub fn coordinate(&self, index: usize, dimension: usize) -> f64 {
        let x = 0.5 + (index as f64 + 1.0) * self.strides[dimension];
        x - x.floor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_dimension_is_the_golden_ratio_and_cells_are_filled_evenly() {
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        let one = Recurrence::new(1);
        assert!((one.coordinate(0, 0) - (0.5 + 1.0 / golden - 1.0)).abs() < 1e-12);
        for dimensions in 2..=4_usize {
            let sequence = Recurrence::new(dimensions);
            let mut counts = vec![0_i32; 1 << dimensions];
            for i in 0..4096 {
                let half = |k: usize| usize::from(sequence.coordinate(i, k) >= 0.5) << k;
                counts[(0..dimensions).map(half).sum::<usize>()] += 1;
            }
            let expected = 4096 >> dimensions;
            assert!(counts.iter().all(|c| (c - expected).abs() < 24), "{dimensions}: {counts:?}");
        }
    }
}
