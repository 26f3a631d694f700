"""Small problems for newton's implicit MPM, with expected results: `python3 newton-block.py NAME [OPTION=VALUE...]`.

Options are those of SolverImplicitMPM.Config.
"""

import sys

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True


class Block:
    """An elastic cuboid of particles, two per cell of size h along each axis, with velocities v(x) along x (m/s)."""

    def __init__(self, h, low, counts, young, v, **options):
        index = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), -1).reshape(-1, 3)
        self.x = low * h + (index + 0.5) * h / 2
        n, builder = len(self.x), newton.ModelBuilder()
        SolverImplicitMPM.register_custom_attributes(builder)
        builder.add_particles(pos=[tuple(p) for p in self.x], vel=[(v(p[0]), 0.0, 0.0) for p in self.x],
                              mass=[1000 * (h / 2) ** 3] * n, radius=[h / 4] * n)
        model = builder.finalize(device="cpu")
        model.set_gravity((0.0, 0.0, 0.0))
        for name, value in {"young_modulus": young, "poisson_ratio": 0.0, "tensile_yield_ratio": 1.0,
                            "yield_pressure": 1e15, "yield_stress": 1e15}.items():
            getattr(model.mpm, name).fill_(value)
        config = SolverImplicitMPM.Config(voxel_size=h, grid_type="dense", grid_padding=2, **options)
        self.solver, self.states = SolverImplicitMPM(model, config), [model.state(), model.state()]

    def step(self, dt):
        """Velocities along x after a step."""
        self.solver.step(*self.states, None, None, dt)
        self.states.reverse()
        return self.states[0].particle_qd.numpy()[:, 0]


def strain_basis(**options):
    """A bar with a pulse. The wave passes a fifth of a cell in each step."""
    bar = Block(1 / 32, np.array([4, 15, 15]), (48, 4, 4), 1e6,
                lambda x: 1e-3 * np.cos(2 * np.pi * np.clip(x - 0.5, -0.25, 0.25)) ** 4, air_drag=1e-6, **options)
    for step in range(1, 17):
        fastest = np.abs(bar.step(2e-4)).max()
        if not fastest < 0.1:
            break
    print(f"largest velocity {fastest:.2e} m/s after {step} steps, expected at most 1e-3 m/s")


def air_drag(v=0.1, dt=0.05, **options):
    """A cube in uniform motion."""
    cube = Block(0.125, np.zeros(3), (8, 8, 8), 1e3, lambda x: v, **options)
    for step in range(1, 41):
        velocities = cube.step(dt)
        if np.isnan(velocities).any():
            break
    print(f"step {step}: {np.isnan(velocities).sum()} of {len(velocities)} velocities are NaN, "
          f"mean of the others {np.nanmean(velocities):.6f} m/s, expected {v} m/s")


def on_faces(**options):
    """A cube in uniform motion. The particles lie on faces of cells after every fourth step, without rounding errors."""
    air_drag(0.125, 0.0625, **options)


def stress(**options):
    """A cube with an elastic strain along x: Cauchy stress and force (momentum over time) after one short step."""
    for strain in (1e-3, -1e-3, 0.3):
        cube = Block(0.125, np.zeros(3), (8, 8, 8), 1e3, lambda x: 0.0, **options)
        stretch = np.diag([1 + strain, 1.0, 1.0]).astype(np.float32)
        cube.states[0].mpm.particle_elastic_strain.assign(np.tile(stretch, (len(cube.x), 1, 1)))
        push = 1000 * 0.0625**3 * cube.step(1e-4)[cube.x[:, 0] > 0.25].sum() / 1e-4
        mean = cube.states[0].mpm.particle_stress.numpy()[:, 0, 0].mean()
        expected = 1e3 * np.log1p(strain)  # Kirchhoff stress
        print(f"strain {strain:+g}: stress {mean:+.3f} Pa, expected {expected / (1 + strain):+.3f} Pa; "
              f"force on the right half {push:+.4f} N, expected {-0.25 * expected:+.4f} N")


if __name__ == "__main__":
    print("newton", newton.__version__, *sys.argv[1:])
    options = dict(option.split("=") for option in sys.argv[2:])
    numbers = {key: float(value) if key == "air_drag" else value for key, value in options.items()}
    globals()[sys.argv[1].replace("-", "_")](**numbers)
