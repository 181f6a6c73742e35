//! The functions around the coupling factors, in every language: the exact factor from E and B, and
//! a base under a lobe. Their formulas are those of `coupling.wgsl`.

use super::role;
use crate::data::ARGUMENT_NAMES;
use lobefit_shade::code::{CodeError, Float, Language};
use lobefit_shade::{ShadeError, Source, Tape};
use lobefit_truth::quantity::Specular;

const TEXT: &str = include_str!("coupling.wgsl");

/// Functions of the text that are written out in those that call them: no file has them.
const INSIDE: [&str; 8] = [
    "factor",
    "base_multiplied",
    "positive",
    "base_single",
    "coloured",
    "average_nodes",
    "average_of",
    "least_average",
];

const COUPLED: &str = "\
The diffuse base is Lambert's: albedo/pi times the factor, which is that of the view, for every light alike.
Energy: in a white environment lobe and white base together send back 1, within the certificates of the factor and of
what multiplies the lobe; an albedo below 1 scales the base's share and its error. Not reciprocal: the factor is of the
view alone.";

const PER_CHANNEL: &str = "\
The same with a reflectance per colour channel: three factors, each that of its channel's f0.";

/// Names of the functions that this module may print, and of the factors.
pub fn names() -> impl Iterator<Item = String> {
    let of_lobe = |specular| [role(specular), exact_name(specular)].into_iter().chain(around(specular));
    Specular::ALL.into_iter().flat_map(of_lobe)
}

/// Names of the functions that may call the factor under a lobe: materials, of one f0 and of one for each
/// channel, and what those of path tracers take.
pub fn around(specular: Specular) -> Vec<String> {
    let name = coupled_name(specular);
    let mut all = vec![name.clone(), coloured(&name)];
    if specular == Specular::Single {
        let reciprocal = [RECIPROCAL, AVERAGE].into_iter().flat_map(|name| [name.into(), coloured(name)]);
        all.extend(reciprocal.chain([EXCHANGED.into()]));
    }
    all
}

/// The functions of a material whose directions can be exchanged. Its lobe must be reciprocal: of
/// ours the bare lobe alone is.
const AVERAGE: &str = "diffuse_coupling_average_single";
const RECIPROCAL: &str = "diffuse_coupled_reciprocal_single";
const EXCHANGED: &str = "diffuse_coupling_reciprocal_single";

const EXCHANGED_TEXT: &str = "\
What the base below has for a factor whose directions can be exchanged: the factor of the light mu_l times that of the
view mu, over their average.";

/// The name of a function's variant for a reflectance per channel.
pub(super) fn coloured(name: &str) -> String {
    format!("{name}_rgb")
}

/// What the four nodes of [`AverageRule`] are off, measured over a material's roughness and all f0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleError {
    /// Largest error of the average.
    pub average: f64,
    /// Largest error, for it, of the light that a white base sends back, over the f0 of the
    /// certificate.
    pub energy: f64,
    /// The same over all f0.
    pub any_energy: f64,
}

/// The functions about the function `factor` of the same file.
fn about(factor: &str, inputs: &[String]) -> Result<Source, ShadeError> {
    let arguments: Vec<String> = inputs.iter().map(|name| format!("{name}: f32")).collect();
    // the factor's name and arguments; what it computes is printed elsewhere
    let stands = format!("fn {factor}({}) -> f32 {{ return {}; }}", arguments.join(", "), inputs.join(" + "));
    let called = format!(
        "fn factor(roughness: f32, alpha: f32, mu: f32, f0: f32) -> f32 {{ return {factor}({}); }}",
        inputs.join(", ")
    );
    let source = Source::parse("coupling.wgsl", &format!("{stands}\n{called}\n{TEXT}"))?;
    Ok(source.inlined(|name| INSIDE.contains(&name)).trimmed().with_arguments(&ARGUMENT_NAMES))
}

/// The functions that no factor is called by.
fn alone() -> Result<Source, ShadeError> {
    about("unfitted", &["f0".to_string()])
}

/// The rule by which the emitted average takes its integral.
#[derive(Clone, Debug, PartialEq)]
pub struct AverageRule {
    /// The cosines at which it has the factor.
    pub nodes: [f32; 4],
    /// The smallest average that a base is divided by.
    pub least: f32,
    average: Tape,
}

impl AverageRule {
    /// The rule of the text.
    ///
    /// # Errors
    /// A text that does not parse, a defect of this program.
    pub fn new() -> Result<AverageRule, ShadeError> {
        let source = alone()?;
        let mut nodes = [0.0; 4];
        for (i, node) in nodes.iter_mut().enumerate() {
            *node = source.tape("average_nodes", i)?.at(&[], &[]);
        }
        let least = source.tape("least_average", 0)?.at(&[], &[]);
        Ok(AverageRule { nodes, least, average: source.tape("average_of", 0)? })
    }

    /// The average as the emitted function has it, of a factor's values at the nodes.
    pub fn average(&self, values: [f32; 4]) -> f32 {
        self.average.at(&values, &[])
    }
}

fn average_text(error: RuleError) -> String {
    format!(
        "its mean over the lights of a white environment, twice the integral of factor mu dmu, by Gauss's rule of\n\
         four nodes: at most {} from the integral at 33 x 33 places of the certificate's roughness and all f0. A constant of\n\
         the material.",
        error.average
    )
}

fn reciprocal_text(error: RuleError, least: f32) -> String {
    format!(
        "A dielectric's BRDF per colour channel whose directions can be exchanged, for path tracers: its bare specular lobe over a\n\
         diffuse base, the factor of the light mu_l times that of the view mu over their average (Kelemen and Szirmay-Kalos, \"A\n\
         microfacet based coupled specular-matte BRDF model with importance sampling\", 2001).\n\
         average is that of the function above. Energy: as the average of the light's factor is the average, the base sends back\n\
         what the view's factor alone would, within {} for the f0 of the certificate and {} for all f0 (measured). Limits: as\n\
         f0 goes to 1 the factor goes to the loss of the bare lobe; an average below {least} counts as {least}, which fades the\n\
         base out and never brightens it.",
        error.energy, error.any_energy
    )
}

fn exact_name(specular: Specular) -> String {
    format!("diffuse_coupling_exact_{}", specular.name())
}

fn coupled_name(specular: Specular) -> String {
    format!("diffuse_coupled_{}", specular.name())
}

/// The factor from E and B, exact: for a table that holds both, or for fits of one's own.
///
/// # Errors
/// A text that does not parse, a defect of this program.
pub fn exact(language: Language, specular: Specular) -> Result<String, CodeError> {
    let what = format!(
        "The coupling factor of a white base under a lobe that is multiplied by {}, exact for the albedo e = E = A + B and the\n\
         bias b = B of the lobe at the same view, from a table of both or from fits: what f0 A + B leaves after that.\n\
         Domain: 0 < e <= 1, 0 <= b <= e, 0 <= f0 <= 1. No light is left at f0 = 1{}.",
        specular.formula(),
        if specular == Specular::Single { ", but for the loss 1 - e" } else { "" }
    );
    alone()?.print(language, &exact_name(specular), &lines(&what))
}

/// Operations of the exact factor.
///
/// # Errors
/// A text that does not parse, a defect of this program.
pub fn exact_ops(specular: Specular) -> Result<u32, ShadeError> {
    alone()?.cost_ops(&[&exact_name(specular)])
}

/// A material: the specular lobe `lobe`, per colour channel and multiplied as the name says, over a
/// base whose factor is that of the function `factor` with these arguments; and the same for an f0
/// per channel.
///
/// # Errors
/// Arguments that no factor has; a text that does not parse, a defect of this program.
pub fn coupled(
    language: Language,
    specular: Specular,
    factor: &str,
    inputs: &[String],
    float: Float,
) -> Result<String, CodeError> {
    let name = coupled_name(specular);
    let (first, kind) = match specular {
        Specular::Single => (
            "A dielectric's BRDF per colour channel: its bare specular lobe over a diffuse base.".to_string(),
            "coupled_single",
        ),
        Specular::Normalised | Specular::Compensated => (
            format!(
                "A dielectric's BRDF per colour channel: its specular lobe, multiplied by {} (N for 1/E), over a diffuse base.",
                specular.formula()
            ),
            "coupled_multiplied",
        ),
    };
    let source = about(factor, inputs)?.renamed(kind, &name)?.renamed(&coloured(kind), &coloured(&name))?;
    let source = source.in_float(float);
    let one = source.print(language, &name, &lines(&format!("{first}\n{COUPLED}")))?;
    let three = source.print(language, &coloured(&name), &lines(PER_CHANNEL))?;
    Ok(format!("{one}\n{three}"))
}

/// The same for path tracers, with the average that it takes: a base under a bare lobe, which may
/// exchange light and view.
///
/// # Errors
/// Arguments that no factor has; a text that does not parse, a defect of this program.
pub fn reciprocal(
    language: Language,
    factor: &str,
    inputs: &[String],
    error: RuleError,
) -> Result<String, CodeError> {
    let (source, least) = (about(factor, inputs)?, AverageRule::new()?.least);
    let of_average = format!("The factor {factor} without its direction:\n{}", average_text(error));
    let functions = [
        (AVERAGE.to_string(), of_average),
        (coloured(AVERAGE), "Its averages for a reflectance per colour channel.".to_string()),
        (EXCHANGED.to_string(), EXCHANGED_TEXT.to_string()),
        (RECIPROCAL.to_string(), reciprocal_text(error, least)),
        (coloured(RECIPROCAL), PER_CHANNEL.to_string()),
    ];
    let printed: Result<Vec<String>, CodeError> =
        functions.iter().map(|(name, text)| source.print(language, name, &lines(text))).collect();
    Ok(printed?.join("\n"))
}

/// Lines of documentation.
fn lines(text: &str) -> Vec<String> {
    text.lines().map(String::from).collect()
}
