//! Evaluates formulas of position and time at many positions and times.
//!
//! The steps of a program are split by their dependence: on position, on time, or on both.
//!
//! Sums are unrolled and registers are renamed, so each step is a node that is computed once
//! (static single assignment: Cytron et al. 1991, ACM TOPLAS 13). The operations that lead to a
//! number do not change, so values are bit-identical.

use super::bound::Formula;
use super::builtin::Binary;
use super::number::Number;
use super::program::{Action, Instruction, Operand, read, run};
use std::collections::BTreeMap;

/// Formulas of the same variables (coordinates, then time) at fixed positions for many times.
///
/// Terms that depend only on position are computed once per position, and terms that depend only on
/// time once per time. The values are bit-identical to those of [`Formula::eval`].
#[derive(Debug, Clone)]
pub struct Hoisted<T> {
    split: Split,
    /// The variables: the most recently added coordinates, and the current time.
    variables: Vec<T>,
    registers: Vec<T>,
    /// Inputs of the steps that depend on both: values stored for the time, then for one position.
    inputs: Vec<T>,
    /// Values stored for each position, one position after another.
    kept: Vec<T>,
}

impl<T: Number> Hoisted<T> {
    /// Splits formulas with this number of `variables`. Sums are unrolled, so a formula has
    /// [`Formula::operations`] steps.
    ///
    /// # Panics
    /// If a formula has a different number of variables.
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

    /// Adds a position with one coordinate per variable except time; the first has index 0.
    pub fn add(&mut self, coordinates: &[T]) {
        let last = self.variables.len() - 1;
        self.variables[..last].copy_from_slice(coordinates);
        let place = &self.split.place;
        run(&place.code, 0, &self.variables, &mut self.registers);
        self.kept.extend_from_slice(&self.registers[..place.kept]);
    }

    /// Sets the time to `t`.
    pub fn set_time(&mut self, t: T) {
        let last = self.variables.len() - 1;
        self.variables[last] = t;
        let time = &self.split.time;
        run(&time.code, 0, &self.variables, &mut self.registers);
        self.inputs[..time.kept].copy_from_slice(&self.registers[..time.kept]);
    }

    /// Returns the values of the formulas at a position for the current time. Does not allocate.
    pub fn eval(&mut self, place: usize) -> impl Iterator<Item = T> {
        let (fixed, rest) = (self.split.place.kept, &self.split.rest);
        let kept = &self.kept[place * fixed..][..fixed];
        self.inputs[self.split.time.kept..].copy_from_slice(kept);
        run(&rest.code, 0, &self.inputs, &mut self.registers);
        self.split.results.iter().map(|result| read(*result, &self.inputs, &self.registers))
    }

    /// Returns the number of operations per evaluation that depend on both position and time.
    pub fn operations(&self) -> usize {
        self.split.rest.code.len()
    }
}

/// Dependence of a node on position and time, as a bit set.
type Dependence = usize;
const NOTHING: Dependence = 0;
const PLACE: Dependence = 1;
const TIME: Dependence = 2;
const BOTH: Dependence = 3;

/// The steps of several formulas. Equal steps, even of different formulas, share one node.
#[derive(Default)]
struct Nodes {
    list: Vec<SsaNode>,
    /// Node indices by the text of the node, which distinguishes 0 from -0, unlike `==`.
    known: BTreeMap<String, usize>,
}

/// A step whose registers are node indices.
struct SsaNode {
    action: Action,
    dependence: Dependence,
}

/// A program whose first registers contain the values that other programs use.
#[derive(Debug, Clone, Default)]
pub(super) struct PartProgram {
    pub(super) code: Vec<Instruction>,
    pub(super) registers: usize,
    /// Number of values that other programs use.
    pub(super) kept: usize,
}

/// Formulas of the same variables, split into three parts. The last variable is the time.
#[derive(Debug, Clone)]
pub(super) struct Split {
    /// Steps that depend only on position. Their inputs are the variables of the formulas.
    pub(super) place: PartProgram,
    /// Steps that depend at most on time. Their inputs are the variables of the formulas.
    pub(super) time: PartProgram,
    /// The remaining steps. Their inputs are the values stored by `time`, then those by `place`.
    pub(super) rest: PartProgram,
    /// Locations of the formula values after running `rest`.
    pub(super) results: Vec<Operand>,
}

impl Split {
    pub(super) fn new(formulas: &[Formula], variables: usize) -> Self {
        let mut nodes = Nodes::default();
        for i in 0..variables {
            let dependence = if i + 1 == variables { TIME } else { PLACE };
            nodes.list.push(SsaNode { action: Action::Copy(Operand::Variable(i)), dependence });
        }
        let results: Vec<Operand> =
            formulas.iter().map(|formula| unroll(formula, &mut nodes)).collect();
        let nodes = nodes.list;
        let homes = Homes::new(&nodes, &results);
        Self {
            place: homes.part(&nodes, PLACE),
            time: homes.part(&nodes, TIME),
            rest: homes.part(&nodes, BOTH),
            results: results.iter().map(|result| homes.seen(*result, BOTH)).collect(),
        }
    }
}

impl Nodes {
    /// Adds a node for a step, or returns the node of an equal step.
    fn push(&mut self, action: Action) -> Operand {
        let next = self.list.len();
        let node = *self.known.entry(format!("{action:?}")).or_insert(next);
        if node == next {
            let dependence =
                action.arguments().fold(NOTHING, |dependence, operand| match operand {
                    Operand::Register(node) => dependence | self.list[node].dependence,
                    _ => dependence,
                });
            self.list.push(SsaNode { action, dependence });
        }
        Operand::Register(node)
    }
}

/// Appends the steps of a formula with unrolled sums. Returns the operand of the formula value.
fn unroll(formula: &Formula, nodes: &mut Nodes) -> Operand {
    // Content of each register: a constant or the value of a node.
    let mut held = vec![Operand::Constant(0.0); formula.registers];
    let now = |held: &[Operand], operand| match operand {
        Operand::Register(register) => held[register],
        Operand::Variable(variable) => Operand::Register(variable),
        Operand::Constant(_) => operand,
    };
    let mut at = 0;
    while let Some(Instruction { action, to }) = formula.code.get(at) {
        at += 1;
        held[*to] = match action {
            Action::Copy(a) => now(&held, *a),
            Action::Next(end) => {
                let sum = Action::Binary(Binary::Add, held[*to], now(&held, end.term));
                if let Operand::Constant(index) = held[to + 1]
                    && index < end.last
                {
                    held[to + 1] = Operand::Constant(index + 1.0);
                    at = end.body;
                }
                nodes.push(sum)
            }
            action => nodes.push(action.map(|operand| now(&held, operand))),
        };
    }
    now(&held, formula.result)
}

/// The part of the program, and the register, in which each node is computed.
struct Homes {
    dependence: Vec<Dependence>,
    /// For each part, the registers of the nodes that the part computes.
    registers: [Vec<Option<usize>>; 4],
    kept: [usize; 4],
}

impl Homes {
    /// Assigns parts and registers to all nodes that `results` need, backwards from the results.
    fn new(nodes: &[SsaNode], results: &[Operand]) -> Self {
        let mut homes = Self {
            dependence: nodes.iter().map(|node| node.dependence).collect(),
            registers: std::array::from_fn(|_| vec![None; nodes.len()]),
            kept: [0; 4],
        };
        let mut wanted: [Vec<bool>; 4] = std::array::from_fn(|_| vec![false; nodes.len()]);
        let mut ask = |operand: Operand, reader: Dependence, wanted: &mut [Vec<bool>; 4]| {
            let Operand::Register(node) = operand else { return };
            let home = home(homes.dependence[node], reader);
            wanted[home][node] = true;
            if home != reader && homes.registers[home][node].is_none() {
                homes.registers[home][node] = Some(homes.kept[home]);
                homes.kept[home] += 1;
            }
        };
        for result in results {
            ask(*result, BOTH, &mut wanted);
        }
        for (i, node) in nodes.iter().enumerate().rev() {
            for reader in [PLACE, TIME, BOTH] {
                if wanted[reader][i] {
                    for argument in node.action.arguments() {
                        ask(argument, reader, &mut wanted);
                    }
                }
            }
        }
        for part in [PLACE, TIME, BOTH] {
            let mut next = homes.kept[part];
            for (register, wanted) in homes.registers[part].iter_mut().zip(&wanted[part]) {
                if *wanted && register.is_none() {
                    *register = Some(next);
                    next += 1;
                }
            }
        }
        homes
    }

    fn part(&self, nodes: &[SsaNode], part: Dependence) -> PartProgram {
        let mut code = Vec::new();
        for (node, register) in nodes.iter().zip(&self.registers[part]) {
            if let Some(to) = *register {
                let action = node.action.map(|operand| self.seen(operand, part));
                code.push(Instruction { action, to });
            }
        }
        PartProgram { registers: code.len(), code, kept: self.kept[part] }
    }

    /// Returns the location from which the part `reader` reads an operand.
    fn seen(&self, operand: Operand, reader: Dependence) -> Operand {
        let Operand::Register(node) = operand else { return operand };
        let home = home(self.dependence[node], reader);
        let register = self.registers[home][node].unwrap_or_default();
        match home {
            _ if home == reader => Operand::Register(register),
            TIME => Operand::Variable(register),
            _ => Operand::Variable(self.kept[TIME] + register),
        }
    }
}

/// Returns the part that computes an input of `reader`. A part computes its own constants, but the
/// constants of `rest`, which runs most often, are computed by `time`.
fn home(dependence: Dependence, reader: Dependence) -> Dependence {
    match (dependence, reader) {
        (NOTHING, BOTH) => TIME,
        (NOTHING, _) => reader,
        _ => dependence,
    }
}
