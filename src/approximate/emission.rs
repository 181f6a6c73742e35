//! Which fits of a job are emitted, which of them is recommended, and what their functions are called.

use super::target::TargetSpec;
use super::{Fit, FitStageError};
use crate::data::{ARGUMENT_NAMES, Arguments, Norm, Pick, Vendor, WeightsError};
use lobefit_shade::code::Float;
use lobefit_shade::{Hypothesis, Op};

/// The error that is kept where a scene states neither an error nor a budget. Beside a true picture
/// two percent of a lobe's energy are hard to see; the figure is a choice.
const USUAL_ERROR: f64 = 0.02;

/// Inputs after the width of the lobe, in the order of emitted functions.
const INPUTS: [&str; 7] = ["mu", "rho", "f0", "mean_length", "light_radius", "coat_roughness", "ior"];

/// What a material's call of a formula takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CallOps {
    /// How often it evaluates the formula.
    pub times: u32,
    /// Operations beside.
    pub beside: u32,
}

impl Default for CallOps {
    fn default() -> Self {
        CallOps { times: 1, beside: 0 }
    }
}

impl CallOps {
    /// Operations of a call of a formula of so many.
    pub fn ops(self, formula: u32) -> u32 {
        formula * self.times + self.beside
    }

    /// Operations that a budget leaves the formula.
    pub fn left(self, budget: u32) -> u32 {
        budget.saturating_sub(self.beside) / self.times
    }
}

/// What is emitted of the fits of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    /// Which fits.
    pub pick: Pick,
    /// How their functions take the width of the lobe.
    pub arguments: Arguments,
    /// The name of the function, by its role: `ggx_energy_compensation`.
    pub role: String,
    /// The error that the scene states.
    pub max_error: Option<f64>,
    /// Most operations of a formula within a budget that is stated without an error: what is taken is as
    /// accurate as every formula of as many.
    pub within: Option<u32>,
    /// Whether the most accurate is taken where the scene states neither an error nor a budget.
    pub most_accurate: bool,
    /// The vendor on whose GPUs they are to be cheap; none: by operations.
    pub cost: Option<Vendor>,
    /// The most that a call may cost on them.
    pub budget: Option<f64>,
    /// The error that every function is to keep, whatever it is for.
    pub every_error: Option<f64>,
    /// The numbers that the functions compute with, and that the fits are measured in.
    pub float: Float,
    /// Whether a page shows the fits that are not emitted.
    pub shown: bool,
    /// What the budget covers.
    pub call: CallOps,
    /// What the operations beside the formula cost on the vendor's GPUs.
    pub beside_price: f64,
}

impl Default for Emission {
    /// Every fit as its formula stands.
    fn default() -> Self {
        Emission {
            pick: Pick::All,
            arguments: Arguments::default(),
            role: String::new(),
            max_error: None,
            within: None,
            most_accurate: false,
            cost: None,
            budget: None,
            every_error: None,
            float: Float::F32,
            shown: true,
            call: CallOps::default(),
            beside_price: 0.0,
        }
    }
}

impl Emission {
    /// The rule by which one of several functions is recommended, as it follows "is".
    pub fn rule() -> String {
        format!(
            "the cheapest function within max_error ({USUAL_ERROR} where the scene states neither max_error nor max_ops), \
             or the most accurate within max_ops"
        )
    }

    /// The rule for a job whose scene states no limit on the error.
    pub fn rule_without_limit(max_ops: Option<u32>) -> String {
        match max_ops {
            None => format!("the cheapest within {USUAL_ERROR}"),
            Some(most) => format!("the most accurate of at most {most} operations"),
        }
    }

    /// What a formula costs where formulas are compared: operations, or by the vendor's model.
    ///
    /// # Errors
    /// As [`Vendor::model`].
    pub fn price(&self, formula: &Hypothesis) -> Result<f64, WeightsError> {
        let ops = || Ok(f64::from(formula.tape().cost_ops()));
        self.cost.map_or_else(ops, |vendor| vendor.price(&formula.tape().features()))
    }

    /// What a call of a formula costs on the vendor's GPUs, where a budget there is exceeded.
    ///
    /// # Errors
    /// As [`Vendor::model`].
    pub fn beyond(&self, formula: &Hypothesis) -> Result<Option<f64>, WeightsError> {
        let price = self.price_of_call(formula)?;
        Ok(self.budget.is_some_and(|most| price > most).then_some(price))
    }

    /// What a call of a formula costs: operations, or by the vendor's model with what stands beside it.
    ///
    /// # Errors
    /// As [`Vendor::model`].
    pub fn price_of_call(&self, formula: &Hypothesis) -> Result<f64, WeightsError> {
        let Some(vendor) = self.cost else { return Ok(f64::from(self.call.ops(formula.tape().cost_ops()))) };
        Ok(vendor.price(&formula.tape().features().times(self.call.times))? + self.beside_price)
    }

    /// The one to take of the emitted fits, by [`Emission::best`], of the first norm that has any.
    pub(super) fn recommended(&self, fits: &[Fit], norms: &[Norm], max_ops: Option<u32>) -> Option<usize> {
        let of_norm = |norm: &Norm| {
            let emitted = |i: &usize| fits[*i].emitted && fits[*i].norm() == norm.name();
            let emitted: Vec<usize> = (0..fits.len()).filter(emitted).collect();
            self.best(fits, &emitted, *norm, max_ops)
        };
        norms.iter().find_map(of_norm)
    }

    /// The fits to emit with the names of their functions; `None`: all, as they are. Formulas whose names do
    /// not say what they are of have the name of the role.
    pub(super) fn picked(
        &self,
        fits: &[Fit],
        (norms, max_ops): (&[Norm], Option<u32>),
        is_named: bool,
    ) -> Option<Vec<(usize, String)>> {
        let picked = |norm: &Norm| -> Vec<(usize, String)> {
            let suffix = if *norm == Norm::Rms && norms.contains(&Norm::Max) { "_rms" } else { "" };
            let of_norm: Vec<usize> = (0..fits.len()).filter(|&i| fits[i].norm() == norm.name()).collect();
            let best = self.best(fits, &of_norm, *norm, max_ops);
            match self.pick {
                Pick::Best => best.map(|i| (i, format!("{}{suffix}", self.role))).into_iter().collect(),
                Pick::Frontier | Pick::All => {
                    // What keeps a limit on the largest error may be beaten in the mean square.
                    let all = self.pick == Pick::All;
                    let mut picked = if all { of_norm } else { frontier(fits, &of_norm, *norm) };
                    picked.extend(best.filter(|best| !picked.contains(best)));
                    // On a vendor's GPUs formulas of as many operations may differ in cost.
                    let name = |(k, &i): (usize, &usize)| {
                        let same =
                            picked[..k].iter().filter(|&&other| ops(&fits[other]) == ops(&fits[i])).count();
                        let again = if same == 0 { String::new() } else { format!("_{}", same + 1) };
                        (i, format!("{}_{}{again}{suffix}", self.role, ops(&fits[i])))
                    };
                    picked.iter().enumerate().map(name).collect()
                }
            }
        };
        (self.pick != Pick::All || !is_named).then(|| norms.iter().flat_map(picked).collect())
    }

    /// The cheapest that keeps the stated error, the more accurate of equals; the most accurate
    /// where none keeps it, or where a budget alone is stated.
    fn best(&self, fits: &[Fit], of_norm: &[usize], norm: Norm, max_ops: Option<u32>) -> Option<usize> {
        let least = |a: &usize, b: &usize| error(&fits[*a], norm).total_cmp(&error(&fits[*b], norm));
        let bar = self.bar(of_norm.iter().map(|&i| &fits[i]), norm);
        let limit = self.limit(max_ops);
        let keeps = |i: &usize| limit.is_some_and(|limit| keeps(&fits[*i], norm, limit, bar));
        let keeping = of_norm.iter().copied().filter(keeps);
        let price = |i: &usize| fits[*i].price;
        let cheapest = keeping.min_by(|a, b| price(a).total_cmp(&price(b)).then(least(a, b)));
        cheapest.or_else(|| of_norm.iter().copied().min_by(least))
    }

    /// The error within which the cheapest is taken; none where the most accurate is.
    fn limit(&self, max_ops: Option<u32>) -> Option<f64> {
        let free = max_ops.is_none() && self.budget.is_none() && !self.most_accurate;
        self.max_error.or(free.then_some(USUAL_ERROR))
    }

    /// The least error of the fits within the operations that another demand allows itself: what is taken
    /// is no less accurate. None where nobody has such a budget.
    fn bar<'f>(&self, fits: impl Iterator<Item = &'f Fit>, norm: Norm) -> Option<f64> {
        let affordable = fits.filter(|fit| self.within.is_some_and(|most| ops(fit) <= most));
        affordable.map(|fit| error(fit, norm)).reduce(f64::min)
    }

    /// The error at which a search through formulas of growing cost may end: of what is dearer nothing is
    /// emitted or shown. None where all are asked for.
    pub(super) fn enough(&self, max_ops: Option<u32>) -> Option<f64> {
        let one = self.pick == Pick::Best && !self.shown;
        self.limit(max_ops).filter(|_| one)
    }

    /// Whether a search that has these fits, among them all of at most [`Emission::within`] operations, and
    /// goes on with formulas of at least a price, has the one to take in a norm already.
    pub(super) fn settled(&self, fits: &[&Fit], norm: Norm, limit: f64, price: f64) -> bool {
        let of_norm = || fits.iter().copied().filter(|fit| fit.norm() == norm.name());
        let bar = self.bar(of_norm(), norm);
        of_norm().any(|fit| fit.price < price && keeps(fit, norm, limit, bar))
    }

    /// The formula as a function of this name with the arguments that are asked for. Its own
    /// arguments follow by the map of roughness.
    pub(super) fn called(
        &self,
        formula: &Hypothesis,
        name: &str,
        spec: &TargetSpec,
    ) -> Result<Hypothesis, FitStageError> {
        let width = self.arguments.names();
        // f0 of a blend is an argument of its use and no input of the quantity.
        let reads = |input: &str| formula.inputs().iter().any(|own| own == input);
        let others = INPUTS.into_iter().filter(|input| spec.domain.contains_key(*input) || reads(input));
        let arguments: Vec<String> =
            width.iter().copied().chain(others).map(|argument| format!("{argument}: f32")).collect();
        // A number is called with what there is.
        let is_number = matches!(formula.tape().ops(), [.., Op::Parameter(_)]);
        let lacks = |input: &str| reads(input) && !width.contains(&input) && !is_number;
        let mut lets = String::new();
        if lacks("alpha") {
            lets += &format!("    let alpha = {};\n", spec.alpha_map.alpha_source("roughness"));
        }
        if lacks("roughness") {
            lets += &format!("    let roughness = {};\n", spec.alpha_map.roughness_source("alpha"));
        }
        let given = if is_number { width[0].into() } else { formula.inputs().join(", ") };
        let call = format!("{}({given})", formula.name());
        let original = Hypothesis::parse(formula.file(), formula.source())?;
        let call = call.replacen(formula.name(), original.name(), 1);
        let function =
            format!("fn {name}({}) -> f32 {{\n{lets}    return {call};\n}}\n", arguments.join(", "));
        Ok(original.wrapped(&function)?.with_arguments(&ARGUMENT_NAMES).in_float(self.float))
    }
}

/// Those that none of the others beats in both cost and error.
fn frontier(fits: &[Fit], of_norm: &[usize], norm: Norm) -> Vec<usize> {
    let mut order = of_norm.to_vec();
    let rank = |i: &usize| (fits[*i].price, error(&fits[*i], norm));
    order.sort_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)));
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = error(&fits[i], norm) < least;
        least = least.min(error(&fits[i], norm));
        better
    });
    order
}

/// Whether a fit keeps a limit on its largest error, and is no worse than the bar in its norm.
fn keeps(fit: &Fit, norm: Norm, limit: f64, bar: Option<f64>) -> bool {
    fit.approximation.certificate.max_abs <= limit && bar.is_none_or(|bar| error(fit, norm) <= bar)
}

fn ops(fit: &Fit) -> u32 {
    fit.approximation.cost.ops
}

/// The error that a norm minimises.
fn error(fit: &Fit, norm: Norm) -> f64 {
    match norm {
        Norm::Max => fit.approximation.certificate.max_abs,
        Norm::Rms => fit.approximation.certificate.rms,
    }
}
