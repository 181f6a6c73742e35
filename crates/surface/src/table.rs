//! Every lobe over every coupling: furnace, reciprocity and cost in a row.

use std::sync::Arc;

use rayon::prelude::*;
use serde::Serialize;

use crate::cost::cost;
use crate::measure::{self, Pair, Rules};
pub use crate::row::{ExchangeAt, FurnaceRow, ReciprocityRow};
use crate::{Albedos, Base, Coupling, Lobe, Material, Surface, SurfaceError};
use lobefit_truth::integrate::Estimate;
use lobefit_truth::optics::{AlphaMap, Smith};

/// Where surfaces are measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Grid {
    /// Roughness; alpha is its square.
    pub roughness: Vec<f64>,
    /// Cosines of the view.
    pub mu: Vec<f64>,
    /// Reflectance at normal incidence.
    pub f0: Vec<f64>,
}

impl Grid {
    /// The whole grid: 11 roughnesses from 0.02, 13 cosines from 0.01, six f0 from 0.02 to 1.
    pub fn full() -> Grid {
        Grid {
            roughness: vec![0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
            mu: vec![0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
            f0: vec![0.02, 0.04, 0.08, 0.2, 0.5, 1.0],
        }
    }

    /// A small one, for tests: all its points are points of [`Grid::full`].
    pub fn reduced() -> Grid {
        Grid { roughness: vec![0.3, 0.6, 1.0], mu: vec![0.06, 0.3, 0.7, 1.0], f0: vec![0.04, 1.0] }
    }

    /// Every (alpha, mu), the cosine fastest.
    pub fn views(&self) -> Vec<(f64, f64)> {
        let alpha = |roughness: &f64| AlphaMap::RoughnessSquared.alpha(*roughness);
        self.roughness.iter().flat_map(|r| self.mu.iter().map(move |mu| (alpha(r), *mu))).collect()
    }

    /// The albedos of every roughness.
    pub fn albedos(&self, smith: Smith) -> Result<Vec<Arc<Albedos>>, SurfaceError> {
        let alphas = self.roughness.iter().map(|r| AlphaMap::RoughnessSquared.alpha(*r));
        alphas.map(|alpha| Ok(Arc::new(Albedos::new(smith, alpha)?))).collect()
    }
}

impl ReciprocityRow {
    /// The furnace of largest departure.
    pub fn worst(&self) -> Option<&FurnaceRow> {
        self.furnace.iter().reduce(|a, b| if b.worst.abs() > a.worst.abs() { b } else { a })
    }
}

/// A lobe with what couples its base; none: alone.
type Entry<'a> = (Lobe, Option<&'a Coupling>);

/// Measures every lobe alone and over every one of `couplings`, a white base under Schlick's
/// Fresnel.
///
/// # Errors
/// A surface that cannot be measured; a formula among the couplings whose cost is not known.
pub fn reciprocity_table(
    smith: Smith,
    couplings: &[Coupling],
    grid: &Grid,
) -> Result<Vec<ReciprocityRow>, SurfaceError> {
    rows_of(smith, &Lobe::ALL, couplings, grid)
}

/// The same of these lobes.
///
/// # Errors
/// As [`reciprocity_table`].
pub fn rows_of(
    smith: Smith,
    lobes: &[Lobe],
    couplings: &[Coupling],
    grid: &Grid,
) -> Result<Vec<ReciprocityRow>, SurfaceError> {
    rows_with(smith, lobes, couplings, &[], grid)
}

/// The same with couplings that are made for one lobe each, after the others of that lobe.
///
/// # Errors
/// As [`reciprocity_table`].
pub fn rows_with(
    smith: Smith,
    lobes: &[Lobe],
    couplings: &[Coupling],
    own: &[(Lobe, Coupling)],
    grid: &Grid,
) -> Result<Vec<ReciprocityRow>, SurfaceError> {
    let albedos = grid.albedos(smith)?;
    let of = |lobe: Lobe| {
        let made_for = own.iter().filter(move |(l, _)| *l == lobe).map(|(_, coupling)| coupling);
        let over = couplings.iter().chain(made_for).map(Some);
        std::iter::once(None).chain(over).map(move |coupling| (lobe, coupling))
    };
    let entries: Vec<Entry> = lobes.iter().copied().flat_map(of).collect();
    let furnaces = furnaces(grid, &albedos, &entries)?;
    let pairs = measure::pairs();
    let rows: Vec<Result<ReciprocityRow, SurfaceError>> = entries
        .par_iter()
        .zip(furnaces)
        .map(|((lobe, coupling), furnace)| {
            let (reciprocity, at) = exchange(grid, &albedos, &pairs, *lobe, *coupling)?;
            let cost = cost(*lobe, *coupling)?;
            Ok(ReciprocityRow {
                lobe: lobe.name().into(),
                coupling: coupling.map(|c| c.name().into()),
                reciprocal: lobe.is_reciprocal() && coupling.is_none_or(Coupling::is_reciprocal),
                furnace,
                reciprocity,
                at,
                ops: cost.ops,
                fetches: cost.fetches,
            })
        })
        .collect();
    rows.into_iter().collect()
}

/// A white material, or a white metal, of an f0 for each channel.
fn surface(
    albedos: &Arc<Albedos>,
    f0: [f64; 3],
    lobe: Lobe,
    coupling: Option<&Coupling>,
) -> Result<Surface, SurfaceError> {
    let base = coupling.map(|coupling| Base { albedo: [1.0; 3], coupling: coupling.clone() });
    let (smith, alpha) = (albedos.smith, albedos.alpha);
    Surface::with(&Material { smith, alpha, f0, lobe, base }, albedos.clone())
}

/// The f0 whose furnace a row has.
fn f0_of(grid: &Grid, coupling: Option<&Coupling>) -> Vec<f64> {
    if coupling.is_some() { grid.f0.clone() } else { vec![1.0] }
}

/// Reflectances, one to a channel; the last is repeated where there are fewer.
fn by_channel(f0: &[f64]) -> impl Iterator<Item = [f64; 3]> {
    f0.chunks(3).map(|part| [0, 1, 2].map(|i| part[i.min(part.len() - 1)]))
}

/// Departures from 1 of every entry at one view, by f0. Entries of one lobe share its specular
/// part.
fn departures(
    grid: &Grid,
    albedos: &Arc<Albedos>,
    entries: &[Entry],
    rules: &Rules,
) -> Result<Vec<Vec<f64>>, SurfaceError> {
    let mut shared: Vec<(Lobe, [f64; 3], [Estimate; 3])> = Vec::new();
    let mut all = Vec::with_capacity(entries.len());
    for (lobe, coupling) in entries {
        let wanted = f0_of(grid, *coupling);
        let mut found = Vec::with_capacity(wanted.len());
        for f0 in by_channel(&wanted) {
            let surface = surface(albedos, f0, *lobe, *coupling)?;
            let specular = match shared.iter().find(|(l, f, _)| l == lobe && *f == f0) {
                Some((_, _, specular)) => *specular,
                None => {
                    let specular = rules.specular(&surface)?;
                    shared.push((*lobe, f0, specular));
                    specular
                }
            };
            found.extend(rules.albedo_over(specular, &surface)?.total().map(|albedo| albedo.value - 1.0));
        }
        found.truncate(wanted.len());
        all.push(found);
    }
    Ok(all)
}

/// The furnace rows of every entry: views in parallel, each with its own rules, gathered in order.
fn furnaces(
    grid: &Grid,
    albedos: &[Arc<Albedos>],
    entries: &[Entry],
) -> Result<Vec<Vec<FurnaceRow>>, SurfaceError> {
    let views = grid.views();
    // [view][entry][f0]
    let found: Vec<Result<Vec<Vec<f64>>, SurfaceError>> = views
        .par_iter()
        .enumerate()
        .map(|(i, (alpha, mu))| {
            departures(grid, &albedos[i / grid.mu.len()], entries, &Rules::new(*alpha, *mu))
        })
        .collect();
    let found: Vec<Vec<Vec<f64>>> = found.into_iter().collect::<Result<_, _>>()?;
    let row = |entry: usize, k: usize, f0: f64| {
        let all: Vec<f64> = found.iter().map(|view| view[entry][k]).collect();
        let worst = (0..all.len()).fold(0, |w, i| if all[i].abs() > all[w].abs() { i } else { w });
        let square: f64 = all.iter().map(|x| x * x).sum();
        let (alpha, mu) = views[worst];
        FurnaceRow { f0, worst: all[worst], rms: (square / all.len() as f64).sqrt(), alpha, mu }
    };
    let of_entry = |(i, (_, coupling)): (usize, &Entry)| {
        f0_of(grid, *coupling).into_iter().enumerate().map(|(k, f0)| row(i, k, f0)).collect()
    };
    Ok(entries.iter().enumerate().map(of_entry).collect())
}

/// The largest departure from reciprocity over the grid.
fn exchange(
    grid: &Grid,
    albedos: &[Arc<Albedos>],
    pairs: &[Pair],
    lobe: Lobe,
    coupling: Option<&Coupling>,
) -> Result<(f64, ExchangeAt), SurfaceError> {
    let mut worst: Option<(f64, ExchangeAt)> = None;
    for albedos in albedos {
        for f0 in by_channel(&grid.f0) {
            let surface = surface(albedos, f0, lobe, coupling)?;
            let Some(found) = measure::reciprocity(&surface, pairs)? else { continue };
            if worst.is_none_or(|(departure, _)| found.departure > departure) {
                let Pair { mu_l, mu_v, azimuth } = found.at;
                let at = ExchangeAt { alpha: albedos.alpha, f0: f0[found.channel], mu_l, mu_v, azimuth };
                worst = Some((found.departure, at));
            }
        }
    }
    worst.ok_or(SurfaceError::Refused(": the grid is empty".into()))
}
