//! The anisotropic lobe over mu, alpha and anisotropy: E as the mean over the azimuth of the view.

use super::solid::{Knots, Solid};
use super::{Lobe, Once, Truth, Values, once, place_of};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use lobefit::data::Smith;
use lobefit::effects::table::aspect;
use lobefit_truth::integrate::aniso::table::{Columns, Grid, tabulate};

/// Least alpha_x and alpha_y: smaller ones are raised, as tables do.
const FLOOR: f64 = 1e-4;

/// Tolerance of exact values.
const EXACT: f64 = 1e-6;

/// Tolerance at the knots.
const QUICK: f64 = 1e-4;

struct Aniso {
    lobes: Vec<Lobe>,
    solid: Solid,
}

/// The values at the knots, of either form.
static KEPT: [Once<Values>; 2] = [Once::new(), Once::new()];

/// `ggx-reflection-aniso`: E.
pub(crate) fn aniso(smiths: &[Smith]) -> Result<impl Truth + use<>, AuditError> {
    let square = |range, count| Knots { coordinate: f64::sqrt, input: |u| u * u, range, count };
    let knots = [
        square([FLOOR, 1.0], 64),
        square([FLOOR, 1.0], 48),
        Knots { coordinate: |x| x, input: |u| u, range: [0.0, 1.0], count: 17 },
    ];
    let at = knots.map(|k| k.inputs());
    let mut values = Vec::new();
    for smith in smiths {
        let made = || means(*smith, [&at[0], &at[1], &at[2]], QUICK);
        values.push(once(&KEPT[place_of(*smith)], made)?);
    }
    let lobes = smiths.iter().map(|s| Lobe { smith: Some(*s), side: None }).collect();
    Ok(Aniso { lobes, solid: Solid { knots, values } })
}

/// E at every combination, mu fastest.
fn means(
    smith: Smith,
    [mus, alphas, anisotropies]: [&[f64]; 3],
    tolerance: f64,
) -> Result<Values, AuditError> {
    let alphas: Vec<f64> = alphas.iter().map(|a| a.max(FLOOR)).collect();
    let aspects: Vec<f64> = anisotropies.iter().map(|a| aspect(*a)).collect();
    let grid = Grid { columns: Columns::Fixed(mus), alphas: &alphas, aspects: &aspects, floor: FLOOR };
    Ok(tabulate(smith, &grid, tolerance)?.e.into_iter().map(|e| [e, 0.0]).collect())
}

impl Truth for Aniso {
    fn quantity(&self) -> &'static str {
        "ggx-reflection-aniso"
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Mu, Input::Alpha, Input::Anisotropy]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::ALBEDO
    }

    fn range(&self, input: Input) -> [f64; 2] {
        if input == Input::Mu { [FLOOR, 1.0] } else { [0.0, 1.0] }
    }

    fn quick(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(self.solid.at(lobe, at))
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        means(self.lobes[lobe].smith.unwrap_or_default(), [at[0], at[1], at[2]], EXACT)
    }

    fn bound(&self) -> f64 {
        EXACT
    }
}
