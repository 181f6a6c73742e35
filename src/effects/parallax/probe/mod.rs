//! Functions that look a probe up through a proxy of its room, in every language.
//!
//! A lookup takes the shading point, the ray that it reflects and the width of its lobe, or for the
//! lobe that is fitted to GGX the surface's normal, the view and alpha, and returns what to fetch
//! from the probe's prefiltered cubemap: a direction with the width of a lobe, or with the level
//! that holds it where the chain is known.

pub mod arguments;
mod lobe;
mod meet;
mod rule;
mod several;
mod single;

use crate::data::{AlphaMap, LOG_FROM, LOG_SCALE, MipChain, MipMap, ProbeLookup, SurfaceLobe};
use crate::effects::parallax::TapRule;
use crate::effects::parallax::room::proxies::Eased;
use crate::effects::parallax::taps::horizon::FADE;
use lobefit_math::ops;
use lobefit_shade::Features;
use lobefit_shade::code::{self, CodeError, Language};
use lobefit_shade::{Hypothesis, ShadeError, Source};

/// What the mirror lobe is.
const MIRROR: [&str; 2] = [
    "The lobe is round about the ray, which points away from the surface: it does not lean as the lobe of a surface",
    "does at grazing angles.",
];

/// The function of the file that gives the level of a roughness.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name.
    pub name: String,
    /// Its text in WGSL.
    pub text: String,
    /// The chain.
    pub chain: MipChain,
}

impl Level {
    /// A formula of the level.
    ///
    /// # Errors
    /// A formula that cannot be printed.
    pub fn new(hypothesis: &Hypothesis, chain: &MipChain) -> Result<Level, CodeError> {
        let text = code::print(Language::Wgsl, hypothesis, &[], &[])?.text;
        Ok(Level { name: hypothesis.name().to_string(), text, chain: chain.clone() })
    }

    /// The level of a logarithmic chain that is 0 before its shader's least roughness is met: a
    /// logarithm of the width.
    fn logarithmic(&self) -> Option<f64> {
        let logarithmic = matches!(self.chain, MipChain::Mapped { map: MipMap::Log, .. });
        let widest = self.chain.widest();
        (logarithmic && widest <= -LOG_SCALE * ops::log2(LOG_FROM)).then_some(widest)
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
    /// The constant k of the width of a fetch, which is that of `parallax_1`.
    pub flow: f64,
    /// Ratios of the distances of shading point and probe, to which theirs is clamped.
    pub rho: [f64; 2],
    /// The level of a roughness, where the chain is known.
    pub level: Option<Level>,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
}

impl Wanted {
    /// The function of the level that a lookup calls; a logarithm of the width is written out.
    pub fn called(&self) -> Option<&str> {
        self.level.as_ref().filter(|level| level.logarithmic().is_none()).map(|level| level.name.as_str())
    }

    /// What is fetched by, beside the direction: a width, 1 over `narrow`, or its level.
    fn fetched(&self) -> String {
        let Some(level) = &self.level else { return "1.0 / narrow".into() };
        match level.logarithmic() {
            Some(widest) => {
                let scale = LOG_SCALE / f64::from(self.alpha_map.power());
                format!("max({:?} - {:?} * log2(narrow), 0.0)", widest as f32, scale as f32)
            }
            None => format!("{}({})", level.name, self.alpha_map.roughness_source("1.0 / narrow")),
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

    /// What the function of these arguments takes and returns, and how that is used.
    pub fn lines(&self, inputs: &[String]) -> Vec<String> {
        let given = match self.level {
            Some(_) => "the level",
            None => "the width alpha of the lobe",
        };
        let several = self.lookup.taps > 1;
        let lobe = match self.lookup.lobe {
            SurfaceLobe::Mirror => "a lobe of width alpha about a ray from a place",
            SurfaceLobe::Fitted => "what a GGX surface of width alpha reflects at a place over its albedo",
        };
        if self.lookup.hit {
            return self.hit_lines(inputs);
        }
        let mut lines = if several {
            let first = format!("{} fetches from a probe for {lobe},", self.lookup.taps);
            let second = format!(
                "along the axis that the wall stretches: directions (xyz) and {given} (w), with their weights."
            );
            let third = format!("A fetch whose cosine with the normal is below {FADE} fades out.");
            vec![first, second, third]
        } else {
            vec![
                format!("What to fetch from a probe for {lobe}:"),
                format!("the direction (xyz) and {given} (w)."),
            ]
        };
        lines.push(format!("The proxy is {}.", self.lookup.text()));
        if !self.lookup.smooth {
            let jumps = "Edges are sharp: the width jumps where a ray passes from one plane to the next.";
            lines.push(jumps.into());
        }
        lines.extend(arguments::lines(inputs));
        lines.extend(self.frame());
        lines.push(self.sum());
        if self.lookup.is_fitted() {
            lines.push("  The surface reflects that times its albedo, f0 A + B of the split sum.".into());
        }
        lines
    }

    /// Those of a lookup of what the engine has hit.
    fn hit_lines(&self, inputs: &[String]) -> Vec<String> {
        let [low, high] = self.rho;
        let mut lines = vec![
            "What to fetch from a probe for a lobe of width alpha about a ray: offset, of any length, and the level (w) or width.".into(),
            "The engine has found what the ray hits.".into(),
        ];
        lines.extend(arguments::lines(inputs));
        lines.extend([
            "The width follows the ratio of the distances, which does not jump at edges, and ignores slants."
                .into(),
            format!(
                "Domain: alpha in [0, 1], distances of 0 or more; their ratio is clamped to [{low}, {high}]."
            ),
            "offset is not zero: what lies at the probe itself is seen in no direction.".into(),
            self.sum(),
        ]);
        lines
    }

    /// What smooth edges are rounded over, a formula of the lobe's width: of alpha, or of the
    /// `width` that the fitted lobe has.
    pub fn rounding(&self) -> String {
        Eased::formula(if self.lookup.is_fitted() { "width" } else { "alpha" })
    }

    /// What must hold of the arguments.
    fn frame(&self) -> Vec<String> {
        let body = if self.lookup.planes.is_none() { "low, high" } else { "planes" };
        let (mut lines, ray) = match self.lookup.lobe {
            SurfaceLobe::Fitted => (lobe::lines(self.lookup.taps), "normal, view"),
            SurfaceLobe::Mirror => (MIRROR.map(String::from).to_vec(), "ray"),
        };
        if self.lookup.planes.is_some() {
            let closed =
                "The planes enclose the probe: every ray has one ahead, or what is fetched is not a number.";
            lines.push(closed.into());
        }
        lines.extend([
            format!("place, {body}, probe, {ray} are in one frame and one unit of length; the cubemap's axes are the frame's."),
            "probe is strictly inside the proxy. Domain: alpha in [0, 1], places anywhere: a wall that the place is outside of".into(),
            format!("counts as being as far ahead as it is behind, and rho is clamped to [{}, {}].", self.rho[0], self.rho[1]),
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

    /// The kinds of work in the same.
    ///
    /// # Errors
    /// As [`Wanted::operations`].
    pub fn features(&self) -> Result<Features, CodeError> {
        Ok(self.source()?.features(&[&self.name])?)
    }

    /// The lookup with everything that it calls.
    ///
    /// # Errors
    /// A source that does not parse, a defect.
    pub fn source(&self) -> Result<Source, ShadeError> {
        let several = self.lookup.taps > 1;
        let level = self.level.as_ref().map_or("", |level| &level.text);
        if self.lookup.hit {
            return Source::parse("probe.wgsl", &(level.to_string() + &single::hit(self)));
        }
        let text = [
            lobe::constants(self.lookup.taps),
            rule::constants(&self.rule),
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
        if self.lookup.hit {
            return Ok(vec![source.print(language, &self.name, &self.header)?]);
        }
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
