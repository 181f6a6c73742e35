//! Where texels lie in a table.

use super::sample::Sample;

/// The box about texels, and those of them that stand alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// First and last index along every axis.
    pub range: Vec<[usize; 2]>,
    /// Single texels, by their places; nothing of those that lie together.
    pub alone: Vec<Vec<usize>>,
    /// Size of the table.
    pub size: Vec<usize>,
}

impl Extent {
    /// The least box about texels, by their places in a sample.
    pub(super) fn of(sample: &Sample, texels: &[usize]) -> Extent {
        Extent {
            alone: Vec::new(),
            ..Extent::alone(sample.size.clone(), texels.iter().map(|i| sample.texel(*i)))
        }
    }

    /// Single texels.
    pub(super) fn alone(size: Vec<usize>, texels: impl Iterator<Item = Vec<usize>>) -> Extent {
        let mut range = vec![[usize::MAX, 0]; size.len()];
        let mut alone: Vec<Vec<usize>> = texels.collect();
        alone.sort_by(|a, b| a.iter().rev().cmp(b.iter().rev()));
        for texel in &alone {
            for (range, k) in range.iter_mut().zip(texel) {
                *range = [range[0].min(*k), range[1].max(*k)];
            }
        }
        Extent { range, alone, size }
    }

    /// How many texels the box holds.
    pub(super) fn volume(&self) -> usize {
        self.range.iter().map(|[from, to]| to - from + 1).product()
    }

    /// Whether it is the whole table.
    pub(super) fn is_whole(&self) -> bool {
        self.range.iter().zip(&self.size).all(|(range, n)| *range == [0, n - 1])
    }

    /// Whether a texel is of it.
    pub(super) fn holds(&self, texel: &[usize]) -> bool {
        let inside = || texel.iter().zip(&self.range).all(|(k, range)| (range[0]..=range[1]).contains(k));
        if self.alone.is_empty() { inside() } else { self.alone.iter().any(|own| own == texel) }
    }
}
