//! Functions that a form may be put into as a whole.

use super::graph::{Graph, Node};
use super::space::SearchSamples;
use lobefit_math::ops;
use lobefit_shade::tape::UnaryOp;

/// What is made of a form's value p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// 2^p: four operations. For what is positive and spans orders of magnitude.
    Exp2,
    /// sqrt(p): four operations. For what is not negative and steep where it is 0.
    Root,
    /// p^2: one operation. For what is not negative.
    Square,
}

/// Error whose argument the linear programs weigh, as part of the largest value.
const ERROR: f64 = 0.01;

impl Link {
    /// The p of a value; none if there is none.
    fn inverse(self, value: f64) -> Option<f64> {
        match self {
            Link::Exp2 => (value > 0.0).then(|| ops::log2(value)),
            Link::Root => (value >= 0.0).then_some(value * value),
            Link::Square => (value >= 0.0).then(|| value.sqrt()),
        }
    }

    fn value(self, p: f32) -> f32 {
        match self {
            Link::Exp2 => ops::exp2(f64::from(p)) as f32,
            Link::Root => p.sqrt(),
            Link::Square => p * p,
        }
    }

    /// p at the value that an anchor has; none where no f32 has that value.
    pub(super) fn base(self, value: f32) -> Option<f32> {
        self.inverse(value.into()).map(|p| p as f32).filter(|p| self.value(*p) == value)
    }

    /// Samples of p, whose residuals are about those of the value. None where a value has no p.
    ///
    /// An error e of a value v is one of p(v + e) - p(v) of p; the factor between them is taken at
    /// one e for all samples, 1 % of the largest target. The tangent (e = 0) would leave p free
    /// where the value is next to 0.
    pub(super) fn linked(self, samples: &SearchSamples) -> Option<SearchSamples> {
        let mut linked = samples.clone();
        let largest = samples.target.iter().fold(0.0_f64, |top, t| top.max(t.abs()));
        let error = ERROR * if largest > 0.0 { largest } else { 1.0 };
        for (scale, target) in linked.scale.iter_mut().zip(&mut linked.target) {
            if *scale == 0.0 {
                continue;
            }
            let (v, e) = (*target / *scale, error / scale.abs());
            let p = self.inverse(v)?;
            *scale *= e / (self.inverse(v + e)? - p);
            *target = *scale * p;
            if !(scale.is_finite() && target.is_finite()) {
                return None;
            }
        }
        Some(linked)
    }

    pub(super) fn write(self, graph: &mut Graph, p: Node) -> Node {
        match self {
            Link::Exp2 => graph.unary(UnaryOp::Exp2, p),
            Link::Root => graph.unary(UnaryOp::Sqrt, p),
            Link::Square => {
                graph.name(p, "root");
                graph.times(p, p)
            }
        }
    }

    /// What it is, for documentation.
    pub(super) fn words(self) -> &'static str {
        match self {
            Link::Exp2 => "an exponential of ",
            Link::Root => "the root of ",
            Link::Square => "the square of ",
        }
    }
}
