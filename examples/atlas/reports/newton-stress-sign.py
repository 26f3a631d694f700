"""The stress of a block that stretches along x: positive if a Cauchy stress is positive in tension."""

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True
h, dt, rate, young = 0.125, 0.01, 0.1, 100.0
side = h / 2
axis = side * (np.arange(8) - 3.5)
x = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
v = np.outer(rate * x[:, 0], [1.0, 0.0, 0.0])

builder = newton.ModelBuilder()
SolverImplicitMPM.register_custom_attributes(builder)
builder.add_particles(pos=[tuple(p) for p in x], vel=[tuple(p) for p in v], mass=[side**3] * len(x),
                      radius=[side / 2] * len(x))
model = builder.finalize(device="cpu")
model.set_gravity((0.0, 0.0, 0.0))
for name, value in {"young_modulus": young, "poisson_ratio": 0.0, "tensile_yield_ratio": 1.0,
                    "yield_pressure": 1e15, "yield_stress": 1e15}.items():
    getattr(model.mpm, name).fill_(value)
solver = SolverImplicitMPM(model, config=SolverImplicitMPM.Config(voxel_size=h, air_drag=1e-6, grid_type="dense"))
now, after = model.state(), model.state()
solver.step(now, after, None, None, dt)
inner = np.abs(x).max(axis=1) < 2 * side
length = np.polyfit(x[inner, 0], after.particle_q.numpy()[inner, 0], 1)[0]
stress = after.mpm.particle_stress.numpy()[inner, 0, 0].mean()
print(f"newton {newton.__version__}: the middle of the block is {length:.6f} times as long; particle_stress xx is "
      f"{stress:.4g} Pa, expected about {young * (length - 1):.4g} Pa")
