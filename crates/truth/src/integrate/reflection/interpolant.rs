//! E and B at millions of points, from patches of polynomials.
//!
//! Over x = ln(alpha) and y = ln(mu/(1.6 - mu)) both are analytic: the layer mu ~ alpha has its
//! branch points at mu = +-i alpha, pi/2 from the real axis in either variable, and 1.6 spreads the
//! end at mu = 1, beyond which the square root of the sine lies.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::effort::Effort;
use super::{albedo_of, split_of};
use crate::integrate::patches::Patches;
use crate::optics::Smith;
use crate::optics::distribution::Distribution;
use lobefit_math::ops;

/// Largest difference from the integral at the points of a tile that are checked: half of
/// [`Interpolant::ERROR`].
const CHECKED: f64 = 1e-9;

/// Tiles along x and along y, none longer than a patch may be.
const TILES: [usize; 2] = [8, 9];

/// E, and B where that is asked for, for alpha and mu in [[`Interpolant::SMALLEST`], 1].
///
/// The domain is cut into tiles once for all. A tile is made when a point of it is first asked for,
/// and stays: its polynomials do not depend on who asks, and when.
pub struct Interpolant<D> {
    lobe: fn(f64) -> D,
    smith: Smith,
    split: bool,
    tiles: [[OnceLock<Option<Patches>>; TILES[0]]; TILES[1]],
}

/// An [`Interpolant`] of some distribution.
pub trait Known: Sync {
    /// Makes the tiles of places (alpha, mu), in parallel; [`Known::at`] makes one at a time.
    fn cover(&self, places: &[(f64, f64)]);

    /// E and B; none outside the domain, and where no polynomial follows the integrals.
    fn at(&self, alpha: f64, mu: f64) -> Option<(f64, f64)>;
}

impl<D: Distribution> Known for Interpolant<D> {
    fn cover(&self, places: &[(f64, f64)]) {
        let mut needed = [[false; TILES[0]]; TILES[1]];
        for [x, y] in places.iter().filter_map(|(alpha, mu)| Self::tile(*alpha, *mu)) {
            needed[y][x] = true;
        }
        let all: Vec<[usize; 2]> = (0..TILES[1]).flat_map(|y| (0..TILES[0]).map(move |x| [x, y])).collect();
        all.into_par_iter().filter(|[x, y]| needed[*y][*x]).for_each(|tile| {
            self.made(tile);
        });
    }

    fn at(&self, alpha: f64, mu: f64) -> Option<(f64, f64)> {
        let tile = Self::tile(alpha, mu)?;
        self.made(tile).map(|patches| patches.at(variables(alpha, mu)).into())
    }
}

impl<D: Distribution> Interpolant<D> {
    /// Smallest alpha and mu.
    pub const SMALLEST: f64 = 1e-4;

    /// Largest error of E and of B of GGX, measured at random points by
    /// `tests/integrate/interpolant.rs`. Beckmann's is below 1e-7 (`crates/truth/tests/truth/many.rs`).
    pub const ERROR: f64 = 2e-9;

    /// No tile yet. E alone takes a fiftieth of the time of E and B; without `split`, B is NaN.
    pub const fn new(lobe: fn(f64) -> D, smith: Smith, split: bool) -> Interpolant<D> {
        let tiles = [const { [const { OnceLock::new() }; TILES[0]] }; TILES[1]];
        Interpolant { lobe, smith, split, tiles }
    }

    /// The tile of a point of the domain.
    fn tile(alpha: f64, mu: f64) -> Option<[usize; 2]> {
        let domain = Self::SMALLEST..=1.0;
        let at = || {
            let (place, [low, high]) = (variables(alpha, mu), ends(Self::SMALLEST));
            [0, 1].map(|k| {
                let part = (place[k] - low[k]) / (high[k] - low[k]);
                ((part * TILES[k] as f64) as usize).min(TILES[k] - 1)
            })
        };
        (domain.contains(&alpha) && domain.contains(&mu)).then(at)
    }

    fn made(&self, tile: [usize; 2]) -> Option<&Patches> {
        let make = || {
            // Both errors below 1e-11, so that the values are smooth: a jump between rules looks
            // like a patch that is too long.
            let effort = Effort::new(16, 12.0);
            let at = |place: [f64; 2]| {
                let [alpha, mu] = physical(place);
                if self.split {
                    split_of(self.smith, (self.lobe)(alpha), mu, &effort).into()
                } else {
                    [albedo_of(self.smith, (self.lobe)(alpha), mu, &effort.outer), 0.0]
                }
            };
            let [low, high] = ends(Self::SMALLEST);
            let edge = |k: usize, i: usize| low[k] + (high[k] - low[k]) * (i as f64 / TILES[k] as f64);
            // Rounding does not leave a point between two tiles.
            let slack = [0, 1].map(|k| 1e-12 * (high[k] - low[k]));
            let over = [
                [0, 1].map(|k| edge(k, tile[k]) - slack[k]),
                [0, 1].map(|k| edge(k, tile[k] + 1) + slack[k]),
            ];
            Patches::new(over, 1 + usize::from(self.split), CHECKED, &at).ok()
        };
        self.tiles[tile[1]][tile[0]].get_or_init(make).as_ref()
    }
}

/// The variables at the smallest and at the largest alpha and mu.
fn ends(smallest: f64) -> [[f64; 2]; 2] {
    [variables(smallest, smallest), variables(1.0, 1.0)]
}

fn variables(alpha: f64, mu: f64) -> [f64; 2] {
    [ops::log(alpha), ops::log(mu / (1.6 - mu))]
}

/// alpha and mu of the variables; rounding does not carry them beyond 1.
fn physical([x, y]: [f64; 2]) -> [f64; 2] {
    let ratio = ops::exp(y);
    [ops::exp(x).min(1.0), (1.6 * ratio / (1.0 + ratio)).min(1.0)]
}
