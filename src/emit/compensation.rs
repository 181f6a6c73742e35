//! The functions that compensate a lobe with a value of its table, in every language (Turquin,
//! "Practical multiple scattering compensation for microfacet models", 2019).

use super::include::call;
use lobefit_shade::code::{CodeError, Float, Language};
use lobefit_shade::{ShadeError, Source};
use lobefit_truth::quantity::{self, Fresnel};

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

/// What the functions compute, with their documentation.
const TEXT: &str = include_str!("compensation.wgsl");

impl Compensation {
    /// The compensation that a quantity's albedo is made for.
    pub fn of_quantity(quantity: &str) -> Option<Compensation> {
        Some(match quantity::find(quantity)?.fresnel()? {
            Fresnel::One => Compensation::Reflection,
            Fresnel::Dielectric => Compensation::Glass,
        })
    }

    /// Its functions in a language: one of the factor, one of colours. In C they need
    /// [`helpers`](lobefit_shade::code::helpers).
    ///
    /// # Errors
    /// A text that does not parse, a defect of this program.
    pub fn print(self, language: Language) -> Result<String, CodeError> {
        let source = Source::parse("compensation.wgsl", TEXT)?;
        let [factor, colours] = self.names().map(|name| source.print_documented(language, name));
        Ok(format!("{}\n{}", factor?, colours?))
    }

    /// Its function of colours.
    pub fn of_colours(self) -> &'static str {
        self.names()[1]
    }

    /// Names of the functions of the factor and of colours.
    fn names(self) -> [&'static str; 2] {
        match self {
            Compensation::Reflection => [NAMES[0], NAMES[1]],
            Compensation::Glass => [NAMES[2], NAMES[3]],
        }
    }
}

/// The names of the arguments of one of these functions; none of another.
pub fn arguments(function: &str) -> Option<Vec<String>> {
    let own = NAMES.contains(&function).then_some(TEXT);
    own.and_then(|text| call(text, function)).map(|declared| declared.arguments)
}

/// The function `name` that is 1 + f0 (N - 1) per colour channel, by a call of N, the function `inner`
/// of these arguments in these numbers. It is exact for f0 = 1 wherever N is. With F the furnace error
/// of N, its relative error against 1 + f0 (1/E - 1) is F f0/(E + f0 (1 - E)) <= F for every f0 in [0,
/// 1], so N's certificate stands for it.
///
/// # Errors
/// A name that the language has taken; a text that does not parse, a defect of this program.
pub fn coloured(
    language: Language,
    name: &str,
    arguments: &[String],
    inner: &str,
    float: Float,
    header: &[String],
) -> Result<String, CodeError> {
    let numbers: Vec<String> = arguments.iter().map(|name| format!("{name}: f32")).collect();
    let numbers = numbers.join(", ");
    // the name and the arguments of N; what it computes is printed elsewhere
    let text = format!(
        "{TEXT}\nfn {inner}({numbers}) -> f32 {{ return {}; }}\n\
         fn {name}({numbers}, f0: vec3f) -> vec3f {{ return coloured(f0, {inner}({})); }}\n",
        arguments.join(" + "),
        arguments.join(", ")
    );
    let source = Source::parse("compensation.wgsl", &text)?.inlined(|called| called == "coloured");
    let source = source.in_float(float);
    source.print(language, name, header)
}

/// Operations of the function of [`coloured`] beside N.
///
/// # Errors
/// A text that does not parse, a defect of this program.
pub fn coloured_ops() -> Result<u32, ShadeError> {
    Source::parse("compensation.wgsl", TEXT)?.cost_ops(&["coloured"])
}

/// The compensations that tables of these quantities are made for, each once, in order.
pub fn of<'a>(quantities: impl IntoIterator<Item = &'a str>) -> Vec<Compensation> {
    let mut found: Vec<Compensation> = quantities.into_iter().filter_map(Compensation::of_quantity).collect();
    found.sort();
    found.dedup();
    found
}
