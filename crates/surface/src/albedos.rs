//! What a surface needs to know of its specular lobe from everywhere: albedos of one alpha,
//! interpolated over the cosine.

use rayon::prelude::*;

use crate::SurfaceError;
use lobefit_math::gauss::Gauss;
use lobefit_math::panels;
use lobefit_math::piecewise::{self, Piecewise};
use lobefit_truth::integrate::reflection::{self, Effort};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::fresnel;

/// Range of alpha of a surface. At 0 the lobe is a mirror, which has no BRDF.
pub const ALPHA: [f64; 2] = [1e-4, 1.0];

/// The panels over the cosine begin at this part of alpha: below it E departs from E(0) by less
/// than 1e-7 alpha.
pub(crate) const FIRST_PANEL: f64 = 1e-6;

/// Directional albedos over mu in [0, 1] of one lobe, to 1e-7 (the loss: relative, for mu >= 1e-5
/// alpha), and their averages.
#[derive(Clone, Debug)]
pub struct Albedos {
    /// Form of the shadowing.
    pub smith: Smith,
    /// GGX alpha.
    pub alpha: f64,
    /// Average of E over the hemisphere, 2 int E mu dmu, and of the loss.
    pub average: Column,
    columns: Piecewise<3>,
}

/// Albedos at one cosine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Column {
    /// E for F = 1.
    pub e: f64,
    /// 1 - E.
    pub loss: f64,
    /// Schlick's bias B.
    pub b: f64,
}

impl Column {
    fn of([e, loss, b]: [f64; 3]) -> Column {
        Column { e, loss, b }
    }
}

impl Albedos {
    /// Integrates the lobe of alpha in [1e-4, 1].
    ///
    /// # Errors
    /// An input outside its range; an integral that is not finite.
    pub fn new(smith: Smith, alpha: f64) -> Result<Albedos, SurfaceError> {
        check("alpha", alpha, ALPHA)?;
        let cuts = panels::from_zero(1.0, FIRST_PANEL * alpha);
        let nodes = piecewise::nodes(&cuts);
        let values: Vec<[f64; 3]> = nodes.par_iter().map(|mu| integrated(smith, alpha, *mu)).collect();
        if let Some(i) = values.iter().position(|v| !v.iter().all(|x| x.is_finite())) {
            return Err(SurfaceError::NotFinite { what: "albedo", alpha, mu: nodes[i] });
        }
        let columns = Piecewise::new(cuts, &values);
        let average = Column::of(average(&columns, |_, at| at));
        Ok(Albedos { smith, alpha, average, columns })
    }

    /// Albedos at mu in [0, 1].
    pub fn at(&self, mu: f64) -> Column {
        Column::of(self.columns.at(mu))
    }

    /// 2 int_0^1 f mu dmu of functions of the cosine and of the albedos there.
    pub fn average_of<const N: usize>(&self, f: impl Fn(f64, &Column) -> [f64; N]) -> [f64; N] {
        average(&self.columns, |mu, at| f(mu, &Column::of(at)))
    }
}

fn integrated(smith: Smith, alpha: f64, mu: f64) -> [f64; 3] {
    let effort = &Effort::ladder()[1];
    let e = reflection::albedo(smith, alpha, mu, &effort.outer);
    let loss = reflection::loss(smith, alpha, mu, &effort.outer);
    let b = reflection::reflected(smith, alpha, mu, effort, &fresnel::schlick_weight);
    [e, loss, b]
}

fn average<const N: usize>(columns: &Piecewise<3>, f: impl Fn(f64, [f64; 3]) -> [f64; N]) -> [f64; N] {
    let rule = Gauss::new(12);
    let mut total = [0.0; N];
    for cut in columns.cuts().windows(2) {
        let (half, middle) = (0.5 * (cut[1] - cut[0]), 0.5 * (cut[0] + cut[1]));
        for (node, weight) in rule.nodes.iter().zip(&rule.weights) {
            let mu = middle + half * node;
            for (total, value) in total.iter_mut().zip(f(mu, columns.at(mu))) {
                *total += 2.0 * half * weight * mu * value;
            }
        }
    }
    total
}

pub(crate) fn check(input: &'static str, value: f64, range: [f64; 2]) -> Result<(), SurfaceError> {
    if (range[0]..=range[1]).contains(&value) {
        return Ok(());
    }
    let [low, high] = range;
    Err(SurfaceError::Refused(format!(": {input} = {value:?} is outside [{low:?}, {high:?}]")))
}
