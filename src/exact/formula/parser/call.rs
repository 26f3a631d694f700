//! Terms that begin with a name: constants, variables and calls.

use std::ops::Range;

use super::Parser;
use crate::exact::formula::ast::{NodeKind, Sum};
use crate::exact::formula::builtin;
use crate::exact::formula::builtin::{Builtin, PI};
use crate::exact::formula::error::FormulaError;
use crate::exact::formula::lexer::Token;

const SUM_FORM: &str = "the form is `sum(index, from, to, body)`";

impl<'a> Parser<'a> {
    /// A term that begins with a name: a call if a parenthesis follows, a value otherwise.
    pub(super) fn named(
        &mut self,
        name: &'a str,
        span: Range<usize>,
    ) -> Result<usize, FormulaError> {
        let called = self.peek() == Token::Symbol('(');
        if let Some(level) = self.indices.iter().position(|&index| index == name) {
            let role = "the index of a sum";
            return self.plain(NodeKind::Index(level), called, name, span, role);
        }
        match Builtin::find(name) {
            _ if name == PI => {
                self.plain(NodeKind::Number(std::f64::consts::PI), called, name, span, "a number")
            }
            Some(builtin) if called => {
                self.at += 1;
                self.builtin(builtin, name, span)
            }
            Some(_) => Err(FormulaError::new(span, format!("the function `{name}` is not called"))
                .help(format!("write its arguments in parentheses: `{name}(...)`"))),
            None if called => {
                self.at += 1;
                let arguments = self.arguments()?;
                Ok(self.push(NodeKind::Call(name.to_owned(), arguments), self.since(span.start)))
            }
            None => Ok(self.push(NodeKind::Name(name.to_owned()), span)),
        }
    }

    /// A name that is a value and so cannot be called.
    fn plain(
        &mut self,
        kind: NodeKind,
        called: bool,
        name: &str,
        span: Range<usize>,
        role: &str,
    ) -> Result<usize, FormulaError> {
        if called {
            return Err(FormulaError::new(span, format!("`{name}` is {role}, not a function"))
                .help(format!("write `{name}*(...)` to multiply")));
        }
        Ok(self.push(kind, span))
    }

    fn builtin(
        &mut self,
        builtin: Builtin,
        name: &str,
        span: Range<usize>,
    ) -> Result<usize, FormulaError> {
        let (needed, given) = match builtin {
            Builtin::Sum => return self.sum(span.start),
            Builtin::Unary(function) => match self.arguments()?[..] {
                [x] => return Ok(self.push(NodeKind::Unary(function, x), self.since(span.start))),
                ref other => (1, other.len()),
            },
            Builtin::Binary(function) => match self.arguments()?[..] {
                [a, b] => {
                    return Ok(self.push(NodeKind::Binary(function, a, b), self.since(span.start)));
                }
                ref other => (2, other.len()),
            },
        };
        let message = format!("`{name}` takes {}, not {given}", builtin::arguments(needed));
        Err(FormulaError::new(self.since(span.start), message))
    }

    /// The arguments of a call, up to and including the closing parenthesis.
    fn arguments(&mut self) -> Result<Vec<usize>, FormulaError> {
        let mut arguments = Vec::new();
        if self.peek() == Token::Symbol(')') {
            self.at += 1;
            return Ok(arguments);
        }
        loop {
            arguments.push(self.expression(0)?);
            let token = self.peek();
            if !matches!(token, Token::Symbol(',' | ')')) {
                return Err(self.missing_operator("`,` or `)`"));
            }
            self.at += 1;
            if token == Token::Symbol(')') {
                return Ok(arguments);
            }
        }
    }

    fn sum(&mut self, start: usize) -> Result<usize, FormulaError> {
        let index_span = self.span();
        let index = self.index()?;
        let from = self.expression(0)?;
        self.comma()?;
        let to = self.expression(0)?;
        self.comma()?;
        self.indices.push(index);
        let body = self.parenthesised()?;
        self.indices.pop();
        let sum = Sum { index: index.to_owned(), index_span, from, to, body };
        Ok(self.push(NodeKind::Sum(sum), self.since(start)))
    }

    fn index(&mut self) -> Result<&'a str, FormulaError> {
        let Token::Name(index) = self.peek() else {
            return Err(self.expected("the name of the index").help(SUM_FORM));
        };
        if self.indices.contains(&index) {
            let message = format!("`{index}` is already the index of an enclosing sum");
            return Err(FormulaError::new(self.span(), message));
        }
        if index == PI || Builtin::find(index).is_some() {
            let message = format!("`{index}` is a builtin name");
            return Err(FormulaError::new(self.span(), message).help("choose another index"));
        }
        self.at += 1;
        self.comma()?;
        Ok(index)
    }

    fn comma(&mut self) -> Result<(), FormulaError> {
        if self.peek() != Token::Symbol(',') {
            return Err(self.expected("`,`").help(SUM_FORM));
        }
        self.at += 1;
        Ok(())
    }
}
