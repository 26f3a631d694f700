"""A total Lagrangian GIMP in one to three dimensions, in NumPy: a solver that shares no code with examples/solvers.

    mpm-verify run SUITE --solver 'python3 tests/clients/total_lagrangian.py --scheme verlet --parts 3'

The functions are those of Bardenhagen & Kober (2004), integrated over the particle domains of the reference
configuration once, as in de Vaucorbeil, Nguyen & Hutchinson (2020), Comput. Methods Appl. Mech. Eng. 360. Particles
never cross cells. Internal forces are -sum V0 P grad N, with the first Piola-Kirchhoff stress P.
"""

from __future__ import annotations

import argparse
import itertools
import json
import sys

import numpy as np


class Refusal(Exception):
    """A problem that the solver does not support."""


class Channel:
    """Messages as lines of decimal JSON; no columns as bytes."""

    def read(self):
        return json.loads(sys.stdin.readline() or '{"type": "bye"}')

    def write(self, message):
        print(json.dumps(message, default=lambda value: np.asarray(value).ravel().tolist()), flush=True)

    def column(self, values):
        return np.array(values, float)


class Problem:
    """The message `problem`, with its columns as arrays."""

    def __init__(self, message, channel):
        self.message, self.channel, d = message, channel, message["dimension"]
        shapes = {"reference_position": (d,), "position": (d,), "velocity": (d,), "deformation_gradient": (d, d),
                  "stress": (d, d), "initial_stress": (d, d)}
        self.columns = {key: channel.column(values).reshape(-1, *shapes.get(key, ()))
                        for key, values in message["particles"].items()}
        self.reference_position = self.columns["reference_position"]

    def body_force(self, time):
        """Force per mass at the reference positions of the particles, also if states are given at other points."""
        kind, shape = self.message["body_force"], self.reference_position.shape
        if kind != "asked":
            return np.broadcast_to(self.message["body_force_value"] if kind == "constant" else 0.0, shape)
        self.channel.write({"type": "values", "of": "body_force", "t": float(time),
                            "reference_position": self.reference_position})
        return self.channel.column(self.channel.read()["values"]).reshape(shape)


def hat(s):
    return np.maximum(1 - np.abs(s), 0)


def hat_integral(s):
    """Integral of the hat function up to s."""
    s = np.clip(s, -1, 1)
    return np.where(s < 0, 0.5 * (1 + s) ** 2, 1 - 0.5 * (1 - s) ** 2)


def polar_rotation(f):
    u, _, vt = np.linalg.svd(f)
    return u @ vt


class TotalLagrangian:
    name, version, formal_order = "total-lagrangian", "1.0", 2

    def __init__(self, domain, grid, scheme, substeps, offset, sample):
        self.domain, self.grid, self.scheme = domain, grid, scheme
        self.substeps, self.offset, self.sample = substeps, offset, sample
        # Domains of a whole cell overlap, and reach beyond the walls.
        walls = ["fixed", "roller"] if domain == "particle" else []
        self.capabilities = {
            "dimensions": [1, 2, 3], "conditions": ["free", *walls], "loads": ["gravity", "body_force"],
            "laws": ["linear_elastic", "neo_hookean", "hencky", "corotated", "small_strain"], "manufactured": True,
            "columns": ["stress", "deformation_gradient"], "initial_deformation": True, "initial_stress": True,
            "varying_density": True}

    def setup(self, problem):
        message, columns = problem.message, problem.columns
        self.problem, self.d = problem, message["dimension"]
        material = message["materials"][0]
        self.law = getattr(self, material["law"])
        young, poisson = material["parameters"]["young"], material["parameters"]["poisson"]
        self.mu = young / (2 * (1 + poisson))
        self.lam = 2 * self.mu * poisson / (1 - 2 * poisson)
        self.x0 = columns["reference_position"] + self.offset
        self.x, self.v = columns["position"] + self.offset, columns["velocity"]
        self.f, self.sigma = columns["deformation_gradient"], columns["stress"]
        self.mass, self.volume = columns["mass"], columns["reference_volume"]
        self.s0 = columns.get("initial_stress", np.zeros_like(self.f))
        self.min_j, self.is_started = np.linalg.det(self.f).min(), False
        self.weigh(message)
        self.chosen = np.arange(len(self.x0))[::self.sample]
        if self.sample == 1:
            return None
        share = self.volume[self.chosen]
        weight = share * (self.volume.sum() / share.sum())
        return {"reference_position": problem.reference_position[self.chosen], "weight": weight}

    def weigh(self, message):
        """Nodes (n, 3^d) of the particles, their functions and reference gradients, and the held components."""
        h, grid = message["grid"]["h"], message["grid"]
        per_axis = round(message["particles_per_cell"] ** (1 / self.d))
        if per_axis**self.d != message["particles_per_cell"]:
            raise Refusal("particle domains that are not cubes")
        half = 0.5 / per_axis if self.domain == "particle" else 0.5  # cells
        values, slopes, index, counts, held = [], [], [], [], []
        for axis in range(self.d):
            faces = sorted((face for face in message["faces"] if face["axis"] == axis),
                           key=lambda face: (face["condition"] == "free", face["high"]))
            # A face of the body is at a node: a wall, if there is one.
            at = [face["at"] for face in faces if self.grid == "body" or face["condition"] != "free"]
            origin = at[0] if at else grid["origin"][axis]
            s = (self.x0[:, axis] - (origin + self.offset)) / h
            low, high = (np.where(np.abs(edge - np.rint(edge)) < 1e-9, np.rint(edge), edge)
                         for edge in (s - half, s + half))
            first = np.floor(low)
            node = first[:, None] + np.arange(3)
            a, b = low[:, None] - node, high[:, None] - node
            values.append((hat_integral(b) - hat_integral(a)) / (b - a))
            slopes.append((hat(b) - hat(a)) / (b - a) / h)
            start = first.min()
            index.append((node - start).astype(int))
            counts.append(index[-1].max() + 1)
            place = origin + h * (start + np.arange(counts[-1]))
            for face in faces:
                inward = (place - face["at"]) * (-1 if face["high"] else 1)
                if face["condition"] != "free":
                    held.append((axis, inward < 0.5 * h, face["condition"] == "fixed"))
        offsets = list(itertools.product(range(3), repeat=self.d))
        self.nodes = np.stack([np.ravel_multi_index([index[a][:, r[a]] for a in range(self.d)], counts)
                               for r in offsets], axis=1)
        self.n = np.stack([np.prod([values[a][:, r[a]] for a in range(self.d)], axis=0) for r in offsets], axis=1)
        self.dn = np.stack([np.stack([np.prod([(slopes if a == b else values)[a][:, r[a]] for a in range(self.d)], axis=0)
                                      for b in range(self.d)], axis=1) for r in offsets], axis=1)
        free = np.ones((*counts, self.d))
        for axis, is_held, is_fixed in held:
            free[(slice(None),) * axis + (is_held,) + (...,) + (slice(None) if is_fixed else axis,)] = 0
        self.free = free.reshape(-1, self.d)
        self.node_mass = self.add(self.n * self.mass[:, None])

    def add(self, terms):
        """Sums at the nodes of terms (n, 3^d)."""
        return np.bincount(self.nodes.ravel(), terms.ravel(), len(self.free))

    def per_mass(self, terms):
        """Sums at the nodes of vectors (n, 3^d, d), divided by the nodal mass; zero where held."""
        sums = np.stack([self.add(terms[..., a]) for a in range(self.d)], axis=1)
        mass = self.node_mass[:, None]
        return self.free * np.divide(sums, mass, out=np.zeros_like(sums), where=mass > 0)

    def gather(self, field):
        return np.einsum("pk,pkd->pd", self.n, field[self.nodes])

    def acceleration(self, time):
        """Accelerations of the particles (m/s2) at `time` (s)."""
        j = np.linalg.det(self.f)[:, None, None]
        first_piola = j * self.sigma @ np.linalg.inv(self.f).transpose(0, 2, 1)
        inner = np.einsum("p,pab,pkb->pka", self.volume, first_piola, self.dn)
        outer = self.mass[:, None] * self.problem.body_force(time)
        return self.gather(self.per_mass(self.n[..., None] * outer[:, None] - inner))

    def advance(self, steps, dt, time):
        count = steps * self.substeps
        for step in range(count):
            self.step(dt / self.substeps, time + step * dt / self.substeps)

    def step(self, dt, time):
        if self.scheme == "verlet":
            if not self.is_started:
                self.a = self.acceleration(time)
            self.v = self.v + 0.5 * dt * self.a
            self.move(dt)
            self.a = self.acceleration(time + dt)
            self.v = self.v + 0.5 * dt * self.a
        else:
            # The velocity of t = 0 becomes that of -dt/2, if it is not used as it is.
            is_half = self.scheme == "leapfrog" and not self.is_started
            self.v = self.v + (0.5 * dt if is_half else dt) * self.acceleration(time)
            self.move(dt)
        self.is_started = True

    def move(self, dt):
        """Positions, deformation and stress after a step with the present velocity."""
        velocity = self.per_mass(self.n[..., None] * (self.mass[:, None] * self.v)[:, None])
        self.x = self.x + dt * self.gather(velocity)
        change = dt * np.einsum("pka,pkb->pab", velocity[self.nodes], self.dn)
        before, self.f = self.f, self.f + change
        j = np.linalg.det(self.f)
        if not j.min() > 0:
            raise ArithmeticError(f"particle {np.argmax(~(j > 0))} is inverted")
        self.min_j = min(self.min_j, j.min())
        self.sigma = self.law(j[:, None, None], before)

    def linear_elastic(self, _, before):
        """sigma' = lambda tr(d) I + 2 mu d, with d of the middle of the step."""
        rate = (self.f - before) @ np.linalg.inv(0.5 * (self.f + before))
        strain = 0.5 * (rate + rate.transpose(0, 2, 1))
        return self.sigma + self.hooke(strain)

    def hooke(self, strain):
        return self.lam * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(self.d) + 2 * self.mu * strain

    def with_initial(self, kirchhoff, j):
        return (kirchhoff + self.f @ self.s0 @ self.f.transpose(0, 2, 1)) / j

    def small_strain(self, j, _):
        """P = lambda tr(grad u) I + 2 mu sym(grad u), linear in u."""
        gradient = self.f - np.eye(self.d)
        return self.hooke(0.5 * (gradient + gradient.transpose(0, 2, 1))) @ self.f.transpose(0, 2, 1) / j

    def neo_hookean(self, j, _):
        one = np.eye(self.d)
        return self.with_initial(self.lam * np.log(j) * one + self.mu * (self.f @ self.f.transpose(0, 2, 1) - one), j)

    def hencky(self, j, _):
        axes, stretch, _ = np.linalg.svd(self.f)
        strain = np.einsum("pai,pi,pbi->pab", axes, np.log(stretch), axes)
        return self.with_initial(self.hooke(strain), j)

    def corotated(self, j, _):
        shear = 2 * self.mu * (self.f - polar_rotation(self.f)) @ self.f.transpose(0, 2, 1)
        return self.with_initial(shear + self.lam * (j - 1) * j * np.eye(self.d), j)

    def state(self):
        state = {"displacement": self.x - self.x0, "velocity": self.v, "stress": self.sigma,
                 "deformation_gradient": self.f}
        return {**{key: value[self.chosen] for key, value in state.items()}, "crossings": 0, "min_j": float(self.min_j)}


def answer(solver, channel, request):
    kind = request["type"]
    if kind == "hello":
        return {"type": "hello", "protocol": 2, "name": solver.name, "version": solver.version,
                "formal_order": solver.formal_order, "capabilities": solver.capabilities}
    if kind == "problem":
        points = solver.setup(Problem(request, channel))
        return {"type": "ready", **({"points": points} if points else {})}
    solver.advance(request["steps"], request["dt"], request["from"])
    state = solver.state()
    numbers = ("crossings", "min_j")
    return {"type": "state", "columns": {key: value for key, value in state.items() if key not in numbers},
            **{key: state[key] for key in numbers}}


def serve(solver):
    channel = Channel()
    while (request := channel.read())["type"] != "bye":
        try:
            channel.write(answer(solver, channel, request))
        except Refusal as reason:
            channel.write({"type": "cannot", "reason": str(reason)})
        except (ArithmeticError, ValueError, np.linalg.LinAlgError) as error:
            channel.write({"type": "failed", "reason": f"{type(error).__name__}: {error}"})


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--domain", choices=["particle", "cell"], default="particle",
                        help="domains over which functions are averaged; cells give quadratic B-splines")
    parser.add_argument("--grid", choices=["body", "problem"], default="body", help="where nodes are placed")
    parser.add_argument("--scheme", choices=["leapfrog", "verlet", "euler"], default="leapfrog",
                        help="the symplectic Euler method uses the velocity of t = 0 as that of -dt/2")
    parser.add_argument("--parts", dest="substeps", type=int, default=1, help="steps for each step that is requested")
    parser.add_argument("--offset", type=float, default=0.0, help="added to all positions that the solver holds (m)")
    parser.add_argument("--sample", type=int, default=1, help="states at every particle with this stride")
    serve(TotalLagrangian(**vars(parser.parse_args())))
