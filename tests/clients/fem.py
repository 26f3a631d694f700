"""Bilinear finite elements on squares, explicit in time, in NumPy, as a solver under test.

    mpm-verify doctor --solver 'python3 tests/clients/fem.py'

Numbers of Gauss points other than two along each axis are planted faults. The laws and the step are those of
examples/solvers/lagrangian.py, and the mesh, walls and initial state those of examples/atlas/fem_body.py.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "examples/solvers"), str(ROOT / "examples/atlas")]
from fem_body import FiniteElements
from lagrangian import LAWS
from mpm_verify import Array, Message, Problem, serve  # noqa: F401, tests take `Problem` from here

QUADRATURE = [-1 / 3**0.5, 1 / 3**0.5]  # points along each axis of an element, from -1 to 1


class Fem(FiniteElements):
    """Squares with four nodes."""

    name, version = "fem", "1.0"
    elements = {(2, 1): None}

    def make_mesh(self, axes: list[Array]) -> None:
        self.nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
        number = np.arange(len(self.nodes)).reshape(len(axes[0]), len(axes[1]))
        corners = [number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]]
        points = [(x, y) for x in QUADRATURE for y in QUADRATURE]
        signs = np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)])
        factors = [1 + signs * point for point in points]
        sizes = np.array([axis[1] - axis[0] for axis in axes])
        cells = np.stack([corner.ravel() for corner in corners], axis=1)
        self.cells = np.repeat(cells, len(points), axis=0)  # nodes of each quadrature point
        self.n = np.tile([f.prod(axis=1) / 4 for f in factors], (len(cells), 1))
        self.dn = np.tile([signs * f[:, ::-1] / 2 / sizes for f in factors], (len(cells), 1, 1))
        self.weight = np.full(len(self.n), sizes.prod() / len(points))
        self.gauss = self.at_gauss(self.nodes)

    def make_law(self, material: Message, stress: Array) -> None:
        self.law = LAWS[material["law"]](material["parameters"])
        self.law.start(self.gradient(), stress)

    def gradient(self) -> Array:
        return np.eye(2) + np.einsum("pka,pkb->pab", self.u[self.cells], self.dn)

    def at_gauss(self, field: Array) -> Array:
        values: Array = np.einsum("pk,pka->pa", self.n, field[self.cells])
        return values

    def at_nodes(self, terms: Array) -> Array:
        size = len(self.nodes)
        sums = [np.bincount(self.cells.ravel(), terms[..., a].ravel(), size) for a in (0, 1)]
        return np.stack(sums, axis=1)

    def load(self, force: Array) -> Array:
        return self.at_nodes(np.einsum("p,pk,pa->pka", self.weight, self.n, force))

    def internal_force(self) -> Array:
        stress = self.law.piola(self.gradient())
        return self.at_nodes(np.einsum("p,pab,pkb->pka", self.weight, stress, self.dn))


if __name__ == "__main__":
    serve(Fem(1, "nodes"))
