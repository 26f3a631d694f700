"""An elastic bar with a pulse of 1e-3 m/s. Expected: velocities of at most 1e-3 m/s. Arguments: options."""

import sys

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True
h, dt = 1 / 32, 2e-4  # the wave passes a fifth of a cell in each step
axis = [start + h / 2 * (np.arange(n) + 0.5) for start, n in ((4 * h, 48), (15 * h, 4), (15 * h, 4))]
x = np.stack(np.meshgrid(*axis, indexing="ij"), -1).reshape(-1, 3)
v = np.zeros_like(x)
v[:, 0] = 1e-3 * np.cos(2 * np.pi * np.clip(x[:, 0] - 0.5, -0.25, 0.25)) ** 4

builder = newton.ModelBuilder()
SolverImplicitMPM.register_custom_attributes(builder)
builder.add_particles(pos=[tuple(p) for p in x], vel=[tuple(p) for p in v], mass=[1e3 * (h / 2) ** 3] * len(x),
                      radius=[h / 4] * len(x))
model = builder.finalize(device="cpu")
model.set_gravity((0.0, 0.0, 0.0))
for name, value in {"young_modulus": 1e6, "poisson_ratio": 0.0, "tensile_yield_ratio": 1.0,
                    "yield_pressure": 1e15, "yield_stress": 1e15}.items():
    getattr(model.mpm, name).fill_(value)
options = dict(option.split("=") for option in sys.argv[1:])
config = SolverImplicitMPM.Config(voxel_size=h, air_drag=1e-6, grid_type="dense", grid_padding=2, **options)
solver = SolverImplicitMPM(model, config=config)
now, after = model.state(), model.state()
for step in range(1, 17):
    solver.step(now, after, None, None, dt)
    now, after = after, now
    fastest = np.abs(now.particle_qd.numpy()).max()
    if not fastest < 0.1:
        break
print(f"newton {newton.__version__}, {options}: largest velocity {fastest:.2e} m/s after {step} steps")
