//! Operator-precedence parser (Pratt) from tokens to a syntax tree.

use super::ast::{Expr, Node, NodeKind, Sum};
use super::builtin;
use super::builtin::{Binary, Builtin, PI};
use super::lexer::{FormulaError, Lexeme, Token, tokens};
use std::ops::Range;

const MAX_DEPTH: usize = 128;
/// Binding power of the unary minus: above `*`, below `^`.
const MINUS: u8 = 5;
const SUM_FORM: &str = "the form is `sum(index, from, to, body)`";

impl Expr {
    /// Parses a formula.
    ///
    /// # Errors
    /// When `source` is not a valid formula, or exceeds a limit.
    pub fn parse(source: &str) -> Result<Self, FormulaError> {
        Ok(Self::new(source, parse(source)?))
    }
}

/// Parses `source` to nodes; the root is last.
fn parse(source: &str) -> Result<Vec<Node>, FormulaError> {
    let lexemes = tokens(source)?;
    let mut parser =
        Parser { source, lexemes, at: 0, nodes: Vec::new(), indices: Vec::new(), depth: 0 };
    parser.expression(0)?;
    match parser.peek() {
        Token::End => Ok(parser.nodes),
        _ => Err(parser.missing_operator("an operator or the end of the formula")),
    }
}

/// Returns the operator of a token, with its left and right binding power.
fn operator(token: Token) -> Option<(Binary, u8, u8)> {
    match token {
        Token::Symbol('+') => Some((Binary::Add, 1, 2)),
        Token::Symbol('-') => Some((Binary::Subtract, 1, 2)),
        Token::Symbol('*') => Some((Binary::Multiply, 3, 4)),
        Token::Symbol('/') => Some((Binary::Divide, 3, 4)),
        Token::Symbol('^') => Some((Binary::Power, 8, 7)),
        _ => None,
    }
}

struct Parser<'a> {
    source: &'a str,
    lexemes: Vec<Lexeme<'a>>,
    at: usize,
    nodes: Vec<Node>,
    /// Index names of the sums whose bodies enclose the current position.
    indices: Vec<&'a str>,
    depth: usize,
}

impl<'a> Parser<'a> {
    /// Parses an expression up to the first operator whose left binding power is below `hold`.
    fn expression(&mut self, hold: u8) -> Result<usize, FormulaError> {
        if self.depth == MAX_DEPTH {
            let message = format!("the formula is nested more than {MAX_DEPTH} levels deep");
            return Err(FormulaError::new(self.span(), message));
        }
        self.depth += 1;
        let mut left = self.operand()?;
        while let Some((operator, to_left, to_right)) = operator(self.peek())
            && to_left >= hold
        {
            self.at += 1;
            let right = self.expression(to_right)?;
            let span = self.nodes[left].span.start..self.nodes[right].span.end;
            left = self.push(NodeKind::Binary(operator, left, right), span);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn operand(&mut self) -> Result<usize, FormulaError> {
        let span = self.span();
        match self.peek() {
            Token::Number(value) => {
                self.at += 1;
                Ok(self.push(NodeKind::Number(value), span))
            }
            Token::Name(name) => {
                self.at += 1;
                self.named(name, span)
            }
            Token::Symbol('-') => {
                self.at += 1;
                let operand = self.expression(MINUS)?;
                let end = self.nodes[operand].span.end;
                Ok(self.push(NodeKind::Negate(operand), span.start..end))
            }
            Token::Symbol('(') => {
                self.at += 1;
                self.parenthesised()
            }
            _ => Err(self.missing_operand()),
        }
    }

    fn parenthesised(&mut self) -> Result<usize, FormulaError> {
        let inner = self.expression(0)?;
        if self.peek() == Token::Symbol(')') {
            self.at += 1;
            return Ok(inner);
        }
        Err(self.missing_operator("`)`"))
    }

    fn push(&mut self, kind: NodeKind, span: Range<usize>) -> usize {
        self.nodes.push(Node { kind, span });
        self.nodes.len() - 1
    }

    fn peek(&self) -> Token<'a> {
        self.lexemes[self.at].token
    }

    fn span(&self) -> Range<usize> {
        self.lexemes[self.at].span.clone()
    }

    /// Returns the byte range from `start` to the end of the last consumed token.
    fn since(&self, start: usize) -> Range<usize> {
        start..self.lexemes[self.at - 1].span.end
    }

    fn expected(&self, what: &str) -> FormulaError {
        let found = match self.peek() {
            Token::End => "the end of the formula".to_owned(),
            _ => format!("`{}`", &self.source[self.span()]),
        };
        FormulaError::new(self.span(), format!("expected {what}, found {found}"))
    }

    fn missing_operand(&self) -> FormulaError {
        let error = self.expected("a value");
        let before = self.at.checked_sub(1).map(|at| self.lexemes[at].token);
        match (before, self.peek()) {
            (Some(Token::Symbol('*')), Token::Symbol('*')) => error.help("a power is written `^`"),
            (_, Token::Symbol('+')) => error.help("there is no unary `+`"),
            _ => error,
        }
    }

    /// Returns a suggestion for a decimal comma: the number with a decimal point.
    fn decimal_comma(&self) -> Option<String> {
        let (before, after) =
            (self.lexemes.get(self.at.checked_sub(1)?)?, self.lexemes.get(self.at + 1)?);
        let are_numbers =
            [before, after].iter().all(|lexeme| matches!(lexeme.token, Token::Number(_)));
        let text = |lexeme: &Lexeme<'_>| self.source.get(lexeme.span.clone());
        are_numbers.then(|| Some(format!("{}.{}", text(before)?, text(after)?)))?
    }

    fn missing_operator(&self, expected: &str) -> FormulaError {
        let error = self.expected(expected);
        match self.peek() {
            Token::Number(_) | Token::Name(_) | Token::Symbol('(') => {
                error.help("there is no implicit multiplication: write `*`")
            }
            Token::Symbol(',') => match self.decimal_comma() {
                Some(number) => error.help(format!("a decimal point is written `.`: `{number}`")),
                None => error,
            },
            _ => error,
        }
    }

    /// Parses a term that begins with a name: a call if a parenthesis follows, otherwise a value.
    fn named(&mut self, name: &'a str, span: Range<usize>) -> Result<usize, FormulaError> {
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

    /// Adds a node for a name with a value. A call of the name is an error that states its `role`.
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
        if builtin == Builtin::Sum {
            return self.sum(span.start);
        }
        let arguments = self.arguments()?;
        let span = self.since(span.start);
        match (builtin, &arguments[..]) {
            (Builtin::Unary(function), &[x]) => Ok(self.push(NodeKind::Unary(function, x), span)),
            (Builtin::Binary(function), &[a, b]) => {
                Ok(self.push(NodeKind::Binary(function, a, b), span))
            }
            (_, given) => {
                let needed = if matches!(builtin, Builtin::Unary(_)) { 1 } else { 2 };
                let (needed, given) = (builtin::arguments(needed), given.len());
                Err(FormulaError::new(span, format!("`{name}` takes {needed}, not {given}")))
            }
        }
    }

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
        if builtin::is_reserved(index) {
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
