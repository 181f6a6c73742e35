//! The functions around the coupling factors, in every language: the exact factor from E and B, and a base under a lobe.

use crate::emit::spelling::{argument, declare, expression, finish, head, part, vector};
use lobefit_shade::code::Language;
use lobefit_shade::comment::comment;
use lobefit_truth::integrate::coupling::Specular;

/// 1/pi, of Lambert's lobe.
const INVERSE_PI: &str = "0.31830987";

const COUPLED: &str = "\
The diffuse base is Lambert's: albedo/pi times the factor, which is that of the view, for every light alike.
Energy: in a white environment lobe and white base together send back 1, within the certificates of the factor and of
what multiplies the lobe; an albedo below 1 scales the base's share and its error. Not reciprocal: the factor is of the
view alone.";

const PER_CHANNEL: &str = "\
The same with a reflectance per colour channel: three factors, each that of its channel's f0.";

/// Names of the functions that this module may print.
pub fn names() -> impl Iterator<Item = String> {
    let around = Specular::ALL.into_iter().flat_map(|specular| {
        [exact_name(specular), coupled_name(specular), coloured(&coupled_name(specular))]
    });
    let reciprocal =
        [AVERAGE.into(), EXCHANGED.into(), RECIPROCAL.into(), coloured(AVERAGE), coloured(RECIPROCAL)];
    around.chain(reciprocal)
}

/// The functions of a material whose directions can be exchanged. Its lobe must be such a one, which of ours the bare one alone is.
const AVERAGE: &str = "diffuse_coupling_average_single";
const RECIPROCAL: &str = "diffuse_coupled_reciprocal_single";
const EXCHANGED: &str = "diffuse_coupling_reciprocal_single";

const EXCHANGED_TEXT: &str = "\
What the base below has for a factor whose directions can be exchanged: the factor of the light mu_l times that of the
view mu, over their average.";

/// The name of a function's variant for a reflectance per channel.
fn coloured(name: &str) -> String {
    format!("{name}_rgb")
}

/// Nodes and weights of the Gauss rule of four nodes for the integral of f(mu) 2 mu over [0, 1].
const RULE: [(&str, &str); 4] = [
    ("0.13975986", "0.062361942"),
    ("0.41640957", "0.2596951"),
    ("0.72315699", "0.40692914"),
    ("0.9428958", "0.27101383"),
];

/// Smallest average that the base is divided by. Where the average is smaller, which is where f0 is next to 1 on a smooth lobe, the
/// base sends back less than the factor says, never more, and no more is lost than the factor itself.
const FLOOR: &str = "0.001";

/// What the four nodes of [`average`] are off, measured over a material's roughness and all f0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleError {
    /// Largest error of the average.
    pub average: f64,
    /// Largest error, for it, of the light that a white base sends back, over the f0 of the certificate.
    pub energy: f64,
    /// The same over all f0.
    pub any_energy: f64,
}

/// The cosines at which the emitted average has its factor.
pub fn average_nodes() -> [f32; 4] {
    RULE.map(|(mu, _)| number(mu))
}

/// The average as the emitted function has it, of a factor's values at those cosines.
pub fn average(values: [f32; 4]) -> f32 {
    let terms = RULE.iter().zip(values).map(|((_, weight), value)| number(weight) * value.max(0.0));
    terms.sum()
}

/// A literal of this file.
fn number(digits: &str) -> f32 {
    digits.parse().unwrap_or(f32::NAN)
}

/// The smallest average that a base is divided by, as a number.
pub fn floor() -> f32 {
    number(FLOOR)
}

fn average_text(error: RuleError) -> String {
    format!(
        "its mean over the lights of a white environment, twice the integral of factor mu dmu, by Gauss's rule of\n\
         four nodes: at most {} from the integral at 33 x 33 places of the certificate's roughness and all f0. A constant of\n\
         the material.",
        error.average
    )
}

fn reciprocal_text(error: RuleError) -> String {
    format!(
        "A dielectric's BRDF per colour channel whose directions can be exchanged, for path tracers: its bare specular lobe over a\n\
         diffuse base, the factor of the light mu_l times that of the view mu over their average (Kelemen and Szirmay-Kalos, \"A\n\
         microfacet based coupled specular-matte BRDF model with importance sampling\", 2001).\n\
         average is that of the function above. Energy: as the average of the light's factor is the average, the base sends back\n\
         what the view's factor alone would, within {} for the f0 of the certificate and {} for all f0 (measured). Limits: as\n\
         f0 goes to 1 the factor goes to the loss of the bare lobe; an average below {FLOOR} counts as {FLOOR}, which fades the\n\
         base out and never brightens it.",
        error.energy, error.any_energy
    )
}

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
/// function `factor` with these arguments; and the same for an f0 per channel.
pub fn coupled(language: Language, specular: Specular, factor: &str, inputs: &[String]) -> String {
    let name = coupled_name(specular);
    let first = match specular {
        Specular::Single => {
            "A dielectric's BRDF per colour channel: its bare specular lobe over a diffuse base.".to_string()
        }
        _ => format!(
            "A dielectric's BRDF per colour channel: its specular lobe, multiplied by {} (N for 1/E), over a diffuse base.",
            specular.formula()
        ),
    };
    let base = |i: Option<usize>| {
        let value = call(language, factor, inputs, &[], i);
        // The others are proven not to be negative for all f0.
        let kept = match specular {
            Specular::Single => not_negative(language, &value),
            Specular::Normalised | Specular::Compensated => value,
        };
        times_inverse_pi(language, &kept)
    };
    let function = |channels: &[Option<usize>], name: &str, text: &str| {
        let arguments = arguments(language, &["lobe", "albedo"], inputs, channels.len() == 3);
        let head = head(language, name, &arguments, &vector(language, 3));
        let bases: Vec<String> = channels.iter().map(|i| base(*i)).collect();
        format!("{}{head}{}", lines(text), sum(language, &bases))
    };
    let one = function(&[None], &name, &format!("{first}\n{COUPLED}"));
    let three = function(&CHANNELS, &coloured(&name), PER_CHANNEL);
    format!("{one}\n{three}")
}

/// The same for path tracers, with the average that it takes: a base under a bare lobe, which may exchange light and view.
pub fn reciprocal(language: Language, factor: &str, inputs: &[String], error: RuleError) -> String {
    let number = vector(language, 1);
    let constant: Vec<String> = inputs.iter().filter(|input| *input != "mu").cloned().collect();
    let kept = |mu: &str, i: Option<usize>| {
        not_negative(language, &call(language, factor, inputs, &[("mu", mu)], i))
    };
    let terms = RULE.iter().enumerate().map(|(i, (mu, weight))| {
        let term = format!("{} * {}", expression(language, weight), kept(&expression(language, mu), None));
        declare(language, &number, &format!("term_{i}"), &term)
    });
    let average = lines(&format!("The factor {factor} without its direction:\n{}", average_text(error)))
        + &head(language, AVERAGE, &arguments(language, &[], &constant, false), &number)
        + &terms.collect::<String>()
        + &finish(language, "average", &["term_0 + term_1 + term_2 + term_3".into()]);
    let averages = lines("Its averages for a reflectance per colour channel.")
        + &head(
            language,
            &coloured(AVERAGE),
            &arguments(language, &[], &constant, true),
            &vector(language, 3),
        )
        + &finish(language, "averages", &CHANNELS.map(|i| call(language, AVERAGE, &constant, &[], i)));
    let with_light: Vec<String> =
        ["average", "mu_l"].map(String::from).into_iter().chain(inputs.iter().cloned()).collect();
    let least = format!("{}(average, {})", function(language, "max"), expression(language, FLOOR));
    let share = lines(EXCHANGED_TEXT)
        + &head(language, EXCHANGED, &arguments(language, &[], &with_light, false), &number)
        + &declare(language, &number, "light", &kept("mu_l", None))
        + &declare(language, &number, "view", &kept("mu", None))
        + &finish(language, "share", &[format!("light * view / {least}")]);
    let base = |i: Option<usize>| {
        let mean = i.map_or("average".into(), |i| part(language, "average", i));
        times_inverse_pi(language, &call(language, EXCHANGED, &with_light, &[("average", &mean)], i))
    };
    let material = |channels: &[Option<usize>], name: &str, text: &str| {
        let coloured = channels.len() == 3;
        let all = arguments(language, &["lobe", "albedo"], &with_light, coloured);
        let bases: Vec<String> = channels.iter().map(|i| base(*i)).collect();
        format!(
            "{}{}{}",
            lines(text),
            head(language, name, &all, &vector(language, 3)),
            sum(language, &bases)
        )
    };
    let one = material(&[None], RECIPROCAL, &reciprocal_text(error));
    let three = material(&CHANNELS, &coloured(RECIPROCAL), PER_CHANNEL);
    [average, averages, share, one, three].join("\n")
}

/// The channels of a colour.
const CHANNELS: [Option<usize>; 3] = [Some(0), Some(1), Some(2)];

/// A comment of documentation.
fn lines(text: &str) -> String {
    comment("///", &text.lines().map(String::from).collect::<Vec<_>>())
}

/// Colours, then the factor's arguments, f0 among them a colour where it is `coloured`.
fn arguments(language: Language, colours: &[&str], inputs: &[String], coloured: bool) -> Vec<String> {
    let (colour, number) = (vector(language, 3), vector(language, 1));
    let kind = |input: &String| {
        if coloured && ["f0", "average"].contains(&input.as_str()) { &colour } else { &number }
    };
    let colours = colours.iter().map(|name| argument(language, name, &colour));
    colours.chain(inputs.iter().map(|input| argument(language, input, kind(input)))).collect()
}

/// A call with the names of the inputs, some of them `replaced`, and f0 that of a channel where there is one.
fn call(
    language: Language,
    function: &str,
    inputs: &[String],
    replaced: &[(&str, &str)],
    channel: Option<usize>,
) -> String {
    let passed = |input: &String| match (replaced.iter().find(|(name, _)| name == input), channel) {
        (Some((_, with)), _) => with.to_string(),
        (None, Some(i)) if input == "f0" => part(language, "f0", i),
        _ => input.clone(),
    };
    format!("{function}({})", inputs.iter().map(passed).collect::<Vec<_>>().join(", "))
}

fn function(language: Language, name: &str) -> String {
    expression(language, name)
}

fn not_negative(language: Language, value: &str) -> String {
    format!("{}({value}, {})", function(language, "max"), expression(language, "0.0"))
}

fn times_inverse_pi(language: Language, value: &str) -> String {
    format!("{value} * {}", expression(language, INVERSE_PI))
}

/// The end of a material: its lobe and the share of its albedo, one for all channels or one for each.
fn sum(language: Language, bases: &[String]) -> String {
    if let [one] = bases {
        let line = declare(language, &vector(language, 1), "base", one);
        let channel = |i| format!("{} + {} * base", part(language, "lobe", i), part(language, "albedo", i));
        return line
            + &match language {
                Language::Rust | Language::C => finish(language, "value", &[0, 1, 2].map(channel)),
                _ => "    return lobe + albedo * base;\n}\n".into(),
            };
    }
    let names = ["red", "green", "blue"];
    let declared = names.iter().zip(bases);
    let declared: String =
        declared.map(|(name, base)| declare(language, &vector(language, 1), name, base)).collect();
    let channel = |(i, name): (usize, &&str)| {
        format!("{} + {} * {name}", part(language, "lobe", i), part(language, "albedo", i))
    };
    let values: Vec<String> = names.iter().enumerate().map(channel).collect();
    declared + &finish(language, "value", &values)
}
