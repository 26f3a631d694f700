//! Sums, which become loops.

use super::{Frame, ProgramBuilder};
use crate::exact::formula::ast::Sum;
use crate::exact::formula::error::FormulaError;
use crate::exact::formula::number::whole;
use crate::exact::formula::program::{Action, Loop, Operand, run};

/// Most terms of a sum.
const MAX_TERMS: f64 = 100_000.0;

impl<'a> ProgramBuilder<'a> {
    /// Compiles a sum to a loop, whose total is kept at `at` and whose index in the next register.
    pub(super) fn sum(
        &mut self,
        frame: &mut Frame<'a>,
        sum: &'a Sum,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let span = sum.index_span.clone();
        if frame.locals.iter().any(|(local, _)| *local == sum.index) {
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

    /// Compiles the body of a sum, which runs once for each of the `terms`.
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

    /// The value of a bound of a sum.
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

    /// Takes back the loop that begins at `start` if it can be evaluated at once: because there
    /// are no terms, or because it reads nothing but constants and its own registers.
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
