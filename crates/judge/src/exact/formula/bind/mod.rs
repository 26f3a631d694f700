//! Compiles a syntax tree to a program: resolves names, inlines functions, folds constants.
//!
//! Compiling a node at register `at` writes only to registers `at` and above. The result is the
//! location of the value: a constant, a variable or a register.
//!
//! User functions are inlined, and sums become loops.

mod name;

use super::ast::{Expr, Node, NodeKind, Sum};
use super::builtin;
use super::builtin::Binary;
use super::lexer::FormulaError;
use super::number::whole;
use super::program::{Action, Instruction, Loop, Operand, run};
use super::scope::{Scope, Tabulated};
use std::collections::BTreeSet;

const MAX_NODES: usize = 100_000;
const MAX_DEPTH: usize = 256;
/// Maximum number of operations of one evaluation, including every term of every sum.
const MAX_OPERATIONS: u64 = 10_000_000;
const MAX_TERMS: f64 = 100_000.0;

/// The formula or function body being compiled, and the values of its local names.
struct Frame<'a> {
    expr: &'a Expr,
    function: Option<&'a str>,
    /// Variables of the formula, or parameters of the function.
    locals: Vec<(&'a str, Operand)>,
    /// Indices of the enclosing sums, starting with the outermost.
    indices: Vec<Operand>,
}

pub(super) struct ProgramBuilder<'a> {
    scope: &'a Scope,
    pub(super) code: Vec<Instruction>,
    pub(super) registers: usize,
    pub(super) uses: BTreeSet<String>,
    /// Functions whose bodies are being compiled; the innermost is last.
    calls: Vec<&'a str>,
    /// Variable that functions and definitions may also use, if the scope declares one.
    free: Option<(&'a str, Operand)>,
    depth: usize,
    nodes: usize,
    /// Number of times the code under construction runs per evaluation.
    runs: u64,
    pub(super) operations: u64,
}

impl<'a> ProgramBuilder<'a> {
    pub(super) fn new(scope: &'a Scope) -> Self {
        Self {
            scope,
            code: Vec::new(),
            registers: 0,
            uses: BTreeSet::new(),
            calls: Vec::new(),
            free: None,
            depth: 0,
            nodes: 0,
            runs: 1,
            operations: 0,
        }
    }

    pub(super) fn formula(
        &mut self,
        expr: &'a Expr,
        variables: &[&'a str],
    ) -> Result<Operand, FormulaError> {
        let variable = |(index, name): (usize, &&'a str)| (*name, Operand::Variable(index));
        let locals: Vec<_> = variables.iter().enumerate().map(variable).collect();
        self.free = locals.iter().copied().find(|(name, _)| self.scope.is_free(name));
        let mut frame = Frame { expr, function: None, locals, indices: Vec::new() };
        self.compile(&mut frame, expr.root(), 0)
    }

    /// Compiles a node and its children. A loop compiles chains of left operands, which may be as
    /// long as the source; for other operands the parser limits the depth of the recursion.
    fn compile(
        &mut self,
        frame: &mut Frame<'a>,
        root: usize,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let expr = frame.expr;
        self.depth += 1;
        let mut pending = Vec::new();
        let mut node = root;
        while let NodeKind::Binary(function, left, right) = expr.node(node).kind {
            self.count(expr.node(node))?;
            pending.push((function, right));
            node = left;
        }
        let mut left = self.leaf(frame, expr.node(node), at)?;
        while let Some((function, right)) = pending.pop() {
            let right = self.compile(frame, right, above(left, at))?;
            left = self.emit(binary(function, left, right), at);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn leaf(
        &mut self,
        frame: &mut Frame<'a>,
        node: &'a Node,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        self.count(node)?;
        match &node.kind {
            NodeKind::Number(value) => Ok(Operand::Constant(*value)),
            NodeKind::Index(level) => Ok(frame.indices[*level]),
            NodeKind::Name(name) => self.name(frame, node, name, at),
            NodeKind::Negate(a) => {
                let a = self.compile(frame, *a, at)?;
                Ok(self.emit(Action::Negate(a), at))
            }
            NodeKind::Unary(function, a) => {
                let a = self.compile(frame, *a, at)?;
                Ok(self.emit(Action::Unary(*function, a), at))
            }
            NodeKind::Call(name, arguments) => self.call(frame, node, name, arguments, at),
            NodeKind::Sum(sum) => self.sum(frame, sum, at),
            NodeKind::Binary(..) => unreachable!("`compile` walks binary operations itself"),
        }
    }

    fn count(&mut self, node: &Node) -> Result<(), FormulaError> {
        self.nodes += 1;
        self.operations = self.operations.saturating_add(self.runs);
        let excess = if self.nodes > MAX_NODES {
            format!("the formula and its functions have more than {MAX_NODES} nodes")
        } else if self.depth > MAX_DEPTH {
            format!("the formula and its functions are nested more than {MAX_DEPTH} levels deep")
        } else if self.operations > MAX_OPERATIONS {
            format!("the sums take more than {MAX_OPERATIONS} operations")
        } else {
            return Ok(());
        };
        Err(FormulaError::new(node.span.clone(), excess))
    }

    /// Appends an instruction with its result in register `to`, or evaluates it if all is constant.
    fn emit(&mut self, action: Action, to: usize) -> Operand {
        if action.arguments().all(|operand| matches!(operand, Operand::Constant(_))) {
            let mut result = [0.0];
            run::<f64>(&[Instruction { action, to: 0 }], 0, &[], &mut result);
            return Operand::Constant(result[0]);
        }
        self.append(action, to);
        Operand::Register(to)
    }

    fn append(&mut self, action: Action, to: usize) {
        self.code.push(Instruction { action, to });
        self.registers = self.registers.max(to + 1);
    }

    fn call(
        &mut self,
        frame: &mut Frame<'a>,
        node: &'a Node,
        name: &str,
        arguments: &[usize],
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let Some((name, function)) = self.scope.called(name) else {
            return Err(self.not_a_function(frame, node, name));
        };
        if arguments.len() != function.parameters.len() {
            let needed = builtin::arguments(function.parameters.len());
            let message = format!("`{name}` takes {needed}, not {}", arguments.len());
            return Err(FormulaError::new(node.span.clone(), message));
        }
        self.refuse_cycle(node, name)?;
        let mut at = at;
        let mut locals = Vec::new();
        for (parameter, argument) in function.parameters.iter().zip(arguments) {
            let operand = self.compile(frame, *argument, at)?;
            at = above(operand, at);
            locals.push((parameter.as_str(), operand));
        }
        self.calls.push(name);
        let result = self.inline(name, &function.body, locals, at);
        self.calls.pop();
        result
    }

    fn inline(
        &mut self,
        name: &'a str,
        expr: &'a Expr,
        locals: Vec<(&'a str, Operand)>,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        self.uses.insert(name.to_owned());
        let mut frame = Frame { expr, function: Some(name), locals, indices: Vec::new() };
        let result = self.compile(&mut frame, expr.root(), at);
        result.map_err(|error| error.within(name))
    }

    fn refuse_cycle(&self, node: &Node, name: &str) -> Result<(), FormulaError> {
        let Some(first) = self.calls.iter().position(|open| *open == name) else {
            return Ok(());
        };
        let cycle: Vec<String> =
            self.calls[first..].iter().chain([&name]).map(|name| format!("`{name}`")).collect();
        let message = format!("functions may not be recursive: {}", cycle.join(" calls "));
        Err(FormulaError::new(node.head(name), message))
    }

    fn table(
        &mut self,
        frame: &Frame<'a>,
        node: &'a Node,
        name: &'a str,
        table: &'a Tabulated,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let by = table.by.as_str();
        let constant = self.scope.value(by).map(Operand::Constant);
        let Some(operand) = frame.local(by).or(constant) else {
            let message = format!("`{name}` is a table by `{by}`, which is not defined here");
            return Err(FormulaError::new(node.span.clone(), message).help(frame.listing()));
        };
        self.inline(name, &table.body, vec![(by, operand)], above(operand, at))
    }

    /// Compiles a sum to a loop. The total is in register `at`, the index in the next register.
    fn sum(
        &mut self,
        frame: &mut Frame<'a>,
        sum: &'a Sum,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let span = sum.index_span.clone();
        if frame.local(&sum.index).is_some() {
            let role = if frame.function.is_some() { "a parameter" } else { "a variable" };
            return Err(FormulaError::new(span, format!("`{}` is already {role}", sum.index)));
        }
        self.scope.fresh(&sum.index, span)?;
        let from = self.bound(frame, sum.from, at)?;
        let last = self.bound(frame, sum.to, at)?;
        let terms = last - from + 1.0;
        if terms > MAX_TERMS {
            let span = frame.expr.node(sum.from).span.start..frame.expr.node(sum.to).span.end;
            let message = format!("the sum has {terms} terms, more than {MAX_TERMS}");
            return Err(FormulaError::new(span, message));
        }
        let start = self.code.len();
        self.append(Action::Copy(Operand::Constant(0.0)), at);
        self.append(Action::Copy(Operand::Constant(from)), at + 1);
        let body = self.code.len();
        let term = self.term(frame, sum, at + 1, terms)?;
        self.append(Action::Next(Loop { term, last, body }), at);
        Ok(self.settle(start, at, terms))
    }

    fn term(
        &mut self,
        frame: &mut Frame<'a>,
        sum: &'a Sum,
        index: usize,
        terms: f64,
    ) -> Result<Operand, FormulaError> {
        let runs = self.runs;
        self.runs = runs.saturating_mul(terms.max(1.0) as u64);
        frame.indices.push(Operand::Register(index));
        let term = self.compile(frame, sum.body, index + 1)?;
        frame.indices.pop();
        self.runs = runs;
        Ok(term)
    }

    /// Returns the value of a sum bound. The bound must be a constant integer.
    fn bound(
        &mut self,
        frame: &mut Frame<'a>,
        node: usize,
        at: usize,
    ) -> Result<f64, FormulaError> {
        let message = match self.compile(frame, node, at)? {
            Operand::Constant(value) if whole(value).is_some() => return Ok(value),
            Operand::Constant(value) => {
                format!("a bound of a sum must be a whole number, not {value}")
            }
            _ => "a bound of a sum may not depend on a variable or an index".to_owned(),
        };
        Err(FormulaError::new(frame.expr.node(node).span.clone(), message))
    }

    /// Replaces the loop from `start` by its value if it has no terms or depends on constants only.
    fn settle(&mut self, start: usize, at: usize, terms: f64) -> Operand {
        let own = |operand| match operand {
            Operand::Constant(_) => true,
            Operand::Variable(_) => false,
            Operand::Register(register) => register >= at,
        };
        if terms < 1.0 {
            self.code.truncate(start);
            return Operand::Constant(0.0);
        }
        if !self.code[start..].iter().all(|instruction| instruction.action.arguments().all(own)) {
            return Operand::Register(at);
        }
        let mut registers = vec![0.0; self.registers];
        run::<f64>(&self.code, start, &[], &mut registers);
        self.code.truncate(start);
        Operand::Constant(registers[at])
    }
}

/// Returns the first register at or above `at` that does not contain `operand`.
fn above(operand: Operand, at: usize) -> usize {
    match operand {
        Operand::Register(register) if register >= at => register + 1,
        _ => at,
    }
}

/// Creates a binary operation; powers with a constant integer exponent become multiplications.
fn binary(function: Binary, left: Operand, right: Operand) -> Action {
    match (function, right) {
        (Binary::Power, Operand::Constant(exponent)) => match whole(exponent) {
            Some(exponent) => Action::Powi(left, exponent),
            None => Action::Binary(function, left, right),
        },
        _ => Action::Binary(function, left, right),
    }
}
