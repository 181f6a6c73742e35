//! Tapes of formulas that come from elsewhere than a hypothesis: operations one by one.

use std::collections::HashMap;

use super::build::{Key, canonical, key, reachable};
use super::real::{binary, select, unary};
use super::{Node, Op, Tape};
use crate::Place;

/// A tape under construction: equal operations are one. Operands must be nodes that it has
/// returned.
#[derive(Debug, Default)]
pub struct Assembler {
    ops: Vec<Op>,
    spans: Vec<(u32, u32)>,
    /// f32 values of the operations that depend on no input.
    constants: Vec<Option<f32>>,
    known: HashMap<Key, Node>,
}

impl Assembler {
    /// The node of an operation, new or known, with its byte range in the source.
    pub fn push(&mut self, op: Op, span: (u32, u32)) -> Node {
        let op = canonical(op);
        let key = key(op);
        if let Some(&node) = self.known.get(&key) {
            return node;
        }
        let node = self.ops.len() as Node;
        self.constants.push(self.fold(op));
        self.ops.push(op);
        self.spans.push(span);
        self.known.insert(key, node);
        node
    }

    fn fold(&self, op: Op) -> Option<f32> {
        let value = |node: Node| self.constant(node);
        Some(match op {
            Op::Input(_) | Op::Parameter(_) => return None,
            Op::Literal(x) => x,
            Op::Unary(code, a) => unary(code, value(a)?),
            Op::Binary(code, a, b) => binary(code, value(a)?, value(b)?),
            Op::Fma(a, b, c) => value(a)?.mul_add(value(b)?, value(c)?),
            Op::Select(a, b, c) => select(value(a)?, value(b)?, value(c)?),
        })
    }

    /// The f32 value of a node that depends on no input.
    pub fn constant(&self, node: Node) -> Option<f32> {
        self.constants.get(node as usize).copied().flatten()
    }

    /// Operations so far.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// The tape whose result is a node, of a function with these inputs and no parameters; `place`
    /// gives the places of byte ranges.
    pub fn tape(
        &self,
        result: Node,
        function: &str,
        inputs: &[String],
        place: impl Fn((u32, u32)) -> Place,
    ) -> Tape {
        let (ops, spans) = reachable(&self.ops, &self.spans, &[result]);
        Tape {
            ops,
            places: spans.into_iter().map(place).collect(),
            function: function.to_string(),
            inputs: inputs.to_vec(),
            parameters: 0,
        }
    }
}
