//! Two bodies face to face, checked at points of the faces.
//!
//! Bodies that share one velocity field are one: displacement and traction go on across the faces.
//! Bodies in contact do not enter each other and do not pull; they push only where they touch, with
//! equal and opposite tractions, and what slides is resisted by friction.
//!
//! One formula may speak of several bodies and jump where they meet: each is looked at from its own
//! inside, a billionth of its length from the face.

use super::friction::{InterfaceTraction, coulomb};
use super::pointwise::{AXES, Event, POINTS, largest, scale, stress};
use crate::exact::condition::{Condition, FacePoint};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// The condition on a face where another body is; [`meets`] holds the two against each other.
#[derive(Debug)]
pub struct Interface;

impl Condition for Interface {
    fn check(&self, _: &dyn FacePoint) -> Result<(), Violation> {
        Ok(())
    }
}

/// How far inside a face is looked at, in lengths of the body.
const INSIDE: f64 = 1e-9;

/// Holds the high face of `one` on `axis` against the low face of `other`, which lies opposite: in
/// contact with a coefficient of friction, or, without one, as one body.
///
/// # Errors
/// The first condition that the motions violate.
pub fn meets(
    one: &Problem,
    other: &Problem,
    axis: usize,
    friction: Option<f64>,
) -> Result<(), Violation> {
    let pair = BodyPair { one, other, axis, sizes: sizes(one, other) };
    let mut random = Random::new(8);
    for _ in 0..POINTS {
        let label = random.point(&one.from, &one.to);
        let t = one.moment(&mut random);
        match friction {
            Some(coefficient) => pair.touch(label, t, coefficient)?,
            None => pair.go_on(label, t)?,
        }
    }
    Ok(())
}

/// Largest displacement (m), velocity (m/s) and stress (Pa) of the two.
fn sizes(one: &Problem, other: &Problem) -> [f64; 3] {
    let of = |problem: &Problem| {
        [
            scale(problem, |_, d| largest(&d.u)),
            scale(problem, |_, d| largest(&d.velocity)),
            stress(problem),
        ]
    };
    let (a, b) = (of(one), of(other));
    // A sum is NaN if one of the two is.
    std::array::from_fn(|i| a[i] + b[i])
}

struct BodyPair<'a> {
    one: &'a Problem,
    other: &'a Problem,
    axis: usize,
    sizes: [f64; 3],
}

impl BodyPair<'_> {
    fn condition(&self, what: &str) -> String {
        format!("where two bodies meet along {}, {what}", AXES[self.axis])
    }

    /// Both bodies next to the faces, and the event on the face.
    fn both(&self, mut label: Vec<f64>, t: f64) -> (Event, Derivatives, Derivatives) {
        let Self { one, other, axis, .. } = *self;
        let inside = |problem: &Problem| INSIDE * (problem.to[axis] - problem.from[axis]);
        label[axis] = one.to[axis] - inside(one);
        let here = one.derivatives(&label, t);
        label[axis] = other.from[axis] + inside(other);
        let there = other.derivatives(&label, t);
        label[axis] = one.to[axis];
        (Event { label, t }, here, there)
    }

    /// P e on the two faces, e being the direction of the axis.
    fn forces(&self, event: &Event, here: &Derivatives, there: &Derivatives) -> [[f64; 3]; 2] {
        let of = |problem: &Problem, face: f64, now: &Derivatives| {
            let mut label = event.label.clone();
            label[self.axis] = face;
            let piola = problem.piola(&label, event.t, now);
            std::array::from_fn(|i| piola[i][self.axis])
        };
        let Self { one, other, axis, .. } = *self;
        [of(one, one.to[axis], here), of(other, other.from[axis], there)]
    }

    fn balance(&self, event: &Event, [here, there]: [[f64; 3]; 2]) -> Result<(), Violation> {
        for i in 0..self.one.dimension() {
            let name = self.condition(&format!("the same traction in {} on both,", AXES[i]));
            let allowed = self.one.law_tolerance() * self.sizes[2];
            event.judge(allowed, name, (here[i], there[i]), "Pa")?;
        }
        Ok(())
    }

    fn go_on(&self, label: Vec<f64>, t: f64) -> Result<(), Violation> {
        let (event, here, there) = self.both(label, t);
        for i in 0..self.one.dimension() {
            let name = self.condition(&format!("the same u_{} on both,", AXES[i]));
            let allowed = self.one.tolerance * self.sizes[0];
            event.judge(allowed, name, (here.u[i], there.u[i]), "m")?;
        }
        self.balance(&event, self.forces(&event, &here, &there))
    }

    fn touch(&self, label: Vec<f64>, t: f64, coefficient: f64) -> Result<(), Violation> {
        let Self { one, other, axis, sizes: [displacement, velocity, stress] } = *self;
        let tolerance = one.tolerance;
        let (event, here, there) = self.both(label, t);
        let gap = other.from[axis] - one.to[axis] + (there.u[axis] - here.u[axis]);
        let allowed = tolerance * displacement;
        let name = self.condition("of which none enters the other, overlap");
        event.judge_most(allowed, name, (0.0, -gap), "m")?;

        let forces = self.forces(&event, &here, &there);
        self.balance(&event, forces)?;
        let ([traction, _], pressure) = (forces, -forces[0][axis]);
        let (allowed, apart) = (one.law_tolerance() * stress, gap > allowed);
        let name = self.condition("and do not pull each other, traction");
        event.judge_most(allowed, name, (0.0, -pressure), "Pa")?;
        if apart {
            let name = self.condition("push each other only where they touch, pressure");
            event.judge_most(allowed, name, (0.0, pressure), "Pa")?;
        }
        let relative = std::array::from_fn(|i| here.velocity[i] - there.velocity[i]);
        let rub = InterfaceTraction { traction, velocity: relative, pressure, coefficient };
        let residuals = [allowed, tolerance * velocity];
        coulomb(&event, (axis, one.dimension()), &rub, residuals, |what| {
            self.condition(&format!("with friction, {what}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::formula::{Expr, Formula, Scope};
    use crate::exact::tests::free;
    use crate::exact::{Face, InitialStress, Motion, SmallStrainLaw};
    use crate::subject::PlaneState;
    use rstest::rstest;
    use std::sync::Arc;

    /// Bars from 0 to 1 and from 1 to 2, with rho = c = 1.
    fn bars(displacement: &str) -> [Problem; 2] {
        let expr = Expr::parse(displacement).unwrap();
        let bind = || Formula::bind(&expr, &Scope::new(), &["X", "t"]).unwrap();
        let face = |name, high, condition| Face { name, axis: 0, high, period: 1.0, condition };
        let bar = |from: f64, ends: [Arc<dyn Condition>; 2]| {
            let [low, high] = ends;
            Problem {
                heat: None,
                from: vec![from],
                to: vec![from + 1.0],
                outline: None,
                plane: PlaneState::Strain,
                density: 1.0,
                equation: SmallStrainLaw::new(1.0, 0.0).into(),
                terms: Vec::new(),
                at_rest: false,
                manufactured: false,
                faces: vec![face("left", false, low), face("right", true, high)],
                follows_motion: true,
                bodies: Vec::new(),
                initial_stress: InitialStress::default(),
                initial_displacement: Vec::new(),
                initial_velocity: Vec::new(),
                until: 3.0,
                motion: Motion::new(vec![bind()]),
                tolerance: 1e-8,
                linearised: None,
                shared_forces: None,
            }
        };
        [bar(0.0, [free(), Arc::new(Interface)]), bar(1.0, [Arc::new(Interface), free()])]
    }

    /// The bars run into each other with velocity 1/100 and part after 2.
    const BOUNCE: &str =
        "sign(1 - X)/100*(t - max(0, t - abs(X - 1)) - max(0, t - (2 - abs(X - 1))))";
    /// They stay together, as one bar that vibrates.
    const STICK: &str = "cos(pi*X/2)*sin(pi*t/2)/100";

    #[rstest]
    #[case::bounce(BOUNCE, Some(0.0), "")]
    #[case::stick(STICK, None, "")]
    #[case::stick_in_contact(STICK, Some(0.0), "do not pull each other")]
    #[case::bounce_as_one(BOUNCE, None, "the same u_X")]
    #[case::pass_through("sign(1 - X)/100*t", Some(0.0), "none enters the other")]
    #[case::push_from_afar(
        "sign(1 - X)/100*(0 - t/2 - max(0, t - abs(X - 1)))",
        Some(0.0),
        "only where they touch"
    )]
    #[case::unequal_push(
        "sign(1 - X)/100*(t - max(0, t - abs(X - 1))*(1.5 - step(X - 1)))",
        Some(0.0),
        "the same traction"
    )]
    fn two_bars(#[case] motion: &str, #[case] friction: Option<f64>, #[case] violated: &str) {
        let [one, other] = bars(motion);
        match meets(&one, &other, 0, friction) {
            Ok(()) => assert!(violated.is_empty(), "`{violated}` was not seen"),
            Err(found) if violated.is_empty() => panic!("{found}"),
            Err(found) => assert!(found.condition.contains(violated), "{found}"),
        }
    }

    /// Plates that are pressed together by 1/100 and move along their common face, each with its
    /// velocity; at mu = 0.3 friction shears them by 3/500.
    #[rstest]
    #[case::together(["t/10", "t/10"], "")]
    #[case::past_each_other(["X*3/500", "t/10 + X*3/500"], "")]
    #[case::without_friction(["0", "t/10"], "traction in Y against the velocity")]
    #[case::with_too_little(["X*2.97/500", "t/10 + X*2.97/500"], "traction in Y against")]
    #[case::with_too_much(["X*3.03/500", "t/10 + X*3.03/500"], "traction in Y against")]
    #[case::driven_by_friction(["-X*3/500", "t/10 - X*3/500"], "traction in Y against")]
    #[case::held(["t/10 + X*2/500", "t/10 + X*2/500"], "")]
    #[case::held_too_well(["t/10 + X*4/500", "t/10 + X*4/500"], "a face that rests")]
    fn two_pressed_plates(#[case] along: [&str; 2], #[case] violated: &str) {
        let bind = |source: &str| {
            let expr = Expr::parse(source).unwrap();
            Formula::bind(&expr, &Scope::new(), &["X", "Y", "t"]).unwrap()
        };
        let [one, other] = bars("X");
        let [one, other] = [(one, along[0]), (other, along[1])].map(|(bar, along)| Problem {
            from: vec![bar.from[0], 0.0],
            to: vec![bar.to[0], 1.0],
            motion: Motion::new(vec![bind("-X/100"), bind(along)]),
            ..bar
        });
        let found = meets(&one, &other, 0, Some(0.3)).map_err(|found| found.condition);
        match found {
            Ok(()) => assert!(violated.is_empty(), "`{violated}` was not seen"),
            Err(found) => assert!(!violated.is_empty() && found.contains(violated), "{found}"),
        }
    }

    #[test]
    fn the_bars_are_sound_each_for_itself() {
        for bar in bars(BOUNCE) {
            bar.check().unwrap();
        }
    }
}
