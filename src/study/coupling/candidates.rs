//! The couplings that are compared.

use crate::effects::surface::{Base, Coupling, Lobe, Material};
use crate::study::StudyError;

/// A coupling with what the tables say of it.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub coupling: Coupling,
    /// Operations of its factor in the model of the tables; none where a table is looked up.
    pub ops: Option<u64>,
    /// Source of its formula, for one that has a file.
    source: String,
}

impl Candidate {
    pub fn name(&self) -> &str {
        self.coupling.name()
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

    /// What it follows from.
    pub fn recipe(&self) -> String {
        format!("{}{}", self.name(), self.source)
    }

    /// The material of a roughness under a lobe with this coupling; alpha = roughness^2.
    pub fn material(&self, roughness: f64, f0: f64, lobe: Lobe, albedo: [f64; 3]) -> Material {
        let mut material = Material::white(roughness * roughness, f0, lobe, self.coupling.clone());
        material.base = Some(Base { albedo, coupling: self.coupling.clone() });
        material
    }
}

/// Place in the list of the reference, and of the reference that is reciprocal.
pub(super) const REFERENCE: usize = 0;
pub(super) const RECIPROCAL: usize = 1;

/// The couplings of the catalogue, references first.
pub(super) fn candidates() -> Result<Vec<Candidate>, StudyError> {
    let of = |coupling, ops| Candidate { coupling, ops, source: String::new() };
    // Operations beside those of Schlick's Fresnel at the cosine named (5: 1 - c and its fifth power as three products, and the mix), which
    // a shader has or not.
    Ok(vec![
        of(Coupling::OneMinusOwnSpecular, None),
        of(Coupling::Kelemen, None),
        of(Coupling::None, Some(0)),
        of(Coupling::OneMinusF0, Some(1)),
        of(Coupling::OneMinusFresnel, Some(6)),
        of(Coupling::FresnelProduct, Some(13)),
        of(Coupling::HalfVector, Some(1)),
        of(Coupling::AshikhminShirley, Some(13)),
        of(Coupling::SchlickRoughness, Some(8)),
        of(Coupling::Pesce, Some(8)),
    ])
}
