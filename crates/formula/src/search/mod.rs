//! A search over forms for a quantity: the frontier of cost against certified error, each point a
//! formula to keep.

mod aids;
mod output;
mod page;
mod pair;
mod space;

pub use aids::{AidKind, Aids, Tried};
pub use output::{document, files, record, summary};

use std::sync::Arc;

use crate::fitting::catalogue::{self, CatalogueFit};
use crate::fitting::{Demand, FittingError};
use lobefit::approximate::target::{Target, TargetSpec};
use lobefit::approximate::{Memo, Places, closer};
use lobefit::data::{Certificate, Model, Vendor, WeightsError};
use lobefit_fit::FitError;
use lobefit_fit::search::{Found, Progress, search};
use lobefit_shade::{Features, Hypothesis, Precision, ShadeError, prove_regular};

/// What to search.
#[derive(Clone, Debug)]
pub struct SearchJob {
    /// What the formulas should be.
    pub spec: TargetSpec,
    /// Most operations.
    pub max_ops: u32,
    /// The vendor on whose GPUs the frontier is to be cheap; none: by operations.
    pub cost: Option<Vendor>,
    /// Forms of each cost that are built upon; none: the search's own number.
    pub width: Option<usize>,
    /// What forms may have beside sums of powers.
    pub aids: Aids,
    /// Where forms are to be exact; none: at alpha = 0, if the truth has one value there.
    pub demands: Vec<Demand>,
    /// Largest error of the most accurate form that is accepted.
    pub limit: Option<f64>,
    /// Command that does this again.
    pub command: String,
}

impl SearchJob {
    /// What kinds of work cost on the vendor's GPUs; none: operations count.
    ///
    /// # Errors
    /// No model of them, a defect of this program.
    pub fn prices(&self) -> Result<Option<Features>, WeightsError> {
        Ok(self.cost.map(Vendor::model).transpose()?.map(|model| model.features()))
    }
}

/// A form of the frontier, measured.
#[derive(Clone, Debug)]
pub struct Point {
    /// The formula; its parameters start at the optimum.
    pub hypothesis: Hypothesis,
    /// Operations.
    pub ops: u32,
    /// Cost by the vendor's model, or the operations.
    pub price: f64,
    /// Error in f32 at points that it was not searched on.
    pub certificate: Certificate,
    /// No coefficients of this form have a smaller largest error on the samples; 0 where nothing is
    /// proven.
    pub bound: f64,
}

/// Everything that was found.
#[derive(Clone, Debug)]
pub struct Searched {
    /// What was searched for.
    pub target: Target,
    /// The vendor's model by which the frontier is the cheapest; none: by operations.
    pub model: Option<Model>,
    /// Where the forms are exact, in words; empty: nowhere.
    pub anchor: String,
    /// What was tried beforehand in narrow searches, and what it gained.
    pub tried: Vec<Tried>,
    /// The frontier by rising cost; certified errors fall.
    pub points: Vec<Point>,
    /// What there was before.
    pub catalogue: Vec<CatalogueFit>,
}

impl Searched {
    /// Beginning of the names of the files: quantity, column and use.
    pub fn name(&self) -> String {
        space::name(&self.target)
    }

    /// Why nothing of it is written: a limit that is passed.
    pub fn problem(&self, limit: Option<f64>) -> Option<String> {
        let best = self.points.iter().map(|p| p.certificate.max_abs).fold(f64::INFINITY, f64::min);
        let limit = limit.filter(|limit| best > *limit)?;
        Some(format!("the most accurate form has a largest error of {best}, above the limit {limit}"))
    }
}

/// Searches, then certifies the frontier; forms that the certificate puts behind a cheaper one are
/// dropped.
///
/// # Errors
/// A target that cannot be searched; no form within the budget.
pub fn run(job: &SearchJob, progress: &dyn Fn(&Progress)) -> Result<Searched, FittingError> {
    let target = space::target(&job.spec)?;
    let model = job.cost.map(Vendor::model).transpose()?;
    let Frontier { found, anchor, tried } = match (&target.f0, target.over_f0) {
        (Some(f0), Some(over)) => pair::run(&target, (f0, over), job, progress)?,
        _ => alone(&target, job, progress)?,
    };
    let memo = Memo::default();
    let measured = Arc::new(target.measured(&memo)?);
    let places = Places { target: &target, measured: &measured, memo: &memo };
    let mut points: Vec<Point> = Vec::new();
    for form in found {
        let coefficients: Vec<f32> = form.hypothesis.parameters().iter().map(|p| p.start).collect();
        let exact: Vec<f64> = form.hypothesis.starts();
        if let Err(ShadeError::Irregular { .. }) =
            prove_regular(form.hypothesis.tape(), &exact, &target.domain()?)
        {
            // The search proves regularity where it can; a certificate needs it in the whole
            // domain.
            continue;
        }
        let certificate = closer(&form.hypothesis, &coefficients, &places, Precision::F32)?;
        let beaten = points.iter().any(|p| p.certificate.max_abs <= certificate.max_abs);
        if !beaten {
            let price = model
                .as_ref()
                .map_or_else(|| f64::from(form.ops), |model| model.cost(form.hypothesis.tape()));
            let hypothesis = unused(form.hypothesis, &points)?;
            points.push(Point { hypothesis, ops: form.ops, price, certificate, bound: form.bound });
        }
    }
    if points.is_empty() {
        let message = format!(
            "no form of at most {} operations is finite over the whole domain; give more --max-ops",
            job.max_ops
        );
        return Err(FitError::Solver { message }.into());
    }
    let catalogue = catalogue::fits(&job.spec, (&target, &measured), u32::MAX, job.cost)?;
    Ok(Searched { anchor, target, model, tried, points, catalogue })
}

/// What a search has found, where it is exact, and what was tried beforehand.
struct Frontier {
    found: Vec<Found>,
    anchor: String,
    tried: Vec<Tried>,
}

/// Forms of one function.
fn alone(target: &Target, job: &SearchJob, progress: &dyn Fn(&Progress)) -> Result<Frontier, FittingError> {
    let anchor = space::anchor(target, &job.demands)?;
    let (space, samples) = (space::space(target, anchor.clone(), job)?, space::samples(target)?);
    let (space, trials) = aids::aided(space, aids::usual(target), true, (target, job), &samples, progress)?;
    let tried = aids::named(&space.axes, None, trials);
    Ok(Frontier {
        found: search(&space, &samples, progress)?,
        anchor: space::words(target, anchor.as_ref()),
        tried,
    })
}

/// A formula by a name that no other has: on a vendor's GPUs formulas of as many operations may
/// differ in cost.
fn unused(formula: Hypothesis, points: &[Point]) -> Result<Hypothesis, ShadeError> {
    let again = points.iter().filter(|point| point.ops == formula.tape().cost_ops()).count();
    if again == 0 {
        return Ok(formula);
    }
    let name = format!("{}_{}", formula.name(), again + 1);
    let source = formula.source().replace(&format!("fn {}(", formula.name()), &format!("fn {name}("));
    Hypothesis::parse(&format!("{name}.wgsl"), &source)
}
