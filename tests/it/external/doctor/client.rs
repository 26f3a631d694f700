//! A small MPM in the plane with a defect. It uses linear functions, FLIP and USL.

use super::defect::{Defect, Defect::*};
use mpm_verify::external::{Capabilities, LevelProblem, ProblemFace, ProblemNeeds, SolverFactory};
use mpm_verify::subject::{Failure, RunCounters, Samples, Subject, SubjectError};
use std::sync::atomic::{AtomicBool, Ordering};

type Vector = [f64; 2];

/// Creates clients with a defect.
pub(super) struct Clinic {
    pub(super) defect: Defect,
    /// Whether clients refuse all problems.
    pub(super) is_closed: AtomicBool,
}

impl Clinic {
    pub(super) fn new(defect: Defect) -> Self {
        Self { defect, is_closed: AtomicBool::new(false) }
    }
}

impl SolverFactory for Clinic {
    fn name(&self) -> &'static str {
        "client"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        if self.is_closed.load(Ordering::Relaxed) {
            return vec!["time".to_owned()];
        }
        let conditions = ["free", "fixed", "roller", "periodic"];
        let able = Capabilities {
            manufactured: true,
            columns: vec!["stress".to_owned(), "deformation_gradient".to_owned()],
            ..Capabilities::of(&[2], &["linear_elastic"], &conditions, &["gravity"])
        };
        able.lacking(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        Ok(Box::new(Client::new(problem, self.defect)))
    }
}

struct Client {
    defect: Defect,
    problem: LevelProblem,
    x: Vec<Vector>,
    v: Vec<Vector>,
    f: Vec<[f64; 4]>,
    sigma: Vec<[f64; 4]>,
    steps: u64,
    /// Lame's parameters.
    lame: [f64; 2],
    walls: Vec<Wall>,
}

/// A face of the grid at which nodes are held.
struct Wall {
    axis: usize,
    high: bool,
    /// Number of the plane of nodes.
    node: usize,
    holds_all: bool,
}

/// A node around a particle, with its weight and gradient.
type Weight = (usize, f64, Vector);

fn vectors(column: &[f64]) -> Vec<Vector> {
    column.chunks_exact(2).map(|v| [v[0], v[1]]).collect()
}

impl Client {
    fn new(problem: LevelProblem, defect: Defect) -> Self {
        let (x, v) = (vectors(&problem.particles.position), vectors(&problem.particles.velocity));
        let n = x.len();
        let stress = if defect == StressAtStart { 0.01 } else { 0.0 };
        let material = &problem.materials[0];
        let (e, nu) = (material.parameter("young"), material.parameter("poisson"));
        let lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let mu = e / (2.0 * (1.0 + nu));
        let grid = &problem.grid;
        let held = problem.faces.iter().filter(|face| {
            ["fixed", "roller"].contains(&face.condition)
                && defect != NoWalls
                && !(defect == LowWallsOnly && face.high)
        });
        let wall = |face: &ProblemFace| Wall {
            axis: face.axis,
            high: face.high,
            node: libm::round((face.at - grid.origin[face.axis]) / grid.h) as usize,
            holds_all: defect == StickyRollers
                || face.condition == "fixed" && defect != FixedHoldsNormal,
        };
        Self {
            defect,
            x,
            v,
            f: vec![[1.0, 0.0, 0.0, 1.0]; n],
            sigma: vec![[stress, 0.0, 0.0, stress]; n],
            steps: 0,
            lame: [lambda, mu],
            walls: held.map(wall).collect(),
            problem,
        }
    }

    /// Returns the cell that contains the position `x`.
    fn cell(&self, x: Vector) -> [isize; 2] {
        let grid = &self.problem.grid;
        [0, 1].map(|i| ((x[i] - grid.origin[i]) / grid.h).floor() as isize)
    }

    /// Returns the nodes around a particle, or `None` for a particle without a cell.
    fn weights(&self, p: usize) -> Option<[Weight; 4]> {
        let grid = &self.problem.grid;
        let cell = self.cell(self.x[p]);
        let s = [0, 1].map(|i| (self.x[p][i] - grid.origin[i]) / grid.h - cell[i] as f64);
        if self.defect == NoCellOnFaces && s.contains(&0.0) {
            return None;
        }
        let value = |i: usize, high: usize| match (high, self.defect) {
            (0, _) => 1.0 - s[i],
            (_, WeightsOfTheirOwn) => s[i] * s[i],
            (_, UnevenWeightsInPic) => s[i] - 0.01 * s[i] * (1.0 - s[i]),
            (_, LowWeights) => 0.999 - 1.0 + s[i],
            _ => s[i],
        };
        let slope = |high: usize| match (high, self.defect) {
            (0, GradientsOfTheirOwn) => -0.9 / grid.h,
            (0, _) => -1.0 / grid.h,
            _ => 1.0 / grid.h,
        };
        let width = self.nodes()[0];
        let corner = |corner: usize| {
            let high = [corner % 2, corner / 2];
            let at = [0, 1].map(|i| {
                let node = cell[i] + high[i] as isize;
                let count = grid.cells[i] as isize;
                (if grid.periodic[i] { node.rem_euclid(count) } else { node }) as usize
            });
            let gradient = [slope(high[0]) * value(1, high[1]), value(0, high[0]) * slope(high[1])];
            (at[0] + width * at[1], value(0, high[0]) * value(1, high[1]), gradient)
        };
        Some([0, 1, 2, 3].map(corner))
    }

    fn nodes(&self) -> [usize; 2] {
        [0, 1].map(|i| self.problem.grid.cells[i] as usize + 2)
    }

    fn body_force(&self, p: usize, t: f64) -> Vector {
        let defect = self.defect;
        let mut force = [0.0; 2];
        if let Some(field) = &self.problem.body_force {
            let label = &self.problem.particles.reference_position[2 * p..2 * p + 2];
            let at = if defect == ForceAtPresentPositions { &self.x[p] } else { label };
            let place = if defect == ForceOfOtherPoints {
                let q = 7 * p % self.x.len();
                &self.problem.particles.reference_position[2 * q..2 * q + 2]
            } else {
                at
            };
            let value = field.at(0, place, t);
            force = [value[0], value[1]];
        }
        if defect == GravityLeftOn {
            force[1] -= 9.81;
        }
        force
    }

    /// Updates volume and stress with the velocity gradient `l`.
    fn strain(&mut self, p: usize, l: [f64; 4], dt: f64) {
        let [lambda, mu] = self.lame;
        let shear = 0.5 * (l[1] + l[2]);
        let trace = l[0] + l[3];
        let rates = [
            lambda * trace + 2.0 * mu * l[0],
            2.0 * mu * shear,
            2.0 * mu * shear,
            lambda * trace + 2.0 * mu * l[3],
        ];
        for k in 0..4 {
            self.sigma[p][k] += dt * rates[k];
        }
        let f = self.f[p];
        for i in 0..2 {
            for j in 0..2 {
                self.f[p][2 * i + j] += dt * (l[2 * i] * f[j] + l[2 * i + 1] * f[2 + j]);
            }
        }
    }

    fn hold(&self, node: usize, v: &mut Vector) {
        let width = self.nodes()[0];
        let at = [node % width, node / width];
        for wall in &self.walls {
            let at = at[wall.axis];
            let is_there = if wall.high { at >= wall.node } else { at <= wall.node };
            if !is_there || self.defect == WallsLetGo && (v[wall.axis] > 0.0) != wall.high {
                continue;
            }
            if wall.holds_all {
                *v = [0.0; 2];
            } else {
                v[wall.axis] = 0.0;
            }
        }
    }
}

impl Subject for Client {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let defect = self.defect;
        let t = self.steps as f64 * dt;
        let [width, height] = self.nodes();
        let particles = &self.problem.particles;
        let (masses, volumes) = (&particles.mass, &particles.volume);
        let mut mass = vec![0.0; width * height];
        let mut momentum = vec![[0.0; 2]; width * height];
        let mut force = vec![[0.0; 2]; width * height];
        let mut load = vec![[0.0; 2]; width * height];
        let all: Vec<_> = (0..self.x.len()).map(|p| self.weights(p)).collect();
        for (p, weights) in all.iter().enumerate() {
            let body = self.body_force(p, t);
            let sigma = self.sigma[p];
            let f = self.f[p];
            let j = f[0] * f[3] - f[1] * f[2];
            let volume = j * volumes[p] * if defect == WholeCells { 4.0 } else { 1.0 };
            let m = if defect == NoDensity { volumes[p] } else { masses[p] };
            for (node, weight, gradient) in weights.iter().flatten() {
                mass[*node] += weight * m;
                for i in 0..2 {
                    momentum[*node][i] += weight * m * self.v[p][i];
                    let pull = sigma[2 * i] * gradient[0] + sigma[2 * i + 1] * gradient[1];
                    force[*node][i] -= volume * pull;
                    load[*node][i] += weight * m * body[i];
                }
            }
        }
        let lightest = match defect {
            LightNodesLeftOut => 0.3 * masses[0],
            AbsoluteThreshold => 1e-12,
            _ => 0.0,
        };
        let (mut acceleration, mut velocity) = (force, momentum);
        for node in 0..width * height {
            if mass[node] > lightest {
                let before = velocity[node].map(|p| p / mass[node]);
                let late = if defect == LoadAfterWalls { 1.0 } else { 0.0 };
                let change = [0, 1].map(|i| {
                    dt * (acceleration[node][i] + (1.0 - late) * load[node][i]) / mass[node]
                });
                let mut after = [0, 1].map(|i| before[i] + change[i]);
                let mut held = before;
                if defect == HeldAcceleration {
                    let mut change = change;
                    self.hold(node, &mut change);
                    after = [0, 1].map(|i| before[i] + change[i]);
                } else {
                    self.hold(node, &mut after);
                    self.hold(node, &mut held);
                }
                after = [0, 1].map(|i| after[i] + late * dt * load[node][i] / mass[node]);
                acceleration[node] = [0, 1].map(|i| (after[i] - before[i]) / dt);
                velocity[node] = if defect == ForwardEuler { held } else { after };
            } else {
                (acceleration[node], velocity[node]) = ([0.0; 2], [0.0; 2]);
            }
        }
        for (p, weights) in all.iter().enumerate() {
            let (mut l, mut v, mut change) = ([0.0; 4], [0.0; 2], [0.0; 2]);
            for (node, weight, gradient) in weights.iter().flatten() {
                for i in 0..2 {
                    v[i] += weight * velocity[*node][i];
                    change[i] += dt * weight * acceleration[*node][i];
                    for j in 0..2 {
                        l[2 * i + j] += velocity[*node][i] * gradient[j];
                    }
                }
            }
            // Factor on the first step if the start is half a step back.
            let first = if defect == Leapfrog && self.steps == 0 { 0.5 } else { 1.0 };
            let cell = self.cell(self.x[p]);
            for i in 0..2 {
                self.v[p][i] += first * change[i];
                match defect {
                    Leapfrog => v[i] = if self.steps == 0 { self.v[p][i] } else { v[i] },
                    Pic | UnevenWeightsInPic => self.v[p][i] = v[i],
                    PicAtFirst if self.steps == 0 => self.v[p][i] = v[i],
                    Drag => self.v[p][i] *= 1.0 - 0.5 * dt,
                    _ => {}
                }
                self.x[p][i] += dt * v[i];
            }
            if defect == LossAtCrossings && self.cell(self.x[p]) != cell {
                self.v[p] = self.v[p].map(|v| 0.99 * v);
            }
            self.strain(p, l, dt);
        }
        self.steps += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        let particles = &self.problem.particles;
        samples.restart(2);
        for (p, label) in vectors(&particles.reference_position).iter().enumerate() {
            let u = [0, 1].map(|i| self.x[p][i] - label[i]);
            samples.push(label, &u, &self.v[p], particles.reference_volume[p]);
        }
        samples.stress = self.sigma.iter().flatten().copied().collect();
        samples.deformation_gradient = self.f.iter().flatten().copied().collect();
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(self.steps)
    }
}
