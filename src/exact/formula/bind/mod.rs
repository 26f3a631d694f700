//! Syntax tree to program: resolves names, puts functions in place, folds constants.
//!
//! Registers are handed out like a stack. Compiling a node at the register `at` writes to `at` and
//! above, never below, and returns where the value is: there, in a variable, in a register below
//! that holds an argument or an index, or nowhere because it is a constant.

mod call;
mod name;
mod sum;
mod table;

use std::collections::BTreeSet;

use super::ast::{Expr, Node, NodeKind};
use super::binary::Binary;
use super::error::FormulaError;
use super::number::whole;
use super::program::{Action, Instruction, Operand, run};
use super::scope::Scope;

/// Most nodes of a formula, with those of the functions it calls.
const MAX_NODES: usize = 100_000;
/// Deepest nesting of a formula, with that of the functions it calls.
const MAX_DEPTH: usize = 256;
/// Most operations of one evaluation, with every term of every sum.
const MAX_OPERATIONS: u64 = 10_000_000;

/// The formula or function body that is being compiled, and the values of its local names.
struct Frame<'a> {
    expr: &'a Expr,
    function: Option<&'a str>,
    /// Variables of the formula, or parameters of the function.
    locals: Vec<(&'a str, Operand)>,
    /// Indices of the enclosing sums, the outermost first.
    indices: Vec<Operand>,
}

/// A program under construction.
pub(super) struct ProgramBuilder<'a> {
    scope: &'a Scope,
    pub(super) code: Vec<Instruction>,
    pub(super) registers: usize,
    pub(super) uses: BTreeSet<String>,
    /// Functions whose bodies are being compiled, the innermost last.
    calls: Vec<&'a str>,
    depth: usize,
    nodes: usize,
    /// How often the code under construction runs in one evaluation.
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
            depth: 0,
            nodes: 0,
            runs: 1,
            operations: 0,
        }
    }

    /// Compiles a whole formula of `variables`.
    pub(super) fn formula(
        &mut self,
        expr: &'a Expr,
        variables: &[&'a str],
    ) -> Result<Operand, FormulaError> {
        let variable = |(index, name): (usize, &&'a str)| (*name, Operand::Variable(index));
        let locals = variables.iter().enumerate().map(variable).collect();
        let mut frame = Frame { expr, function: None, locals, indices: Vec::new() };
        self.compile(&mut frame, expr.root(), 0)
    }

    /// Compiles a node and those below it. A chain of left operands, as long as the source permits,
    /// is walked in a loop; only what the parser nests is walked by recursion.
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

    /// Compiles a node that is not a binary operation.
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

    /// Counts a node against the limits.
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

    /// Appends an instruction with the result in the register `to`, or evaluates it at once.
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
}

/// The first register at or above `at` that does not hold `operand`.
fn above(operand: Operand, at: usize) -> usize {
    match operand {
        Operand::Register(register) if register >= at => register + 1,
        _ => at,
    }
}

/// A binary operation; powers to a whole constant are multiplied out.
fn binary(function: Binary, left: Operand, right: Operand) -> Action {
    match (function, right) {
        (Binary::Power, Operand::Constant(exponent)) => match whole(exponent) {
            Some(exponent) => Action::Powi(left, exponent),
            None => Action::Binary(function, left, right),
        },
        _ => Action::Binary(function, left, right),
    }
}
