"""Explicit MPM for several bodies with contact, and for walls with friction, in NumPy, as a solver under test.

    mpm-verify doctor --solver 'python3 tests/clients/several_bodies.py --basis linear'

Each body has its own grid fields, as in Bardenhagen, Brackbill & Sulsky (2000), CMAME 187. Bodies are those of
examples/solvers/numpy_mpm.py, with USL and FLIP.
"""

from __future__ import annotations

import argparse
import copy
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples/solvers"))
from mpm_verify import Array, Cannot, Message, Problem, serve
from numpy_mpm import Mpm

COLUMNS = ["reference_position", "position", "velocity", "mass", "reference_volume", "volume",
           "deformation_gradient", "stress", "reference_stress"]


class Part(Mpm):
    """One body, with local damping."""

    contact: Array | float = 0.0  # accelerations of nodes by contact (m/s2)

    def acceleration(self, time: float, dt: float) -> Array:
        field = super().acceleration(time, dt)
        for index, load in enumerate(self.problem.loads):
            if load["load"] == "local_damping":
                field = field - load["values"]["share"] * np.abs(field) * np.sign(self.velocity())
        return field + self.contact


class Bodies:
    """All bodies, each with its own law and density."""

    name, version, formal_order = "several-bodies", "1.0", 2

    def __init__(self, basis: str, start: str) -> None:
        self.options = {"basis": basis, "scheme": "usl", "flip": 1.0, "start": start}
        own = Mpm.capabilities
        self.capabilities = {**own, "conditions": [*own["conditions"], "friction"],
                             "loads": [*own["loads"], "local_damping"], "several_bodies": True, "contact": True}

    def setup(self, problem: Problem) -> None:
        count = len(problem.materials)
        if count > 1 and problem.message["body_force"] == "asked":
            raise Cannot("several bodies with a body force that varies")
        self.problem, self.parts = problem, []
        for number, material in enumerate(problem.materials):
            part = copy.copy(problem)
            part.materials = [material]
            for column in COLUMNS if count > 1 else []:
                setattr(part, column, getattr(problem, column)[problem.body == number])
            solver = Part(**self.options)
            solver.setup(part)
            self.parts.append(solver)

    def advance(self, steps: int, dt: float, time: float) -> None:
        for step in range(steps):
            if len(self.parts) == 2:
                self.touch(time + step * dt, dt)
            for part in self.parts:
                part.step(dt, time + step * dt)

    def touch(self, time: float, dt: float) -> None:
        """Contact of two bodies, or their common velocity without contact, from trial velocities."""
        trials = []
        for part in self.parts:
            part.weigh()
            part.contact = 0.0
            trials.append(part.velocity() + dt * part.acceleration(time, dt))
        masses = [part.mass[:, None] for part in self.parts]
        common = np.divide(sum(m * v for m, v in zip(masses, trials)), sum(masses), out=np.zeros_like(trials[0]),
                           where=sum(masses) > 0)
        both = np.minimum(*masses) > 0
        # The common face is normal to the axis along which the bodies are farthest apart.
        apart = self.parts[1].x.mean(axis=0) - self.parts[0].x.mean(axis=0)
        axis = np.argmax(np.abs(apart))
        outwards = np.sign(apart[axis]) * np.eye(len(apart))[axis]
        for part, trial, normal in zip(self.parts, trials, (outwards, -outwards)):
            change = common - trial
            if self.problem.contact is not None:
                change = self.limited(change, normal, self.problem.contact["coefficient"])
            part.contact = np.where(both, change, 0.0) / dt

    def limited(self, change: Array, normal: Array, coefficient: float) -> Array:
        """The change of velocity without its tension, with limited friction."""
        across = (change * normal).sum(axis=1, keepdims=True)
        pressed, along = np.maximum(-across, 0.0), change - across * normal
        speed = np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
        return -pressed * normal + np.minimum(coefficient * pressed / speed, 1.0) * along

    def state(self) -> Message:
        state = self.parts[0].state()
        for column in ("displacement", "velocity", "stress", "deformation_gradient"):
            values = np.zeros((len(self.problem.mass), *state[column].shape[1:]))
            for number, part in enumerate(self.parts):
                values[self.problem.body == number] = part.state()[column]
            state[column] = values
        return state


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--basis", choices=["linear", "quadratic_bspline", "cubic_bspline"], default="linear")
    parser.add_argument("--start", choices=["at_zero", "half_step_back"], default="at_zero")
    serve(Bodies(**vars(parser.parse_args())))
