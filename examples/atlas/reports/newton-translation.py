"""A block of elastic particles in uniform motion, without gravity or walls: positions should be x + v t."""

import sys

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True
h, steps, dt = 0.125, 8, 0.05
side = h / 2
axis = 0.375 + side * (np.arange(4) + 0.5)
x = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
v = np.array([0.1, -0.07, 0.04])

builder = newton.ModelBuilder()
SolverImplicitMPM.register_custom_attributes(builder)
builder.add_particles(pos=[tuple(p) for p in x], vel=[tuple(v)] * len(x), mass=[side**3] * len(x),
                      radius=[side / 2] * len(x))
model = builder.finalize(device="cpu")
model.set_gravity((0.0, 0.0, 0.0))
for name, value in {"young_modulus": 1.0, "poisson_ratio": 0.0, "tensile_yield_ratio": 1.0,
                    "yield_pressure": 1e15, "yield_stress": 1e15}.items():
    getattr(model.mpm, name).fill_(value)
config = SolverImplicitMPM.Config(voxel_size=h, air_drag=1e-6, **dict(option.split("=") for option in sys.argv[1:]))
solver = SolverImplicitMPM(model, config=config)
now, after = model.state(), model.state()
print(f"newton {newton.__version__}, warp {wp.__version__}")
for step in range(1, steps + 1):
    solver.step(now, after, None, None, dt)
    now, after = after, now
    error = np.abs(now.particle_q.numpy() - x - v * dt * step).max()
    print(f"step {step}: largest error of a position {error:.1e}; expected about 1e-6")
