//! Proposes expectations for a suite without expectations, based on runs of the suite.
//!
//! If the observed order agrees with the formal one, the formal order is proposed. Other values are
//! taken from the run. A range is proposed only if the observed order lies inside the range, at a
//! distance of at least twice its uncertainty from either bound.

use super::advice::{advice, is_inside, range};
use crate::verify::figure::counted;
use crate::verify::{Axis, Conserved, Convergence, LevelOutcome, Verdict, format_number, larger};
use mpm_subject::named;

/// Maximum drift that is explained by rounding of the sums.
const ROUNDING: f64 = 1e-11;

/// Minimum ratio of a proposed bound to the measured drift. On another processor, sums may be
/// computed in a different order, with different rounding errors.
const ROOM_OF_DRIFT: f64 = 30.0;

/// Ratio of a proposed error bound to the largest measured error.
const ROOM_OF_ERROR: f64 = 2.0;

named! {
    /// Origin of a proposed expectation.
    pub enum Ground {
        /// The formal order, or a conservation law.
        Theory = "theory",
        /// Measured values of the run.
        Run = "the run",
    }
}

/// One key of a proposed entry of `expect`.
#[derive(Debug, Clone, PartialEq)]
pub struct ProposedKey {
    /// Key and value in the notation of suites.
    pub text: String,
    /// Origin of the value.
    pub ground: Ground,
}

/// A proposed entry of `expect` for one case.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// Keys other than `case` and `because`.
    pub keys: Vec<ProposedKey>,
    /// Reason for the expectation; without theory, the author of the suite must complete the text.
    pub because: String,
    /// Verdict and measured values of the run.
    pub seen: String,
    /// Reasons why the expectation is not stronger, and ways to obtain a stronger one.
    pub stronger: Vec<String>,
}

struct ProposedOrder {
    key: String,
    ground: Ground,
    because: String,
}

/// Proposes an entry of `expect` that agrees with the results of a case.
pub fn propose(study: &Convergence) -> Proposal {
    let claim = claim(study).filter(|_| study.compared);
    let is_claimed = claim.is_some();
    let mut keys = Vec::new();
    let because = match claim {
        Some(ProposedOrder { key, ground, because }) => {
            keys.push(ProposedKey { text: key, ground });
            because
        }
        None if study.compared => {
            "from the run: bounds that the results meet, without a claim about the order; state the \
             reason, or correct the suite"
                .to_owned()
        }
        None => "conserved sums; errors are not compared".to_owned(),
    };
    let from_run = |text| ProposedKey { text, ground: Ground::Run };
    keys.extend(crossings(study).map(from_run));
    keys.extend(floor(study).map(from_run));
    if study.compared && !is_claimed {
        keys.extend(error_bound(study).map(from_run));
    }
    keys.extend(drifts(study));
    let stronger = if study.compared { advice(study) } else { Vec::new() };
    Proposal { keys, because, seen: seen(study), stronger }
}

fn seen(study: &Convergence) -> String {
    let order = study.judgement.order.map(|order| format!("; order {}", order.shown()));
    format!("{}{}", study.verdict(), order.unwrap_or_default())
}

/// Returns the verdict or order to propose; `None` if another run might not meet it.
fn claim(study: &Convergence) -> Option<ProposedOrder> {
    let formal = study.formal_order;
    let theory = match study.axis {
        Axis::Particles => "theory gives no order for particles per cell".to_owned(),
        axis => format!("theory gives the order {} in {}", format_number(formal), axis.name()),
    };
    let verdict = |word: &str| ProposedOrder {
        key: format!("verdict: {word}"),
        ground: Ground::Run,
        because: format!(
            "from the run; {theory}; state why this case differs, or correct the suite"
        ),
    };
    let within = |order: f64, ground, because| ProposedOrder {
        key: format!("order: {}", range(order)),
        ground,
        because,
    };
    match study.verdict() {
        Verdict::Converging | Verdict::TooLow | Verdict::TooGood => {
            let observed = study.judgement.order?;
            if study.axis != Axis::Particles && is_inside(&observed, formal) {
                return Some(within(formal, Ground::Theory, theory));
            }
            let nearest = (2.0 * observed.value).round() / 2.0;
            if nearest > 0.0 && is_inside(&observed, nearest) {
                let because = format!("from the run; {theory}; state why it differs here");
                return Some(within(nearest, Ground::Run, because));
            }
            (study.verdict() == Verdict::TooLow).then(|| verdict("too_low"))
        }
        Verdict::AtFloor => Some(verdict("at_floor")),
        Verdict::Oscillatory => Some(verdict("oscillatory")),
        Verdict::Divergent => Some(verdict("divergent")),
        Verdict::Failed => Some(verdict("failed")),
        Verdict::PreAsymptotic | Verdict::TooFewLevels => None,
    }
}

fn crossings(study: &Convergence) -> Option<String> {
    let crossings = study.levels.last()?.run.counters.crossings?;
    (study.compared && study.verdict() != Verdict::Failed)
        .then(|| format!("crossings: {}", if crossings > 0 { "some" } else { "none" }))
}

fn floor(study: &Convergence) -> Option<String> {
    let cause = study.floor.as_ref()?.cause()?;
    Some(format!("floor: {}", cause.name()))
}

fn error_bound(study: &Convergence) -> Option<String> {
    let largest = counted(&study.levels).map(|level| level.error).reduce(larger)?;
    let bound = rounded_up(ROOM_OF_ERROR * largest);
    (bound > 0.0 && bound.is_finite()).then(|| format!("error_below: {bound:e}"))
}

/// Rounds a number up to one significant digit.
fn rounded_up(value: f64) -> f64 {
    let text = format!("{value:.0e}");
    let nearest: f64 = text.parse().unwrap_or(value);
    if nearest >= value {
        return nearest;
    }
    let (digit, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digit: u32 = digit.parse().unwrap_or(9);
    format!("{}e{exponent}", digit + 1).parse().unwrap_or(value)
}

/// Proposes bounds on conserved sums. Only a bound on mass follows from theory: particles have
/// constant masses in every method.
fn drifts(study: &Convergence) -> Vec<ProposedKey> {
    let worst = |sum: Conserved| {
        let drift = |level: &LevelOutcome| level.run.drift.map(|drift| drift.of(sum));
        let all: Option<Vec<f64>> = counted(&study.levels).map(drift).collect();
        all?.into_iter().reduce(larger)
    };
    let kept = |sum: &&Conserved| worst(**sum).is_some_and(|drift| drift <= ROUNDING);
    let (mass, others): (Vec<Conserved>, Vec<Conserved>) =
        study.drifts.iter().filter(kept).partition(|sum| **sum == Conserved::Mass);
    let bound = |sum: &Conserved| {
        let drift = worst(*sum).unwrap_or(f64::NAN).max(f64::EPSILON);
        let decade = libm::ceil(libm::log10(ROOM_OF_DRIFT * drift)) as i32;
        format!("{}: 1e{decade}", sum.name())
    };
    let bounds: Vec<String> = mass.iter().chain(&others).map(bound).collect();
    if bounds.is_empty() {
        return Vec::new();
    }
    let ground = if others.is_empty() { Ground::Theory } else { Ground::Run };
    vec![ProposedKey { text: format!("drift: {{{}}}", bounds.join(", ")), ground }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::conservation::Balance;
    use crate::verify::convergence::tests::study;
    use mpm_subject::Totals;

    #[test]
    fn bounds_have_one_digit_and_hold() {
        assert_eq!([1e-3, 1.01e-3, 9.6e-4, 0.0].map(rounded_up), [1e-3, 2e-3, 1e-3, 0.0]);
    }

    fn keys(study: &Convergence) -> Vec<String> {
        propose(study).keys.into_iter().map(|key| key.text).collect()
    }

    #[test]
    fn orders_go_by_halves() {
        let halves = |order: f64| {
            let error = |k: i32| libm::exp2(-order * f64::from(k));
            keys(&study(&(0..5).map(error).collect::<Vec<_>>()))
        };
        assert_eq!(halves(2.0), ["order: [1.9, 2.1]"]);
        assert_eq!(halves(1.5), ["order: [1.4, 1.6]"]);
        assert_eq!(halves(1.25), ["verdict: too_low"]);
    }

    #[test]
    fn crossings_are_proposed_of_runs_that_end() {
        let mut study = study(&[1.0, 0.25, 0.0625, 0.015_625]);
        for level in &mut study.levels {
            level.run.counters.crossings = Some(3);
        }
        assert_eq!(keys(&study), ["order: [1.9, 2.1]", "crossings: some"]);
        study.judgement.verdict = Verdict::Failed;
        assert_eq!(keys(&study), ["verdict: failed"]);
    }

    /// 30 times the largest drift of a level that counts is rounded up to a power of ten.
    #[test]
    fn proposed_bounds_have_a_margin() {
        let mut study = study(&[1.0, 0.25, 0.0625, 0.015_625]);
        study.drifts = vec![Conserved::Momentum, Conserved::Mass, Conserved::KineticEnergy];
        let start =
            Totals { mass: 1e6, momentum_size: 1e-6, kinetic_energy: 1.0, ..Totals::default() };
        for (level, drift) in study.levels.iter_mut().zip([1e-14, 1e-13, 1e-15, 1e-3]) {
            let mut balance = Balance::start(start);
            let momentum = [0.0, 0.04 * drift * 1e-6, 0.0];
            let kinetic_energy = 1.0 - 110.0 * drift;
            balance.look(Some(&Totals {
                mass: 1e6 * (1.0 - drift),
                momentum,
                kinetic_energy,
                ..start
            }));
            level.run.drift = Some(balance.drift());
        }
        study.levels[3].usable = false;
        let drift = "drift: {mass: 1e-11, momentum: 1e-12}";
        assert_eq!(keys(&study), ["order: [1.9, 2.1]", drift]);
        // Without an order, errors are bounded by twice the largest one of a level that counts.
        study.judgement.verdict = Verdict::TooFewLevels;
        study.levels[0].error = 1.2e-6;
        study.levels[1].error = 1.6e-6;
        study.levels[2].error = 1e-6;
        assert_eq!(keys(&study), ["error_below: 4e-6", drift]);
    }
}
