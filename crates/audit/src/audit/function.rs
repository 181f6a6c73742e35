//! A shader function as a table: its values at texel centres of the unit square (or cube) of its
//! arguments, in f32 as a shader computes them. What the arguments mean is then found as the axes
//! of a table are.

use super::AuditError;
use super::arguments::{Feed, feeds};
use super::axis::Scale;
use super::table::{AuditedTable, Source, place};
use crate::foreign::{Channel, ShaderFunction, Step};
use lobefit_math::ops;
use lobefit_truth::quantity::Quantity;

/// Places along every argument: of one, two and three,
const PLACES: [usize; 3] = [512, 128, 20];
/// and of a function that takes long at least.
const FEWEST: [usize; 3] = [64, 16, 8];

/// Statements and expressions that are run in all at most, but for the fewest places: 8 s on two cores.
const STEPS: f64 = 3e8;

/// Values that an argument for F0 takes, one after the other: f0 A + B at 0 is B, and at 1 it is E.
const BLENDS: [(f32, &str); 2] = [(0.0, "at f0 = 0"), (1.0, AT_ONE)];

/// How the name of a channel at an f0 of 1 ends.
pub(super) const AT_ONE: &str = "at f0 = 1";

/// An F0 that every saturate(50 f0), by which engines take black for no mirror, leaves whole.
const DIELECTRIC: f32 = 0.04;

/// A function over as many arguments as the quantity has inputs; `set` gives others a value, by
/// name, and `axes` says what the remaining ones are given, if the user does.
///
/// An argument runs over 0 to 1, one that is an index of refraction (by its name, if the quantity
/// has one, or by `axes`) over 1 to 2. One whose name says that it is an F0 or a colour is taken at
/// 0 and at 1, alpha beside a roughness is its square, and a normal and a view are two unit
/// vectors.
///
/// # Errors
/// More or fewer arguments left than inputs; a value that is no number; an argument that is not
/// there.
pub fn sampled(
    function: &ShaderFunction,
    quantity: &dyn Quantity,
    set: &[(String, f64)],
    axes: &[Scale],
) -> Result<AuditedTable, AuditError> {
    of_feeds(function, feeds(function, quantity, set, axes, false)?)
}

/// The same with the argument that is named for an index of refraction running over 1/ior from 1/2
/// to 1, for [`Fixed::inverse`](super::Fixed::inverse); none of a function that has no such
/// argument.
///
/// # Errors
/// As of [`sampled`].
pub fn sampled_inverse(
    function: &ShaderFunction,
    quantity: &dyn Quantity,
    set: &[(String, f64)],
) -> Result<Option<AuditedTable>, AuditError> {
    let (names, feeds) = feeds(function, quantity, set, &[], true)?;
    if !feeds.iter().any(|feed| matches!(feed, Feed::Eta(_))) {
        return Ok(None);
    }
    of_feeds(function, (names, feeds)).map(Some)
}

fn of_feeds(
    function: &ShaderFunction,
    (names, feeds): (Vec<String>, Vec<Feed>),
) -> Result<AuditedTable, AuditError> {
    let n = places(function, names.len(), &feeds);
    let size = vec![n; names.len()];
    let places: Vec<Vec<usize>> = (0..size.iter().product()).map(|i| place(i, &size)).collect();
    let centre = |i: usize| (i as f32 + 0.5) / n as f32;
    let blended = feeds.contains(&Feed::Blend);
    let run = |f0: f32| -> Result<Vec<Vec<f64>>, AuditError> {
        let column = |feed: &Feed| -> Vec<f32> {
            places.iter().map(|p| feed.value(&|axis| centre(p[axis]), f0)).collect()
        };
        let columns: Vec<Vec<f32>> = feeds.iter().map(column).collect();
        let results = function.evaluate(&columns);
        let results = results.map_err(|e| AuditError::refused(&function.name, e.to_string()))?;
        Ok(results.into_iter().map(|values| values.into_iter().map(f64::from).collect()).collect())
    };
    let mut channels: Vec<Channel> = Vec::new();
    let mut add = |name: String, values: Vec<f64>| {
        // A grey result is one channel, not three.
        if !channels.iter().any(|c| *c.values == values) {
            channels.push(Channel { name, values: values.into() });
        }
    };
    let blends: &[(f32, &str)] = if blended { &BLENDS } else { &BLENDS[..1] };
    let runs = blends.iter().map(|(f0, _)| run(*f0)).collect::<Result<Vec<_>, _>>()?;
    let constant = |values: &[f64]| values.iter().all(|v| *v == values[0]);
    let hidden = |k: usize| runs.len() > 1 && constant(&runs[0][k]) && !constant(&runs[1][k]);
    // 1 + f0 (N - 1), a compensation in colour, is 1 there: what there is of it is N.
    let factor = |k: usize| hidden(k) && runs[0][k][0] == 1.0;
    let hidden = |k: usize| hidden(k) && !factor(k);
    let some = (0..function.results.len()).any(hidden).then(|| run(DIELECTRIC)).transpose()?;
    for ((_, words), (which, results)) in blends.iter().zip(runs.iter().enumerate()) {
        for (k, values) in results.iter().enumerate() {
            let component = component(function, k);
            match &some {
                // Black is taken for no mirror: B is what is left at f0 = 0 of the line through two
                // others.
                Some(some) if which == 0 && hidden(k) => {
                    let low = f64::from(DIELECTRIC);
                    let pairs = some[k].iter().zip(&runs[1][k]);
                    let values = pairs.map(|(at, one)| (at - low * one) / (1.0 - low)).collect();
                    add(format!("{component} less f0 A, by f0 = {DIELECTRIC} and 1"), values);
                }
                _ if which == 0 && factor(k) => {}
                _ if blended => add(format!("{component} {words}"), values.clone()),
                _ => add(component, values.clone()),
            }
        }
    }
    Ok(AuditedTable {
        what: function.name.clone(),
        size,
        axes: names,
        source: Source::Function,
        channels,
        step: Step::None,
        scale: 1.0,
        dead: Vec::new(),
    })
}

/// Places along every argument at which a function is taken: fewer of one that takes many steps, as loops
/// over samples do. What cannot be run is said of the first place at which it is.
fn places(function: &ShaderFunction, arguments: usize, feeds: &[Feed]) -> usize {
    let [most, fewest] = [PLACES, FEWEST].map(|places| places[arguments - 1]);
    let steps = |x: f32| {
        let point: Vec<f32> = feeds.iter().map(|feed| feed.value(&|_| x, 1.0)).collect();
        function.steps(&point).unwrap_or(0)
    };
    let steps = [0.1, 0.5, 0.9].map(steps).into_iter().fold(1, usize::max);
    let affordable = ops::pow(STEPS / steps as f64, 1.0 / arguments as f64) as usize;
    affordable.clamp(fewest, most)
}

/// Name of a scalar of the result.
fn component(function: &ShaderFunction, k: usize) -> String {
    match (function.results[k].as_str(), function.results.len()) {
        ("", 1) => "result".to_string(),
        ("", _) => k.to_string(),
        (name, _) => name.to_string(),
    }
}
