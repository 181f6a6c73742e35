//! The couplings of a lobe, by what is seen of them.

use std::sync::Arc;

use super::Compared;
use super::candidates::Candidate;
use super::parameters::Lit;
use crate::study::StudyError;
use crate::study::coupling::findings::{FurnaceStrip, LitRow, LitStrip, Ranked, Ranking};
use crate::study::coupling::surface::measure::{self, Pair};
use crate::study::coupling::surface::{Albedos, Lobe, Material, Surface, cost};
use lobefit::data::{AlphaMap, Smith};
use lobefit_formula::perceptual::Perceptual;
use lobefit_math::sum::mean;

/// One ranking for each lobe, over the reflectances of dielectrics, for which the fits are made.
pub(super) fn rankings(
    compared: &[Compared],
    furnace: &[FurnaceStrip],
    lit: &[LitStrip],
    parameters: &Lit,
) -> Result<Vec<Ranking>, StudyError> {
    let weight = Perceptual::new();
    let exchange = Exchange::of(parameters)?;
    let f0 = &parameters.ranked_f0;
    let furnace: Vec<&FurnaceStrip> = furnace.iter().filter(|s| f0.contains(&s.f0)).collect();
    let lit: Vec<&LitStrip> = lit.iter().filter(|s| f0.contains(&s.f0)).collect();
    let one = |Compared { lobe, candidates }: &Compared| {
        let ranked = |c: &Candidate| ranked(c, *lobe, (&furnace, &lit), &weight, &exchange);
        let mut rows = candidates.iter().map(ranked).collect::<Result<Vec<Ranked>, StudyError>>()?;
        rows.sort_by(|a, b| a.flip.total_cmp(&b.flip));
        Ok(Ranking { lobe: lobe.name().into(), f0: f0.clone(), rows })
    };
    compared.iter().map(one).collect()
}

fn ranked(
    candidate: &Candidate,
    lobe: Lobe,
    (furnace, lit): (&[&FurnaceStrip], &[&LitStrip]),
    weight: &Perceptual,
    exchange: &Exchange,
) -> Result<Ranked, StudyError> {
    let reciprocity = exchange.base(candidate, lobe)?;
    let whole = cost(lobe, Some(&candidate.coupling))?;
    let ops = whole.ops.saturating_sub(cost(lobe, None)?.ops);
    let (name, lobe) = (candidate.name().into_owned(), lobe.name());
    let lit_rows: Vec<&LitRow> =
        lit.iter().filter(|s| s.lobe == lobe).flat_map(|s| &s.rows).filter(|r| r.name == name).collect();
    let over =
        |of: fn(&LitRow) -> &Vec<f64>| lit_rows.iter().flat_map(|r| of(r)).copied().collect::<Vec<f64>>();
    let errors = over(|r| &r.error);
    let strips = furnace.iter().copied().filter(|s| s.lobe == lobe);
    let departures = Departures::of(&name, strips, weight);
    Ok(Ranked {
        name,
        reciprocity,
        directional: candidate.directional(),
        ours: candidate.ours,
        ops,
        fetches: whole.fetches,
        flip: mean(&over(|r| &r.flip)),
        // All spheres are lit from the same directions: the errors do not average out.
        flip_error: mean(&errors),
        flip_reciprocal: mean(&over(|r| &r.flip_reciprocal)),
        furnace_max: departures.largest,
        perceptual: departures.weighted,
    })
}

/// Where the two directions of a base are exchanged.
struct Exchange {
    albedos: Vec<Arc<Albedos>>,
    f0: Vec<f64>,
    pairs: Vec<Pair>,
}

impl Exchange {
    fn of(lit: &Lit) -> Result<Exchange, StudyError> {
        let alphas = lit.roughness.iter().map(|r| AlphaMap::RoughnessSquared.alpha(*r));
        let albedos = alphas.map(|alpha| Ok(Arc::new(Albedos::new(Smith::Correlated, alpha)?)));
        let albedos = albedos.collect::<Result<_, StudyError>>()?;
        Ok(Exchange { albedos, f0: lit.ranked_f0.clone(), pairs: measure::pairs() })
    }

    /// The largest departure from reciprocity of a base.
    fn base(&self, candidate: &Candidate, lobe: Lobe) -> Result<f64, StudyError> {
        let mut worst: f64 = 0.0;
        for albedos in &self.albedos {
            for f0 in &self.f0 {
                let material = candidate.material(albedos.alpha.sqrt(), *f0, lobe, [1.0; 3]);
                let material = Material { alpha: albedos.alpha, ..material };
                let surface = Surface::with(&material, albedos.clone())?;
                let found = measure::base_reciprocity(&surface, &self.pairs)?;
                worst = found.map_or(worst, |found| worst.max(found.departure));
            }
        }
        Ok(worst)
    }
}

/// Departures from white over roughness, mu and reflectance.
struct Departures {
    largest: f64,
    weighted: f64,
}

impl Departures {
    fn of<'a>(name: &str, strips: impl Iterator<Item = &'a FurnaceStrip>, weight: &Perceptual) -> Departures {
        let (mut largest, mut sum, mut total) = (0.0_f64, 0.0, 0.0);
        for strip in strips {
            for row in strip.rows.iter().filter(|r| r.name == name) {
                for albedo in &row.albedo {
                    for ((&mu, step), a) in strip.mu.iter().zip(steps(&strip.mu)).zip(albedo) {
                        let (w, d) = (weight.at(mu), a - 1.0);
                        largest = largest.max(d.abs());
                        sum += step * w * w * d * d;
                        total += step * w * w;
                    }
                }
            }
        }
        Departures { largest, weighted: if total > 0.0 { (sum / total).sqrt() } else { 0.0 } }
    }
}

/// Width of the cell of each of increasing places in [0, 1]: half way to its neighbours, or to the
/// ends.
fn steps(places: &[f64]) -> Vec<f64> {
    let edge = |i: usize| match (places.get(i.wrapping_sub(1)), places.get(i)) {
        (None, _) => 0.0,
        (_, None) => 1.0,
        (Some(a), Some(b)) => (a + b) / 2.0,
    };
    (0..places.len()).map(|i| edge(i + 1) - edge(i)).collect()
}
