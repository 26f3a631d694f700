"""The crate phyz-particle: FLIP blended with PIC and an affine field, cubic B-splines, three dimensions.

It has a constant acceleration of 9.81 along its second axis. The time unit is chosen so that this is
the gravity of the problem, or negligible.
"""

from __future__ import annotations

import argparse
import subprocess

import numpy as np
from box import Array, Box, Cannot, Message, Problem, gravity, laws
from mpm_verify import serve

GRAVITY, PAD = 9.81, 4
AXES = [0, 2, 1]  # upward is the second
DENSITY = 1e9  # masses of nodes below 1e-12 are left out


class Phyz:
    name = "phyz-particle"
    version = "0.1.0"

    def __init__(self, program: str, flip: float, stiffness: float, any_law: bool, gravity: str) -> None:
        self.program, self.flip, self.stiffness = program, flip, stiffness
        self.capabilities = {"dimensions": [3], "laws": laws(["neo_hookean"], any_law),
                             "conditions": ["free"], "several_bodies": True,
                             "loads": ["gravity"] if gravity == "on" else []}

    def setup(self, problem: Problem) -> None:
        self.box = box = Box(problem, PAD, self.second(problem))
        self.process = subprocess.Popen(
            [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.write([len(box.x), box.dx, problem.dt / box.second, 1,
                    self.stiffness * DENSITY * box.young, box.poisson,
                    DENSITY * box.volume, box.volume, self.flip])
        self.write(np.hstack([box.x[:, AXES], box.v[:, AXES]]))

    def second(self, problem: Problem) -> float:
        """The unit of time (s)."""
        *across, down = gravity(problem)
        unit = Box(problem, PAD)
        if any(across) or down > 0:
            raise Cannot("gravity that does not act downwards")
        if down:
            return float(np.sqrt(GRAVITY / (-down * unit.metre)))
        return float(1e8 / np.sqrt(unit.young))  # a wave crosses the box in 1e-8

    def write(self, numbers: Array | list[float]) -> None:
        self.process.stdin.write(np.asarray(numbers, "<f8").tobytes())
        self.process.stdin.flush()

    def advance(self, steps: int, dt: float, time: float) -> None:
        self.write([steps])
        size = 8 * 6 * len(self.box.x)
        self.now = np.frombuffer(self.process.stdout.read(size), "<f8").reshape(-1, 6)

    def state(self) -> Message:
        return self.box.motion(self.now[:, AXES], self.now[:, 3:][:, AXES])


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True, help="that of phyz/, built")
    parser.add_argument("--flip", type=float, default=0.95, help="share of FLIP, 0.95 unless said")
    parser.add_argument("--stiffness", type=float, default=1, help="share of that of the problem")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    parser.add_argument("--gravity", choices=["on", "off"], default="on", help="off: problems without gravity "
                        "only, for `doctor`, whose gravity does not act downwards")
    serve(Phyz(**vars(parser.parse_args())))
