//! `ggx-coat`: what a rough dielectric coat does to diffuse light, averaged over the hemisphere: what it
//! reflects from outside, what of it enters, and what comes back to a base that it lies on.
//!
//! The coat has one interface, rough GGX with the exact Fresnel term, and absorbs nothing. `E_avg` is 2
//! int E_c(mu) mu dmu of its albedo E_c from outside, R of `ggx-glass`; `T_avg` the same of T. Light that
//! a diffuse base sends up meets the interface from inside: `K_single` of it is reflected, T_avg/ior^2
//! leaves (the transmission is reciprocal: ior^2 times as much light lies within the same solid angle,
//! seen from inside), and the rest is what single scattering loses between facets.
//!
//! `K` is the internal reflectance where nothing is lost: all that is not reflected enters, T = 1 - E_c,
//! and by the same reciprocity `escape` = 1 - K = (1 - E_avg)/ior^2. Over a base of albedo rho light goes
//! to and fro, and the layers send back
//!   E(mu) = E_c(mu) + (1 - E_c(mu)) rho (1 - K)/(1 - rho K),
//! 1 for a white base at every mu. Of single scattering it is E_c + T(mu) rho (T_avg/ior^2)/(1 - rho
//! K_single) (`crates/truth/tests/truth/coat.rs` walks it).
//!
//! Ends of the domain: alpha = 0 is the smooth interface, of which nothing is lost and both K are equal;
//! ior = 1 reflects nothing.

use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_math::gauss::Gauss;
use lobefit_math::{ops, panels};
use rayon::prelude::*;

use super::glass::GGX_GLASS;
use super::{
    ALPHA, Asked, Choice, Facts, Input, Quantity, Residual, Truth, Use, Variant, check_domain, check_unit,
};
use crate::integrate::glass::{self, Side, table};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::walk::{Walks, escape};
use crate::integrate::{Estimate, Goal, IntegrateError};
use crate::optics::Smith;
use crate::points::{Points, hull};

/// The quantity.
#[derive(Clone, Copy, Debug)]
pub struct GgxCoat;

/// The share that leaves a coat: bases are multiplied by it and divided by 1 - rho (1 - escape), so that its
/// relative error is what a renderer sees at most.
pub const ESCAPE: Use = Use {
    name: "escape",
    meaning: "the share of diffuse light from inside that leaves a coat, error relative",
    metric: "relative error of the share that leaves",
    residual: Residual::Quotient,
    blends: false,
};

/// Bound of the error by default.
const TOLERANCE: f64 = 1e-6;

/// Tolerance of what is averaged.
const INNER: f64 = 1e-7;

/// Smallest alpha above 0, and smallest mu at which a rough interface is asked for: where neighbours
/// share their work. 4e-8 of the light comes from below, which counts as error.
const SMALLEST_ALPHA: f64 = 4e-4;
const SMALLEST_MU: f64 = table::MU[0];
const BELOW: f64 = SMALLEST_MU * SMALLEST_MU;

/// Nodes of a panel over mu of two rules.
const NODES: [usize; 2] = [8, 16];

/// The smallest panel, in widths of the layer where R changes: mu of about alpha, and as near to the
/// critical angle.
const FINEST: f64 = 0.1;

/// The smallest panel of a smooth interface, whose R from inside goes as the root of the distance from
/// the critical angle.
const SMOOTH: f64 = 1e-8;

/// Where mu is sampled: cosines and weights of 2 int f(mu) mu dmu.
struct Average {
    cosines: Vec<f64>,
    weights: Vec<f64>,
}

impl Average {
    fn new(alpha: f64, ior: f64, side: Side, nodes: usize) -> Average {
        let (cuts, rule) = (cuts(alpha, ior, side), Gauss::new(nodes));
        let least = if alpha == 0.0 { glass::SMALLEST_MU } else { SMALLEST_MU };
        let mut average = Average { cosines: Vec::new(), weights: Vec::new() };
        for cut in cuts.windows(2) {
            let (half, middle) = (0.5 * (cut[1] - cut[0]), 0.5 * (cut[0] + cut[1]));
            for (node, weight) in rule.nodes.iter().zip(&rule.weights) {
                let mu = middle + half * node;
                average.cosines.push(mu.max(least));
                average.weights.push(2.0 * half * weight * mu);
            }
        }
        average
    }

    fn points(&self, alpha: f64, ior: f64) -> Points {
        let all = |x: f64| vec![x; self.cosines.len()];
        Points::new([("alpha", all(alpha)), ("mu", self.cosines.clone()), ("ior", all(ior))])
    }

    fn of(&self, values: impl Iterator<Item = f64>) -> f64 {
        self.weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
    }
}

/// Panels of the light from a side.
fn cuts(alpha: f64, ior: f64, side: Side) -> Vec<f64> {
    // The smooth interface's R from outside has its branch points at mu = +-i sqrt(ior^2 - 1).
    let excess = ((ior - 1.0) * (ior + 1.0)).sqrt();
    let finest = FINEST * if alpha == 0.0 { excess } else { alpha };
    match side {
        Side::Outside => panels::from_zero(1.0, finest.max(SMOOTH)),
        Side::Inside => {
            let (critical, near) = (excess / ior, (FINEST * alpha).max(SMOOTH));
            let mut cuts = vec![0.0];
            panels::towards_both(&mut cuts, 0.0, critical, 1.0, [finest.max(SMOOTH), near]);
            let mut above = vec![-1.0];
            panels::towards_end(&mut above, -1.0, -critical, 1.0, near);
            cuts.extend(above.iter().rev().skip(1).map(|x| -x));
            cuts
        }
    }
}

/// E_avg, T_avg and K_single by one rule.
fn by(smith: Smith, [alpha, ior]: [f64; 2], nodes: usize) -> Result<[f64; 3], IntegrateError> {
    let outside = Average::new(alpha, ior, Side::Outside, nodes);
    let points = outside.points(alpha, ior);
    let entering = GGX_GLASS.energies(smith, Some(Side::Outside), &points, INNER)?.0;
    let inside = Average::new(alpha, ior, Side::Inside, nodes);
    let back = GGX_GLASS.reflected((smith, Side::Inside), &inside.points(alpha, ior), INNER)?.0;
    Ok([
        outside.of(entering.iter().map(|energies| energies.r[0])),
        outside.of(entering.iter().map(|energies| energies.t[0])),
        inside.of(back.into_iter()),
    ])
}

/// Nodes of the interpolant of E_avg over ln(alpha) and sqrt(ior - 1), and the bound of its error: 4e-8
/// where it was measured, at random places up to an index of 2 (`crates/truth/tests/truth/many.rs`).
const GRID: usize = 24;
const QUICK: f64 = 1e-6;

/// E_avg over a box.
struct Averages {
    alpha: [f64; 2],
    /// sqrt(ior - 1) of rows.
    iors: Vec<f64>,
    rows: Vec<Chebyshev>,
}

impl Averages {
    /// Over ranges of alpha > 0 and of ior.
    fn new(smith: Smith, alpha: [f64; 2], ior: [f64; 2]) -> Result<Averages, IntegrateError> {
        let ([low, high], root) = (alpha.map(ops::log), ior.map(|n| (n - 1.0).sqrt()));
        let iors = chebyshev::nodes(root[0], root[1], GRID);
        let excess: Vec<f64> = iors.iter().map(|y| (1.0 + y * y).clamp(ior[0], ior[1])).collect();
        let column = |x: &f64| {
            let alpha = ops::exp(*x).clamp(SMALLEST_ALPHA, 1.0);
            let average = Average::new(alpha, ior[1], Side::Outside, NODES[0]);
            let points = Points::product(&[("ior", &excess), ("mu", &average.cosines), ("alpha", &[alpha])]);
            let (r, _) = GGX_GLASS.reflected((smith, Side::Outside), &points, INNER)?;
            Ok((0..GRID).map(|k| average.of(r.iter().skip(k).step_by(GRID).copied())).collect())
        };
        let nodes = chebyshev::nodes(low, high, GRID);
        let columns: Vec<Vec<f64>> = nodes.par_iter().map(column).collect::<Result<_, IntegrateError>>()?;
        let row = |k: usize| Chebyshev::new(low, high, columns.iter().map(|column| column[k]).collect());
        Ok(Averages { alpha: [low, high], rows: (0..GRID).map(row).collect(), iors })
    }

    fn at(&self, alpha: f64, ior: f64) -> f64 {
        let x = ops::log(alpha).clamp(self.alpha[0], self.alpha[1]);
        let last = self.iors.len() - 1;
        let y = (ior - 1.0).sqrt().clamp(self.iors[0], self.iors[last]);
        let rows = chebyshev::all_at(&self.rows, x);
        chebyshev::weights(&self.iors, y).iter().zip(rows).map(|(w, row)| w * row).sum()
    }
}

/// What leaves of diffuse light from inside where nothing is lost, and the internal reflectance.
fn internal(e_avg: f64, ior: f64) -> [f64; 2] {
    let escape = (1.0 - e_avg) / (ior * ior);
    [escape, 1.0 - escape]
}

impl Quantity for GgxCoat {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "ggx-coat",
                inputs: &[ALPHA, Input::new("ior", [1.0, 3.0]).usually([1.1, 2.5])],
                outputs: &["escape", "K", "E_avg", "T_avg", "K_single", "error"],
                choices: &[Choice::Smith],
                tolerance: TOLERANCE,
                smallest_alpha: SMALLEST_ALPHA,
                remark: "escape = 1 - K from inside, where nothing is lost; T_avg and K_single of single scattering",
                ..Facts::NONE
            }
        }
    }

    fn uses(&self, column: &str) -> &'static [Use] {
        if column == self.outputs()[0] { &[ESCAPE, Use::VALUE] } else { &[Use::VALUE] }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        check_unit(self, ALPHA.name, &x[..1], self.smallest_alpha())?;
        check_domain(self, &[x[0].min(1.0), x[1]])?;
        let bounded = |coarse: &[f64; 3], fine: &[f64; 3]| {
            let values = [0, 1, 2].map(|k| Estimate::from_slow_pair(coarse[k], fine[k], 1.0));
            let error = values.iter().map(|value| value.error).fold(0.0, f64::max) + 2.0 * INNER + BELOW;
            let [e, t, k] = values.map(|value| value.value);
            let [escape, internal] = internal(e, x[1]);
            error.is_finite().then(|| (vec![escape, internal, e, t, k, error], error))
        };
        let place = || format!("alpha = {:?}, ior = {:?}", x[0], x[1]);
        let goal = Goal { quantity: self.name(), place: &place, tolerance };
        goal.climb(NODES, |nodes| by(smith, [x[0].min(1.0), x[1]], nodes), bounded)
    }

    /// What is of E_avg alone, from an interpolant over the box of the points.
    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let few = asked.points.len() <= GRID;
        if few || asked.tolerance < QUICK || asked.wants(&["T_avg", "K_single", "error"]) {
            return Ok(None);
        }
        let (smith, places) = (asked.variant.smith(self.name())?, asked.places(self)?);
        let [alpha, ior] = asked.columns(self)?;
        check_unit(self, ALPHA.name, alpha, self.smallest_alpha())?;
        ior.iter().try_for_each(|ior| check_domain(self, &[0.0, *ior]))?;
        let rough = hull(alpha.iter().copied().filter(|alpha| *alpha > 0.0));
        if rough[0] > rough[1] {
            return Ok(None);
        }
        let known = Averages::new(smith, rough, hull(ior.iter().copied()))?;
        let one = |i: usize| {
            let e = match alpha[i] {
                0.0 => self.at(asked.variant, &[0.0, ior[i]], asked.tolerance)?[2],
                alpha => known.at(alpha, ior[i]),
            };
            let [escape, internal] = internal(e, ior[i]);
            Ok([escape, internal, e])
        };
        let rows: Vec<[f64; 3]> = (0..alpha.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let columns = places.iter().map(|place| rows.iter().map(|row| row[*place]).collect()).collect();
        Ok(Some(Truth { columns, error: QUICK, evaluations: (GRID * GRID) as u64 }))
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        let dear = ["T_avg", "K_single", "error"];
        if outputs.iter().any(|output| dear.contains(output)) { 3e4 } else { 1.0 }
    }

    /// Views in proportion to their cosine, and visible normals.
    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let [e, t, k_single] = monte_carlo::coat(smith, x[0], x[1], run)?;
        let standard_error = e.standard_error / (x[1] * x[1]);
        let [escape, k] = internal(e.value, x[1]).map(|value| Sampled { value, standard_error });
        Ok(vec![escape, k, e, t, k_single])
    }

    fn walked(&self, x: &[f64], walks: Walks) -> Option<Result<Sampled, IntegrateError>> {
        Some(escape([x[0], x[1]], walks))
    }
}
