//! `ggx-glass`, `beckmann-glass`: energies of a rough dielectric interface.

use rayon::prelude::*;

use super::{ALPHA, Asked, Choice, Facts, Fresnel, Input, MU, Quantity, Trace, Truth, Variant};
use crate::integrate::glass::Side;
use crate::integrate::glass::table::{self, Energies, Kernel, Tabled};
use crate::integrate::monte_carlo::{self, Run, Sampled};
use crate::integrate::{IntegrateError, count, glass};
use crate::optics::Smith;
use crate::optics::beckmann::Beckmann;
use crate::optics::distribution::Ggx;
use crate::points::Points;

/// Points of one task: work is cut by index alone.
const CHUNK: usize = 256;

/// Fewest points for which the rules of rings that neighbours share are set up.
const MANY: usize = 16;

/// Finest tolerance of the rings that neighbours share.
const FINEST: f64 = 1e-8;

/// Reflected and transmitted energy, their sum and 1 less the sum, from either side.
///
/// A lobe stands behind a pointer, so that no package that names one compiles its kernels again. The errors
/// of all are those of [`Quantity::at`].
pub trait Glass: Quantity {
    /// R from one side alone, in much less work than E, and the evaluations that it took.
    fn reflected(
        &self,
        at: (Smith, Side),
        points: &Points,
        tolerance: f64,
    ) -> Result<(Vec<f64>, u64), IntegrateError>;

    /// The energies of both sides or of one, and the evaluations that they took.
    fn energies(
        &self,
        smith: Smith,
        only: Option<Side>,
        points: &Points,
        tolerance: f64,
    ) -> Result<(Vec<Energies>, u64), IntegrateError>;

    /// R, T and the loss at alpha, mu and ior by Monte Carlo.
    fn drawn(&self, at: (Smith, Side), place: [f64; 3], run: Run) -> Result<[Sampled; 3], IntegrateError>;

    /// R, T and E at points from outside and from inside, which share their work as neighbours of
    /// one alpha and mu do; E is within a tolerance in [1e-8, 1e-2], R and T within twice as much.
    fn both_sides(
        &self,
        smith: Smith,
        points: &Points,
        tolerance: f64,
    ) -> Result<[Truth; 2], IntegrateError> {
        let (all, evaluations) = self.energies(smith, None, points, tolerance)?;
        Ok([0, 1].map(|side| {
            let rows: Vec<[f64; 3]> = all.iter().map(|e| [e.r[side], e.t[side], e.e()[side]]).collect();
            Truth::of_rows(&rows, tolerance, evaluations)
        }))
    }

    /// E from one side alone, in less work than from both, and the evaluations that it took.
    fn one_side(
        &self,
        (smith, side): (Smith, Side),
        points: &Points,
        tolerance: f64,
    ) -> Result<(Vec<f64>, u64), IntegrateError> {
        let (all, evaluations) = self.energies(smith, Some(side), points, tolerance)?;
        Ok((all.into_iter().map(|e| e.e()[usize::from(side == Side::Inside)]).collect(), evaluations))
    }
}

/// `ggx-glass`.
pub static GGX_GLASS: &dyn Glass = &Lobe::new(Ggx, true);

/// `beckmann-glass`.
pub static BECKMANN_GLASS: &dyn Glass = &Lobe::new(Beckmann, false);

/// The quantity of a distribution of normals.
struct Lobe<D> {
    facts: Facts,
    /// The distribution of a width.
    lobe: fn(f64) -> D,
    /// Whether it is the lobe of the path tracer.
    is_traced: bool,
}

impl<D: Tabled + 'static> Lobe<D> {
    const fn new(lobe: fn(f64) -> D, is_traced: bool) -> Lobe<D> {
        let facts = Facts {
            name: D::QUANTITY,
            inputs: const {
                &[
                    ALPHA,
                    Input { domain: [glass::SMALLEST_MU, 1.0], ..MU },
                    Input::new("ior", [1.0, glass::LARGEST_IOR]).usually([1.0, 2.0]),
                ]
            },
            outputs: &["R", "T", "E", "loss", "error"],
            choices: &[Choice::Smith, Choice::Side],
            tolerance: glass::TOLERANCE,
            smallest_alpha: glass::ALPHA[0],
            fresnel: Some(Fresnel::Dielectric),
            draws: monte_carlo::GLASS_DRAWS,
            ..Facts::NONE
        };
        Lobe { facts, lobe, is_traced }
    }

    /// The energies at alpha, mu and ior by the truth's own sweep.
    fn exactly(
        &self,
        (smith, side): (Smith, Side),
        [alpha, mu, ior]: [f64; 3],
        tolerance: f64,
    ) -> Result<glass::Glass, IntegrateError> {
        glass::glass_of(D::QUANTITY, (smith, (self.lobe)(alpha)), mu, (ior, side), tolerance)
    }

    /// Values at points, and the evaluations that they took: neighbours of one alpha and mu go together.
    fn in_groups<T: Send>(
        &self,
        points: &Points,
        group: impl Fn(&[[f64; 3]], &mut Vec<T>) -> Result<u64, IntegrateError> + Sync,
    ) -> Result<(Vec<T>, u64), IntegrateError> {
        let asked = Asked { variant: &Variant::default(), points, outputs: &[], tolerance: 0.0 };
        let [alpha, mu, ior] = asked.columns(self)?;
        let inputs: Vec<[f64; 3]> = (0..alpha.len()).map(|i| [alpha[i], mu[i], ior[i]]).collect();
        let chunk = |chunk: &[[f64; 3]]| {
            let (mut values, mut evaluations) = (Vec::with_capacity(chunk.len()), 0);
            for same in chunk.chunk_by(|a, b| a[..2] == b[..2]) {
                evaluations += group(same, &mut values)?;
            }
            Ok((values, evaluations))
        };
        let parts: Vec<(Vec<T>, u64)> =
            inputs.par_chunks(CHUNK).map(chunk).collect::<Result<_, IntegrateError>>()?;
        let evaluations = parts.iter().map(|(_, n)| n).sum();
        count::add(evaluations as usize);
        Ok((parts.into_iter().flat_map(|(values, _)| values).collect(), evaluations))
    }
}

impl<D: Tabled + 'static> Glass for Lobe<D> {
    fn reflected(
        &self,
        (smith, side): (Smith, Side),
        points: &Points,
        tolerance: f64,
    ) -> Result<(Vec<f64>, u64), IntegrateError> {
        let kernel = Kernel::of(self.lobe, smith, tolerance)?;
        self.in_groups(points, |same, out| {
            let ([alpha, mu, _], start) = (same[0], out.len());
            let iors: Vec<f64> = same.iter().map(|point| point[2]).collect();
            out.resize(start + iors.len(), 0.0);
            if table::covers(alpha, mu, &iors) {
                return kernel.reflected([alpha, mu], &iors, side, &mut out[start..]);
            }
            for (ior, r) in iors.iter().zip(&mut out[start..]) {
                *r = self.exactly((smith, side), [alpha, mu, *ior], tolerance)?.r;
            }
            Ok(iors.len() as u64)
        })
    }

    fn energies(
        &self,
        smith: Smith,
        only: Option<Side>,
        points: &Points,
        tolerance: f64,
    ) -> Result<(Vec<Energies>, u64), IntegrateError> {
        let kernel = Kernel::of(self.lobe, smith, tolerance)?;
        let kernel = match only {
            Some(side) => kernel.only(side),
            None => kernel,
        };
        self.in_groups(points, |same, out| {
            let ([alpha, mu, _], start) = (same[0], out.len());
            let iors: Vec<f64> = same.iter().map(|point| point[2]).collect();
            out.resize(start + iors.len(), Energies::default());
            if table::covers(alpha, mu, &iors) {
                return kernel.energies(alpha, mu, &iors, &mut out[start..]);
            }
            for (ior, energies) in iors.iter().zip(&mut out[start..]) {
                for (k, side) in Side::ALL.into_iter().enumerate() {
                    let value = self.exactly((smith, side), [alpha, mu, *ior], tolerance)?;
                    (energies.r[k], energies.t[k]) = (value.r, value.t);
                }
            }
            Ok(2 * iors.len() as u64)
        })
    }

    fn drawn(
        &self,
        (smith, side): (Smith, Side),
        [alpha, mu, ior]: [f64; 3],
        run: Run,
    ) -> Result<[Sampled; 3], IntegrateError> {
        monte_carlo::glass_of(D::QUANTITY, (smith, (self.lobe)(alpha)), mu, (ior, side), run)
    }
}

impl<D: Tabled + 'static> Quantity for Lobe<D> {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let at = (variant.smith(self.name())?, variant.side(self.name())?);
        let v = self.exactly(at, [x[0], x[1], x[2]], tolerance)?;
        Ok(vec![v.r, v.t, v.e, v.loss, v.error])
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let Asked { variant, points, tolerance, .. } = *asked;
        if asked.wants(&["loss", "error"]) || tolerance < 2.0 * FINEST || points.len() < MANY {
            return Ok(None);
        }
        let (smith, side) = (variant.smith(self.name())?, variant.side(self.name())?);
        if asked.outputs == ["R"] {
            let (r, evaluations) = self.reflected((smith, side), points, 0.5 * tolerance)?;
            return Ok(Some(Truth { columns: vec![r], error: tolerance, evaluations }));
        }
        if asked.outputs == ["E"] {
            let (e, evaluations) = self.one_side((smith, side), points, 0.5 * tolerance)?;
            return Ok(Some(Truth { columns: vec![e], error: tolerance, evaluations }));
        }
        let places = asked.places(self)?;
        let all = &self.both_sides(smith, points, 0.5 * tolerance)?[usize::from(side == Side::Inside)];
        let columns = places.iter().map(|place| all.columns[*place].clone()).collect();
        Ok(Some(Truth { columns, error: tolerance, evaluations: all.evaluations }))
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        match outputs {
            ["R"] => 100.0,
            ["E"] => 300.0,
            _ => 1e4,
        }
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let at = (variant.smith(self.name())?, variant.side(self.name())?);
        let [r, t, loss] = self.drawn(at, [x[0], x[1], x[2]], run)?;
        // The replicas of R and T are correlated: the sum's error is that of its complement.
        let e = Sampled { value: r.value + t.value, ..loss };
        Ok(vec![r, t, e, loss])
    }

    /// The path tracer has tables of GGX, and draws visible normals.
    fn traced(&self, variant: &Variant, x: &[f64]) -> Option<Trace<'_>> {
        let (smith, side) = (variant.smith.filter(|_| self.is_traced)?, variant.side?);
        Some(monte_carlo::traced_glass(smith, (self.lobe)(x[0]), monte_carlo::view(x[1]), (x[2], side)))
    }
}
