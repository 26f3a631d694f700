//! Paths and mistakes of J2 plasticity, fluids and plane stress.

use super::{
    AFTER, COMPRESSION, LawCause, LawMistake, Laws, Leg, SHEAR, StrainGradient, StrainPath, YOUNG,
    examine,
};
use crate::external::SMALL_STRAIN;
use crate::testing::doctor::prelude::*;

pub(in super::super) const PLASTICITY: Examination = Examination {
    name: "plasticity",
    expected: "in compression and shear, the column `stress` agrees with J2 plasticity with linear \
               hardening, for one large step and for many small steps",
    after: AFTER,
    covers: &["laws: j2"],
    examine: |patient| examine(patient, &J2),
};

pub(in super::super) const FLUIDS: Examination = Examination {
    name: "fluids",
    expected: "in compression and extension, the column `stress` is the pressure of the equation \
               of state; in shear, it contains the viscous stress",
    // The pressure of a gas also depends on the mass, which `start` examines.
    after: &["translation", "force", "transfer", "stress", "laws", "start"],
    covers: &["laws: newtonian", "laws: linear_fluid", "laws: polytropic"],
    examine: |patient| examine(patient, &FLUID),
};

pub(in super::super) const PLANE_STRESS: Examination = Examination {
    name: "plane-stress",
    expected: "in a plate that stretches and shears, the column `stress` is that of plane stress",
    after: AFTER,
    covers: &["plane_stress"],
    examine: |patient| examine(patient, &PLATE),
};

/// Sets yield stress and hardening (Pa). Hardening about doubles the yield stress on a path.
const METAL: fn(&mut BoxScene) = |scene| {
    scene.strength = YOUNG / 12_000.0;
    scene.extras.hardening = Some(YOUNG / 4.0);
};

const J2: Laws = Laws {
    names: &["j2"],
    dimensions: &[2, 3, 1],
    measures: [1.0, 0.5],
    paths: &[
        StrainPath::new("shear in one step", SHEAR, METAL).steps(1),
        StrainPath::new("shear", SHEAR, METAL).everywhere(),
        StrainPath::new("compression in one step", COMPRESSION, METAL).steps(1).everywhere(),
        StrainPath::new("compression", COMPRESSION, METAL).everywhere(),
    ],
    mistakes: &[
        (|scene| scene.law = "hencky", 1.0, J2_ELASTIC),
        (|scene| harden(scene, 1.0, 0.0), 1.0, J2_PERFECT),
        (|scene| harden(scene, 1.0, 2.0 / 3.0), 1.0, J2_HARDENING),
        (|scene| harden(scene, 1.0, 1.5), 1.0, J2_HARDENING),
        (|scene| harden(scene, 1.5_f64.sqrt(), 1.0), 1.0, J2_RADIUS),
        (|scene| harden(scene, 1.5_f64.sqrt().recip(), 1.0), 1.0, J2_RADIUS),
        (|scene| harden(scene, 3.0_f64.sqrt(), 1.0), 1.0, J2_RADIUS),
        (|scene| harden(scene, 3.0_f64.sqrt().recip(), 1.0), 1.0, J2_RADIUS),
        (|scene| harden(scene, 1.5_f64.sqrt(), 1.5), 1.0, J2_RADIUS),
        (|scene| harden(scene, 1.5_f64.sqrt(), 1.5_f64.sqrt()), 1.0, J2_RADIUS),
    ],
    otherwise: |leg, _, depends_on_steps| match (depends_on_steps, leg.path.steps) {
        (true, 1) => J2_STEPS,
        (true, _) => J2_NOT_ACCUMULATED,
        _ => J2_RETURN,
    },
};

fn harden(scene: &mut BoxScene, strength: f64, hardening: f64) {
    scene.strength *= strength;
    scene.extras.hardening = scene.extras.hardening.map(|modulus| hardening * modulus);
}

const RADIAL_RETURN: &str = "the radial return: the yield function sqrt(3/2) |s| - (Y + H alpha) \
                             with the deviator s; the multiplier flow = f/(3 mu + H); alpha grows \
                             by flow in each step. With f = |s| - sqrt(2/3) (Y + H alpha), the \
                             multiplier is f/(2 mu + 2/3 H), and alpha grows by sqrt(2/3) of it";
const J2_ELASTIC: LawCause = (
    "j2-does-not-yield",
    "the stress stays elastic beyond the yield stress: the return mapping is not applied",
    RADIAL_RETURN,
);
const J2_PERFECT: LawCause =
    ("j2-without-hardening", "the yield stress does not grow", RADIAL_RETURN);
const J2_HARDENING: LawCause = (
    "j2-hardening-scaled",
    "the hardening modulus is wrong by a factor of 2/3 or 3/2",
    RADIAL_RETURN,
);
const J2_RADIUS: LawCause = (
    "j2-yield-radius",
    "the yield stress is wrong by a factor of sqrt(3/2) or sqrt(3), or its inverse: |s|, or \
     sqrt(J2), is compared with the uniaxial yield stress",
    RADIAL_RETURN,
);
const J2_STEPS: LawCause = (
    "j2-depends-on-steps",
    "the stress is correct after many steps, but wrong after one: the return mapping stops before \
     the stress reaches the yield surface",
    RADIAL_RETURN,
);
const J2_NOT_ACCUMULATED: LawCause = (
    "j2-not-accumulated",
    "the stress is correct after one step, but wrong after many: the plastic strain or the \
     hardening variable is not kept from step to step, or grows by a wrong amount",
    RADIAL_RETURN,
);
const J2_RETURN: LawCause =
    ("j2-return", "the stress is not that of a radial return", RADIAL_RETURN);

/// Relative change of volume of a fluid. The value is so small that few particles cross cell faces,
/// and so large that an equation of state differs from its linearisation.
const CHANGE: f64 = 0.06;

const FLUID_STEPS: u64 = 50;

const fn stretch(strain: f64) -> StrainGradient {
    [[strain, 0.0, 0.0], [0.0; 3], [0.0; 3]]
}

const FLUID: Laws = Laws {
    names: &["newtonian", "linear_fluid", "polytropic"],
    dimensions: &[2, 3, 1],
    // An explicit step multiplies the volume by 1 + tr(D) dt, det(I + L dt), exp(tr(D) dt) or
    // 1/(1 - tr(D) dt). These factors differ by at most the square of the strain of the step.
    measures: [0.0, 1.0 / FLUID_STEPS as f64],
    paths: &[
        StrainPath::new("compression", stretch(-CHANGE), |_| {}).steps(FLUID_STEPS),
        StrainPath::new("extension", stretch(CHANGE), |_| {}).steps(FLUID_STEPS),
        // The viscous stress of a Newtonian fluid is a tenth of Young's modulus.
        StrainPath::new("shear", [[0.0, CHANGE, 0.0], [0.0; 3], [0.0; 3]], |scene| {
            scene.extras.viscosity = 0.1 * YOUNG / CHANGE;
        })
        .steps(FLUID_STEPS),
    ],
    mistakes: &[
        (|scene| strain(scene, |_| 0.0), 1.0, PRESSURE_CONSTANT),
        (|_| {}, -1.0, PRESSURE_SIGN),
        (|scene| strain(scene, inverse), 1.0, PRESSURE_INVERSE),
        (|scene| scene.law = "linear_fluid", 1.0, PRESSURE_LINEAR),
        (
            |scene| {
                scene.law = "linear_fluid";
                strain(scene, inverse);
            },
            -1.0,
            PRESSURE_OF_DENSITY,
        ),
        (|scene| scene.extras.viscosity = 0.0, 1.0, VISCOSITY_IGNORED),
        (|scene| scene.extras.viscosity *= 0.5, 1.0, VISCOSITY_SCALED),
        (|scene| scene.extras.viscosity *= 2.0, 1.0, VISCOSITY_SCALED),
    ],
    otherwise: |leg: &Leg, _, _| {
        if leg.scene.extras.viscosity > 0.0 { VISCOUS_STRESS } else { PRESSURE_DIFFERS }
    },
};

fn strain(scene: &mut BoxScene, change: fn(f64) -> f64) {
    let along = &mut scene.velocity.gradient[0][0];
    *along = change(*along);
}

fn inverse(strain: f64) -> f64 {
    1.0 / (1.0 + strain) - 1.0
}

const STATE: &str = "equation-of-state";
const PRESSURE: &str = "the pressure as a function of J = V/V0, which `mpm-verify explain SUITE` \
                        prints, with J < 1 in compression; the update of J or of the density in \
                        each step; in the column, -p I plus the viscous stress 2 eta dev(D)";
const PRESSURE_CONSTANT: LawCause =
    (STATE, "the pressure stays that of V = V0: the volume or density is not updated", PRESSURE);
const PRESSURE_SIGN: LawCause = (STATE, "the pressure has the wrong sign", PRESSURE);
const PRESSURE_INVERSE: LawCause = (STATE, "V0/V and V/V0 are exchanged", PRESSURE);
const PRESSURE_LINEAR: LawCause = (STATE, "the pressure is linear in V/V0, K (1 - V/V0)", PRESSURE);
const PRESSURE_OF_DENSITY: LawCause =
    (STATE, "the pressure is linear in the density, K (V0/V - 1)", PRESSURE);
const PRESSURE_DIFFERS: LawCause = (
    STATE,
    "the pressure is not that of the equation of state: another exponent or modulus, the Kirchhoff \
     stress J sigma, or a stress that is not isotropic",
    PRESSURE,
);
const VISCOSITY_IGNORED: LawCause = ("viscous-stress", "the viscosity is ignored", PRESSURE);
const VISCOSITY_SCALED: LawCause = (
    "viscous-stress",
    "the viscous stress is wrong by a factor of two, as in 2 eta D with D = (L + L^T)/2",
    PRESSURE,
);
const VISCOUS_STRESS: LawCause = (
    "viscous-stress",
    "the viscous stress is wrong: another rate of deformation, or a kinematic viscosity in place \
     of the dynamic one",
    PRESSURE,
);

const PLATE_STRAIN: StrainGradient = [[-0.000_75, 0.000_4, 0.0], [0.0, 0.000_2, 0.0], [0.0; 3]];

const PLATE: Laws = Laws {
    names: &["linear_elastic", "neo_hookean", "hencky", SMALL_STRAIN],
    dimensions: &[2],
    measures: [1.0, 0.5],
    paths: &[StrainPath::new("stretch and shear", PLATE_STRAIN, |scene| {
        scene.extras.keys.push("plane: stress".to_owned());
    })],
    mistakes: &PLATE_MISTAKES,
    otherwise: |_, _, _| PLATE_DIFFERS,
};

const PLATE_MISTAKES: [LawMistake; 2] = [
    (
        |scene| scene.extras.keys.clear(),
        1.0,
        ("plane-strain", "the solver uses the law of plane strain for a plate", PLATE_LAW),
    ),
    (
        |scene| scene.poisson = 0.0,
        1.0,
        (
            "poisson-ratio-ignored",
            "Poisson's ratio has no effect on the normal stresses",
            PLATE_LAW,
        ),
    ),
];
const PLATE_LAW: &str = "`plane` of the problem, which is \"stress\": the stress across the plate \
                         is zero, and the strain across it is -nu/(1 - nu) times the sum of the \
                         strains in the plane; the stiffness E/(1 - nu^2) of a plate";
const PLATE_DIFFERS: LawCause =
    ("plane-stress-differs", "the stress is not that of a plate in plane stress", PLATE_LAW);

#[cfg(test)]
mod tests {
    use super::super::finding;
    use super::*;

    /// Factors of the stress after one step and after many steps, and the name of the finding.
    #[test]
    fn path_with_the_wrong_stress_is_reported() {
        for (factors, name) in
            [([1.1, 1.0], "j2-depends-on-steps"), ([1.0, 1.1], "j2-not-accumulated")]
        {
            let legs = [0, 1].map(|k| {
                let (path, expected) = (J2.paths[k], vec![3.0, 1.0, 1.0, 2.0]);
                let stress = expected.iter().map(|stress| factors[k] * stress).collect();
                Leg { path, scene: path.scene((2, "j2")), stress, expected, bound: 0.01 }
            });
            let finding = finding(&legs, &J2).ok().flatten();
            assert_eq!(finding.map(|finding| finding.name), Some(name));
        }
    }
}
