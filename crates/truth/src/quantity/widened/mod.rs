//! Which roughness stands for a lobe that something widens: normals that a texel averages
//! (`averaged-width`), a light that is a disk (`lit-width`), a coat above (`coated-width`).
//!
//! The lobe of a surface is the light that GGX facets mirror, with height-correlated shadowing and
//! F = 1, weighted by the cosine: f(v, l) (n.l). What widens it turns each light away and takes some of
//! it. About the mirror direction of the view, `radius` is the angle of the cone that holds half of the
//! widened lobe's energy. The first output is the roughness r' whose own lobe, of the same view and with
//! alpha = r'^2, holds half of its energy within the same cone; it is 1 where no lobe is wide enough.
//! Where nothing widens, r' is the surface's roughness for every view. Half of the energy is a measure
//! that the tails of GGX leave finite, where a variance is infinite.
//!
//! Values are means over sequences with random shifts of their own in every dimension; `error` is three
//! standard errors of the mean by their spread, of `normalisation` as a part of it. Lobe and bare lobe are
//! drawn by the same numbers, whose errors cancel in r' where
//! little is widened. Many points come from one interpolant over the whole domain.

mod averaged;
mod coated;
mod lit;

use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

pub use averaged::AVERAGED_WIDTH;
pub use coated::COATED_WIDTH;
pub use lit::{LIGHT, LIT_WIDTH};

use super::{Asked, Facts, Input, Quantity, Seen, Truth, Use, Variant};
use crate::integrate::IntegrateError;
use crate::integrate::count;
use crate::integrate::monte_carlo::shadowing;
use crate::optics::Smith;
use crate::optics::ggx::{self, Vec3};
use lobefit_math::recurrence::Recurrence;
use lobefit_math::{chebyshev, ops, sum, vector};

/// The form of the shadowing.
const SMITH: Smith = Smith::Correlated;

/// Inputs that all have.
const ALPHA: Input = Input { domain: [1e-4, 1.0], usual: [1e-4, 1.0], ..super::ALPHA };
const MU: Input = Input { domain: [0.01, 1.0], ..super::MU };

/// Numbers that a light is drawn with.
pub(super) const DIMENSIONS: usize = 6;
type Draw = [f64; DIMENSIONS];

/// A light and its energy; none where it is lost.
type Light = Option<(Vec3, f64)>;

/// Lights of a lobe.
type Lights = Box<dyn Fn(&Draw) -> Light + Sync>;

/// What all of them have.
const FACTS: Facts = Facts { tolerance: TOLERANCE, smallest_alpha: ALPHA.domain[0], ..Facts::NONE };

/// What widens a lobe.
pub struct Widened {
    /// The inputs are alpha, mu, and how much it widens.
    facts: Facts,
    /// The lights of a view.
    lights: fn(Vec3, &[f64]) -> Lights,
    /// Another value of the bare lobe, where there is one.
    beside: Option<Beside>,
    /// Nodes of the interpolant along the inputs, lights at each, and the error of many points.
    nodes: &'static [usize],
    drawn: usize,
    quick: f64,
    known: OnceLock<Tensor>,
}

/// A value of the means of the bare lobe.
struct Beside {
    of: fn(&[f64], Means) -> f64,
    used: &'static [Use],
}

/// Means over the lights of a bare lobe: of the cotangent of the angle to the mirror direction by energy, and
/// of
/// the energy of a light that is drawn.
struct Means {
    cotangent: f64,
    energy: f64,
}

/// The largest error of a value where no less is asked for.
const TOLERANCE: f64 = 1e-2;

/// The sequence as it is.
const UNMOVED: Draw = [0.0; DIMENSIONS];

/// Shifts of the sequences of a mean, independent of one another.
static MOVED: LazyLock<[Draw; SHIFTS]> = LazyLock::new(|| {
    let mut random = Pcg64::seed_from_u64(6);
    std::array::from_fn(|_| std::array::from_fn(|_| random.random()))
});

/// Shifted sequences of a mean, the first and the last number of lights of each.
const SHIFTS: usize = 8;
const FIRST: usize = 1 << 8;
const LAST: usize = 1 << 16;

/// Nodes of the interpolant of bare lobes, and lights there.
const BARE: [usize; 2] = [20, 12];
const AT_BARE: usize = 1 << 12;
const AT_MEANS: usize = 1 << 15;

/// Bins of ln(tan(theta/2)), from ln(NARROWEST) on.
const BINS: usize = 1 << 14;
const NARROWEST: f64 = 1e-7;
const BIN: f64 = 2e-3;

/// The view of a cosine.
pub(super) fn view(mu: f64) -> Vec3 {
    [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]
}

/// The light of a facet that mirrors a view, drawn by two numbers, with its energy.
pub(super) fn mirrored(alpha: f64, view: Vec3, u: f64, v: f64) -> Light {
    let light = ggx::mirror(view, ggx::visible_normal([alpha; 2], view, u, v)).0;
    (light[2] > 0.0).then(|| (light, shadowing(SMITH, [alpha; 2], view, light).0))
}

/// The direction at 1 - cos = `fall` from an axis, a part `turn` of a turn about it.
fn tilted(axis: Vec3, fall: f64, turn: f64) -> Vec3 {
    let (sine, (y, x)) = ((fall * (2.0 - fall)).max(0.0).sqrt(), ops::sincos(2.0 * PI * turn));
    vector::turned(axis, vector::tangents(axis), [sine * x, sine * y, 1.0 - fall])
}

/// The energy of lights by their angle to an axis.
struct Spread {
    bins: Vec<f64>,
    energy: f64,
    drawn: usize,
}

impl Spread {
    /// Of so many lights about an axis, drawn by a sequence with a shift.
    fn new(axis: Vec3, drawn: usize, shift: &Draw, light: impl Fn(&Draw) -> Light) -> Spread {
        let sequence = Recurrence::new(DIMENSIONS);
        count::add(drawn);
        let mut spread = Spread { bins: vec![0.0; BINS], energy: 0.0, drawn };
        for i in 0..drawn {
            let draw = std::array::from_fn(|k| {
                let x = sequence.coordinate(i, k) + shift[k];
                x - x.floor()
            });
            let Some((light, energy)) = light(&draw) else { continue };
            let length = |sign: f64| (0..3).map(|k| light[k] + sign * axis[k]).map(|x| x * x).sum::<f64>();
            let bin = (0.5 * ops::log(length(-1.0) / length(1.0)) - ops::log(NARROWEST)) / BIN;
            spread.bins[bin.clamp(0.0, (BINS - 1) as f64) as usize] += energy;
            spread.energy += energy;
        }
        spread
    }

    /// tan(theta/2) of the cone of half of the energy.
    fn middle(&self) -> f64 {
        let mut left = 0.5 * self.energy;
        for (k, energy) in self.bins.iter().enumerate() {
            if left <= *energy {
                return tangent(k as f64 + left / energy);
            }
            left -= energy;
        }
        tangent(BINS as f64)
    }

    /// What is interpolated of it.
    fn root(&self) -> f64 {
        self.middle().sqrt()
    }

    fn means(&self) -> Means {
        let filled = self.bins.iter().enumerate().filter(|(_, energy)| **energy > 0.0);
        let cotangent = |t: f64| 0.5 * (1.0 - t * t) / t;
        let sum = filled.map(|(k, energy)| energy * cotangent(tangent(k as f64 + 0.5))).sum::<f64>();
        Means { cotangent: sum / self.energy, energy: self.energy / self.drawn as f64 }
    }
}

fn tangent(bin: f64) -> f64 {
    NARROWEST * ops::exp(BIN * bin)
}

/// The bare lobe.
fn bare([alpha, mu]: [f64; 2], drawn: usize, shift: &Draw) -> Spread {
    let view = view(mu);
    Spread::new([-view[0], 0.0, view[2]], drawn, shift, |u| mirrored(alpha, view, u[0], u[1]))
}

/// The alpha in [1e-4, 1] at which a rising function is 0, sought between two places if it is there.
fn rising(between: [f64; 2], f: &dyn Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = between.map(|x| x.clamp(ALPHA.domain[0], 1.0));
    let [mut below, mut above] = [low, high].map(f);
    if (below > 0.0 || above < 0.0) && between != ALPHA.domain {
        return rising(ALPHA.domain, f);
    }
    for _ in 0..STEPS {
        // The line between both ends, by the logarithm; off either, so that both come nearer.
        let next = low * ops::pow(high / low, (below / (below - above)).clamp(0.05, 0.95));
        let off = f(next);
        if off.abs() <= SOUGHT || high - low <= SOUGHT * low {
            return next;
        }
        if off > 0.0 {
            (high, above) = (next, off);
        } else {
            (low, below) = (next, off);
        }
    }
    high
}

/// Steps to it, far more than are taken, and how near in the logarithm.
const STEPS: usize = 60;
const SOUGHT: f64 = 1e-4;

/// An interpolant over a box.
struct Tensor {
    nodes: Vec<Vec<f64>>,
    values: Vec<f64>,
}

impl Tensor {
    /// The interpolant over the inputs before those that are given, the last ones.
    fn of_last(&self, place: &[f64]) -> Tensor {
        let first = self.nodes.len() - place.len();
        let mut values = self.values.clone();
        for (nodes, x) in self.nodes[first..].iter().zip(place).rev() {
            let weights = chebyshev::weights(nodes, x.clamp(nodes[0], nodes[nodes.len() - 1]));
            let row = |row: &[f64]| row.iter().zip(&weights).map(|(value, weight)| value * weight).sum();
            values = values.chunks(nodes.len()).map(row).collect();
        }
        Tensor { nodes: self.nodes[..first].to_vec(), values }
    }

    fn at(&self, place: &[f64]) -> f64 {
        self.of_last(place).values[0]
    }
}

/// The root of tan(theta/2) of a spread's middle, of bare lobes.
static BARE_ROOTS: LazyLock<Tensor> = LazyLock::new(|| {
    let [roots] = tabulated(&[ALPHA, MU], &BARE, |x| [bare([x[0], x[1]], AT_BARE, &UNMOVED).root()]);
    roots
});

/// ln(alpha cotangent) and the energy, of the means of bare lobes.
static BARE_MEANS: LazyLock<[Tensor; 2]> = LazyLock::new(|| {
    tabulated(&[ALPHA, MU], &BARE, |x| {
        let Means { cotangent, energy } = bare([x[0], x[1]], AT_MEANS, &UNMOVED).means();
        [ops::log(x[0] * cotangent), energy]
    })
});

/// The alpha of the bare lobe of a root of tan(theta/2), from their interpolant.
fn quick_alpha(root: f64, mu: f64) -> f64 {
    let roots = BARE_ROOTS.of_last(&[mu.sqrt()]);
    let off = |alpha: f64| 2.0 * ops::log(roots.at(&[alpha.sqrt()]) / root);
    rising(ALPHA.domain, &off)
}

/// An input as the interpolant has it, in which widths are nearly linear, and back.
fn coordinate(name: &str, x: f64) -> f64 {
    match name {
        "mean_length" => (1.0 - x).max(0.0).sqrt().sqrt(),
        "alpha" | "mu" | "light_radius" => x.sqrt(),
        _ => x,
    }
}
fn value(name: &str, x: f64) -> f64 {
    match name {
        "mean_length" => 1.0 - x * x * x * x,
        "alpha" | "mu" | "light_radius" => x * x,
        _ => x,
    }
}

/// Nodes of inputs, and values at their product.
fn tabulated<const N: usize>(
    inputs: &[Input],
    counts: &[usize],
    at: impl Fn(&[f64]) -> [f64; N] + Sync,
) -> [Tensor; N] {
    let ends = |input: &Input| input.domain.map(|x| coordinate(input.name, x));
    let nodes: Vec<Vec<f64>> = (inputs.iter().map(ends).zip(counts))
        .map(|([a, b], count)| chebyshev::nodes(a.min(b), a.max(b), *count))
        .collect();
    let place = |mut i: usize| {
        let mut x: Vec<f64> = (nodes.iter().zip(inputs).rev())
            .map(|(nodes, input)| {
                let node = nodes[i % nodes.len()];
                i /= nodes.len();
                value(input.name, node).clamp(input.domain[0], input.domain[1])
            })
            .collect();
        x.reverse();
        at(&x)
    };
    let all: Vec<[f64; N]> = (0..counts.iter().product()).into_par_iter().map(place).collect();
    std::array::from_fn(|k| Tensor { nodes: nodes.clone(), values: all.iter().map(|row| row[k]).collect() })
}

impl Widened {
    /// The lights of the lobe of inputs, each by the numbers that it is drawn with.
    pub(super) fn lights(&self, x: &[f64]) -> Lights {
        (self.lights)(view(x[1]), x)
    }

    /// The lobe of inputs.
    fn spread(&self, x: &[f64], drawn: usize, shift: &Draw) -> Spread {
        let view = view(x[1]);
        Spread::new([-view[0], 0.0, view[2]], drawn, shift, self.lights(x))
    }

    /// Roughness, radius, and the value beside them, by one sequence.
    fn by(&self, x: &[f64], drawn: usize, shift: &Draw) -> Vec<f64> {
        let middle = self.spread(x, drawn, shift).middle();
        let off = |alpha: f64| ops::log(bare([alpha, x[1]], drawn, shift).middle() / middle);
        let guess = quick_alpha(middle.sqrt(), x[1]);
        let alpha = rising([0.95 * guess, 1.05 * guess], &off);
        let mut values = vec![alpha.sqrt(), 2.0 * ops::atan(middle)];
        values.extend(self.beside.as_ref().map(|own| (own.of)(x, bare([x[0], x[1]], drawn, shift).means())));
        values
    }

    /// The interpolant of the root, made at the first call.
    fn known(&self) -> &Tensor {
        self.known.get_or_init(|| {
            let [roots] =
                tabulated(self.facts.inputs, self.nodes, |x| [self.spread(x, self.drawn, &UNMOVED).root()]);
            roots
        })
    }

    /// The outputs of many points, but for the error.
    fn quick(&self, x: &[f64]) -> Vec<f64> {
        let place: Vec<f64> =
            x.iter().zip(self.facts.inputs).map(|(x, input)| coordinate(input.name, *x)).collect();
        let root = self.known().at(&place);
        let mut values = vec![quick_alpha(root, x[1]).sqrt(), 2.0 * ops::atan(root * root)];
        values.extend(self.beside.as_ref().map(|own| {
            let [cotangent, energy] = BARE_MEANS.each_ref().map(|means| means.at(&place[..2]));
            (own.of)(x, Means { cotangent: ops::exp(cotangent) / x[0], energy })
        }));
        values
    }

    /// A place beyond an end by rounding, on it.
    fn inside(&self, x: &[f64]) -> Vec<f64> {
        let inputs = self.facts.inputs.iter().zip(x);
        inputs.map(|(input, x)| x.clamp(input.domain[0], input.domain[1])).collect()
    }

    fn check(&self, x: &[f64]) -> Result<(), IntegrateError> {
        let checked = |(input, &value): (&Input, &f64)| {
            let [low, high] = input.domain;
            let inside = (low * (1.0 - super::ROUNDED)..=high * (1.0 + super::ROUNDED)).contains(&value);
            (input.name, value, inside, "is outside the quantity's domain")
        };
        IntegrateError::outside(self.facts.name, self.facts.inputs.iter().zip(x).map(checked))
    }
}

impl Quantity for Widened {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn seen(&self) -> Option<&dyn Seen> {
        Some(self)
    }

    fn uses(&self, column: &str) -> &'static [Use] {
        let beside = self.beside.as_ref().filter(|_| self.facts.outputs[2] == column);
        beside.map_or(&[Use::VALUE], |own| own.used)
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        self.check(x)?;
        let x = &self.inside(x);
        let place = || format!("{x:?}");
        let (mut drawn, mut reached) = (FIRST, f64::INFINITY);
        while drawn <= LAST {
            let all: Vec<Vec<f64>> = MOVED.iter().map(|shift| self.by(x, drawn, shift)).collect();
            let column = |k: usize| all.iter().map(|row| row[k]).collect::<Vec<f64>>();
            let columns: Vec<Vec<f64>> = (0..all[0].len()).map(column).collect();
            // What is beside them may be far below 1, and is a factor: its error is relative.
            let scale = |(k, column): (usize, &Vec<f64>)| if k < 2 { 1.0 } else { sum::mean(column) };
            let error = |at: (usize, &Vec<f64>)| 3.0 * sum::standard_error(at.1) / scale(at);
            reached = columns.iter().enumerate().map(error).fold(0.0, f64::max);
            if columns.iter().flatten().any(|value| !value.is_finite()) {
                return Err(IntegrateError::NotFinite { quantity: self.facts.name, place: place() });
            }
            if reached <= tolerance {
                return Ok(columns.iter().map(|column| sum::mean(column)).chain([reached]).collect());
            }
            drawn *= 4;
        }
        Err(IntegrateError::Tolerance { quantity: self.facts.name, place: place(), reached, tolerance })
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        if asked.tolerance < self.quick || asked.wants(&["error"]) {
            return Ok(None);
        }
        let (places, inputs) = (asked.places(self)?, asked.inputs(self)?);
        let one = |i: usize| {
            let x: Vec<f64> = inputs.iter().flatten().map(|column| column[i]).collect();
            self.check(&x)?;
            Ok(self.quick(&x))
        };
        let rows: Vec<Vec<f64>> =
            (0..asked.points.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let columns = places.iter().map(|place| rows.iter().map(|row| row[*place]).collect()).collect();
        Ok(Some(Truth { columns, error: self.quick, evaluations: rows.len() as u64 }))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        self.quick
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        if outputs.contains(&"error") { 2e4 } else { 2e3 }
    }
}
