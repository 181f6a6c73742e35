//! Statements of a shader function, walked symbolically: calls inlined, loops unrolled, both sides
//! of a branch taken and merged.

use naga::{Block, Expression, Function, Handle, Module, Span, Statement, SwitchValue};

use super::source::Source;
use super::value::{Maker, Pointer, Value};
use crate::foreign::{ForeignError, limits};
use lobefit_shade::Node;

/// What has happened when a block has run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Flow {
    Next,
    Break,
    Continue,
    Return,
}

/// What a function has returned so far.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Returned {
    Never,
    Always(Value),
    /// Where the first is true, the second.
    Where(Node, Value),
}

/// A function at work.
pub(super) struct Frame<'a> {
    pub function: &'a Function,
    pub arguments: Vec<Value>,
    /// Slots of its variables, by index.
    pub locals: Vec<usize>,
    /// Values of its expressions, by index.
    pub values: Vec<Option<Value>>,
    returned: Returned,
    /// The first slot of its own.
    base: usize,
}

/// The walk of a module's functions.
pub(super) struct Walk<'a> {
    pub module: &'a Module,
    pub source: &'a Source,
    pub maker: Maker,
    /// Variables of the functions at work, callers first.
    pub memory: Vec<Value>,
    /// Slots of global variables, by index.
    pub globals: Vec<Option<usize>>,
    /// The last place that was known: front ends do not tell that of every expression.
    here: Span,
    /// Slots below this belong to callers of a function that may have returned already: they are
    /// not written.
    guard: usize,
    steps: usize,
    depth: usize,
}

impl<'a> Walk<'a> {
    pub fn new(module: &'a Module, source: &'a Source) -> Walk<'a> {
        Walk {
            module,
            source,
            maker: Maker::default(),
            memory: Vec::new(),
            globals: vec![None; module.global_variables.len()],
            here: Span::default(),
            guard: 0,
            steps: 0,
            depth: 0,
        }
    }

    /// The value of a call; an empty list where the function returns nothing.
    pub fn call(&mut self, handle: Handle<Function>, arguments: Vec<Value>) -> Result<Value, ForeignError> {
        let function = &self.module.functions[handle];
        let span = self.module.functions.get_span(handle);
        let span = self.known(span);
        self.depth += 1;
        if self.depth > limits::DEPTH {
            return Err(self.source.too_large("calls inside one another", self.depth, limits::DEPTH));
        }
        let mut frame = Frame {
            function,
            arguments,
            locals: Vec::new(),
            values: vec![None; function.expressions.len()],
            returned: Returned::Never,
            base: self.memory.len(),
        };
        for (handle, local) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            let value = match local.init {
                Some(init) => self.value(&mut frame, init)?,
                None => self.unwritten(local.ty, span)?,
            };
            frame.locals.push(self.memory.len());
            self.memory.push(value);
        }
        self.block(&mut frame, &function.body)?;
        self.memory.truncate(frame.base);
        self.depth -= 1;
        match frame.returned {
            Returned::Always(value) => Ok(value),
            _ if function.result.is_none() => Ok(Value::List(Vec::new())),
            _ => Err(self.source.unsupported(
                span,
                "a path that returns nothing",
                "let every path return a value",
            )),
        }
    }

    fn block(&mut self, frame: &mut Frame<'a>, block: &Block) -> Result<Flow, ForeignError> {
        for (statement, span) in block.span_iter() {
            let flow = self.statement(frame, statement, *span)?;
            if flow != Flow::Next {
                return Ok(flow);
            }
        }
        Ok(Flow::Next)
    }

    /// The span, or the last one before it that tells a place.
    pub fn known(&mut self, span: Span) -> Span {
        if span.is_defined() {
            self.here = span;
        }
        self.here
    }

    /// Counts a step and refuses too many.
    pub fn step(&mut self) -> Result<(), ForeignError> {
        self.steps += 1;
        if self.steps > limits::STEPS {
            return Err(self.source.too_large("steps, loops unrolled", self.steps, limits::STEPS));
        }
        if self.maker.tape.len() > limits::OPERATIONS {
            let found = self.maker.tape.len();
            return Err(self.source.too_large(
                "operations, calls and loops expanded",
                found,
                limits::OPERATIONS,
            ));
        }
        Ok(())
    }

    fn statement(
        &mut self,
        frame: &mut Frame<'a>,
        statement: &Statement,
        span: Span,
    ) -> Result<Flow, ForeignError> {
        self.step()?;
        let span = self.known(span);
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.expression(frame, handle)?;
                    frame.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(block) => return self.block(frame, block),
            Statement::If { condition, accept, reject } => {
                let condition = self.truth(frame, *condition)?;
                return self.branch(frame, condition, accept, reject, span);
            }
            Statement::Switch { selector, cases } => {
                let Value::Integer(found) = self.value(frame, *selector)? else {
                    return Err(self.source.unsupported(
                        span,
                        "a switch that depends on the inputs",
                        "use if",
                    ));
                };
                let is = |value: SwitchValue| match value {
                    SwitchValue::I32(x) => i64::from(x) == found,
                    SwitchValue::U32(x) => i64::from(x) == found,
                    SwitchValue::Default => false,
                };
                let case = cases.iter().position(|c| is(c.value));
                let case = case.or_else(|| cases.iter().position(|c| c.value == SwitchValue::Default));
                for case in cases.iter().skip(case.unwrap_or(cases.len())) {
                    match self.block(frame, &case.body)? {
                        Flow::Next if case.fall_through => {}
                        Flow::Next | Flow::Break => break,
                        other => return Ok(other),
                    }
                }
            }
            Statement::Loop { body, continuing, break_if } => {
                return self.repeat(frame, body, continuing, *break_if, span);
            }
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                let value = match value {
                    Some(value) => self.value(frame, *value)?,
                    None => Value::List(Vec::new()),
                };
                let before = std::mem::replace(&mut frame.returned, Returned::Never);
                frame.returned = self.then(before, value);
                return Ok(Flow::Return);
            }
            Statement::Store { pointer, value } => {
                let value = self.value(frame, *value)?;
                self.store(frame, *pointer, value, span)?;
            }
            Statement::Call { function, arguments, result } => {
                let values: Result<Vec<Value>, ForeignError> =
                    arguments.iter().map(|&a| self.value(frame, a)).collect();
                let guarded = self.guarded(frame);
                let guard = std::mem::replace(&mut self.guard, guarded);
                let value = self.call(*function, values?)?;
                self.guard = guard;
                if let Some(result) = result {
                    frame.values[result.index()] = Some(value);
                }
            }
            _ => return Err(self.source.unsupported(span, "this statement", ONLY)),
        }
        Ok(Flow::Next)
    }

    fn store(
        &mut self,
        frame: &mut Frame<'a>,
        pointer: Handle<Expression>,
        value: Value,
        span: Span,
    ) -> Result<(), ForeignError> {
        let Value::Pointer(pointer) = self.value(frame, pointer)? else {
            return Err(self.source.unsupported(span, "an assignment to this", ONLY));
        };
        if pointer.slot < self.guarded(frame) {
            return Err(self.early(span));
        }
        match pointer.of(&mut self.memory) {
            Some(place) => *place = value,
            None => {
                return Err(self.source.unsupported(span, "an assignment beyond the end", "check the index"));
            }
        }
        Ok(())
    }

    /// The guard at a statement of a function: its callers' slots, once it has returned on some
    /// path.
    fn guarded(&self, frame: &Frame) -> usize {
        if matches!(frame.returned, Returned::Where(..)) { self.guard.max(frame.base) } else { self.guard }
    }

    fn early(&self, span: Span) -> ForeignError {
        let what = "an early return from a function that writes variables of its caller";
        self.source.unsupported(span, what, "return at the end, or return the values")
    }

    /// Takes the side that is known, or both.
    fn branch(
        &mut self,
        frame: &mut Frame<'a>,
        condition: Node,
        accept: &Block,
        reject: &Block,
        span: Span,
    ) -> Result<Flow, ForeignError> {
        match self.maker.tape.constant(condition) {
            Some(1.0) => return self.block(frame, accept),
            Some(0.0) => return self.block(frame, reject),
            Some(_) => return Err(self.source.unsupported(span, "a condition that is not a number", ONLY)),
            None => {}
        }
        let before = self.memory.clone();
        let guarded = self.guarded(frame);
        let guard = std::mem::replace(&mut self.guard, guarded);
        let returned = std::mem::replace(&mut frame.returned, Returned::Never);
        let first = self.block(frame, accept)?;
        let accepted = std::mem::replace(&mut self.memory, before);
        let first_returned = std::mem::replace(&mut frame.returned, Returned::Never);
        let second = self.block(frame, reject)?;
        let second_returned = std::mem::replace(&mut frame.returned, Returned::Never);
        self.guard = guard;
        if matches!(first, Flow::Break | Flow::Continue) || matches!(second, Flow::Break | Flow::Continue) {
            let advice = "only loops that run a fixed number of times are";
            return Err(self.source.unsupported(span, "a loop's end that depends on the inputs", advice));
        }
        if (first == Flow::Return) != (second == Flow::Return)
            && accepted[..frame.base] != self.memory[..frame.base]
        {
            return Err(self.early(span));
        }
        if second == Flow::Return && first != Flow::Return {
            self.memory = accepted;
        } else if first != Flow::Return || second == Flow::Return {
            for (slot, accepted) in accepted.iter().enumerate() {
                let merged = self.maker.merge(condition, accepted, &self.memory[slot]);
                self.memory[slot] = merged;
            }
        }
        let merged = self.merge_returned(condition, first_returned, second_returned);
        frame.returned = self.chain(returned, merged);
        Ok(if matches!(frame.returned, Returned::Always(_)) { Flow::Return } else { Flow::Next })
    }

    fn repeat(
        &mut self,
        frame: &mut Frame<'a>,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<Flow, ForeignError> {
        loop {
            self.step()?;
            match self.block(frame, body)? {
                Flow::Break => return Ok(Flow::Next),
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            self.block(frame, continuing)?;
            if let Some(condition) = break_if {
                let condition = self.truth(frame, condition)?;
                match self.maker.tape.constant(condition) {
                    Some(1.0) => return Ok(Flow::Next),
                    Some(_) => {}
                    None => {
                        let advice = "only loops that run a fixed number of times are";
                        return Err(self.source.unsupported(
                            span,
                            "a loop's end that depends on the inputs",
                            advice,
                        ));
                    }
                }
            }
        }
    }

    /// What has been returned when, where nothing has yet, a value is.
    fn then(&mut self, before: Returned, value: Value) -> Returned {
        self.chain(before, Returned::Always(value))
    }

    fn chain(&mut self, first: Returned, second: Returned) -> Returned {
        match (first, second) {
            (Returned::Never, other) | (other, Returned::Never) => other,
            (Returned::Always(value), _) => Returned::Always(value),
            (Returned::Where(c, a), Returned::Always(b)) => Returned::Always(self.maker.merge(c, &a, &b)),
            (Returned::Where(c, a), Returned::Where(d, b)) => {
                let either = self.maker.or(c, d);
                Returned::Where(either, self.maker.merge(c, &a, &b))
            }
        }
    }

    fn merge_returned(&mut self, condition: Node, accept: Returned, reject: Returned) -> Returned {
        if let (Returned::Always(a), Returned::Always(b)) = (&accept, &reject) {
            return Returned::Always(self.maker.merge(condition, a, b));
        }
        let rejected = self.maker.not(condition);
        let accept = self.narrowed(condition, accept);
        let reject = self.narrowed(rejected, reject);
        self.chain(accept, reject)
    }

    /// What is returned where a condition holds besides.
    fn narrowed(&mut self, condition: Node, returned: Returned) -> Returned {
        match returned {
            Returned::Never => Returned::Never,
            Returned::Always(value) => Returned::Where(condition, value),
            Returned::Where(c, value) => Returned::Where(self.maker.and(condition, c), value),
        }
    }

    /// A pointer to a variable that is kept in a slot.
    pub fn pointer(slot: usize) -> Value {
        Value::Pointer(Pointer { slot, path: Vec::new() })
    }
}

/// What is read, for messages.
pub(super) const ONLY: &str = "a function may use numbers, vectors, matrices, constant arrays, if, loops that run a fixed number of times, and calls";
