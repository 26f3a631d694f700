//! Paths and mistakes of soils: yield, flow, edges, the apex, objectivity and the number of steps.

use super::{
    AFTER, COMPRESSION, LawCause, Laws, Leg, SHEAR, StrainGradient, StrainPath, YOUNG, examine,
};
use crate::testing::doctor::prelude::*;
use crate::testing::doctor::scene::{FRICTION, FRICTION_ANGLE};

pub(in super::super) const SOILS: Examination = Examination {
    name: "soils",
    expected: "in compression, extension, shear and rotation, the column `stress` agrees with the \
               soil law, for one large step and for many small steps",
    after: AFTER,
    covers: &["laws: drucker_prager", "laws: mohr_coulomb"],
    examine: |patient| examine(patient, &SOIL),
};

/// Uniaxial extension whose elastic stress lies beyond the apex of the yield surface.
const EXTENSION: StrainGradient = [[0.000_15, 0.0, 0.0], [0.0; 3], [0.0; 3]];
/// Three different strains. The middle principal stress is in the plane.
const UNEQUAL: StrainGradient = [[-0.000_75, 0.0, 0.0], [0.0, -0.000_1, 0.0], [0.0, 0.0, 0.000_1]];
/// Compression to 0.97 along X and a rotation by 0.4 rad: the cosine is 0.921061 and the sine
/// 0.389418.
const ROTATION: StrainGradient =
    [[0.921_061 * 0.97 - 1.0, -0.389_418, 0.0], [0.389_418 * 0.97, 0.921_061 - 1.0, 0.0], [0.0; 3]];

/// Maximum error on the path with a rotation. Affine transfers change a rotation in their first
/// step, and explicit rates have a strain of its square in each step: an error of 0.2 in 20 steps.
const NEAR_WITH_ROTATION: f64 = 0.1;

/// Sets the strength (Pa). The soil yields at a tenth of the final strain of a path.
const SOFT_SOIL: fn(&mut BoxScene) = |scene| scene.strength = YOUNG / 60_000.0;
const STRONG_SOIL: fn(&mut BoxScene) = |scene| scene.strength = YOUNG / 1500.0;
const WITHOUT_DILATION: fn(&mut BoxScene) = |scene| {
    SOFT_SOIL(scene);
    scene.dilation = 0.0;
};
const WITHOUT_FRICTION: fn(&mut BoxScene) = |scene| {
    WITHOUT_DILATION(scene);
    scene.friction = 0.0;
};

const SOIL: Laws = Laws {
    names: &["drucker_prager", "mohr_coulomb"],
    dimensions: &[2, 3, 1],
    measures: [1.0, 0.5],
    paths: &[
        StrainPath::new("compression in one step", COMPRESSION, SOFT_SOIL).steps(1),
        StrainPath::new("compression", COMPRESSION, SOFT_SOIL),
        StrainPath::new("shear", SHEAR, SOFT_SOIL),
        StrainPath::new("extension beyond the apex", EXTENSION, SOFT_SOIL).cause(APEX),
        StrainPath::new("compression without dilation", COMPRESSION, WITHOUT_DILATION),
        StrainPath::new("extension without dilation", EXTENSION, WITHOUT_DILATION).cause(APEX),
        StrainPath::new("extension without dilation in one step", EXTENSION, WITHOUT_DILATION)
            .steps(1)
            .cause(APEX),
        StrainPath::new("compression without friction", COMPRESSION, WITHOUT_FRICTION),
        StrainPath::new("extension without friction", EXTENSION, WITHOUT_FRICTION),
        StrainPath::new(UNEQUAL_STRAINS, UNEQUAL, SOFT_SOIL).everywhere(),
        StrainPath {
            bound: Some(NEAR_WITH_ROTATION),
            steps: 100,
            ..StrainPath::new("compression with a rotation by 0.4", ROTATION, STRONG_SOIL)
        }
        .cause(NOT_OBJECTIVE),
    ],
    mistakes: &[
        (|scene| scene.law = "hencky", 1.0, DOES_NOT_YIELD),
        (|scene| scene.dilation = 1.0, 1.0, ASSOCIATED),
        (|scene| scene.dilation = 0.0, 1.0, NO_DILATION),
    ],
    otherwise,
};

const UNEQUAL_STRAINS: &str = "unequal strains";

/// Returns the finding on a wrong stress that is neither elastic nor that of another dilation.
fn otherwise(leg: &Leg, legs: &[Leg], depends_on_steps: bool) -> LawCause {
    let is_compression = leg.path.gradient == COMPRESSION;
    let face_is_right = legs.iter().any(|leg| leg.path.name == "shear" && !leg.is_wrong());
    // The stress of a Mohr-Coulomb soil is on an edge in compression, and on a face in shear.
    if is_compression && leg.scene.law == "mohr_coulomb" && face_is_right {
        EDGE
    } else if depends_on_steps {
        STEPS_MATTER
    } else if leg.path.name == UNEQUAL_STRAINS {
        MIDDLE_STRESS
    } else if is_compression && is_on_surface(leg) == Some(true) {
        FLOW_POINT
    } else {
        YIELD_SURFACE
    }
}

const FLOW: &str = "the flow potential, which contains the dilation in place of the friction; the \
                    volumetric part of the return, which is K times the dilation";
const DOES_NOT_YIELD: LawCause = (
    "soil-does-not-yield",
    "the stress stays elastic beyond the yield surface",
    "the yield function; the units of the strength; the signs: the mean stress p and principal \
     stresses are positive in tension",
);
const ASSOCIATED: LawCause = (
    "soil-flow-direction",
    "the plastic flow is associated: the dilation equals the friction",
    FLOW,
);
const NO_DILATION: LawCause = ("soil-flow-direction", "the plastic flow is without dilation", FLOW);
const FLOW_POINT: LawCause =
    ("soil-flow-direction", "the stress is on the yield surface, but at the wrong point", FLOW);
const STEPS_MATTER: LawCause = (
    "soil-depends-on-steps",
    "the stress depends on the number of steps, although the strain path is straight. The return \
     mapping stops before the stress reaches the yield surface, or uses the flow direction at the \
     start of the step",
    "the return mapping, which must give a stress on the yield surface at the end of a step of any \
     size",
);
const YIELD_SURFACE: LawCause = (
    "soil-yield-surface",
    "the stress is not on the yield surface of the problem: wrong coefficient, wrong strength, a \
     strength that changes, wrong sign of the mean stress, or angles in wrong units",
    "the yield function: sqrt(J2) + eta p = k with p positive in tension (Drucker-Prager); (t1 - \
     t3) + (t1 + t3) sin(phi) = 2 c cos(phi) with angles in degrees (Mohr-Coulomb)",
);
const EDGE: LawCause = (
    "soil-edge",
    "the return to a face of the yield surface is correct, but the return to an edge, where two \
     principal stresses are equal, is wrong",
    "the return to both planes of the edge, with two plastic multipliers; the choice of the edge; \
     after the return, no yield function may be positive",
);
const APEX: LawCause = (
    "soil-apex",
    "in tension, the return mapping does not end at the apex of the yield surface, or the strength \
     is wrong",
    "the return to the apex, p = k/eta (Drucker-Prager) or p = c cot(phi) (Mohr-Coulomb), which is \
     required if the return to the cone or to an edge would reverse the deviator. It must not \
     divide by the dilation, which may be zero",
);
const MIDDLE_STRESS: LawCause = (
    "soil-middle-stress",
    "stresses are correct in compression and shear, but wrong if three principal strains differ: \
     the return mapping keeps or exchanges the middle principal stress",
    "the return to a face of the yield surface, which changes all three principal stresses: with \
     dilation, the middle one by lambda times the plastic volume strain; the order of principal \
     stresses and directions",
);
const NOT_OBJECTIVE: LawCause = (
    "soil-not-objective",
    "the stress is correct without rotation, but wrong with rotation: the elastic strain or the \
     plastic state does not rotate with the body",
    "the elastic strain b_e = F Cp^-1 F^T, with Cp^-1 in the reference axes; for laws in rate form, \
     an objective stress rate",
);

/// Whether the measured stress of a uniaxial strain path is on the yield surface, with a tolerance
/// for rounded parameters. `None` in one dimension, where the lateral stress is unknown.
fn is_on_surface(leg: &Leg) -> Option<bool> {
    let (d, scene) = (leg.scene.dimension, &leg.scene);
    if d == 1 {
        return None;
    }
    let j = 1.0 + scene.velocity.gradient[0][0];
    let (axial, lateral) = (j * leg.stress[0], j * leg.stress[d + 1]);
    let (one, other) = if scene.law == "drucker_prager" {
        let shear = (axial - lateral).abs() / 3.0_f64.sqrt();
        (shear, FRICTION * scene.friction * (axial + 2.0 * lateral) / 3.0 - scene.strength)
    } else {
        let (sin, cos) = libm::sincos((FRICTION_ANGLE * scene.friction).to_radians());
        (lateral - axial, (lateral + axial) * sin - 2.0 * scene.strength * cos)
    };
    Some((one + other).abs() <= leg.bound * (one.abs() + other.abs()))
}

#[cfg(test)]
mod tests {
    use super::super::{STEPS, expected, finding};
    use super::*;
    use crate::testing::doctor::scene::Kind;
    use rstest::rstest;

    fn soil(kind: Kind, steps: u64) -> BoxScene {
        SOIL.paths[1].steps(steps).scene(kind)
    }

    fn compression(law: &'static str, change: fn(&mut BoxScene)) -> Leg {
        let scene = soil((2, law), STEPS);
        let mut changed = scene.clone();
        change(&mut changed);
        let of = |scene: &BoxScene| expected(scene).unwrap_or_else(|_| panic!("it fails"));
        let (stress, expected) = (of(&changed), of(&scene));
        Leg { path: SOIL.paths[1], stress, expected, scene, bound: 0.002 }
    }

    fn name(leg: &Leg) -> Option<&'static str> {
        let legs = std::slice::from_ref(leg);
        finding(legs, &SOIL).unwrap_or_else(|_| panic!("it fails")).map(|finding| finding.name)
    }

    #[rstest]
    fn other_flow_ends_on_the_yield_surface(
        #[values("drucker_prager", "mohr_coulomb")] law: &'static str,
        #[values(|scene: &mut BoxScene| scene.dilation = 0.0, |scene: &mut BoxScene| scene.dilation = 1.0)]
        change: fn(&mut BoxScene),
    ) {
        let leg = compression(law, change);
        assert_eq!(is_on_surface(&leg), Some(true));
        assert_eq!(name(&leg), Some("soil-flow-direction"));
    }

    #[test]
    fn elastic_stress_is_beyond_the_yield_surface() {
        assert_eq!(name(&compression("drucker_prager", |_| {})), None);
        let leg = compression("drucker_prager", |scene| scene.law = "hencky");
        assert_eq!(is_on_surface(&leg), Some(false));
        assert_eq!(name(&leg), Some("soil-does-not-yield"));
    }

    #[test]
    fn strength_that_is_one_percent_lower_is_a_wrong_yield_surface() {
        let leg = compression("drucker_prager", |scene| scene.friction = 0.99);
        assert_eq!(name(&leg), Some("soil-yield-surface"));
    }

    #[test]
    fn stress_that_is_not_a_number_is_wrong() {
        let leg = compression("drucker_prager", |_| {});
        let leg = Leg { stress: vec![f64::NAN; 4], ..leg };
        assert!(leg.is_wrong() && !(leg.distance_from(&leg) <= leg.bound));
    }
}
