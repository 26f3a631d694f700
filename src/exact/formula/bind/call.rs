//! Calls of user functions, whose bodies are put in place.

use super::{Frame, ProgramBuilder, above};
use crate::exact::formula::ast::Node;
use crate::exact::formula::builtin;
use crate::exact::formula::error::FormulaError;
use crate::exact::formula::program::Operand;

impl<'a> ProgramBuilder<'a> {
    /// Compiles the arguments, each once, and then the body with its parameters standing for them.
    pub(super) fn call(
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
        self.uses.insert(name.to_owned());
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
        let expr = &function.body;
        let mut inner = Frame { expr, function: Some(name), locals, indices: Vec::new() };
        self.calls.push(name);
        let result = self.compile(&mut inner, expr.root(), at);
        self.calls.pop();
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
}
