"""Explicit elastodynamics in the reference configuration: laws and time steps.

Shared by solvers whose points keep their neighbours: `sph.py` here, and the finite elements of
examples/atlas.
"""

from __future__ import annotations

import numpy as np

from mpm_verify import Array, Message, Problem


class Material:
    """An elastic law at n points. Deformation gradients and stresses have the shape (n, d, d)."""

    def __init__(self, parameters: Message) -> None:
        young, poisson = parameters["young"], parameters["poisson"]
        self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        self.mu = young / (2 * (1 + poisson))

    def start(self, f: Array, stress: Array) -> None:
        """Takes the initial deformation gradient and Cauchy stress (Pa)."""

    def piola(self, f: Array) -> Array:
        """The first Piola-Kirchhoff stress (Pa) at the deformation gradient `f`."""
        raise NotImplementedError


class NeoHookean(Material):
    """P = lambda ln(J) F^-T + mu (F - F^-T)."""

    def piola(self, f: Array) -> Array:
        spherical = self.lam * np.log(volume_ratio(f)) - self.mu
        return spherical[:, None, None] * inverse_transpose(f) + self.mu * f


class Corotated(Material):
    """P = 2 mu (F - R) + lambda (J - 1) J F^-T, where F = R U."""

    def piola(self, f: Array) -> Array:
        j = volume_ratio(f)
        left, _, right = np.linalg.svd(f)
        spherical = self.lam * (j - 1) * j
        return 2 * self.mu * (f - left @ right) + spherical[:, None, None] * inverse_transpose(f)


class LinearElastic(Material):
    """Linear elasticity in rate form: d(sigma)/dt = lambda tr(D) I + 2 mu D, without the rotation
    of an objective rate. Each step is integrated by the midpoint rule. `piola` must be called once
    for each step, in the order of the steps."""

    def start(self, f: Array, stress: Array) -> None:
        self.f, self.stress = f.copy(), stress.copy()

    def piola(self, f: Array) -> Array:
        gradient = (f - self.f) @ np.linalg.inv(0.5 * (f + self.f))
        strain = 0.5 * (gradient + gradient.transpose(0, 2, 1))
        trace = np.trace(strain, axis1=1, axis2=2)[:, None, None]
        self.stress += self.lam * trace * np.eye(f.shape[-1]) + 2 * self.mu * strain
        self.f = f.copy()
        return volume_ratio(f)[:, None, None] * self.stress @ inverse_transpose(f)


class SmallStrain(Material):
    """P = lambda tr(eps) I + 2 mu eps, where eps = sym(F - I)."""

    def piola(self, f: Array) -> Array:
        strain = 0.5 * (f + f.transpose(0, 2, 1)) - np.eye(f.shape[-1])
        trace = np.trace(strain, axis1=1, axis2=2)[:, None, None]
        return self.lam * trace * np.eye(f.shape[-1]) + 2 * self.mu * strain


LAWS = {"linear_elastic": LinearElastic, "small_strain": SmallStrain, "neo_hookean": NeoHookean,
        "corotated": Corotated}


def inverse_transpose(f: Array) -> Array:
    return np.linalg.inv(f).transpose(0, 2, 1)


def volume_ratio(f: Array) -> Array:
    """J = det F; an error if it is not positive."""
    j = np.linalg.det(f)
    if not j.min() > 0:
        p = np.argmax(~(j > 0))
        raise ArithmeticError(f"point {p} is inverted: J = {j[p]}")
    return j


class TotalLagrangian:
    """Time steps for displacements `u` and velocities `v` of points. A solver sets these in
    `setup`, with `a = None`, and defines `acceleration`."""

    problem: Problem
    u: Array
    v: Array
    a: Array | None
    time_order = 2
    longest_step = np.inf  # s; longer steps are divided

    def acceleration(self, time: float) -> Array:
        """Accelerations (m/s2) at the displacements `u`, zero where a point is held."""
        raise NotImplementedError

    def advance(self, steps: int, dt: float, time: float) -> None:
        if self.a is None:
            self.a = self.acceleration(time)
        take = {2: self.verlet, 4: self.nystrom}[self.time_order]
        parts = int(np.ceil(dt / self.longest_step)) or 1
        for step in range(steps * parts):
            take(dt / parts, time + step * dt / parts)

    def verlet(self, dt: float, time: float) -> None:
        """Velocity Verlet."""
        self.v = self.v + 0.5 * dt * self.a
        self.u = self.u + dt * self.v
        self.a = self.acceleration(time + dt)
        self.v = self.v + 0.5 * dt * self.a

    def nystrom(self, dt: float, time: float) -> None:
        """The method of Nystroem of order 4 for accelerations that depend on u and t only."""
        u, v, a = self.u, self.v, self.a
        self.u = u + 0.5 * dt * v + 0.125 * dt**2 * a
        middle = self.acceleration(time + 0.5 * dt)
        self.u = u + dt * v + 0.5 * dt**2 * middle
        end = self.acceleration(time + dt)
        self.u = u + dt * v + dt**2 / 6 * (a + 2 * middle)
        self.v = v + dt / 6 * (a + 4 * middle + end)
        self.a = self.acceleration(time + dt)
