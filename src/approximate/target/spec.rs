//! What is asked for, checked and completed.

use std::collections::BTreeMap;

use super::TargetError;
use super::affine::affine_in;
use crate::data::{AlphaMap, Use, nine_digits};
use lobefit_math::ops;
use lobefit_shade::{Domain, Hypothesis, ShadeError};
use lobefit_truth::quantity::Specular;
use lobefit_truth::quantity::{Choice, Quantity, Variant};

/// What to approximate, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetSpec {
    /// Quantity.
    pub quantity: &'static dyn Quantity,
    /// Its column; none: its first.
    pub column: Option<String>,
    /// Use; none: `coupling` for `diffuse-coupling`, `f0-blend` for a formula of f0 and
    /// `ggx-reflection`, else `value`.
    pub used_as: Option<Use>,
    /// Variant of the quantity; what the quantity does not have is ignored.
    pub variant: Variant,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Ranges by input; the others have those of [`Span::usual`].
    pub domain: BTreeMap<String, [f64; 2]>,
}

/// An independent input and its range, ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Input.
    pub name: String,
    /// Its range.
    pub range: [f64; 2],
}

/// Where the value of a quantity's input comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Given {
    /// An axis.
    Axis(usize),
    /// alpha, from the axis of roughness.
    Alpha,
    /// An optional input that is left out.
    Absent,
    /// f0.
    F0,
}

/// A quantity's column in a use over a domain, for the inputs of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Quantity.
    pub quantity: &'static dyn Quantity,
    /// Its column.
    pub column: &'static str,
    /// Use.
    pub used_as: Use,
    /// Variant of the quantity: what the quantity has of the one asked for.
    pub variant: Variant,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Independent inputs but f0.
    pub axes: Vec<Span>,
    /// The range of f0, where it is an input.
    pub f0: Option<Span>,
    /// Whether the error is affine in f0.
    pub affine: bool,
    pub(super) given: Vec<Given>,
}

/// The name of the input that alpha is made from.
pub(super) const ROUGHNESS: &str = "roughness";

/// A ratio of distances.
const RHO: &str = "rho";

impl Span {
    /// The range of an input where none is asked for, inside the range of the quantity's own: that
    /// of the published comparisons, roughness 0.02 to 1 and mu 0.01 to 1; widths of an anisotropic
    /// lobe from 0.02, ior to 2, an azimuth over its quarter, ratios of distances 1/16 to 8.
    pub fn usual(name: &str, defined: [f64; 2]) -> Span {
        let wanted = match name {
            ROUGHNESS => [0.02, 1.0],
            "mu" => [0.01, 1.0],
            "alpha_x" | "alpha_y" => [0.02, 1.0],
            "ior" => [1.0, 2.0],
            "phi" => [0.0, std::f64::consts::FRAC_PI_2],
            RHO => [1.0 / 16.0, 8.0],
            _ => [0.0, 1.0],
        };
        let range = [wanted[0].max(defined[0]), wanted[1].min(defined[1])];
        Span { name: name.into(), range }
    }

    /// The ends in the coordinate that points are even in: the logarithm of a ratio, any other
    /// value itself.
    pub(super) fn coordinates(&self) -> [f64; 2] {
        if self.name == RHO { self.range.map(ops::log) } else { self.range }
    }

    /// The value of a coordinate; the ends are exact.
    pub(super) fn value(&self, coordinate: f64) -> f64 {
        let [low, high] = self.coordinates();
        match coordinate {
            x if x == low => self.range[0],
            x if x == high => self.range[1],
            x if self.name == RHO => ops::exp(x),
            x => x,
        }
    }

    /// The value at a part of the way from the lower end to the upper one.
    pub(super) fn at(&self, part: f64) -> f64 {
        let [low, high] = self.coordinates();
        self.value(low + (high - low) * part)
    }

    /// Whether there is more than one value.
    pub fn is_spanned(&self) -> bool {
        self.range[0] < self.range[1]
    }
}

impl Target {
    /// Checks a spec against the quantity and the formula's arguments.
    ///
    /// # Errors
    /// Unknown columns, uses that the quantity does not have, ranges outside of its domain, missing
    /// words, arguments that are no input.
    pub fn new(spec: &TargetSpec, formula: &Hypothesis) -> Result<Target, TargetError> {
        let column = column(spec)?;
        let used_as = used_as(spec, column, formula)?;
        let mut target = Target {
            quantity: spec.quantity,
            column,
            used_as,
            variant: variant(spec)?,
            alpha_map: spec.alpha_map,
            axes: Vec::new(),
            f0: None,
            affine: false,
            given: Vec::new(),
        };
        for input in spec.quantity.inputs() {
            let wanted = spec.domain.contains_key(input.name) || takes(formula, input.name);
            let given = if input.optional && !wanted {
                Given::Absent
            } else {
                target.number(spec, input.name, input.domain)?
            };
            target.given.push(given);
        }
        if used_as == Use::F0Blend {
            target.f0 = Some(range(spec, "f0", [0.0, 1.0])?);
        }
        let straight = target.variant.specular != Some(Specular::Compensated);
        target.affine = straight && affine_in(formula.tape(), "f0");
        target.refuse_unknown(spec, formula)?;
        Ok(target)
    }

    fn number(&mut self, spec: &TargetSpec, input: &str, defined: [f64; 2]) -> Result<Given, TargetError> {
        match input {
            "f0" => {
                self.f0 = Some(range(spec, "f0", defined)?);
                Ok(Given::F0)
            }
            "alpha" => {
                let span = match spec.domain.get("alpha") {
                    Some(alpha) => {
                        range(spec, "alpha", defined)?;
                        Span { name: ROUGHNESS.into(), range: alpha.map(|a| spec.alpha_map.roughness(a)) }
                    }
                    None => range(spec, ROUGHNESS, defined.map(|a| spec.alpha_map.roughness(a)))?,
                };
                no_gap(spec, &span)?;
                self.axes.push(span);
                Ok(Given::Alpha)
            }
            _ => {
                self.axes.push(range(spec, input, defined)?);
                Ok(Given::Axis(self.axes.len() - 1))
            }
        }
    }

    /// The error of a domain where every fetch is saturated.
    pub(super) fn all_saturated(&self) -> TargetError {
        let [low, high] = self.axes.iter().find(|axis| axis.name == RHO).map_or([1.0; 2], |axis| axis.range);
        let reason = "every fetch is saturated there: the widest lobe is too narrow; begin at a smaller ratio, or at a smaller alpha";
        TargetError::Range { input: RHO.into(), low, high, reason: reason.into() }
    }

    /// Every range and word asked for is of an input, and every argument of the formula is one.
    fn refuse_unknown(&self, spec: &TargetSpec, formula: &Hypothesis) -> Result<(), TargetError> {
        let known = self.inputs();
        let listed = known.join(", ");
        if let Some(input) = spec.domain.keys().find(|input| !known.contains(input)) {
            let (input, quantity) = (input.clone(), self.quantity.name());
            return Err(TargetError::Input { input, quantity, known: listed });
        }
        if spec.domain.contains_key("alpha") && spec.domain.contains_key(ROUGHNESS) {
            let [low, high] = spec.domain["alpha"];
            let reason = "roughness has a range too, and alpha follows from it; give one of them".into();
            return Err(TargetError::Range { input: "alpha".into(), low, high, reason });
        }
        if formula.inputs().is_empty() {
            let place = Box::new(formula.place_of_function());
            return Err(TargetError::NoInputs { place, known: listed });
        }
        match formula.inputs().iter().find(|input| !known.contains(input)) {
            None => Ok(()),
            Some(input) => {
                let known = format!("{listed}; rename it in the formula");
                let place = Box::new(formula.place_of_argument(input));
                Err(TargetError::Argument { place, input: input.clone(), known })
            }
        }
    }

    /// The same target where f0 is an input of one value.
    pub fn at_f0(&self, f0: f64) -> Target {
        Target { f0: Some(Span { name: "f0".into(), range: [f0, f0] }), ..self.clone() }
    }

    /// Whether alpha is an input, made from roughness.
    pub fn has_alpha(&self) -> bool {
        self.given.contains(&Given::Alpha)
    }

    /// Names of all inputs that a formula may have: the axes, alpha, f0.
    pub fn inputs(&self) -> Vec<String> {
        let mut names: Vec<String> = self.axes.iter().map(|a| a.name.clone()).collect();
        names.extend(self.has_alpha().then(|| "alpha".to_string()));
        names.extend(self.f0.as_ref().map(|f0| f0.name.clone()));
        names
    }

    /// What the variant says but the shadowing, as names and words.
    pub fn words(&self) -> BTreeMap<&'static str, &str> {
        let choices = self.quantity.choices().iter().filter(|choice| **choice != Choice::Smith);
        choices.filter_map(|choice| Some((choice.name(), self.variant.word(*choice)?))).collect()
    }

    /// Every independent input, f0 the last.
    pub fn spans(&self) -> Vec<Span> {
        self.axes.iter().chain(&self.f0).cloned().collect()
    }

    /// Range of every input; alpha's to nine digits.
    pub fn ranges(&self) -> BTreeMap<String, [f64; 2]> {
        let mut ranges: BTreeMap<String, [f64; 2]> =
            self.spans().into_iter().map(|span| (span.name, span.range)).collect();
        if let Some(roughness) = ranges.get(ROUGHNESS).copied()
            && self.has_alpha()
        {
            ranges.insert("alpha".into(), roughness.map(|r| nine_digits(self.alpha_map.alpha(r))));
        }
        ranges
    }

    /// The box of inputs, alpha following from roughness.
    ///
    /// # Errors
    /// A domain that [`Domain`] refuses.
    pub fn domain(&self) -> Result<Domain, ShadeError> {
        let spans = self.spans();
        let axes: Vec<(&str, f64, f64)> =
            spans.iter().map(|s| (s.name.as_str(), s.range[0], s.range[1])).collect();
        let domain = Domain::new(&axes)?;
        if self.has_alpha() {
            domain.with_derived("alpha", ROUGHNESS, self.alpha_map.power())
        } else {
            Ok(domain)
        }
    }
}

/// What the quantity has of the variant that is asked for.
fn variant(spec: &TargetSpec) -> Result<Variant, TargetError> {
    let quantity = spec.quantity;
    let open = |choice: &&Choice| !choice.is_optional() && spec.variant.word(**choice).is_none();
    if let Some(choice) = quantity.choices().iter().find(open) {
        let words = choice.words();
        let (input, first) = (choice.name(), words.first().copied().unwrap_or_default());
        let (name, known) = (quantity.name(), words.join(", "));
        let reason = format!("{name} is asked for at one of {known}; say which, as --fix {input}={first}");
        return Err(TargetError::Word { input: input.into(), reason });
    }
    Ok(spec.variant.of(quantity.choices()))
}

fn column(spec: &TargetSpec) -> Result<&'static str, TargetError> {
    // The last output is the error.
    let columns = &spec.quantity.outputs()[..spec.quantity.outputs().len() - 1];
    let Some(wanted) = &spec.column else { return Ok(columns[0]) };
    columns.iter().copied().find(|c| c == wanted).ok_or_else(|| TargetError::Column {
        quantity: spec.quantity.name(),
        column: wanted.clone(),
        known: columns.join(", "),
    })
}

fn used_as(spec: &TargetSpec, column: &str, formula: &Hypothesis) -> Result<Use, TargetError> {
    let name = spec.quantity.name();
    let usual = match name {
        "diffuse-coupling" => Use::Coupling,
        "parallax-alpha" if column == "alpha_adjusted" => Use::Parallax,
        "ggx-reflection" if column == "E" && takes(formula, "f0") => Use::F0Blend,
        _ => Use::Value,
    };
    let used_as = spec.used_as.unwrap_or(usual);
    let refuse = |reason: &str| Err(TargetError::Use { used_as: used_as.name(), reason: reason.into() });
    match used_as {
        Use::F0Blend if name != "ggx-reflection" || column != "E" => {
            refuse("f0 A + B is a blend of ggx-reflection's E and B; give --to ggx-reflection")
        }
        Use::F0Blend if !takes(formula, "f0") => {
            refuse("the formula has no argument f0; it should be f0 A + B, as mix(B, E, f0)")
        }
        Use::Coupling if name != "diffuse-coupling" => {
            refuse("a coupling factor is a value of diffuse-coupling; give --to diffuse-coupling")
        }
        Use::Normalisation if !ALBEDOS.contains(&column) => {
            let albedos = spec.quantity.outputs().iter().copied().filter(|c| ALBEDOS.contains(c));
            let albedos: Vec<String> = albedos.map(|c| format!("--to {name}:{c}")).collect();
            let remedy = match albedos.as_slice() {
                [] => "give another quantity or leave --use out".into(),
                some => format!("give {} or leave --use out", some.join(" or ")),
            };
            refuse(&format!(
                "a normalisation N makes E N = 1 of an albedo E, all that leaves a surface, which {name}:{column} is not; {remedy}"
            ))
        }
        Use::Parallax if name != "parallax-alpha" || column != "alpha_adjusted" => {
            refuse("the width of a fetch is a value of parallax-alpha; give --to parallax-alpha")
        }
        _ => Ok(used_as),
    }
}

/// The columns that are all the energy that leaves a surface in a white furnace: what a
/// normalisation may divide by.
const ALBEDOS: [&str; 2] = ["E", "E_avg"];

fn takes(formula: &Hypothesis, input: &str) -> bool {
    formula.inputs().iter().any(|i| i == input)
}

/// The range asked for, or the usual one.
fn range(spec: &TargetSpec, input: &str, defined: [f64; 2]) -> Result<Span, TargetError> {
    let Some(&[low, high]) = spec.domain.get(input) else { return Ok(Span::usual(input, defined)) };
    let refuse = |reason: String| Err(TargetError::Range { input: input.into(), low, high, reason });
    if !(low.is_finite() && high.is_finite() && low <= high) {
        return refuse("a range goes from its smaller end to its larger one, both finite".into());
    }
    if low < defined[0] || high > defined[1] {
        let common = [low.max(defined[0]), high.min(defined[1])];
        let remedy = if common[0] <= common[1] {
            format!("give --domain {input}={}..{}", common[0], common[1])
        } else {
            "give a range in there".into()
        };
        return refuse(format!(
            "is not inside [{}, {}], where {} is defined; {remedy}",
            defined[0],
            defined[1],
            spec.quantity.name()
        ));
    }
    Ok(Span { name: input.into(), range: [low, high] })
}

/// Refuses a range that holds widths between a mirror's 0 and the smallest that have a truth.
fn no_gap(spec: &TargetSpec, span: &Span) -> Result<(), TargetError> {
    let (quantity, [low, high]) = (spec.quantity, span.range);
    let (smallest, map) = (quantity.smallest_alpha(), spec.alpha_map);
    if high == 0.0 || map.alpha(low) >= smallest * (1.0 - ROUNDED) {
        return Ok(());
    }
    let input = if spec.domain.contains_key("alpha") { "alpha" } else { ROUGHNESS };
    let from = if input == "alpha" { smallest } else { up(map.roughness(smallest)) };
    let [low, high] = spec.domain.get(input).copied().unwrap_or([low, high]);
    let remedy = if from <= high {
        format!("give --domain {input}={from}..{high}")
    } else {
        String::from("begin there")
    };
    Err(TargetError::Range {
        input: input.into(),
        low,
        high,
        reason: format!(
            "{} has no truth between alpha = 0 and alpha = {smallest:e}, which is {input} = {from}; {remedy}{}",
            quantity.name(),
            if low == 0.0 { ", and --exact alpha=0 if the mirror matters" } else { "" }
        ),
    })
}

/// An f32 next to an end of a range may lie outside of it by this part.
const ROUNDED: f64 = 1e-6;

/// To three digits, upwards: what a person would type.
fn up(x: f64) -> f64 {
    lobefit_shade::round_up(x, 3)
}
