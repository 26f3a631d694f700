//! Formulas of place and time at many places and many times.

use super::bound::Formula;
use super::number::Number;
use super::program::{read, run};
use super::split::Split;

/// Formulas of the same variables, the last of which is the time, evaluated at the same places
/// again and again.
///
/// Terms of the place only are computed once for each place, terms of the time only once for each
/// time. The values have the bits that [`Formula::eval`] gives.
#[derive(Debug, Clone)]
pub struct Hoisted<T> {
    split: Split,
    /// The variables: the coordinates last added, and the present time.
    variables: Vec<T>,
    registers: Vec<T>,
    /// Inputs of the remaining steps: values kept for the time, then those of one place.
    inputs: Vec<T>,
    /// Values kept for each place, place after place.
    kept: Vec<T>,
}

impl<T: Number> Hoisted<T> {
    /// Takes formulas of `variables` variables apart. Their sums are written out: see
    /// [`Formula::operations`] for how long that will be.
    ///
    /// # Panics
    /// If a formula is bound to another number of variables.
    pub fn new(formulas: &[Formula], variables: usize) -> Self {
        assert!(formulas.iter().all(|formula| formula.variables() == variables), "variables");
        let split = Split::new(formulas, variables);
        let parts = [&split.place, &split.time, &split.rest];
        let registers = parts.map(|part| part.registers).into_iter().max().unwrap_or_default();
        let zero = T::from(0.0);
        Self {
            variables: vec![zero; variables],
            registers: vec![zero; registers],
            inputs: vec![zero; split.time.kept + split.place.kept],
            kept: Vec::new(),
            split,
        }
    }

    /// Adds a place; the first has the number 0.
    ///
    /// # Panics
    /// If `coordinates` are not all variables but the last.
    pub fn add(&mut self, coordinates: &[T]) {
        let last = self.variables.len() - 1;
        self.variables[..last].copy_from_slice(coordinates);
        let place = &self.split.place;
        run(&place.code, 0, &self.variables, &mut self.registers);
        self.kept.extend_from_slice(&self.registers[..place.kept]);
    }

    /// Moves on to the time `t`.
    pub fn set_time(&mut self, t: T) {
        let last = self.variables.len() - 1;
        self.variables[last] = t;
        let time = &self.split.time;
        run(&time.code, 0, &self.variables, &mut self.registers);
        self.inputs[..time.kept].copy_from_slice(&self.registers[..time.kept]);
    }

    /// The values of the formulas at a place, at the present time. Allocates nothing.
    ///
    /// # Panics
    /// If there is no such place.
    pub fn eval(&mut self, place: usize) -> impl Iterator<Item = T> {
        let (fixed, rest) = (self.split.place.kept, &self.split.rest);
        let kept = &self.kept[place * fixed..][..fixed];
        self.inputs[self.split.time.kept..].copy_from_slice(kept);
        run(&rest.code, 0, &self.inputs, &mut self.registers);
        self.split.results.iter().map(|result| read(*result, &self.inputs, &self.registers))
    }

    /// Operations that are left for each evaluation.
    pub fn operations(&self) -> usize {
        self.split.rest.code.len()
    }
}
