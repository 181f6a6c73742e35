//! A shader function as a table: its values at texel centres of the unit square (or cube) of its arguments, in f32 as a shader computes
//! them. What the arguments mean is then found as the axes of a table are.

use super::AuditError;
use super::axis::Input;
use super::shipped::{Shipped, ShippedChannel, Source, place};
use crate::foreign::{ShaderFunction, Step};

/// Places along every argument: of one, two and three.
const PLACES: [usize; 3] = [512, 128, 20];

/// Values that an argument for F0 takes, one after the other: f0 A + B at 0 is B, and at 1 it is E.
const BLENDS: [(f32, &str); 2] = [(0.0, "at F0 = 0"), (1.0, "at F0 = 1")];

/// A function over as many arguments as the quantity has inputs; `set` gives others a value, by name. An argument of which the name says
/// that it is an F0 or a colour is taken at 0 and at 1.
///
/// Errors: more or fewer arguments left than inputs; a value that is no number; an argument that is not there.
pub fn sampled(
    function: &ShaderFunction,
    inputs: usize,
    set: &[(String, f64)],
) -> Result<Shipped, AuditError> {
    let given = |name: &str| set.iter().find(|(n, _)| n == name).map(|(_, x)| *x as f32);
    if let Some((name, value)) = set.iter().find(|(n, _)| !function.inputs.contains(n)) {
        let reason = format!("{} has the arguments {}", function.name, function.inputs.join(", "));
        return Err(AuditError::Option { option: "--set", value: format!("{name}={value}"), reason });
    }
    let free: Vec<usize> =
        (0..function.inputs.len()).filter(|i| given(&function.inputs[*i]).is_none()).collect();
    let blended: Vec<usize> =
        free.iter().copied().filter(|i| free.len() > inputs && is_f0(&function.inputs[*i])).collect();
    let axes: Vec<usize> = free.into_iter().filter(|i| !blended.contains(i)).collect();
    if axes.len() != inputs || !(1..=3).contains(&inputs) {
        let names: Vec<&str> = axes.iter().map(|i| function.inputs[*i].as_str()).collect();
        return Err(AuditError::Arguments {
            function: function.name.clone(),
            names: names.join(", "),
            inputs,
        });
    }
    let n = PLACES[inputs - 1];
    let size = vec![n; inputs];
    let coordinate = |i: usize| (i as f32 + 0.5) / n as f32;
    let points: usize = size.iter().product();
    let places: Vec<Vec<usize>> = (0..points).map(|i| place(i, &size)).collect();
    let blends: &[(f32, &str)] = if blended.is_empty() { &BLENDS[..1] } else { &BLENDS };
    let mut channels: Vec<ShippedChannel> = Vec::new();
    for (f0, words) in blends {
        let name = |k: usize| {
            let component =
                match (function.results.get(k).map_or("", String::as_str), function.components.len()) {
                    ("", 1) => "result".to_string(),
                    ("", _) => k.to_string(),
                    (name, _) => name.to_string(),
                };
            if blended.is_empty() { component } else { format!("{component} {words}") }
        };
        let column = |argument: usize| -> Vec<f32> {
            if let Some(value) = given(&function.inputs[argument]) {
                return vec![value; points];
            }
            match axes.iter().position(|a| *a == argument) {
                Some(axis) => places.iter().map(|p| coordinate(p[axis])).collect(),
                None => vec![*f0; points],
            }
        };
        let columns: Vec<Vec<f32>> = (0..function.inputs.len()).map(column).collect();
        for (k, tape) in function.components.iter().enumerate() {
            let values = tape.evaluate(&columns, &[]).map_err(|e| AuditError::Evaluate {
                function: function.name.clone(),
                reason: e.to_string(),
            })?;
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            // A grey result is one channel, not three.
            if !channels.iter().any(|c| c.values == values) {
                channels.push(ShippedChannel { name: name(k), values });
            }
        }
    }
    Ok(Shipped {
        what: function.name.clone(),
        size,
        axes: axes.iter().map(|i| function.inputs[*i].clone()).collect(),
        source: Source::Function,
        channels,
        step: Step::None,
    })
}

/// Whether a name says that an argument is a reflectance at normal incidence.
fn is_f0(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    let told =
        ["f0", "specular", "color", "colour", "reflectance", "rf0"].iter().any(|word| lower.contains(word));
    // A `specularRoughness` is a roughness.
    told && role(name).is_none()
}

/// The input that an argument's name tells, if it does.
pub(super) fn role(name: &str) -> Option<Input> {
    let name = name.to_ascii_lowercase().replace('_', "");
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if name == "mu" || name == "nv" || has(&["ndotv", "nov", "ndotwo", "vdotn", "cos"]) {
        return Some(Input::Mu);
    }
    has(&["rough", "alpha", "gloss", "smooth"]).then_some(Input::Alpha)
}
