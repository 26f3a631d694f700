"""Independent implementation of the solver in crates/solvers/src/mpm, written from the equations of the method.

    python3 tests/second_opinion/mpm.py [PROBLEM ...]

runs the problems of problems.py and writes a file of numbers for each into this folder.
crates/solvers/tests/solver/mpm/second_opinion.rs compares the solver with these files. Basis functions are matrices of all
particles by all nodes, so that a step is a few products: slow, and short enough for comparison with the papers.

FLIP with a lumped mass matrix: Sulsky, Chen & Schreyer (1994); Wobbes & Tielen (2015). GIMP:
Bardenhagen & Kober (2004), with the domains of Wallstedt & Guilkey (2008). B-splines: Steffen,
Kirby & Berzins (2008).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Iterator

import numpy as np

from problems import PROBLEMS, Array, Problem

BASES, SCHEMES = ("linear", "cpgimp", "cubic_bspline"), ("usl", "musl")
SHOWN = 24  # particles, at most


class Inverted(ArithmeticError):
    """A particle was turned inside out."""


def hat(s: Array) -> Array:
    """The hat of a node at distance s (cells)."""
    return np.maximum(0, 1 - abs(s))


def hat_slope(s: Array) -> Array:
    """Its slope; at a node, that of the cell on the right."""
    return np.where((s >= 0) & (s < 1), -1.0, np.where((s >= -1) & (s < 0), 1.0, 0.0))


def hat_integral(s: Array) -> Array:
    """Its integral from minus infinity to s."""
    left, right = np.clip(s, -1, 0), np.clip(s, 0, 1)
    return 0.5 * (1 + left) ** 2 + right - 0.5 * right**2


def fold(columns: Array, first: int, cells: int) -> Array:
    """Functions with the numbers from `first` on, those a period apart taken for one."""
    folded = np.zeros((len(columns), cells))
    for k, column in enumerate(columns.T):
        folded[:, (first + k) % cells] += column
    return folded


def along_axis(
    basis: str, s: Array, half: Array, cells: int, periodic: bool
) -> tuple[Array, Array]:
    """Functions and slopes (per cell), particles by nodes, along an axis of so many cells.

    s: positions (cells); half: half-lengths of domains (cells).
    """
    if periodic:
        s = s % cells
    if basis == "cubic_bspline":
        knots = np.arange(-3.0, cells + 4.0)
        value, slope = bsplines(3, knots if periodic else np.clip(knots, 0, cells), s, cells)
        return (fold(value, 0, cells), fold(slope, 0, cells)) if periodic else (value, slope)
    nodes = np.arange(-2.0, cells + 3.0) if periodic else np.arange(cells + 1.0)
    if basis == "linear":
        value, slope = hat(s[:, None] - nodes), hat_slope(s[:, None] - nodes)
    else:
        low, high = s - half, s + half
        if not periodic:  # at walls the domain is cut off
            low, high = np.maximum(low, 0), np.minimum(high, cells)
        low, high = low[:, None] - nodes, high[:, None] - nodes
        value = (hat_integral(high) - hat_integral(low)) / (high - low)
        slope = (hat(high) - hat(low)) / (high - low)
    return (fold(value, -2, cells), fold(slope, -2, cells)) if periodic else (value, slope)


def bsplines(degree: int, knots: Array, s: Array, cells: int) -> tuple[Array, Array]:
    """All B-splines over these knots and their slopes: de Boor (1978), where 0/0 is 0."""
    def over(numerator: Array, span: Array) -> Array:
        return np.divide(numerator, span, out=np.zeros_like(numerator), where=span > 0)

    cell = np.minimum(np.floor(s), cells - 1)[:, None]
    value = ((knots[:-1] <= cell) & (cell < knots[1:])).astype(float)
    slope = np.zeros_like(value)
    for p in range(1, degree + 1):
        span = np.broadcast_to(knots[p:] - knots[:-p], value.shape)
        share = over(value, span)
        slope = p * (share[:, :-1] - share[:, 1:])
        left, right = s[:, None] - knots[:-p - 1], knots[p + 1:] - s[:, None]
        value = left * share[:, :-1] + right * share[:, 1:]
    return value, slope


class Mpm:
    """n particles in d dimensions."""

    def __init__(self, problem: Problem, basis: str, scheme: str, cells: int) -> None:
        self.problem, self.basis, self.scheme = problem, basis, scheme
        self.h = problem.grid / cells
        self.cells = [cells + problem.room] * problem.d
        per_axis = round(problem.body / (self.h / problem.ppc))
        spacing = problem.body / per_axis
        lattice = (np.arange(per_axis) + 0.5) * spacing
        self.X = np.stack([x.ravel() for x in np.meshgrid(*[lattice] * problem.d)], axis=-1)
        self.half = 0.5 * spacing
        self.volume0 = spacing**problem.d
        self.m = problem.rho * self.volume0
        u, self.F, self.v = problem.start(self.X)
        self.x, self.sigma = self.X + u, np.zeros_like(self.F)
        self.J = np.linalg.det(self.F)
        if problem.law == "neo_hookean":
            self.sigma = self.neo_hookean()
        nodes = [self.functions(a)[0].shape[1] for a in range(problem.d)]
        self.free = np.ones((*nodes, problem.d))
        for a in range(problem.d):
            at = np.moveaxis(self.free[..., a], a, 0)
            for end in problem.held:
                at[end] = 0
        self.free = self.free.reshape(-1, problem.d)

    def functions(self, axis: int) -> tuple[Array, Array]:
        s, half = self.x[:, axis] / self.h, self.half * self.F[:, axis, axis] / self.h
        return along_axis(self.basis, s, half, self.cells[axis], self.problem.periodic)

    def weigh(self) -> tuple[Array, Array]:
        """Functions S (n, nodes) and gradients G (d, n, nodes), products of those along axes."""
        axes = [self.functions(a) for a in range(self.problem.d)]

        def product(slope_of: int | None) -> Array:
            result = np.ones((len(self.x), 1))
            for a, (value, slope) in enumerate(axes):
                along = slope / self.h if a == slope_of else value
                result = (result[:, :, None] * along[:, None, :]).reshape(len(self.x), -1)
            return result

        return product(None), np.stack([product(a) for a in range(self.problem.d)])

    def step(self, number: int, dt: float) -> None:
        """v_p += dt a; then v_i + dt a_i (USL), or v_p mapped again (MUSL), strains and moves."""
        S, G = self.weigh()
        mass = self.m * S.sum(axis=0)
        per_mass = self.free * np.divide(1, mass, out=np.zeros_like(mass), where=mass > 0)[:, None]

        def velocity() -> Array:
            return per_mass * (S.T @ (self.m * self.v))

        stress = np.einsum("bpi,pab->ia", G, (self.volume0 * self.J)[:, None, None] * self.sigma)
        outer = self.m * self.problem.body_force(self.X, number * dt)
        outer[np.argmax(self.X.sum(axis=1))] += self.problem.pull
        a = per_mass * (S.T @ outer - stress)
        if number == 0 and self.problem.half_step_back:
            self.v = self.v - 0.5 * dt * S @ a
        v = velocity() + dt * a
        self.v = self.v + dt * S @ a
        if self.scheme == "musl":
            v = velocity()
        increment = dt * np.einsum("bpi,ia->pab", G, v)
        self.x = self.x + dt * S @ v
        self.F = self.F + increment @ self.F
        self.J = np.linalg.det(self.F)
        if not (self.J > 0).all():
            raise Inverted
        if self.problem.law == "neo_hookean":
            self.sigma = self.neo_hookean()
        else:  # E per strain, without Poisson's ratio
            self.sigma = self.sigma + self.problem.young * increment

    def neo_hookean(self) -> Array:
        """(lambda ln J I + mu (F F^T - I))/J."""
        one, J = np.eye(self.problem.d), self.J[:, None, None]
        b = self.F @ self.F.transpose(0, 2, 1)
        return (self.problem.lam * np.log(J) * one + self.problem.mu * (b - one)) / J


def written(*numbers: float) -> str:
    return " ".join(f"{number:.12e}" for number in numbers)


def rms(vectors: Array) -> float:
    """Root of the mean square of their lengths."""
    return float(np.sqrt(np.sum(vectors**2) / len(vectors)))


def run(problem: Problem, basis: str, scheme: str, cells: int) -> Iterator[str]:
    """The lines of a level, and of some particles on the coarsest one."""
    steps = problem.steps(cells)
    mpm, dt, found = Mpm(problem, basis, scheme, cells), problem.until / steps, []
    instants = min(problem.instants, steps)
    for step in range(steps):
        try:
            mpm.step(step, dt)
        except Inverted:
            yield f"level {cells} {steps} inverted {step + 1}"
            return
        if (step + 1) * instants // steps > step * instants // steps:
            fields = (mpm.x - mpm.X, mpm.v, mpm.sigma, mpm.F - np.eye(problem.d))
            error = fields[0] - problem.exact(mpm.X, (step + 1) * dt)
            found.append([rms(field) for field in (error, *fields)])
    yield f"level {cells} {steps} {written(found[-1][0], *np.max(found, axis=0))}"
    if cells == problem.levels[0]:
        for p in range(0, len(mpm.x), len(mpm.x) // SHOWN + 1):
            yield f"{p} {written(*(number for part in fields for number in part[p].flat))}"


def main() -> None:
    for problem in PROBLEMS:
        if sys.argv[1:] and problem.name not in sys.argv[1:]:
            continue
        lines = [f"# Written by: python3 tests/second_opinion/mpm.py {problem.name}",
                 "# case: basis, scheme, start",
                 "# level: cells, steps; rms error of the displacement at the end, the largest of",
                 "#   all instants, and the largest rms of displacement, velocity, stress and F - I",
                 "# number of a particle on the coarsest level: the four fields at the end"]
        start = "half_step_back" if problem.half_step_back else "at_zero"
        for basis in BASES:
            for scheme in SCHEMES:
                lines.append(f"case {basis} {scheme} {start}")
                for cells in problem.levels:
                    lines += run(problem, basis, scheme, cells)
        Path(__file__).with_name(f"{problem.name}.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
