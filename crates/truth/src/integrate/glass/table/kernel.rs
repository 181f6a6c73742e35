//! E = R + T of one lobe from one direction, for a list of indices of refraction and both sides.

use super::effort::Effort;
use super::lobe::Lobe;
use super::reflect::Reflection;
use super::rules::Rules;
use super::stretch::{self, Seen};
use super::tabled::Tabled;
use super::transmit::Sweep;
use crate::integrate::glass::Side;
use crate::integrate::{IntegrateError, Path};
use crate::optics::Smith;
use crate::optics::distribution::Ggx;

/// Range of a cosine. The lower end leaves room below 1e-3, where lookups are judged, for the texel
/// that a lookup at that edge blends with.
pub const MU: [f64; 2] = [2e-4, 1.0];

/// Below this ior - 1 the limit stands: E has slopes up to 1e5 there (at grazing, where a
/// refraction by less than mu matters).
const STRAIGHT: f64 = 1e-14;

/// Reflected and transmitted energy, from outside and from inside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Reflected.
    pub r: [f64; 2],
    /// Transmitted.
    pub t: [f64; 2],
}

impl Energies {
    /// R + T from outside and from inside.
    pub fn e(&self) -> [f64; 2] {
        [self.r[0] + self.t[0], self.r[1] + self.t[1]]
    }
}

/// The integrals for one distribution, one shadowing form and one tolerance.
#[derive(Debug)]
pub struct Kernel<D = Ggx> {
    lobe: fn(f64) -> D,
    smith: Smith,
    effort: Effort,
    path: Path,
    /// The one side that is integrated; `None` for both.
    only: Option<Side>,
    rules: Rules,
    /// Values of rings to Legendre series: see [`Rules::series`].
    series: Vec<Vec<f64>>,
}

impl Kernel {
    /// A kernel of GGX of which E is within `tolerance` in [1e-8, 1e-2] for alpha in [4e-4, 1], mu in
    /// [`MU`] and ior in [1, 3].
    pub fn new(smith: Smith, tolerance: f64) -> Result<Kernel, IntegrateError> {
        Kernel::of(Ggx, smith, tolerance)
    }

    /// A kernel with more nodes on shorter panels than [`Kernel::new`]: for checks.
    pub fn finer(smith: Smith, tolerance: f64) -> Result<Kernel, IntegrateError> {
        let kernel = Kernel::new(smith, tolerance)?;
        let finer = kernel.effort.finer();
        kernel.with(finer)
    }
}

impl<D: Tabled> Kernel<D> {
    /// [`Kernel::new`] of a distribution.
    ///
    /// # Errors
    /// A tolerance outside [1e-8, 1e-2].
    pub fn of(lobe: fn(f64) -> D, smith: Smith, tolerance: f64) -> Result<Kernel<D>, IntegrateError> {
        let (effort, rules) = (Effort::of(tolerance)?, Rules::new());
        let effort = Effort { longest: D::PANEL * effort.longest, ..effort };
        let series = rules.series(effort.ring_panel);
        Ok(Kernel { lobe, smith, effort, path: Path::Best, only: None, rules, series })
    }

    /// The same kernel on another compiled form of its loops: the results are the same bits.
    pub fn on(self, path: Path) -> Kernel<D> {
        Kernel { path, ..self }
    }

    /// The same kernel for one side; the energies of the other are NaN.
    pub fn only(self, side: Side) -> Kernel<D> {
        Kernel { only: Some(side), ..self }
    }

    /// Its numbers of nodes.
    pub fn effort(&self) -> Effort {
        self.effort
    }

    /// The same kernel with other numbers of nodes: for studies of convergence.
    ///
    /// # Errors
    /// [`IntegrateError::Option`] for an effort outside what [`Effort`] states.
    pub fn with(self, effort: Effort) -> Result<Kernel<D>, IntegrateError> {
        effort.check()?;
        let series = self.rules.series(effort.ring_panel);
        Ok(Kernel { effort, series, ..self })
    }

    /// R and T from both sides for every index of refraction into `out`, of the same length;
    /// returns the number of integrand evaluations.
    pub fn energies(
        &self,
        alpha: f64,
        mu: f64,
        iors: &[f64],
        out: &mut [Energies],
    ) -> Result<u64, IntegrateError> {
        check(D::QUANTITY, alpha, mu, iors)?;
        let lobe = Lobe::new(self.smith, (self.lobe)(alpha), mu);
        let Kernel { effort, path, rules, series, .. } = self;
        let rings = Reflection::new(&lobe, effort, rules, series, *path);
        let mut sweep = Sweep::with_capacity(6 * effort.panel * iors.len());
        let mut ends = Vec::with_capacity(2 * iors.len());
        let is_wanted = |side: Side| self.only.is_none_or(|only| only == side);
        for ior in iors {
            for (side, seen) in [(Side::Outside, Seen::outside(*ior)), (Side::Inside, Seen::inside(*ior))] {
                if is_wanted(side) && ior - 1.0 >= STRAIGHT {
                    for stretch in stretch::stretches(&lobe, seen).iter().flatten() {
                        stretch::append(&mut sweep, stretch, seen, effort, rules);
                    }
                }
                ends.push(sweep.u.len());
            }
        }
        sweep.pad();
        let mut values = Vec::with_capacity(sweep.u.len());
        let evaluations = path.transmit(&lobe, rules, effort.azimuth, &sweep, &mut values);
        let mut start = 0;
        for ((ior, ends), e) in iors.iter().zip(ends.chunks(2)).zip(out) {
            let transmitted =
                [values[start..ends[0]].iter().sum::<f64>(), values[ends[0]..ends[1]].iter().sum()];
            start = ends[1];
            if ior - 1.0 < STRAIGHT {
                let lambda = lobe.facets.lambda(mu);
                *e = Energies { r: [0.0; 2], t: [self.smith.lit_given_visible(lambda, lambda); 2] };
                continue;
            }
            let passed = |side: Side| match side {
                _ if !is_wanted(side) => f64::NAN,
                Side::Outside => rings.passed_outside(Seen::outside(*ior), *path),
                Side::Inside => rings.passed_inside(&lobe, Seen::inside(*ior), (effort, rules), *path),
            };
            *e = Energies { r: Side::ALL.map(|side| rings.whole - passed(side)), t: transmitted };
        }
        Ok(evaluations + rings.evaluations)
    }
}

impl<D: Tabled> Kernel<D> {
    /// R alone, from one side, for every index of refraction into `out`, of the same length: the rings
    /// without the transmitted energy, in a twentieth of the time. Returns the number of integrand
    /// evaluations.
    ///
    /// # Errors
    /// As [`Kernel::energies`].
    pub fn reflected(
        &self,
        [alpha, mu]: [f64; 2],
        iors: &[f64],
        side: Side,
        out: &mut [f64],
    ) -> Result<u64, IntegrateError> {
        check(D::QUANTITY, alpha, mu, iors)?;
        let lobe = Lobe::new(self.smith, (self.lobe)(alpha), mu);
        let Kernel { effort, path, rules, series, .. } = self;
        let rings = Reflection::new(&lobe, effort, rules, series, *path);
        for (ior, r) in iors.iter().zip(out) {
            *r = match side {
                _ if ior - 1.0 < STRAIGHT => 0.0,
                Side::Outside => rings.whole - rings.passed_outside(Seen::outside(*ior), *path),
                Side::Inside => {
                    let seen = Seen::inside(*ior);
                    rings.whole - rings.passed_inside(&lobe, seen, (effort, rules), *path)
                }
            };
        }
        Ok(rings.evaluations)
    }
}

/// Whether a kernel's domain holds these.
pub fn covers(alpha: f64, mu: f64, iors: &[f64]) -> bool {
    check("", alpha, mu, iors).is_ok()
}

/// Refuses inputs outside the domain.
fn check(quantity: &'static str, alpha: f64, mu: f64, iors: &[f64]) -> Result<(), IntegrateError> {
    // A roughness rounded to f32 may make an alpha just below 4e-4.
    let widths = [
        ("alpha", alpha, (3.99e-4..=1.0).contains(&alpha), "is outside [4e-4, 1] of a table"),
        ("mu", mu, (MU[0]..=MU[1]).contains(&mu), "is outside [2e-4, 1] of a table"),
    ];
    let of_ior = |ior: &f64| ("ior", *ior, (1.0..=3.0).contains(ior), "is outside [1, 3] of a table");
    IntegrateError::outside(quantity, widths.into_iter().chain(iors.iter().map(of_ior)))
}
