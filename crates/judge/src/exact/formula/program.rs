//! Instructions of a bound formula, and their interpreter.
//!
//! Sums are loops and user functions are inlined, so there is no recursion.

use super::builtin::Binary;
use super::number::Number;
use super::unary::Unary;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Operand {
    Constant(f64),
    Variable(usize),
    Register(usize),
}

#[derive(Debug, Clone)]
pub(super) struct Instruction {
    pub(super) action: Action,
    pub(super) to: usize,
}

#[derive(Debug, Clone)]
pub(super) enum Action {
    Copy(Operand),
    Negate(Operand),
    Unary(Unary, Operand),
    Binary(Binary, Operand, Operand),
    Powi(Operand, i32),
    Next(Loop),
}

/// The end of the body of a sum. Adds `term` to register `to`; the next register contains the
/// index. If the index is below `last`, increments it and jumps to instruction `body`.
#[derive(Debug, Clone)]
pub(super) struct Loop {
    pub(super) term: Operand,
    pub(super) last: f64,
    pub(super) body: usize,
}

impl Action {
    pub(super) fn arguments(&self) -> impl Iterator<Item = Operand> {
        let (first, second) = match self {
            Self::Copy(a) | Self::Negate(a) | Self::Unary(_, a) | Self::Powi(a, _) => (*a, None),
            Self::Binary(_, a, b) => (*a, Some(*b)),
            Self::Next(end) => (end.term, None),
        };
        std::iter::once(first).chain(second)
    }

    pub(super) fn map(&self, to: impl Fn(Operand) -> Operand) -> Self {
        match self {
            Self::Copy(a) => Self::Copy(to(*a)),
            Self::Negate(a) => Self::Negate(to(*a)),
            Self::Unary(function, a) => Self::Unary(*function, to(*a)),
            Self::Powi(a, exponent) => Self::Powi(to(*a), *exponent),
            Self::Binary(function, a, b) => Self::Binary(*function, to(*a), to(*b)),
            Self::Next(end) => Self::Next(Loop { term: to(end.term), ..end.clone() }),
        }
    }
}

pub(super) fn run<T: Number>(
    code: &[Instruction],
    start: usize,
    variables: &[T],
    registers: &mut [T],
) {
    // Operands are accessed by reference, because copying a jet is slow.
    macro_rules! operand {
        ($operand:expr, $constant:ident) => {
            match *$operand {
                Operand::Constant(value) => {
                    $constant = T::from(value);
                    &$constant
                }
                Operand::Variable(index) => &variables[index],
                Operand::Register(index) => &registers[index],
            }
        };
    }
    let mut at = start;
    while let Some(Instruction { action, to }) = code.get(at) {
        at += 1;
        let (one, other);
        match action {
            Action::Copy(a) => registers[*to] = *operand!(a, one),
            Action::Negate(a) => registers[*to] = -*operand!(a, one),
            Action::Unary(function, a) => registers[*to] = operand!(a, one).unary(*function),
            Action::Binary(function, a, b) => {
                let (a, b) = (operand!(a, one), operand!(b, other));
                // Each branch writes directly to the register; a common temporary would be copied.
                match function {
                    Binary::Add => registers[*to] = *a + *b,
                    Binary::Subtract => registers[*to] = *a - *b,
                    Binary::Multiply => registers[*to] = *a * *b,
                    _ => registers[*to] = function.apply(*a, *b),
                }
            }
            Action::Powi(a, exponent) => registers[*to] = operand!(a, one).powi(*exponent),
            Action::Next(end) => {
                let sum = registers[*to] + *operand!(&end.term, one);
                let index = registers[to + 1].value();
                if index < end.last {
                    registers[to + 1] = T::from(index + 1.0);
                    at = end.body;
                }
                registers[*to] = sum;
            }
        }
    }
}

#[inline]
pub(super) fn read<T: Number>(operand: Operand, variables: &[T], registers: &[T]) -> T {
    match operand {
        Operand::Constant(value) => T::from(value),
        Operand::Variable(index) => variables[index],
        Operand::Register(index) => registers[index],
    }
}
