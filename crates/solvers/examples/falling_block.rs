//! Creates a solver from data, and lets a block fall freely.

use mpm_solvers::mpm::input::{
    BodyInput, EffectInput, GridInput, InitialState, MethodInput, MpmMethod, SceneInput,
    ShapeInput, StateInput, subject,
};
use mpm_solvers::mpm::{
    BasisName, FrameName, MassName, MaterialPlan, SchemeName, TransferName, VolumeName,
};
use mpm_subject::{PlaneState, Precision, Samples, Start, SubjectError};

fn main() -> Result<(), SubjectError> {
    let gravity = |_, acceleration: &mut [f64]| acceleration.copy_from_slice(&[0.0, -10.0]);
    let block = BodyInput {
        shape: ShapeInput::Box { from: vec![1.0, 2.0], to: vec![2.0, 3.0] },
        per_axis: 2,
        density: 1000.0,
        mass: None,
        displace: None,
        extra: Vec::new(),
        material: MaterialPlan::NeoHookean { young: 1e6, poisson: 0.3 },
        effects: vec![EffectInput::Gravity(Box::new(gravity))],
        initial: InitialState {
            motion: Box::new(|_| StateInput::default()),
            is_displaced: false,
            stress: None,
        },
        stores_deformation: false,
        samples_stress_across: false,
    };
    let scene = SceneInput {
        plane: PlaneState::Strain,
        grid: GridInput {
            origin: vec![0.0; 2],
            h: 0.25,
            cells: vec![12, 12],
            periodic: vec![false; 2],
        },
        walls: Vec::new(),
        bodies: vec![block],
        contact: None,
    };
    let method = MpmMethod {
        basis: BasisName::QuadraticBSpline,
        transfer: TransferName::Apic.into(),
        scheme: SchemeName::Usl,
        start: Start::HalfStepBack,
        mass: MassName::Lumped,
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        precision: Precision::Double,
    };
    let mut solver = subject(scene, MethodInput::Dynamic(method))?;
    for _ in 0..300 {
        solver.step(1e-3)?;
    }
    let mut samples = Samples::default();
    solver.sample(&mut samples);
    println!("after 0.3 s: {:.4} m, exactly -0.4500 m", samples.displacement[1]);
    Ok(())
}
