//! What the arguments of a shader function are given, by their names and by what the user says.

use super::axis::{Input, Scale};
use super::{AuditError, inputs_of};
use crate::foreign::ShaderFunction;
use lobefit_truth::quantity::Quantity;

/// What an argument is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feed {
    /// The same everywhere.
    Value(f32),
    /// The coordinate along an axis, 0 to 1.
    Axis(usize),
    /// One more than that: an index of refraction.
    Ior(usize),
    /// The coordinate between two ends.
    Between(usize, [f32; 2]),
    /// The inverse of an index of refraction, from 1/2 to 1.
    Eta(usize),
    /// Its square: alpha beside a roughness.
    Square(usize),
    /// The sine of an angle whose cosine is the coordinate.
    Sine(usize),
    /// An F0.
    Blend,
}

impl Feed {
    /// The value at coordinates, with an F0.
    pub(super) fn value(self, coordinate: &dyn Fn(usize) -> f32, f0: f32) -> f32 {
        match self {
            Feed::Value(x) => x,
            Feed::Axis(k) => coordinate(k),
            Feed::Ior(k) => 1.0 + coordinate(k),
            Feed::Between(k, [low, high]) => low + (high - low) * coordinate(k),
            Feed::Eta(k) => 0.5 * (1.0 + coordinate(k)),
            Feed::Square(k) => coordinate(k) * coordinate(k),
            Feed::Sine(k) => (1.0 - coordinate(k) * coordinate(k)).sqrt(),
            Feed::Blend => f0,
        }
    }
}

/// The input that an argument's name tells, if the quantity has it.
fn role_in(quantity: &dyn Quantity, name: &str) -> Option<Input> {
    let has_ior = quantity.inputs().iter().any(|i| i.name == Input::Ior.name());
    role(name).filter(|input| *input != Input::Ior || has_ior)
}

/// Names of the axes, and what every argument is given: one that is named for an index, the index
/// or, if it is `inverse`, 1/ior.
pub(super) fn feeds(
    function: &ShaderFunction,
    quantity: &dyn Quantity,
    set: &[(String, f64)],
    scales: &[Scale],
    inverse: bool,
) -> Result<(Vec<String>, Vec<Feed>), AuditError> {
    let (arguments, inputs) = (&function.inputs, inputs_of(quantity));
    let role = |name: &str| role_in(quantity, name);
    // A vector or a structure is set as a whole by its name.
    let of = |name: &str, set: &str| {
        name == set || name.strip_prefix(set).is_some_and(|rest| rest.starts_with('.'))
    };
    if let Some((name, value)) = set.iter().find(|(n, _)| !arguments.iter().any(|a| of(a, n))) {
        let reason = format!("{} has the arguments {}", function.name, arguments.join(", "));
        return Err(AuditError::Option { option: "--set", value: format!("{name}={value}"), reason });
    }
    let given = |name: &String| set.iter().rfind(|(n, _)| of(name, n)).map(|(_, x)| Feed::Value(*x as f32));
    let mut feeds: Vec<Option<Feed>> = arguments.iter().map(given).collect();
    let free = |feeds: &[Option<Feed>]| (0..feeds.len()).filter(|i| feeds[*i].is_none()).collect::<Vec<_>>();
    let mut axes: Vec<(usize, String)> = Vec::new();
    if free(&feeds).len() > inputs {
        axes.extend(directions(arguments, &mut feeds));
    }
    for i in free(&feeds) {
        if free(&feeds).len() + axes.len() <= inputs {
            break;
        }
        feeds[i] = match arguments[i].to_ascii_lowercase().contains("f90") {
            true => Some(Feed::Value(1.0)),
            false => is_f0(&arguments[i], quantity).then_some(Feed::Blend),
        };
    }
    if free(&feeds).len() + axes.len() > inputs {
        let value = |feed: &Option<Feed>| if let Some(Feed::Value(x)) = feed { Some(*x) } else { None };
        let values: Vec<Option<f32>> = feeds.iter().map(value).collect();
        for i in free(&feeds) {
            // Of a structure a function may read a few members alone.
            let idle = role(&arguments[i]).is_none() && function.is_idle(i, &values, &[]);
            feeds[i] = idle.then_some(Feed::Value(0.5));
        }
    }
    if let Some(i) = free(&feeds).into_iter().find(|i| function.whole[*i]) {
        let name = &arguments[i];
        let reason =
            format!("the argument {name} is no f32, which runs along no axis: give --set {name}=VALUE");
        return Err(AuditError::refused(&function.signature, reason));
    }
    let left = free(&feeds);
    let squared = if left.len() + axes.len() > inputs { both_widths(arguments, &left) } else { None };
    axes.extend(left.iter().filter(|i| squared != Some(**i)).map(|i| (*i, arguments[*i].clone())));
    axes.sort_by_key(|a| a.0);
    if axes.len() != inputs || !(1..=3).contains(&inputs) {
        let names: Vec<&str> = axes.iter().map(|(_, name)| name.as_str()).collect();
        let names = names.join(", ");
        let reason = format!(
            "the arguments {names} are left for {inputs} inputs; give --set NAME=VALUE to those that are none"
        );
        return Err(AuditError::refused(&function.signature, reason));
    }
    for (axis, (i, name)) in axes.iter_mut().enumerate() {
        let named = (role(name) == Some(Input::Ior)).then_some(if inverse { Scale::Eta } else { Scale::Ior });
        if feeds[*i].is_none() {
            feeds[*i] = Some(match scales.get(axis).copied().or(named) {
                Some(Scale::Ior) => Feed::Ior(axis),
                Some(Scale::Eta) => Feed::Eta(axis),
                Some(Scale::Span(span)) => Feed::Between(axis, span.ends.map(|x| x as f32)),
                _ => Feed::Axis(axis),
            });
        }
        if let (Some(square), Some(Input::Alpha)) = (squared, role(name)) {
            feeds[square] = Some(Feed::Square(axis));
            *name = format!("{name} (and {} its square)", arguments[square]);
        }
    }
    // The cosine's place among the axes is known only now.
    let place = |i: usize| axes.iter().position(|a| a.0 == i);
    let done = feeds.into_iter().map(|feed| match feed {
        Some(Feed::Axis(i)) if i >= CORNER => place(i - CORNER).map_or(Feed::Value(0.0), Feed::Axis),
        Some(Feed::Sine(i)) if i >= CORNER => place(i - CORNER).map_or(Feed::Value(0.0), Feed::Sine),
        Some(feed) => feed,
        None => Feed::Value(0.0),
    });
    let done = done.collect();
    Ok((axes.into_iter().map(|a| a.1).collect(), done))
}

/// Added to an argument's index where an axis is meant that has no number yet; functions have at
/// most 64 arguments.
const CORNER: usize = 1 << 16;

/// A normal (0, 0, 1) and a view (sin, 0, cos), where the arguments are two such vectors: the axis
/// is the cosine, by the view's z.
fn directions(arguments: &[String], feeds: &mut [Option<Feed>]) -> Option<(usize, String)> {
    let vector = |words: &[&str]| {
        (0..arguments.len().saturating_sub(2)).find_map(|i| {
            let base = arguments[i].strip_suffix(".x")?;
            let parts = [".x", ".y", ".z"].map(|part| format!("{base}{part}"));
            let fits = words.contains(&base.to_ascii_lowercase().replace('_', "").as_str());
            let free = feeds[i..i + 3].iter().all(Option::is_none);
            (fits && free && arguments[i..i + 3] == parts).then(|| (i, base.to_string()))
        })
    };
    let (n, normal) = vector(&["n", "normal", "geometrynormal", "nrm"])?;
    let (v, view) = vector(&["v", "view", "viewdir", "wo", "eye", "viewdirection", "geometryviewdir"])?;
    feeds[n..n + 3].copy_from_slice(&[0.0, 0.0, 1.0].map(|x| Some(Feed::Value(x))));
    let axis = CORNER + v + 2;
    feeds[v..v + 3].copy_from_slice(&[
        Some(Feed::Sine(axis)),
        Some(Feed::Value(0.0)),
        Some(Feed::Axis(axis)),
    ]);
    Some((v + 2, format!("dot({normal}, {view})")))
}

/// Of a roughness and an alpha among the arguments left, the alpha.
fn both_widths(arguments: &[String], left: &[usize]) -> Option<usize> {
    let named = |word: &str| {
        let mut found = left.iter().filter(|i| arguments[**i].to_ascii_lowercase().contains(word));
        found.next().filter(|_| found.next().is_none()).copied()
    };
    named("rough").and(named("alpha"))
}

/// Whether a name says that an argument is a reflectance at normal incidence.
fn is_f0(name: &str, quantity: &dyn Quantity) -> bool {
    let lower = name.to_ascii_lowercase();
    let told =
        ["f0", "specular", "color", "colour", "reflectance", "rf0"].iter().any(|word| lower.contains(word));
    // A `specularRoughness` is a roughness.
    told && role_in(quantity, name).is_none()
}

/// The input that an argument's name tells, if it does.
pub(super) fn role(name: &str) -> Option<Input> {
    let ior = words(name).any(|word| word == "ior");
    let name = name.to_ascii_lowercase().replace('_', "");
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if name == "mu" || name == "nv" || has(&["ndotv", "nov", "ndotwo", "vdotn", "dotnv", "dot(", "cos"]) {
        return Some(Input::Mu);
    }
    if ior || matches!(name.as_str(), "eta" | "refractiveindex" | "indexofrefraction") {
        return Some(Input::Ior);
    }
    has(&["rough", "alpha", "gloss", "smooth"]).then_some(Input::Alpha)
}

/// Whether a name says that an argument falls as the surface gets rougher.
pub(super) fn is_gloss(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    name.contains("gloss") || name.contains("smooth")
}

/// The words of a snake or camel case name, in lower case: `specularIOR`, `ior_inside`, `IORValue`,
/// but not `interior`.
fn words(name: &str) -> impl Iterator<Item = String> {
    let letters: Vec<char> = name.chars().collect();
    let mut out = vec![String::new()];
    for (i, c) in letters.iter().enumerate() {
        let upper = |k: usize| letters.get(k).is_some_and(|c| c.is_uppercase());
        let lower = |k: usize| letters.get(k).is_some_and(|c| c.is_lowercase());
        let begins = upper(i) && (i > 0 && !upper(i - 1) || lower(i + 1));
        if begins || !c.is_alphabetic() {
            out.push(String::new());
        }
        if let Some(word) = out.last_mut().filter(|_| c.is_alphabetic()) {
            word.extend(c.to_lowercase());
        }
    }
    out.into_iter().filter(|word| !word.is_empty())
}
