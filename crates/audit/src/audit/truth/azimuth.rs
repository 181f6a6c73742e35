//! The anisotropic lobe over mu, alpha, anisotropy and the azimuth of the view: for tables that say
//! how they are looked up. No convention is tried with it.

use rayon::prelude::*;

use super::{Lobe, Truth, Values};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit::effects::table::aspect;
use lobefit_math::ops;
use lobefit_truth::integrate::aniso::table::Azimuthal;

/// Least alpha and mu that are judged: below it the interpolant over all of its four inputs needs
/// more nodes than it has.
const LEAST: f64 = 1e-3;

/// Tolerance of a value.
const EXACT: f64 = 1e-5;

struct Azimuth {
    lobes: Vec<Lobe>,
}

/// `ggx-reflection-aniso` at an azimuth: E.
pub(crate) fn azimuth(smiths: &[Smith]) -> impl Truth + use<> {
    Azimuth { lobes: smiths.iter().map(|s| Lobe { smith: Some(*s), side: None }).collect() }
}

/// Least and greatest.
fn ends(list: &[f64]) -> [f64; 2] {
    let least = list.iter().copied().fold(f64::INFINITY, f64::min);
    [least, list.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
}

impl Truth for Azimuth {
    fn quantity(&self) -> &'static str {
        "ggx-reflection-aniso"
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Mu, Input::Alpha, Input::Anisotropy, Input::Azimuth]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::ALBEDO
    }

    fn range(&self, input: Input) -> [f64; 2] {
        if matches!(input, Input::Mu | Input::Alpha) { [LEAST, 1.0] } else { [0.0, 1.0] }
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        let [mus, alphas, anisotropies, squares] = at else { return Ok(Values::new()) };
        let aspects: Vec<f64> = anisotropies.iter().map(|a| aspect(*a)).collect();
        let [narrow, round] = ends(&aspects);
        let smith = self.lobes[lobe].smith.unwrap_or_default();
        let truth = Azimuthal::new(smith, ends(alphas), [narrow, round], ends(mus), EXACT)?;
        let phi = |square: &f64| ops::atan2((1.0 - square).sqrt(), square.sqrt());
        let phis: Vec<f64> = squares.iter().map(phi).collect();
        let lines: Vec<(f64, f64)> =
            aspects.iter().flat_map(|aspect| alphas.iter().map(|alpha| (*alpha, *aspect))).collect();
        // Of every alpha and aspect, mu fastest, for each azimuth.
        let planes: Vec<Vec<f64>> = lines
            .par_iter()
            .map(|(alpha, aspect)| {
                let fixed = truth.pinned(*alpha, *aspect);
                phis.iter()
                    .flat_map(|phi| mus.iter().map(|mu| fixed.at(*mu, *phi)).collect::<Vec<_>>())
                    .collect()
            })
            .collect();
        let of_azimuth = |k: usize| planes.iter().flat_map(move |p| &p[k * mus.len()..][..mus.len()]);
        Ok((0..phis.len()).flat_map(of_azimuth).map(|e| [*e, 0.0]).collect())
    }

    fn bound(&self) -> f64 {
        EXACT
    }
}
