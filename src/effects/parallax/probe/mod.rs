//! Functions that look a probe up through a proxy of its room, in every language.
//!
//! A lookup takes the shading point, the ray that it reflects and the width of its lobe, or for the
//! lobe that is fitted to GGX the surface's normal, the view and alpha, and returns what to fetch
//! from the probe's prefiltered cubemap: a direction with the width of a lobe, or with the level
//! that holds it where the chain is known.

mod lobe;
mod meet;
mod rule;
mod several;
mod single;

use crate::data::{AlphaMap, ProbeLookup, SurfaceLobe};
use crate::effects::parallax::TapRule;
use crate::effects::parallax::room::proxies::Tie;
use crate::effects::parallax::taps::horizon::FADE;
use lobefit_shade::code::{self, CodeError, Language};
use lobefit_shade::{Hypothesis, ShadeError, Source};

/// What the ray of the mirror lobe is.
const MIRROR: [&str; 2] = [
    "ray is the reflected one, of unit length, and points away from the surface. The lobe is round about the ray:",
    "it does not lean as the lobe of a surface does at grazing angles.",
];

/// A function of the file that a lookup calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Called {
    /// Name.
    pub name: String,
    /// Names of the arguments.
    pub inputs: Vec<String>,
    /// Its text in WGSL.
    pub text: String,
}

impl Called {
    /// A formula with its coefficients.
    ///
    /// # Errors
    /// A formula that cannot be printed.
    pub fn new(hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<Called, CodeError> {
        let text = code::print(Language::Wgsl, hypothesis, coefficients, &[])?.text;
        Ok(Called { name: hypothesis.name().to_string(), inputs: hypothesis.inputs().to_vec(), text })
    }

    /// A call of a width, by what stands for alpha and rho.
    fn call(&self, alpha: &str, rho: &str) -> String {
        let passed = |input: &String| if input == "rho" { rho.to_string() } else { alpha.to_string() };
        format!("{}({})", self.name, self.inputs.iter().map(passed).collect::<Vec<_>>().join(", "))
    }
}

/// A lookup to be printed.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Name of the function.
    pub name: String,
    /// Name of the function of one fetch along a ray, which lookups of the same lobe, proxy and
    /// chain share.
    pub fetch: String,
    /// What it does.
    pub lookup: ProbeLookup,
    /// Where its fetches go.
    pub rule: TapRule,
    /// Its documentation.
    pub header: Vec<String>,
    /// The width of a fetch.
    pub width: Called,
    /// The level of a roughness, where the chain is known.
    pub level: Option<Called>,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// The power of smooth edges.
    pub power: Tie,
}

impl Wanted {
    /// What is fetched by, beside the direction: a width or its level.
    fn fetched(&self, width: &str) -> String {
        match &self.level {
            Some(level) => format!("{}({})", level.name, self.alpha_map.roughness_source(width)),
            None => width.into(),
        }
    }

    /// Names of the arguments, in order.
    ///
    /// # Errors
    /// A source that does not parse, a defect.
    pub fn inputs(&self) -> Result<Vec<String>, CodeError> {
        let source = self.source()?;
        let function = source.function(&self.name)?;
        Ok(function.variables[..function.arguments].iter().map(|v| v.name.clone()).collect())
    }

    /// What the function takes and returns, and how that is used.
    pub fn lines(&self) -> Vec<String> {
        let given = match self.level {
            Some(_) => "the level",
            None => "the width alpha of the lobe",
        };
        let several = self.lookup.taps > 1;
        let lobe = match self.lookup.lobe {
            SurfaceLobe::Mirror => "a lobe of width alpha about a ray from a place",
            SurfaceLobe::Fitted => "what a GGX surface of width alpha reflects at a place over its albedo",
        };
        let mut lines = if several {
            let first = format!("{} fetches from a probe for {lobe},", self.lookup.taps);
            let second = format!(
                "along the axis that the wall stretches: directions (xyz) and {given} (w), with their weights."
            );
            let third = format!(
                "normal is that of the surface, of unit length: below a cosine of {FADE} with it a fetch fades out."
            );
            vec![first, second, third]
        } else {
            vec![
                format!("What to fetch from a probe for {lobe}:"),
                format!("the direction (xyz) and {given} (w)."),
            ]
        };
        lines.push(format!("The proxy is {}.", self.lookup.text()));
        lines.push(if self.lookup.smooth {
            let lobe = if self.lookup.is_fitted() { ", width that of the lobe" } else { "" };
            format!("Edges are smooth: the power of the proxy is {}{lobe}.", self.power_formula())
        } else {
            "Edges are sharp: the width jumps where a ray passes from one plane to the next.".into()
        });
        lines.extend(self.frame());
        lines.push(self.sum());
        if self.lookup.is_fitted() {
            lines.push("  The surface reflects that times its albedo, f0 A + B of the split sum.".into());
        }
        lines
    }

    /// The power of smooth edges, a formula of the lobe's width: of alpha, or of the `width` that
    /// the fitted lobe has.
    pub fn power_formula(&self) -> String {
        let formula = self.power.formula();
        if self.lookup.is_fitted() { formula.replace("alpha", "width") } else { formula }
    }

    /// What the arguments must be.
    fn frame(&self) -> Vec<String> {
        let (body, bound) = match self.lookup.planes {
            None => ("low, high", ""),
            Some(_) => ("planes", ", whose planes bound a body"),
        };
        let (mut lines, ray) = match self.lookup.lobe {
            SurfaceLobe::Fitted => (lobe::lines(self.lookup.taps), "normal, view"),
            SurfaceLobe::Mirror => (MIRROR.map(String::from).to_vec(), "ray"),
        };
        lines.extend([
            format!("place, {body}, probe, {ray} are in one frame and one unit of length; the cubemap's axes are the frame's."),
            format!("probe is strictly inside the proxy{bound}: else values are not finite."),
            "Domain: alpha in [0, 1], a place inside. As the place comes to the wall that the ray meets, the width goes".into(),
            "to 0; a place outside is taken as on the wall. Cosines with the proxy's normal below 0.02 count as that.".into(),
        ]);
        lines
    }

    /// How fetches become a colour.
    fn sum(&self) -> String {
        let fetch = if self.lookup.taps > 1 { "fetch_i" } else { "fetch" };
        let (level, note) = match self.level {
            Some(_) => (format!("{fetch}.w"), ""),
            None => (format!("mip_of({fetch}.w)"), ", mip_of the level of a width"),
        };
        let sum = if self.lookup.taps > 1 { "sum weight_i * " } else { "" };
        format!("Use: color = {sum}sample_level(env, {fetch}.xyz, {level}){note}")
    }

    /// What several fetches are expected to be off by, and those of the fitted lobe; nothing of one
    /// about the ray.
    pub fn expected(&self) -> Vec<String> {
        let taps = self.lookup.taps;
        let mut lines = if self.lookup.is_fitted() { lobe::expected(taps) } else { Vec::new() };
        if taps > 1 {
            lines.extend(rule::expected(&self.rule));
        }
        lines
    }

    /// Operations of a call, those of the functions that it calls among them.
    ///
    /// # Errors
    /// A source that does not parse, a defect.
    pub fn operations(&self) -> Result<u32, CodeError> {
        Ok(self.source()?.cost_ops(&[&self.name])?)
    }

    /// The lookup with everything that it calls.
    ///
    /// # Errors
    /// A source that does not parse, a defect.
    pub fn source(&self) -> Result<Source, ShadeError> {
        let several = self.lookup.taps > 1;
        let level = self.level.as_ref().map_or("", |level| &level.text);
        let text = [
            lobe::constants(self.lookup.taps),
            rule::constants(&self.rule),
            self.width.text.clone(),
            level.to_string(),
            meet::source(self.lookup),
            single::fetch(self),
            if several { several::structure(self.lookup.taps) } else { String::new() },
            if several { several::lookup(self) } else { single::lookup(self) },
        ];
        Source::parse("probe.wgsl", &text.concat())
    }

    /// Its text with what it shares, in a language.
    fn print(&self, language: Language) -> Result<Vec<String>, CodeError> {
        let source = self.source()?;
        let fetched = if self.level.is_some() { "level" } else { "width" };
        let fetch = format!(
            "One fetch of the lookups below, along a ray, of a lobe of width alpha: direction and {fetched}."
        );
        let structure = source.print_structure(language, &self.name)?;
        let functions = [
            (meet::name(self.lookup), meet::header(self.lookup)),
            (self.fetch.clone(), vec![fetch]),
            (self.name.clone(), self.header.clone()),
        ];
        let printed = functions.iter().map(|(name, header)| source.print(language, name, header));
        structure.map(Ok).into_iter().chain(printed).collect()
    }
}

/// A number as a constant of a source.
fn constant(name: &str, value: f64) -> String {
    format!("const {name}: f32 = {:?};\n", value as f32)
}

/// The functions of lookups and what they share, each after what it calls; empty where there are
/// none.
///
/// # Errors
/// A source that does not parse, a defect; a name that the language has taken.
pub fn print(language: Language, lookups: &[Wanted]) -> Result<String, CodeError> {
    let mut texts: Vec<String> = Vec::new();
    for lookup in lookups {
        for text in lookup.print(language)? {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
    }
    Ok(texts.into_iter().map(|text| format!("\n{text}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every combination is a source of the dialect, and its names are words of no language.
    #[test]
    fn lookups_are_printed_in_every_language() {
        let called = |name: &str, input: &str| Called {
            name: name.into(),
            inputs: vec![input.into()],
            text: format!("fn {name}({input}: f32) -> f32 {{ return {input}; }}\n"),
        };
        for i in 0..24 {
            let planes = (i % 2 == 1).then_some(9);
            let lobe = if i / 4 % 2 == 0 { SurfaceLobe::Mirror } else { SurfaceLobe::Fitted };
            let lookup = ProbeLookup { planes, smooth: i / 2 % 2 == 0, taps: 1 + i / 8, lobe };
            let wanted = Wanted {
                name: "lookup".into(),
                fetch: "one_fetch".into(),
                lookup,
                rule: [TapRule::one(), TapRule::two(), TapRule::three()][lookup.taps as usize - 1],
                header: Vec::new(),
                width: called("f", "alpha"),
                level: (i % 3 == 0).then(|| called("g", "alpha")),
                alpha_map: AlphaMap::RoughnessSquared,
                power: Tie { over: 4.0, power: 1.0 },
            };
            assert!(wanted.operations().expect("a source") > 20, "{lookup:?}");
            for language in Language::ALL {
                let text = print(language, std::slice::from_ref(&wanted)).expect("a text");
                let renamed =
                    text.split(|c: char| !c.is_alphanumeric() && c != '_').find(|w| w.ends_with('_'));
                assert_eq!(renamed, None, "{}", language.title());
            }
        }
    }
}
