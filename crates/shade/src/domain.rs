//! The box of inputs over which a formula is meant to hold.

use std::collections::BTreeMap;

use super::ShadeError;
use super::tape::Interval;

/// One independent input and its range, ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct DomainAxis {
    /// Input's name.
    pub name: String,
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// An input that is an integer power of an axis: alpha = roughness^2.
#[derive(Clone, Debug, PartialEq)]
struct Derived {
    name: String,
    axis: usize,
    power: u32,
}

/// A closed box of independent inputs, with inputs derived from them as integer powers.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    axes: Vec<DomainAxis>,
    derived: Vec<Derived>,
}

impl Domain {
    /// A box of independent inputs `(name, lo, hi)`.
    ///
    /// # Errors
    /// A range that is not finite or empty (lo > hi), and a name given twice.
    pub fn new(axes: &[(&str, f64, f64)]) -> Result<Domain, ShadeError> {
        let mut domain = Domain { axes: Vec::new(), derived: Vec::new() };
        for &(name, lo, hi) in axes {
            domain.refuse_known(name)?;
            if !(lo.is_finite() && hi.is_finite() && lo <= hi) {
                return Err(bad(name, format!("{lo} .. {hi} is not a closed, finite range")));
            }
            domain.axes.push(DomainAxis { name: name.to_string(), lo, hi });
        }
        Ok(domain)
    }

    /// Adds the input `name = axis^power`, computed by repeated squaring as in a shader (power 1, 2
    /// or 4).
    ///
    /// # Errors
    /// An unknown axis, a name given twice, another power, an axis that reaches below 0.
    pub fn with_derived(mut self, name: &str, axis: &str, power: u32) -> Result<Domain, ShadeError> {
        self.refuse_known(name)?;
        let Some(index) = self.axes.iter().position(|a| a.name == axis) else {
            return Err(bad(name, format!("is derived from {axis}, which is not an axis")));
        };
        if ![1, 2, 4].contains(&power) {
            return Err(bad(name, format!("is {axis}^{power}; the powers known are 1, 2 and 4")));
        }
        if self.axes[index].lo < 0.0 {
            return Err(bad(name, format!("is a power of {axis}, which must not be negative")));
        }
        self.derived.push(Derived { name: name.to_string(), axis: index, power });
        Ok(self)
    }

    fn refuse_known(&self, name: &str) -> Result<(), ShadeError> {
        if self.names().any(|n| n == name) {
            return Err(bad(name, "is given twice".to_string()));
        }
        Ok(())
    }

    /// The independent inputs.
    pub fn axes(&self) -> &[DomainAxis] {
        &self.axes
    }

    /// Names of all inputs, the axes first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.axes.iter().map(|a| a.name.as_str()).chain(self.derived.iter().map(|d| d.name.as_str()))
    }

    /// Range of every input, derived ones included, as a certificate states it.
    pub fn bounds(&self) -> BTreeMap<String, [f64; 2]> {
        let axes = self.axes.iter().map(|a| (a.name.clone(), [a.lo, a.hi]));
        let derived = self.derived.iter().map(|d| {
            let axis = &self.axes[d.axis];
            (d.name.clone(), [power(axis.lo, d.power), power(axis.hi, d.power)])
        });
        axes.chain(derived).collect()
    }

    /// Columns of the inputs named in `inputs`, from columns of axis values (one per axis, in
    /// order).
    ///
    /// # Errors
    /// An input that the domain does not give; another number of columns than axes.
    pub fn columns(
        &self,
        function: &str,
        inputs: &[String],
        axes: &[Vec<f64>],
    ) -> Result<Vec<Vec<f64>>, ShadeError> {
        if axes.len() != self.axes.len() {
            let what = format!("{function}: columns of axis values");
            return Err(ShadeError::Shape { what, found: axes.len(), expected: self.axes.len() });
        }
        let column = |name: &String| {
            let (axis, exponent) = self.locate(function, name)?;
            Ok(axes[axis].iter().map(|&x| power(x, exponent)).collect())
        };
        inputs.iter().map(column).collect()
    }

    /// The intervals of the inputs named in `inputs` over a box given by one interval per axis.
    pub(super) fn intervals(
        &self,
        function: &str,
        inputs: &[String],
        axes: &[Interval],
    ) -> Result<Vec<Interval>, ShadeError> {
        let one = |name: &String| {
            let (axis, exponent) = self.locate(function, name)?;
            let square = |x: Interval| x.mul_same_sign(x);
            let x = axes[axis];
            Ok(match exponent {
                1 => x,
                2 => square(x),
                _ => square(square(x)),
            })
        };
        inputs.iter().map(one).collect()
    }

    /// Axis and power that give the input called `name`.
    fn locate(&self, function: &str, name: &str) -> Result<(usize, u32), ShadeError> {
        if let Some(axis) = self.axes.iter().position(|a| a.name == name) {
            return Ok((axis, 1));
        }
        if let Some(derived) = self.derived.iter().find(|d| d.name == name) {
            return Ok((derived.axis, derived.power));
        }
        Err(ShadeError::UnknownInput {
            function: function.to_string(),
            input: name.to_string(),
            given: self.names().collect::<Vec<_>>().join(", "),
        })
    }
}

fn bad(input: &str, message: String) -> ShadeError {
    ShadeError::Domain { input: input.to_string(), message }
}

/// x, x^2 or x^4 by squaring.
fn power<T: Copy + std::ops::Mul<Output = T>>(x: T, exponent: u32) -> T {
    match exponent {
        1 => x,
        2 => x * x,
        _ => (x * x) * (x * x),
    }
}
