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
        let range = range(&sample.size, texels.iter().map(|i| sample.texel(*i)));
        Extent { range, alone: Vec::new(), size: sample.size.clone() }
    }

    /// Single texels.
    pub(super) fn singles(size: Vec<usize>, texels: impl Iterator<Item = Vec<usize>>) -> Extent {
        let mut alone: Vec<Vec<usize>> = texels.collect();
        alone.sort_by(|a, b| a.iter().rev().cmp(b.iter().rev()));
        Extent { range: range(&size, alone.iter().cloned()), alone, size }
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

/// First and last index of texels along every axis.
fn range(size: &[usize], texels: impl Iterator<Item = Vec<usize>>) -> Vec<[usize; 2]> {
    let mut range = vec![[usize::MAX, 0]; size.len()];
    for texel in texels {
        for (range, k) in range.iter_mut().zip(texel) {
            *range = [range[0].min(k), range[1].max(k)];
        }
    }
    range
}
