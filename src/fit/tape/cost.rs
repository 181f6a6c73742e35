//! What a formula takes at run time, by the project's operation model.

use std::collections::BTreeMap;

use super::{BinaryOp, Node, Op, Tape, UnaryOp};

/// rcp, sqrt, inverse sqrt, exp2, log2, sin, cos: one instruction of the special-function unit, a quarter rate.
const SPECIAL: u32 = 4;

impl Tape {
    /// Weighted operations with parameters and literals constant: add, mul, fma, min, max, compare, select, floor,
    /// logic 1; rcp, sqrt, inverseSqrt, exp2, log2, sin, cos 4; a division is rcp + mul (the rcp of a divisor is
    /// counted once, 1/x has no mul); exp and log 5; pow 9; sign 2; negate, not, abs, saturate 0. Constant
    /// sub-expressions cost nothing, common ones count once, a mul whose only use is an add or a subtraction fuses.
    pub fn cost_ops(&self) -> u32 {
        let constant = self.constants();
        let users = self.users(&constant);
        let mut fused = vec![false; self.ops.len()];
        let mut reciprocals = BTreeMap::new();
        let mut total = 0;
        for (node, op) in self.ops.iter().enumerate() {
            if constant[node] {
                continue;
            }
            if let Op::Binary(BinaryOp::Add | BinaryOp::Subtract, a, b) = *op
                && let Some(product) = [a, b].into_iter().find_map(|n| self.product(n, &users, &constant))
                && !fused[product as usize]
            {
                fused[product as usize] = true;
                total -= 1;
            }
            total += self.weight(op, &constant, &mut reciprocals);
        }
        total as u32
    }

    /// Which operations depend on no input.
    fn constants(&self) -> Vec<bool> {
        let mut constant: Vec<bool> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let value = !matches!(op, Op::Input(_)) && op.operands().all(|n| constant[n as usize]);
            constant.push(value);
        }
        constant
    }

    /// How often each operation is used by others that count.
    fn users(&self, constant: &[bool]) -> Vec<u32> {
        let mut users = vec![0; self.ops.len()];
        for (op, _) in self.ops.iter().zip(constant).filter(|(_, constant)| !**constant) {
            op.operands().for_each(|n| users[n as usize] += 1);
        }
        users
    }

    /// The multiplication that an addition's operand is, through negations, if nothing else uses it.
    fn product(&self, node: Node, users: &[u32], constant: &[bool]) -> Option<Node> {
        let at = node as usize;
        if users[at] != 1 || constant[at] {
            return None;
        }
        match self.ops[at] {
            Op::Unary(UnaryOp::Negate, a) => self.product(a, users, constant),
            Op::Binary(BinaryOp::Multiply, ..) => Some(node),
            Op::Binary(BinaryOp::Divide, a, _) if !self.is_one(a) => Some(node),
            _ => None,
        }
    }

    fn is_one(&self, node: Node) -> bool {
        matches!(self.ops[node as usize], Op::Literal(x) if x.abs() == 1.0)
    }

    fn weight(&self, op: &Op, constant: &[bool], reciprocals: &mut BTreeMap<Node, ()>) -> i32 {
        let weight = match *op {
            Op::Input(_) | Op::Parameter(_) | Op::Literal(_) => 0,
            Op::Fma(..) | Op::Select(..) => 1,
            Op::Unary(code, _) => match code {
                UnaryOp::Negate | UnaryOp::Not | UnaryOp::Abs | UnaryOp::Saturate => 0,
                UnaryOp::Floor => 1,
                UnaryOp::Sign => 2,
                UnaryOp::Exp | UnaryOp::Log => SPECIAL + 1,
                UnaryOp::Sqrt
                | UnaryOp::InverseSqrt
                | UnaryOp::Exp2
                | UnaryOp::Log2
                | UnaryOp::Sin
                | UnaryOp::Cos => SPECIAL,
            },
            Op::Binary(BinaryOp::Divide, a, b) => {
                let paid = constant[b as usize] || reciprocals.insert(b, ()).is_some();
                let reciprocal = if paid { 0 } else { SPECIAL };
                reciprocal + u32::from(!self.is_one(a))
            }
            // pow(x, y) = exp2(y log2(x))
            Op::Binary(BinaryOp::Pow, ..) => 2 * SPECIAL + 1,
            Op::Binary(..) => 1,
        };
        weight as i32
    }
}
