//! What a formula takes at run time, by the project's operation model.

use std::collections::BTreeSet;

use super::{BinaryOp, Node, Op, Tape, UnaryOp};

/// rcp, sqrt, inverse sqrt, exp2, log2, sin, cos: one instruction of the special-function unit, a
/// quarter rate.
const SPECIAL: u32 = 4;

impl Tape {
    /// Weighted operations with parameters and literals constant: add, mul, fma, min, max, compare,
    /// select, floor, logic 1; rcp, sqrt, inverseSqrt, exp2, log2, sin, cos 4; a division is
    /// rcp + mul (the rcp of a divisor is counted once, 1/x has no mul); exp and log 5; pow 9; sign
    /// 2; negate, not, abs, saturate 0. Constant sub-expressions cost nothing, common ones count
    /// once; a mul all of whose users are additions or subtractions fuses into them, one into each.
    pub fn cost_ops(&self) -> u32 {
        let constant = self.constants();
        let fused = self.fused(&constant);
        let mut reciprocals = BTreeSet::new();
        let counted = (0..self.ops.len()).filter(|&node| !constant[node]);
        counted
            .map(|node| self.weight(&self.ops[node], &constant, &mut reciprocals) - u32::from(fused[node]))
            .sum()
    }

    /// The multiplications that disappear into additions.
    pub(super) fn fused(&self, constant: &[bool]) -> Vec<bool> {
        let mut users: Vec<Vec<Node>> = vec![Vec::new(); self.ops.len()];
        for (node, op) in self.ops.iter().enumerate().filter(|(node, _)| !constant[*node]) {
            op.operands().for_each(|n| users[n as usize].push(node as Node));
        }
        let mut taken = vec![false; self.ops.len()];
        let mut fused = vec![false; self.ops.len()];
        for node in (0..self.ops.len()).filter(|&n| !constant[n] && self.multiplies(n)) {
            let additions = self.additions(node, &users);
            // x y + x y needs the product itself.
            let distinct = additions.iter().collect::<BTreeSet<_>>().len() == additions.len();
            if distinct && !additions.is_empty() && additions.iter().all(|a| a.is_some_and(|a| !taken[a])) {
                fused[node] = true;
                additions.into_iter().flatten().for_each(|a| taken[a] = true);
            }
        }
        fused
    }

    /// The additions that use a value, through negations; `None` for every other use.
    fn additions(&self, node: usize, users: &[Vec<Node>]) -> Vec<Option<usize>> {
        let mut found = Vec::new();
        for &user in &users[node] {
            match self.ops[user as usize] {
                Op::Unary(UnaryOp::Negate, _) => found.extend(self.additions(user as usize, users)),
                Op::Binary(BinaryOp::Add | BinaryOp::Subtract, ..) => found.push(Some(user as usize)),
                _ => found.push(None),
            }
        }
        found
    }

    /// Whether an operation ends in a multiplication.
    fn multiplies(&self, node: usize) -> bool {
        match self.ops[node] {
            Op::Binary(BinaryOp::Multiply, ..) => true,
            Op::Binary(BinaryOp::Divide, a, _) => !self.is_one(a),
            _ => false,
        }
    }

    /// Which operations depend on no input.
    pub(super) fn constants(&self) -> Vec<bool> {
        let mut constant: Vec<bool> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let value = !matches!(op, Op::Input(_)) && op.operands().all(|n| constant[n as usize]);
            constant.push(value);
        }
        constant
    }

    pub(super) fn is_one(&self, node: Node) -> bool {
        matches!(self.ops[node as usize], Op::Literal(x) if x.abs() == 1.0)
    }

    fn weight(&self, op: &Op, constant: &[bool], reciprocals: &mut BTreeSet<Node>) -> u32 {
        match *op {
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
                let paid = constant[b as usize] || !reciprocals.insert(b);
                let reciprocal = if paid { 0 } else { SPECIAL };
                reciprocal + u32::from(!self.is_one(a))
            }
            // pow(x, y) = exp2(y log2(x))
            Op::Binary(BinaryOp::Pow, ..) => 2 * SPECIAL + 1,
            Op::Binary(..) => 1,
        }
    }
}
