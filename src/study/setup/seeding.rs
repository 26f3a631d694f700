//! Bodies filled with particles, see [`lattice`](crate::suite::scene::lattice).

use crate::exact::{Cut, Piece, Random, join_small};
use crate::mpm::{Fragment, Matrix, Particles, Vector};
use crate::suite::model::Scene;
use crate::suite::model::stability::LatticeEdits;
use crate::suite::scene::lattice::{LatticeOffsets, block};

/// The particles of a scene on a grid that starts at `origin`, with cells of size `h`.
pub(crate) fn particles<const D: usize>(
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

/// Sets the mass of each particle to the integral of a density that varies, over the part of the
/// lattice cell of the particle that is inside the body.
fn weigh<const D: usize>(scene: &Scene, particles: &mut Particles<D>) {
    if scene.density.uniform().is_some() {
        return;
    }
    let half = particles.spacing * 0.5;
    let holds = |label: &[f64]| scene.outline.as_ref().is_none_or(|o| o.holds(label));
    for (mass, x0) in particles.mass.iter_mut().zip(&particles.x0) {
        *mass = scene.density.mass(x0.as_slice(), half.as_slice(), holds);
    }
}

/// The particle of a piece of a body in the plane; a further axis would be its thickness of one.
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
    /// Moves and adds particles.
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
