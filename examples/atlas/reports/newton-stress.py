"""A cube whose elastic strain along x is given: the Cauchy stress (Pa) after one short step, positive in tension."""

import newton
import numpy as np
import warp as wp
from newton.solvers import SolverImplicitMPM

wp.config.quiet = True
h, n, young = 0.125, 8, 1000.0
axis = (np.arange(n) + 0.5) * h / 2
x = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
for strain in (1e-3, -1e-3):
    builder = newton.ModelBuilder()
    SolverImplicitMPM.register_custom_attributes(builder)
    builder.add_particles(pos=[tuple(p) for p in x], vel=[(0.0, 0.0, 0.0)] * len(x),
                          mass=[1000 * (h / 2) ** 3] * len(x), radius=[h / 4] * len(x))
    model = builder.finalize(device="cpu")
    model.set_gravity((0.0, 0.0, 0.0))
    for name, value in {"young_modulus": young, "poisson_ratio": 0.0, "tensile_yield_ratio": 1.0,
                        "yield_pressure": 1e15, "yield_stress": 1e15}.items():
        getattr(model.mpm, name).fill_(value)
    solver = SolverImplicitMPM(model, SolverImplicitMPM.Config(voxel_size=h, grid_type="dense", grid_padding=2))
    now, after = model.state(), model.state()
    f = np.diag([1 + strain, 1.0, 1.0]).astype(np.float32)
    now.mpm.particle_elastic_strain.assign(np.tile(f, (len(x), 1, 1)))
    solver.step(now, after, None, None, 1e-4)
    stress = after.mpm.particle_stress.numpy()[:, 0, 0].mean()
    print(f"newton {newton.__version__}, strain {strain:+g}: stress {stress:+.3f} Pa, "
          f"expected {young * strain:+.3f} Pa")
