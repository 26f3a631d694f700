//! Why a case does not have the order of theory: what runs that change one thing have shown.

use crate::verify::order::fit::Interval;
use crate::verify::order::hypothesis::OrderHypothesis;
use crate::verify::verdict::judge::Judgement;
use crate::verify::verdict::name::Verdict;

/// Share of the finest error that a change must leave at most, to be named where none restores the
/// order.
const FALL: f64 = 0.75;

/// Half of the width of the interval of an order that is settled.
const SETTLED: f64 = 0.15;

/// An order that is raised rises by this.
const RISE: f64 = 0.25;

/// Orders that differ by less are the same.
const ALIKE: f64 = 0.1;

/// Effect of a change that shows the cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// The order is that of theory.
    Restored,
    /// The order is higher, and settled.
    Raised,
    /// The finest error is smaller.
    Lowered,
}

/// The finest levels of a case, run with one thing changed.
#[derive(Debug, Clone)]
pub struct ChangedRun {
    /// The thing that is changed, and into what.
    pub change: String,
    /// The cause, if the change is what helps.
    pub cause: &'static str,
    /// Change of the suite that keeps the order.
    pub remedy: &'static str,
    /// Verdict on these levels, against an order near that of theory.
    pub verdict: Verdict,
    /// Observed order on these levels.
    pub order: Option<Interval>,
    /// The finest error over that of the case itself, both over their amplitude.
    pub ratio: f64,
    /// Whether levels are finer, so that their error is smaller whatever the cause.
    pub is_finer: bool,
}

/// The finding on one case.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// Name of the case.
    pub case: String,
    /// Order of theory.
    pub formal_order: f64,
    /// The case as it is, all levels of the gate.
    pub judgement: Judgement,
    /// The same on the levels that are run again.
    pub finest: Judgement,
    /// Levels that are run again, by name.
    pub levels: Vec<String>,
    /// Whether particles left the grid, so that the finest levels have no error to explain.
    pub left_grid: bool,
    /// A function with a kink that the exact solution calls: theory's order is for smooth ones.
    pub kink: Option<&'static str>,
    /// The runs that change one thing.
    pub runs: Vec<ChangedRun>,
    /// Changes that were possible, and too expensive.
    pub skipped: Vec<String>,
}

impl Diagnosis {
    /// Whether the case has the order of theory, so that there is nothing to explain.
    pub fn is_sound(&self) -> bool {
        self.judgement.verdict == Verdict::Converging
    }

    /// The run that shows the cause, and what it shows. The first that restores the order, in the
    /// order of the runs; where none does the first of those that raise it most, if it is settled
    /// then; otherwise the one that takes most off the error.
    pub fn found(&self) -> Option<(&ChangedRun, Evidence)> {
        let least = self.formal_order - OrderHypothesis::TOLERANCE;
        let is_near = self.finest.verdict == Verdict::Converging;
        // An order that is nearly that of theory is restored only by one that is within its range.
        let off = |order: Option<Interval>| {
            order.map_or(f64::INFINITY, |order| (order.value - self.formal_order).abs())
        };
        let restores = |run: &&ChangedRun| {
            let is_within = run.order.is_some_and(|order| order.low >= least);
            let is_nearer = off(run.order) < off(self.finest.order);
            run.verdict == Verdict::Converging && is_nearer && (is_within || !is_near)
        };
        if let Some(run) = self.runs.iter().find(restores) {
            return Some((run, Evidence::Restored));
        }
        if is_near {
            return None;
        }
        let before = self.finest.order.map_or(0.0, |order| order.value.max(0.0));
        let settled = |run: &ChangedRun| {
            let order = run.order.filter(|order| order.half_width() <= SETTLED)?;
            (run.verdict == Verdict::TooLow && order.value >= before + RISE).then_some(order.value)
        };
        let highest = self.runs.iter().filter_map(settled).reduce(f64::max);
        let raises = |run: &&ChangedRun| {
            settled(run).zip(highest).is_some_and(|(order, most)| order >= most - ALIKE)
        };
        if let Some(run) = self.runs.iter().find(raises) {
            return Some((run, Evidence::Raised));
        }
        let falls = self.runs.iter().filter(|run| !run.is_finer && run.ratio <= FALL);
        let most = falls.min_by(|a, b| a.ratio.total_cmp(&b.ratio));
        most.map(|run| (run, Evidence::Lowered))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::order::level::Level;
    use crate::verify::verdict::judge::judge;

    /// A judgement with this verdict and order.
    fn found(verdict: Verdict, order: Interval) -> Judgement {
        let none = judge(&[Level::new(1.0, 1.0)], &OrderHypothesis::formal(2.0));
        Judgement { verdict, order: Some(order), ..none }
    }

    fn order(value: f64, half_width: f64) -> Interval {
        Interval { value, low: value - half_width, high: value + half_width }
    }

    fn diagnosis(finest: (Verdict, Interval), run: (Verdict, Interval, f64)) -> Diagnosis {
        let judgement = found(finest.0, finest.1);
        let changed = ChangedRun {
            change: String::new(),
            cause: "the cause",
            remedy: "",
            verdict: run.0,
            order: Some(run.1),
            ratio: run.2,
            is_finer: false,
        };
        Diagnosis {
            case: String::new(),
            formal_order: 2.0,
            finest: judgement.clone(),
            judgement,
            levels: Vec::new(),
            left_grid: false,
            kink: None,
            runs: vec![changed],
            skipped: Vec::new(),
        }
    }

    fn evidence(diagnosis: &Diagnosis) -> Option<Evidence> {
        diagnosis.found().map(|(_, evidence)| evidence)
    }

    use Verdict::{Converging, TooLow};

    /// 2.05 is nearer to 2 than 1.7, and 2.4 is not.
    #[test]
    fn the_order_that_is_nearer_to_theory_is_restored() {
        let to = |value| (Converging, order(value, 0.05), 0.9);
        let low = (TooLow, order(1.7, 0.05));
        assert_eq!(evidence(&diagnosis(low, to(2.05))), Some(Evidence::Restored));
        assert_eq!(evidence(&diagnosis(low, to(2.4))), None);
    }

    /// An order whose interval leaves the range of theory explains no order that was nearly right.
    #[test]
    fn an_order_nearly_right_is_restored_by_a_whole_interval() {
        let near = (Converging, order(1.95, 0.04));
        let to = |half_width| (Converging, order(2.0, half_width), 0.9);
        assert_eq!(evidence(&diagnosis(near, to(0.05))), Some(Evidence::Restored));
        assert_eq!(evidence(&diagnosis(near, to(0.15))), None);
    }

    /// Finer levels have a smaller error whatever its cause is.
    #[test]
    fn a_smaller_error_of_finer_levels_is_no_evidence() {
        let mut found = diagnosis((TooLow, order(1.0, 0.05)), (TooLow, order(1.0, 0.05), 0.25));
        assert_eq!(evidence(&found), Some(Evidence::Lowered));
        found.runs[0].is_finer = true;
        assert_eq!(evidence(&found), None);
    }
}
