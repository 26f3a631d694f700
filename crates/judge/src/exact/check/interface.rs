//! Checks the interface of two bodies at points of their faces.
//!
//! Bodies with one velocity field are bonded: displacement and traction are continuous. Bodies in
//! contact do not penetrate and do not pull, and friction resists sliding.
//!
//! A formula that describes several bodies may jump at their interface. The motion at a face is
//! therefore expanded about a point 1e-9 body lengths inside the body.

use super::event::{AXES, Event, FACE_EVENTS, OnFace};
use super::friction::{InterfaceTraction, coulomb};
use super::survey::{self, Magnitudes};
use crate::exact::condition::{Condition, FacePoint};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::{LargestViolation, Violation};

/// Condition on a face next to another body, which [`meets`] checks for both bodies together.
#[derive(Debug)]
pub struct Interface;

impl Condition for Interface {
    fn check(&self, _: &dyn FacePoint) -> Result<(), Violation> {
        Ok(())
    }
}

/// Distance of the expansion point from the face, relative to the length of the body.
const INSIDE: f64 = 1e-9;

/// Checks the high face of the body `one` against the low face of the body `other` along `axis`.
/// Without `friction` the bodies are bonded. `largest` contains the scales of the residuals over
/// all bodies.
///
/// # Errors
/// The first condition that the motions violate.
pub fn meets(
    one: &Problem,
    other: &Problem,
    axis: usize,
    friction: Option<f64>,
    largest: &Magnitudes,
) -> Result<(), Violation> {
    let Magnitudes { displacement, velocity, stress, .. } = *largest;
    let pair = BodyPair { one, other, axis, sizes: [displacement, velocity, stress] };
    let on_face = OnFace::new(&one.from, &one.to, axis, true);
    let extent = on_face.extent(&survey::extent(one));
    let mut found = LargestViolation::default();
    for event in extent.spread(FACE_EVENTS, |_| true, &mut Random::new(8)) {
        found.add(match friction {
            Some(coefficient) => pair.touch(&event, coefficient),
            None => pair.go_on(&event),
        });
    }
    found.into_result()
}

/// Returns the motion on a face, expanded about a point at the depth `inside` (m) along `axis`.
fn on_face(problem: &Problem, event: &Event, axis: usize, inside: f64) -> Derivatives {
    let mut label = event.label.clone();
    label[axis] -= inside;
    let mut now = problem.motion.derivatives(&label, event.t);
    for i in 0..problem.dimension() {
        now.u[i] += now.grad[i][axis] * inside;
        now.velocity[i] += now.grad_rate[i][axis] * inside;
        for j in 0..problem.dimension() {
            now.grad[i][j] += now.second[i][j][axis] * inside;
        }
    }
    problem.complete(&event.label, &mut now);
    now
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

    fn both(&self, event: &Event) -> [Derivatives; 2] {
        let Self { one, other, axis, .. } = *self;
        let inside = |problem: &Problem| INSIDE * (problem.to[axis] - problem.from[axis]);
        let mut opposite = event.clone();
        opposite.label[axis] = other.from[axis];
        [on_face(one, event, axis, inside(one)), on_face(other, &opposite, axis, -inside(other))]
    }

    /// Returns P e on both faces, where e is the unit vector along the axis.
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
            let name = self.condition(&format!("their tractions in {} differ", AXES[i]));
            let allowed = self.one.law_tolerance() * self.sizes[2];
            event.judge(allowed, name, (here[i], there[i]), "Pa")?;
        }
        Ok(())
    }

    fn go_on(&self, event: &Event) -> Result<(), Violation> {
        let [here, there] = self.both(event);
        for i in 0..self.one.dimension() {
            let name = self.condition(&format!("their displacements u_{} differ", AXES[i]));
            let allowed = self.one.tolerance * self.sizes[0];
            event.judge(allowed, name, (here.u[i], there.u[i]), "m")?;
        }
        self.balance(event, self.forces(event, &here, &there))
    }

    fn touch(&self, event: &Event, coefficient: f64) -> Result<(), Violation> {
        let Self { one, other, axis, sizes: [displacement, velocity, stress] } = *self;
        let tolerance = one.tolerance;
        let [here, there] = self.both(event);
        let gap = other.from[axis] - one.to[axis] + (there.u[axis] - here.u[axis]);
        let allowed = tolerance * displacement;
        let name = self.condition("they overlap");
        event.judge_most(allowed, name, 0.0, -gap, "m")?;

        let forces = self.forces(event, &here, &there);
        self.balance(event, forces)?;
        let ([traction, _], pressure) = (forces, -forces[0][axis]);
        let (allowed, apart) = (one.law_tolerance() * stress, gap > allowed);
        let name = self.condition("they pull each other");
        event.judge_most(allowed, name, 0.0, -pressure, "Pa")?;
        if apart {
            let name = self.condition("they push each other without touching");
            event.judge_most(allowed, name, 0.0, pressure, "Pa")?;
        }
        let relative = std::array::from_fn(|i| here.velocity[i] - there.velocity[i]);
        let rub = InterfaceTraction { traction, velocity: relative, pressure, coefficient };
        let residuals = [allowed, tolerance * velocity];
        let surface = format!("the common face along {}", AXES[axis]);
        coulomb(event, axis, one.dimension(), &rub, residuals, &surface)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::check::survey::Survey;
    use crate::exact::tests::{assert_outcome, bar, bind, face, free};
    use crate::exact::{Motion, SmallStrainLaw};
    use rstest::rstest;
    use std::sync::Arc;

    /// Creates bars from 0 to 1 and from 1 to 2, with rho = c = 1.
    fn bars(displacement: &str) -> [Problem; 2] {
        let bar = |from: f64, [low, high]: [Arc<dyn Condition>; 2]| Problem {
            from: vec![from],
            to: vec![from + 1.0],
            density: 1.0.into(),
            equation: SmallStrainLaw::new(1.0, 0.0).into(),
            faces: vec![face("left", 0, false, low), face("right", 0, true, high)],
            until: 3.0,
            ..bar(displacement, free())
        };
        [bar(0.0, [free(), Arc::new(Interface)]), bar(1.0, [Arc::new(Interface), free()])]
    }

    fn meets_alone(one: &Problem, other: &Problem, friction: Option<f64>) -> Result<(), Violation> {
        let surveys = Survey::of_each(&[one.clone(), other.clone()]);
        meets(one, other, 0, friction, &surveys[0].largest)
    }

    /// Displacement of bars that collide with velocity 1/100 and separate after time 2.
    const BOUNCE: &str =
        "sign(1 - X)/100*(t - max(0, t - abs(X - 1)) - max(0, t - (2 - abs(X - 1))))";
    /// Displacement of bars that stay together and vibrate as one bar.
    const STICK: &str = "cos(pi*X/2)*sin(pi*t/2)/100";

    #[rstest]
    #[case::bounce(BOUNCE, Some(0.0), "")]
    #[case::stick(STICK, None, "")]
    #[case::stick_in_contact(STICK, Some(0.0), "pull each other")]
    #[case::bounce_as_one(BOUNCE, None, "displacements u_X differ")]
    #[case::pass_through("sign(1 - X)/100*t", Some(0.0), "they overlap")]
    #[case::push_from_afar(
        "sign(1 - X)/100*(0 - t/2 - max(0, t - abs(X - 1)))",
        Some(0.0),
        "without touching"
    )]
    #[case::unequal_push(
        "sign(1 - X)/100*(t - max(0, t - abs(X - 1))*(1.5 - step(X - 1)))",
        Some(0.0),
        "tractions in"
    )]
    fn two_bars(#[case] motion: &str, #[case] friction: Option<f64>, #[case] violated: &str) {
        let [one, other] = bars(motion);
        assert_outcome(meets_alone(&one, &other, friction), violated);
    }

    /// The plates have a strain of 1/100; friction with mu = 0.3 causes a shear strain of 3/500.
    #[rstest]
    #[case::together(["t/10", "t/10"], "")]
    #[case::past_each_other(["X*3/500", "t/10 + X*3/500"], "")]
    #[case::without_friction(["0", "t/10"], "traction in Y on")]
    #[case::with_too_little(["X*2.97/500", "t/10 + X*2.97/500"], "traction in Y on")]
    #[case::with_too_much(["X*3.03/500", "t/10 + X*3.03/500"], "traction in Y on")]
    #[case::driven_by_friction(["-X*3/500", "t/10 - X*3/500"], "traction in Y on")]
    #[case::held(["t/10 + X*2/500", "t/10 + X*2/500"], "")]
    #[case::held_too_well(["t/10 + X*4/500", "t/10 + X*4/500"], "at rest")]
    fn two_pressed_plates(#[case] along: [&str; 2], #[case] violated: &str) {
        let bind = |source| bind(source, &["X", "Y", "t"]);
        let [one, other] = bars("X");
        let [one, other] = [(one, along[0]), (other, along[1])].map(|(bar, along)| Problem {
            from: vec![bar.from[0], 0.0],
            to: vec![bar.to[0], 1.0],
            motion: Motion::new(vec![bind("-X/100"), bind(along)]),
            ..bar
        });
        assert_outcome(meets_alone(&one, &other, Some(0.3)), violated);
    }
}
