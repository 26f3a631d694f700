"""scikit-fem: finite elements on lines, squares and cubes, explicit in time.

The package assembles and interpolates. lagrangian.py provides the step, the lumped mass and the
laws.
"""

from __future__ import annotations

import numpy as np
import skfem
from box import Array, Message
from fem_body import FiniteElements, main
from lagrangian import LAWS

MESHES = {1: skfem.MeshLine, 2: skfem.MeshQuad, 3: skfem.MeshHex}


@skfem.LinearForm
def virtual_work(v, w):
    """Linear form of the row `w.p` of the first Piola-Kirchhoff stress."""
    return sum(w.p[k] * v.grad[k] for k in range(len(v.grad)))


@skfem.LinearForm
def body_load(v, w):
    return w.force * v


class ScikitFem(FiniteElements):
    name = "scikit-fem"
    version = skfem.__version__
    elements = {
        (1, 1): skfem.ElementLineP1, (2, 1): skfem.ElementQuad1, (3, 1): skfem.ElementHex1,
        (1, 2): skfem.ElementLineP2, (2, 2): skfem.ElementQuad2, (3, 2): skfem.ElementHex2}

    def make_mesh(self, axes: list[Array]) -> None:
        d = len(axes)
        mesh = MESHES[d].init_tensor(*axes)
        element = self.elements[d, self.degree]()
        self.basis = skfem.Basis(mesh, element, intorder=2 * self.degree + 1)
        self.nodes = self.basis.doflocs.T.copy()
        self.gauss = np.moveaxis(np.asarray(self.basis.global_coordinates()), 0, -1).reshape(-1, d)
        self.weight = self.basis.dx.ravel()

    def make_law(self, material: Message, stress: Array) -> None:
        self.law = LAWS[material["law"]](material["parameters"])
        self.law.start(self.deformation_gradient(), stress)

    def at_gauss(self, field: Array) -> Array:
        columns = [np.asarray(self.basis.interpolate(column)).ravel() for column in field.T]
        return np.stack(columns, axis=1)

    def load(self, force: Array) -> Array:
        shape = self.basis.dx.shape
        columns = [body_load.assemble(self.basis, force=f.reshape(shape)) for f in force.T]
        return np.stack(columns, axis=1)

    def deformation_gradient(self) -> Array:
        """F at the quadrature points."""
        d = self.u.shape[1]
        rows = [self.basis.interpolate(column).grad.reshape(d, -1) for column in self.u.T]
        return np.eye(d) + np.stack(rows).transpose(2, 0, 1)

    def internal_force(self) -> Array:
        shape = self.basis.dx.shape
        piola = self.law.piola(self.deformation_gradient()).transpose(1, 2, 0)
        columns = [virtual_work.assemble(self.basis, p=row.reshape(-1, *shape)) for row in piola]
        return np.stack(columns, axis=1)


if __name__ == "__main__":
    main(ScikitFem)
