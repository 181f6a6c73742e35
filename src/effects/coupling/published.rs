//! What engines ship for this effect: measured and reported beside ours, not emitted.
//! `tests/effects/published_coupling.rs` reproduces their published comparison.

use crate::approximate::{Entry, published};
use lobefit_fit::FitError;
use lobefit_shade::Hypothesis;
use lobefit_truth::quantity::Specular;

/// The factor, or its mean over the lights of a white environment where it depends on the light.
pub const PUBLISHED: [Entry; 8] = published![
    "coupling_none" by "no coupling",
    "coupling_f0" by "1 - f0",
    "coupling_fresnel" by "1 - F(mu)",
    "coupling_gltf" by "Khronos, glTF 2.0, appendix B, 1 - F(v.h)",
    "coupling_ashikhmin_shirley" by "Ashikhmin and Shirley, An Anisotropic Phong BRDF Model, 2000",
    "coupling_schlick_roughness" by "S. Lagarde; C. Fdez-Aguera 2019; LearnOpenGL, 1 - F with roughness",
    "coupling_pesce" by "A. Pesce, Misunderstanding Multiscattering, 2019",
    "coupling_dassault" by "Dassault Systemes, Enterprise PBR Shading Model",
];

/// What a shader computes of the formulas that depend on the light, for their cost: `l` is the
/// light's cosine, `vh` that between view and half vector.
pub(super) const LIGHTS: [(&str, &str); 3] = [
    (
        "coupling_gltf",
        "fn coupling_gltf_light(vh: f32, f0: f32) -> f32 {
            let x = 1.0 - vh;
            let x2 = x * x;
            return (1.0 - f0) * (1.0 - x2 * x2 * x);
        }",
    ),
    (
        "coupling_ashikhmin_shirley",
        "fn through(x: f32) -> f32 {
            let x2 = x * x;
            return 1.0 - x2 * x2 * x;
        }
        fn coupling_ashikhmin_shirley_light(l: f32, mu: f32, f0: f32) -> f32 {
            return (1.2173913 - 1.2173913 * f0) * through(1.0 - 0.5 * l) * through(1.0 - 0.5 * mu);
        }",
    ),
    (
        "coupling_dassault",
        "fn left(x: f32, f0: f32, facing: f32, weight: f32) -> f32 {
            let x2 = x * x;
            return 1.0 - mix(f0 + (1.0 - f0) * (x2 * x2 * x), facing, weight);
        }
        fn coupling_dassault_light(alpha: f32, l: f32, mu: f32, f0: f32) -> f32 {
            let y = 1.0 - alpha;
            let y2 = y * y;
            let weight = 1.0 - y2 * y2 * y;
            let facing = 0.04762 + 0.95238 * f0;
            let average = f0 - (0.33263 * alpha + 0.072359) * (1.0 - f0) * f0;
            return left(1.0 - l, f0, facing, weight) * left(1.0 - mu, f0, facing, weight) / (1.0 - average);
        }",
    ),
];

/// Operations of a formula's form for a light; none of a formula that does not depend on it.
///
/// # Errors
/// A form that does not parse.
pub fn light_ops(name: &str) -> Result<Option<u32>, FitError> {
    let Some((_, source)) = LIGHTS.iter().find(|(known, _)| *known == name) else { return Ok(None) };
    Ok(Some(Hypothesis::parse(name, source)?.tape().cost_ops()))
}

/// 1 less the albedo of a published lobe, f0 A + B, times what its own E says that a lobe of this
/// kind is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnSpecular {
    /// What multiplies the lobe.
    pub specular: Specular,
    /// The factor.
    pub entry: Entry,
}

/// The factors of one published f0 A + B, with its arguments but f0 (declared, and as they are
/// passed).
macro_rules! own_specular {
    ($($name:literal of $blend:literal ($declared:literal, $passed:literal) by $publication:literal),* $(,)?) => {
        [$(
            own_specular!(@ Single, "single", $name, $blend, $declared, $passed, $publication, "1.0 - albedo"),
            own_specular!(@ Normalised, "normalised", $name, $blend, $declared, $passed, $publication, "1.0 - albedo / e"),
            own_specular!(@ Compensated, "compensated", $name, $blend, $declared, $passed, $publication,
                "1.0 - albedo * (1.0 + f0 * (1.0 / e - 1.0))"),
        )*]
    };
    (@ $specular:ident, $word:literal, $name:literal, $blend:literal, $declared:literal, $passed:literal, $publication:literal,
     $value:literal) => {
        OwnSpecular {
            specular: Specular::$specular,
            entry: Entry {
                file: concat!("published/coupling_", $word, "_", $name, ".wgsl"),
                source: concat!(
                    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/fits/hypotheses/published/", $blend, ".wgsl")),
                    "\n/// Published: 1 less the specular albedo that the lobe above comes to by its own fit.\n",
                    "fn coupling_", $word, "_", $name, "(", $declared, ", f0: f32) -> f32 {\n",
                    "    let albedo = ", $blend, "(", $passed, ", f0);\n",
                    "    let e = ", $blend, "(", $passed, ", 1.0);\n",
                    "    return ", $value, ";\n}\n",
                ),
                publication: Some($publication),
            },
        }
    };
}

/// 1 less the specular albedo of each.
pub const OWN_SPECULAR: [OwnSpecular; 15] = own_specular![
    "karis" of "ggx_blend_karis" ("roughness: f32, mu: f32", "roughness, mu")
        by "1 - own albedo, B. Karis, Physically Based Shading on Mobile, 2014",
    "materialx_m1" of "ggx_blend_materialx_m1" ("alpha: f32, mu: f32", "alpha, mu")
        by "1 - own albedo, MaterialX, mx_microfacet_specular",
    "ue5" of "ggx_blend_ue5" ("roughness: f32, mu: f32", "roughness, mu")
        by "1 - own albedo, Unreal Engine 5, ShadingEnergyConservation",
    "ray_tracing_gems" of "ggx_blend_ray_tracing_gems" ("alpha: f32, mu: f32", "alpha, mu")
        by "1 - own albedo, Ray Tracing Gems, ch. 32, 2019, for separable Smith",
    "tauray" of "ggx_blend_tauray" ("roughness: f32, alpha: f32, mu: f32", "roughness, alpha, mu")
        by "1 - own albedo, VGA group, Tauray",
];
