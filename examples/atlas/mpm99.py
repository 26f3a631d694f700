"""Taichi's example mpm99: MLS-MPM, quadratic B-splines, APIC, two dimensions.

Hu et al. (2018), ACM Trans. Graph. 37. Its kernel has a constant downward acceleration of 50. The
time unit is chosen so that this is the gravity of the problem, or negligible. The body does not
reach the walls.

With `--derivatives` the kernel is differentiated by Taichi in reverse mode, unmodified: `checked` has the
check of Taichi's rules as well. Young's modulus is then a field: material 3 (neither liquid, jelly nor
snow) has the modulus E exp(10 (1 - Jp)).
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
ELASTIC, HARDENING = 3, 10.0  # another material, and its constant
PAD = 6


class Mpm99:
    name = "taichi-mpm99"
    version = ".".join(map(str, ti.__version__))

    def __init__(self, precision: str, any_law: bool, derivatives: str | None, gravity: str) -> None:
        self.bits, self.precision, self.derivatives = precision, PRECISION[precision], derivatives
        self.capabilities = {"dimensions": [2], "laws": laws(["corotated"], any_law),
                             "conditions": ["free"], "loads": ["gravity"] if gravity == "on" else [],
                             "several_bodies": True}
        if derivatives:
            self.capabilities["gradients"] = ["young", "density", "initial_velocity"]

    def setup(self, problem: Problem) -> None:
        self.box = box = Box(problem, PAD, self.second(problem))
        self.code = code = self.load()
        code.n_grid, code.dx, code.inv_dx = box.n, box.dx, 1 / box.dx
        code.dt = problem.dt / box.second
        code.p_vol = code.p_mass = box.volume
        code.mu_0, code.lambda_0 = box.mu / SOFTER, box.lam / SOFTER
        n, real = len(box.x), {"dtype": float, "needs_grad": self.derivatives is not None}
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
        self.value = ti.field(**real, shape=())

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
        ti.init = lambda **_: start(arch=ti.cpu, default_fp=precision, cpu_max_num_threads=1,
                                    debug=self.derivatives == "checked")
        from taichi.examples.simulation import mpm99
        return mpm99

    def advance(self, steps: int, dt: float, time: float) -> None:
        for _ in range(steps):
            self.code.substep()

    def differentiate(self, of: Message, with_respect_to: list[str], steps: int, dt: float
                      ) -> tuple[float, list[float]]:
        """The mean square displacement and its derivatives, by Taichi."""
        if of["functional"] != "mean_square_displacement":
            raise Cannot(f"no gradient of {of['functional']}")
        code, box = self.code, self.box
        code.mu_0, code.lambda_0 = box.mu, box.lam
        code.material.fill(ELASTIC)
        of_log_young, of_velocity = self.reverse(steps, self.functional())
        if not np.isfinite([of_log_young, of_velocity]).all():
            raise ArithmeticError(f"the derivatives are {of_log_young} and {of_velocity}")
        material = box.problem.materials[0]
        # The motion depends on the ratio of Young's modulus and density.
        slopes = {"young": of_log_young / material["parameters"]["young"],
                  "density": -of_log_young / material["density"], "initial_velocity": of_velocity}
        unit = box.metre**-2
        return self.value[None] * unit, [slopes[name] * unit for name in with_respect_to]

    def functional(self) -> Any:
        """A kernel that adds the mean square displacement in units of the code to `value`."""
        start = ti.Vector.field(2, dtype=float, shape=len(self.box.x))
        start.from_numpy((self.box.problem.reference_position - self.box.origin) * self.box.metre)
        value, x, n = self.value, self.code.x, len(self.box.x)

        @ti.kernel
        def add():  # type: ignore[no-untyped-def]
            for p in x:
                value[None] += (x[p] - start[p]).norm_sqr() / n

        return add

    def reverse(self, steps: int, functional: Any) -> tuple[float, float]:
        """Derivatives with respect to the logarithm of Young's modulus, and to a factor on the
        velocities, in one pass back."""
        code = self.code
        try:
            with ti.ad.Tape(self.value, validation=self.derivatives == "checked"):
                self.advance(steps, 0.0, 0.0)
                functional()
        except ti.TaichiAssertionError as error:
            raise Cannot(" ".join(str(error).split("File")[0].split())) from None
        return (float(-code.Jp.grad.to_numpy().sum() / HARDENING),
                float((code.v.grad.to_numpy() * self.box.v).sum()))

    def state(self) -> Message:
        return self.box.motion(self.code.x.to_numpy(), self.code.v.to_numpy())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--precision", choices=["f32", "f64"], default="f32")
    parser.add_argument("--derivatives", choices=["tape", "checked"],
                        help="by Taichi's automatic differentiation")
    parser.add_argument("--gravity", choices=["on", "off"], default="on", help="off: problems without "
                        "gravity only, for `doctor`, whose gravity does not act downwards")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    serve(Mpm99(**vars(parser.parse_args())))
