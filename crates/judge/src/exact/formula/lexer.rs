//! Tokens of a formula, and formula errors with their positions.

use std::ops::Range;
use thiserror::Error;

const MAX_BYTES: usize = 16 * 1024;
const MAX_TOKENS: usize = 4096;
const SYMBOLS: &[u8] = b"+-*/^(),";

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Symbol(char),
    End,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lexeme<'a> {
    pub(super) token: Token<'a>,
    pub(super) span: Range<usize>,
}

/// Splits `source` into tokens, terminated by [`Token::End`].
pub(super) fn tokens(source: &str) -> Result<Vec<Lexeme<'_>>, FormulaError> {
    if source.len() > MAX_BYTES {
        let message = format!("the formula is longer than {MAX_BYTES} bytes");
        return Err(FormulaError::new(0..source.len(), message));
    }
    let mut lexer = Lexer { source, at: 0 };
    let mut lexemes = Vec::new();
    loop {
        let lexeme = lexer.next()?;
        if lexemes.len() == MAX_TOKENS && lexeme.token != Token::End {
            let message = format!("the formula has more than {MAX_TOKENS} tokens");
            return Err(FormulaError::new(lexeme.span, message));
        }
        let last = lexeme.token == Token::End;
        lexemes.push(lexeme);
        if last {
            return Ok(lexemes);
        }
    }
}

/// Whether `name` is a valid name: a letter or `_`, then letters, digits and `_`.
pub(super) fn is_name(name: &str) -> bool {
    name.bytes().next().is_some_and(starts_name) && name.bytes().all(continues_name)
}

fn starts_name(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

fn continues_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// A position in the source, always on a character boundary, because only ASCII is consumed.
struct Lexer<'a> {
    source: &'a str,
    at: usize,
}

impl<'a> Lexer<'a> {
    fn next(&mut self) -> Result<Lexeme<'a>, FormulaError> {
        self.skip(|byte| byte.is_ascii_whitespace());
        let start = self.at;
        let token = match self.peek(0) {
            None => Token::End,
            Some(byte) if byte.is_ascii_digit() || byte == b'.' => self.number()?,
            Some(byte) if starts_name(byte) => Token::Name(self.name()),
            Some(byte) if SYMBOLS.contains(&byte) => {
                self.at += 1;
                Token::Symbol(char::from(byte))
            }
            Some(_) => return Err(self.foreign()),
        };
        Ok(Lexeme { token, span: start..self.at })
    }

    fn peek(&self, ahead: usize) -> Option<u8> {
        self.source.as_bytes().get(self.at + ahead).copied()
    }

    fn skip(&mut self, accept: impl Fn(u8) -> bool) -> usize {
        let start = self.at;
        while self.peek(0).is_some_and(&accept) {
            self.at += 1;
        }
        self.at - start
    }

    fn name(&mut self) -> &'a str {
        let start = self.at;
        self.skip(continues_name);
        &self.source[start..self.at]
    }

    fn number(&mut self) -> Result<Token<'a>, FormulaError> {
        let start = self.at;
        self.mantissa()?;
        self.exponent();
        let text = &self.source[start..self.at];
        self.refuse_tail(start, text)?;
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Token::Number(value)),
            _ => {
                Err(FormulaError::new(start..self.at, format!("the number `{text}` is too large")))
            }
        }
    }

    fn mantissa(&mut self) -> Result<(), FormulaError> {
        let start = self.at;
        self.skip(|byte| byte.is_ascii_digit());
        if self.peek(0) == Some(b'.') {
            self.at += 1;
            if self.skip(|byte| byte.is_ascii_digit()) == 0 {
                return Err(FormulaError::new(start..self.at, "expected a digit after `.`"));
            }
        }
        Ok(())
    }

    /// Treats `e` or `E` as an exponent only if digits follow, because `E` is also a common name.
    fn exponent(&mut self) {
        let sign = usize::from(matches!(self.peek(1), Some(b'+' | b'-')));
        let has_digits = self.peek(1 + sign).is_some_and(|byte| byte.is_ascii_digit());
        if matches!(self.peek(0), Some(b'e' | b'E')) && has_digits {
            self.at += 1 + sign;
            self.skip(|byte| byte.is_ascii_digit());
        }
    }

    /// Refuses `2E` and `1.2.3`: no letter, digit or point may follow a number.
    fn refuse_tail(&mut self, start: usize, number: &str) -> Result<(), FormulaError> {
        let name = self.name();
        if !name.is_empty() {
            let message = format!("`{number}{name}` is neither a number nor a name");
            let after = name.trim_start_matches('_');
            if name.starts_with('_')
                && after.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_')
            {
                let whole = format!("{number}{}", name.replace('_', ""));
                return Err(FormulaError::new(start..self.at, message)
                    .help(format!("digits are not grouped: write `{whole}`")));
            }
            return Err(FormulaError::new(start..self.at, message)
                .help(format!("write `{number}*{name}` to multiply")));
        }
        if self.peek(0) == Some(b'.') {
            self.at += 1;
            let message = format!("the number `{number}` is followed by a second `.`");
            return Err(FormulaError::new(start..self.at, message));
        }
        Ok(())
    }

    fn foreign(&self) -> FormulaError {
        let found = self.source[self.at..].chars().next().unwrap_or_default();
        let span = self.at..self.at + found.len_utf8();
        let error =
            FormulaError::new(span, format!("unexpected character `{}`", found.escape_debug()));
        if found.is_ascii() {
            return error;
        }
        error.help(
            "formulas are ASCII: write the names of letters, as in `omega`, and use `-`, \
                    `*`, `/`",
        )
    }
}

/// An error in parsing or binding a formula.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct FormulaError {
    /// The error in one line.
    pub message: String,
    /// Byte range in the formula, in the body of `within`, or in the name of a declaration.
    pub span: Range<usize>,
    /// A correction, if known.
    pub help: Option<String>,
    /// The user function whose body contains the error; `None` for the formula itself.
    pub within: Option<String>,
    /// The name that is not declared; `None` for other errors.
    pub unknown: Option<String>,
}

impl FormulaError {
    pub(super) fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { message: message.into(), span, help: None, within: None, unknown: None }
    }

    pub(super) fn unknown(span: Range<usize>, name: &str) -> Self {
        let message = format!("unknown name `{name}`");
        Self { unknown: Some(name.to_owned()), ..Self::new(span, message) }
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the function whose body contains the error, unless an inner function is already set.
    pub(super) fn within(mut self, function: &str) -> Self {
        self.within.get_or_insert_with(|| function.to_owned());
        self
    }
}
