//! What a fit keeps wherever a shader may call it, which is farther than its certificate reaches:
//! no pole, no value below 0, and none far above 1.
//!
//! The first two are proven by interval arithmetic on the coefficients as emitted, the last is
//! looked at on a lattice of points. Where the best coefficients do not keep them, the search is
//! made again with the values bound there.

use std::collections::BTreeMap;

use crate::data::AlphaMap;
use lobefit_fit::{Condition, Constraint, FitError};
use lobefit_math::chebyshev;
use lobefit_shade::{Domain, Hypothesis, RangeProof, ShadeError, prove_range, prove_regular};

/// Where a shader may call a formula of roughness, mu and f0.
#[derive(Clone, Debug, PartialEq)]
pub struct SafeRange {
    /// Roughness of the fit's region. Formulas that have a value at roughness = mu = 0 are held to
    /// roughness from 0.
    pub roughness: [f64; 2],
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Largest f0; from 0.
    pub f0: f64,
}

/// The box in which a formula is proven to have no pole and no negative value, by input.
pub type Safe = BTreeMap<String, [f64; 2]>;

/// What was found out about a formula's coefficients.
#[derive(Clone, Debug, PartialEq)]
pub enum SafeProof {
    /// Proven.
    Proven(Safe),
    /// Not, and why.
    Unproven(String),
}

/// Places per axis of the lattice at which values are bound.
const NODES: usize = 33;

/// What is asked of the values there, times 1 - f0: so far from 0 that the proof need not end in
/// boxes of no size, and so little that no picture shows it.
const MARGIN: f64 = 1e-3;

/// Largest value there that coefficients are searched within, and that is let pass: a factor's
/// truth is at most 1, and errors within the domain are the certificate's to tell.
const MOST: f64 = 1.02;
const PASSED: f64 = 1.05;

/// f0 of the bound values: between them formulas are affine in it, or 1 - f0 times such; at 1 they
/// vanish.
const BOUND_F0: [f64; 2] = [0.0, 0.9];

impl SafeRange {
    /// What interval arithmetic says of coefficients.
    ///
    /// # Errors
    /// Inputs of the formula that are not those of the domain.
    pub fn prove(&self, hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<SafeProof, FitError> {
        let (safe, exact) = (self.safe(hypothesis), coefficients.iter().map(|c| f64::from(*c)));
        let (exact, domain) = (exact.collect::<Vec<f64>>(), self.domain(&safe)?);
        match prove_regular(hypothesis.tape(), &exact, &domain) {
            Ok(()) => {}
            Err(error @ ShadeError::Irregular { .. }) => return Ok(SafeProof::Unproven(error.to_string())),
            Err(error) => return Err(error.into()),
        }
        if let Some(told) = self.too_bright(hypothesis, coefficients)? {
            return Ok(SafeProof::Unproven(told));
        }
        Ok(match prove_range(hypothesis.tape(), &exact, &domain, 0.0, f64::INFINITY)? {
            RangeProof::Proven => SafeProof::Proven(safe),
            RangeProof::Violated { at, value } => SafeProof::Unproven(format!("it is {value:.2e} at {at}")),
            RangeProof::Open { at } => {
                SafeProof::Unproven(format!("it is not proven to be positive at {at}"))
            }
        })
    }

    /// A value of the lattice that is far above 1.
    fn too_bright(&self, hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<Option<String>, FitError> {
        let places = self.lattice(hypothesis);
        let inputs = self.columns(hypothesis, &places)?;
        let values = hypothesis.tape().evaluate(&inputs, coefficients)?;
        let found = values.iter().zip(&places).find(|(value, _)| f64::from(**value) > PASSED);
        Ok(found.map(|(value, [roughness, mu, f0])| {
            format!("it is {value} at roughness = {roughness}, mu = {mu}, f0 = {f0}")
        }))
    }

    /// The bounds on its values at a lattice.
    ///
    /// # Errors
    /// Inputs of the formula that are not those of the domain.
    pub fn constraints(&self, hypothesis: &Hypothesis) -> Result<[Constraint; 2], FitError> {
        let places = self.lattice(hypothesis);
        let wide = |column: Vec<f32>| column.into_iter().map(f64::from).collect();
        let points: Vec<Vec<f64>> = self.columns(hypothesis, &places)?.into_iter().map(wide).collect();
        let least = places.iter().map(|[.., f0]| MARGIN * (1.0 - f64::from(*f0))).collect();
        let most = vec![MOST; places.len()];
        let constraint = |name: &str, condition| Constraint { name: name.into(), condition };
        Ok([
            constraint("no negative value", Condition::AtLeast { points: points.clone(), values: least }),
            constraint("no value far above 1", Condition::AtMost { points, values: most }),
        ])
    }

    /// Roughness, mu and f0 of the lattice.
    fn lattice(&self, hypothesis: &Hypothesis) -> Vec<[f32; 3]> {
        let safe = self.safe(hypothesis);
        let range = |name: &str| safe.get(name).copied().unwrap_or_default();
        let nodes = |[low, high]: [f64; 2]| chebyshev::nodes(low, high, NODES);
        // Smooth lobes change fastest: most of the roughnesses are theirs.
        let dense = |[low, high]: [f64; 2]| {
            let squared = |t: f64| low + (high - low) * t * t;
            chebyshev::nodes(0.0, 1.0, NODES).into_iter().map(squared).collect::<Vec<f64>>()
        };
        let (roughness, mu) = (dense(range("roughness")), nodes(range("mu")));
        let mut places = Vec::new();
        for f0 in BOUND_F0 {
            for r in &roughness {
                places.extend(mu.iter().map(|m| [*r as f32, *m as f32, f0 as f32]));
            }
        }
        places
    }

    /// The box for a formula: roughness from 0, unless it is 0/0 of alpha and mu there, as a lobe's
    /// albedo is at a mirror's horizon.
    fn safe(&self, hypothesis: &Hypothesis) -> Safe {
        let corner: Vec<f64> = vec![0.0; hypothesis.inputs().len()];
        let columns: Vec<Vec<f64>> = corner.iter().map(|x| vec![*x]).collect();
        let there = hypothesis.tape().evaluate(&columns, &hypothesis.starts());
        let defined = there.is_ok_and(|values| values.iter().all(|v| v.is_finite()));
        let [smallest, largest] = self.roughness;
        let lowest = if defined { 0.0 } else { smallest };
        let of = |name: &str, range: [f64; 2]| (name.to_string(), range);
        BTreeMap::from([of("f0", [0.0, self.f0]), of("mu", [0.0, 1.0]), of("roughness", [lowest, largest])])
    }

    fn domain(&self, safe: &Safe) -> Result<Domain, ShadeError> {
        let axes: Vec<(&str, f64, f64)> = safe.iter().map(|(name, [a, b])| (name.as_str(), *a, *b)).collect();
        Domain::new(&axes)?.with_derived("alpha", "roughness", self.alpha_map.power())
    }

    /// The formula's inputs at places of the lattice.
    fn columns(&self, hypothesis: &Hypothesis, places: &[[f32; 3]]) -> Result<Vec<Vec<f32>>, ShadeError> {
        let column = |name: &String| {
            let of: fn(&SafeRange, [f32; 3]) -> f32 = match name.as_str() {
                "roughness" => |_, [roughness, ..]| roughness,
                "alpha" => |of, [roughness, ..]| of.alpha_map.alpha_f32(roughness),
                "mu" => |_, [_, mu, _]| mu,
                "f0" => |_, [.., f0]| f0,
                _ => {
                    return Err(ShadeError::UnknownInput {
                        function: hypothesis.name().into(),
                        input: name.clone(),
                        given: "roughness, alpha, mu, f0".into(),
                    });
                }
            };
            Ok(places.iter().map(|place| of(self, *place)).collect())
        };
        hypothesis.inputs().iter().map(column).collect()
    }
}
