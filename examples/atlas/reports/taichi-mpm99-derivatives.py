"""Taichi's example mpm99, unmodified: derivative of the mean height of a body with respect to its vertical velocity."""

import sys

import taichi as ti

checked, start = "checked" in sys.argv, ti.init
ti.init = lambda **_: start(arch=ti.cpu, default_fp=ti.f64, cpu_max_num_threads=1, debug=checked)
from taichi.examples.simulation import mpm99 as code  # noqa: E402

n, grid, kind = 64, (code.n_grid, code.n_grid), {"dtype": float, "needs_grad": True}
code.x, code.v = (ti.Vector.field(2, **kind, shape=n) for _ in range(2))
code.C, code.F = (ti.Matrix.field(2, 2, **kind, shape=n) for _ in range(2))
code.Jp, code.material, height = ti.field(**kind, shape=n), ti.field(int, n), ti.field(**kind, shape=())
code.grid_v, code.grid_m = ti.Vector.field(2, **kind, shape=grid), ti.field(**kind, shape=grid)


@ti.kernel
def begin():
    for i in range(n):
        code.x[i] = (ti.Vector([i // 8, i % 8]) * 0.5 + 64.25) * code.dx
        code.v[i], code.F[i], code.C[i] = [0, 0], [[1, 0], [0, 1]], [[0, 0], [0, 0]]
        code.Jp[i], code.material[i] = 1, 1


@ti.kernel
def measure():
    for i in code.x:
        height[None] += code.x[i][1] / n


print("taichi", ti.__version__)
for steps in (1, 2, 5, 20):
    begin()
    with ti.ad.Tape(height, validation=checked):
        for _ in range(steps):
            code.substep()
        measure()
    slope = sum(code.v.grad[i][1] for i in range(n))
    print(f"{steps} steps: derivative {slope:.4e} s; expected {steps * code.dt:.4e} s")
