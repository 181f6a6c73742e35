//! Couplings of diffuse bases with the lobes above them, as the page of the effect shows them.

use serde::Serialize;

use crate::data::Place;
use crate::effects::coupling::surface::table::{Grid, ReciprocityRow};
use crate::report::Field;
use crate::report::{ApproximationFinding, EffectFinding, FitFinding, Furnace, FurnaceRow, LeftOut, Origin};

/// What a bake found out about the coupling of diffuse bases.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingFindings {
    /// What made it.
    pub origin: Origin,
    /// What called for it.
    pub effect: EffectFinding,
    /// Hypotheses without a fit.
    pub left_out: Vec<LeftOut>,
    /// The factor beside 1 - Fresnel.
    pub curves: CouplingCurves,
    /// Under each kind of lobe that lies above a base.
    pub lobes: Vec<CouplingLobe>,
}

/// The true factors over mu at one f0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingCurves {
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// Cosines, increasing.
    pub mu: Vec<f64>,
    /// 1 - F(mu), what the macroscopic normal alone would let in.
    pub fresnel: Vec<f64>,
    /// One per roughness, rising.
    pub panels: Vec<CouplingPanel>,
}

/// The factors at one roughness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingPanel {
    /// Roughness.
    pub roughness: f64,
    /// Kind of lobe, and the factor at each mu.
    pub factors: Vec<(String, Vec<f64>)>,
}

/// The bases under one kind of lobe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingLobe {
    /// `single`, `normalised` or `compensated`.
    pub specular: String,
    /// What that multiplies the lobe by.
    pub multiplier: String,
    /// f0 of the truth, and of curves and maps of the fits: the smallest of the scene.
    pub f0: f64,
    /// The true factor over roughness and mu.
    pub truth: Field,
    /// Every factor, ours and published.
    pub approximations: Vec<ApproximationFinding>,
    /// The error of each of them over all f0 in [0, 1], in their order.
    pub anywhere: Vec<AnyF0Finding>,
    /// Fits shown beside their truth.
    pub fits: Vec<FitFinding>,
    /// Lobe and white base in a white environment.
    pub furnace: CouplingFurnace,
    /// The lobe over published couplings and the best fit, as functions of two directions; none
    /// where that was not measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reciprocity: Option<CouplingReciprocity>,
}

/// Materials as functions of two directions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingReciprocity {
    /// Where they were measured.
    pub places: Grid,
    /// The lobe alone, and over each coupling.
    pub rows: Vec<ReciprocityRow>,
}

/// The error of a factor over all f0.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnyF0Finding {
    /// Name of the approximation.
    pub name: String,
    /// Largest error.
    pub max: f64,
    /// Where it is.
    pub at: Place,
    /// Places of roughness and mu that were looked at.
    pub places: u64,
    /// Values of f0 there: every f0, or how many.
    pub looked_at: String,
}

/// Spheres in a white environment: a panel for each f0, rows of factors, columns of roughness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingFurnace {
    /// Roughness of each column.
    pub roughness: Vec<f64>,
    /// Cosines at which the light is given, increasing.
    pub mu: Vec<f64>,
    /// How many times the departure from white is amplified.
    pub amplification: f64,
    /// f0, and the light of lobe and base together for each factor; `factors[column][k]` at
    /// `mu[k]`.
    pub panels: Vec<(f64, Vec<FurnaceRow>)>,
}

impl CouplingFurnace {
    /// The spheres of each f0.
    pub fn spheres(&self) -> impl Iterator<Item = Furnace> {
        let of = |(_, rows): &(f64, Vec<FurnaceRow>)| Furnace {
            roughness: self.roughness.clone(),
            mu: self.mu.clone(),
            rows: rows.clone(),
            amplification: self.amplification,
        };
        self.panels.iter().map(of)
    }
}
