//! Diffuse couplings: what each departs from white in a furnace, and what is seen of it under an
//! environment.

mod candidates;
mod findings;
mod furnace;
mod lit;
pub mod page;
mod parameters;
mod ranking;
pub mod surface;

use serde_json::Value;

use super::{Size, Study, StudyError};
use crate::study::coupling::findings::{CouplingStudy, Meaning};
use crate::study::coupling::surface::{Coupling, Lobe, SurfaceRows, Wanted};
use candidates::Candidate;
use lobefit::bake::Progress;
use lobefit::report::{Origin, Page, document};
use parameters::Parameters;

/// The study.
pub struct DiffuseCouplings;

impl Study for DiffuseCouplings {
    fn name(&self) -> &'static str {
        "coupling"
    }

    fn code(&self) -> &'static str {
        env!("LOBEFIT_STUDY_COUPLING")
    }

    fn about(&self) -> &'static str {
        "diffuse couplings in a furnace and under a sky: minutes"
    }

    fn parameters(&self, size: Size) -> Result<Value, StudyError> {
        Ok(serde_json::to_value(Parameters::of(size)?)?)
    }

    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError> {
        let found = results(size, origin, progress)?;
        Ok((page::page(&found)?, document("results.json", &found)?))
    }
}

/// A specular lobe with the couplings under it.
struct Compared {
    lobe: Lobe,
    candidates: Vec<Candidate>,
}

/// Runs it.
fn results(size: Size, origin: Origin, progress: &dyn Progress) -> Result<CouplingStudy, StudyError> {
    let parameters = Parameters::of(size)?;
    let mut compared = Vec::new();
    for under in &parameters.lobes {
        progress.stage(&format!("fits, {}", under.lobe.name()));
        let candidates = candidates::made(&under.planned, under.lobe)?;
        compared.push(Compared { lobe: under.lobe, candidates });
    }
    progress.stage("furnace");
    let furnace = furnace::strips(&parameters.furnace, &compared)?;
    progress.stage("lit spheres");
    let lit = lit::strips(&parameters.lit, &compared)?;
    progress.stage("reciprocity and random walks");
    let surfaces = SurfaceRows::measure(&Wanted { own: own(&compared)?, ..wanted(size)? })?;
    let rankings = ranking::rankings(&compared, &furnace, &lit, &parameters.lit)?;
    let meanings = meanings(&compared, &surfaces);
    let parameters = serde_json::to_value(&parameters)?;
    let reduced = size == Size::Reduced;
    Ok(CouplingStudy { origin, reduced, parameters, furnace, lit, rankings, meanings, surfaces })
}

/// Couplings that are made for one lobe: ours with their constants, and published fits.
fn own(compared: &[Compared]) -> Result<Vec<(Lobe, Coupling)>, StudyError> {
    let mut own = Vec::new();
    for Compared { lobe, candidates } in compared {
        let ours = candidates.iter().filter(|c| c.ours).map(|c| c.coupling.clone());
        own.extend(ours.chain(candidates::published_fits(*lobe)?).map(|coupling| (*lobe, coupling)));
    }
    Ok(own)
}

/// What the names of lobes and couplings mean; of forms of ours and of published fits once.
fn meanings(compared: &[Compared], surfaces: &SurfaceRows) -> Vec<Meaning> {
    let entry = |lobe: bool, name: &str, meaning: &str| Meaning {
        lobe,
        name: name.to_string(),
        meaning: meaning.to_string(),
    };
    let mut all: Vec<Meaning> =
        Lobe::ALL.iter().map(|lobe| entry(true, lobe.name(), lobe.meaning())).collect();
    all.extend(Coupling::ALL.iter().map(|c| entry(false, &c.name(), &c.meaning())));
    let has = |end: &str| {
        surfaces.reciprocity.iter().filter_map(|row| row.coupling.as_ref()).any(|name| name.ends_with(end))
    };
    let lobes = compared.iter().filter_map(|c| c.candidates.iter().find(|c| c.ours)).map(Candidate::name);
    if let Some(name) = lobes.min() {
        let meaning = "a form of ours (fits/hypotheses) of roughness, n·v and f0 with constants fitted for f0 from 0.02 to 0.2; the last \
                       number counts its operations";
        all.push(entry(false, &format!("{name}, ..."), meaning));
    }
    if has("_karis") {
        let meaning = "1 less the albedo of a lobe by a published fit of f0 A + B: of Karis, MaterialX, Unreal Engine 5, Ray Tracing \
                       Gems, Tauray";
        all.push(entry(false, "coupling_..._karis, ...", meaning));
    }
    all.push(entry(
        false,
        "7 operations",
        "(1 − f0)(1 − ((1 − roughness)(1 − n·v)²)²), a formula without constants",
    ));
    all.push(entry(
        false,
        "..., perceptual",
        "the constants are fitted for what is seen (fit --weight perceptual)",
    ));
    let both = "made reciprocal: the factor f at the light times that at the view over its average, f(l) f(v)/f_avg; f of a cosine below those that \
                it was fitted for, from 0.01, is f there";
    all.push(entry(false, "..., reciprocal", both));
    all
}

/// What is measured of whole materials.
fn wanted(size: Size) -> Result<Wanted, StudyError> {
    Ok(match size {
        Size::Full => Wanted::full()?,
        Size::Reduced => Wanted::reduced()?,
    })
}
