//! What a formula's compiled code is made of, and what that costs where each kind has a price.

use std::collections::BTreeSet;

use super::{BinaryOp, Node, Op, Tape, UnaryOp};

/// Kinds of work in a formula, or a price for each.
///
/// Products that additions take in are counted as [`Features::cost_ops`](Tape::cost_ops) fuses
/// them, parameters are literals, and constant sub-expressions one literal each. Numbers that
/// instructions hold for free are no literals: 0, and 1/2, 1, 2 and 4 with either sign.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Features {
    /// Additions and subtractions that take in no product.
    pub additions: f64,
    /// Products that no addition takes in; that of a division with the reciprocal among them.
    pub products: f64,
    /// Multiply-adds.
    pub multiply_adds: f64,
    /// Minima, maxima, comparisons, selections, roundings and logic.
    pub comparisons: f64,
    /// Reciprocals, roots, exponentials, logarithms, sines and cosines.
    pub transcendentals: f64,
    /// Operands that are literals.
    pub literals: f64,
    /// Operations with two literals or more.
    pub pairs: f64,
    /// Operations in the longest chain in which each waits for the one before.
    pub chain: f64,
    /// -1 for each function: what runs while inputs are awaited, or instead of an empty shader, is not paid.
    pub overlap: f64,
}

impl Features {
    /// Names of all, in order.
    pub const NAMES: [&str; 9] = [
        "additions",
        "products",
        "multiply_adds",
        "comparisons",
        "transcendentals",
        "literals",
        "pairs",
        "chain",
        "overlap",
    ];

    /// All, in the order of their names.
    pub fn all(&self) -> [f64; 9] {
        let Features { additions, products, multiply_adds, comparisons, .. } = *self;
        let Features { transcendentals, literals, pairs, chain, overlap, .. } = *self;
        [additions, products, multiply_adds, comparisons, transcendentals, literals, pairs, chain, overlap]
    }

    /// Of numbers in the order of the names.
    pub fn of(all: [f64; 9]) -> Features {
        let [additions, products, multiply_adds, comparisons, ..] = all;
        let [.., transcendentals, literals, pairs, chain, overlap] = all;
        Features {
            additions,
            products,
            multiply_adds,
            comparisons,
            transcendentals,
            literals,
            pairs,
            chain,
            overlap,
        }
    }

    /// The work of so many evaluations in one function, whose inputs are awaited once.
    pub fn times(&self, count: u32) -> Features {
        let all = self.all().map(|work| work * f64::from(count));
        Features { overlap: self.overlap, ..Features::of(all) }
    }

    /// What work costs at these prices: not less than nothing.
    pub fn price(&self, work: &Features) -> f64 {
        self.all().iter().zip(work.all()).map(|(price, count)| price * count).sum::<f64>().max(0.0)
    }
}

/// What an operation adds beside its literals: instructions of each kind, in order.
#[derive(Default)]
struct Instructions {
    products: u32,
    comparisons: u32,
    transcendentals: u32,
}

impl Tape {
    /// The kinds of work in this formula.
    pub fn features(&self) -> Features {
        self.features_of(&self.live())
    }

    /// The same of the operations that some result depends on.
    fn features_of(&self, live: &[bool]) -> Features {
        let constant = self.constants();
        let fused = self.fused(&constant);
        let mut reciprocals = BTreeSet::new();
        let mut features = Features { overlap: -1.0, ..Features::default() };
        let mut depth: Vec<f64> = Vec::with_capacity(self.ops.len());
        for (node, op) in self.ops.iter().enumerate() {
            let before = self.before(op, &depth, &constant);
            if constant[node] || !live[node] {
                depth.push(before);
                continue;
            }
            let Instructions { products, comparisons, transcendentals } =
                self.instructions(op, &constant, &mut reciprocals);
            let products = products - u32::from(fused[node]);
            features.products += f64::from(products);
            features.comparisons += f64::from(comparisons);
            features.transcendentals += f64::from(transcendentals);
            let sum = matches!(op, Op::Fma(..) | Op::Binary(BinaryOp::Add | BinaryOp::Subtract, ..));
            let taken = sum.then(|| op.operands().find_map(|n| self.product_of(n, &fused))).flatten();
            match taken {
                _ if !sum => {}
                None if !matches!(op, Op::Fma(..)) => features.additions += 1.0,
                _ => features.multiply_adds += 1.0,
            }
            if !fused[node] {
                let literals = self.literals(op, taken, &constant);
                features.literals += f64::from(literals);
                features.pairs += f64::from(u32::from(literals > 1));
            }
            let reciprocal = matches!(op, Op::Binary(BinaryOp::Divide, ..));
            let steps =
                products + comparisons + u32::from(sum) + if reciprocal { 0 } else { transcendentals };
            depth.push(before + f64::from(steps));
        }
        features.chain = depth
            .into_iter()
            .zip(live)
            .filter(|(_, live)| **live)
            .map(|(steps, _)| steps)
            .fold(0.0, f64::max);
        features
    }

    /// The kinds of work in functions of several results; the chain is the longest of any.
    pub(crate) fn features_of_all(&self) -> Features {
        let live = vec![true; self.ops.len()];
        self.features_of(&live)
    }

    /// How long the chain before an operation is; a reciprocal is a part of the chain of every
    /// quotient that it is in.
    fn before(&self, op: &Op, depth: &[f64], constant: &[bool]) -> f64 {
        let of = |n: Node| depth[n as usize];
        match *op {
            Op::Binary(BinaryOp::Divide, a, b) if !constant[b as usize] => of(a).max(of(b) + 1.0),
            _ => op.operands().map(of).fold(0.0, f64::max),
        }
    }

    /// Which operations the result depends on.
    fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.ops.len()];
        if let Some(last) = live.last_mut() {
            *last = true;
        }
        for node in (0..self.ops.len()).rev() {
            if live[node] {
                self.ops[node].operands().for_each(|n| live[n as usize] = true);
            }
        }
        live
    }

    /// The product that an addition takes in at an operand, through negations.
    fn product_of(&self, mut node: Node, fused: &[bool]) -> Option<Node> {
        while let Op::Unary(UnaryOp::Negate, inner) = self.ops[node as usize] {
            node = inner;
        }
        fused[node as usize].then_some(node)
    }

    /// Literals among the operands of the instruction that an operation ends in; of a multiply-add,
    /// also those of the product that it takes in.
    fn literals(&self, op: &Op, taken: Option<Node>, constant: &[bool]) -> u32 {
        let literal = |node: Node| u32::from(constant[node as usize] && !self.is_free(node));
        let own = match *op {
            // The numerator's product; the reciprocal of a constant is one.
            Op::Binary(BinaryOp::Divide, a, b) => literal(a) + u32::from(constant[b as usize]),
            Op::Unary(UnaryOp::Negate | UnaryOp::Not | UnaryOp::Abs | UnaryOp::Saturate, _) => 0,
            _ => op.operands().map(literal).sum(),
        };
        let product = taken.map_or(0, |node| match self.ops[node as usize] {
            Op::Binary(_, a, b) => literal(a) + literal(b),
            _ => 0,
        });
        own + product
    }

    /// Whether instructions hold a number without a literal.
    fn is_free(&self, node: Node) -> bool {
        matches!(self.ops[node as usize], Op::Literal(x) if [0.0, 0.5, 1.0, 2.0, 4.0].contains(&x.abs()))
    }

    fn instructions(&self, op: &Op, constant: &[bool], reciprocals: &mut BTreeSet<Node>) -> Instructions {
        let of =
            |products, comparisons, transcendentals| Instructions { products, comparisons, transcendentals };
        match *op {
            Op::Input(_) | Op::Parameter(_) | Op::Literal(_) | Op::Fma(..) => of(0, 0, 0),
            Op::Select(..) => of(0, 1, 0),
            Op::Unary(code, _) => match code {
                UnaryOp::Negate | UnaryOp::Not | UnaryOp::Abs | UnaryOp::Saturate => of(0, 0, 0),
                UnaryOp::Floor => of(0, 1, 0),
                UnaryOp::Sign => of(0, 2, 0),
                UnaryOp::Exp | UnaryOp::Log => of(1, 0, 1),
                UnaryOp::Sqrt
                | UnaryOp::InverseSqrt
                | UnaryOp::Exp2
                | UnaryOp::Log2
                | UnaryOp::Sin
                | UnaryOp::Cos => of(0, 0, 1),
            },
            Op::Binary(code, a, b) => match code {
                BinaryOp::Add | BinaryOp::Subtract => of(0, 0, 0),
                BinaryOp::Multiply => of(1, 0, 0),
                BinaryOp::Divide => {
                    let paid = constant[b as usize] || !reciprocals.insert(b);
                    of(u32::from(!self.is_one(a)), 0, u32::from(!paid))
                }
                // pow(x, y) = exp2(y log2(x))
                BinaryOp::Pow => of(1, 0, 2),
                BinaryOp::Min
                | BinaryOp::Max
                | BinaryOp::Less
                | BinaryOp::LessEqual
                | BinaryOp::Equal
                | BinaryOp::And
                | BinaryOp::Or => of(0, 1, 0),
            },
        }
    }
}
