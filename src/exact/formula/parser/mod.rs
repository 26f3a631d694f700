//! Tokens to a syntax tree, by operator precedence (Pratt).

mod call;

use std::ops::Range;

use super::ast::{Expr, Node, NodeKind};
use super::binary::Binary;
use super::error::FormulaError;
use super::lexer::{Lexeme, Token, tokens};

/// Deepest nesting of parentheses, arguments, signs and right operands.
const MAX_DEPTH: usize = 128;
/// How tightly the unary minus holds its operand: tighter than `*`, looser than `^`.
const MINUS: u8 = 5;

impl Expr {
    /// Reads a formula.
    ///
    /// # Errors
    /// When `source` is not a formula of the language, or exceeds its limits.
    pub fn parse(source: &str) -> Result<Self, FormulaError> {
        Ok(Self::new(source, parse(source)?))
    }
}

/// The nodes of the formula `source`, its root last.
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

/// An operator and how tightly it holds its left and its right operand.
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
    /// Indices of the sums whose bodies enclose the present position.
    indices: Vec<&'a str>,
    depth: usize,
}

impl<'a> Parser<'a> {
    /// Reads operands as long as operators hold them at least as tightly as `hold`.
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

    /// From `start` to the end of the last token taken.
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

    /// The error where a value should begin.
    fn missing_operand(&self) -> FormulaError {
        let error = self.expected("a value");
        let before = self.at.checked_sub(1).map(|at| self.lexemes[at].token);
        match (before, self.peek()) {
            (Some(Token::Symbol('*')), Token::Symbol('*')) => error.help("a power is written `^`"),
            (_, Token::Symbol('+')) => error.help("there is no unary `+`"),
            _ => error,
        }
    }

    /// The number around a comma between two numbers, with a point in its place.
    fn decimal_comma(&self) -> Option<String> {
        let (before, after) =
            (self.lexemes.get(self.at.checked_sub(1)?)?, self.lexemes.get(self.at + 1)?);
        let are_numbers =
            [before, after].iter().all(|lexeme| matches!(lexeme.token, Token::Number(_)));
        let text = |lexeme: &Lexeme<'_>| self.source.get(lexeme.span.clone());
        are_numbers.then(|| Some(format!("{}.{}", text(before)?, text(after)?)))?
    }

    /// The error where an operand has ended: if another one follows, a `*` may be missing.
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
}
