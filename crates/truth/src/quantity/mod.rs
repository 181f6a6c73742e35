//! Quantities by name: each is a value of the list [`QUANTITIES`], with its inputs, its outputs,
//! the variants that it really has, its truth and, where it has one, its second opinion by Monte
//! Carlo.
//!
//! A quantity is added by a file here that implements [`Quantity`] and by a line of the list.

mod aniso;
mod aniso_glass;
mod average;
mod coat;
pub mod coupling;
pub mod eon;
mod facts;
mod glass;
mod over_f0;
mod parallax;
mod reflection;
mod refracted;
mod seen;
pub mod sheen;
mod used;
mod variant;
mod widened;

pub use aniso::GgxReflectionAniso;
pub use aniso_glass::GgxGlassAniso;
pub use average::GgxAverage;
pub use coat::{ESCAPE, GgxCoat};
pub use coupling::{COUPLING, DiffuseCoupling, Specular};
pub use eon::EonSingle;
pub use facts::{Facts, Fresnel, Input};
pub use glass::{BECKMANN_GLASS, GGX_GLASS, Glass};
pub use over_f0::{F0Form, OverF0, Parts};
pub use parallax::{PARALLAX, ParallaxAlpha, footprint};
pub use reflection::{BECKMANN_REFLECTION, GGX_REFLECTION, Reflection, SCHLICK_SMITH, TRUTH_ERROR};
pub use refracted::RefractedWidth;
pub use seen::{Seen, Sky};
pub use sheen::{EstevezKulla, SheenCharlie};
pub use used::{Residual, Use};
pub use variant::{Choice, Variant};
pub use widened::{AVERAGED_WIDTH, COATED_WIDTH, LIGHT, LIT_WIDTH, Widened};

use rayon::prelude::*;

use crate::integrate::IntegrateError;
use crate::integrate::brdf::{self, Brdf};
use crate::integrate::monte_carlo::{Draw, Run, Sampled};
use crate::integrate::walk::Walks;
use crate::points::Points;

/// The GGX width alpha in [0, 1]; 0 is a mirror. It is hard where the path tracer's running sum is at its
/// worst.
pub(crate) const ALPHA: Input = Input::new("alpha", [0.0, 1.0]).studied([0.5, 0.016]);

/// Cosine of the angle between view and normal. Its usual range is that of published comparisons.
pub(crate) const MU: Input = Input::new("mu", [0.0, 1.0]).usually([0.01, 1.0]).studied([0.7, 0.11]);

/// A function with a truth.
pub trait Quantity: Sync {
    /// What is said of it.
    fn facts(&self) -> &Facts;

    /// [`Facts::name`].
    fn name(&self) -> &'static str {
        self.facts().name
    }

    /// [`Facts::inputs`].
    fn inputs(&self) -> &'static [Input] {
        self.facts().inputs
    }

    /// [`Facts::outputs`].
    fn outputs(&self) -> &'static [&'static str] {
        self.facts().outputs
    }

    /// [`Facts::choices`].
    fn choices(&self) -> &'static [Choice] {
        self.facts().choices
    }

    /// [`Facts::tolerance`], which may depend on the variant.
    fn tolerance(&self, _: &Variant) -> f64 {
        self.facts().tolerance
    }

    /// [`Facts::smallest_alpha`].
    fn smallest_alpha(&self) -> f64 {
        self.facts().smallest_alpha
    }

    /// What formulas of an output are used as. The first use that has the formula's arguments is
    /// meant by default. An output `E` or `E_avg` is all the energy that leaves a
    /// surface.
    fn uses(&self, column: &str) -> &'static [Use] {
        if ["E", "E_avg"].contains(&column) { &[Use::VALUE, Use::NORMALISATION] } else { &[Use::VALUE] }
    }

    /// How its values over an input f0 are made of a lobe's E and B, of a quantity with that input.
    fn over_f0(&self, _: &Variant) -> Option<OverF0> {
        None
    }

    /// Where no formula can be blamed for the error of an output.
    fn excused(&self, _column: &str) -> Option<&'static Excuse> {
        None
    }

    /// [`Facts::fresnel`].
    fn fresnel(&self) -> Option<Fresnel> {
        self.facts().fresnel
    }

    /// [`Facts::changes_at_alpha`].
    fn changes_at_alpha(&self) -> bool {
        self.facts().changes_at_alpha
    }

    /// [`Facts::remark`].
    fn remark(&self) -> &'static str {
        self.facts().remark
    }

    /// The outputs at one point by quadrature. The last is the estimated error of the others, at
    /// most `tolerance`: from two rules of which one has twice the nodes, it holds at all but 1 of
    /// 1000 points of `ggx-reflection` (`tests/integrate/error_bound.rs`) and at all but 1 of 300
    /// or more of every other quantity (`crates/truth/tests/truth/error.rs`, `tests/integrate/lobes.rs`).
    ///
    /// # Errors
    /// An input outside of its domain, a variant that leaves a choice open, a tolerance that the
    /// largest rule does not reach.
    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        check_domain(self, x)?;
        let mu = self.inputs().iter().position(|input| input.name == MU.name);
        let mu = mu.ok_or(IntegrateError::NoInput { quantity: self.name(), input: MU.name })?;
        let e = brdf::albedo(self.name(), &self.brdf(variant, x)?, x[mu], tolerance)?;
        Ok(vec![e.value, e.error])
    }

    /// The BRDF at inputs, of a quantity that is its albedo over `mu`: all that a quantity must
    /// give where nobody has derived a shorter integral. Its outputs are then one value and the
    /// error.
    ///
    /// # Errors
    /// A quantity that has its own [`Quantity::at`]; a variant that leaves a choice open.
    fn brdf(&self, variant: &Variant, x: &[f64]) -> Result<Brdf<'_>, IntegrateError> {
        let _ = (variant, x);
        Err(IntegrateError::NoBrdf { quantity: self.name() })
    }

    /// Some outputs at many points, by the fastest way that keeps an absolute `tolerance`:
    /// [`Quantity::many`] where the quantity has it, as interpolants and rules that neighbours
    /// share; else [`Quantity::at`] of every point.
    ///
    /// # Errors
    /// As [`Quantity::at`]; an output that there is not, a column of inputs that the points do not
    /// have.
    fn truth(
        &self,
        variant: &Variant,
        points: &Points,
        outputs: &[&str],
        tolerance: f64,
    ) -> Result<Truth, IntegrateError> {
        let asked = Asked { variant, points, outputs, tolerance };
        let places = asked.places(self)?;
        match self.many(&asked)? {
            Some(truth) => Ok(truth),
            None => asked.each(self, &places),
        }
    }

    /// [`Quantity::truth`] by a way of its own; `None` where it has none for what is asked.
    ///
    /// # Errors
    /// As [`Quantity::truth`].
    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let _ = asked;
        Ok(None)
    }

    /// The tolerance of [`Quantity::truth`] that its fast ways keep: what to ask for where the
    /// promise is finer than any use of many points.
    fn tolerance_of_many(&self, variant: &Variant) -> f64 {
        self.tolerance(variant).max(1e-6)
    }

    /// About how many microseconds a point of many takes on one core, at
    /// [`Quantity::tolerance_of_many`].
    fn microseconds(&self, outputs: &[&str]) -> f64 {
        let _ = outputs;
        1e4
    }

    /// The outputs without the error at one point by Monte Carlo, which shares nothing with the
    /// quadrature but definitions.
    ///
    /// # Errors
    /// As [`Quantity::at`]; an input at a limit that cannot be sampled; a quantity that is no
    /// integral.
    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let _ = (variant, x, run);
        Err(IntegrateError::NoSecondOpinion { quantity: self.name() })
    }

    /// [`Facts::draws`].
    fn draws(&self) -> &'static [Draw] {
        self.facts().draws
    }

    /// Which output ways to compute it are compared by: E, or the first.
    fn studied(&self) -> usize {
        self.outputs().iter().position(|output| *output == "E").unwrap_or(0)
    }

    /// Rules for this output alone, beside [`Quantity::at`]: a value by each step of each.
    ///
    /// # Errors
    /// As [`Quantity::at`].
    fn rules(&self, variant: &Variant, x: &[f64]) -> Result<Vec<Rule<'_>>, IntegrateError> {
        let _ = (variant, x);
        Ok(Vec::new())
    }

    /// One sample of this output from random numbers, as the path tracer draws it for its tables; `None` of a
    /// quantity that it has no table of.
    fn traced(&self, variant: &Variant, x: &[f64]) -> Option<Trace<'_>> {
        let _ = (variant, x);
        None
    }

    /// This output by a random walk over facets; `None` where there is no walk.
    fn walked(&self, x: &[f64], walks: Walks) -> Option<Result<Sampled, IntegrateError>> {
        let _ = (x, walks);
        None
    }

    /// A sky by its lobe and by the one in its place; `None` of what is no roughness.
    fn seen(&self) -> Option<&dyn Seen> {
        None
    }

    /// Whether its variants say this.
    fn has(&self, choice: Choice) -> bool {
        self.choices().contains(&choice)
    }
}

/// A rule of quadrature, and a value by each of its steps from few nodes to many.
pub struct Rule<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its steps.
    pub steps: Vec<Box<dyn Fn() -> f64 + 'a>>,
}

/// One sample from numbers in [0, 1).
pub type Trace<'a> = Box<dyn Fn([f64; 3]) -> f64 + 'a>;

/// Points that fits leave out.
#[derive(Debug)]
pub struct Excuse {
    /// The output that is 1 there, else 0.
    pub output: &'static str,
    /// The input whose range decides how many points are left.
    pub input: &'static str,
    /// What is wrong where no point is left, and what helps.
    pub reason: &'static str,
}

/// Outputs at points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Truth {
    /// A column for each output that was asked for, in that order.
    pub columns: Vec<Vec<f64>>,
    /// Bound of the error of all values.
    pub error: f64,
    /// Evaluations of integrands, where they were counted; else the integrals.
    pub evaluations: u64,
}

impl Truth {
    /// The columns, as many as were asked for.
    ///
    /// # Panics
    /// If that is not `N`: it never depends on input.
    pub fn arrays<const N: usize>(self) -> [Vec<f64>; N] {
        let count = self.columns.len();
        self.columns.try_into().unwrap_or_else(|_| panic!("{count} outputs were asked for, not {N}"))
    }

    /// Columns of rows.
    fn of_rows<const N: usize>(rows: &[[f64; N]], error: f64, evaluations: u64) -> Truth {
        let columns = (0..N).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
        Truth { columns, error, evaluations }
    }

    /// Columns of which each is `of` an output and a row.
    fn of<T>(outputs: &[&str], rows: &[T], of: impl Fn(&str, &T) -> f64) -> Truth {
        let columns = outputs.iter().map(|output| rows.iter().map(|row| of(output, row)).collect()).collect();
        Truth { columns, error: 0.0, evaluations: rows.len() as u64 }
    }
}

/// What is asked of a quantity at many points.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The variant.
    pub variant: &'a Variant,
    /// The points.
    pub points: &'a Points,
    /// Names of outputs.
    pub outputs: &'a [&'a str],
    /// Largest error.
    pub tolerance: f64,
}

impl<'a> Asked<'a> {
    /// Whether one of some outputs is asked for.
    fn wants(&self, outputs: &[&str]) -> bool {
        self.outputs.iter().any(|output| outputs.contains(output))
    }

    /// Columns of the inputs of a quantity, in its order; `None` of an optional input that the
    /// points do not have.
    fn inputs<Q: Quantity + ?Sized>(&self, quantity: &Q) -> Result<Vec<Option<&'a [f64]>>, IntegrateError> {
        let column = |input: &Input| match self.points.column(input.name) {
            None if !input.optional => {
                Err(IntegrateError::NoInput { quantity: quantity.name(), input: input.name })
            }
            column => Ok(column),
        };
        quantity.inputs().iter().map(column).collect()
    }

    /// The columns of a quantity without optional inputs.
    fn columns<const N: usize, Q: Quantity + ?Sized>(
        &self,
        quantity: &Q,
    ) -> Result<[&'a [f64]; N], IntegrateError> {
        let columns = self.inputs(quantity)?;
        Ok(std::array::from_fn(|k| columns.get(k).copied().flatten().unwrap_or(&[])))
    }

    /// The places of the outputs among those of a quantity.
    fn places<Q: Quantity + ?Sized>(&self, quantity: &Q) -> Result<Vec<usize>, IntegrateError> {
        let place = |output: &&str| {
            let found = quantity.outputs().iter().position(|o| o == output);
            let output = String::from(*output);
            found.ok_or_else(|| IntegrateError::NoOutput { quantity: quantity.name(), output })
        };
        self.outputs.iter().map(place).collect()
    }

    /// [`Quantity::at`] of every point.
    fn each<Q: Quantity + ?Sized>(&self, quantity: &Q, places: &[usize]) -> Result<Truth, IntegrateError> {
        let inputs = self.inputs(quantity)?;
        let at = |i: usize| {
            let x: Vec<f64> =
                inputs.iter().map(|column| column.map_or(f64::NAN, |column| column[i])).collect();
            quantity.at(self.variant, &x, self.tolerance)
        };
        let count = self.points.len();
        let rows: Vec<Vec<f64>> = (0..count).into_par_iter().map(at).collect::<Result<_, _>>()?;
        let error = rows.iter().filter_map(|row| row.last().copied()).fold(0.0, f64::max);
        let columns = places.iter().map(|place| rows.iter().map(|row| row[*place]).collect()).collect();
        Ok(Truth { columns, error, evaluations: count as u64 })
    }
}

/// Refuses inputs outside of their domains.
fn check_domain<Q: Quantity + ?Sized>(quantity: &Q, x: &[f64]) -> Result<(), IntegrateError> {
    let checked = |(input, &value): (&Input, &f64)| {
        let [low, high] = input.domain;
        let inside = (low..=high).contains(&value) || (input.optional && value.is_nan());
        (input.name, value, inside, "is outside the quantity's domain")
    };
    IntegrateError::outside(quantity.name(), quantity.inputs().iter().zip(x).map(checked))
}

/// Refuses values that are neither 0 nor in [smallest, 1], but for what a rounding to f32 does to
/// the ends.
fn check_unit<Q: Quantity + ?Sized>(
    quantity: &Q,
    input: &'static str,
    values: &[f64],
    smallest: f64,
) -> Result<(), IntegrateError> {
    let domain = (smallest * (1.0 - ROUNDED))..=(1.0 + ROUNDED);
    let missed = "is neither 0 nor in the quantity's domain";
    let checked = |x: &f64| (input, *x, *x == 0.0 || domain.contains(x), missed);
    IntegrateError::outside(quantity.name(), values.iter().map(checked))
}

/// Relative rounding of an input in f32.
const ROUNDED: f64 = 1e-6;

impl std::fmt::Debug for dyn Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for dyn Quantity {
    fn eq(&self, other: &dyn Quantity) -> bool {
        self.name() == other.name()
    }
}

/// Every quantity of this version.
pub static QUANTITIES: [&dyn Quantity; 17] = [
    GGX_REFLECTION,
    &GgxReflectionAniso,
    &GgxAverage,
    GGX_GLASS,
    &GgxGlassAniso,
    &SheenCharlie,
    &EstevezKulla,
    &DiffuseCoupling,
    &ParallaxAlpha,
    BECKMANN_REFLECTION,
    BECKMANN_GLASS,
    &EonSingle,
    &RefractedWidth,
    &GgxCoat,
    &AVERAGED_WIDTH,
    &LIT_WIDTH,
    &COATED_WIDTH,
];

/// The quantity of a name.
pub fn find(name: &str) -> Option<&'static dyn Quantity> {
    QUANTITIES.iter().copied().find(|quantity| quantity.name() == name)
}
