"""Newton's implicit MPM: three dimensions, Hencky's law, in single precision."""

from __future__ import annotations

import argparse

import numpy as np
from box import Array, Message, Problem, aside, gravity, laws, uniform
from mpm_verify import serve

with aside():
    import newton
    import warp as wp
    from newton.solvers import SolverImplicitMPM

    wp.config.quiet = True
    wp.init()


class Newton:
    name = "newton-mpm"
    version = newton.__version__
    precision = "single"

    def __init__(self, any_law: bool, substeps: int, drag: float, tolerance: float,
                 **options: str) -> None:
        self.substeps, self.drag, self.tolerance, self.options = substeps, drag, tolerance, options
        self.capabilities = {"dimensions": [3], "laws": laws(["hencky"], any_law),
                             "conditions": ["free"], "loads": ["gravity"]}

    def setup(self, problem: Problem) -> None:
        parameters = problem.materials[0]["parameters"]
        self.problem = problem
        volume, mass = uniform("volumes", problem.volume), uniform("masses", problem.mass)
        builder = newton.ModelBuilder()
        SolverImplicitMPM.register_custom_attributes(builder)
        n = len(problem.position)
        builder.add_particles(
            pos=vectors(problem.position), vel=vectors(problem.velocity), mass=[mass] * n,
            radius=[volume ** (1 / 3) / 2] * n)
        model = builder.finalize(device="cpu")
        model.set_gravity(tuple(map(float, gravity(problem))))
        model.mpm.young_modulus.fill_(parameters["young"])
        model.mpm.poisson_ratio.fill_(parameters["poisson"])
        model.mpm.tensile_yield_ratio.fill_(1.0)
        model.mpm.yield_pressure.fill_(1e15)
        model.mpm.yield_stress.fill_(1e15)
        config = SolverImplicitMPM.Config(
            voxel_size=problem.h, air_drag=self.drag, tolerance=self.tolerance, grid_type="dense",
            grid_padding=2, solver="cg", carry_residual_strain="unconverged", **self.options)
        self.solver = SolverImplicitMPM(model, config=config)
        self.states = [model.state(), model.state()]

    def advance(self, steps: int, dt: float, time: float) -> None:
        for _ in range(steps * self.substeps):
            self.solver.step(*self.states, None, None, dt / self.substeps)
            self.states.reverse()

    def state(self) -> Message:
        x, v = (array.numpy().astype(float) for array in
                (self.states[0].particle_q, self.states[0].particle_qd))
        return {"displacement": x - self.problem.reference_position, "velocity": v}


def vectors(values: Array) -> list[tuple[float, ...]]:
    return [tuple(map(float, value)) for value in values.astype(np.float32)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    parser.add_argument("--substeps", type=int, default=1, help="of each step")
    parser.add_argument("--drag", type=float, default=1e-6, help="that of the air, 1 unless said")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="1e-4 unless said")
    parser.add_argument("--velocity-basis", default="B2")
    parser.add_argument("--strain-basis", default="P1d")
    parser.add_argument("--integration-scheme", choices=["pic", "gimp"], default="pic")
    parser.add_argument("--transfer-scheme", choices=["pic", "apic"], default="apic")
    serve(Newton(**vars(parser.parse_args())))
