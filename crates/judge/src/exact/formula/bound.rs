//! Formulas with resolved names.

use std::collections::BTreeSet;

use super::ast::Expr;
use super::bind::ProgramBuilder;
use super::lexer::FormulaError;
use super::number::Number;
use super::program::{Instruction, Operand, read, run};
use super::scope::Scope;

/// Number of stack registers for short formulas, which are cleared faster than [`MANY`].
const FEW: usize = 8;
/// Number of stack registers; formulas with more registers allocate them on the heap.
const MANY: usize = 32;

/// A formula with resolved names, ready for evaluation.
#[derive(Debug, Clone)]
pub struct Formula {
    source: String,
    uses: BTreeSet<String>,
    variables: usize,
    pub(super) code: Vec<Instruction>,
    pub(super) registers: usize,
    operations: u64,
    /// Location of the value after the code has run.
    pub(super) result: Operand,
}

impl Formula {
    /// Resolves the names in `expr`: first as one of the `variables`, then in `scope`.
    ///
    /// # Errors
    /// When a name is unknown, duplicate or misused, when functions form a cycle, when the bounds
    /// of a sum are not constant integers, or when a limit is exceeded.
    pub fn bind(expr: &Expr, scope: &Scope, variables: &[&str]) -> Result<Self, FormulaError> {
        for (position, variable) in variables.iter().enumerate() {
            scope.fresh(variable, 0..variable.len())?;
            if variables[..position].contains(variable) {
                let message = format!("`{variable}` is already a variable");
                return Err(FormulaError::new(0..variable.len(), message));
            }
        }
        let mut builder = ProgramBuilder::new(scope);
        let result = builder.formula(expr, variables)?;
        Ok(Self {
            source: expr.source().to_owned(),
            uses: builder.uses,
            variables: variables.len(),
            code: builder.code,
            registers: builder.registers,
            operations: builder.operations,
            result,
        })
    }

    /// Evaluates the formula at `variables`, in the order of [`Formula::bind`].
    ///
    /// # Panics
    /// If the number of variables differs from the number in [`Formula::bind`].
    // Not inlined, so that other packages link to the code compiled here.
    #[inline(never)]
    pub fn eval<T: Number>(&self, variables: &[T]) -> T {
        assert_eq!(variables.len(), self.variables, "variables of `{}`", self.source);
        let zero = T::from(0.0);
        if self.registers <= FEW {
            self.run(variables, &mut [zero; FEW])
        } else if self.registers <= MANY {
            self.run(variables, &mut [zero; MANY])
        } else {
            self.run(variables, &mut vec![zero; self.registers])
        }
    }

    /// Returns the number of operations per evaluation. Operations in sums count once per term.
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// Returns the text of the formula.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns the names of the scope that the formula uses, directly or through functions.
    pub fn uses(&self) -> &BTreeSet<String> {
        &self.uses
    }

    /// Returns the value if the formula is constant.
    pub fn constant(&self) -> Option<f64> {
        match self.result {
            Operand::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Returns the number of variables to which the formula is bound.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Whether the value depends on the variable with this index.
    pub fn reads(&self, variable: usize) -> bool {
        let variable = Operand::Variable(variable);
        let mut arguments = self.code.iter().flat_map(|step| step.action.arguments());
        self.result == variable || arguments.any(|argument| argument == variable)
    }

    fn run<T: Number>(&self, variables: &[T], registers: &mut [T]) -> T {
        run(&self.code, 0, variables, registers);
        read(self.result, variables, registers)
    }
}
