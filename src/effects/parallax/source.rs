//! The functions of a chain of levels as WGSL: what the printers of all languages take.

use crate::approximate::Fit;
use crate::data::{AlphaMap, MipChain, MipMap};

/// A number as the f32 that it is in a shader.
fn number(x: f64) -> String {
    format!("{:?}", x as f32)
}

/// The function of a roughness that gives its level.
pub fn level(name: &str, chain: &MipChain) -> String {
    let last = number(chain.count() as f64 - 1.0);
    let quadratic = |slope: &str, curve: &str| {
        format!("    let r = saturate(roughness);\n    return r * ({slope} - {curve}) * {last};")
    };
    let body = match chain {
        MipChain::Mapped { map: MipMap::Linear, .. } => format!("    return saturate(roughness) * {last};"),
        MipChain::Mapped { map: MipMap::Steep, .. } => quadratic("2.0", "r"),
        MipChain::Mapped { map: MipMap::Steeper, .. } => quadratic("1.7", "0.7 * r"),
        MipChain::Mapped { map: MipMap::Log, .. } => {
            let widest = number(chain.widest());
            format!("    return max({widest} + 1.2 * log2(clamp(roughness, 0.001, 1.0)), 0.0);")
        }
        MipChain::Given(levels) => {
            let step = |pair: &[f64]| {
                let inverse = number(1.0 / (pair[1] - pair[0]));
                match pair[0] {
                    0.0 => format!("saturate(roughness * {inverse})"),
                    from => format!("saturate((roughness - {}) * {inverse})", number(from)),
                }
            };
            format!("    return {};", levels.windows(2).map(step).collect::<Vec<_>>().join("\n        + "))
        }
    };
    format!("fn {name}(roughness: f32) -> f32 {{\n{body}\n}}\n")
}

/// Its inverse: the roots of the quadratics without their cancellation at 0.
pub fn roughness(name: &str, chain: &MipChain) -> String {
    let inverse = number(1.0 / (chain.count() as f64 - 1.0));
    let root = |top: &str, bottom: &str| {
        format!("    let m = saturate(mip * {inverse});\n    return {top} / ({bottom});")
    };
    let body = match chain {
        MipChain::Mapped { map: MipMap::Linear, .. } => format!("    return saturate(mip * {inverse});"),
        MipChain::Mapped { map: MipMap::Steep, .. } => root("m", "1.0 + sqrt(1.0 - m)"),
        MipChain::Mapped { map: MipMap::Steeper, .. } => root("2.0 * m", "1.7 + sqrt(2.89 - 2.8 * m)"),
        MipChain::Mapped { map: MipMap::Log, .. } => {
            let widest = number(chain.widest());
            format!("    return exp2((clamp(mip, 0.0, {widest}) - {widest}) * {});", number(1.0 / 1.2))
        }
        MipChain::Given(levels) => {
            let step = |(i, pair): (usize, &[f64])| {
                let below = if i == 0 { "mip".into() } else { format!("mip - {}", number(i as f64)) };
                format!("{} * saturate({below})", number(pair[1] - pair[0]))
            };
            let steps: Vec<String> = levels.windows(2).enumerate().map(step).collect();
            let first =
                if levels[0] == 0.0 { String::new() } else { format!("{}\n        + ", number(levels[0])) };
            format!("    return {first}{};", steps.join("\n        + "))
        }
    };
    format!("fn {name}(mip: f32) -> f32 {{\n{body}\n}}\n")
}

/// The function of a level and a ratio that gives the level to fetch, by a fit of the width, with
/// the fit's parameters.
pub fn adjusted(name: &str, chain: &MipChain, map: AlphaMap, fit: &Fit) -> String {
    let original = fit.hypothesis.source().to_string();
    let own = own_name(&original);
    let width = original.replacen(&format!("fn {own}("), "fn width(", 1);
    let inputs = fit.hypothesis.inputs();
    let alpha = match inputs.iter().any(|input| input == "alpha") {
        true => format!("    let alpha = {};\n", map.alpha_source("roughness")),
        false => String::new(),
    };
    let call = format!("width({})", inputs.join(", "));
    let back = map.roughness_source(&call);
    let (level, inverse) = (level("level", chain), roughness("roughness_of", chain));
    format!(
        "{width}\n{level}\n{inverse}\nfn {name}(mip: f32, rho: f32) -> f32 {{\n    let roughness = roughness_of(mip);\n{alpha}    \
         return level({back});\n}}\n"
    )
}

/// The name that a formula has in its source: a fit may have another.
fn own_name(source: &str) -> &str {
    let last = source.rfind("fn ").map_or("", |at| &source[at + 3..]);
    last.split('(').next().unwrap_or_default()
}
