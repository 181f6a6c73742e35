//! Which materials of a scene are rough, and how reasons name them.

use crate::scene::{Material, Scene};

/// Most materials that a reason names; the rest are counted.
const NAMED: usize = 3;

/// Materials with a rough specular lobe: place in the scene, material, roughness range.
pub(super) fn rough(scene: &Scene) -> impl Iterator<Item = (usize, &Material, [f64; 2])> {
    let materials = scene.materials.iter().enumerate();
    materials.filter_map(|(i, m)| m.rough_range(scene.alpha).map(|range| (i, m, range)))
}

/// Whether a material's lobe is rough somewhere.
pub(super) fn is_rough(scene: &Scene, material: &Material) -> bool {
    material.rough_range(scene.alpha).is_some()
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
    let first: Vec<String> = materials.iter().take(NAMED).map(|m| format!("`{}`", m.name)).collect();
    match materials.len().saturating_sub(NAMED) {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
