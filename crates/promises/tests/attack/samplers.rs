//! Normals that are drawn, counted in cells of slopes: chi-square against the density of visible normals
//! that Smith's theory gives (Heitz 2014, eq. 16), down to alpha = 1e-4.

use std::f64::consts::PI;

use lobefit_math::ops;
use lobefit_math::vector::{Vec3, normalise};
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::optics::distribution::Distribution;
use lobefit_truth::optics::ggx;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Cells by radius and by azimuth.
const CELLS: [usize; 2] = [12, 24];

/// Points along each side of a cell at which its share is summed.
const SIDE: usize = 48;

/// Normals drawn of each lobe and view.
const DRAWN: usize = 400_000;

/// A lobe that is drawn: slopes over alpha of radius r, where a part w^2 of all lies beyond r.
struct Lobe {
    name: &'static str,
    alpha: [f64; 2],
    draw: fn([f64; 2], Vec3, f64, f64) -> Vec3,
    radius: fn(f64) -> f64,
    beyond: fn(f64) -> f64,
}

const GGX: Lobe = Lobe {
    name: "GGX",
    alpha: [1.0; 2],
    draw: ggx::visible_normal,
    radius: |w| ((1.0 - w) * (1.0 + w)).sqrt() / w,
    beyond: |r| 1.0 / (1.0 + r * r).sqrt(),
};

const BECKMANN: Lobe = Lobe {
    name: "Beckmann",
    draw: |alpha, view, u, v| Beckmann(alpha[0]).visible_normal(view, u, v),
    radius: |w| (-2.0 * ops::log(w)).sqrt(),
    beyond: |r| ops::exp(-0.5 * r * r),
    ..GGX
};

/// The share of every cell: equal steps of w and of the azimuth, each weighted by w and by v.n/n_z.
fn shares(lobe: &Lobe, view: Vec3) -> Vec<f64> {
    let [rings, sectors] = CELLS;
    let [x, y] = [lobe.alpha[0] * view[0], lobe.alpha[1] * view[1]];
    let one = |cell: usize| {
        let (ring, sector) = (cell / sectors, cell % sectors);
        let at = |k: usize, i: usize, n: usize| (k as f64 + (i as f64 + 0.5) / SIDE as f64) / n as f64;
        let mut sum = 0.0;
        for i in 0..SIDE {
            let w = at(ring, i, rings);
            let r = (lobe.radius)(w);
            for j in 0..SIDE {
                let (sine, cosine) = ops::sincos(2.0 * PI * at(sector, j, sectors));
                sum += w * (view[2] + r * (x * cosine + y * sine)).max(0.0);
            }
        }
        sum
    };
    let sums: Vec<f64> = (0..rings * sectors).map(one).collect();
    let whole: f64 = sums.iter().sum();
    sums.into_iter().map(|sum| sum / whole).collect()
}

fn counts(lobe: &Lobe, view: Vec3, seed: u64) -> Vec<u32> {
    let [rings, sectors] = CELLS;
    let mut random = Pcg64::seed_from_u64(seed);
    let mut counts = vec![0; rings * sectors];
    for _ in 0..DRAWN {
        let n = (lobe.draw)(lobe.alpha, view, random.random(), random.random());
        assert!(
            n.iter().all(|x| x.is_finite()) && n[2] > 0.0,
            "{} {:?} {view:?}: {n:?}",
            lobe.name,
            lobe.alpha
        );
        let (x, y) = (n[0] / (lobe.alpha[0] * n[2]), n[1] / (lobe.alpha[1] * n[2]));
        let w = (lobe.beyond)((x * x + y * y).sqrt());
        let turn = ops::atan2(y, x) / (2.0 * PI);
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        let cell = |part: f64, n: usize| ((part * n as f64) as usize).min(n - 1);
        counts[cell(w, rings) * sectors + cell(turn, sectors)] += 1;
    }
    counts
}

#[test]
fn drawn_normals_have_the_density_of_visible_ones() {
    let mut cases = Vec::new();
    for alpha in [[1e-4, 1e-4], [1e-4, 1e-2], [0.02, 0.3], [0.5, 0.5], [1.0, 1.0]] {
        for mu in [1.0, 0.6, 0.05, 1e-3, -0.2] {
            // From below, a narrow lobe shows no facet to speak of.
            if mu > 0.0 || alpha[1] > 0.1 {
                cases.push((Lobe { alpha, ..GGX }, mu));
            }
            if alpha[0] == alpha[1] && mu > 0.0 {
                cases.push((Lobe { alpha, ..BECKMANN }, mu));
            }
        }
    }
    let off: Vec<f64> = cases
        .par_iter()
        .enumerate()
        .map(|(seed, (lobe, mu))| {
            let view = normalise([0.8, 0.6, 0.0]).map(|x| x * f64::sqrt(1.0 - mu * mu));
            let view = [view[0], view[1], *mu];
            let (mut square, mut freedom) = (0.0, -1.0);
            let (mut rest, mut rest_counted) = (0.0, 0.0);
            for (share, counted) in shares(lobe, view).into_iter().zip(counts(lobe, view, seed as u64)) {
                let expected = share * DRAWN as f64;
                if expected < 20.0 {
                    rest += expected;
                    rest_counted += f64::from(counted);
                    continue;
                }
                square += (f64::from(counted) - expected) * (f64::from(counted) - expected) / expected;
                freedom += 1.0;
            }
            square += (rest_counted - rest) * (rest_counted - rest) / f64::max(rest, 1.0);
            let off = (square - freedom) / f64::sqrt(2.0 * freedom);
            println!(
                "{} {:?} mu {mu}: chi-square {square:.1} of {freedom} cells, {off:.2} sigma",
                lobe.name, lobe.alpha
            );
            off
        })
        .collect();
    // 5 sigma of a chi-square of some hundred cells: 1 of a million.
    assert!(off.iter().all(|off| off.abs() < 5.0), "{off:?}");
}

/// Normals by D cos do not depend on the view: they are those that are visible from above, in shares w of
/// rings and equal ones of sectors.
#[test]
fn normals_by_the_distribution_have_its_density() {
    for alpha in [[1e-4, 1e-4], [0.02, 0.3], [1.0, 1.0]] {
        for lobe in [Lobe { alpha, ..GGX }, Lobe { alpha: [alpha[0]; 2], ..BECKMANN }] {
            let above = [0.0, 0.0, 1.0];
            let (shares, counts) = (shares(&lobe, above), counts(&lobe, above, 5));
            let of = |(share, count): (&f64, &u32)| {
                let expected = share * DRAWN as f64;
                (f64::from(*count) - expected) * (f64::from(*count) - expected) / expected
            };
            let square: f64 = shares.iter().zip(&counts).map(of).sum();
            let freedom = shares.len() as f64 - 1.0;
            let off = (square - freedom) / f64::sqrt(2.0 * freedom);
            assert!(off.abs() < 5.0, "{} {alpha:?}: {off:.2} sigma", lobe.name);
        }
    }
}
