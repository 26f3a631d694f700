//! Converts the model of a body to data for the solvers.

use super::initial_state::Initial;
use crate::exact::heat::Conduction;
use crate::exact::{CellQuadrature, Cut, Forcing, Piece, Problem, Random, join_small};
use crate::mpm::Side;
use crate::mpm::input::{
    BodyInput, CellLattice, Displace, EffectInput, FaceInput, ForceAt, FragmentInput, GridInput,
    LatticeCell, MassAt, SceneInput, ShapeInput, WallInput,
};
use crate::subject::SubjectError;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::stability::LatticeEdits;
use crate::suite::model::{ConvergencePlan, Scene, SceneFace, Suite};
use crate::suite::scene::lattice::{LatticeOffsets, lattice_ends};
use crate::suite::scene::load::{BodySite, ListedLoad, LoadTarget};
use crate::suite::scene::{cell_size, grid_axis, per_axis};
use crate::verify::Quantity;

pub(crate) struct Body<'a> {
    /// The scene of all bodies, with the grid and its walls.
    pub(crate) scene: &'a Scene,
    pub(crate) own: &'a Scene,
    pub(crate) initial: Initial,
    pub(crate) manufactured: Option<&'a Problem>,
    pub(crate) heat: Option<&'a Conduction>,
    /// Judged quantity, for which particles may store F and sample the out-of-plane stress.
    pub(crate) judged: Option<Quantity>,
    /// Changes to the lattice of particles: displacements and additional particles.
    pub(crate) lattice: LatticeEdits,
}

impl<'a> Body<'a> {
    pub(crate) fn of(plan: &'a ConvergencePlan, own: &'a Scene) -> Self {
        Self {
            scene: &plan.scene,
            own,
            initial: Initial::of_body(plan, own),
            manufactured: plan.manufactured(),
            heat: plan.heat_problem(),
            judged: Some(plan.of),
            lattice: LatticeEdits { scatter: plan.scatter.clone(), ..LatticeEdits::default() },
        }
    }

    pub(crate) fn stated(scene: &'a Scene, own: &'a Scene, lattice: LatticeEdits) -> Self {
        let initial = Initial::stated(own);
        Self { scene, own, initial, manufactured: None, heat: None, judged: None, lattice }
    }

    fn input(self, level: LevelPlan) -> Result<BodyInput<'a>, SubjectError> {
        let Self { scene, own, judged, .. } = self;
        let h = cell_size(scene, level.cells);
        let d = scene.dimension();
        let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, d)).ok_or("MPM needs particles")?;
        let effects = self.effects();
        let LatticeEdits { shift, scatter, extra } = self.lattice;
        Ok(BodyInput {
            shape: shape(own, scene, h),
            per_axis,
            density: own.density.largest(),
            mass: mass(own),
            displace: displacement(shift, scatter),
            extra,
            material: own.material,
            effects,
            initial: self.initial.input(),
            stores_deformation: judged.is_some_and(Quantity::needs_deformation_gradient),
            samples_stress_across: judged.is_some_and(Quantity::needs_stress_across),
        })
    }

    /// Creates the effects of the loads. A manufactured force comes before loads on sets.
    fn effects(&self) -> Vec<EffectInput> {
        let on_set = |load: &ListedLoad| matches!(load.target(), LoadTarget::Set(_));
        let loads = &self.own.loads;
        let (whole, sets) = loads.split_at(loads.partition_point(|load| !on_set(load)));
        let site = BodySite { dimension: self.scene.dimension(), heat: self.heat };
        let made = self.manufactured.map(|problem| {
            let force = ManufacturedForce { problem: problem.clone(), forcing: None };
            EffectInput::BodyForce(Box::new(force))
        });
        let input = |load: &ListedLoad| load.input(&site);
        whole.iter().map(input).chain(made).chain(sets.iter().map(input)).collect()
    }
}

pub(crate) fn scene_input(
    bodies: Vec<Body<'_>>,
    level: LevelPlan,
) -> Result<SceneInput<'_>, SubjectError> {
    let scene = bodies.first().ok_or("the scene has no body")?.scene;
    let bodies: Result<_, SubjectError> =
        bodies.into_iter().map(|body| body.input(level)).collect();
    Ok(SceneInput {
        plane: scene.plane,
        grid: grid(scene, cell_size(scene, level.cells)),
        walls: walls(scene),
        bodies: bodies?,
        contact: scene.contact,
    })
}

pub(crate) fn plan_input(
    plan: &ConvergencePlan,
    level: LevelPlan,
) -> Result<SceneInput<'_>, SubjectError> {
    scene_input(plan.scene.each().iter().map(|own| Body::of(plan, own)).collect(), level)
}

/// Creates the effects in the scene of `suite`.
///
/// # Errors
/// The suite is not a convergence study.
pub fn effects(suite: &Suite) -> Result<Vec<EffectInput>, SubjectError> {
    let plan = suite.convergence().ok_or("the suite is not a convergence study")?;
    let site = BodySite { dimension: plan.scene.dimension(), heat: plan.heat_problem() };
    Ok(plan.scene.loads.iter().map(|load| load.input(&site)).collect())
}

struct ManufacturedForce {
    problem: Problem,
    forcing: Option<Forcing>,
}

impl ForceAt for ManufacturedForce {
    fn prepare(&mut self, labels: &[&[f64]]) {
        self.forcing = Some(Forcing::new(&self.problem, labels.iter().copied()));
    }

    fn write(&mut self, t: f64, _: &dyn Fn(usize) -> [f64; 3], into: &mut [[f64; 3]]) {
        if let Some(forcing) = &mut self.forcing {
            forcing.at(t, into);
        }
    }
}

fn grid(scene: &Scene, h: f64) -> GridInput {
    let axes = 0..scene.dimension();
    let (origin, cells) = axes.clone().map(|axis| grid_axis(scene, axis, h)).unzip();
    let counts = |cells: Vec<f64>| cells.into_iter().map(|cells| cells as usize).collect();
    let periodic = axes.map(|axis| periodic(scene, axis)).collect();
    GridInput { origin, h, cells: counts(cells), periodic }
}

/// Whether an axis is periodic. A round body has no faces and no periodic axes.
pub(crate) fn periodic(scene: &Scene, axis: usize) -> bool {
    scene.faces.get(2 * axis).is_some_and(|face| face.hold.is_periodic())
}

/// Lists the conditions on grid faces. Later ones override earlier ones at shared nodes.
fn walls(scene: &Scene) -> Vec<WallInput> {
    let mut faces: Vec<&SceneFace> = scene.faces.iter().collect();
    faces.sort_by_key(|face| face.hold.kind().strength);
    let wall = |face: &SceneFace| {
        let side = if face.high { Side::High } else { Side::Low };
        let condition = face.hold.wall()?;
        Some(WallInput { face: FaceInput { axis: face.axis, side }, condition })
    };
    faces.into_iter().filter_map(wall).collect()
}

fn shape<'a>(own: &'a Scene, scene: &Scene, h: f64) -> ShapeInput<'a> {
    if let Some(panel) = &own.mapped {
        return ShapeInput::Panel(panel.clone());
    }
    let Some(outline) = &own.outline else {
        return ShapeInput::Box { from: own.from.clone(), to: own.to.clone() };
    };
    let (from, to) = lattice_ends(own, scene, h);
    let cut = |lattice: &CellLattice| {
        let CellLattice { centres, half, along } = lattice;
        let cut = |centre: &Vec<f64>| outline.cut(centre, half);
        let mut cuts: Vec<Cut> = centres.iter().map(cut).collect();
        if let [x, y] = half[..] {
            let place = |p: usize| [centres[p][0], centres[p][1]];
            join_small(&mut cuts, *along, [x, y], &place, &|label| outline.holds(label));
        }
        cuts.iter().map(lattice_cell).collect()
    };
    ShapeInput::Cells { from, to, cut: Box::new(cut) }
}

fn lattice_cell(cut: &Cut) -> LatticeCell {
    let fragment = |piece: &Piece| FragmentInput {
        place: piece.place,
        volume: piece.volume,
        domain: piece.domain(),
    };
    match cut {
        Cut::Nothing => LatticeCell::Empty,
        Cut::Whole => LatticeCell::Whole,
        Cut::Pieces(pieces) => LatticeCell::Parts(pieces.iter().map(fragment).collect()),
    }
}

/// Returns the mass of a particle: the density integrated over its lattice cell in the body.
fn mass(scene: &Scene) -> Option<MassAt<'_>> {
    if scene.density.uniform().is_some() {
        return None;
    }
    let holds = |label: &[f64]| scene.outline.as_ref().is_none_or(|o| o.holds(label));
    let cells = CellQuadrature::new(scene.dimension());
    Some(Box::new(move |x0, half| scene.density.mass(&cells, x0, half, &holds)))
}

/// Returns the function that shifts and perturbs particle positions (m), for a given spacing (m).
fn displacement(shift: Vec<f64>, scatter: LatticeOffsets) -> Option<Displace<'static>> {
    if shift.is_empty() && scatter.is_none() {
        return None;
    }
    let component = |numbers: &[f64], axis: usize| numbers.get(axis).copied().unwrap_or(0.0);
    let mut random = Random::new(scatter.seed);
    Some(Box::new(move |x, spacing| {
        for (axis, x) in x.iter_mut().enumerate() {
            *x += component(&shift, axis);
        }
        if scatter.is_none() {
            return;
        }
        for (axis, x) in x.iter_mut().enumerate() {
            let random = random.between(-1.0, 1.0);
            let share = component(&scatter.shift, axis) + scatter.perturb * random;
            *x += share * spacing[axis];
        }
    }))
}
