//! The formula language of suites.
//!
//! Suites contain numbers and exact solutions as formulas: `pi/(2*L)*sqrt(E/rho)`,
//! `v0/omega*sin(pi*X/(2*L))*sin(omega*t)`. A formula is processed in three stages:
//!
//! 1. [`Expr::parse`] turns text into a syntax tree, without resolving names.
//! 2. [`Formula::bind`] resolves every name in a [`Scope`] and a list of variables, inlines user
//!    functions, folds constants and returns a flat program.
//! 3. [`Formula::eval`] runs the program over any [`Number`]: `f64`, or a [`Jet`] with first and
//!    second derivatives. [`NumberBatch`] evaluates several positions at once, and [`Hoisted`] many
//!    positions and times at lower cost.
//!
//! # Language
//!
//! - Numbers `1`, `1.5`, `.5`, `2e-3`; the constant `pi`. There is no constant `e`, because `E` is
//!   Young's modulus: write `exp(1)`.
//! - `+ - * / ^` and parentheses. `^` associates to the right and binds tighter than the unary
//!   minus: `-2^2` is -4. There is no implicit multiplication.
//! - The functions of [`Unary`] and [`Binary`], and `sum(n, from, to, body)`, whose bounds are
//!   integers that are known when the formula is bound.
//! - User functions, declared with [`Scope::function`] in any order. They may use constants, other
//!   functions and their own parameters, but no variable of the calling formula except the one
//!   declared with [`Scope::free`].
//!
//! # Reproducibility
//!
//! Transcendental functions come from `libm`, so formulas are bit-identical on all platforms.
//!
//! # Hostile input
//!
//! Formulas above limits give a [`FormulaError`], never a stack overflow or an endless loop.
//!
//! ```
//! use mpm_judge::exact::formula::{Expr, Formula, Jet, Scope};
//!
//! let mut scope = Scope::new();
//! scope.constant("omega", 3.0)?;
//! let formula = Formula::bind(&Expr::parse("sin(omega*t)")?, &scope, &["t"])?;
//! let jet = formula.eval(&[Jet::<1>::variable(0.0, 0)]);
//! assert_eq!((jet.value(), jet.d(0), jet.dd(0, 0)), (0.0, 3.0, 0.0));
//! # Ok::<(), mpm_judge::exact::formula::FormulaError>(())
//! ```

mod ast;
mod bind;
mod bound;
mod builtin;
mod force;
mod hoisted;
mod jet;
mod lexer;
mod number;
mod parser;
mod program;
mod scope;
mod smooth;
mod unary;

pub use ast::Expr;
pub use bound::Formula;
pub use builtin::Binary;
pub use force::FormulaForce;
pub use jet::Jet;
pub use lexer::FormulaError;
pub use number::Number;
pub use scope::Scope;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{hoisted::Hoisted, jet::Slope, number::NumberBatch, unary::Unary};
