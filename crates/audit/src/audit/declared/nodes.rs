//! The inputs at the texels of a table that says itself what it is: there a single wrong texel shows
//! whole, which between places that are even in the inputs it may not.

use super::domain::Domain;
use super::statement::{Axis, Statement};
use super::{coordinate, roughness};
use crate::audit::axis::Input;
use crate::audit::table::{AuditedTable, flat, place};

/// Most texels that are all judged; of more those that stand out most from their neighbours.
const ALL: usize = 4096;
const OUTSTANDING: usize = 256;

/// Halvings that find an input of a coordinate: the last digits of a single.
const HALVINGS: usize = 32;

/// Inputs by name, in the order of the truth.
pub(super) type Inputs = Vec<(&'static str, f64)>;

/// How many texels are judged, where the file claims something, and the inputs there.
pub(super) fn nodes(table: &AuditedTable, said: &Statement, domain: &Domain) -> (usize, Vec<Inputs>) {
    let count = table.channels.first().map_or(0, |c| c.values.len());
    let texels = if count > ALL { outstanding(table) } else { (0..count).collect() };
    let (mut judged, mut found) = (0, Vec::new());
    for texel in texels {
        let Some(known) = inverse(&place(texel, &table.size), table, said) else { continue };
        let from = found.len();
        // What runs along no axis, as the azimuth, is judged at both ends of its range.
        for last in [false, true] {
            let input = |(name, list): &(&'static str, Vec<f64>)| {
                let (low, high) = (*list.first()?, *list.last()?);
                let own = known.iter().find(|(own, _)| own == name).map(|(_, x)| *x);
                let x = own.unwrap_or(if last { high } else { low });
                ((low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&x))
                    .then_some((*name, x.clamp(low, high)))
            };
            let all: Option<Inputs> = domain.places.iter().map(input).collect();
            found.extend(all.filter(|inputs| !found[from..].contains(inputs)));
        }
        judged += usize::from(found.len() > from);
    }
    (judged, found)
}

/// Texels that are farthest from the mean of their neighbours, along the axis where they are least so.
fn outstanding(table: &AuditedTable) -> Vec<usize> {
    let size = &table.size;
    let off = |texel: usize| -> f64 {
        let at = place(texel, size);
        let along = |axis: usize, values: &[f64]| {
            let mut beside = [at.clone(), at.clone()];
            let ends = [at[axis] == 0, at[axis] + 1 == size[axis]];
            beside[0][axis] = if ends[0] { 2 } else { at[axis] - 1 };
            beside[1][axis] = if ends[1] { at[axis] - 2 } else { at[axis] + 1 };
            let [before, after] = beside.map(|at| values[flat(&at, size)]);
            let mean = match ends {
                [true, _] => 2.0 * after - before,
                [_, true] => 2.0 * before - after,
                _ => 0.5 * (before + after),
            };
            (values[texel] - mean).abs()
        };
        let of = |values: &Vec<f64>| (0..size.len()).map(|a| along(a, values)).fold(f64::INFINITY, f64::min);
        table.channels.iter().map(|c| of(&c.values)).fold(0.0, f64::max)
    };
    let mut ranked: Vec<(usize, f64)> = (0..size.iter().product()).map(|i| (i, off(i))).collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    ranked.into_iter().take(OUTSTANDING).map(|r| r.0).collect()
}

/// The inputs along the axes at a texel: each axis is solved once what its coordinate names is known;
/// none where that does not come to an end.
fn inverse(texel: &[usize], table: &AuditedTable, said: &Statement) -> Option<Vec<(&'static str, f64)>> {
    let mut known: Vec<(&str, f64)> = Vec::new();
    let mut open: Vec<(&Axis, f64)> = Vec::new();
    for ((axis, i), n) in said.axes.iter().zip(texel).zip(&table.size) {
        open.push((axis, axis.registration.coordinate(*i, *n)));
    }
    while !open.is_empty() {
        let before = open.len();
        open.retain(|(axis, u)| match solved(axis, *u, &known, said) {
            Some(x) => {
                known.push((axis.name.as_str(), x));
                false
            }
            None => true,
        });
        if open.len() == before {
            return None;
        }
    }
    let alpha = |x: f64| said.alpha.value(&|name| (name == "roughness").then_some(x));
    let input = |(name, x): (&str, f64)| match name {
        "roughness" => Some((Input::Alpha.name(), alpha(x)?)),
        name => INPUTS.into_iter().map(Input::name).find(|own| *own == name).map(|own| (own, x)),
    };
    known.into_iter().map(input).collect()
}

/// Inputs that run along axes.
const INPUTS: [Input; 5] = [Input::Alpha, Input::Mu, Input::Ior, Input::Anisotropy, Input::Azimuth];

/// What runs along an axis at a coordinate, by halving its range: coordinates rise.
fn solved(axis: &Axis, u: f64, known: &[(&str, f64)], said: &Statement) -> Option<f64> {
    let at = |x: f64| {
        let own = |name: &str| if name == axis.name { Some(x) } else { value(name, known) };
        let alpha = |name: &str| {
            let width = own("roughness").and_then(|r| said.alpha.value(&|n| (n == "roughness").then_some(r)));
            if name == "alpha" { width.or(own("alpha")) } else { own(name) }
        };
        let rough = |name: &str| match (name, own(name)) {
            ("roughness", None) => own("alpha").and_then(|alpha| roughness(said, alpha)),
            _ => alpha(name),
        };
        coordinate(axis, &rough).filter(|u| u.is_finite())
    };
    let [mut low, mut high] = axis.range;
    for end in [low, high] {
        if (at(end)? - u).abs() < 1e-12 {
            return Some(end);
        }
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if at(middle)? < u { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

fn value(name: &str, known: &[(&str, f64)]) -> Option<f64> {
    known.iter().find(|(own, _)| *own == name).map(|(_, x)| *x)
}
