//! The functions around the coupling factors, in every language: the exact factor from E and B, and a base under a lobe.

use super::code::Language;
use super::comment::comment;
use super::spelling::{argument, declare, expression, finish, head, part, vector};
use crate::integrate::coupling::Specular;

/// 1/pi, of Lambert's lobe.
const INVERSE_PI: &str = "0.31830987";

const COUPLED: &str = "\
The diffuse base is Lambert's: albedo/pi times the factor, which is that of the view, for every light alike.
Energy: in a white environment lobe and white base together send back 1, within the certificates of the factor and of
what multiplies the lobe; an albedo below 1 scales the base's share and its error. Not reciprocal: the factor is of the
view alone.";

/// Names of the functions that this module may print.
pub fn names() -> impl Iterator<Item = String> {
    let around =
        Specular::ALL.into_iter().flat_map(|specular| [exact_name(specular), coupled_name(specular)]);
    around.chain([AVERAGE, RECIPROCAL].map(String::from))
}

/// The functions of a material whose directions can be exchanged. Its lobe must be such a one, which of ours the bare one alone is.
const AVERAGE: &str = "diffuse_coupling_average_single";
const RECIPROCAL: &str = "diffuse_coupled_reciprocal_single";

/// Nodes and weights of the Gauss rule of four nodes for the integral of f(mu) 2 mu over [0, 1].
const RULE: [(&str, &str); 4] = [
    ("0.13975986", "0.062361942"),
    ("0.41640957", "0.2596951"),
    ("0.72315699", "0.40692914"),
    ("0.9428958", "0.27101383"),
];

const AVERAGE_TEXT: &str = "\
its mean over the lights of a white environment, twice the integral of factor mu dmu, by Gauss's rule of
four nodes: within 0.001 of the integral. A constant of the material.";

const RECIPROCAL_TEXT: &str = "\
A dielectric's BRDF per colour channel whose directions can be exchanged, for path tracers: its bare specular lobe over a
diffuse base, the factor of the light mu_l times that of the view mu over their average (Kelemen and Szirmay-Kalos, \"A
microfacet based coupled specular-matte BRDF model with importance sampling\", 2001).
average is that of the function above. Energy: as the average of the light's factor is the average, the base sends back
what the view's factor alone would, within 0.001 of it. Domain: average above 0, so f0 below 1; the base vanishes as
f0 goes to 1.";

fn exact_name(specular: Specular) -> String {
    format!("diffuse_coupling_{}", specular.name())
}

fn coupled_name(specular: Specular) -> String {
    format!("diffuse_coupled_{}", specular.name())
}

/// The factor from E and B, exact: for a table that holds both, or for fits of one's own.
pub fn exact(language: Language, specular: Specular) -> String {
    let number = vector(language, 1);
    let arguments = ["f0", "e", "b"].map(|name| argument(language, name, &number));
    let left = "(1.0 - f0) * (1.0 - b / e)";
    let (lines, value) = match specular {
        Specular::Single => (String::new(), "1.0 - (b + f0 * (e - b))"),
        Specular::Normalised => (String::new(), left),
        Specular::Compensated => (
            declare(language, &number, "left", &expression(language, left)),
            "left + (1.0 - f0) * (1.0 - e) * (1.0 - left)",
        ),
    };
    let what = format!(
        "The coupling factor of a white base under a lobe that is multiplied by {}, exact for the albedo e = E = A + B and the\n\
         bias b = B of the lobe at the same view, from a table of both or from fits: what f0 A + B leaves after that.\n\
         Domain: 0 < e <= 1, 0 <= b <= e, 0 <= f0 <= 1. No light is left at f0 = 1{}.",
        specular.formula(),
        if specular == Specular::Single { ", but for the loss 1 - e" } else { "" }
    );
    let comment = comment("///", &what.lines().map(String::from).collect::<Vec<_>>());
    let head = head(language, &exact_name(specular), &arguments, &number);
    format!("{comment}{head}{lines}{}", finish(language, "factor", &[expression(language, value)]))
}

/// A material: the specular lobe `lobe`, per colour channel and multiplied as the name says, over a base whose factor is that of the
/// function `factor` with these arguments.
pub fn coupled(language: Language, specular: Specular, factor: &str, inputs: &[String]) -> String {
    let (colour, number) = (vector(language, 3), vector(language, 1));
    let colours = ["lobe", "albedo"].map(|name| argument(language, name, &colour));
    let numbers = inputs.iter().map(|input| argument(language, input, &number));
    let arguments: Vec<String> = colours.into_iter().chain(numbers).collect();
    let name = coupled_name(specular);
    let call = format!("{factor}({})", inputs.join(", "));
    let scale = format!("{call} * {}", expression(language, INVERSE_PI));
    let line = declare(language, &number, "base", &scale);
    let first = match specular {
        Specular::Single => {
            "A dielectric's BRDF per colour channel: its bare specular lobe over a diffuse base.".to_string()
        }
        _ => format!(
            "A dielectric's BRDF per colour channel: its specular lobe, multiplied by {} (N for 1/E), over a diffuse base.",
            specular.formula()
        ),
    };
    let lines: Vec<String> =
        std::iter::once(first.as_str()).chain(COUPLED.lines()).map(String::from).collect();
    format!("{}{}{line}{}", comment("///", &lines), head(language, &name, &arguments, &colour), sum(language))
}

/// The same for path tracers, with the average that it takes: a base under a bare lobe, which may exchange light and view.
pub fn reciprocal(language: Language, factor: &str, inputs: &[String]) -> String {
    let (colour, number) = (vector(language, 3), vector(language, 1));
    let numbers = |names: &[String]| -> Vec<String> {
        names.iter().map(|name| argument(language, name, &number)).collect()
    };
    let at = |mu: &str| {
        let passed: Vec<String> =
            inputs.iter().map(|input| if input == "mu" { mu.to_string() } else { input.clone() }).collect();
        format!("{factor}({})", passed.join(", "))
    };
    let constant: Vec<String> = inputs.iter().filter(|input| *input != "mu").cloned().collect();
    let sums = RULE.iter().enumerate().map(|(i, (mu, weight))| {
        let term = format!("{} * {}", expression(language, weight), at(&expression(language, mu)));
        declare(language, &number, &format!("term_{i}"), &term)
    });
    let first = format!("The factor {factor} without its direction:");
    let average = comment(
        "///",
        &std::iter::once(first.as_str()).chain(AVERAGE_TEXT.lines()).map(String::from).collect::<Vec<_>>(),
    ) + &head(language, AVERAGE, &numbers(&constant), &number)
        + &sums.collect::<String>()
        + &finish(language, "average", &["term_0 + term_1 + term_2 + term_3".into()]);
    let colours = ["lobe", "albedo"].map(|name| argument(language, name, &colour));
    let both: Vec<String> =
        ["average", "mu_l"].map(String::from).into_iter().chain(inputs.iter().cloned()).collect();
    let arguments: Vec<String> = colours.into_iter().chain(numbers(&both)).collect();
    let share = format!("{} * {} / average * {}", at("mu_l"), at("mu"), expression(language, INVERSE_PI));
    let line = declare(language, &number, "base", &share);
    let text = comment("///", &RECIPROCAL_TEXT.lines().map(String::from).collect::<Vec<_>>());
    format!("{average}\n{text}{}{line}{}", head(language, RECIPROCAL, &arguments, &colour), sum(language))
}

/// The end of a material: its lobe and the share `base` of its albedo.
fn sum(language: Language) -> String {
    let channel = |i| format!("{} + {} * base", part(language, "lobe", i), part(language, "albedo", i));
    match language {
        Language::Rust | Language::C => finish(language, "value", &[0, 1, 2].map(channel)),
        _ => "    return lobe + albedo * base;\n}\n".into(),
    }
}
