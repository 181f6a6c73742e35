//! What functions of integers take, from their text in WGSL, by the operation model of formulas.

use naga::{
    BinaryOperator, Expression, Function, Handle, Literal, MathFunction, Module, Span, Statement, TypeInner,
};

use crate::hypothesis::parse;
use crate::tape::{BinaryOp, Node, Op, Tape, UnaryOp};
use crate::{Place, ShadeError};

/// What a function takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MaskCost {
    /// Operations of numbers as [`Tape::cost_ops`] has them; of integers a sum, a product, a logical
    /// operation, a shift, a count of bits, a comparison and a conversion one each.
    pub ops: u32,
    /// Reads of a table.
    pub fetches: u32,
    /// Bytes of its numbers.
    pub bytes: u64,
}

/// What a function of a source takes.
///
/// # Errors
/// A source that is not WGSL, a function that it has not, an operation that has no count here.
pub(super) fn counted(source: &str, function: &str) -> Result<MaskCost, ShadeError> {
    let module = parse(function, source)?;
    let found = module.functions.iter().find(|(_, one)| one.name.as_deref() == Some(function));
    let refuse = |span: Span, message: &str| {
        let range = span.to_range().unwrap_or_default();
        let place = Place::of(function, source, range.start, range.end);
        ShadeError::Dialect { place: Box::new(place), message: message.into() }
    };
    let (_, found) = found.ok_or_else(|| refuse(Span::default(), "no such function"))?;
    let mut counter = Counter {
        module: &module,
        function: found,
        values: vec![None; found.expressions.len()],
        locals: vec![Vec::new(); found.local_variables.len()],
        ops: Vec::new(),
        cost: MaskCost::default(),
    };
    counter.body().map_err(|(span, message)| refuse(span, message))?;
    Ok(MaskCost { ops: Tape::of_ops(counter.ops, 0).cost_ops(), ..counter.cost })
}

/// Where something has no count, and what it is.
type Uncounted = (Span, &'static str);

/// Operations of a function as those of a tape that cost as much. The tape is counted and never
/// evaluated: an operation of integers stands in it as one of numbers or of truth values.
struct Counter<'a> {
    module: &'a Module,
    function: &'a Function,
    /// Components of the expressions that were evaluated.
    values: Vec<Option<Vec<Node>>>,
    /// Components of the variables.
    locals: Vec<Vec<Node>>,
    ops: Vec<Op>,
    cost: MaskCost,
}

impl Counter<'_> {
    fn push(&mut self, op: Op) -> Node {
        let known = self.ops.iter().position(|other| *other == op);
        let node = known.unwrap_or_else(|| {
            self.ops.push(op);
            self.ops.len() - 1
        });
        node as Node
    }

    fn body(&mut self) -> Result<(), Uncounted> {
        let function = self.function;
        for (handle, local) in function.local_variables.iter() {
            if let Some(init) = local.init {
                self.locals[handle.index()] = self.value(init)?;
            }
        }
        for (statement, span) in function.body.span_iter() {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        self.value(handle)?;
                    }
                }
                Statement::Store { pointer, value } => match function.expressions[*pointer] {
                    Expression::LocalVariable(local) => self.locals[local.index()] = self.value(*value)?,
                    _ => return Err((*span, "a store that is to no variable is not counted")),
                },
                Statement::Return { .. } => {}
                _ => return Err((*span, "this statement is not counted")),
            }
        }
        Ok(())
    }

    /// The components of an expression, counted the first time.
    fn value(&mut self, handle: Handle<Expression>) -> Result<Vec<Node>, Uncounted> {
        if let Some(known) = &self.values[handle.index()] {
            return Ok(known.clone());
        }
        let value = self.fresh(handle)?;
        self.values[handle.index()] = Some(value.clone());
        Ok(value)
    }

    fn fresh(&mut self, handle: Handle<Expression>) -> Result<Vec<Node>, Uncounted> {
        let (function, module) = (self.function, self.module);
        let uncounted = |what| Err((function.expressions.get_span(handle), what));
        match &function.expressions[handle] {
            Expression::Literal(literal) => match *literal {
                Literal::U32(x) => Ok(vec![self.push(Op::Literal(x as f32))]),
                Literal::F32(x) => Ok(vec![self.push(Op::Literal(x))]),
                _ => uncounted("this literal is not counted"),
            },
            Expression::FunctionArgument(index) => Ok(vec![self.push(Op::Input(*index as u16))]),
            Expression::Splat { size, value } => Ok(vec![self.value(*value)?[0]; *size as usize]),
            Expression::Compose { components, .. } => {
                let parts: Result<Vec<_>, _> = components.iter().map(|part| self.value(*part)).collect();
                Ok(parts?.concat())
            }
            Expression::AccessIndex { base, index } => match function.expressions[*base] {
                // A component of a variable: read by the load that follows.
                Expression::LocalVariable(local) => Ok(vec![self.locals[local.index()][*index as usize]]),
                _ => Ok(vec![self.value(*base)?[*index as usize]]),
            },
            Expression::Load { pointer } => match function.expressions[*pointer] {
                Expression::LocalVariable(local) => Ok(self.locals[local.index()].clone()),
                _ => self.value(*pointer),
            },
            Expression::LocalVariable(local) => Ok(self.locals[local.index()].clone()),
            Expression::Access { base, index } => match function.expressions[*base] {
                Expression::Constant(table) => {
                    self.value(*index)?;
                    let (components, bytes) =
                        table_size(module, &module.types[module.constants[table].ty].inner);
                    self.cost = MaskCost { fetches: self.cost.fetches + 1, bytes, ..self.cost };
                    let first = 1 + function.arguments.len() as u16;
                    Ok((first..first + components).map(|k| self.push(Op::Input(k))).collect())
                }
                _ => uncounted("an index into what is no constant table is not counted"),
            },
            Expression::Binary { op, left, right } => {
                let Some(op) = binary(*op) else { return uncounted("this operator is not counted") };
                let operands = [self.value(*left)?, self.value(*right)?];
                Ok(self.each(&operands, |x| Op::Binary(op, x[0], x[1])))
            }
            Expression::Select { condition, accept, reject } => {
                let operands = [self.value(*condition)?, self.value(*accept)?, self.value(*reject)?];
                Ok(self.each(&operands, |x| Op::Select(x[0], x[1], x[2])))
            }
            Expression::Math { fun: MathFunction::CountOneBits, arg, .. } => {
                let operand = [self.value(*arg)?];
                Ok(self.each(&operand, |x| Op::Unary(UnaryOp::Floor, x[0])))
            }
            Expression::As { expr, .. } => {
                let operand = [self.value(*expr)?];
                Ok(self.each(&operand, |x| Op::Binary(BinaryOp::Max, x[0], x[0])))
            }
            _ => uncounted("this expression is not counted"),
        }
    }

    /// An operation of each component; a single number goes with all.
    fn each<const N: usize>(&mut self, operands: &[Vec<Node>; N], op: impl Fn([Node; N]) -> Op) -> Vec<Node> {
        let most = operands.iter().map(Vec::len).max().unwrap_or_default();
        let at = |i: usize| std::array::from_fn(|k| operands[k][i.min(operands[k].len() - 1)]);
        (0..most).map(|i| self.push(op(at(i)))).collect()
    }
}

/// What stands for an operator: a shift is no comparison, and costs as much.
fn binary(op: BinaryOperator) -> Option<BinaryOp> {
    Some(match op {
        BinaryOperator::Add => BinaryOp::Add,
        BinaryOperator::Multiply => BinaryOp::Multiply,
        BinaryOperator::Divide => BinaryOp::Divide,
        BinaryOperator::And => BinaryOp::And,
        BinaryOperator::InclusiveOr => BinaryOp::Or,
        BinaryOperator::ShiftRight => BinaryOp::Less,
        BinaryOperator::ShiftLeft => BinaryOp::LessEqual,
        BinaryOperator::NotEqual => BinaryOp::Equal,
        _ => return None,
    })
}

/// Components of an element of a table, and bytes of all.
fn table_size(module: &Module, table: &TypeInner) -> (u16, u64) {
    match table {
        TypeInner::Array { base, size: naga::ArraySize::Constant(n), .. } => {
            let (components, bytes) = table_size(module, &module.types[*base].inner);
            (components, bytes * u64::from(n.get()))
        }
        TypeInner::Vector { size, scalar } => (*size as u16, *size as u64 * u64::from(scalar.width)),
        _ => (1, 4),
    }
}
