"""The problems of the second opinion: what the suites of the same names in verification/ state."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass
class Problem:
    """A body [0, body]^d (m) on a grid [0, grid]^d (m), with `room` more cells at its end."""

    name: str
    levels: list[int]
    ppc: int  # along each axis
    until: float  # s
    steps: Callable[[int], int]  # of the number of cells
    instants: int
    young: float  # Pa
    rho: float  # kg/m^d
    law: str
    exact: Callable[[Array, float], Array]  # displacement (m) at X (n, d)
    start: Callable[[Array], tuple[Array, Array, Array]]  # displacement, F, velocity at X
    body_force: Callable[[Array, float], Array]  # m/s2, at X and a time
    poisson: float = 0.0
    d: int = 1
    body: float = 1.0
    grid: float = 1.0
    room: int = 0
    pull: float = 0.0  # N, on the last particle
    held: tuple[int, ...] = ()  # ends of all axes whose normal velocity is zero
    periodic: bool = False
    half_step_back: bool = False

    @property
    def mu(self) -> float:
        return self.young / (2 * (1 + self.poisson))

    @property
    def lam(self) -> float:
        return self.young * self.poisson / ((1 + self.poisson) * (1 - 2 * self.poisson))


def nothing(X: Array, t: float = 0.0) -> Array:
    return np.zeros_like(X)


def undeformed(velocity: Callable[[Array], Array]) -> Callable[[Array], tuple[Array, Array, Array]]:
    return lambda X: (nothing(X), np.tile(np.eye(X.shape[1]), (len(X), 1, 1)), velocity(X))


def vibrating_bar(name: str, levels: list[int], v0: float) -> Problem:
    L, young, rho = 25.0, 100.0, 1.0
    k = pi / (2 * L)
    omega = k * sqrt(young / rho)
    return Problem(
        name, levels, ppc=4, until=0.5, steps=lambda cells: 500, instants=50, young=young, rho=rho,
        law="linear_elastic", body=L, grid=L, room=3, held=(0,),
        exact=lambda X, t: v0 / omega * np.sin(k * X) * np.sin(omega * t),
        start=undeformed(lambda X: v0 * np.sin(k * X)), body_force=nothing)


def oedometer(
    name: str, levels: list[int], g: float, steps: Callable[[int], int], instants: int
) -> Problem:
    young, rho = 1e5, 1e3
    c = sqrt(young / rho)

    def exact(X: Array, t: float) -> Array:
        def fall(tau: Array) -> Array:
            return -g / 2 * np.maximum(tau, 0) ** 2

        def wave(k: int) -> Array:
            return (-1) ** k * (fall(t - (2 * k + X) / c) + fall(t - (2 * (k + 1) - X) / c))

        return fall(np.array(t)) - np.sum([wave(k) for k in range(4)], axis=0)

    return Problem(
        name, levels, ppc=10, until=0.5, steps=steps, instants=instants, young=young, rho=rho,
        law="linear_elastic", room=3, held=(0,), half_step_back=True, exact=exact,
        start=undeformed(nothing), body_force=lambda X, t: np.full_like(X, -g))


def steffen_bar(name: str, levels: list[int], p0: float, half_step_back: bool) -> Problem:
    young, rho, grid = 100.0, 100.0, 1.15
    c = sqrt(young / rho)

    def exact(X: Array, t: float) -> Array:
        def pull(tau: Array) -> Array:
            return p0 * c / young * np.maximum(tau, 0)

        def wave(k: int) -> Array:
            return (-1) ** k * (pull(t - (2 * k + 1 - X) / c) - pull(t - (2 * k + 1 + X) / c))

        return np.sum([wave(k) for k in range(3)], axis=0)

    def steps(cells: int) -> int:
        return round(1.5 / (0.15 * grid / cells / c)) if half_step_back else 150

    return Problem(
        name, levels, ppc=10, until=1.5, steps=steps, instants=150, young=young, rho=rho,
        law="linear_elastic", grid=grid, held=(0,), pull=p0, half_step_back=half_step_back,
        exact=exact, start=undeformed(nothing), body_force=nothing)


def manufactured(
    name: str, levels: list[int], young: float, rho: float, amplitude: float, wave: float,
    phases: list[float], until: float, courant: float, instants: int, poisson: float = 0.0,
    held: tuple[int, ...] = (), half_step_back: bool = False
) -> Problem:
    """u_a = A sin(wave pi X_a) sin(pi (c t + phase_a)) along each axis a, c = sqrt(E/rho).

    Between the `held` ends, or periodic.
    """
    c, k, omega = sqrt(young / rho), wave * pi, pi * sqrt(young / rho)
    phase = pi * np.array(phases)

    def exact(X: Array, t: float) -> Array:
        return amplitude * np.sin(k * X) * np.sin(omega * t + phase)

    def stretches(X: Array, t: float) -> Array:
        return 1 + amplitude * k * np.cos(k * X) * np.sin(omega * t + phase)

    def start(X: Array) -> tuple[Array, Array, Array]:
        F = stretches(X, 0)[:, :, None] * np.eye(X.shape[1])
        return exact(X, 0), F, amplitude * omega * np.sin(k * X) * np.cos(phase)

    def body_force(X: Array, t: float) -> Array:
        # P_aa = mu (F_a - 1/F_a) + lambda ln(J)/F_a; only F_a depends on X_a, and J = F_1 F_2.
        F, lam, mu = stretches(X, t), problem.lam, problem.mu
        ln_J = np.log(np.prod(F, axis=1, keepdims=True))
        slope = mu * (1 + 1 / F**2) + lam * (1 - ln_J) / F**2
        return (slope * k**2 / rho - omega**2) * exact(X, t)  # u_tt - P_aa,a / rho

    def steps(cells: int) -> int:
        return round(until * c * cells / courant)

    problem = Problem(
        name, levels, ppc=2, until=until, steps=steps, instants=instants, young=young, rho=rho,
        law="neo_hookean", exact=exact, start=start, body_force=body_force, poisson=poisson,
        d=len(phases), held=held, periodic=not held, half_step_back=half_step_back)
    return problem


def fixed_bar(name: str, levels: list[int], amplitude: float) -> Problem:
    return manufactured(
        name, levels, 1e7, 1e3, amplitude, 1, [0], 0.02, 0.2, instants=20, held=(0, -1))


def periodic_bar(name: str, levels: list[int], amplitude: float, phase: float) -> Problem:
    return manufactured(
        name, levels, 1e4, 1.0, amplitude, 2, [phase], 0.02, 0.1, instants=20,
        half_step_back=True)


def axis_aligned(
    name: str, levels: list[int], amplitude: float, wave: float, held: tuple[int, ...]
) -> Problem:
    return manufactured(
        name, levels, 1e4, 1.0, amplitude, wave, [0, 1], 0.01, 0.4, instants=5, poisson=0.3,
        held=held, half_step_back=True)


def translating_stressed_bar() -> Problem:
    stretch, young = 1.1, 1e4
    velocity = 0.1 * sqrt(young)

    def exact(X: Array, t: float) -> Array:
        return (stretch - 1) * X + velocity * t

    return Problem(
        "translating-stressed-bar", [22], ppc=2, until=10 * stretch / 22 / velocity,
        steps=lambda cells: 1000, instants=50, young=young, rho=1.0, law="neo_hookean",
        grid=stretch, periodic=True, exact=exact, body_force=nothing,
        start=lambda X: (exact(X, 0), np.full((len(X), 1, 1), stretch), np.full_like(X, velocity)))


PROBLEMS = [
    vibrating_bar("vibrating-bar", [5, 10, 80], 0.1),
    vibrating_bar("vibrating-bar-small-amplitude", [5, 10, 20], 1e-4),
    oedometer("oedometer", [10, 20], 9.81, lambda cells: {10: 167, 20: 334}[cells], 167),
    oedometer("oedometer-small-strain", [10], 9.81e-5, lambda cells: round(5 * cells / 0.15), 100),
    steffen_bar("steffen-bar", [10, 20], 0.7, half_step_back=False),
    steffen_bar("steffen-bar-small-load", [10, 20], 7e-6, half_step_back=True),
    fixed_bar("mms-fixed-bar-small", [8, 16, 32], 1e-4),
    fixed_bar("mms-fixed-bar-large", [8, 16, 32], 0.05),
    periodic_bar("mms-periodic-bar-small", [12, 16, 24], 1e-4, 0.5),
    periodic_bar("mms-periodic-bar-cos", [16, 24], 0.05, 0.5),
    periodic_bar("mms-periodic-bar-sin", [16, 24], 0.05, 0),
    translating_stressed_bar(),
    axis_aligned("mms-axis-aligned-2d", [8, 12], 0.05, 1, held=(0, -1)),
    axis_aligned("mms-axis-aligned-2d-periodic", [12], 0.025, 2, held=()),
]
