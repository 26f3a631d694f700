"""The body of a problem for finite elements: a box of elements of size h.

The protocol provides the initial state at particles. It is interpolated to nodes by polynomials
of degree 5 along each axis of the lattice of particles, an error of order 6 in h.
"""

from __future__ import annotations

import argparse
import itertools

import numpy as np
from box import Array, Cannot, Message, Problem
from lagrangian import LAWS, TotalLagrangian
from mpm_verify import serve

DEGREE = 5  # of the interpolation of the initial state
TOLERANCE = 1e-6  # of places, in cells


class FiniteElements(TotalLagrangian):
    """Lumped masses and an explicit step; a subclass provides the library. With quadratic elements
    the step has order 4, and states are given at quadrature points."""

    formal_order: int
    elements: dict[tuple[int, int], object]  # of the library, by dimension and degree
    nodes: Array  # places of the nodes (n by dimension, m)
    gauss: Array  # places of the quadrature points (m by dimension, m)
    weight: Array  # volumes of the quadrature points

    def __init__(self, degree: int, points: str) -> None:
        self.degree, self.points = degree, points
        self.formal_order, self.time_order = degree + 1, 2 * degree
        # A law in rate form is integrated once a step, which the method of order 4 does not do.
        able = [law for law in LAWS if degree == 1 or law != "linear_elastic"]
        self.capabilities = {
            "dimensions": [d for d in (1, 2, 3) if (d, degree) in self.elements],
            "laws": able,
            "conditions": ["free", "fixed", "roller", "periodic"],
            "loads": ["gravity", "body_force"], "manufactured": True, "initial_deformation": True}

    def make_mesh(self, axes: list[Array]) -> None:
        """Makes elements between these coordinates; sets `nodes`, `gauss` and `weight`."""
        raise NotImplementedError

    def make_law(self, material: Message, stress: Array) -> None:
        """Makes the law at the quadrature points, which start with the displacements `u` and the
        Cauchy stress `stress`."""
        raise NotImplementedError

    def at_gauss(self, field: Array) -> Array:
        """A nodal field at the quadrature points."""
        raise NotImplementedError

    def load(self, force: Array) -> Array:
        """Nodal forces of a force per volume at the quadrature points."""
        raise NotImplementedError

    def internal_force(self) -> Array:
        """Nodal forces of the stress at the displacements `u`."""
        raise NotImplementedError

    def setup(self, problem: Problem) -> Message:
        self.problem = problem
        low, high = box(problem)
        counts = np.maximum(np.rint((high - low) / problem.h).astype(int), 1)
        self.make_mesh([np.linspace(*ends, n + 1) for *ends, n in zip(low, high, counts)])
        lattice = Lattice(problem.reference_position, problem.h)
        self.u = lattice.interpolate(problem.position - problem.reference_position, self.nodes)
        self.v = lattice.interpolate(problem.velocity, self.nodes)
        flat = problem.stress.reshape(len(problem.stress), -1)
        self.make_law(problem.materials[0], lattice.interpolate(flat, self.gauss).reshape(
            -1, *problem.stress.shape[1:]))
        self.hold(low, high)
        volume = self.load(np.ones_like(self.gauss))
        self.density = problem.materials[0]["density"]
        self.mass = self.density * self.join(volume)
        # Nodes that periodic axes identify have one velocity.
        self.v = self.join(self.density * volume * self.v) / self.mass
        self.external, self.a = None, None
        self.v *= self.free
        if self.points == "quadrature":
            return {"reference_position": self.gauss, "weight": self.weight}
        return {"reference_position": self.nodes, "weight": volume[:, 0]}

    def hold(self, low: Array, high: Array) -> None:
        """Finds the constrained nodes, and the nodes that periodic axes identify."""
        step = TOLERANCE * self.problem.h
        self.free = np.ones_like(self.nodes)
        place = np.rint((self.nodes - low) / step).astype(int)
        for face in self.problem.faces:
            condition, axis = face["condition"], face["axis"]
            on = np.abs(self.nodes[:, axis] - face["at"]) < 0.1 * self.problem.h
            if condition == "fixed":
                self.free[on] = 0
            elif condition == "roller":
                self.free[on, axis] = 0
            elif condition == "periodic":
                place[:, axis] %= np.rint((high - low)[axis] / step).astype(int)
        _, self.one = np.unique(place, axis=0, return_inverse=True)

    def join(self, field: Array) -> Array:
        """Sums over nodes that periodic axes identify, at each of them."""
        sums = [np.bincount(self.one, values)[self.one] for values in field.T]
        return np.stack(sums, axis=1)

    def acceleration(self, time: float) -> Array:
        if self.external is None or self.problem.message["body_force"] == "asked":
            force = self.problem.body_force(time, self.gauss)
            self.external = self.load(self.density * force)
        return self.free * self.join(self.external - self.internal_force()) / self.mass

    def state(self) -> Message:
        show = self.at_gauss if self.points == "quadrature" else np.asarray
        return {"displacement": show(self.u), "velocity": show(self.v)}


def box(problem: Problem) -> tuple[Array, Array]:
    """The corners of the body."""
    low, high = np.full((2, problem.dimension), np.nan)
    for face in problem.faces:
        (high if face["high"] else low)[face["axis"]] = face["at"]
    volume = problem.mass.sum() / problem.materials[0]["density"]
    if not abs(np.prod(high - low) - volume) < 1e-6 * volume:
        raise Cannot("a body that is no box")
    return low, high


class Lattice:
    """Values at particles that are the points of a lattice."""

    def __init__(self, places: Array, h: float) -> None:
        number = np.rint(places / (TOLERANCE * h)).astype(int)
        self.axes, self.index = [], []
        for along, x in zip(number.T, places.T):
            _, first, index = np.unique(along, return_index=True, return_inverse=True)
            self.axes.append(x[first])
            self.index.append(index)
        self.shape = [len(axis) for axis in self.axes]
        at = np.ravel_multi_index(self.index, self.shape)
        if len(np.unique(at)) != np.prod(self.shape) or len(at) != np.prod(self.shape):
            raise Cannot("particles that are not on a lattice")
        self.order = np.argsort(at)

    def interpolate(self, values: Array, places: Array) -> Array:
        """Values at particles (n by k) at other places."""
        along = [lagrange(axis, x) for axis, x in zip(self.axes, places.T)]
        result = np.zeros((len(places), values.shape[1]))
        for choice in itertools.product(*(range(len(weights)) for _, weights in along)):
            at = [first + k for (first, _), k in zip(along, choice)]
            weight = np.prod([weights[k] for (_, weights), k in zip(along, choice)], axis=0)
            rows = self.order[np.ravel_multi_index(at, self.shape)]
            result += weight[:, None] * values[rows]
        return result


def lagrange(axis: Array, x: Array) -> tuple[Array, Array]:
    """Number of the first of the points of `axis` around `x`, and the weight of each."""
    count = min(DEGREE + 1, len(axis))
    first = np.clip(np.searchsorted(axis, x) - count // 2, 0, len(axis) - count)
    points = axis[first + np.arange(count)[:, None]]
    weights = np.ones_like(points)
    for k, m in itertools.permutations(range(count), 2):
        weights[k] *= (x - points[m]) / (points[k] - points[m])
    return first, weights


def main(solver: type[FiniteElements]) -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--degree", type=int, choices=[1, 2], default=1, help="of the elements")
    parser.add_argument("--points", choices=["nodes", "quadrature"], help="points of the states; "
                        "by default nodes with degree 1, quadrature points with degree 2")
    options = parser.parse_args()
    points = options.points or {1: "nodes", 2: "quadrature"}[options.degree]
    serve(solver(options.degree, points))
