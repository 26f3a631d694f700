//! Converts the model of one body to solver inputs, in any number of dimensions.

use super::initial_state::Initial;
use crate::exact::heat::Conduction;
use crate::exact::{CellQuadrature, Cut, Forcing, Piece, Problem, Random, join_small};
use crate::mpm::{
    BasisName, BodyForce, Boundary, Effect, Fragment, Grid, HeatSolver, Hoop, Kernel, Material,
    Matrix, Particles, QuasiStatic, QuasiStaticSetup, Setup, Side, Vector, kernel,
};
use crate::subject::{PlaneState, SubjectError};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::stability::LatticeEdits;
use crate::suite::model::{ConvergencePlan, Scene, SceneFace, Suite};
use crate::suite::scene::boundary::{FaceSite, build as build_boundary};
use crate::suite::scene::lattice::{LatticeOffsets, block};
use crate::suite::scene::load::{BodySite, ListedLoad, LoadTarget};
use crate::suite::scene::{cell_size, grid_axis, load, per_axis};
use crate::verify::Quantity;

/// Model of a body at the start of a run.
pub(crate) struct Body<'a> {
    /// The scene of all bodies, with the grid and its walls.
    pub(crate) scene: &'a Scene,
    /// The scene of this body, with its shape, material and loads.
    pub(crate) own: &'a Scene,
    pub(crate) initial: Initial,
    /// Problem whose manufactured force acts on the body, if any.
    pub(crate) manufactured: Option<&'a Problem>,
    /// Heat-conduction problem of the body, if any.
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

    /// Creates a body in the initial state that the scene `own` describes, without exact solution.
    pub(crate) fn stated(scene: &'a Scene, own: &'a Scene, lattice: LatticeEdits) -> Self {
        let initial = Initial::stated(own);
        Self { scene, own, initial, manufactured: None, heat: None, judged: None, lattice }
    }

    /// Creates the material law of the body, with its initial stress.
    fn material<const D: usize>(
        &self,
        particles: &mut Particles<D>,
    ) -> Result<Box<dyn Material<D>>, SubjectError> {
        let law = self.own.material.in_plane(self.scene.plane);
        let law = law.ok_or("a law not supported in its plane")?;
        Ok(self.initial.stressed(law, particles)?)
    }
}

/// Creates the solver inputs of `body` on the cells of `level`.
pub(crate) fn setup<const D: usize>(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
) -> Result<Setup<D>, SubjectError> {
    let Method::Mpm { basis, transfer, scheme, start, mass, frame, volume, .. } = method else {
        return Err("not an MPM method".into());
    };
    let scene = body.scene;
    let (kernel, grid, mut particles) = discretisation::<D>(body, basis, level)?;
    if body.judged.is_some_and(Quantity::needs_deformation_gradient) {
        particles.track_deformation();
    }
    body.initial.put(&mut particles);
    let mut effects = effects_of(body, &grid, basis, &mut particles)?;
    if scene.plane == PlaneState::Axisymmetric {
        effects.insert(0, Box::new(Hoop::default()));
    }
    let material = body.material(&mut particles)?;
    Ok(Setup {
        kernel,
        transfer: transfer.build(),
        mass: crate::mpm::mass_matrix(mass),
        frame,
        volume,
        material,
        effects,
        boundary: boundary(scene, &grid, basis),
        grid,
        particles,
        scheme,
        start,
    })
}

fn discretisation<const D: usize>(
    body: &Body<'_>,
    basis: BasisName,
    level: LevelPlan,
) -> Result<(Box<dyn Kernel<D>>, Grid<D>, Particles<D>), SubjectError> {
    let h = cell_size(body.scene, level.cells);
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, D)).ok_or("MPM needs particles")?;
    let kernel = kernel::<D>(basis);
    let grid = grid(body.scene, h, kernel.as_ref());
    let mut particles = seeded_particles(body.own, &grid.origin, h, per_axis);
    body.lattice.apply(&mut particles);
    particles.samples_stress_across =
        D == 2 && body.judged.is_some_and(Quantity::needs_stress_across);
    if body.scene.plane == PlaneState::Axisymmetric {
        particles.revolve();
    }
    Ok((kernel, grid, particles))
}

/// Creates the quasi-static solver of `plan`, which applies the load in `load_steps` steps.
pub(crate) fn quasi_static<const D: usize>(
    plan: &ConvergencePlan,
    basis: BasisName,
    level: LevelPlan,
    load_steps: u64,
) -> Result<QuasiStatic<D>, SubjectError> {
    let body = Body::of(plan, &plan.scene);
    let (kernel, grid, mut particles) = discretisation::<D>(&body, basis, level)?;
    let effects = effects_of(&body, &grid, basis, &mut particles)?;
    let boundary = boundary(&plan.scene, &grid, basis);
    let material = body.material(&mut particles)?;
    Ok(QuasiStatic::new(QuasiStaticSetup {
        grid,
        particles,
        kernel,
        material,
        effects,
        boundary,
        load_steps,
    })?)
}

/// Creates the effects in the scene of `suite`, for `particles` and a `grid` of the caller.
///
/// # Errors
/// The reason why the effects cannot be created.
pub fn effects<const D: usize>(
    suite: &Suite,
    grid: &Grid<D>,
    basis: BasisName,
    particles: &mut Particles<D>,
) -> Result<Vec<Box<dyn Effect<D>>>, SubjectError> {
    let plan = suite.convergence().ok_or("the suite is not a convergence study")?;
    let site = BodySite { grid, basis, heat: plan.heat_problem(), particles };
    built(&plan.scene.loads, site)
}

/// Creates the heat solver of a body at rest.
pub(crate) fn conductor<const D: usize>(
    plan: &ConvergencePlan,
    basis: BasisName,
    level: LevelPlan,
) -> Result<HeatSolver<D>, SubjectError> {
    let h = cell_size(&plan.scene, level.cells);
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, D)).ok_or("MPM needs particles")?;
    let kernel = kernel::<D>(basis);
    let grid = grid(&plan.scene, h, kernel.as_ref());
    let mut particles = seeded_particles(&plan.scene, &grid.origin, h, per_axis);
    let site =
        BodySite { grid: &grid, basis, heat: plan.heat_problem(), particles: &mut particles };
    let effects = built(&plan.scene.loads, site)?;
    Ok(HeatSolver::new(kernel, grid, particles, effects)?)
}

fn manufactured_force<const D: usize>(
    made: &Problem,
    particles: &Particles<D>,
) -> Box<dyn Effect<D>> {
    let mut forcing = Forcing::new(made, particles.x0.iter().map(Vector::as_slice));
    Box::new(BodyForce::new(Box::new(move |t, _, b| {
        forcing.at(t, b, |force| Vector::from_fn(|i, _| force[i]));
    })))
}

/// Creates the grid of the suite. If the suite defines no grid, the grid covers the bounding box of
/// the body, with additional cells outside free faces.
fn grid<const D: usize>(scene: &Scene, h: f64, kernel: &dyn Kernel<D>) -> Grid<D> {
    let axes: [(f64, f64); D] = std::array::from_fn(|axis| grid_axis(scene, axis, h));
    let origin = Vector::from_fn(|axis, _| axes[axis].0);
    let cells = axes.map(|(_, cells)| cells as usize);
    kernel.grid(origin, h, cells, std::array::from_fn(|axis| periodic(scene, axis)))
}

/// Creates the effects of the body's loads. A manufactured force comes before loads on sets.
fn effects_of<const D: usize>(
    body: &Body<'_>,
    grid: &Grid<D>,
    basis: BasisName,
    particles: &mut Particles<D>,
) -> Result<Vec<Box<dyn Effect<D>>>, SubjectError> {
    let on_set = |load: &ListedLoad| matches!(load.target(), LoadTarget::Set(_));
    let loads = &body.own.loads;
    let (whole, sets) = loads.split_at(loads.partition_point(|load| !on_set(load)));
    let site = BodySite { grid, basis, heat: body.heat, particles };
    let mut effects = built(whole, site)?;
    effects.extend(body.manufactured.map(|made| manufactured_force(made, particles)));
    effects.extend(built(sets, BodySite { grid, basis, heat: body.heat, particles })?);
    Ok(effects)
}

fn built<const D: usize>(
    loads: &[ListedLoad],
    mut site: BodySite<'_, D>,
) -> Result<Vec<Box<dyn Effect<D>>>, SubjectError> {
    loads.iter().map(|load| Ok(load::build(load, &mut site)?)).collect()
}

/// Whether an axis is periodic. A round body has no faces and no periodic axes.
pub(crate) fn periodic(scene: &Scene, axis: usize) -> bool {
    scene.faces.get(2 * axis).is_some_and(|face| face.hold.is_periodic())
}

/// Creates boundary conditions on the faces of the grid. Conditions with higher priority come last,
/// because later conditions override earlier ones at shared nodes.
pub(crate) fn boundary<const D: usize>(
    scene: &Scene,
    grid: &Grid<D>,
    basis: BasisName,
) -> Vec<Box<dyn Boundary<D>>> {
    let mut faces: Vec<&SceneFace> = scene.faces.iter().collect();
    faces.sort_by_key(|face| face.hold.kind().strength);
    let build = |face: &SceneFace| {
        let side = if face.high { Side::High } else { Side::Low };
        build_boundary(&face.hold, &FaceSite { grid, basis, at: (face.axis, side) })
    };
    faces.into_iter().filter_map(build).collect()
}

/// Creates the particles of a scene on a grid with the origin `origin` and cells of size `h`.
pub(crate) fn seeded_particles<const D: usize>(
    scene: &Scene,
    origin: &Vector<D>,
    h: f64,
    per_axis: usize,
) -> Particles<D> {
    if let Some(panel) = &scene.mapped {
        return panel.fill(scene.density.largest(), h, per_axis);
    }
    let block = block(scene, origin, h);
    let Some(outline) = &scene.outline else {
        let mut particles = Particles::fill(&block, h, per_axis);
        weigh(scene, &mut particles);
        return particles;
    };
    let half = block.spacing(h, per_axis) * 0.5;
    let centres: Vec<Vector<D>> = block.centres(h, per_axis).collect();
    let cut = |centre: &Vector<D>| outline.cut(centre.as_slice(), half.as_slice());
    let mut cuts: Vec<Cut> = centres.iter().map(cut).collect();
    if let [x, y] = half.as_slice() {
        let along = block.counts(h, per_axis)[0];
        let place = |p: usize| [centres[p][0], centres[p][1]];
        join_small(&mut cuts, along, [*x, *y], &place, &|label| outline.holds(label));
    }
    let mut fragments = Vec::new();
    let mut all = cuts.iter();
    let mut particles = Particles::fill_where(&block, h, per_axis, |_| match all.next() {
        Some(Cut::Pieces(pieces)) => {
            fragments.extend(pieces.iter().map(fragment));
            false
        }
        cut => cut == Some(&Cut::Whole),
    });
    particles.add_fragments(&fragments, scene.density.largest());
    weigh(scene, &mut particles);
    particles
}

/// Sets each particle mass for a varying density: the density is integrated over the part of the
/// particle's lattice cell that is inside the body.
fn weigh<const D: usize>(scene: &Scene, particles: &mut Particles<D>) {
    if scene.density.uniform().is_some() {
        return;
    }
    let half = particles.spacing * 0.5;
    let holds = |label: &[f64]| scene.outline.as_ref().is_none_or(|o| o.holds(label));
    let cells = CellQuadrature::new(D);
    for (mass, x0) in particles.mass.iter_mut().zip(&particles.x0) {
        *mass = scene.density.mass(&cells, x0.as_slice(), half.as_slice(), holds);
    }
}

/// Converts a piece of a body in the plane to a particle, with unit thickness along a third axis.
fn fragment<const D: usize>(piece: &Piece) -> Fragment<D> {
    let domain = piece.domain();
    Fragment {
        volume: piece.volume,
        place: Vector::from_fn(|i, _| piece.place.get(i).copied().unwrap_or(0.0)),
        domain: Matrix::from_fn(|i, j| match (i, j) {
            (0 | 1, 0 | 1) => domain[2 * i + j],
            _ => 0.5 * f64::from(u8::from(i == j)),
        }),
    }
}

impl LatticeEdits {
    /// Shifts and perturbs the particles, and adds the extra particles.
    pub(crate) fn apply<const D: usize>(&self, particles: &mut Particles<D>) {
        let vector =
            |numbers: &[f64]| Vector::<D>::from_fn(|i, _| numbers.get(i).copied().unwrap_or(0.0));
        let shift = vector(&self.shift);
        particles.x0.iter_mut().for_each(|x| *x += shift);
        if !self.scatter.is_none() {
            let LatticeOffsets { shift, perturb, seed } = &self.scatter;
            let (shift, spacing) = (vector(shift), particles.spacing);
            let mut random = Random::new(*seed);
            for x in &mut particles.x0 {
                let mut share = |axis: usize| shift[axis] + perturb * random.between(-1.0, 1.0);
                *x += Vector::from_fn(|axis, _| share(axis) * spacing[axis]);
            }
        }
        for place in &self.extra {
            particles.add(vector(place));
        }
        particles.x.clone_from(&particles.x0);
    }
}
