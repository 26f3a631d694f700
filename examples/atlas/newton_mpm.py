"""Newton's implicit MPM: three dimensions, Hencky's law, in single precision.

It works with newton 0.1.3 to 1.8.0. With `--friction` it runs plane bodies with walls. The body is two
layers of particles, with free faces in front and behind. Without lateral strain (Poisson's ratio 0) its
motion is plane.
"""

from __future__ import annotations

import argparse
from dataclasses import fields

import numpy as np
from box import Array, Cannot, Message, Problem, aside, common_material, gravity, laws, uniform
from mpm_verify import serve

with aside():
    import newton
    import warp as wp
    from newton.solvers import SolverImplicitMPM

    wp.config.quiet = True
    wp.init()

# In 0.1.3 the options contain the material, and states and models have no attributes of the solver.
FIRST = hasattr(SolverImplicitMPM, "Options")
Config = SolverImplicitMPM.Options if FIRST else SolverImplicitMPM.Config
OPTIONS = {field.name for field in fields(Config)}
PROPERTIES = getattr(newton, "ModelFlags", None) or newton.solvers.SolverNotifyFlags


class Newton:
    name = "newton-mpm"
    version = newton.__version__
    precision = "single"

    def __init__(self, any_law: bool, friction: bool, substeps: int, drag: float, **options: object) -> None:
        self.friction, self.substeps, self.drag = friction, substeps, drag
        # Elastic bodies explode with strain basis P1d in releases without `carry_residual_strain`.
        wanted: dict[str, object] = {"strain_basis": "P0", "tolerance": 1e-6}
        if "carry_residual_strain" in OPTIONS:
            # With a larger tolerance, residual strains of small vibrations make them grow.
            wanted = {"strain_basis": "P1d", "carry_residual_strain": "unconverged", "tolerance": 1e-9}
        wanted |= {"velocity_basis": "B2"} if "velocity_basis" in OPTIONS else {}
        self.options = wanted | {key: value for key, value in options.items() if value}
        builder = newton.ModelBuilder()
        if not FIRST:
            SolverImplicitMPM.register_custom_attributes(builder)
        self.has_stress = not FIRST and "mpm:particle_stress" in builder.custom_attributes
        self.capabilities = {"dimensions": [3], "laws": laws(["hencky"], any_law),
                             "conditions": ["free"], "loads": ["gravity"], "several_bodies": True}
        if self.has_stress:
            self.capabilities["columns"] = ["stress"]
        if friction:
            self.capabilities |= {"dimensions": [2], "conditions": ["free"] if FIRST else ["free", "friction"]}

    def setup(self, problem: Problem) -> None:
        if lacking := self.options.keys() - OPTIONS:
            raise Cannot(f"newton {self.version} without the options {', '.join(lacking)}")
        parameters = common_material(problem)["parameters"]
        self.problem = problem
        volume, mass = uniform("volumes", problem.volume), uniform("masses", problem.mass)
        builder = newton.ModelBuilder()
        if not FIRST:
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
        if FIRST:
            model.particle_ke = model.particle_kd = model.particle_adhesion = model.particle_cohesion = None
        else:
            for name, value in material.items():
                getattr(model.mpm, name).fill_(value)
        options = {"voxel_size": problem.h, "air_drag": self.drag * mass / volume, "grid_type": "dense",
                   "grid_padding": 2, "solver": "gauss-seidel" if self.friction or FIRST else "cg",
                   **material, **self.options}
        self.solver = SolverImplicitMPM(model, Config(**{k: v for k, v in options.items() if k in OPTIONS}))
        self.states = [model.state(), model.state()]
        if FIRST:
            self.solver.mpm_model.setup_collider(ground_height=-1e3)  # 0 unless said
            for state in self.states:
                SolverImplicitMPM.enrich_state(state)

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
                self.solver.notify_model_changed(PROPERTIES.MODEL_PROPERTIES)
            self.solver.step(*self.states, None, None, dt / self.substeps)
            self.states.reverse()

    def state(self) -> Message:
        state, (n, d) = self.states[0], self.problem.position.shape
        x, v = (array.numpy().astype(float)[:n, :d] for array in (state.particle_q, state.particle_qd))
        answer = {"displacement": x - self.problem.reference_position, "velocity": v}
        if self.has_stress:  # newton's is positive in compression
            answer["stress"] = -state.mpm.particle_stress.numpy().astype(float)[:n, :d, :d]
        return answer


def vectors(values: Array) -> list[tuple[float, ...]]:
    return [tuple(map(float, value)) for value in values.astype(np.float32)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    parser.add_argument("--friction", action="store_true", help="plane bodies with walls")
    parser.add_argument("--substeps", type=int, default=1, help="of each step")
    parser.add_argument("--drag", type=float, default=1e-6, help="of the air, per density (1/s)")
    parser.add_argument("--tolerance", type=float, help="default: 1e-9, or 1e-6 before 1.8.0")
    parser.add_argument("--solver", help="default: cg, or gauss-seidel with friction")
    parser.add_argument("--velocity-basis", help="default: B2, or Q1 before 1.1.0")
    parser.add_argument("--strain-basis", help="default: P1d, or P0 before 1.8.0")
    parser.add_argument("--integration-scheme", choices=["pic", "gimp"])
    parser.add_argument("--transfer-scheme", choices=["pic", "apic"], default="apic")
    serve(Newton(**vars(parser.parse_args())))
