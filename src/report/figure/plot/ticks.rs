//! Positions and labels of ticks.

use super::scale::{Label, Scale};

/// One tick. Ticks with a label are major ticks.
#[derive(Clone, Debug)]
pub(crate) struct Tick {
    /// Position along the axis from 0 to 1.
    pub(crate) at: f64,
    pub(crate) label: Option<Label>,
}

/// Minimum length (decades) of a logarithmic axis on which powers of ten are the only labels.
const SHORT: f64 = 2.0;

/// Range of exponents in which a short logarithmic axis has plain numbers as labels.
const WRITTEN_OUT: (f64, f64) = (-3.0, 4.0);

/// Digits at which a decade has ticks.
const DIGITS: [i32; 9] = [1, 2, 3, 4, 5, 6, 7, 8, 9];

/// Number of decades above which ticks within decades would be too close together.
const TICKED_DECADES: f64 = 8.0;

/// Chooses the densest ticks whose labels do not touch on an axis of `length` pixels. `extent` is
/// the space that a label requires along the axis, including its margin.
pub(crate) fn choose(scale: &Scale, length: f64, extent: impl Fn(&Label) -> f64) -> Vec<Tick> {
    let fits = |ticks: &Vec<Tick>| {
        let major: Vec<_> = ticks
            .iter()
            .filter_map(|t| t.label.as_ref().map(|l| (t.at * length, extent(l))))
            .collect();
        major.windows(2).all(|w| w[1].0 - w[0].0 >= f64::midpoint(w[0].1, w[1].1))
    };
    let mut choices = if scale.span() < SHORT {
        short_log(scale)
    } else {
        [1, 2, 3, 4, 5, 10, 20, 50, 100, 200].map(|stride| decades(scale, stride)).to_vec()
    };
    let chosen = choices.iter().position(fits);
    choices.swap_remove(chosen.unwrap_or(choices.len() - 1))
}

/// Creates ticks at powers of ten and labels every `stride`-th one.
fn decades(scale: &Scale, stride: i32) -> Vec<Tick> {
    let within = if stride == 1 && scale.span() <= TICKED_DECADES { &DIGITS } else { &DIGITS[..1] };
    log_ticks(scale, within, |digit, power| {
        (digit == 1 && power % stride == 0).then(|| Label::power("10", power))
    })
}

/// Creates possible sets of ticks, the densest first. Labels are at 1, 2 and 5 times a power of
/// ten. If there are fewer than three such labels, more digits are labelled.
fn short_log(scale: &Scale) -> Vec<Vec<Tick>> {
    // All labels of the axis have the same notation.
    let Scale { lo, hi } = *scale;
    let written_out = lo >= WRITTEN_OUT.0 && hi <= WRITTEN_OUT.1;
    let labelled = |ticked: &[i32], shown: &[i32]| {
        log_ticks(scale, ticked, |digit, power| {
            shown.contains(&digit).then(|| short_label(digit, power, written_out))
        })
    };
    let few = labelled(&DIGITS, &[1, 2, 5]);
    let mut choices = Vec::new();
    if few.iter().filter(|t| t.label.is_some()).count() < 3 {
        choices.push(labelled(&DIGITS, &DIGITS));
        choices.push(labelled(&DIGITS, &[1, 2, 3, 5, 7]));
    }
    choices.push(few);
    choices.push(labelled(&DIGITS, &[1]));
    choices
}

fn short_label(digit: i32, power: i32, written_out: bool) -> Label {
    if written_out {
        let value = f64::from(digit) * libm::pow(10.0, f64::from(power));
        return Label::decimal(value, (-power).max(0) as usize);
    }
    match digit {
        1 => Label::power("10", power),
        _ => Label::power(&format!("{digit}×10"), power),
    }
}

fn log_ticks(
    scale: &Scale,
    digits: &[i32],
    label: impl Fn(i32, i32) -> Option<Label>,
) -> Vec<Tick> {
    let Scale { lo, hi } = *scale;
    let mut ticks = Vec::new();
    for power in libm::floor(lo) as i32..=libm::ceil(hi) as i32 {
        for &digit in digits {
            let at = scale.fraction_of_working(f64::from(power) + libm::log10(f64::from(digit)));
            // The tolerance keeps ticks that rounding places just outside the axis.
            if (-1e-9..=1.0 + 1e-9).contains(&at) {
                let label = label(digit, power);
                ticks.push(Tick { at, label });
            }
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::plot::scale::Pad;
    use rstest::rstest;

    const NONE: Pad = Pad { lo: 0.0, hi: 0.0 };

    fn labels(scale: &Scale) -> String {
        let ticks = choose(scale, 400.0, |l| l.width() + 12.0);
        assert!(ticks.windows(2).all(|w| w[0].at < w[1].at));
        let labels: Vec<_> = ticks.iter().filter_map(|t| t.label.as_ref()).collect();
        labels.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[rstest]
    #[case(0.1, 1.0, "0.1 0.2 0.5 1")]
    #[case(0.015, 0.3, "0.02 0.05 0.1 0.2")]
    #[case(0.3, 0.95, "0.3 0.4 0.5 0.6 0.7 0.8 0.9")]
    #[case(0.05, 0.2, "0.05 0.1 0.2")]
    #[case(5e-4, 2e-3, "5×10^-4 10^-3 2×10^-3")]
    #[case(0.06, 0.3, "0.07 0.1 0.2 0.3")]
    #[case(1e6, 4e6, "10^6 2×10^6 3×10^6 4×10^6")]
    #[case(30.0, 600.0, "50 100 200 500")]
    #[case(1e-7, 1e-6, "10^-7 2×10^-7 5×10^-7 10^-6")]
    #[case(0.001, 1.0, "10^-3 10^-2 10^-1 10^0")]
    #[case(1e-10, 1.0, "10^-10 10^-8 10^-6 10^-4 10^-2 10^0")]
    #[case(5e-324, f64::MAX, "10^-300 10^-200 10^-100 10^0 10^100 10^200 10^300")]
    fn log_ticks(#[case] lo: f64, #[case] hi: f64, #[case] expected: &str) {
        assert_eq!(labels(&Scale::log([lo, hi].into_iter(), NONE)), expected);
    }

    #[test]
    fn minor_ticks_are_at_the_digits() {
        let scale = Scale::log([0.01, 1.0].into_iter(), NONE);
        let ticks = choose(&scale, 400.0, Label::width);
        assert_eq!(ticks.iter().filter(|t| t.label.is_none()).count(), 16);
    }
}
