//! Where constraints hold: edges at which a formula is exact, lattices over which it stays in a
//! range or is monotone.

use super::spec::ROUGHNESS;
use super::{Span, Target, TargetError};
use lobefit_math::chebyshev;
use lobefit_shade::ShadeError;

/// Places per axis of the lattices of constraints.
const NODES: usize = 17;

/// Places per axis where it is checked that they hold, and the most places of all axes for that
/// many.
const FINE: usize = 65;
const MOST: usize = 1 << 18;

/// Points of the formula's inputs, one column per input.
type Columns = Vec<Vec<f64>>;

impl Target {
    /// Places at which `input` has this value, which may lie outside of the domain, with what the
    /// formula should be there: the truth, or `value`. Columns follow `names`.
    ///
    /// # Errors
    /// An input that there is not, a value that the quantity does not have, a truth that cannot be
    /// integrated.
    pub fn edge(
        &self,
        names: &[String],
        function: &str,
        (input, at): (&str, f64),
        value: Option<f64>,
    ) -> Result<(Columns, Vec<f64>), TargetError> {
        let refuse = |reason: String| TargetError::Edge { setting: "exact", input: input.into(), reason };
        let mut target = self.clone();
        let axis = self.axis_of("exact", input)?;
        let defined = self.defined(input);
        if !(defined[0]..=defined[1]).contains(&at) {
            return Err(refuse(format!("{at} is not in [{}, {}]", defined[0], defined[1])));
        }
        match axis {
            Axis::Axis(k) => {
                let at = if input == "alpha" { self.alpha_inverse(at) } else { at };
                target.axes[k].range = [at, at];
            }
            Axis::F0 => target.f0 = Some(Span::new("f0", [at, at])),
        }
        let (places, f0) = target.lattice(NODES);
        let ideal = match value {
            Some(value) => vec![value; places.len() * f0.len()],
            None => target.at(&places, &f0).map_err(|error| no_truth(input, error))?.ideal(),
        };
        if let Some(bad) = ideal.iter().find(|v| !v.is_finite()) {
            return Err(refuse(format!("the truth there is {bad}; give the value as {input}={at}:VALUE")));
        }
        Ok((target.columns(names, function, &places, &f0)?, ideal))
    }

    /// A lattice over the domain, columns following `names`.
    ///
    /// # Errors
    /// An input that there is not.
    pub fn inside(&self, names: &[String], function: &str) -> Result<Columns, TargetError> {
        let (places, f0) = self.lattice(NODES);
        Ok(self.columns(names, function, &places, &f0)?)
    }

    /// Pairs of neighbours along an input: places, and the next ones.
    ///
    /// # Errors
    /// An input that there is not, or that has one value.
    pub fn steps(
        &self,
        names: &[String],
        function: &str,
        setting: &'static str,
        input: &str,
    ) -> Result<(Columns, Columns), TargetError> {
        self.steps_of(names, function, (setting, input), NODES)
    }

    /// [`Target::steps`] on a finer lattice, which holds the other.
    ///
    /// # Errors
    /// As there.
    pub fn fine_steps(
        &self,
        names: &[String],
        function: &str,
        setting: &'static str,
        input: &str,
    ) -> Result<(Columns, Columns), TargetError> {
        let spanned = self.spans().iter().filter(|span| span.is_spanned()).count() as u32;
        let fits = |n: usize| n.checked_pow(spanned).is_some_and(|all| all <= MOST);
        let count = [FINE, FINE / 2 + 1].into_iter().find(|n| fits(*n)).unwrap_or(NODES);
        self.steps_of(names, function, (setting, input), count)
    }

    fn steps_of(
        &self,
        names: &[String],
        function: &str,
        (setting, input): (&'static str, &str),
        count: usize,
    ) -> Result<(Columns, Columns), TargetError> {
        let axis = self.axis_of(setting, input)?;
        let (places, f0) = self.lattice(count);
        let (mut from, mut to) = (Vec::new(), Vec::new());
        match axis {
            Axis::F0 => {
                for place in &places {
                    from.extend(f0.windows(2).map(|w| with(place, w[0])));
                    to.extend(f0.windows(2).map(|w| with(place, w[1])));
                }
            }
            Axis::Axis(k) => {
                let nodes = nodes(&self.axes[k], count);
                for place in &places {
                    let next = nodes.iter().copied().find(|x| *x > place[k]);
                    for f0 in &f0 {
                        let Some(next) = next else { continue };
                        let mut after = place.clone();
                        after[k] = next;
                        from.push(with(place, *f0));
                        to.push(with(&after, *f0));
                    }
                }
            }
        }
        if from.is_empty() {
            let reason = "its range is one value".into();
            return Err(TargetError::Edge { setting, input: input.into(), reason });
        }
        Ok((self.transposed(names, function, &from)?, self.transposed(names, function, &to)?))
    }

    fn axis_of(&self, setting: &'static str, input: &str) -> Result<Axis, TargetError> {
        let name = if input == "alpha" && self.has_alpha() { ROUGHNESS } else { input };
        if input == "f0" && self.f0.is_some() {
            return Ok(Axis::F0);
        }
        let found = self.axes.iter().position(|a| a.name == name);
        found.map(Axis::Axis).ok_or_else(|| {
            let reason = format!("there is no such input; the inputs are {}", self.inputs().join(", "));
            TargetError::Edge { setting, input: input.into(), reason }
        })
    }

    /// Where the quantity is defined, of an input; roughness where its alpha is, f0 in [0, 1].
    fn defined(&self, input: &str) -> [f64; 2] {
        if input == ROUGHNESS && self.has_alpha() {
            return self.defined("alpha").map(|alpha| self.alpha_inverse(alpha));
        }
        let found = self.quantity.inputs().iter().find(|i| i.name == input);
        // f0 alone is no input of every quantity that is blended by it
        found.map_or([0.0, 1.0], |input| input.domain)
    }

    /// Places of the axes and values of f0, ends included.
    fn lattice(&self, count: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
        let per_axis: Vec<Vec<f64>> = self.axes.iter().map(|axis| nodes(axis, count)).collect();
        let places = per_axis.iter().fold(vec![Vec::new()], |places: Vec<Vec<f64>>, axis| {
            places.iter().flat_map(|place| axis.iter().map(|x| with(place, *x))).collect()
        });
        let f0 = self.f0.as_ref().map_or(vec![1.0], |span| match self.affine {
            true if span.is_spanned() => span.range.to_vec(),
            _ => nodes(span, count),
        });
        (places, f0)
    }

    fn columns(
        &self,
        names: &[String],
        function: &str,
        places: &[Vec<f64>],
        f0: &[f64],
    ) -> Result<Columns, ShadeError> {
        // As Target::at has them: all places for each f0 in turn.
        let rows: Vec<Vec<f64>> = f0.iter().flat_map(|f0| places.iter().map(|p| with(p, *f0))).collect();
        self.transposed(names, function, &rows)
    }

    /// Columns of the formula's inputs, from rows of all axes and f0, rounded as a shader has them.
    fn transposed(&self, names: &[String], function: &str, rows: &[Vec<f64>]) -> Result<Columns, ShadeError> {
        let axis = |k: usize| rows.iter().map(|row| row[k] as f32).collect::<Vec<f32>>();
        let wide = |column: Vec<f32>| -> Vec<f64> { column.into_iter().map(f64::from).collect() };
        let find = |name: &str| self.axes.iter().position(|a| a.name == name);
        let column = |name: &String| match name.as_str() {
            "f0" if self.f0.is_some() => Ok(wide(axis(self.axes.len()))),
            "alpha" if self.has_alpha() => {
                let roughness = find(ROUGHNESS).map(axis).unwrap_or_default();
                Ok(wide(roughness.into_iter().map(|r| self.alpha_map.alpha_f32(r)).collect()))
            }
            name => find(name).map(|k| wide(axis(k))).ok_or_else(|| ShadeError::UnknownInput {
                function: function.into(),
                input: name.into(),
                given: self.inputs().join(", "),
            }),
        };
        names.iter().map(column).collect()
    }

    fn alpha_inverse(&self, alpha: f64) -> f64 {
        self.alpha_map.roughness(alpha)
    }
}

/// The error of a truth that cannot be had at an edge, as the edge's own.
fn no_truth(input: &str, error: TargetError) -> TargetError {
    match error {
        TargetError::Integrate(error) => TargetError::Edge {
            setting: "exact",
            input: input.into(),
            reason: format!("{error}; give the value as {input}=AT:VALUE"),
        },
        error => error,
    }
}

/// An independent input.
enum Axis {
    Axis(usize),
    F0,
}

fn nodes(span: &Span, count: usize) -> Vec<f64> {
    let [low, high] = span.range;
    if span.is_spanned() { chebyshev::nodes(low, high, count) } else { vec![low] }
}

fn with(place: &[f64], more: f64) -> Vec<f64> {
    place.iter().copied().chain([more]).collect()
}
