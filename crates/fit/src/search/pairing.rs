//! Formulas that are made of two functions u and v of the inputs and a further argument t.

use super::draft::Part;
use super::graph::{Graph, Node};
use super::space::Space;
use super::write::{NAMES, Sums, Written};
use super::writer::Writer;
use lobefit_shade::tape::BinaryOp;

/// How the value follows from u, v and t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// v + t (u - v): from v at t = 0 to u at t = 1.
    Mix,
    /// u (v + t (1 - v)): from u v at t = 0 to u at t = 1.
    Blend,
    /// 1 - u (v + t (1 - v)): what a blend leaves.
    Rest,
    /// g (v + u (1 - g v)) with g = 1 - t: what is left of g v once more, in the share u.
    Recycled,
}

impl Pairing {
    /// The value is m v + n: m and n.
    pub(super) fn of_second(self, t: f64, u: f64) -> [f64; 2] {
        let g = 1.0 - t;
        match self {
            Pairing::Mix => [g, t * u],
            Pairing::Blend => [g * u, t * u],
            Pairing::Rest => [-g * u, 1.0 - t * u],
            Pairing::Recycled => [g * (1.0 - g * u), g * u],
        }
    }

    /// The value is p u + q: p.
    pub(super) fn of_first(self, t: f64, v: f64) -> f64 {
        let g = 1.0 - t;
        match self {
            Pairing::Mix => t,
            Pairing::Blend => v + t * (1.0 - v),
            Pairing::Rest => -(v + t * (1.0 - v)),
            Pairing::Recycled => g * (1.0 - g * v),
        }
    }

    /// Largest error of the value, from those of u and of v with what they are multiplied by:
    /// between 0 and 1 both errors of a blend are averaged, the others add up.
    pub(super) fn error(self, u: f64, v: f64) -> f64 {
        match self {
            Pairing::Mix | Pairing::Blend | Pairing::Rest => u.max(v),
            Pairing::Recycled => u + v,
        }
    }

    /// The value of u and v given as quotients, with a single division.
    fn value(self, graph: &mut Graph, t: Node, [nu, du]: [Node; 2], [nv, dv]: [Node; 2]) -> Node {
        let one = graph.number(1.0);
        let add = BinaryOp::Add;
        let bottom = graph.times(du, dv);
        match self {
            Pairing::Mix => {
                let (left, right) = (graph.times(nu, dv), graph.times(nv, du));
                let slope = graph.binary(BinaryOp::Subtract, left, right);
                let slope = graph.times(t, slope);
                let top = graph.binary(add, right, slope);
                quotient(graph, top, bottom)
            }
            Pairing::Blend | Pairing::Rest => {
                let slope = graph.binary(BinaryOp::Subtract, dv, nv);
                let slope = graph.times(t, slope);
                let inner = graph.binary(add, nv, slope);
                let top = graph.times(nu, inner);
                let blend = quotient(graph, top, bottom);
                if self == Pairing::Blend { blend } else { graph.binary(BinaryOp::Subtract, one, blend) }
            }
            Pairing::Recycled => {
                let g = graph.binary(BinaryOp::Subtract, one, t);
                let rest = graph.times(g, nv);
                let rest = graph.binary(BinaryOp::Subtract, dv, rest);
                let (rest, first) = (graph.times(nu, rest), graph.times(nv, du));
                let sum = graph.binary(add, first, rest);
                let top = graph.times(g, sum);
                quotient(graph, top, bottom)
            }
        }
    }
}

fn quotient(graph: &mut Graph, top: Node, bottom: Node) -> Node {
    if graph.is_one(bottom) { top } else { graph.binary(BinaryOp::Divide, top, bottom) }
}

/// The cheapest way of writing two forms as one formula: each of them by itself, or a quotient of
/// the whole. Common operations count once.
pub(super) fn write_pair(
    pairing: Pairing,
    spaces: [&Space; 2],
    parts: &[Part; 2],
    argument: &str,
) -> Option<(u32, Written)> {
    let ways = [[true, true], [true, false], [false, true], [false, false]];
    let written = ways.into_iter().filter_map(|whole| {
        let mut writer = Writer::new(spaces[0]);
        let sums = [0, 1].map(|k| writer.sums(parts[k].form, &parts[k].layout, &NAMES[k]));
        let t = writer.further();
        let mut values = [[0; 2]; 2];
        for k in 0..2 {
            values[k] = value(&mut writer.graph, sums[k], spaces[k], &parts[k], whole[k])?;
        }
        let result = pairing.value(&mut writer.graph, t, values[0], values[1]);
        let cost = writer.graph.cost(result);
        let mut written = writer.finish(result);
        written.arguments.push(argument.to_string());
        Some((cost, written))
    });
    written.min_by_key(|(cost, _)| *cost)
}

/// A part as a quotient: of two sums, or (itself, 1). None where it has no sums to be a quotient
/// of.
fn value(graph: &mut Graph, sums: Sums, space: &Space, part: &Part, whole: bool) -> Option<[Node; 2]> {
    let base = space.base();
    if !whole {
        return sums.quotient(graph, base, part.negative);
    }
    let value = sums.value(graph, base, part.negative);
    graph.name(value, &space.name);
    Some([value, graph.number(1.0)])
}
