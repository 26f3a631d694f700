"""Total-Lagrangian SPH in one to three dimensions, as a solver under test.

    mpm-verify run SUITE --solver 'python3 examples/solvers/sph.py'

Gradients are corrected to be exact for linear fields (Bonet & Lok 1999), neighbours are those of
the reference configuration, and forces are the derivative of an energy, so that momentum is
conserved.

Orders in h of the displacement, for particles on a lattice: 2 inside the body, and at rollers and
periodic ends, where images of the particles complete the neighbourhood. A free face cuts the
neighbourhood off: the gradient has order 1 there, in a layer as wide as the kernel. In the weak form
this is an error of order 2, and suites with free faces show order 2. Images at a fixed end are odd, so that a
displacement with a curvature there, as under gravity, has order 1 (sph.yaml). Off a lattice the order is 0, and
`setup` refuses.

The shortest wave of the lattice has no energy and is not damped. Smooth initial data do not excite it.
"""

from __future__ import annotations

import argparse
import itertools

import numpy as np

from lagrangian import LAWS, TotalLagrangian
from mpm_verify import Array, Cannot, Message, Problem, serve


class Sph(TotalLagrangian):
    """The solver: n particles in d dimensions, and k pairs of a particle and a neighbour, which may
    be an image beyond a periodic end or a wall."""

    name = "sph"
    version = "1.0"
    formal_order = 2
    capabilities = {
        "dimensions": [1, 2, 3],
        "laws": list(LAWS),
        "conditions": ["free", "fixed", "roller", "periodic"],
        "loads": ["gravity", "body_force"],
        "columns": ["stress", "deformation_gradient"],
        "manufactured": True,
        "initial_deformation": True,
    }

    def __init__(self, radius: float) -> None:
        self.spacings = radius

    def setup(self, problem: Problem) -> None:
        self.problem, self.d = problem, problem.dimension
        self.place, material = problem.reference_position, problem.materials[0]
        self.mass, self.volume = problem.mass, problem.mass / material["density"]
        self.u, self.v, self.a = problem.position - self.place, problem.velocity.copy(), None
        self.radius = self.spacings * self.volume.max() ** (1 / self.d)
        self.find_images()
        self.find_pairs()
        self.weigh_pairs()
        self.f = self.deformation_gradient()
        self.law = LAWS[material["law"]](material["parameters"])
        # Half of the limit of a lattice at rest, because compression stiffens it.
        wave_speed = np.sqrt((self.law.lam + 2 * self.law.mu) / material["density"])
        self.longest_step = 0.5 * self.volume.min() ** (1 / self.d) / wave_speed
        self.law.start(self.f, problem.stress)
        self.piola = self.law.piola(self.f)

    def find_images(self) -> None:
        """Finds the images: place and source of each, and the signs and the offset that make its
        displacement from that of the source."""
        self.image, self.source = self.place, np.arange(len(self.place))
        self.sign, self.offset = np.ones_like(self.place), np.zeros_like(self.place)
        for axis in range(self.d):
            faces = [face for face in self.problem.faces if face["axis"] == axis]
            copies = [(self.image, self.source, self.sign, self.offset)]
            for face, other in zip(faces, faces[::-1]):
                if face["condition"] == "free":
                    continue
                if face["condition"] == "fixed" and self.d > 1:
                    raise Cannot("a fixed face in more than one dimension")
                place, sign, offset = self.image.copy(), self.sign.copy(), self.offset.copy()
                if face["condition"] == "periodic":
                    length = face["at"] - other["at"]
                    period = np.copysign(self.problem.h * self.problem.cells[axis], length)
                    place[:, axis] += length
                    offset[:, axis] += period - length
                else:
                    place[:, axis] = 2 * face["at"] - place[:, axis]
                    sign[:, axis] *= -1
                    offset[:, axis] *= -1
                near = np.abs(place[:, axis] - face["at"]) < self.radius
                copies.append((place[near], self.source[near], sign[near], offset[near]))
            self.image, self.source, self.sign, self.offset = map(np.concatenate, zip(*copies))

    def find_pairs(self) -> None:
        """Finds the pairs that are less than the radius apart, by cells of that size."""
        low = self.image.min(axis=0) - 1.5 * self.radius
        cell = np.floor((self.image - low) / self.radius).astype(int)
        shape = tuple(cell.max(axis=0) + 2)
        number = np.ravel_multi_index(cell.T, shape)
        order = np.argsort(number, kind="stable")
        pairs = []
        for step in itertools.product((-1, 0, 1), repeat=self.d):
            other = np.ravel_multi_index((cell[:len(self.place)] + step).T, shape)
            begin, end = (np.searchsorted(number[order], other, side) for side in ("left", "right"))
            a = np.repeat(np.arange(len(self.place)), end - begin)
            start = np.repeat(np.cumsum(end - begin) - (end - begin), end - begin)
            b = order[begin[a] + np.arange(len(a)) - start]
            distance = np.linalg.norm(self.image[b] - self.place[a], axis=1)
            pairs.append(np.array([a, b])[:, (distance < self.radius) & (a != b)])
        self.first, self.second = np.hstack(pairs)

    def weigh_pairs(self) -> None:
        """Gradients of Wendland's kernel (1 - q)^4 (1 + 4 q), corrected."""
        apart = self.image[self.second] - self.place[self.first]
        q = np.linalg.norm(apart, axis=1) / self.radius
        slope = apart * (self.volume[self.source[self.second]] * (1 - q) ** 3)[:, None]
        inside = np.ones(len(self.place), bool)
        for face in self.problem.faces:
            if face["condition"] == "free":
                inside &= np.abs(self.place[:, face["axis"]] - face["at"]) > self.radius
        asymmetry = np.abs(self.sum(slope)) / self.sum(np.abs(slope)).max()
        if np.ptp(self.volume) > 1e-6 * self.volume.max() or (asymmetry[inside] > 1e-6).any():
            raise Cannot("particles that are not on a lattice, half a spacing from walls")
        moment = self.sum(apart[:, :, None] * slope[:, None, :])
        self.gradient = np.einsum("kij,kj->ki", np.linalg.inv(moment)[self.first], slope)

    def sum(self, terms: Array) -> Array:
        """Sums over the pairs of each particle."""
        return add(terms, self.first, len(self.place))

    def difference(self) -> Array:
        """Displacement of the second particle of each pair less that of the first."""
        second = self.sign * self.u[self.source] + self.offset
        return second[self.second] - self.u[self.first]

    def deformation_gradient(self) -> Array:
        terms = self.difference()[:, :, None] * self.gradient[:, None, :]
        return np.eye(self.d) + self.sum(terms)

    def acceleration(self, time: float) -> Array:
        self.f = self.deformation_gradient()
        self.piola = self.law.piola(self.f)
        work = self.volume[:, None, None] * self.piola
        pull = np.einsum("kij,kj->ki", work[self.first], self.gradient)
        force = self.sum(pull)
        force -= add(self.sign[self.second] * pull, self.source[self.second], len(self.place))
        return self.problem.body_force(time, self.place) + force / self.mass[:, None]

    def state(self) -> Message:
        j = np.linalg.det(self.f)
        stress = self.piola @ self.f.transpose(0, 2, 1) / j[:, None, None]
        return {"displacement": self.u, "velocity": self.v, "stress": stress,
                "deformation_gradient": self.f, "min_j": j.min()}


def add(terms: Array, index: Array, size: int) -> Array:
    """Sums of the terms of each index."""
    columns = terms.reshape(len(terms), -1).T
    sums = [np.bincount(index, column, size) for column in columns]
    return np.stack(sums, axis=1).reshape(size, *terms.shape[1:])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--radius", type=float, default=1.6, help="of the kernel, in spacings")
    serve(Sph(**vars(parser.parse_args())))
