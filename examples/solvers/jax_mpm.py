"""The solver of `numpy_mpm.py` with derivatives by JAX, in reverse mode.

    pip install numpy jax
    mpm-verify run gradient-bar --solver 'python3 examples/solvers/jax_mpm.py'

Runs without derivatives are those of the NumPy client, and need no JAX. For derivatives its methods
run on arrays of JAX. The loop over the steps is compiled, so loads that depend on time are tables.
"""

from __future__ import annotations

import argparse
from typing import Any, Callable

import numpy as np

import numpy_mpm
from mpm_verify import Array, Cannot, Message, serve

STATE = ("x", "v", "f", "sigma", "vol", "s", "cell", "plastic", "hardened",
         "crossings", "min_j")


class Moments:
    """A time of each step, of which the loop is at the one with the number `index`."""

    def __init__(self, times: Array, index: Any) -> None:
        self.times, self.index = times, index

    def __add__(self, other: float) -> Moments:
        return Moments(self.times + other, self.index)

    def __lt__(self, other: float) -> bool:
        return bool((self.times < other).all())


def tabulated(ask: Callable[..., Array], place: int) -> Callable[..., Any]:
    """A function of the problem whose argument number `place` is a time, for `Moments` too."""
    def values(*arguments: Any) -> Any:
        t = arguments[place]
        if not isinstance(t, Moments):
            return ask(*arguments)
        rows = [ask(*arguments[:place], float(one), *arguments[place + 1:]) for one in t.times]
        return jnp.asarray(np.stack(rows))[t.index]
    return values


class Traced(numpy_mpm.Mpm):
    """The NumPy client on arrays of JAX."""

    def locate(self) -> None:
        """Finds the cells of the particles. A particle outside the grid makes the run NaN."""
        problem = self.problem
        s = (self.x - problem.origin) / problem.h
        ends, periodic = np.array(problem.cells), np.array(problem.periodic)
        s = s - jnp.where(periodic, ends * jnp.floor(s / ends), 0)
        self.s = jnp.where((s >= 0) & (s <= ends), s, jnp.nan)
        self.cell = jnp.clip(jnp.nan_to_num(self.s).astype(int), 0, ends - 1)

    def add(self, terms: Any) -> Any:
        return jnp.zeros(len(self.free)).at[self.nodes.ravel()].add(terms.ravel())

    def per_mass(self, terms: Any) -> Any:
        sums = jnp.stack([self.add(terms[..., a]) for a in range(self.d)], axis=1)
        mass = self.mass[:, None]
        return self.free * jnp.where(mass > 0, sums / jnp.where(mass > 0, mass, 1), 0)

    def strain(self, step: Any) -> None:
        self.f = self.f + step @ self.f
        self.update_stress(step)
        self.min_j = jnp.minimum(self.min_j, (self.vol / self.vol0).min())

    def carried(self) -> dict[str, Any]:
        """The part of the state that a step changes."""
        return {name: getattr(self, name) for name in STATE}

    def loop(self, state: dict[str, Any], steps: int, dt: float, time: float) -> dict[str, Any]:
        """The state after all steps: the first step, then a loop over the others."""
        vars(self).update(state)
        self.step(dt, time)
        times = time + dt * np.arange(1, steps)

        def step(state: dict[str, Any], index: Any) -> tuple[dict[str, Any], None]:
            vars(self).update(state)
            self.velocity_time = Moments(times - 0.5 * dt, index)
            self.step(dt, Moments(times, index))
            return self.carried(), None

        return jax.lax.scan(step, self.carried(), np.arange(steps - 1))[0]

    def parameters(self) -> dict[str, Any]:
        """The parameters of the problem."""
        material = self.problem.materials[0]
        walls = {"friction": coefficient for coefficient, *_ in self.rough}
        return {"density": material["density"], "initial_velocity": 1.0, **material["parameters"],
                **walls}

    def end(self, of: Message, parameters: dict[str, Any], steps: int, dt: float) -> Any:
        """The functional `of` after all steps, with other values of some parameters."""
        nominal = self.parameters()
        now = {**nominal, **parameters}
        self.set_moduli(now["young"], now["poisson"])
        self.yield_stress, self.hardening = now.get("yield"), now.get("hardening", 0.0)
        self.m = self.m * (now["density"] / nominal["density"])
        self.v = self.v * now["initial_velocity"]
        for wall in self.rough:
            wall[0] = now["friction"]
        vars(self).update(self.loop(self.carried(), steps, dt, 0.0))
        return self.functional(of)


class JaxMpm(numpy_mpm.Mpm):
    """The NumPy client, with reverse differentiation of all steps."""

    name = "jax-mpm"

    def __init__(self, basis: str, scheme: str, flip: float, start: str) -> None:
        super().__init__(basis, scheme, flip, start, gradient=True)
        loads = ["gravity", "body_force", "damping"]
        self.capabilities = {**self.capabilities, "loads": loads}

    def differentiate(self, of: Message, with_respect_to: list[str], steps: int, dt: float
                      ) -> tuple[float, list[float]]:
        """The functional `of` and its derivatives, in one pass back through all steps."""
        self.refuse(of)
        traced, problem = Traced.__new__(Traced), self.problem
        vars(traced).update(vars(self))
        nominal = traced.parameters()
        unknown = [name for name in with_respect_to if name not in nominal]
        if unknown:
            raise Cannot(f"the problem has no {unknown[0]}")
        import_jax()
        traced.update_stress = getattr(traced, self.update_stress.__name__)
        problem.body_force = tabulated(problem.body_force, 0)  # type: ignore[method-assign]
        problem.load = tabulated(problem.load, 1)  # type: ignore[method-assign]
        problem.face_velocity = tabulated(problem.face_velocity, 1)  # type: ignore[method-assign]
        slopes_of = jax.value_and_grad(lambda values: traced.end(of, values, steps, dt))
        value, slopes = jax.jit(slopes_of)({name: nominal[name] for name in with_respect_to})
        return float(value), [float(slopes[name]) for name in with_respect_to]


def import_jax() -> None:
    """Loads JAX, in double precision, and gives it to the methods of the NumPy client."""
    global jax, jnp
    import jax
    from jax import numpy as jnp

    jax.config.update("jax_enable_x64", True)
    numpy_mpm.np, numpy_mpm.replaced = jnp, replaced  # type: ignore[assignment]


def replaced(field: Any, nodes: Array, values: Any) -> Any:
    """A nodal field with other values at some nodes."""
    return field.at[nodes].set(values)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--basis", choices=numpy_mpm.DEGREES, default="linear")
    parser.add_argument("--scheme", choices=["usl", "musl"], default="musl")
    parser.add_argument("--flip", type=float, default=1.0, help="share of FLIP; the rest is PIC")
    parser.add_argument("--start", choices=["at_zero", "half_step_back"], default="at_zero",
                        help="time of the first velocity; the latter takes it to -dt/2")
    serve(JaxMpm(**vars(parser.parse_args())))
