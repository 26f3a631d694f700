//! Laws with a memory are known to the truth for loading that never reverses: that it does not is
//! checked here.

use super::survey::{Survey, SurveyPoint};
use crate::exact::problem::Problem;
use crate::exact::violation::Violation;

/// In uniaxial strain: where the body flows, the stretch never turns back.
pub(crate) fn monotone(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    if !problem.equation.has_history() {
        return Ok(());
    }
    for SurveyPoint { event, now, .. } in &survey.points {
        if !problem.equation.flows(now.grad[0][0]) {
            continue;
        }
        let outwards = if now.grad[0][0] < 0.0 { -1.0 } else { 1.0 };
        let back = (outwards * now.grad_rate[0][0]).min(0.0);
        let allowed = problem.tolerance * now.grad[0][0].abs() / problem.until;
        let name = "the demand that loading never reverses where the body flows: \
                    the rate du_X/dX dt, where it turns back,"
            .to_owned();
        event.judge(allowed, name, (0.0, back), "1/s")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::J2Law;
    use crate::exact::tests::{bar, free};
    use rstest::rstest;

    /// The bar flows beyond a strain of 0.01, and turns back at half of the time.
    #[rstest]
    #[case::pulled("0.05*X*t", true)]
    #[case::pressed("-0.05*X*t", true)]
    #[case::swings_elastically("0.004*X*sin(20*t)", true)]
    #[case::pulled_and_let_go("0.1*X*(0.1 + t*(1 - t))", false)]
    #[case::pressed_and_let_go("-0.1*X*(0.1 + t*(1 - t))", false)]
    fn what_flows_does_not_turn_back(#[case] displacement: &str, #[case] passes: bool) {
        let equation = J2Law::new(2.0, 0.0, 0.02, 0.1).into();
        let problem = Problem { equation, ..bar(displacement, free()) };
        assert_eq!(monotone(&problem, &Survey::of(&problem)).is_ok(), passes);
    }
}
