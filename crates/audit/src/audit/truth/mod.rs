//! The truth of a quantity over whole tensors of inputs, fast enough to try thousands of
//! conventions.

mod beyond;
mod knots;
mod spec;

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use rayon::prelude::*;

use super::axis::Input;
use super::column::Base;
use super::lobe::{Form, Lobe};
use super::{AuditError, work};
pub use beyond::Beyond;
use knots::along;
use lobefit::effects::table::aspect;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Choice, GGX_REFLECTION, Quantity};
pub(super) use spec::{Spec, averaged, spec, with_azimuth};

/// What columns are made of at every combination of the inputs given, the first input fastest.
pub(super) type Values = Vec<Base>;

/// Values of a lobe at every combination of inputs.
pub(super) type Truths<'a> = fn(&Truth<'a>, usize, &[&[f64]]) -> Result<Values, AuditError>;

/// What is known of a lobe of a quantity, of its averages or a slice of it, with so many knots.
type OfLobe = ((&'static str, bool, Option<(Input, f64)>, usize, Lobe), Arc<Known>);

/// What is integrated once for all audits of a process: for every channel, encoding and reading that
/// asks for it.
static KNOWN: Mutex<Vec<OfLobe>> = Mutex::new(Vec::new());

/// Values of a lobe.
#[derive(Default)]
struct Known {
    at_knots: Values,
    /// Beyond the knots, by the bits of the inputs: readings share an edge.
    outer: Mutex<BTreeMap<Vec<u64>, Base>>,
}

/// How near to 1 an index of refraction is one.
const NO_INTERFACE: f64 = 1e-7;

/// Fewest points of glass that share their work.
const SHARED: usize = 256;

/// Most values beyond the knots that are kept.
const OUTER: usize = 1 << 16;

/// A quantity's truth.
pub(super) struct Truth<'a> {
    /// How the quantity's own lobe is integrated.
    pub spec: Spec<'a>,
    /// The lobes to be tried.
    pub lobes: Vec<Lobe>,
    /// How each of the lobes is integrated.
    pub specs: Vec<Spec<'a>>,
    /// What is known of each lobe; nothing of a quantity without knots.
    known: Vec<Arc<Known>>,
    /// Ranges of inputs that are asked for.
    domain: Vec<(Input, [f64; 2])>,
}

impl<'a> Truth<'a> {
    /// The truth of the lobes of these forms and sides; a rough one has few knots, for a sieve of lobes of
    /// which most are not meant: its quick values alone are of use.
    pub(super) fn new(
        spec: Spec<'a>,
        forms: &[&'static Form],
        sides: &[Side],
        is_rough: bool,
    ) -> Result<Truth<'a>, AuditError> {
        let mut lobes = Lobe::of(spec.quantity, forms, sides);
        // A slice has no axis of an index, so no lobe of both sides.
        lobes.retain(|lobe| !lobe.both || spec.inputs.contains(&Input::Ior));
        let of = |lobe: &Lobe| spec.of_form(lobe.form);
        let specs = lobes.iter().map(|l| if is_rough { of(l).rough() } else { of(l) }).collect();
        let mut truth = Truth { spec, lobes, specs, known: Vec::new(), domain: Vec::new() };
        if !spec.knots.is_empty() {
            let of =
                |lobe: usize| if truth.lobes[lobe].both { Ok(Arc::default()) } else { truth.at_knots(lobe) };
            truth.known = (0..truth.lobes.len()).map(of).collect::<Result<_, _>>()?;
        }
        Ok(truth)
    }

    /// The values of a lobe at the knots. They are not made under the lock: a thread that waits for
    /// others in it may be given another audit.
    fn at_knots(&self, lobe: usize) -> Result<Arc<Known>, AuditError> {
        let count = self.specs[lobe].knots.iter().map(|knots| knots.count).sum();
        let Spec { quantity, averaged, at, .. } = self.spec;
        let key = (quantity.name(), averaged, at, count, self.lobes[lobe]);
        let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().iter().find(|(known, _)| *known == key).map(|(_, known)| known.clone());
        if let Some(known) = found {
            return Ok(known);
        }
        let Spec { knots, tolerances, .. } = self.specs[lobe];
        let knots: Vec<Vec<f64>> = knots.iter().map(|knots| knots.inputs()).collect();
        let at: Vec<&[f64]> = knots.iter().map(Vec::as_slice).collect();
        let at_knots = self.integrated(lobe, self.product(&at), tolerances[0])?;
        let own = Arc::new(Known { at_knots, outer: Mutex::default() });
        known().push((key, own.clone()));
        Ok(own)
    }

    /// Range of an input of a lobe; texels outside are not judged. From both sides an index below 1 is
    /// its inverse, from inside.
    pub(super) fn range(&self, lobe: usize, input: Input) -> [f64; 2] {
        let [low, high] = self.specs[lobe].range(input);
        if self.lobes[lobe].both && input == Input::Ior { [1.0 / high, high] } else { [low, high] }
    }

    /// The same, judged in ranges of its inputs alone.
    pub(super) fn within(self, domain: &[(Input, [f64; 2])]) -> Truth<'a> {
        Truth { domain: domain.to_vec(), ..self }
    }

    /// Whether a texel with this value of an input is judged of a lobe.
    pub(super) fn judges(&self, lobe: usize, input: Input, x: f64) -> bool {
        self.beyond(lobe, input, x).is_none()
    }

    /// Why a texel with this value of an input is not judged of a lobe; `None` of one that is.
    pub(super) fn beyond(&self, lobe: usize, input: Input, x: f64) -> Option<Beyond> {
        let asked = |(own, [low, high]): &(Input, [f64; 2])| *own != input || (*low..=*high).contains(&x);
        let [low, high] = self.range(lobe, input);
        let Spec { mirror_only, narrowest, .. } = self.specs[lobe];
        let narrow = input == Input::Alpha && mirror_only && x > 0.0 && x < narrowest;
        let causes = [
            (!self.domain.iter().all(asked), Beyond::Asked),
            (input == Input::Ior && (x - 1.0).abs() < NO_INTERFACE, Beyond::NoInterface),
            (x < low, Beyond::Below(input, low)),
            (x > high, Beyond::Above(input, high)),
            (narrow, Beyond::Narrow(narrowest)),
        ];
        causes.into_iter().find(|(holds, _)| *holds).map(|(_, cause)| cause)
    }

    /// Values within about 1e-3, for trying many conventions; inputs are moved into the range.
    pub(super) fn quick(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        if let Some(halves) = self.halves(lobe, at, Truth::quick) {
            return halves;
        }
        let Some(known) = self.known.get(lobe) else { return self.exact(lobe, at) };
        let knots = self.specs[lobe].knots;
        let mut values: Values = known.at_knots.clone();
        for (k, (knots_of, at)) in knots.iter().zip(at).enumerate().rev() {
            let step = knots[..k].iter().map(|faster| faster.count).product();
            values = along(knots_of, at, step, &values);
        }
        Ok(values)
    }

    /// Values to rank conventions and judge lookups by: exact ones, where these cost little.
    pub(super) fn ranked(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        if self.specs[lobe].costly { self.quick(lobe, at) } else { self.exact(lobe, at) }
    }

    /// Values within the bound of a lobe; inputs lie in the range.
    pub(super) fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        if let Some(halves) = self.halves(lobe, at, Truth::exact) {
            return halves;
        }
        let Spec { knots, tolerances: [_, tolerance], interpolated, .. } = self.specs[lobe];
        let points = self.product(at);
        if !interpolated {
            return self.integrated(lobe, points, tolerance);
        }
        let mut values = self.quick(lobe, at)?;
        let inside = |i: usize| {
            let mut inputs = points.columns().zip(knots);
            inputs.all(|((_, x), knots)| (knots.range[0]..=knots.range[1]).contains(&x[i]))
        };
        let key = |i: usize| points.columns().map(|(_, x)| x[i].to_bits()).collect::<Vec<u64>>();
        let outer = || self.known[lobe].outer.lock().unwrap_or_else(PoisonError::into_inner);
        let mut missing = vec![false; points.len()];
        {
            let outer = outer();
            for i in (0..points.len()).filter(|i| !inside(*i)) {
                match outer.get(&key(i)) {
                    Some(known) => values[i] = *known,
                    None => missing[i] = true,
                }
            }
        }
        let integrated = self.integrated(lobe, points.marked(&missing), tolerance)?;
        let mut outer = outer();
        for (i, value) in (0..points.len()).filter(|i| missing[*i]).zip(integrated) {
            values[i] = value;
            if outer.len() < OUTER {
                outer.insert(key(i), value);
            }
        }
        Ok(values)
    }

    /// The same at single points, whose inputs are in the order of its specification.
    pub(super) fn at(&self, lobe: usize, points: &[Vec<(&'static str, f64)>]) -> Result<Values, AuditError> {
        let column = |k: usize| points.iter().map(|point| point[k].1).collect::<Vec<f64>>();
        if self.specs[lobe].interpolated {
            let one = |point: &Vec<(&str, f64)>| {
                let at: Vec<[f64; 1]> = point.iter().map(|(_, x)| [*x]).collect();
                Ok(self.exact(lobe, &at.iter().map(<[f64; 1]>::as_slice).collect::<Vec<_>>())?[0])
            };
            return points.iter().map(one).collect();
        }
        let columns = self.spec.inputs.iter().enumerate().map(|(k, input)| (input.name(), column(k)));
        self.integrated(lobe, Points::new(columns), self.specs[lobe].tolerances[1])
    }

    /// Of a lobe of both sides the values of each, put together along the index, which is the first
    /// input; none of every other lobe.
    fn halves(&self, lobe: usize, at: &[&[f64]], values: Truths<'a>) -> Option<Result<Values, AuditError>> {
        let own = self.lobes[lobe];
        let of = |side| self.lobes.iter().position(|l| *l == Lobe { side: Some(side), both: false, ..own });
        let sides = own.both.then(|| Some([of(Side::Inside)?, of(Side::Outside)?])).flatten()?;
        let iors = at[0];
        let (inside, outside): (Vec<f64>, Vec<f64>) = iors.iter().partition(|ior| **ior < 1.0);
        let inverse: Vec<f64> = inside.iter().map(|x| 1.0 / x).collect();
        let part = |(lobe, iors): (usize, &[f64])| -> Result<Values, AuditError> {
            let at: Vec<&[f64]> = [iors].into_iter().chain(at[1..].iter().copied()).collect();
            if iors.is_empty() { Ok(Vec::new()) } else { values(self, lobe, &at) }
        };
        let parts = [(sides[0], inverse.as_slice()), (sides[1], outside.as_slice())].map(part);
        let lines: usize = at[1..].iter().map(|list| list.len()).product();
        Some(match parts {
            [Ok(inside), Ok(outside)] => {
                let mut parts = [inside.into_iter(), outside.into_iter()];
                let line = |_| iors.iter().map(|ior| usize::from(*ior >= 1.0));
                Ok((0..lines).flat_map(line).filter_map(|side| parts[side].next()).collect())
            }
            [Err(error), _] | [_, Err(error)] => Err(error),
        })
    }

    /// Every combination of inputs, by the audit's names.
    fn product(&self, at: &[&[f64]]) -> Points {
        let named: Vec<(&str, &[f64])> =
            self.spec.inputs.iter().zip(at).map(|(input, at)| (input.name(), *at)).collect();
        Points::product(&named)
    }

    /// Base values at points whose columns bear the audit's names.
    fn integrated(&self, lobe: usize, points: Points, tolerance: f64) -> Result<Values, AuditError> {
        let points = match self.spec.at {
            Some((input, x)) => {
                let column = vec![x; points.len()];
                points.with(input.name(), column)
            }
            None => points,
        };
        if self.specs[lobe].averaged {
            return self.averaged(lobe, &points, tolerance);
        }
        self.at_points(lobe, points, tolerance)
    }

    /// Averages over the cosine, weighted with it, by a rule over its root: twice the integral of
    /// E mu dmu.
    fn averaged(&self, lobe: usize, points: &Points, tolerance: f64) -> Result<Values, AuditError> {
        static RULE: LazyLock<Gauss> = LazyLock::new(|| Gauss::new(32));
        let (count, nodes) = (points.len(), RULE.nodes.len());
        let root = |k: usize| 0.5 + 0.5 * RULE.nodes[k];
        // All at once: neighbours share work. Below the least cosine that is judged next to nothing weighs.
        let least = self.range(lobe, Input::Mu)[0];
        let mu = |k: usize| (root(k) * root(k)).max(least);
        let repeated = points.columns().map(|(name, column)| (name, column.repeat(nodes)));
        let mus = (0..nodes).flat_map(|k| std::iter::repeat_n(mu(k), count)).collect();
        let all = Points::new(repeated).with(Input::Mu.name(), mus);
        let values = self.at_points(lobe, all, tolerance)?;
        let mut out = vec![[0.0; 3]; count];
        for (i, value) in values.into_iter().enumerate() {
            let root = root(i / count);
            let weight = 0.5 * RULE.weights[i / count] * 4.0 * root * root * root;
            out[i % count].iter_mut().zip(value).for_each(|(sum, v)| *sum += weight * v);
        }
        Ok(out)
    }

    fn at_points(&self, lobe: usize, points: Points, tolerance: f64) -> Result<Values, AuditError> {
        let Spec { quantity, outputs, normal, .. } = self.specs[lobe];
        let variant = self.lobes[lobe].variant();
        let iors = points.column(Input::Ior.name()).map(<[f64]>::to_vec);
        let count = points.len();
        work::integrated(count);
        let points = filled(quantity, self.inside(lobe, points));
        let mut columns = quantity.truth(&variant, &points, outputs, tolerance)?.columns;
        if normal {
            let ones = vec![1.0; points.len()];
            columns.extend(GGX_REFLECTION.truth(&variant, &points.with("mu", ones), &["E"], 1e-7)?.columns);
        }
        let second = |i: usize| columns.get(1).map_or(0.0, |column| column[i]);
        let scale = |i: usize| {
            let eta = |ior: f64| if self.lobes[lobe].side == Some(Side::Inside) { ior } else { 1.0 / ior };
            iors.as_ref().map_or(0.0, |iors| eta(iors[i]) * eta(iors[i]))
        };
        Ok((0..count).map(|i| [columns[0][i], second(i), scale(i)]).collect())
    }

    /// Points with the columns of what integrates a lobe, moved into its domain.
    fn inside(&self, lobe: usize, points: Points) -> Points {
        let Spec { quantity, narrowest, .. } = self.specs[lobe];
        let named = |name: &str| points.column(name).map(<[f64]>::to_vec);
        let widths = |power: f64| -> Option<Vec<f64>> {
            let (alphas, anisotropies) = (points.column("alpha")?, points.column("anisotropy")?);
            let width = |(alpha, a): (&f64, &f64)| {
                (alpha.max(narrowest) * ops::pow(aspect(*a), power)).max(narrowest)
            };
            Some(alphas.par_iter().zip(anisotropies).map(width).collect())
        };
        let phi = |square: &f64| ops::atan2((1.0 - square).sqrt(), square.sqrt());
        let of = |name: &str| match name {
            "alpha_x" => widths(-1.0),
            "alpha_y" => widths(1.0),
            "phi" => named(Input::Azimuth.name()).map(|squares| squares.iter().map(phi).collect()),
            name => named(name),
        };
        let narrow = |x: f64| if x < narrowest { 0.0 } else { x };
        let column = |input: &lobefit_truth::quantity::Input| {
            let [low, high] = input.domain;
            let column = of(input.name)?;
            let moved = |x: f64| if input.name == "alpha" { narrow(x) } else { x }.clamp(low, high);
            Some((input.name, column.into_iter().map(moved).collect::<Vec<f64>>()))
        };
        Points::new(quantity.inputs().iter().filter_map(column))
    }
}

/// Points of a quantity with sides, as many at least as share their work: fewer are integrated one by one,
/// for a hundred times as long. Copies of the last are added.
fn filled(quantity: &dyn Quantity, points: Points) -> Points {
    let missing = SHARED.saturating_sub(points.len());
    if !quantity.has(Choice::Side) || points.is_empty() || missing == 0 {
        return points;
    }
    let column = |(name, column): (&str, &[f64])| {
        let last = column[column.len() - 1];
        (name.to_string(), [column, &vec![last; missing]].concat())
    };
    Points::new(points.columns().map(column))
}
