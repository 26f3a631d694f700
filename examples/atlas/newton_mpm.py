"""Newton's implicit MPM: three dimensions, Hencky's law, in single precision.

With `--friction` it runs plane bodies with walls. The body is two layers of particles, with free
faces in front and behind. Without lateral strain (Poisson's ratio 0) its motion is plane.
"""

from __future__ import annotations

import argparse

import numpy as np
from box import Array, Cannot, Message, Problem, aside, common_material, gravity, laws, uniform
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

    def __init__(self, any_law: bool, friction: bool, substeps: int, drag: float, tolerance: float,
                 **options: str) -> None:
        self.friction, self.substeps, self.drag, self.tolerance, self.options = (
            friction, substeps, drag, tolerance, options)
        self.capabilities = {"dimensions": [3], "laws": laws(["hencky"], any_law),
                             "conditions": ["free"], "loads": ["gravity"], "several_bodies": True}
        if friction:
            self.capabilities |= {"dimensions": [2], "conditions": ["free", "friction"],
                                  "columns": ["stress"]}

    def setup(self, problem: Problem) -> None:
        parameters = common_material(problem)["parameters"]
        self.problem = problem
        volume, mass = uniform("volumes", problem.volume), uniform("masses", problem.mass)
        builder = newton.ModelBuilder()
        if hasattr(SolverImplicitMPM, "register_custom_attributes"):
            SolverImplicitMPM.register_custom_attributes(builder)
        side = volume ** (1 / problem.dimension)
        position, velocity = self.layers(problem.position, side), self.layers(problem.velocity, 0.0)
        n, across = len(position), side if self.friction else 1.0
        if self.friction and parameters["poisson"] != 0:
            raise Cannot("plane bodies with lateral strain")
        builder.add_particles(pos=vectors(position), vel=vectors(velocity),
                              mass=[mass * across] * n, radius=[side / 2] * n)
        for face in problem.faces:
            if face["condition"] == "friction":
                inward = [0.0, 0.0, 0.0]
                inward[face["axis"]] = -1.0 if face["high"] else 1.0
                rough = newton.ModelBuilder.ShapeConfig(mu=face["values"]["coefficient"])
                builder.add_shape_plane(plane=(*inward, -inward[face["axis"]] * face["at"]),
                                        width=0.0, length=0.0, cfg=rough)
        self.model = model = builder.finalize(device="cpu")
        self.pull(0.0)
        material = {"young_modulus": parameters["young"], "poisson_ratio": parameters["poisson"],
                    "tensile_yield_ratio": 1.0, "yield_pressure": 1e15, "yield_stress": 1e15}
        for name, value in material.items():
            if hasattr(model, "mpm"):  # otherwise the configuration has them
                getattr(model.mpm, name).fill_(value)
        self.solver = SolverImplicitMPM(model, self.config(problem.h, material))
        self.states = [model.state(), model.state()]

    def config(self, h: float, material: dict[str, float]) -> object:
        """The options that this release has. Before 1.1, velocities are linear and conjugate gradients are
        missing."""
        config = (getattr(SolverImplicitMPM, "Config", None) or SolverImplicitMPM.Options)()
        options = {"voxel_size": h, "air_drag": self.drag, "tolerance": self.tolerance, "grid_type": "dense",
                   "grid_padding": 2, "solver": "gauss-seidel" if self.friction else "cg",
                   "carry_residual_strain": "unconverged", **self.options, **material}
        if not hasattr(config, "velocity_basis"):
            options |= {"solver": "gauss-seidel", "strain_basis": "P0"}
        for name, value in options.items():
            if hasattr(config, name):
                setattr(config, name, value)
        return config

    def layers(self, vectors: Array, side: float) -> Array:
        """Vectors in space; those of a plane body are repeated in two layers, `side` apart."""
        if not self.friction:
            return vectors
        across = np.repeat([-side / 2, side / 2], len(vectors))
        return np.column_stack([np.tile(vectors, (2, 1)), across])

    def pull(self, time: float) -> None:
        """Sets the gravity."""
        varies = self.problem.message["body_force"] == "asked"
        value = self.problem.body_force(time)[0] if varies else gravity(self.problem)
        self.model.set_gravity([*map(float, value), 0.0][:3])

    def advance(self, steps: int, dt: float, time: float) -> None:
        for step in range(steps * self.substeps):
            if self.friction:
                self.pull(time + step * dt / self.substeps)
                self.solver.notify_model_changed(newton.ModelFlags.MODEL_PROPERTIES)
            self.solver.step(*self.states, None, None, dt / self.substeps)
            self.states.reverse()

    def state(self) -> Message:
        state, (n, d) = self.states[0], self.problem.position.shape
        x, v = (array.numpy().astype(float)[:n, :d] for array in (state.particle_q, state.particle_qd))
        answer = {"displacement": x - self.problem.reference_position, "velocity": v}
        if hasattr(state, "mpm") and hasattr(state.mpm, "particle_stress"):  # positive in compression
            answer["stress"] = -state.mpm.particle_stress.numpy().astype(float)[:n, :d, :d]
        return answer


def vectors(values: Array) -> list[tuple[float, ...]]:
    return [tuple(map(float, value)) for value in values.astype(np.float32)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    parser.add_argument("--friction", action="store_true", help="plane bodies with walls")
    parser.add_argument("--substeps", type=int, default=1, help="of each step")
    parser.add_argument("--drag", type=float, default=1e-6, help="that of the air, 1 unless said")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="1e-4 unless said")
    parser.add_argument("--velocity-basis", default="B2")
    parser.add_argument("--strain-basis", default="P1d")
    parser.add_argument("--integration-scheme", choices=["pic", "gimp"], default="pic")
    parser.add_argument("--transfer-scheme", choices=["pic", "apic"], default="apic")
    serve(Newton(**vars(parser.parse_args())))
