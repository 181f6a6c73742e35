//! What the user demands of a formula, as constraints on its coefficients.

use super::FittingError;
use lobefit::approximate::target::Target;
use lobefit_fit::{Condition, Constraint};
use lobefit_shade::Hypothesis;

/// A demand on the formula's own value.
#[derive(Clone, Debug, PartialEq)]
pub enum Demand {
    /// The truth, or the value given, wherever the input has this value.
    Exact {
        /// Input.
        input: String,
        /// Where.
        at: f64,
        /// What the formula should be there; none: the truth.
        value: Option<f64>,
    },
    /// Within these ends over the domain.
    Range {
        /// Smallest value; infinite for none.
        low: f64,
        /// Largest value; infinite for none.
        high: f64,
    },
    /// Never falling as the input rises.
    Rising(String),
    /// Never rising as the input rises.
    Falling(String),
}

impl Demand {
    /// The words of messages and reports.
    pub fn words(&self) -> String {
        match self {
            Demand::Exact { input, at, value: None } => format!("exact at {input} = {at}"),
            Demand::Exact { input, at, value: Some(value) } => format!("{value} at {input} = {at}"),
            Demand::Range { low, high } if *high == f64::INFINITY => format!("at least {low}"),
            Demand::Range { low, high } if *low == f64::NEG_INFINITY => format!("at most {high}"),
            Demand::Range { low, high } => format!("in [{low}, {high}]"),
            Demand::Rising(input) => format!("rising in {input}"),
            Demand::Falling(input) => format!("falling in {input}"),
        }
    }
}

/// The constraints of demands, in order; a range is up to two.
pub(super) fn constraints(
    demands: &[Demand],
    target: &Target,
    formula: &Hypothesis,
) -> Result<Vec<Constraint>, FittingError> {
    let (names, function) = (formula.inputs(), formula.name());
    let mut constraints = Vec::new();
    for demand in demands {
        let name = demand.words();
        match demand {
            Demand::Exact { input, at, value } => {
                let (points, values) = target.edge(names, function, (input, *at), *value)?;
                constraints.push(Constraint { name, condition: Condition::Equal { points, values } });
            }
            Demand::Range { low, high } => {
                let points = target.inside(names, function)?;
                let count = points.first().map_or(0, Vec::len);
                let bounded = |bound: f64| (points.clone(), vec![bound; count]);
                if low.is_finite() {
                    let (points, values) = bounded(*low);
                    let condition = Condition::AtLeast { points, values };
                    constraints.push(Constraint { name: format!("at least {low}"), condition });
                }
                if high.is_finite() {
                    let (points, values) = bounded(*high);
                    let condition = Condition::AtMost { points, values };
                    constraints.push(Constraint { name: format!("at most {high}"), condition });
                }
            }
            Demand::Rising(input) => {
                let (from, to) = target.steps(names, function, "rising", input)?;
                constraints.push(Constraint { name, condition: Condition::Rising { from, to } });
            }
            Demand::Falling(input) => {
                let (from, to) = target.steps(names, function, "falling", input)?;
                let condition = Condition::Rising { from: to, to: from };
                constraints.push(Constraint { name, condition });
            }
        }
    }
    Ok(constraints)
}
