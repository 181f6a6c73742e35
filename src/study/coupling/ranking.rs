//! The couplings of a lobe, by what is seen of them.

use super::Compared;
use super::candidates::Candidate;
use crate::effects::surface::{Lobe, cost};
use crate::fitting::Perceptual;
use crate::math::sum::mean;
use crate::report::{FurnaceStrip, LitRow, LitStrip, Ranked, Ranking};
use crate::study::StudyError;

/// One ranking for each lobe, over the reflectances that are lit.
pub(super) fn rankings(
    compared: &[Compared],
    furnace: &[FurnaceStrip],
    lit: &[LitStrip],
) -> Result<Vec<Ranking>, StudyError> {
    let weight = Perceptual::new();
    let one = |Compared { lobe, candidates }: &Compared| {
        let ranked = |c: &Candidate| ranked(c, *lobe, (furnace, lit), &weight);
        let mut rows = candidates.iter().map(ranked).collect::<Result<Vec<Ranked>, StudyError>>()?;
        rows.sort_by(|a, b| a.flip.total_cmp(&b.flip));
        Ok(Ranking { lobe: lobe.name().into(), rows })
    };
    compared.iter().map(one).collect()
}

fn ranked(
    candidate: &Candidate,
    lobe: Lobe,
    (furnace, lit): (&[FurnaceStrip], &[LitStrip]),
    weight: &Perceptual,
) -> Result<Ranked, StudyError> {
    let whole = cost(lobe, Some(&candidate.coupling))?;
    let ops = whole.ops.saturating_sub(cost(lobe, None)?.ops);
    let (name, lobe) = (candidate.name().into_owned(), lobe.name());
    let lit_rows: Vec<&LitRow> =
        lit.iter().filter(|s| s.lobe == lobe).flat_map(|s| &s.rows).filter(|r| r.name == name).collect();
    let over =
        |of: fn(&LitRow) -> &Vec<f64>| lit_rows.iter().flat_map(|r| of(r)).copied().collect::<Vec<f64>>();
    let errors = over(|r| &r.error);
    let seen = |f0: f64| lit.iter().any(|s| s.f0 == f0);
    let strips = furnace.iter().filter(|s| s.lobe == lobe && seen(s.f0));
    let departures = Departures::of(&name, strips, weight);
    Ok(Ranked {
        name,
        reciprocal: candidate.coupling.is_reciprocal(),
        directional: candidate.directional(),
        ours: candidate.ours,
        ops,
        fetches: whole.fetches,
        flip: mean(&over(|r| &r.flip)),
        // Of a mean of independent figures.
        flip_error: errors.iter().map(|e| e * e).sum::<f64>().sqrt() / errors.len().max(1) as f64,
        flip_reciprocal: mean(&over(|r| &r.flip_reciprocal)),
        furnace_max: departures.largest,
        perceptual: departures.weighted,
    })
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

/// Width of the cell of each of increasing places in [0, 1]: half way to its neighbours, or to the ends.
fn steps(places: &[f64]) -> Vec<f64> {
    let edge = |i: usize| match (places.get(i.wrapping_sub(1)), places.get(i)) {
        (None, _) => 0.0,
        (_, None) => 1.0,
        (Some(a), Some(b)) => (a + b) / 2.0,
    };
    (0..places.len()).map(|i| edge(i + 1) - edge(i)).collect()
}
