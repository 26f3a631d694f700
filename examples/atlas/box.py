"""Maps the grid of a problem into the unit cube, in which many codes compute.

For a code with a fixed box and walls around it, the grid gets extra cells on all sides, so that the
body does not reach a wall. Lengths and times are scaled to the units of the code.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "solvers"))

from mpm_verify import Array, Cannot, Message, Problem  # noqa: E402

# Precisions, by their names in the protocol.
PRECISION = {"f32": "single", "f64": "double"}


class Box:
    """Units of a code: lengths of n h, with `pad` cells around the longest side of the grid, times
    of `second` s, and a density of one."""

    def __init__(self, problem: Problem, pad: int, second: float = 1.0) -> None:
        self.problem, self.second = problem, second
        self.n = max(problem.cells) + 2 * pad
        self.metre = 1 / (self.n * problem.h)
        self.origin = problem.origin - pad * problem.h
        self.dx = 1 / self.n
        self.x = (problem.position - self.origin) * self.metre
        self.v = problem.velocity * self.metre * second
        self.volume = uniform("volumes", problem.volume) * self.metre**problem.dimension
        self.density = uniform("densities", problem.mass / problem.volume)
        parameters = common_material(problem)["parameters"]
        self.poisson = parameters["poisson"]
        self.young = parameters["young"] / self.density * (self.metre * second) ** 2
        self.mu = self.young / (2 * (1 + self.poisson))
        self.lam = 2 * self.mu * self.poisson / (1 - 2 * self.poisson)

    def motion(self, x: Array, v: Array) -> Message:
        """The state of particles at x with v, in m and s."""
        x, v = np.asarray(x, float), np.asarray(v, float)
        return {"displacement": self.origin + x / self.metre - self.problem.reference_position,
                "velocity": v / (self.metre * self.second)}

    def gravity(self) -> Array:
        """The uniform acceleration."""
        return gravity(self.problem) * self.metre * self.second**2


@contextmanager
def aside() -> Iterator[None]:
    """Redirects the output of a package during its import to standard error."""
    sys.stdout.flush()
    out = os.dup(1)
    os.dup2(2, 1)
    yield
    sys.stdout.flush()
    os.dup2(out, 1)
    os.close(out)


def gravity(problem: Problem) -> Array:
    """The uniform acceleration of a problem (m/s2)."""
    has_none = problem.message["body_force"] == "none"
    return np.zeros(problem.dimension) if has_none else problem.constant_force


def uniform(what: str, values: Array) -> float:
    """The common value of all entries."""
    if np.ptp(values) > 1e-9 * abs(values[0]):
        raise Cannot(f"particles of several {what}")
    return float(values[0])


def common_material(problem: Problem) -> Message:
    """The material of all bodies."""
    first, *others = problem.materials
    if any(material != first for material in others):
        raise Cannot("bodies of several materials")
    return first


def laws(able: list[str], any_law: bool) -> list[str]:
    """Declared laws of a code: all laws if nothing deforms and the caller requests it."""
    rest = ["linear_elastic", "neo_hookean", "hencky", "corotated"]
    return able + [law for law in rest if any_law and law not in able]
