//! The functions that compensate a lobe with a value of its table, in every language (Turquin, "Practical multiple
//! scattering compensation for microfacet models", 2019).

use super::spelling::{argument, expression, finish, head, part, vector};
use lobefit_shade::code::Language;
use lobefit_shade::comment::comment;

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
    "ggx_compensate_reflection_factor",
    "ggx_compensate_reflection",
    "ggx_compensate_glass_factor",
    "ggx_compensate_glass",
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

    /// Its functions in a language: one of the factor, one of colours. In C they need [`super::lookup::helpers`].
    pub fn print(self, language: Language) -> String {
        let [of_factor, of_colours] = self.comments();
        format!("{of_factor}{}\n{of_colours}{}", self.factor(language), self.colours(language))
    }

    /// Name of the function of the factor; that of colours is its start.
    fn name(self) -> &'static str {
        match self {
            Compensation::Reflection => "ggx_compensate_reflection_factor",
            Compensation::Glass => "ggx_compensate_glass_factor",
        }
    }

    fn factor(self, language: Language) -> String {
        let (names, value): (&[&str], _) = match self {
            Compensation::Reflection => (&["f0", "e"], "1.0 + f0 * ((1.0 - e) / e)"),
            Compensation::Glass => (&["e"], "1.0 / e"),
        };
        let number = vector(language, 1);
        let arguments: Vec<String> = names.iter().map(|name| argument(language, name, &number)).collect();
        let value = expression(language, value);
        head(language, self.name(), &arguments, &number) + &finish(language, "factor", &[value])
    }

    fn colours(self, language: Language) -> String {
        let (colour, number) = (vector(language, 3), vector(language, 1));
        let (names, whole): (&[&str], _) = match self {
            Compensation::Reflection => (&["f_ss", "f0"], "f_ss * (1.0 + f0 * ((1.0 - e) / e))"),
            Compensation::Glass => (&["f"], "f / e"),
        };
        let colours = names.iter().map(|name| argument(language, name, &colour));
        let arguments: Vec<String> = colours.chain([argument(language, "e", &number)]).collect();
        let head = head(language, self.name().trim_end_matches("_factor"), &arguments, &colour);
        let channel = |i: usize| {
            let [first, f0] = [names[0], "f0"].map(|name| part(language, name, i));
            match self {
                Compensation::Reflection => format!("{first} * {}({f0}, e)", self.name()),
                Compensation::Glass => format!("{first} / e"),
            }
        };
        let end = match language {
            Language::Rust | Language::C => finish(language, "f_ms", &[0, 1, 2].map(channel)),
            _ => format!("    return {};\n}}\n", expression(language, whole)),
        };
        head + &end
    }

    fn comments(self) -> [String; 2] {
        let texts = match self {
            Compensation::Reflection => [REFLECTION_FACTOR, REFLECTION],
            Compensation::Glass => [GLASS_FACTOR, GLASS],
        };
        texts.map(|text| comment("///", &text.lines().map(String::from).collect::<Vec<_>>()))
    }
}

/// The function `name` that is 1 + f0 (N - 1), by a call of N, the function `inner` of the same inputs but f0.
pub fn saturating(
    language: Language,
    name: &str,
    inputs: &[String],
    inner: &str,
    header: &[String],
) -> String {
    let number = vector(language, 1);
    let arguments: Vec<String> = inputs.iter().map(|input| argument(language, input, &number)).collect();
    let passed: Vec<&str> = inputs.iter().map(String::as_str).filter(|input| *input != "f0").collect();
    let call = format!("{inner}({})", passed.join(", "));
    let value = format!("{} + f0 * ({call} - {})", expression(language, "1.0"), expression(language, "1.0"));
    let head = head(language, name, &arguments, &number);
    format!("{}{head}{}", comment("///", header), finish(language, "value", &[value]))
}

/// The compensations that tables of these quantities are made for, each once, in order.
pub fn of<'a>(quantities: impl IntoIterator<Item = &'a str>) -> Vec<Compensation> {
    let mut found: Vec<Compensation> = quantities.into_iter().filter_map(Compensation::of_quantity).collect();
    found.sort();
    found.dedup();
    found
}
