//! The couplings that are compared under a lobe.

use std::collections::BTreeMap;

use crate::data::{AlphaMap, Smith, Use};
use crate::effects::coupling::hypotheses;
use crate::effects::surface::{Base, Coupling, Factor, Lobe, Material};
use crate::effects::target::TargetSpec;
use crate::effects::{Entry, Quantity};
use crate::fit::{Goal, Hypothesis, Precision};
use crate::fitting::{Job, fit};
use crate::integrate::coupling::Specular;
use crate::study::{Size, StudyError};

/// Places in the list of the reference, and of the reference that is reciprocal.
pub(super) const REFERENCE: usize = 0;
pub(super) const RECIPROCAL: usize = 1;

/// What is published, references first.
const PUBLISHED: [Coupling; 10] = [
    Coupling::OneMinusOwnSpecular,
    Coupling::Kelemen,
    Coupling::None,
    Coupling::OneMinusF0,
    Coupling::OneMinusFresnel,
    Coupling::FresnelProduct,
    Coupling::HalfVector,
    Coupling::AshikhminShirley,
    Coupling::SchlickRoughness,
    Coupling::Pesce,
];

/// Starting points of a fit: the constants in the files are good ones.
const STARTS: usize = 2;

/// A coupling that is to be compared.
#[derive(Clone, Debug)]
pub(super) enum Planned {
    /// A formula of the literature.
    Published(Coupling),
    /// A form of ours, its constants fitted for the largest error or for what is seen.
    Fit { entry: Entry, perceptual: bool },
}

impl Planned {
    /// Those of a lobe: of our forms the cheapest, one in the middle and the most accurate, each fitted twice.
    pub fn of(lobe: Lobe, size: Size) -> Vec<Planned> {
        let mut planned: Vec<Planned> = PUBLISHED.into_iter().map(Planned::Published).collect();
        let forms = specular(lobe).map_or(&[][..], hypotheses);
        let mut chosen = match size {
            Size::Full => vec![0, forms.len() / 2, forms.len().saturating_sub(1)],
            Size::Reduced => vec![0],
        };
        chosen.dedup();
        for entry in chosen.into_iter().filter_map(|i| forms.get(i)) {
            planned.extend([false, true].map(|perceptual| Planned::Fit { entry: *entry, perceptual }));
        }
        planned
    }

    /// What it follows from.
    pub fn recipe(&self) -> String {
        match self {
            Planned::Published(coupling) => coupling.name().to_string(),
            Planned::Fit { entry, perceptual } => {
                format!("{} {}", if *perceptual { "perceptual" } else { "max" }, entry.source)
            }
        }
    }

    /// The coupling itself; a form of ours is fitted for a lobe.
    pub fn made(&self, lobe: Lobe) -> Result<Candidate, StudyError> {
        match self {
            Planned::Published(coupling) => Ok(Candidate { coupling: coupling.clone(), ours: false }),
            Planned::Fit { entry, perceptual } => fitted(entry, *perceptual, lobe),
        }
    }
}

/// A coupling ready to be evaluated.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub coupling: Coupling,
    /// Whether its constants were fitted here.
    pub ours: bool,
}

impl Candidate {
    pub fn name(&self) -> &str {
        self.coupling.name()
    }

    /// The material of a roughness under a lobe with this coupling; alpha = roughness^2.
    pub fn material(&self, roughness: f64, f0: f64, lobe: Lobe, albedo: [f64; 3]) -> Material {
        let mut material =
            Material::white(AlphaMap::RoughnessSquared.alpha(roughness), f0, lobe, self.coupling.clone());
        material.base = Some(Base { albedo, coupling: self.coupling.clone() });
        material
    }

    /// Whether its factor depends on the light's direction.
    pub fn directional(&self) -> bool {
        matches!(
            self.coupling,
            Coupling::FresnelProduct
                | Coupling::HalfVector
                | Coupling::AshikhminShirley
                | Coupling::Kelemen
                | Coupling::Interreflected
        )
    }
}

fn fitted(entry: &Entry, perceptual: bool, lobe: Lobe) -> Result<Candidate, StudyError> {
    let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
    let specular = specular(lobe).map_or("single", Specular::name);
    let job = Job {
        hypothesis,
        spec: TargetSpec {
            quantity: Quantity::diffuse_coupling(),
            column: Some("factor".into()),
            used_as: Some(Use::Coupling),
            smith: Smith::Correlated,
            alpha_map: AlphaMap::RoughnessSquared,
            domain: BTreeMap::new(),
            words: BTreeMap::from([("specular".to_string(), specular.to_string())]),
        },
        goals: vec![if perceptual { Goal::Rms } else { Goal::Max }],
        weight: perceptual.then(|| "perceptual".to_string()),
        demands: Vec::new(),
        precisions: vec![Precision::F32],
        starts: STARTS,
        limit: None,
        languages: Vec::new(),
        command: String::new(),
    };
    let fits = fit(&job)?.fits;
    let suffix = if perceptual { ", perceptual" } else { "" };
    let name = format!("{}{suffix}", entry.name());
    let factor = fits.first().map(|fit| Factor::fitted(&name, &fit.hypothesis, &fit.coefficients));
    let factor = factor.ok_or(StudyError::Unfitted { name })??;
    Ok(Candidate { coupling: Coupling::Factor(factor), ours: true })
}

/// What multiplies the lobe, as the quantity names it; none for lobes that the quantity does not have.
fn specular(lobe: Lobe) -> Option<Specular> {
    match lobe {
        Lobe::Single => Some(Specular::Single),
        Lobe::Normalised => Some(Specular::Normalised),
        Lobe::Compensated => Some(Specular::Compensated),
        _ => None,
    }
}
