//! Formulas, parameters and functions.

use super::samples::BAR;
use super::{Edits, refused};
use rstest::rstest;

#[rstest]
#[case::an_open_parenthesis(
    &[("*sin(omega*t)\"", "*sin(omega*t▸\"")],
    &["expected `,` or `)`, found the end of the formula"]
)]
#[case::a_decimal_comma(&[("L: 25 ", "L: 25▸,5 ")], &["expected an operator or the end of the formula, found `,`"])]
#[case::an_unknown_parameter(&[("v0/omega*", "v0/▸omgea*")], &["unknown name `omgea`", "did you mean `omega`? declared: `omega`, "])]
#[case::an_unknown_function(&[("v0*mode(X)", "v0*▸mod(X)")], &["unknown function `mod`", "did you mean `mode`?"])]
#[case::a_small_letter(&[("mode(X)*", "mode(▸x)*")], &["unknown name `x`", "did you mean `X`?"])]
#[case::a_coordinate_of_more_dimensions(
    &[("mode(X)*", "mode(▸Y)*")],
    &["unknown name `Y`", "the variables are `X`, `t`"]
)]
#[case::time_in_the_time_step(&[("dt: 1e-3", "dt: ▸t")], &["unknown name `t`", "the variables are `h`"])]
#[case::a_parameter_that_comes_later(
    &[("L: 25 ", "L: \"▸E/4\" ")],
    &["unknown name `E`", "`E` is declared further down (line 7): move it up"]
)]
#[case::a_parameter_that_is_declared_nowhere(
    &[("E: 100", "E: \"▸M*4\"")],
    &["unknown name `M`", "there are no variables here; declared: `L`"]
)]
#[case::a_modulus_that_varies(
    &[("young: E", "young: \"E*▸X\"")],
    &["unknown name `X`", "for several materials, list several `bodies` in `scene`"]
)]
#[case::a_parameter_that_comes_later_in_a_function(
    &[("sin(pi*s/(2*L))", "sin(pi*s/(2*▸v0))"), ("L: 25 ", "L: \"25*mode(1)\" ")],
    &["unknown name `v0`", "`v0` is declared further down (line 9): move it up"]
)]
#[case::an_unused_parameter(
    &[("rho: 1\n", "rho: 1\n  ▸nu: 0.3\n")],
    &["the parameter `nu` is never used", "remove it, or use it"]
)]
#[case::an_unused_function(
    &[("functions:\n", "functions:\n  ▸spare(s): \"s^2\"\n")],
    &["the function `spare` is never used", "remove it, or use it"]
)]
#[case::an_unused_function_that_does_not_parse(
    &[("functions:\n", "functions:\n  spare(s): \"s^▸\"\n")],
    &["expected a value, found the end of the formula"]
)]
#[case::a_function_that_calls_itself(
    &[("sin(pi*s/(2*L))", "sin(pi*▸mode(s)/(2*L))")],
    &["functions may not be recursive: `mode` calls `mode`"]
)]
#[case::functions_that_call_each_other(
    &[("\"sin(pi*s/(2*L))\"", "\"other(s)\"\n  other(s): \"▸mode(s)\"")],
    &["functions may not be recursive: `mode` calls `other` calls `mode`"]
)]
#[case::a_name_that_is_unknown_in_a_function(
    &[("sin(pi*s/(2*L))", "sin(pi*▸S/(2*L))")],
    &["unknown name `S`", "did you mean `s`?"]
)]
#[case::too_many_arguments(&[("v0*mode(X)", "v0*▸mode(X, t)")], &["`mode` takes 1 argument, not 2"])]
#[case::a_parameter_that_hides_a_builtin(&[("rho: 1\n", "rho: 1\n  ▸sin: 1\n")], &["`sin` is already a builtin name"])]
#[case::a_parameter_that_hides_pi(&[("rho: 1\n", "rho: 1\n  ▸pi: 3\n")], &["`pi` is already a builtin name"])]
#[case::a_parameter_that_hides_time(
    &[("rho: 1\n", "rho: 1\n  ▸t: 3\n")],
    &["`t` is a variable of formulas and cannot be declared", "rename it; the variables are X, t"]
)]
#[case::a_parameter_that_hides_the_cell_size(
    &[("rho: 1\n", "rho: 1\n  ▸h: 3\n")],
    &["`h` is a variable of formulas and cannot be declared"]
)]
#[case::a_function_that_hides_a_coordinate(
    &[("functions:\n", "functions:\n  ▸X(s): \"s^2\"\n")],
    &["`X` is a variable of formulas and cannot be declared"]
)]
#[case::a_head_without_parentheses(
    &[("mode(s):", "▸mode s:")],
    &["`mode s` is not a function declaration", "write the name and its arguments: `s(tau)`"]
)]
#[case::a_head_without_arguments(&[("mode(s):", "▸mode():")], &["`mode()` lacks a name or an argument", "`s(tau)`"])]
#[case::a_head_without_a_name(&[("mode(s):", "▸(s):")], &["`(s)` lacks a name or an argument"])]
#[case::a_head_with_half_an_argument(&[("mode(s):", "▸\"mode(s,)\":")], &["`mode(s,)` lacks a name or an argument"])]
#[case::a_head_with_a_number(
    &[("mode(s):", "▸mode(2s):")],
    &["`2s` is not a name", "a name is made of ASCII letters, digits and `_`"]
)]
#[case::a_function_twice(
    &[("functions:\n", "functions:\n  mode(x): \"x\"\n"), ("  mode(s)", "  ▸mode(s)")],
    &["`mode` is already a function"]
)]
#[case::a_sum_that_takes_hours(
    &[("[\"v0/omega*mode(X)*", "[▸\"sum(k, 1, 99999, sin(k*X))*")],
    &["this formula takes ", "expected at most 5000: shorten its sums"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}
