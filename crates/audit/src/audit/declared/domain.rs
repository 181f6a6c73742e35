//! Where a table is judged that says itself what it is: over the domain that it claims, as far as
//! the truth is had; and what its axes cover beyond that, of which nothing is known.

use super::statement::{Axis, Statement};
use crate::audit::axis::Input;
use crate::audit::truth::Truth;
use crate::audit::verdict::number;

/// Places along the inputs: of two, of three and of four.
const PLACES: [usize; 3] = [64, 14, 11];

/// Cosine below which the certificates of this tool claim nothing, though axes of mu begin at 0: no
/// table is held to more.
const GRAZING: f64 = 0.001;

/// How far apart ends may lie that are the same: they are printed, and one may come of the other by
/// a formula.
const SAME: f64 = 1e-6;

/// What is judged of a table.
pub(super) struct Domain {
    /// Every input with its places, both ends among them; more of mu and alpha where they are
    /// small.
    pub places: Vec<(&'static str, Vec<f64>)>,
    /// What the axes cover and the file claims nothing of: `alpha below 0.02`.
    pub beyond: Vec<String>,
    /// What the file claims and the truth is not had of.
    pub cut: Vec<String>,
}

impl Domain {
    /// Errors: an input of which the statement gives no range, or one that is empty where the truth is had,
    /// or a single value of an axis.
    pub fn new(truth: &Truth, own: usize, said: &Statement) -> Result<Domain, String> {
        let count = PLACES[truth.spec.inputs.len().clamp(2, 4) - 2];
        let mut out = Domain { places: Vec::new(), beyond: Vec::new(), cut: Vec::new() };
        for input in truth.spec.inputs {
            let name = input.name();
            let [low, high] = truth.range(own, *input);
            // A table of the azimuth is of all of them.
            let all = (*input == Input::Azimuth).then_some([low, high]);
            let claimed = said.range(name).or(all);
            let claimed = claimed.ok_or_else(|| format!("its line `domain` has no {name}"))?;
            let [from, to] = claimed.map(|x| x.clamp(low, high));
            let covered = cover(said, *input)?;
            let is_constant = covered.is_none() && claimed == [from, to] && from == to;
            let along = if is_constant { vec![from] } else { places(*input, [from, to], count)? };
            out.places.push((name, along));
            out.cut.extend(outside(name, claimed, [low, high]));
            let [least, most] = covered.unwrap_or(if is_constant { claimed } else { [low, high] });
            let least = if *input == Input::Mu { least.max(GRAZING) } else { least };
            out.beyond.extend(outside(name, [least.max(low), most.min(high)], [from, to]));
        }
        Ok(out)
    }
}

fn places(input: Input, [from, to]: [f64; 2], count: usize) -> Result<Vec<f64>, String> {
    let curved = matches!(input, Input::Mu | Input::Alpha);
    let at = |k: usize| {
        let u = k as f64 / (count - 1) as f64;
        (from + (to - from) * if curved { u * u } else { u }).clamp(from, to)
    };
    let list: Vec<f64> = (0..count).map(at).collect();
    if list.windows(2).all(|w| w[0] < w[1]) {
        return Ok(list);
    }
    let name = input.name();
    Err(format!("its line `domain` leaves no range of {name} in which the truth is had, but {from} to {to}"))
}

/// The parts of a range outside of another, in words.
fn outside(name: &str, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> Vec<String> {
    let below = (from < low - SAME).then(|| format!("{name} below {}", number(low)));
    let above = (to > high + SAME).then(|| format!("{name} above {}", number(high)));
    below.into_iter().chain(above).collect()
}

/// The range of an input that the axes cover; none where no axis bears its name.
fn cover(said: &Statement, input: Input) -> Result<Option<[f64; 2]>, String> {
    let axis = |name: &str| said.axes.iter().find(|a| a.name == name);
    if let Some(Axis { range, .. }) = axis(input.name()) {
        return Ok(Some(*range));
    }
    let Some(axis) = axis("roughness").filter(|_| input == Input::Alpha) else { return Ok(None) };
    let alpha = |roughness: f64| {
        let value = said.alpha.value(&|name| (name == "roughness").then_some(roughness));
        value
            .filter(|x| x.is_finite())
            .ok_or_else(|| format!("its `alpha` has no value at roughness {roughness}"))
    };
    let [a, b] = [alpha(axis.range[0])?, alpha(axis.range[1])?];
    Ok(Some([a.min(b), a.max(b)]))
}
