//! A solver that keeps an energy ledger of its steps.

use super::energy_ledger::EnergyLedger;
use crate::mpm::basis::BasisName;
use crate::mpm::step::solver::Solver;
use crate::subject::{
    BodyFields, EnergyBalance, Failure, Perturbable, Reaction, RunCounters, Samples, Subject,
    Totals,
};

/// A [`Solver`] with an [`EnergyLedger`]. Its steps are those of the solver, bit for bit. It has no
/// checkpoints.
pub struct LedgerSolver<const D: usize> {
    solver: Solver<D>,
    ledger: EnergyLedger,
}

impl<const D: usize> LedgerSolver<D> {
    /// `solver`, whose basis is `basis`, with an empty ledger.
    pub fn new(basis: BasisName, solver: Solver<D>) -> Self {
        Self { solver, ledger: EnergyLedger::new(basis) }
    }
}

impl<const D: usize> Subject for LedgerSolver<D> {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.ledger.step(&mut self.solver, dt)
    }

    fn energy_balance(&self) -> Option<EnergyBalance> {
        self.ledger.balance().copied()
    }

    fn sample(&self, samples: &mut Samples) {
        self.solver.sample(samples);
    }

    fn counters(&self) -> RunCounters {
        self.solver.counters()
    }

    fn passes(&self) -> Vec<String> {
        self.solver.passes()
    }

    fn fields(&self) -> Vec<BodyFields> {
        self.solver.fields()
    }

    fn totals(&self) -> Option<Totals> {
        self.solver.totals()
    }

    fn reaction(&self, face: Option<(usize, bool)>) -> Option<Reaction> {
        Subject::reaction(&self.solver, face)
    }

    fn null_space_energy(&self) -> Option<f64> {
        Subject::null_space_energy(&self.solver)
    }
}

impl<const D: usize> Perturbable for LedgerSolver<D> {
    fn fix_configuration(&mut self) {
        self.solver.fix_configuration();
    }

    fn state(&self, state: &mut Vec<f64>) {
        self.solver.state(state);
    }

    fn set_state(&mut self, state: &[f64]) {
        self.solver.set_state(state);
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        self.solver.sizes(speed, modulus, sizes);
    }
}
