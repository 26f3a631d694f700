"""Taichi's example mpm99: MLS-MPM, quadratic B-splines, APIC, two dimensions.

Hu et al. (2018), ACM Trans. Graph. 37. Its kernel has a constant downward acceleration of 50. The
time unit is chosen so that this is the gravity of the problem, or negligible. The body does not
reach the walls.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from box import PRECISION, Box, Cannot, Message, Problem, aside, gravity, laws
from mpm_verify import serve

with aside():
    import taichi as ti

GRAVITY, JELLY, SOFTER = 50.0, 1, 0.3  # constants of mpm99
PAD = 6


class Mpm99:
    name = "taichi-mpm99"
    version = ".".join(map(str, ti.__version__))

    def __init__(self, precision: str, any_law: bool) -> None:
        self.bits, self.precision = precision, PRECISION[precision]
        self.capabilities = {"dimensions": [2], "laws": laws(["corotated"], any_law),
                             "conditions": ["free"], "loads": ["gravity"]}

    def setup(self, problem: Problem) -> None:
        self.box = box = Box(problem, PAD, self.second(problem))
        self.code = code = self.load()
        code.n_grid, code.dx, code.inv_dx = box.n, box.dx, 1 / box.dx
        code.dt = problem.dt / box.second
        code.p_vol = code.p_mass = box.volume
        code.mu_0, code.lambda_0 = box.mu / SOFTER, box.lam / SOFTER
        n, real = len(box.x), {"dtype": float}
        for name, start in [("x", box.x), ("v", box.v)]:
            setattr(code, name, ti.Vector.field(2, **real, shape=n))
            getattr(code, name).from_numpy(start)
        code.C = ti.Matrix.field(2, 2, **real, shape=n)
        code.F = ti.Matrix.field(2, 2, **real, shape=n)
        code.F.from_numpy(np.tile(np.eye(2), (n, 1, 1)))
        code.Jp, code.material = ti.field(**real, shape=n), ti.field(dtype=int, shape=n)
        code.Jp.fill(1)
        code.material.fill(JELLY)
        code.grid_v = ti.Vector.field(2, **real, shape=(box.n, box.n))
        code.grid_m = ti.field(**real, shape=(box.n, box.n))

    def second(self, problem: Problem) -> float:
        """The unit of time (s)."""
        across, down = gravity(problem)
        unit = Box(problem, PAD)
        if across or down > 0:
            raise Cannot("gravity that does not act downwards")
        if down:
            return float(np.sqrt(GRAVITY / (-down * unit.metre)))
        return float(1e8 / np.sqrt(unit.young))  # a wave crosses the box in 1e-8

    def load(self) -> Any:
        start = ti.init
        precision = {"f32": ti.f32, "f64": ti.f64}[self.bits]
        # One thread: sums in a fixed order.
        ti.init = lambda **_: start(arch=ti.cpu, default_fp=precision, cpu_max_num_threads=1)
        from taichi.examples.simulation import mpm99
        return mpm99

    def advance(self, steps: int, dt: float, time: float) -> None:
        for _ in range(steps):
            self.code.substep()

    def state(self) -> Message:
        return self.box.motion(self.code.x.to_numpy(), self.code.v.to_numpy())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--precision", choices=["f32", "f64"], default="f32")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    serve(Mpm99(**vars(parser.parse_args())))
