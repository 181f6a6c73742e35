//! Which materials of a scene are rough, and how reasons name them.

use std::collections::BTreeSet;

use super::demand::Demand;
use crate::data::Ndf;
use crate::scene::{Lobe, Material, Scene};

/// Most materials that a reason names; the rest are counted.
const NAMED: usize = 3;

/// Why a scene leaves out what is of glass, where it has none.
pub(super) const NO_GLASS: &str = "no material is glass";

/// Why a scene leaves out functions of glass, where none of its glass wants them.
pub(super) const NOT_ASKED: &str = "no glass asks for it (`fit`, `refracted_width`)";

/// Materials with a rough specular lobe: place in the scene, material, roughness range.
pub(super) fn rough(scene: &Scene) -> impl Iterator<Item = (usize, &Material, [f64; 2])> {
    let materials = scene.materials.iter().enumerate();
    materials.filter_map(|(i, m)| m.rough_range(scene.alpha).map(|range| (i, m, range)))
}

/// Whether a material's lobe is rough somewhere.
pub(super) fn is_rough(scene: &Scene, material: &Material) -> bool {
    material.rough_range(scene.alpha).is_some()
}

/// Why a scene leaves out what is of a distribution of normals.
pub(super) fn no_distribution(ndf: Ndf, noun: &str) -> String {
    match ndf {
        Ndf::Ggx => format!("every {noun} has Beckmann's distribution"),
        Ndf::Beckmann => format!("no {noun} has Beckmann's distribution"),
    }
}

/// Why a scene leaves out glass of Beckmann's distribution.
pub(super) fn no_beckmann_glass(scene: &Scene) -> String {
    let has = |material: &Material| material.distribution == Ndf::Beckmann;
    no_distribution(Ndf::Beckmann, if scene.materials.iter().any(has) { "glass" } else { "material" })
}

/// What an isotropic approximation leaves out of a material's lobe.
pub(super) fn anisotropy(material: &Material) -> Option<&'static str> {
    matches!(material.lobe(), Lobe::Anisotropic | Lobe::AnisotropicGlass).then_some("anisotropy")
}

/// `a`, `b` stay below alpha 0.0001, which is smooth.
pub(super) fn stay_smooth(materials: &[&Material]) -> String {
    format!("{} {} below alpha 0.0001, which is smooth", named(materials), verb(materials, "stay"))
}

/// The sentences about the groups that have materials.
pub(super) fn reasons(groups: impl IntoIterator<Item = Option<String>>) -> Option<String> {
    let all: Vec<String> = groups.into_iter().flatten().collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// A sentence, where there are materials that it is about.
pub(super) fn about(materials: &[&Material], sentence: impl Fn(&[&Material]) -> String) -> Option<String> {
    (!materials.is_empty()).then(|| sentence(materials))
}

/// The reasons of demands, which are sentences `name: kind with this (its ranges) wants that`: those that
/// differ in the name and in what stands in brackets are one, with the first names and the last.
pub(super) fn grouped(demands: &[Demand]) -> Vec<String> {
    let mut seen = BTreeSet::new();
    let different = demands.iter().filter(|demand| seen.insert(&demand.because));
    let groups = lobefit_math::groups(different, |Demand { because, name, .. }| {
        let rest = because.strip_prefix(&format!("{name}: ")).unwrap_or(because);
        match (rest.find(" ("), rest.find(')')) {
            (Some(open), Some(close)) if open < close => format!("{}{}", &rest[..open], &rest[close + 1..]),
            _ => rest.to_string(),
        }
    });
    groups.iter().map(|(shape, demands)| group(shape, demands)).collect()
}

/// `18 dielectrics with a rough specular lobe want fits: plastic 0, plastic 1 ... car paint 3`.
fn group(shape: &str, demands: &[&Demand]) -> String {
    let names: Vec<&str> = demands.iter().map(|demand| demand.name.as_str()).collect();
    let [first, second, .., last] = &names[..] else {
        return if let [first, last] = &names[..] {
            of_all(shape, 2, &format!("{first}, {last}"))
        } else {
            demands[0].because.clone()
        };
    };
    let dots = if names.len() == 3 { "," } else { " ..." };
    of_all(shape, names.len(), &format!("{first}, {second}{dots} {last}"))
}

fn of_all(shape: &str, count: usize, names: &str) -> String {
    let (kind, rest) = shape.split_once(' ').unwrap_or((shape, ""));
    let plural = if kind.ends_with('s') { "es" } else { "s" };
    format!("{count} {kind}{plural} {}: {names}", rest.replacen(" wants ", " want ", 1))
}

/// The verb as it goes with one material or with several.
pub(super) fn verb(materials: &[&Material], plural: &str) -> String {
    match (materials.len(), plural) {
        (1, "have") => "has".into(),
        (1, "are") => "is".into(),
        (1, _) => format!("{plural}s"),
        _ => plural.into(),
    }
}

/// The first names, and how many more there are.
pub(super) fn named(materials: &[&Material]) -> String {
    let shown = if materials.len() == NAMED + 1 { NAMED + 1 } else { NAMED };
    let first: Vec<String> = materials.iter().take(shown).map(|m| format!("`{}`", m.name)).collect();
    match materials.len().saturating_sub(shown) {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
