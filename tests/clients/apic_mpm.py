"""An explicit APIC MPM with B-splines, in NumPy, as a solver under test.

    mpm-verify run SUITE --solver 'python3 tests/clients/apic_mpm.py --basis cubic_bspline'

Jiang, Schroeder, Selle, Teran & Stomakhin (2015), ACM Trans. Graph. 34. With `--gradient affine` forces and
velocity gradients use the moving least squares of Hu et al. (2018), ACM Trans. Graph. 37. Basis, walls,
materials and time steps are those of examples/solvers/numpy_mpm.py.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples/solvers"))
from mpm_verify import Array, Problem, serve
from numpy_mpm import Mpm


class Apic(Mpm):
    """MPM whose particles carry an affine velocity field: v_p + C_p (x - x_p)."""

    name = "apic-mpm"

    def __init__(self, basis: str, start: str, gradient: str) -> None:
        super().__init__(basis, "usl", 1.0, start)
        self.is_mls = gradient == "affine"
        # The moments change near walls, which costs moving least squares and cubic B-splines the order 2 there.
        walls = [] if self.is_mls or basis == "cubic_bspline" else ["fixed", "roller"]
        self.capabilities = {**self.capabilities, "conditions": ["free", "periodic", *walls],
                             "loads": ["gravity", "body_force"]}

    def setup(self, problem: Problem) -> None:
        self.affine = np.zeros((len(problem.position), problem.dimension, problem.dimension))
        super().setup(problem)

    def weigh(self) -> None:
        super().weigh()
        # Nodes lie at the Greville abscissae of their B-splines, so that sum_i w_i (x_i - x_p) = 0 at walls too.
        # The moments sum_i w_i (x_i - x_p) (x_i - x_p)^T are then diagonal.
        knots = self.cell[..., None, None] + np.arange(self.degree + 1)[:, None] + np.arange(self.degree) - self.degree + 1
        ends, is_periodic = np.array(self.problem.cells)[:, None, None], np.array(self.problem.periodic)[:, None, None]
        nodes = np.where(is_periodic, knots, np.clip(knots, 0, ends)).mean(axis=-1)
        along = self.problem.h * (nodes - self.s[..., None])
        offsets = itertools.product(range(self.degree + 1), repeat=self.d)
        self.offset = np.stack([along[:, range(self.d), list(r)] for r in offsets], axis=1)
        moment = np.einsum("pk,pka->pa", self.n, self.offset**2)
        self.by_moment = self.n[..., None] * self.offset / moment[:, None]
        if self.is_mls:
            self.dn = self.by_moment

    def velocity(self) -> Array:
        moved = self.v[:, None] + np.einsum("pab,pkb->pka", self.affine, self.offset)
        return self.per_mass(self.n[..., None] * self.m[:, None, None] * moved)

    def acceleration(self, time: float, _: float = 0.0) -> Array:
        stress = np.einsum("pkb,pab->pka", self.dn, self.vol[:, None, None] * self.sigma)
        force = self.m[:, None] * self.problem.body_force(time)
        return self.per_mass(self.n[..., None] * force[:, None] - stress)

    def take(self, velocity: Array) -> None:
        """Affine fields of the particles, from a nodal velocity."""
        self.affine = np.einsum("pka,pkb->pab", velocity[self.nodes], self.by_moment)

    def step(self, dt: float, time: float) -> None:
        self.weigh()
        if not self.started:
            # The problem states no velocity gradient: the first one is that of the mapped velocity.
            self.take(self.velocity())
        is_half = not self.started and self.start == "half_step_back"
        self.started = True
        velocity = self.velocity() + (0.5 if is_half else 1.0) * dt * self.acceleration(time)
        self.v = self.gather(velocity)
        self.take(velocity)
        self.strain(dt * np.einsum("pka,pkb->pab", velocity[self.nodes], self.dn))
        self.x += dt * self.gather(velocity)
        before = self.cell
        self.locate()
        self.crossings += np.any(self.cell != before, axis=1).sum()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--basis", choices=["quadratic_bspline", "cubic_bspline"], default="quadratic_bspline")
    parser.add_argument("--start", choices=["at_zero", "half_step_back"], default="at_zero",
                        help="time of the first velocity; the latter takes it to -dt/2")
    parser.add_argument("--gradient", choices=["basis", "affine"], default="basis",
                        help="gradients of the basis, or of moving least squares")
    serve(Apic(**vars(parser.parse_args())))
