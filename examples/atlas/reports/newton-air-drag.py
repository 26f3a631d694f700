"""A cube in uniform motion (0.1 m/s) without gravity: velocities after up to 40 steps. Argument: air_drag."""

import sys

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True
h, n, dt = 0.125, 8, 0.05
axis = (np.arange(n) + 0.5) * h / 2
x = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
for basis in ("Q1", "B2", "B3"):
    builder = newton.ModelBuilder()
    SolverImplicitMPM.register_custom_attributes(builder)
    builder.add_particles(pos=[tuple(p) for p in x], vel=[(0.1, 0.0, 0.0)] * len(x),
                          mass=[1000 * (h / 2) ** 3] * len(x), radius=[h / 4] * len(x))
    model = builder.finalize(device="cpu")
    model.set_gravity((0.0, 0.0, 0.0))
    for name in ("yield_pressure", "yield_stress"):
        getattr(model.mpm, name).fill_(1e15)
    model.mpm.young_modulus.fill_(1000.0)
    solver = SolverImplicitMPM(model, SolverImplicitMPM.Config(
        voxel_size=h, grid_type="dense", grid_padding=2, velocity_basis=basis, air_drag=float(sys.argv[1])))
    now, after = model.state(), model.state()
    for step in range(1, 41):
        solver.step(now, after, None, None, dt)
        now, after = after, now
        v = now.particle_qd.numpy()[:, 0]
        if np.isnan(v).any():
            break
    print(f"newton {newton.__version__}, {basis}, step {step}: {np.isnan(v).sum()} of {len(v)} velocities are NaN, "
          f"mean of the others {np.nanmean(v):.6f} m/s")
