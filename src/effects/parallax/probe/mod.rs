//! Functions that look a probe up through a proxy of its room, in every language.
//!
//! A lookup takes the shading point, the ray that it reflects and the width of its lobe, or for the lobe that is fitted to GGX the surface's
//! normal, the view and alpha, and returns what to fetch from the probe's
//! prefiltered cubemap: a direction with the width of a lobe, or with the level that holds it where the chain is known.

mod lobe;
mod meet;
mod rule;
mod script;
mod several;
mod single;
mod spelling;

use crate::data::{AlphaMap, ProbeLookup, SurfaceLobe};
use crate::effects::parallax::TapRule;
use crate::effects::parallax::room::proxies::Tie;
use crate::effects::parallax::taps::horizon::FADE;
use lobefit_fit::FitError;
use lobefit_shade::code::Language;

/// What the ray of the mirror lobe is.
const MIRROR: [&str; 2] = [
    "ray is the reflected one, of unit length, and points away from the surface. The lobe is round about the ray:",
    "it does not lean as the lobe of a surface does at grazing angles.",
];

/// A function of the file that a lookup calls: its name, its arguments in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Called {
    /// Name.
    pub name: String,
    /// Names of the arguments.
    pub inputs: Vec<String>,
    /// Operations.
    pub ops: u32,
}

impl Called {
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
    /// Name of the function of one fetch along a ray, which lookups of the same lobe, proxy and chain share.
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
    /// The lines that name what a width is fetched by, where that is the level.
    fn level_lines(&self, width: &str) -> String {
        let Some(level) = &self.level else { return String::new() };
        let name = &level.name;
        let root = self.alpha_map.roughness_source(width);
        if root == width {
            return format!("mip_{width} :1 = {name}({width})\n");
        }
        format!("roughness_{width} = {root}\nmip_{width} :1 = {name}(roughness_{width})\n")
    }

    /// What is fetched by, beside the direction: a width or its level.
    fn fetched(&self, width: &str) -> String {
        if self.level.is_some() { format!("mip_{width}") } else { width.into() }
    }

    /// Names of the arguments, in order.
    pub fn inputs(&self) -> Vec<String> {
        self.routine().arguments.iter().map(|(name, _)| name.to_string()).collect()
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

    /// The power of smooth edges, a formula of the lobe's width: of alpha, or of the `width` that the fitted lobe has.
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

    /// What several fetches are expected to be off by, and those of the fitted lobe; nothing of one about the ray.
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
    /// A script that is no arithmetic, a defect.
    pub fn operations(&self) -> Result<u32, FitError> {
        let met = meet::routine(self.lookup).operations()?;
        let level = self.level.as_ref().map_or(0, |level| level.ops);
        let fetch = single::fetch(self).operations()? + met + self.width.ops + level;
        let own = self.routine().operations()?;
        // several fetches need to meet the proxy along the ray first
        let first = if self.lookup.taps > 1 { met } else { 0 };
        Ok(own + first + self.lookup.taps * fetch)
    }

    fn routine(&self) -> script::Routine {
        if self.lookup.taps > 1 { several::lookup(self) } else { single::lookup(self) }
    }
}

/// The functions of lookups and what they share, each after what it calls; empty where there are none.
pub fn print(language: Language, lookups: &[Wanted]) -> String {
    let mut texts: Vec<String> = Vec::new();
    for lookup in lookups {
        let taps = lookup.lookup.taps as usize;
        let structure = (taps > 1).then(|| script::structure_text(language, taps));
        let routines = [meet::routine(lookup.lookup), single::fetch(lookup), lookup.routine()];
        for text in structure.into_iter().chain(routines.map(|routine| routine.print(language))) {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
    }
    texts.into_iter().map(|text| format!("\n{text}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The scripts' names are words of no language.
    #[test]
    fn names_are_free_in_every_language() {
        let called =
            |name: &str| Called { name: name.into(), inputs: vec!["alpha".into(), "rho".into()], ops: 1 };
        use SurfaceLobe::{Fitted, Mirror};
        for (planes, smooth, taps, lobe) in [
            (None, true, 2, Mirror),
            (None, false, 3, Fitted),
            (Some(9), true, 3, Mirror),
            (Some(9), false, 1, Mirror),
            (None, true, 1, Fitted),
        ] {
            let lookup = ProbeLookup { planes, smooth, taps, lobe };
            let rule = [TapRule::one(), TapRule::two(), TapRule::three()][taps as usize - 1];
            let wanted = Wanted {
                name: "lookup".into(),
                fetch: "one_fetch".into(),
                lookup,
                rule,
                header: Vec::new(),
                width: called("f"),
                level: Some(called("g")),
                alpha_map: AlphaMap::RoughnessSquared,
                power: Tie { over: 4.0, power: 1.0 },
            };
            for routine in [meet::routine(lookup), single::fetch(&wanted), wanted.routine()] {
                let body = routine.body.lines().filter_map(|line| line.trim().split_once(" = "));
                let named = body.map(|(name, _)| name.trim_start_matches("var ").trim_start_matches("set "));
                let named = named.map(|name| name.split(" :").next().unwrap_or(name));
                let arguments = routine.arguments.iter().map(|(name, _)| *name);
                for name in
                    named.chain(arguments).chain(["plane", "every", "result", "taps", "weights", "fetches"])
                {
                    for language in Language::ALL {
                        assert!(!language.takes(name), "{name} in {}", language.title());
                    }
                }
            }
        }
    }
}
