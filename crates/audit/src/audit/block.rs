//! A block of texels that departs from the rest of its table.

use super::defects::{Defect, SEEN, of_extent, tight};
use super::errors::Residuals;
use super::table::place;

/// A block stands out where its root mean square is this many times that of the others,
const APART: f64 = 6.0;
/// that of a line at each of its edges this many times that of the line beside it: errors that fade
/// towards the inside of a table do so by a factor of 3 from its first line to its second at most,
const EDGE: f64 = 4.0;
/// its errors are of one sign but for so much of them, as those of samples are not,
pub(super) const ONE_SIGN: f64 = 0.8;
/// they are all over it: the square of their mean is this share of their mean square, where a few large ones
/// make less of it;
const FILLED: f64 = 0.3;
/// or, as rows that hold those before them, it stands out by so much, by many texels;
const FAR: f64 = 36.0;
const FILLED_FAR: f64 = 0.15;
/// and it has so many texels.
const BLOCK: f64 = 4.0;
/// It is looked for above thresholds, each so many times lower than the one before.
const FALL: f64 = 1.5;

/// A block of texels that departs from the rest of the table, though it be half of it, or though the rest be
/// no more exact than samples are.
pub(super) fn block(r: &Residuals) -> Option<Defect> {
    let least = SEEN * r.spread();
    let beyond = |over: f64| -> Vec<usize> {
        r.judged.iter().copied().filter(|i| r.errors[*i].abs() > over).collect()
    };
    // A truth without a spread has no scale by which anything stands out.
    if least == 0.0 {
        return None;
    }
    let mut over = r.judged.iter().map(|i| r.errors[*i].abs()).fold(0.0, f64::max) / FALL;
    while over > least {
        let tight = tight(r, &beyond(over));
        // A block of rows may fade along x, as what it holds does.
        let wide = |(axis, n): (usize, &usize)| {
            let mut wide = tight.clone();
            wide.range[axis] = [0, n - 1];
            wide
        };
        let mut extents = std::iter::once(tight.clone()).chain(r.sample.size.iter().enumerate().map(wide));
        if let Some(extent) = extents.find(|extent| stands_out(r, &extent.range)) {
            return Some(of_extent(r, extent, &beyond(least), least));
        }
        over /= FALL;
    }
    None
}

/// Whether the errors of a range stand out from those around it, and end at its edges.
fn stands_out(r: &Residuals, range: &[[usize; 2]]) -> bool {
    // One line at the end of an axis may be of a clamp.
    let end = |(at, [from, to]): (&Vec<usize>, &[usize; 2])| {
        from == to && (at.first() == Some(from) || at.last() == Some(from))
    };
    if r.sample.at.iter().zip(range).any(end) {
        return false;
    }
    let about = About::of(r, range);
    let [inside, outside] = [about.inside, about.outside];
    inside.count >= BLOCK
        && outside.count > 0.0
        && inside.square() >= APART * APART * outside.square()
        && (about.is_filled() || about.is_far())
        && about.ends_at_edges()
}

/// Errors in a range of texels, and about it.
pub(super) struct About {
    inside: Mean,
    outside: Mean,
    /// Sums inside, of errors and of their magnitudes.
    signs: [f64; 2],
    /// At both ends along every axis the last line inside and the first outside.
    lines: Vec<[Mean; 2]>,
}

impl About {
    pub(super) fn of(r: &Residuals, range: &[[usize; 2]]) -> About {
        let dims = r.sample.dims();
        let among = |(at, [from, to]): (&Vec<usize>, &[usize; 2])| {
            [at.partition_point(|k| k < from), at.partition_point(|k| k <= to) - 1]
        };
        let range: Vec<[usize; 2]> = r.sample.at.iter().zip(range).map(among).collect();
        let (mut inside, mut outside, mut signs) = (Mean::default(), Mean::default(), [0.0; 2]);
        let mut lines = vec![[Mean::default(); 2]; 2 * range.len()];
        for i in &r.judged {
            let (texel, error) = (place(*i, &dims), r.errors[*i]);
            let away: Vec<usize> =
                (0..range.len()).filter(|k| !(range[*k][0]..=range[*k][1]).contains(&texel[*k])).collect();
            if away.is_empty() {
                inside.add(error);
                signs = [signs[0] + error, signs[1] + error.abs()];
            } else {
                outside.add(error);
            }
            for (k, [from, to]) in range.iter().enumerate() {
                for (line, own, beside) in [
                    (2 * k, texel[k] == *from, texel[k] + 1 == *from),
                    (2 * k + 1, texel[k] == *to, texel[k] == to + 1),
                ] {
                    if away.is_empty() && own {
                        lines[line][0].add(error);
                    } else if away == [k] && beside {
                        lines[line][1].add(error);
                    }
                }
            }
        }
        About { inside, outside, signs, lines }
    }

    /// Whether it is the smaller part, and stands out by far all over.
    fn is_far(&self) -> bool {
        let [inside, outside] = [self.inside, self.outside];
        let is_far = inside.square() >= FAR * FAR * outside.square();
        is_far && inside.count <= outside.count && self.is_over(FILLED_FAR)
    }

    /// Whether its errors are of one sign, and all over it.
    fn is_filled(&self) -> bool {
        self.is_over(FILLED) && self.is_of_one_sign()
    }

    /// Whether they are all over it, by a share.
    fn is_over(&self, share: f64) -> bool {
        let [_, magnitudes] = self.signs;
        magnitudes * magnitudes >= share * self.inside.count * self.inside.sum
    }

    pub(super) fn is_of_one_sign(&self) -> bool {
        self.signs[0].abs() >= ONE_SIGN * self.signs[1]
    }

    pub(super) fn ends_at_edges(&self) -> bool {
        self.lines.iter().all(|[own, beside]| own.square() >= EDGE * EDGE * beside.square())
    }
}

/// A mean square.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, error: f64) {
        (self.sum, self.count) = (self.sum + error * error, self.count + 1.0);
    }

    fn square(self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}
