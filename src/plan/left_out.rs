//! Why an effect is left out of a plan.

use super::effect::EffectName;
use super::merge::is_rough;
use crate::scene::{Base, Kind, Lobe, Material, Scene};

/// Most materials that a reason names; the rest are counted.
const NAMED: usize = 3;

/// Why an effect is left out.
pub(super) fn reason(effect: EffectName, scene: &Scene) -> String {
    let lacks = match effect {
        EffectName::Reflection => return no_reflection(scene),
        EffectName::DiffuseCoupling => return no_coupling(scene),
        EffectName::Anisotropy => return no_anisotropy(scene),
        EffectName::Glass => return no_glass(scene),
        EffectName::Sheen => return no_sheen(scene),
        EffectName::Parallax => return no_parallax(scene),
        EffectName::Clearcoat => "has a clear coat",
        EffectName::OrenNayar => "has a rough diffuse base",
        EffectName::Occlusion => "has an occlusion map",
    };
    format!("no material {lacks}")
}

fn no_reflection(scene: &Scene) -> String {
    if scene.materials.is_empty() {
        return "the scene has no materials".into();
    }
    let (rough, smooth): (Vec<&Material>, Vec<&Material>) =
        scene.materials.iter().partition(|m| is_rough(scene, m));
    if rough.is_empty() {
        return format!("no material has a rough specular lobe: {}", stay_smooth(&smooth));
    }
    // What is rough and wants neither table nor fits is anisotropic or glass.
    let (glass, anisotropic): (Vec<&Material>, Vec<&Material>) =
        rough.into_iter().partition(|m| m.lobe() == Lobe::Glass);
    let why = [
        (!anisotropic.is_empty()).then(|| unwanted(&anisotropic)),
        (!glass.is_empty()).then(|| format!("{} {} light", named(&glass), verb(&glass, "transmit"))),
        (!smooth.is_empty()).then(|| stay_smooth(&smooth)),
    ];
    let why: Vec<String> = why.into_iter().flatten().collect();
    format!("no material wants a table or fits of a lobe that only reflects: {}", why.join("; "))
}

fn unwanted(anisotropic: &[&Material]) -> String {
    let be = if anisotropic.len() == 1 { "is" } else { "are" };
    format!("{} {be} anisotropic and {} tables of that", named(anisotropic), verb(anisotropic, "want"))
}

fn no_anisotropy(scene: &Scene) -> String {
    let anisotropic = scene.materials.iter().filter(|m| m.lobe() == Lobe::Anisotropic);
    let (rough, smooth): (Vec<&Material>, Vec<&Material>) = anisotropic.partition(|m| is_rough(scene, m));
    let why = [
        (!rough.is_empty()).then(|| format!("{} {} no table of it", named(&rough), verb(&rough, "want"))),
        (!smooth.is_empty()).then(|| stay_smooth(&smooth)),
    ];
    let why: Vec<String> = why.into_iter().flatten().collect();
    if why.is_empty() {
        return "no material is anisotropic".into();
    }
    format!("no anisotropic material calls for it: {}", why.join("; "))
}

fn no_glass(scene: &Scene) -> String {
    let glass: Vec<&Material> = scene.materials.iter().filter(|m| m.lobe() == Lobe::Glass).collect();
    if glass.is_empty() {
        return "no material transmits light".into();
    }
    format!("no glass is rough: {}", stay_smooth(&glass))
}

fn no_sheen(scene: &Scene) -> String {
    let sheens: Vec<&Material> = scene.materials.iter().filter(|m| m.sheen.is_some()).collect();
    if sheens.is_empty() {
        return "no material has a sheen layer".into();
    }
    let of = if sheens.len() == 1 { "the sheen of" } else { "the sheens of" };
    format!("no sheen is rough: {of} {}", stay_smooth(&sheens))
}

fn no_parallax(scene: &Scene) -> String {
    let Some(first) = scene.probes.first() else { return "the scene has no probe".into() };
    let more = scene.probes.len() - 1;
    let (of, stay) = match more {
        0 => (format!("`{}`", first.name), "stays"),
        _ => (format!("`{}` and {more} more", first.name), "stay"),
    };
    format!("no probe is looked up with a rough lobe: {of} {stay} below alpha 0.0001, which is smooth")
}

fn no_coupling(scene: &Scene) -> String {
    let dielectrics: Vec<&Material> = scene.materials.iter().filter(|m| m.kind == Kind::Dielectric).collect();
    let based = |m: &&&Material| m.base.is_some();
    let (based, bare): (Vec<&Material>, Vec<&Material>) = dielectrics.iter().partition(based);
    if based.is_empty() {
        let but = match bare.is_empty() {
            true => String::new(),
            false => format!(": {} {} no `base`", named(&bare), verb(&bare, "have")),
        };
        return format!("no material is a dielectric with a diffuse base{but}");
    }
    let (black, lit): (Vec<&Material>, Vec<&Material>) =
        based.into_iter().partition(|m| m.base.as_ref().is_some_and(Base::is_black));
    let why = [
        (!black.is_empty()).then(|| {
            format!("{} {} a black base, which sends back nothing", named(&black), verb(&black, "have"))
        }),
        (!lit.is_empty())
            .then(|| format!("{}: there the factor is (1 - f0)(1 - (1 - mu)^5)", stay_smooth(&lit))),
    ];
    let why: Vec<String> = why.into_iter().flatten().collect();
    format!("no dielectric with a diffuse base calls for it: {}", why.join("; "))
}

fn stay_smooth(materials: &[&Material]) -> String {
    format!("{} {} below alpha 0.0001, which is smooth", named(materials), verb(materials, "stay"))
}

/// The verb as it goes with one material or with several.
fn verb(materials: &[&Material], plural: &str) -> String {
    match (materials.len(), plural) {
        (1, "have") => "has".into(),
        (1, _) => format!("{plural}s"),
        _ => plural.into(),
    }
}

/// The first names, and how many more there are.
fn named(materials: &[&Material]) -> String {
    let mut text =
        materials.iter().take(NAMED).map(|m| format!("`{}`", m.name)).collect::<Vec<_>>().join(", ");
    if materials.len() > NAMED {
        text += &format!(" and {} more", materials.len() - NAMED);
    }
    text
}
