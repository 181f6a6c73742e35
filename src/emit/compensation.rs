//! The functions that compensate a lobe with a value of its table, in WGSL and in Rust (Turquin, "Practical multiple
//! scattering compensation for microfacet models", 2019).

use super::comment::comment;

/// A lobe that is compensated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Compensation {
    /// Reflection by a conductor, or by the coat of a dielectric: f_ms = (1 + F0 (1 - E)/E) f_ss.
    Reflection,
    /// Reflection and transmission of rough glass: f_ms = f_ss/E for both.
    Glass,
}

/// Names of the functions, in the order of the text.
pub const NAMES: [&str; 4] = [
    "ggx_compensate_reflection",
    "ggx_compensate_reflection_factor",
    "ggx_compensate_glass",
    "ggx_compensate_glass_factor",
];

const REFLECTION: &str = "\
A metal's lobe f_ss compensated for the light that it loses between facets: (1 + F0 (1 - E)/E) f_ss, per colour
channel. f_ss has its Fresnel factor; e is the sampled albedo of the same lobe without it (F = 1), at the same view.
Energy: with f0 = 1 all light comes back, E (1 + (1 - E)/E) = 1; with f0 < 1 the light added is tinted by f0 once,
where every further bounce would tint it again. Not reciprocal: E is of the view alone.
Domain: 0 < e <= 1; e = 1 returns f_ss. As e goes to 0 the factor grows as f0/e, while f_ss vanishes as e does: at
e = 0 itself, which no table holds for a view above the horizon, the result is not finite.
Turquin, \"Practical multiple scattering compensation for microfacet models\", 2019.";

const GLASS: &str = "\
Rough glass compensated for the light that it loses between facets: f/E, for the reflected and the transmitted lobe
alike, per colour channel. e is the sampled R + T of a ray from the same side, at the same view and index of
refraction; f may hold the factor 1/eta^2 of radiance, which E, a share of energy, does not.
Energy: without absorption all light leaves again, (R + T)/E = 1, in the shares that single scattering has. Not
reciprocal: E is of the view alone.
Domain: 0 < e <= 1; e = 1 returns f. As e goes to 0 the factor grows as 1/e, while f vanishes as e does: at e = 0
itself, which no table holds for a view above the horizon, the result is not finite.
Turquin, \"Practical multiple scattering compensation for microfacet models\", 2019.";

/// What the scalar functions are.
const REFLECTION_FACTOR: &str = "\
The factor of ggx_compensate_reflection for one colour channel, 1 + F0 (1 - E)/E: for lobes that are sampled, to
multiply the path's weight by.";
const GLASS_FACTOR: &str = "\
The factor of ggx_compensate_glass, 1/E: for lobes that are sampled, to multiply the path's weight by.";

impl Compensation {
    /// The compensation that a quantity's albedo is made for.
    pub fn of_quantity(quantity: &str) -> Option<Compensation> {
        match quantity {
            "ggx-reflection" | "ggx-reflection-aniso" => Some(Compensation::Reflection),
            "ggx-glass" => Some(Compensation::Glass),
            _ => None,
        }
    }

    /// Its WGSL functions: one of colours, one of the factor.
    pub fn wgsl(self) -> String {
        let [of_colours, of_factor] = self.comments();
        match self {
            Compensation::Reflection => format!(
                "{of_colours}fn ggx_compensate_reflection(f_ss: vec3<f32>, f0: vec3<f32>, e: f32) -> vec3<f32> {{
    return f_ss * (1.0 + f0 * ((1.0 - e) / e));
}}

{of_factor}fn ggx_compensate_reflection_factor(f0: f32, e: f32) -> f32 {{
    return 1.0 + f0 * ((1.0 - e) / e);
}}
"
            ),
            Compensation::Glass => format!(
                "{of_colours}fn ggx_compensate_glass(f: vec3<f32>, e: f32) -> vec3<f32> {{
    return f / e;
}}

{of_factor}fn ggx_compensate_glass_factor(e: f32) -> f32 {{
    return 1.0 / e;
}}
"
            ),
        }
    }

    /// The same in Rust.
    pub fn rust(self) -> String {
        let [of_colours, of_factor] = self.comments();
        match self {
            Compensation::Reflection => format!(
                "{of_colours}pub fn ggx_compensate_reflection(f_ss: [f32; 3], f0: [f32; 3], e: f32) -> [f32; 3] {{
    let channel = |c: usize| f_ss[c] * ggx_compensate_reflection_factor(f0[c], e);
    [channel(0), channel(1), channel(2)]
}}

{of_factor}pub fn ggx_compensate_reflection_factor(f0: f32, e: f32) -> f32 {{
    1.0 + f0 * ((1.0 - e) / e)
}}
"
            ),
            Compensation::Glass => format!(
                "{of_colours}pub fn ggx_compensate_glass(f: [f32; 3], e: f32) -> [f32; 3] {{
    [f[0] / e, f[1] / e, f[2] / e]
}}

{of_factor}pub fn ggx_compensate_glass_factor(e: f32) -> f32 {{
    1.0 / e
}}
"
            ),
        }
    }

    fn comments(self) -> [String; 2] {
        let texts = match self {
            Compensation::Reflection => [REFLECTION, REFLECTION_FACTOR],
            Compensation::Glass => [GLASS, GLASS_FACTOR],
        };
        texts.map(|text| comment("///", &text.lines().map(String::from).collect::<Vec<_>>()))
    }
}

/// The compensations that tables of these quantities are made for, each once, in order.
pub fn of<'a>(quantities: impl IntoIterator<Item = &'a str>) -> Vec<Compensation> {
    let mut found: Vec<Compensation> = quantities.into_iter().filter_map(Compensation::of_quantity).collect();
    found.sort();
    found.dedup();
    found
}
