//! What an audit knows of each quantity: the ranges of its inputs, its knots, and what channels may
//! hold.

use super::knots::Knots;
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use crate::audit::lobe::Form;
use lobefit_math::ops;
use lobefit_truth::quantity::{Choice, Quantity, TRUTH_ERROR};

/// How an audit computes the truth of a quantity.
#[derive(Clone, Copy)]
pub(in crate::audit) struct Spec<'a> {
    /// The quantity.
    pub quantity: &'a dyn Quantity,
    /// Inputs of tables, in the order of tensors.
    pub inputs: &'static [Input],
    /// Knots along each input; nothing where every value is integrated.
    pub knots: &'static [Knots],
    /// The input that is none of those, as it is the same throughout, and its value.
    pub at: Option<(Input, f64)>,
    /// What channels may hold.
    pub columns: &'static [Column],
    /// Outputs that are the base values.
    pub outputs: &'static [&'static str],
    /// Whether E at normal incidence is the second base value.
    pub normal: bool,
    /// Whether values are averages over the cosine, which is no input then.
    pub averaged: bool,
    /// Ranges of the inputs that are judged, where they are not [0, 1].
    pub ranges: &'static [(Input, [f64; 2])],
    /// An alpha below it counts as 0; alpha_x and alpha_y are raised to it.
    pub narrowest: f64,
    /// Whether an alpha between 0 and `narrowest` is not judged.
    pub mirror_only: bool,
    /// Tolerances at the knots and of exact values.
    pub tolerances: [f64; 2],
    /// Whether the values between the knots are exact.
    pub interpolated: bool,
    /// Largest error of an exact value.
    pub bound: f64,
    /// Whether an exact value costs so much that conventions are ranked, and lookups judged, by the
    /// values between the knots.
    pub costly: bool,
}

impl<'a> Spec<'a> {
    /// The same for a shadowing form, which may have an integrand of its own.
    pub(super) fn of_form(self, form: &Form) -> Spec<'a> {
        let Some(quantity) = form.integrand else { return self };
        let narrowest = quantity.smallest_alpha();
        if quantity.has(Choice::Smith) {
            return Spec { quantity, narrowest, ..self };
        }
        // Its truth is no analytic function of mu, and costs milliseconds.
        Spec {
            quantity,
            narrowest,
            knots: match self.averaged {
                true => const { &[log([LEAST_ALPHA, 1.0], 32)] },
                false => const { &[log([LEAST_ALPHA, 1.0], 32), log([1e-6, 1.0], 64)] },
            },
            ranges: &[(Input::Alpha, [LEAST_ALPHA, 1.0]), (Input::Mu, [1e-6, 1.0])],
            tolerances: [1e-5; 2],
            interpolated: false,
            bound: 1e-5,
            costly: true,
            ..self
        }
    }

    /// The same with the knots that a sieve calls for, where the lobe is analytic: values within 1e-3.
    pub(super) fn rough(self) -> Spec<'a> {
        match (self.interpolated, self.knots.len()) {
            (true, 2) => Spec { knots: &[ROUGH, ROUGH], ..self },
            _ => self,
        }
    }

    /// The same at one value of its first input or its last.
    ///
    /// # Errors
    /// Any other input, or a value outside the range of it.
    pub(in crate::audit) fn slice(self, at: (Input, f64)) -> Result<Spec<'a>, AuditError> {
        let (input, x) = at;
        let refused =
            |reason| AuditError::Option { option: "--at", value: format!("{}={x}", input.name()), reason };
        let (inputs, knots) = match self.inputs {
            [first, rest @ ..] if *first == input && rest.len() > 1 => (rest, &self.knots[1..]),
            [rest @ .., last] if *last == input && rest.len() > 1 => (rest, &self.knots[..rest.len()]),
            _ => {
                let quantity = self.quantity.name();
                return Err(refused(format!("{quantity} is no table of two axes at one {}", input.name())));
            }
        };
        let [low, high] = self.range(input);
        // At an index of 1 there is no interface.
        let is_open = input == Input::Ior;
        if is_open && x <= low || !(low..=high).contains(&x) {
            let from = if is_open { "above" } else { "from" };
            return Err(refused(format!("it is judged {from} {low} to {high}")));
        }
        Ok(Spec { inputs, knots, at: Some(at), ..self })
    }

    /// The range of an input.
    pub(super) fn range(&self, input: Input) -> [f64; 2] {
        self.ranges.iter().find(|(own, _)| *own == input).map_or([0.0, 1.0], |(_, range)| *range)
    }
}

/// Even in the root of an input, cubics between them.
const fn root(range: [f64; 2], count: usize) -> Knots {
    Knots { coordinate: f64::sqrt, input: |u| u * u, range, count, cubic: true }
}

/// Even in the logarithm of an input, cubics between them.
const fn log(range: [f64; 2], count: usize) -> Knots {
    Knots { coordinate: ops::log, input: ops::exp, range, count, cubic: true }
}

/// Chebyshev nodes in the logarithm of alpha or mu, in which E and B are analytic with
/// singularities no nearer than i pi/2 (alpha^2 or mu^2 negative). Over [1e-4, 1]^2 of GGX 52 nodes
/// leave 2e-8, a factor of 9 less for every 6 more; what lies below is integrated.
const ANALYTIC: Knots =
    Knots { coordinate: ops::log, input: ops::exp, range: [LEAST_ALPHA, 1.0], count: 52, cubic: false };

/// Fewer nodes: 24 leave 4e-4.
const ROUGH: Knots = Knots { count: 24, ..ANALYTIC };

/// Least alpha that is judged of an albedo that may have no bound at grazing view below it.
const LEAST_ALPHA: f64 = 1e-4;

/// Least mu of the anisotropic lobe; alpha, alpha_x and alpha_y are raised to it, as tables do.
const ANISO_FLOOR: f64 = 1e-4;

/// Least alpha of glass beside 0: narrower lobes are not judged.
const GLASS_ALPHA: f64 = 4e-4;

/// Largest index of refraction that is judged.
const MOST_IOR: f64 = 3.0;

/// What is known of a quantity; `None` of a quantity that is not audited.
pub(in crate::audit) fn spec(quantity: &dyn Quantity) -> Option<Spec<'_>> {
    let lobe = Spec {
        quantity,
        inputs: &[Input::Alpha, Input::Mu],
        knots: &[ANALYTIC, ANALYTIC],
        at: None,
        columns: &column::REFLECTION,
        outputs: &["E", "B"],
        normal: false,
        averaged: false,
        ranges: &[],
        narrowest: quantity.smallest_alpha(),
        mirror_only: false,
        tolerances: [TRUTH_ERROR; 2],
        interpolated: true,
        bound: 2.0 * TRUTH_ERROR,
        costly: false,
    };
    Some(match quantity.name() {
        "ggx-reflection" => lobe,
        // Its tail bends more.
        "beckmann-reflection" => Spec { bound: 1e-5, ..lobe },
        "ggx-average" => Spec {
            inputs: &[Input::Alpha],
            knots: const { &[Knots { range: [1e-5, 1.0], count: 64, ..ANALYTIC }] },
            columns: &column::AVERAGE,
            outputs: &["E_avg"],
            normal: true,
            tolerances: [1e-8; 2],
            bound: 1e-7,
            ..lobe
        },
        "ggx-reflection-aniso" => Spec {
            inputs: &[Input::Mu, Input::Alpha, Input::Anisotropy],
            knots: const {
                &[
                    root([ANISO_FLOOR, 1.0], 64),
                    root([ANISO_FLOOR, 1.0], 48),
                    Knots { coordinate: |x| x, input: |u| u, range: [0.0, 1.0], count: 17, cubic: true },
                ]
            },
            columns: &column::ALBEDO,
            outputs: &["E"],
            ranges: &[(Input::Mu, [ANISO_FLOOR, 1.0])],
            narrowest: ANISO_FLOOR,
            tolerances: [1e-4, 1e-6],
            interpolated: false,
            bound: 1e-6,
            ..lobe
        },
        "ggx-glass" | "beckmann-glass" => Spec {
            inputs: &[Input::Ior, Input::Alpha, Input::Mu],
            knots: const { &[root([1.0, MOST_IOR], 20), root([GLASS_ALPHA, 1.0], 20), root([1e-3, 1.0], 40)] },
            columns: &column::GLASS,
            outputs: &["R", "T"],
            ranges: &[(Input::Ior, [1.0, MOST_IOR]), (Input::Mu, [2e-4, 1.0])],
            narrowest: GLASS_ALPHA,
            mirror_only: true,
            tolerances: [5e-3, 2e-6],
            interpolated: false,
            bound: 1e-6,
            ..lobe
        },
        _ if is_albedo(quantity) => Spec {
            // E bends down to the least of cosines, for it rises to 40 there.
            knots: const {
                &[Knots { count: 64, ..ANALYTIC }, Knots { range: [1e-7, 1.0], count: 96, ..ANALYTIC }]
            },
            columns: &column::ALBEDO,
            outputs: &["E"],
            ranges: &[(Input::Alpha, [LEAST_ALPHA, 1.0])],
            tolerances: [quantity.tolerance_of_many(&Default::default()); 2],
            bound: 1e-6,
            ..lobe
        },
        _ => return None,
    })
}

/// The specification of averages over the cosine, of an albedo that has no quantity of its own for
/// them, and of glass; `None` of every other. The rule leaves 1e-5 where the lobe is narrow.
pub(in crate::audit) fn averaged(quantity: &dyn Quantity) -> Option<Spec<'_>> {
    let own = spec(quantity)?;
    if ["ggx-glass", "beckmann-glass"].contains(&quantity.name()) {
        return Some(Spec {
            inputs: &[Input::Ior, Input::Alpha],
            knots: const { &[root([1.0, MOST_IOR], 20), root([GLASS_ALPHA, 1.0], 20)] },
            columns: &column::GLASS_MEAN,
            averaged: true,
            tolerances: [1e-4, 1e-5],
            bound: 2e-5,
            costly: true,
            ..own
        });
    }
    if !is_albedo(quantity) {
        return None;
    }
    Some(Spec {
        inputs: &[Input::Alpha],
        knots: const { &[Knots { count: 64, ..ANALYTIC }] },
        columns: &column::MEAN,
        averaged: true,
        bound: 1e-5,
        ..own
    })
}

/// The specification with the azimuth of the view as one more input, of a quantity that depends on
/// it; `None` of every other. No convention is tried with it. Least alpha and mu: below them the
/// interpolant over all of its four inputs needs more nodes than it has.
pub(in crate::audit) fn with_azimuth(quantity: &dyn Quantity) -> Option<Spec<'_>> {
    let mean = spec(quantity).filter(|spec| spec.inputs.contains(&Input::Anisotropy))?;
    Some(Spec {
        inputs: &[Input::Mu, Input::Alpha, Input::Anisotropy, Input::Azimuth],
        knots: &[],
        ranges: &[(Input::Mu, [1e-3, 1.0]), (Input::Alpha, [1e-3, 1.0])],
        tolerances: [1e-5; 2],
        bound: 1e-5,
        ..mean
    })
}

/// Whether a quantity is E of alpha and mu, and has no variants.
fn is_albedo(quantity: &dyn Quantity) -> bool {
    let inputs = quantity.inputs().iter().map(|input| input.name);
    inputs.eq(["alpha", "mu"]) && quantity.outputs() == ["E", "error"] && quantity.choices().is_empty()
}
