//! Creases: errors in the second differences of what is displayed, on the edges of the proxy and
//! elsewhere.

use lobefit::report::{Image, displayed};
use lobefit_math::sum;

/// Mean absolute second difference, in steps of displayed luminance in [0, 1], over three pixels in
/// a row or a column. 0 where a picture has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Creases {
    /// Where the mirror rays of the three meet two walls: an edge of the proxy is in the picture.
    pub edges: f64,
    /// Where those of five in a row meet one wall: farther than a pixel from there.
    pub elsewhere: f64,
}

/// Of the difference of two pictures as shown, linear light in [0, 1]. `met` has the wall that the
/// mirror ray of each pixel meets; none where nothing reflects.
pub(super) fn creases(test: &Image, reference: &Image, met: &[Option<usize>]) -> Creases {
    let pairs = test.pixels.iter().zip(&reference.pixels);
    let off: Vec<f64> = pairs.map(|(a, b)| displayed(*a) - displayed(*b)).collect();
    let (mut edges, mut elsewhere) = (Vec::new(), Vec::new());
    for row in 0..test.height {
        for column in 0..test.width {
            let k = row * test.width + column;
            for (step, place, end) in [(1, column, test.width), (test.width, row, test.height)] {
                if place == 0 || place + 1 == end {
                    continue;
                }
                let [Some(a), Some(b), Some(c)] = [k - step, k, k + step].map(|k| met[k]) else { continue };
                let second = (off[k - step] - 2.0 * off[k] + off[k + step]).abs();
                let beyond = || {
                    place > 1
                        && place + 2 < end
                        && [k - 2 * step, k + 2 * step].iter().all(|&k| met[k] == Some(b))
                };
                if a != b || b != c {
                    edges.push(second);
                } else if beyond() {
                    elsewhere.push(second);
                }
            }
        }
    }
    let mean = |seconds: &[f64]| if seconds.is_empty() { 0.0 } else { sum::mean(seconds) };
    Creases { edges: mean(&edges), elsewhere: mean(&elsewhere) }
}

/// Those of a picture itself: what is there to see.
pub(super) fn detail(picture: &Image, met: &[Option<usize>]) -> Creases {
    let black = Image { pixels: vec![[0.0; 3]; picture.pixels.len()], ..*picture };
    creases(picture, &black, met)
}
