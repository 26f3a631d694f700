"""The client examples/solvers/numpy_mpm.py with further laws, and with plates in plane stress.

    mpm-verify doctor --solver 'python3 tests/clients/laws_mpm.py --basis linear'

J2 plasticity with the radial return of de Souza Neto, Peric & Owen (2008), chapter 7, on logarithmic strains; Tait's
equation of state (Cole 1948). With `--form rate`, metals and soils have the Jaumann rate of the Cauchy stress, and
fluids the rate of the density.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples/solvers"))
from mpm_verify import Array, Cannot, Problem, serve
from numpy_mpm import DEGREES, Mpm


class Laws(Mpm):
    """MPM with J2 plasticity and fluids in one to three dimensions, and with plane stress in rate form."""

    name = "laws-mpm"
    capabilities = {**Mpm.capabilities, "laws": [*Mpm.capabilities["laws"], "j2", "newtonian", "linear_fluid"],
                    "plane_stress": True}

    def __init__(self, form: str, **options) -> None:
        super().__init__(**options)
        self.form = form

    def setup(self, problem: Problem) -> None:
        material = problem.materials[0]
        self.law = law = material["law"]
        self.plate = problem.plane == "stress"
        if self.plate and law != "linear_elastic":
            raise Cannot("plane stress with linear elasticity only")
        if law in ("j2", "newtonian", "linear_fluid"):
            material["law"] = "hencky"
            if law != "j2":
                material["parameters"].update(young=1.0, poisson=0.0)
            if law == "j2" and problem.reference_stress.any():
                raise Cannot("j2 without initial stress only")
        super().setup(problem)
        material["law"] = law
        if law == "j2":
            self.plastic = np.broadcast_to(np.eye(3), (len(self.x), 3, 3))  # Cp^-1
            self.soil, self.update_stress = self.mises, self.plasticity
        if self.form == "rate" and self.update_stress == self.plasticity:
            self.update_stress, self.whole = self.jaumann, np.zeros((len(self.x), 3, 3))
        if law in ("newtonian", "linear_fluid"):
            self.update_stress = self.fluid
        if self.plate:
            self.lam = 2 * self.mu * self.lam / (self.lam + 2 * self.mu)

    def acceleration(self, time: float, dt: float) -> Array:
        self.dt = dt
        return super().acceleration(time, dt)

    def mises(self, tau: Array) -> Array:
        """Radial return to sqrt(3/2) abs(s) = yield + hardening alpha, with the deviator s."""
        mean = tau.mean(axis=1, keepdims=True)
        size = np.sqrt(1.5 * ((tau - mean) ** 2).sum(axis=1, keepdims=True))
        alpha = self.hardened[:, None]
        flow = np.maximum(size - (self.yield_stress + self.hardening * alpha), 0.0) / (3 * self.mu + self.hardening)
        self.hardened = self.hardened + flow[:, 0]
        return mean + (tau - mean) * (1 - 3 * self.mu * flow / np.maximum(size, 1e-300))

    def pressure(self, ratio: Array) -> Array:
        """Pressure at the volume ratio V/V0."""
        bulk = self.parameters["bulk"]
        if self.law == "linear_fluid":
            return bulk * (1 - ratio)
        return bulk / 7 * (ratio**-7.0 - 1)

    def fluid(self, step: Array) -> None:
        """sigma = -p I + 2 eta dev(D)."""
        trace = np.trace(step, axis1=1, axis2=2)
        self.vol = self.vol / (1 - trace) if self.form == "rate" else self.vol * np.linalg.det(np.eye(self.d) + step)
        one, rate = np.eye(self.d), 0.5 * (step + step.transpose(0, 2, 1)) / self.dt
        deviator = rate - np.trace(rate, axis1=1, axis2=2)[:, None, None] / 3 * one
        viscous = 2 * self.parameters.get("viscosity", 0.0) * deviator
        self.sigma = viscous - self.pressure(self.vol / self.vol0)[:, None, None] * one

    def jaumann(self, step: Array) -> None:
        """sigma += lambda tr(d eps) I + 2 mu d eps + W sigma - sigma W, returned to the yield surface."""
        self.vol = self.vol * np.linalg.det(np.eye(self.d) + step)
        whole = np.zeros_like(self.whole)
        whole[:, :self.d, :self.d] = step
        strain, spin = 0.5 * (whole + whole.transpose(0, 2, 1)), 0.5 * (whole - whole.transpose(0, 2, 1))
        trace = np.trace(strain, axis1=1, axis2=2)[:, None, None]
        trial = self.whole + self.lam * trace * np.eye(3) + 2 * self.mu * strain + spin @ self.whole - self.whole @ spin
        values, axes = np.linalg.eigh(trial)
        self.whole = np.einsum("pai,pi,pbi->pab", axes, self.soil(values), axes)
        self.sigma = self.whole[:, :self.d, :self.d]

    def rate(self, step: Array) -> None:
        super().rate(step)
        if self.plate:
            # D33 = -nu/(1 - nu) (D11 + D22); lam is that of the plate.
            across = -self.lam / (2 * self.mu) * np.trace(step, axis1=1, axis2=2)
            self.vol = self.vol * np.exp(across)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--basis", choices=DEGREES, default="linear")
    parser.add_argument("--scheme", choices=["usl", "musl"], default="musl")
    parser.add_argument("--flip", type=float, default=1.0)
    parser.add_argument("--start", choices=["at_zero", "half_step_back"], default="at_zero")
    parser.add_argument("--form", choices=["finite", "rate"], default="finite")
    serve(Laws(**vars(parser.parse_args())))
