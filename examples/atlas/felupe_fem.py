"""felupe: finite elements on lines, squares and cubes, explicit in time.

The package provides meshes, fields, the assembly, and the neo-Hookean law. lagrangian.py provides the
step, the lumped mass and the other laws.
"""

from __future__ import annotations

import felupe
import numpy as np
from box import Array, Message
from fem_body import FiniteElements, main
from lagrangian import LAWS, Material


class UserMaterial(felupe.ConstitutiveMaterial):
    """A law of lagrangian.py as a material of felupe, whose tensors have the axes (i, j, q, c)."""

    def __init__(self, law: Material) -> None:
        self.law, self.x = law, [np.eye(3), np.zeros(0)]

    def gradient(self, x: list[Array]) -> list[Array]:
        d, _, *shape = x[0].shape
        piola = self.law.piola(x[0].reshape(d, d, -1).transpose(2, 0, 1))
        return [piola.transpose(1, 2, 0).reshape(d, d, *shape), x[1]]


class Felupe(FiniteElements):
    name = "felupe"
    version = felupe.__version__
    elements = {
        (1, 1): felupe.element.Line, (2, 1): felupe.element.Quad,
        (3, 1): felupe.element.Hexahedron, (2, 2): felupe.element.BiQuadraticQuad,
        (3, 2): felupe.element.TriQuadraticHexahedron}

    def make_mesh(self, axes: list[Array]) -> None:
        d = len(axes)
        mesh = felupe.Grid(*axes)
        if self.degree == 2:
            mesh = mesh.convert(2, calc_points=True, calc_midfaces=True, calc_midvolumes=d == 3)
        quadrature = felupe.GaussLegendre(order=self.degree, dim=d)
        self.region = felupe.Region(mesh, self.elements[d, self.degree](), quadrature)
        self.nodes = mesh.points
        self.gauss, self.weight = self.at_gauss(self.nodes), self.region.dV.ravel()

    def container(self, values: Array) -> felupe.FieldContainer:
        """A field with these nodal values, of plane strain in two dimensions."""
        kind = felupe.FieldPlaneStrain if values.shape[1] == 2 else felupe.Field
        field = kind(self.region, dim=values.shape[1], values=values.copy())
        return felupe.FieldContainer([field])

    def make_law(self, material: Message, stress: Array) -> None:
        self.field = self.container(self.u)
        law = LAWS[material["law"]](material["parameters"])
        if material["law"] == "neo_hookean":
            umat = felupe.NeoHookeCompressible(mu=law.mu, lmbda=law.lam)
        else:
            f = self.field.extract()[0]
            pad = len(f) - stress.shape[1]  # felupe has F of plane strain in three dimensions
            f = f.reshape(len(f), len(f), -1).transpose(2, 0, 1)
            law.start(f, np.pad(stress, ((0, 0), (0, pad), (0, pad))))
            umat = UserMaterial(law)
        self.solid = felupe.SolidBody(umat, self.field)

    def at_gauss(self, field: Array) -> Array:
        values = felupe.Field(self.region, dim=field.shape[1], values=field).interpolate()
        return values.reshape(len(values), -1).T.copy()

    def load(self, force: Array) -> Array:
        field = self.container(np.zeros_like(self.nodes))
        values = force.T.reshape(-1, *self.region.dV.shape)
        form = felupe.IntegralForm([values], field, self.region.dV, grad_v=[False])
        return form.assemble().toarray().reshape(self.nodes.shape)

    def internal_force(self) -> Array:
        self.field[0].values[:] = self.u
        return self.solid.assemble.vector(self.field).toarray().reshape(self.nodes.shape)


if __name__ == "__main__":
    main(Felupe)
