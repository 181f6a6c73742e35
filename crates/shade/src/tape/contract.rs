//! A tape as a compiler may contract it: products that are only added become fused multiply-adds.

use super::{BinaryOp, Node, Op, Tape, UnaryOp};

impl Tape {
    /// The tape with every multiplication that the cost model fuses contracted into the additions
    /// that use it, rounded once.
    ///
    /// A quotient that the model fuses stays a quotient and an addition: an exact division is not a
    /// reciprocal and a product. Operations that nothing uses any more stay in the list.
    pub fn contracted(&self) -> Tape {
        let fused = self.fused(&self.constants());
        let mut tape = Tape { ops: Vec::new(), places: Vec::new(), ..self.clone() };
        let mut moved: Vec<Node> = Vec::with_capacity(self.ops.len());
        for (node, op) in self.ops.iter().enumerate() {
            let at = |n: Node| moved[n as usize];
            let contracted = match *op {
                Op::Binary(code @ (BinaryOp::Add | BinaryOp::Subtract), a, b) => {
                    self.fusion(&fused, code, a, b).map(|f| (f.of.map(at), f))
                }
                _ => None,
            };
            let place = self.places[node].clone();
            let mut push = |op| {
                tape.ops.push(op);
                tape.places.push(place.clone());
                tape.ops.len() as Node - 1
            };
            moved.push(match contracted {
                Some(([mut x, y, mut z], fusion)) => {
                    if fusion.negate_product {
                        x = push(Op::Unary(UnaryOp::Negate, x));
                    }
                    if fusion.negate_addend {
                        z = push(Op::Unary(UnaryOp::Negate, z));
                    }
                    push(Op::Fma(x, y, z))
                }
                None => push(op.with_operands(&moved)),
            });
        }
        tape
    }

    /// How a + b or a - b is a fused multiply-add, if one of the two is a fused product, through
    /// negations.
    fn fusion(&self, fused: &[bool], code: BinaryOp, a: Node, b: Node) -> Option<Fusion> {
        let minus = code == BinaryOp::Subtract;
        let product = |mut node: Node| {
            let mut negated = false;
            while let Op::Unary(UnaryOp::Negate, inner) = self.ops[node as usize] {
                (node, negated) = (inner, !negated);
            }
            match self.ops[node as usize] {
                Op::Binary(BinaryOp::Multiply, x, y) if fused[node as usize] => Some((x, y, negated)),
                _ => None,
            }
        };
        if let Some((x, y, negated)) = product(a) {
            return Some(Fusion { of: [x, y, b], negate_product: negated, negate_addend: minus });
        }
        let (x, y, negated) = product(b)?;
        Some(Fusion { of: [x, y, a], negate_product: negated != minus, negate_addend: false })
    }
}

/// A fused multiply-add: its factors and addend, each as it is or negated (which is exact).
struct Fusion {
    of: [Node; 3],
    negate_product: bool,
    negate_addend: bool,
}

impl Op {
    /// The same operation on other operands: `moved[n]` in place of n.
    fn with_operands(self, moved: &[Node]) -> Op {
        let at = |n: Node| moved[n as usize];
        match self {
            Op::Input(_) | Op::Parameter(_) | Op::Literal(_) => self,
            Op::Unary(code, a) => Op::Unary(code, at(a)),
            Op::Binary(code, a, b) => Op::Binary(code, at(a), at(b)),
            Op::Fma(a, b, c) => Op::Fma(at(a), at(b), at(c)),
            Op::Select(a, b, c) => Op::Select(at(a), at(b), at(c)),
        }
    }
}
