//! What is asked for, checked and completed.

use std::collections::BTreeMap;

use super::TargetError;
use super::affine::affine_in;
use crate::data::{AlphaMap, Use, nine_digits};
use lobefit_math::ops;
use lobefit_shade::{Domain, Hypothesis, ShadeError};
use lobefit_truth::quantity::{Choice, Excuse, F0Form, Input, OverF0, Quantity, Variant};

/// What to approximate, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetSpec {
    /// Quantity.
    pub quantity: &'static dyn Quantity,
    /// Its column; none: its first.
    pub column: Option<String>,
    /// Use; none: the first of the quantity's that has the formula's arguments.
    pub used_as: Option<Use>,
    /// Variant of the quantity; what the quantity does not have is ignored.
    pub variant: Variant,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Ranges by input; the others have the usual ones of [`Input`].
    pub domain: BTreeMap<String, [f64; 2]>,
}

impl TargetSpec {
    /// The range of each input that the target has, alpha's as roughness; of one that is not asked for a
    /// range of more than one value.
    pub fn ranges(&self) -> impl Iterator<Item = (&str, [f64; 2])> {
        self.quantity.inputs().iter().filter_map(|input| {
            let name = if input.name == "alpha" { ROUGHNESS } else { input.name };
            let asked = self.domain.get(input.name).or_else(|| self.domain.get(name)).copied();
            asked.or((!input.optional).then_some([0.0, 1.0])).map(|range| (name, range))
        })
    }
}

/// An independent input and its range, ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Input.
    pub name: String,
    /// Its range.
    pub range: [f64; 2],
    /// Whether points are even in its logarithm.
    pub is_ratio: bool,
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
    /// What every value is made of, where f0 is an input.
    pub over_f0: Option<OverF0>,
    /// Whether the error is affine in f0.
    pub affine: bool,
    /// Whether alpha is an input, made from roughness.
    alpha: bool,
}

/// The name of the input that alpha is made from.
pub(super) const ROUGHNESS: &str = "roughness";

/// Its range by default: that of published comparisons.
const USUAL_ROUGHNESS: [f64; 2] = [0.02, 1.0];

impl Span {
    /// A range of an input.
    pub fn new(name: &str, range: [f64; 2]) -> Span {
        Span { name: name.into(), range, is_ratio: false }
    }

    /// The ends in the coordinate that points are even in: the logarithm of a ratio, any other
    /// value itself.
    pub(super) fn coordinates(&self) -> [f64; 2] {
        if self.is_ratio { self.range.map(ops::log) } else { self.range }
    }

    /// The value of a coordinate; the ends are exact.
    pub(super) fn value(&self, coordinate: f64) -> f64 {
        let [low, high] = self.coordinates();
        match coordinate {
            x if x == low => self.range[0],
            x if x == high => self.range[1],
            x if self.is_ratio => ops::exp(x),
            x => x,
        }
    }

    /// The value at a part of the way from the lower end to the upper one.
    pub(super) fn at(&self, part: f64) -> f64 {
        let [low, high] = self.coordinates();
        self.value(low + (high - low) * part)
    }

    /// The part of the way from the lower end to the upper one at which a value stands: the inverse of
    /// [`Span::at`], 0 on an axis of one value.
    pub(super) fn part(&self, x: f64) -> f64 {
        let [low, high] = self.coordinates();
        let x = if self.is_ratio { ops::log(x) } else { x };
        if low < high { ((x - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 }
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
            over_f0: None,
            affine: false,
            alpha: false,
        };
        target.over_f0 = match used_as.blends {
            true => Some(OverF0 { lobe: spec.quantity, form: F0Form::Albedo }),
            false => spec.quantity.over_f0(&target.variant),
        };
        for input in spec.quantity.inputs() {
            let wanted = spec.domain.contains_key(input.name) || takes(formula, input.name);
            if wanted || !input.optional {
                target.number(spec, input)?;
            }
        }
        if used_as.blends {
            target.f0 = Some(range(spec, &Input::new("f0", [0.0, 1.0]))?);
        }
        let straight = target.over_f0.is_none_or(|over| over.form.is_affine());
        target.affine = straight && affine_in(formula.tape(), "f0");
        target.refuse_unknown(spec, formula)?;
        Ok(target)
    }

    /// Takes an input of the quantity for one of the formula's.
    fn number(&mut self, spec: &TargetSpec, input: &Input) -> Result<(), TargetError> {
        match input.name {
            "f0" if self.over_f0.is_some() => self.f0 = Some(range(spec, input)?),
            "alpha" => {
                let span = match spec.domain.get("alpha") {
                    Some(alpha) => {
                        range(spec, input)?;
                        Span::new(ROUGHNESS, alpha.map(|a| spec.alpha_map.roughness(a)))
                    }
                    None => {
                        let [least, most] = input.domain.map(|a| spec.alpha_map.roughness(a));
                        let usual = [USUAL_ROUGHNESS[0].max(least), USUAL_ROUGHNESS[1].min(most)];
                        range(spec, &Input::new(ROUGHNESS, [least, most]).usually(usual))?
                    }
                };
                no_gap(spec, &span)?;
                self.axes.push(span);
                self.alpha = true;
            }
            _ => self.axes.push(range(spec, input)?),
        }
        Ok(())
    }

    /// The error of a domain without a point that a formula can be blamed for.
    pub(super) fn all_excused(&self, excuse: &Excuse) -> TargetError {
        let axis = self.axes.iter().find(|axis| axis.name == excuse.input);
        let [low, high] = axis.map_or([1.0; 2], |axis| axis.range);
        TargetError::Range { input: excuse.input.into(), low, high, reason: excuse.reason.into() }
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
                let same = if input == "n_dot_v" { " (emitted code says n_dot_v for mu)" } else { "" };
                let known = format!("{listed}{same}; rename it in the formula");
                let place = Box::new(formula.place_of_argument(input));
                Err(TargetError::Argument { place, input: input.clone(), known })
            }
        }
    }

    /// Whether alpha is an input, made from roughness.
    pub fn has_alpha(&self) -> bool {
        self.alpha
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

    /// Whether an input but f0 has one value.
    pub fn has_one_value(&self) -> bool {
        !self.axes.iter().all(Span::is_spanned)
    }

    /// Where a formula is to have no pole: the domain, and where an input has one value also the views and
    /// the widths below it, at which shaders call it too; the widths unless the formula is 0/0 of alpha and
    /// mu there.
    ///
    /// # Errors
    /// As [`Target::domain`].
    pub fn proven(&self, formula: &Hypothesis) -> Result<Domain, ShadeError> {
        if !self.has_one_value() {
            return self.domain();
        }
        let mut target = self.clone();
        let corner = vec![vec![0.0]; formula.inputs().len()];
        let there = formula.tape().evaluate(&corner, &formula.starts());
        let is_defined = there.is_ok_and(|values| values.iter().all(|value| value.is_finite()));
        for axis in &mut target.axes {
            if axis.name == "mu" || (axis.name == ROUGHNESS && axis.is_spanned() && is_defined) {
                axis.range[0] = 0.0;
            }
        }
        target.domain()
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

/// The use asked for, or the first that has the formula's arguments.
fn used_as(spec: &TargetSpec, column: &str, formula: &Hypothesis) -> Result<Use, TargetError> {
    let (quantity, uses) = (spec.quantity, spec.quantity.uses(column));
    let has_f0 = quantity.inputs().iter().any(|input| input.name == "f0");
    let blends = takes(formula, "f0") && !has_f0;
    let Some(used_as) = spec.used_as else {
        let suits = uses.iter().find(|used_as| used_as.blends == blends);
        return Ok(*suits.unwrap_or(&Use::VALUE));
    };
    let refuse = |reason: String| Err(TargetError::Use { used_as: used_as.name, reason });
    if !uses.contains(&used_as) {
        let suits: Vec<String> = used_as.suits(quantity).iter().map(|to| format!("--to {to}")).collect();
        let (name, meaning) = (quantity.name(), used_as.meaning);
        let suits = suits.join(" or ");
        return refuse(format!(
            "it is {meaning}, and not of {name}:{column}; give {suits} or leave --use out"
        ));
    }
    if used_as.blends && !blends {
        return refuse(format!("it is {}, and the formula has no argument f0", used_as.meaning));
    }
    Ok(used_as)
}

fn takes(formula: &Hypothesis, input: &str) -> bool {
    formula.inputs().iter().any(|i| i == input)
}

/// The range asked for, or the usual one.
fn range(spec: &TargetSpec, input: &Input) -> Result<Span, TargetError> {
    let &Input { name: input, domain: defined, usual, is_ratio, .. } = input;
    let span = |range| Span { name: input.into(), range, is_ratio };
    let Some(&[low, high]) = spec.domain.get(input) else { return Ok(span(usual)) };
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
    Ok(span([low, high]))
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
