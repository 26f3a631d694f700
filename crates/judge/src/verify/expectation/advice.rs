//! Compares an observed order with the expected range, and suggests stronger expectations.

use crate::verify::figure::counted;
use crate::verify::{
    Axis, Convergence, FEWEST_LEVELS, Interval, Level, LevelOutcome, NormName, OrderHypothesis,
    Verdict, format_number, judge, two_sided_95,
};

/// Maximum width of the observed interval for which the default range is proposed, as a fraction of
/// the half-width of this range.
const COMFORTABLE: f64 = 0.75;

/// Whether the default range around `order` contains the observed interval with a margin.
pub(crate) fn is_inside(observed: &Interval, order: f64) -> bool {
    let room = OrderHypothesis::TOLERANCE - (observed.value - order).abs();
    let room = room.min(COMFORTABLE * OrderHypothesis::TOLERANCE);
    2.0 * observed.half_width() <= room
}

/// Formats the default range around an order in the notation of suites.
pub(crate) fn range(order: f64) -> String {
    let (low, high) = OrderHypothesis::formal(order).range();
    format!("[{}, {}]", format_number(low), format_number(high))
}
/// Half-width of the confidence interval of an order above which more levels are suggested.
const WIDE: f64 = 0.03;

/// Lists reasons why an expectation cannot be stronger, and remedies: more levels, or another norm.
pub(crate) fn advice(study: &Convergence) -> Vec<String> {
    let mut advice = Vec::new();
    let usable = counted(&study.levels).count();
    let Some(order) = study.judgement.order else {
        if usable < FEWEST_LEVELS {
            let more = FEWEST_LEVELS - usable;
            advice.push(format!(
                "levels: an order needs {FEWEST_LEVELS} levels that count, so add {more}"
            ));
        }
        return advice;
    };
    if study.verdict() == Verdict::Converging && study.axis != Axis::Particles {
        let (formal, seen) = (range(study.formal_order), order.shown());
        if !is_inside(&order, study.formal_order) {
            advice.push(format!(
                "the order {seen} is only just within {formal}, so it is not proposed"
            ));
        }
    }
    let points = study.judgement.window.as_ref().map_or(0, Vec::len);
    if order.half_width() > WIDE && points >= FEWEST_LEVELS {
        // The width is proportional to t/sqrt(Sxx), with Sxx ~ n (n^2 - 1) for equal ratios.
        let width = |n: usize| {
            let n_f = n as f64;
            two_sided_95(n - 2) / (n_f * (n_f * n_f - 1.0)).sqrt()
        };
        let then = order.half_width() * width(points + 2) / width(points);
        advice.push(format!(
            "levels: two more would narrow the interval from -+ {:.2} to about -+ {then:.2}",
            order.half_width()
        ));
    }
    advice.extend(other_norm(study, &order));
    advice
}

/// Suggests the norm with the narrowest interval of the order, if this interval is much narrower
/// than in the judged norm.
fn other_norm(study: &Convergence, judged: &Interval) -> Option<String> {
    const CLEARLY: f64 = 0.5;
    if judged.half_width() <= WIDE {
        return None;
    }
    let (formal_order, axis) = (study.formal_order, study.axis);
    let order = |norm: NormName| {
        let level =
            |level: &LevelOutcome| Level::new(level.spacing, level.run.errors.in_norm(norm));
        let levels: Vec<Level> = counted(&study.levels).map(level).collect();
        let judgement = judge(&levels, &OrderHypothesis { formal_order, expected: None, axis });
        let order = judgement.order.filter(|_| judgement.verdict == Verdict::Converging)?;
        Some((norm, order))
    };
    let (norm, order) = NormName::ALL
        .iter()
        .copied()
        .filter(|norm| *norm != study.norm && !norm.is_by_mass())
        .filter_map(order)
        .min_by(|(_, a), (_, b)| a.half_width().total_cmp(&b.half_width()))?;
    (order.half_width() <= CLEARLY * judged.half_width()).then(|| {
        format!(
            "norm: `judge: {{norm: {}}}` has the order {} on the same levels",
            norm.name(),
            order.shown()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::convergence::tests::study;
    use rstest::rstest;

    #[rstest]
    #[case::clear(2.01, 0.01, true)]
    #[case::at_half_of_the_distance(2.08, 0.0099, true)]
    #[case::only_just(2.08, 0.0101, false)]
    #[case::certain(2.0, 0.0374, true)]
    #[case::uncertain(2.0, 0.0376, false)]
    #[case::outside(2.11, 0.0, false)]
    #[case::outside_below(1.89, 0.0, false)]
    #[case::far_below(1.0, 0.0, false)]
    #[case::nan(f64::NAN, 0.0, false)]
    #[case::no_interval(2.0, f64::NAN, false)]
    fn no_interval_is_met_only_just(
        #[case] value: f64,
        #[case] half_width: f64,
        #[case] is_met: bool,
    ) {
        let observed = Interval { value, low: value - half_width, high: value + half_width };
        assert_eq!(is_inside(&observed, 2.0), is_met);
    }

    /// Creates a study of six levels whose order has an interval of -+ 1.
    fn uncertain() -> Convergence {
        let errors: Vec<f64> = (0..6).map(|k| libm::exp2(-2.0 * f64::from(k))).collect();
        let mut study = study(&errors);
        study.judgement.order = Some(Interval { value: 2.0, low: 1.0, high: 3.0 });
        study
    }

    /// From t(4) = 2.776 and t(6) = 2.447, and Sxx ~ n (n^2 - 1) for n levels with equal ratios.
    #[test]
    fn more_levels_narrow_an_interval_as_those_of_a_line() {
        let width = 2.447 / 2.776 * (6.0 * 35.0 / (8.0 * 63.0_f64)).sqrt();
        let expected = format!(
            "levels: two more would narrow the interval from -+ 1.00 to about -+ {width:.2}"
        );
        assert!(advice(&uncertain()).contains(&expected), "{:?}", advice(&uncertain()));
    }

    #[test]
    fn a_norm_is_advised_only_if_it_converges() {
        let mut study = uncertain();
        for (k, level) in study.levels.iter_mut().enumerate() {
            level.run.errors.at_end.l1 = level.spacing;
            level.run.errors.at_end.l2 =
                level.spacing * level.spacing * (1.0 + 0.01 * (k % 2) as f64);
        }
        let advice = advice(&study);
        assert!(advice.iter().any(|line| line.contains("{norm: l2}")), "{advice:?}");
    }
}
