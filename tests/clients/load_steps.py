"""Quasi-static load steps of a column: finite elements along its axis, as a solver under test.

    mpm-verify doctor --solver 'python3 tests/clients/load_steps.py'

Linear elements in the reference configuration, one Gauss point each, with Newton's method. With `--dimension 2`, rollers
hold the sides of the column; with `--at points`, states are those of the middles of the elements.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples/solvers"))
from mpm_verify import Cannot, Message, Problem, serve


class LoadSteps:
    """The nodes of a column that is held at one or both ends, under gravity."""

    name = "load-steps"
    version = "1.0"
    formal_order = 2
    capabilities = {"dimensions": [1], "laws": ["neo_hookean", "hencky"], "conditions": ["free", "fixed", "roller"],
                    "loads": ["gravity"], "load_steps": True}

    def __init__(self, dimension: int, at: str) -> None:
        self.d, self.at = dimension, at
        self.capabilities = {**self.capabilities, "dimensions": [dimension]}

    def setup(self, problem: Problem) -> Message:
        if "load_steps" not in problem.message:
            raise Cannot("load steps only")
        sides = [face["condition"] for face in problem.faces if face["axis"] > 0]
        if any(condition != "roller" for condition in sides) or problem.message["body_force"] == "asked":
            raise Cannot("a column between rollers, with constant gravity, only")
        low, high = (problem.message["bodies"][0][key][0] for key in ("from", "to"))
        count = round((high - low) / problem.h)
        self.x = np.linspace(low, high, count + 1)
        self.law, parameters = problem.materials[0]["law"], problem.materials[0]["parameters"]
        young, poisson = parameters["young"], parameters["poisson"]
        self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        self.mu = young / (2 * (1 + poisson))
        self.free = np.ones(count + 1, bool)
        for face in problem.faces:
            if face["axis"] == 0 and face["condition"] != "free":
                self.free[-1 if face["high"] else 0] = False
        share = np.full(count + 1, problem.h)
        share[[0, -1]] *= 0.5
        self.weight = problem.materials[0]["density"] * share * problem.message["body_force_value"][0]
        self.u, self.done, self.count = np.zeros(count + 1), 0, problem.message["load_steps"]
        place, weight = self.mean(self.x)[:, None], share if self.at == "nodes" else np.full(count, problem.h)
        if self.d == 2:
            side = np.array([problem.message["bodies"][0][key][1] for key in ("from", "to")])
            place = np.stack([np.repeat(place, 2), np.tile(side, len(place))], axis=1)
            weight = np.repeat(weight, 2) * 0.5 * (side[1] - side[0])
        return {"reference_position": place, "weight": weight}

    def mean(self, values):
        """Values at the nodes or, with `--at points`, in the elements."""
        return values if self.at == "nodes" else 0.5 * (values[1:] + values[:-1])

    def piola(self, f):
        """First Piola-Kirchhoff stress and its derivative."""
        m = self.lam + 2 * self.mu
        if self.law == "hencky":
            return m * np.log(f) / f, m * (1 - np.log(f)) / f**2
        return (self.lam * np.log(f) - self.mu) / f + self.mu * f, (self.lam * (1 - np.log(f)) + self.mu) / f**2 + self.mu

    def fraction(self):
        return self.done / self.count

    def advance(self, steps: int, dt: float, time: float) -> None:
        for _ in range(steps):
            self.done += 1
            self.solve(self.fraction() * self.weight)

    def solve(self, load) -> None:
        for _ in range(30):
            h = np.diff(self.x)
            stress, slope = self.piola(1 + np.diff(self.u) / h)
            residual = load - (np.append(-stress, 0) + np.append(0, stress))
            if np.abs(residual[self.free]).max() <= 1e-12 * np.abs(self.weight).sum():
                return
            k = np.zeros((len(self.x), len(self.x)))
            for e, stiffness in enumerate(slope / h):
                k[e:e + 2, e:e + 2] += stiffness * np.array([[1, -1], [-1, 1]])
            free = np.ix_(self.free, self.free)
            self.u[self.free] += np.linalg.solve(k[free], residual[self.free])

    def state(self) -> Message:
        u = self.mean(self.u)[:, None]
        if self.d == 2:
            u = np.repeat(u, 2, axis=0) * [1, 0]
        return {"displacement": u, "velocity": 0 * u}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--dimension", type=int, choices=[1, 2], default=1)
    parser.add_argument("--at", choices=["nodes", "points"], default="nodes")
    serve(LoadSteps(**vars(parser.parse_args())))
