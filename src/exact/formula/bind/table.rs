//! Tables, whose name stands for an expression of one variable or constant.

use super::{Frame, ProgramBuilder, above};
use crate::exact::formula::ast::Node;
use crate::exact::formula::error::FormulaError;
use crate::exact::formula::program::Operand;
use crate::exact::formula::scope::Tabulated;

impl<'a> ProgramBuilder<'a> {
    /// Compiles the expression of a table, with what it is read by.
    pub(super) fn table(
        &mut self,
        frame: &Frame<'a>,
        node: &'a Node,
        (name, table): (&'a str, &'a Tabulated),
        at: usize,
    ) -> Result<Operand, FormulaError> {
        let by = table.by.as_str();
        let local = frame.locals.iter().find(|(local, _)| *local == by);
        let constant = self.scope.value(by).map(Operand::Constant);
        let Some(operand) = local.map(|(_, operand)| *operand).or(constant) else {
            let message = format!("`{name}` is a table by `{by}`, which is not known here");
            return Err(FormulaError::new(node.span.clone(), message).help(frame.listing()));
        };
        self.uses.insert(name.to_owned());
        let (expr, locals) = (&table.body, vec![(by, operand)]);
        let mut inner = Frame { expr, function: Some(name), locals, indices: Vec::new() };
        let result = self.compile(&mut inner, expr.root(), above(operand, at));
        result.map_err(|error| error.within(name))
    }
}
