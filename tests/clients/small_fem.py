"""Explicit finite elements with linear kinematics, in NumPy, as a solver under test.

    mpm-verify run SUITE --solver 'python3 tests/clients/small_fem.py'

The stress is C : sym(grad u) in the reference configuration (`small_strain`). Elements are linear in one dimension,
bilinear in two and trilinear in three, with two Gauss points along each axis, a lumped mass and velocity Verlet steps.
With `--at nodes`, states are those of the nodes, without stresses; otherwise those of the Gauss points. With
`--plates`, two-dimensional bodies may be in plane stress.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples/solvers"))
from lagrangian import TotalLagrangian
from mpm_verify import Array, Cannot, Message, Problem, serve


class SmallFem(TotalLagrangian):
    """Finite elements with c corners on a box, in d dimensions, with q Gauss points in each of m elements."""

    name = "small-fem"
    version = "1.0"
    capabilities = {
        "dimensions": [1, 2, 3],
        "laws": ["small_strain"],
        "conditions": ["free", "fixed", "roller", "periodic"],
        "loads": ["gravity", "body_force"],
        "columns": ["stress", "deformation_gradient"],
        "manufactured": True,
        "initial_deformation": True,
    }

    def __init__(self, at: str, plates: bool) -> None:
        self.at_nodes = at == "nodes"
        self.capabilities = {**self.capabilities, "plane_stress": plates}
        if self.at_nodes:
            self.capabilities = {**self.capabilities, "columns": []}

    def setup(self, problem: Problem) -> Message:
        self.problem, self.a, d, box = problem, None, problem.dimension, problem.bodies[0]
        if box["shape"] != "box":
            raise Cannot("a body that is not a box")
        low, high = np.array(box["from"]), np.array(box["to"])
        count = np.maximum(np.rint((high - low) / problem.h).astype(int), 1)
        size = (high - low) / count
        shape = count + 1 - np.array(problem.periodic)  # nodes along each axis
        grid = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, d)
        self.place = low + grid * size
        corners = np.array(list(itertools.product((0, 1), repeat=d)))
        lowest = np.stack(np.meshgrid(*map(np.arange, count), indexing="ij"), axis=-1).reshape(-1, 1, d)
        self.nodes = np.ravel_multi_index(np.moveaxis((lowest + corners) % shape, -1, 0), shape)  # (m, c)
        gauss = 0.5 + (corners - 0.5) / np.sqrt(3)
        factor = np.where(corners == 1, gauss[:, None], 1 - gauss[:, None])  # (q, c, d)
        self.shape = factor.prod(axis=-1)
        slope = np.where(corners == 1, 1.0, -1.0) / size
        self.slope = np.stack([slope[:, i] * np.delete(factor, i, axis=-1).prod(axis=-1) for i in range(d)], axis=-1)
        self.weight = size.prod() / len(corners)
        material = problem.materials[0]
        young, poisson = material["parameters"]["young"], material["parameters"]["poisson"]
        self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        self.mu = young / (2 * (1 + poisson))
        if problem.plane == "stress":
            self.lam = young * poisson / (1 - poisson**2)
        self.volume = self.weight * np.bincount(self.nodes.ravel(), minlength=len(self.place))
        self.mass = material["density"] * self.volume
        self.held = np.zeros(self.place.shape, bool)
        for face in problem.faces:
            end = 0 if not face["high"] else shape[face["axis"]] - 1
            axes = {"fixed": slice(None), "roller": face["axis"]}.get(face["condition"])
            if axes is not None:
                self.held[grid[:, face["axis"]] == end, axes] = True
        self.u = problem.initial_displacement(self.place)
        self.v = np.where(self.held, 0.0, problem.initial_velocity(self.place))
        if self.at_nodes:
            return {"reference_position": self.place, "weight": self.volume}
        points = (low + (lowest + gauss) * size).reshape(-1, d)
        return {"reference_position": points, "weight": np.full(len(points), self.weight)}

    def gradient(self) -> Array:
        """Displacement gradients at the Gauss points (m, q, d, d)."""
        return np.einsum("mci,qcj->mqij", self.u[self.nodes], self.slope)

    def stress(self) -> Array:
        gradient = self.gradient()
        trace = np.trace(gradient, axis1=2, axis2=3)[..., None, None]
        return self.lam * trace * np.eye(gradient.shape[-1]) + self.mu * (gradient + gradient.swapaxes(2, 3))

    def acceleration(self, time: float) -> Array:
        pull = -self.weight * np.einsum("mqij,qcj->mci", self.stress(), self.slope).reshape(-1, self.u.shape[1])
        force = np.stack([np.bincount(self.nodes.ravel(), column, len(self.place)) for column in pull.T], axis=1)
        a = force / self.mass[:, None] + self.problem.body_force(time, self.place)
        return np.where(self.held, 0.0, a)

    def state(self) -> Message:
        if self.at_nodes:
            return {"displacement": self.u, "velocity": self.v}
        d = self.u.shape[1]
        inside = {key: np.einsum("mci,qc->mqi", field[self.nodes], self.shape).reshape(-1, d)
                  for key, field in (("displacement", self.u), ("velocity", self.v))}
        return {**inside, "stress": self.stress().reshape(-1, d, d),
                "deformation_gradient": (np.eye(d) + self.gradient()).reshape(-1, d, d)}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--at", choices=["points", "nodes"], default="points")
    parser.add_argument("--plates", action="store_true")
    serve(SmallFem(**vars(parser.parse_args())))
