//! The requirement of `run --gate`, checked on random series.

use super::{Random, halvings};
use mpm_verify::verify::{
    Acceptance, Axis, Interval, Judgement, OrderHypothesis, Requirement, Unmet, Verdict, judge,
};
use proptest::prelude::*;

/// Errors at or below this bound count as rounding errors.
const ROUNDING: f64 = 1e-12;

/// Kinds of series whose errors do not fall with the number of levels.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Constant,
    Random,
    Growing,
    SlowFall,
    RoundingOnTheLastLevel,
    NotANumber,
    ZeroSomewhere,
}

fn kind() -> impl Strategy<Value = Kind> {
    use Kind::{
        Constant, Growing, NotANumber, Random, RoundingOnTheLastLevel, SlowFall, ZeroSomewhere,
    };
    let kinds =
        [Constant, Random, Growing, SlowFall, RoundingOnTheLastLevel, NotANumber, ZeroSomewhere];
    prop::sample::select(kinds.to_vec())
}

/// Creates four to nine errors of this kind, of any magnitude above rounding.
fn errors(kind: Kind, random: &mut Random) -> Vec<f64> {
    let levels = random.between(4.0, 10.0) as usize;
    let size = libm::exp(random.between(-20.0, 20.0));
    let error = |k: usize, random: &mut Random| match kind {
        Kind::Constant => size,
        Kind::Growing => size * libm::exp2(0.7 * k as f64),
        Kind::SlowFall => size * libm::pow(0.9, k as f64),
        _ => size * random.between(0.5, 1.0),
    };
    let mut errors: Vec<f64> = (0..levels).map(|k| error(k, random)).collect();
    match kind {
        Kind::RoundingOnTheLastLevel => errors[levels - 1] = ROUNDING * random.uniform(),
        Kind::NotANumber => errors[random.between(0.0, levels as f64) as usize] = f64::NAN,
        Kind::ZeroSomewhere => errors[random.between(0.0, levels as f64) as usize] = 0.0,
        _ => (),
    }
    errors
}

fn requirement(order: f64) -> Requirement {
    Requirement {
        order: Some(order),
        error_below: None,
        own_error_below: None,
        because: String::new(),
    }
}

fn check(
    required: &Requirement,
    errors: &[f64],
    forge: impl Fn(&mut Judgement),
) -> Result<Acceptance, Unmet> {
    let levels = halvings(errors);
    let mut judgement = judge(&levels, &OrderHypothesis::formal(required.order.unwrap_or(2.0)));
    forge(&mut judgement);
    required.check(&levels, Axis::Space, &judgement, ROUNDING)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3000) })]

    #[test]
    fn errors_that_do_not_fall_never_pass(kind in kind(), seed in 1_u64..u64::MAX, order in 1.0..4.0_f64) {
        let errors = errors(kind, &mut Random(seed));
        let result = check(&requirement(order), &errors, |_| ());
        prop_assert!(result.is_err(), "{:?} {:?}", errors, result);
        let own = Requirement { own_error_below: Some(ROUNDING), ..requirement(order) };
        let result = check(&own, &errors, |_| ());
        prop_assert!(result.is_err(), "{:?} {:?}", errors, result);
    }

    #[test]
    fn growing_errors_and_failed_levels_never_pass_for_any_interval(
        kind in prop::sample::select(vec![Kind::Constant, Kind::Growing, Kind::NotANumber]),
        seed in 1_u64..u64::MAX,
        low in -20.0..50.0_f64,
        width in 0.0..50.0_f64,
    ) {
        let errors = errors(kind, &mut Random(seed));
        let result = check(&requirement(2.0), &errors, |judgement| {
            judgement.verdict = Verdict::Converging;
            judgement.order = Some(Interval { value: low + 0.5 * width, low, high: low + width });
        });
        prop_assert!(result.is_err(), "{:?} {:?}", errors, result);
    }

    #[test]
    fn errors_that_fall_to_rounding_pass(seed in 1_u64..u64::MAX, order in 1.0..4.0_f64, coarse in 0_i32..9) {
        let mut random = Random(seed);
        let errors: Vec<f64> = (0..coarse + 2)
            .map(|k| if k < coarse {
                libm::exp2(-order * f64::from(k))
            } else {
                ROUNDING * random.uniform()
            })
            .collect();
        let result = check(&requirement(order), &errors, |_| ());
        prop_assert!(result.is_ok(), "{:?} {:?}", errors, result);
    }
}
