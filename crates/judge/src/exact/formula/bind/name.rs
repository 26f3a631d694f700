//! Resolves names in a formula, and suggests corrections for unknown names.

use super::{Frame, ProgramBuilder};
use crate::exact::formula::ast::Node;
use crate::exact::formula::builtin;
use crate::exact::formula::lexer::FormulaError;
use crate::exact::formula::program::Operand;
use mpm_subject::{by_nearness, nearest};

/// Maximum number of constants that a message lists.
const LISTED: usize = 8;

impl<'a> ProgramBuilder<'a> {
    pub(super) fn name(
        &mut self,
        frame: &Frame<'a>,
        node: &'a Node,
        name: &str,
        at: usize,
    ) -> Result<Operand, FormulaError> {
        if let Some(operand) = frame.local(name) {
            return Ok(operand);
        }
        if let Some(value) = self.scope.value(name) {
            self.uses.insert(name.to_owned());
            return Ok(Operand::Constant(value));
        }
        if let Some((_, operand)) = self.free.filter(|(free, _)| *free == name) {
            return Ok(operand);
        }
        if let Some((name, body)) = self.scope.defined(name) {
            return self.inline(name, body, Vec::new(), at);
        }
        if let Some(table) = self.scope.tabulated(name) {
            return self.table(frame, node, table.0, table.1, at);
        }
        let span = node.span.clone();
        if self.scope.called(name).is_some() {
            let message = format!("the function `{name}` is not called");
            return Err(FormulaError::new(span, message)
                .help(format!("write its arguments in parentheses: `{name}(...)`")));
        }
        let help = elsewhere(name).unwrap_or_else(|| self.instead(frame, name));
        Err(FormulaError::unknown(span, name).help(help))
    }

    pub(super) fn not_a_function(&self, frame: &Frame, node: &Node, name: &str) -> FormulaError {
        let local = frame.local(name).is_some();
        let role = match frame.function {
            _ if self.scope.value(name).is_some() => "a constant",
            _ if self.scope.tabulated(name).is_some() => "a table",
            Some(_) if local => "a parameter",
            None if local => "a variable",
            _ => {
                let error =
                    FormulaError::new(node.head(name), format!("unknown function `{name}`"));
                let callable = self.scope.functions().chain(builtin::names());
                return match elsewhere(name).or_else(|| meant(name, callable)) {
                    Some(help) => error.help(help),
                    None => error,
                };
            }
        };
        FormulaError::new(node.head(name), format!("`{name}` is {role}, not a function"))
            .help(format!("write `{name}*(...)` to multiply"))
    }

    /// Returns suggestions for `name`: the closest known name, or all variables and constants.
    fn instead(&self, frame: &Frame, name: &str) -> String {
        let known = frame.locals.iter().map(|(local, _)| *local);
        match (meant(name, known.chain(self.declared())), self.constants(name)) {
            (Some(near), Some(constants)) => format!("{near} {constants}"),
            (Some(near), None) => near,
            (None, Some(constants)) => format!("{}; {constants}", frame.listing()),
            (None, None) => frame.listing(),
        }
    }

    fn constants(&self, name: &str) -> Option<String> {
        let sorted = by_nearness(name, self.scope.constants().map(|(known, _)| known));
        let listed: Vec<String> =
            sorted.iter().take(LISTED).map(|known| format!("`{known}`")).collect();
        let more = sorted.len().saturating_sub(LISTED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        (!listed.is_empty()).then(|| format!("declared: {}{more}", listed.join(", ")))
    }

    /// Returns all names that are valid in every formula and function.
    fn declared(&self) -> impl Iterator<Item = &str> {
        let constants = self.scope.constants().map(|(name, _)| name);
        let declared = constants.chain(self.scope.tables()).chain(self.scope.functions());
        declared.chain(builtin::names())
    }
}

impl Frame<'_> {
    pub(super) fn local(&self, name: &str) -> Option<Operand> {
        let local = self.locals.iter().find(|(local, _)| *local == name);
        local.map(|(_, operand)| *operand)
    }

    pub(super) fn listing(&self) -> String {
        let names: Vec<String> =
            self.locals.iter().map(|(local, _)| format!("`{local}`")).collect();
        match (self.function, names.is_empty()) {
            (None, false) => format!("the variables are {}", names.join(", ")),
            (None, true) => "there are no variables here".to_owned(),
            (Some(name), false) => format!("the parameters of `{name}` are {}", names.join(", ")),
            (Some(name), true) => format!("`{name}` has no parameters"),
        }
    }
}

/// Names from programming languages, each with its equivalent in the formula language.
const ELSEWHERE: &[(&str, &str)] = &[
    ("e", "there is no constant `e`: write `exp(1)`"),
    ("log", "the natural logarithm is `ln`"),
    ("pow", "a power is written `a^b`"),
    ("heaviside", "the unit step is `step`"),
];

pub(in crate::exact::formula) fn elsewhere(name: &str) -> Option<String> {
    let known = ELSEWHERE.iter().find(|(foreign, _)| *foreign == name);
    known.map(|(_, help)| (*help).to_owned())
}

/// Returns the text "did you mean" with the closest candidate, if any is similar.
pub(in crate::exact::formula) fn meant<'a>(
    name: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<String> {
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}
