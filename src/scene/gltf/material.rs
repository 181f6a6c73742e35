//! One material of glTF as materials of a scene: what each extension means for the lobes.

use serde_json::{Value, json};

use super::document::{Extensions, Glossiness, Material, Metallic};
use crate::scene::limits::GLASS_IOR;
use crate::scene::number::{DielectricIor, In, Interval, Numbers};
use crate::scene::value::Maybe;
use lobefit_truth::optics::fresnel::f0_of_ior;

/// Index of refraction where a material states none.
const IOR: f64 = 1.5;

/// Half of the spread of the index over the visible wavelengths, over ior - 1, of a dispersion of 1.
const DISPERSION: f64 = 0.025;

/// A material of the scene: its kind, and its fields but the name, in the order of a scene.
pub(super) struct Part {
    pub kind: &'static str,
    pub fields: Fields,
}

type Fields = Vec<(&'static str, Value)>;

/// What a material becomes.
#[derive(Default)]
pub(super) struct Parts {
    pub parts: Vec<Part>,
    /// What that leaves out or changes, in sentences.
    pub notes: Vec<String>,
}

impl Parts {
    fn note(&mut self, text: &str) {
        self.notes.push(text.into());
    }

    fn add(&mut self, kind: &'static str, fields: Fields) {
        self.parts.push(Part { kind, fields });
    }
}

/// The materials of a scene that a material of glTF calls for: a metal, a dielectric, glass, or several.
pub(super) fn parts(material: &Material) -> Parts {
    let mut out = Parts::default();
    let with = &material.extensions;
    if with.unlit.0.is_some() {
        out.note("unlit: it has no lobe");
        return out;
    }
    match &with.glossiness.0 {
        Some(glossiness) => of_glossiness(glossiness, &mut out),
        None => of_metalness(&material.pbr_metallic_roughness, with, &mut out),
    }
    layers(with, &mut out);
    out
}

/// Metallic-roughness: between the metal and the dielectric lies what mixes both f0, for which the functions
/// of the metal take the mixed one.
fn of_metalness(of: &Metallic, with: &Extensions, out: &mut Parts) {
    let textured = of.metallic_roughness_texture.0.is_some();
    let metalness = range(&of.metallic_factor, 1.0, textured);
    let roughness = range(&of.roughness_factor, 1.0, textured);
    let colour = rgb(&of.base_color_factor, 1.0);
    let shape = shape(roughness, with, out);
    let with_shape = |first: Fields| [first, shape.clone()].concat();
    if metalness[1] > 0.0 {
        out.add("metal", with_shape(vec![("f0", json!(colour))]));
    }
    if metalness[0] == 1.0 {
        return;
    }
    if metalness != [0.0; 2] {
        out.note(
            "metalness between 0 and 1: mix f0 as glTF does and give it to `ggx_energy_compensation_rgb`, whose relative error holds at every f0",
        );
    }
    let ior = with.ior.0.as_ref().and_then(|own| number(&own.ior)).unwrap_or(IOR);
    let transmission = with.transmission.0.as_ref();
    let share = transmission
        .map_or([0.0; 2], |own| range(&own.transmission_factor, 0.0, own.transmission_texture.0.is_some()));
    let is_solid = with.volume.0.as_ref().and_then(|volume| number(&volume.thickness_factor)) > Some(0.0);
    if share[1] > 0.0 && is_solid {
        glass(ior, roughness, with, out);
    } else if share[1] > 0.0 {
        out.note("transmission without a volume is a thin wall: this version has its reflection and not its transmitted lobe");
    }
    if share[0] < 1.0 || !is_solid {
        let mut own = with_shape(vec![reflectance(ior, with)]);
        // What lets all light through scatters none below its surface.
        if share[0] < 1.0 && colour != [0.0; 3] {
            own.push(("base", json!({ "albedo": colour })));
        }
        out.add("dielectric", own);
    }
}

/// Glass of a solid: from outside and from inside, over the indices that its colours have.
fn glass(ior: f64, roughness: [f64; 2], with: &Extensions, out: &mut Parts) {
    let dispersion = with.dispersion.0.as_ref().and_then(|own| number(&own.dispersion)).unwrap_or(0.0);
    let spread = (ior - 1.0) * DISPERSION * dispersion;
    let range = [(ior - spread).max(1.0), (ior + spread).min(GLASS_IOR)];
    if range[0] > range[1] || ior == 0.0 {
        out.note("its index of refraction is beyond 3, where glass ends: its transmitted lobe is left out");
        return;
    }
    if with.anisotropy.0.is_some() {
        out.note("anisotropic glass: this version has tables of isotropic glass alone");
    }
    out.add("glass", vec![("ior", span(range)), ("roughness", span(roughness))]);
}

/// The reflectance of a dielectric: its index, or f0 where `KHR_materials_specular` changes that.
fn reflectance(ior: f64, with: &Extensions) -> (&'static str, Value) {
    let Some(specular) = &with.specular.0 else {
        let has_index = DielectricIor::MIN < ior && ior <= DielectricIor::MAX;
        return if has_index { ("ior", json!(ior)) } else { ("f0", json!(tidy(f0_of(ior)))) };
    };
    let factor = number(&specular.specular_factor).unwrap_or(1.0);
    let colour = specular.specular_color_factor.0.as_ref().map_or([1.0; 3], values);
    ("f0", json!(colour.map(|c| tidy((f0_of(ior) * c).min(1.0) * factor))))
}

/// f0 of an index; glTF's 0 stands for an infinite one.
fn f0_of(ior: f64) -> f64 {
    if ior == 0.0 { 1.0 } else { f0_of_ior(ior) }
}

/// Specular-glossiness, which glTF had before: a dielectric of this f0 over a diffuse base.
fn of_glossiness(of: &Glossiness, out: &mut Parts) {
    let [low, high] = range(&of.glossiness_factor, 1.0, of.specular_glossiness_texture.0.is_some());
    let diffuse = rgb(&of.diffuse_factor, 1.0);
    let f0 = of.specular_factor.0.as_ref().map_or([1.0; 3], values);
    let mut fields = vec![("f0", json!(f0)), ("roughness", span([1.0 - high, 1.0 - low]))];
    if diffuse == [0.0; 3] {
        return out.add("metal", fields);
    }
    fields.push(("base", json!({ "albedo": diffuse })));
    out.add("dielectric", fields);
}

/// Roughness and anisotropy of the reflecting lobe. glTF has alpha_b = roughness^2 and alpha_t =
/// mix(alpha_b, 1, strength^2); a scene alpha = sqrt(alpha_t alpha_b) and alpha_b/alpha_t = 1 - 0.9
/// anisotropy, both of which rise with the strength; the first rises with roughness, the second falls.
fn shape(roughness: [f64; 2], with: &Extensions, out: &mut Parts) -> Fields {
    let strength = with
        .anisotropy
        .0
        .as_ref()
        .map_or([0.0; 2], |own| range(&own.anisotropy_strength, 0.0, own.anisotropy_texture.0.is_some()));
    if strength[1] == 0.0 {
        return vec![("roughness", span(roughness))];
    }
    let widths = |roughness: f64, strength: f64| {
        let across = roughness * roughness;
        [across, across + (1.0 - across) * strength * strength]
    };
    let own = |roughness: f64, strength: f64| {
        let [across, along] = widths(roughness, strength);
        (across * along).sqrt().sqrt()
    };
    let anisotropy = |roughness: f64, strength: f64| {
        let [across, along] = widths(roughness, strength);
        if along > 0.0 { (1.0 - across / along) / 0.9 } else { 0.0 }
    };
    let [low, high] = [anisotropy(roughness[1], strength[0]), anisotropy(roughness[0], strength[1])];
    out.note(
        "anisotropy: with alpha_b and alpha_t of glTF call functions with roughness = (alpha_t alpha_b)^(1/4) and anisotropy = (1 - alpha_b/alpha_t)/0.9",
    );
    if high > 1.0 {
        out.note("its alpha_t is more than 10 times its alpha_b somewhere, where the anisotropy of a scene ends: clamp it to 1 there");
    }
    let range = [own(roughness[0], strength[0]), own(roughness[1], strength[1])];
    vec![("roughness", span(range)), ("anisotropy", span([low.min(1.0), high.min(1.0)]))]
}

/// Layers above and effects beside the lobes: the sheen, and what this version leaves out.
fn layers(with: &Extensions, out: &mut Parts) {
    if let Some(sheen) = &with.sheen.0
        && rgb3(&sheen.sheen_color_factor, 0.0) != [0.0; 3]
    {
        let roughness = range(&sheen.sheen_roughness_factor, 0.0, sheen.sheen_roughness_texture.0.is_some());
        // One layer covers the surface: it stands once, at the last of the parts that reflect alone.
        if let Some(part) = out.parts.iter_mut().rfind(|part| part.kind != "glass") {
            part.fields.push(("sheen", json!({ "roughness": span(roughness) })));
        }
    }
    let present = |factor: Option<f64>| factor > Some(0.0);
    if present(with.clearcoat.0.as_ref().and_then(|own| number(&own.clearcoat_factor))) {
        out.note("clear coat: this version has no coat over a base: the base is planned as if it lay bare");
    }
    if present(with.iridescence.0.as_ref().and_then(|own| number(&own.iridescence_factor))) {
        out.note(
            "iridescence: its film changes f0 with the angle, and what is promised for an f0 is void there",
        );
    }
    let diffuse = with.diffuse_transmission.0.as_ref();
    if present(diffuse.and_then(|own| number(&own.diffuse_transmission_factor))) {
        out.note("diffuse transmission: this version has no base that lets light through: it is planned as one that does not");
    }
}

/// The range of a factor: from 0 where a texture multiplies it.
fn range<I>(factor: &Maybe<In<I>>, default: f64, textured: bool) -> [f64; 2] {
    let factor = number(factor).unwrap_or(default);
    [if textured { 0.0 } else { factor }, factor]
}

/// A range, or a number where both ends are equal.
fn span(range: [f64; 2]) -> Value {
    let range = range.map(tidy);
    if range[0] == range[1] { json!(range[0]) } else { json!(range) }
}

/// A derived number without the digits of its rounding.
fn tidy(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

fn number<I>(given: &Maybe<In<I>>) -> Option<f64> {
    given.0.as_ref().map(|number| number.0)
}

fn values<I>(given: &Numbers<In<I>, 3, false>) -> [f64; 3] {
    [0, 1, 2].map(|k| given.0[k].0)
}

fn rgb3<I>(given: &Maybe<Numbers<In<I>, 3, false>>, default: f64) -> [f64; 3] {
    given.0.as_ref().map_or([default; 3], values)
}

/// The colour of a factor with alpha.
fn rgb<I>(given: &Maybe<Numbers<In<I>, 4, false>>, default: f64) -> [f64; 3] {
    given.0.as_ref().map_or([default; 3], |of| [0, 1, 2].map(|k| of.0[k].0))
}
