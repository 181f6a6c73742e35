//! The couplings that are compared under a lobe.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::study::coupling::surface::{Base, Coupling, Factor, Lobe, Material};
use crate::study::{Size, StudyError};
use lobefit::approximate::target::TargetSpec;
use lobefit::approximate::{Entry, Fit, Memo, Region};
use lobefit::data::{AlphaMap, Norm, Smith};
use lobefit::effects::coupling::{CouplingSpec, OWN_SPECULAR, OwnSpecular, fit_all, hypotheses};
use lobefit_fit::Goal;
use lobefit_formula::fitting::{Job, fit};
use lobefit_shade::{Hypothesis, Precision};
use lobefit_truth::quantity::{COUPLING, DiffuseCoupling, Specular, Variant};

/// Places in the list of the reference, and of the reference that is reciprocal.
pub(super) const REFERENCE: usize = 0;
pub(super) const RECIPROCAL: usize = 1;

/// What is published, references first.
const PUBLISHED: [Coupling; 11] = [
    Coupling::OneMinusOwnSpecular,
    Coupling::Kelemen,
    Coupling::None,
    Coupling::OneMinusF0,
    Coupling::OneMinusFresnel,
    Coupling::FresnelProduct,
    Coupling::HalfVector,
    Coupling::AshikhminShirley,
    Coupling::Dassault,
    Coupling::SchlickRoughness,
    Coupling::Pesce,
];

/// Reflectances that fits are made for: those of dielectrics with an index of refraction from 1.33
/// to 2.6, which are lit.
pub(super) const F0: [f64; 2] = [0.02, 0.2];

/// Roughness that fits are made for.
const ROUGHNESS: [f64; 2] = [0.02, 1.0];

/// Cosines that fits are made for.
pub(super) const MU: [f64; 2] = [0.01, 1.0];

/// Starting points of a fit: the constants in the files are good ones.
pub(super) const STARTS: usize = 2;

/// A coupling that is to be compared.
#[derive(Clone, Debug)]
pub(super) enum Planned {
    /// A formula of the literature.
    Published(Coupling),
    /// A form of ours.
    Fit(Entry, Kind),
}

/// What a form of ours is fitted for, and used as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The largest error.
    Max,
    /// What is seen.
    Perceptual,
    /// The largest error, and made reciprocal: the factor at the light times that at the view over
    /// its average.
    Symmetrised,
}

impl Planned {
    /// Those of a lobe: of our forms the cheapest, one in the middle and the most accurate, each
    /// fitted for both measures, and the last made reciprocal.
    pub fn of(lobe: Lobe, size: Size) -> Vec<Planned> {
        let mut planned: Vec<Planned> = PUBLISHED.into_iter().map(Planned::Published).collect();
        let forms = specular(lobe).map_or(&[][..], hypotheses);
        let mut chosen = match size {
            Size::Full => vec![0, forms.len() / 2, forms.len().saturating_sub(1)],
            Size::Reduced => vec![0],
        };
        chosen.dedup();
        let chosen: Vec<Entry> = chosen.into_iter().filter_map(|i| forms.get(i).copied()).collect();
        for entry in &chosen {
            planned.extend([Kind::Max, Kind::Perceptual].map(|kind| Planned::Fit(*entry, kind)));
        }
        planned.extend(chosen.last().map(|entry| Planned::Fit(*entry, Kind::Symmetrised)));
        planned
    }

    /// What it follows from.
    pub fn recipe(&self) -> String {
        match self {
            Planned::Published(coupling) => coupling.name().to_string(),
            Planned::Fit(entry, kind) => format!("{kind:?} over f0 {F0:?}, mu {MU:?}: {}", entry.source),
        }
    }
}

/// The couplings themselves; forms of ours are fitted for the lobe, once for each measure.
pub(super) fn made(planned: &[Planned], lobe: Lobe) -> Result<Vec<Candidate>, StudyError> {
    let fits = planned.iter().any(|one| matches!(one, Planned::Fit(..)));
    let emitted = if fits { emitted(lobe)? } else { Vec::new() };
    let mut factors: Vec<Factor> = Vec::new();
    let mut made = Vec::new();
    for one in planned {
        let coupling = match one {
            Planned::Published(coupling) => coupling.clone(),
            Planned::Fit(entry, kind) => {
                let perceptual = *kind == Kind::Perceptual;
                let name = format!("{}{}", entry.name(), if perceptual { ", perceptual" } else { "" });
                let factor = match factors.iter().find(|factor| factor.name() == name) {
                    Some(factor) => factor.clone(),
                    None => fitted(entry, &name, perceptual, lobe, &emitted)?,
                };
                factors.push(factor.clone());
                if *kind == Kind::Symmetrised {
                    Coupling::Symmetrised(factor)
                } else {
                    Coupling::Factor(factor)
                }
            }
        };
        made.push(Candidate { coupling, ours: matches!(one, Planned::Fit(..)) });
    }
    Ok(made)
}

/// A coupling ready to be evaluated.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub coupling: Coupling,
    /// Whether its constants were fitted here.
    pub ours: bool,
}

impl Candidate {
    pub fn name(&self) -> Cow<'_, str> {
        self.coupling.name()
    }

    /// The material of a roughness under a lobe with this coupling; alpha = roughness^2.
    pub fn material(&self, roughness: f64, f0: f64, lobe: Lobe, albedo: [f64; 3]) -> Material {
        let mut material =
            Material::white(AlphaMap::RoughnessSquared.alpha(roughness), f0, lobe, self.coupling.clone());
        material.base = Some(Base { albedo, coupling: self.coupling.clone() });
        material
    }

    /// Whether few rows of pictures must have it: the references, what engines do most, and the
    /// most accurate of ours.
    pub fn telling(&self, candidates: &[Candidate]) -> bool {
        match &self.coupling {
            Coupling::OneMinusOwnSpecular
            | Coupling::Kelemen
            | Coupling::None
            | Coupling::OneMinusFresnel
            | Coupling::Pesce => true,
            Coupling::Symmetrised(_) => true,
            Coupling::Factor(factor) => candidates
                .iter()
                .any(|c| matches!(&c.coupling, Coupling::Symmetrised(both) if both.name() == factor.name())),
            _ => false,
        }
    }

    /// Whether its factor depends on the light's direction.
    pub fn directional(&self) -> bool {
        matches!(
            self.coupling,
            Coupling::FresnelProduct
                | Coupling::HalfVector
                | Coupling::AshikhminShirley
                | Coupling::Dassault
                | Coupling::Kelemen
                | Coupling::Interreflected
                | Coupling::Symmetrised(_)
        )
    }
}

/// Forms of ours for the largest error, as a bake emits them: kept from poles and from below 0
/// wherever a shader may call them.
fn emitted(lobe: Lobe) -> Result<Vec<Fit>, StudyError> {
    let spec = CouplingSpec {
        specular: specular(lobe).unwrap_or_default(),
        smith: Smith::Correlated,
        region: Region { roughness: ROUGHNESS, mu: MU, alpha_map: AlphaMap::RoughnessSquared },
        f0: F0,
        max_ops: None,
        norms: vec![Norm::Max],
    };
    Ok(fit_all(&spec, &Memo::default())?.fits)
}

/// A form of ours with its constants: those that a bake emits, or the ones that lose least of what
/// is seen.
fn fitted(
    entry: &Entry,
    name: &str,
    perceptual: bool,
    lobe: Lobe,
    emitted: &[Fit],
) -> Result<Factor, StudyError> {
    if !perceptual {
        let fit = emitted.iter().find(|fit| fit.approximation.name == name);
        let fit = fit.ok_or_else(|| StudyError::Unfitted { name: name.into() })?;
        return Ok(Factor::fitted(name, &fit.hypothesis, &fit.coefficients())?.above(MU[0]));
    }
    let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
    let specular = specular(lobe).unwrap_or(Specular::Single);
    let job = Job {
        hypothesis,
        spec: TargetSpec {
            quantity: &DiffuseCoupling,
            column: Some("factor".into()),
            used_as: Some(COUPLING),
            variant: Variant { specular: Some(specular), ..Smith::Correlated.into() },
            alpha_map: AlphaMap::RoughnessSquared,
            domain: BTreeMap::from([("f0".to_string(), F0), ("mu".to_string(), MU)]),
        },
        goals: vec![Goal::Rms],
        weight: Some("perceptual".to_string()),
        demands: Vec::new(),
        precisions: vec![Precision::F32],
        starts: STARTS,
        allow_undetermined: true,
        limit: None,
        languages: Vec::new(),
        command: String::new(),
    };
    let fits = fit(&job)?.fits;
    let first = fits.first().ok_or_else(|| StudyError::Unfitted { name: name.into() })?;
    Ok(Factor::fitted(name, &first.hypothesis, &first.coefficients)?.above(MU[0]))
}

/// Couplings of published fits to their own lobe, as [`OwnSpecular`] has them.
pub(super) fn published_fits(lobe: Lobe) -> Result<Vec<Coupling>, StudyError> {
    let Some(specular) = specular(lobe) else { return Ok(Vec::new()) };
    let of = OWN_SPECULAR.iter().filter(|own| own.specular == specular);
    of.map(|OwnSpecular { entry, .. }| {
        let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
        Ok(Coupling::Factor(Factor::fitted(entry.name(), &hypothesis, &[])?))
    })
    .collect()
}

/// What multiplies the lobe, as the quantity names it; none for lobes that the quantity does not
/// have.
fn specular(lobe: Lobe) -> Option<Specular> {
    match lobe {
        Lobe::Single => Some(Specular::Single),
        Lobe::Normalised => Some(Specular::Normalised),
        Lobe::Compensated => Some(Specular::Compensated),
        _ => None,
    }
}
