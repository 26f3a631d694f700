"""An explicit MPM in one to three dimensions, in NumPy, as a solver under test.

    mpm-verify run SUITE --solver 'python3 examples/solvers/numpy_mpm.py --scheme usl'
    mpm-verify run gradient-bar --solver 'python3 examples/solvers/numpy_mpm.py --gradient'

Sulsky, Chen & Schreyer (1994) with a lumped mass matrix; B-splines at walls as in Steffen, Kirby &
Berzins (2008).
"""

from __future__ import annotations

import argparse
import itertools
import math
from typing import Any, Callable

import numpy as np

from mpm_verify import Array, Cannot, Message, Problem, serve

DEGREES = {"linear": 1, "quadratic_bspline": 2, "cubic_bspline": 3}


class Dual(np.lib.mixins.NDArrayOperatorsMixin):
    """An array with its derivatives, an array for each parameter: forward differentiation.

    Branches, such as the cell of a particle, depend on the value only."""

    def __init__(self, value: Any, slopes: list[Any]) -> None:
        self.value = np.asarray(value)
        self.slopes = [np.broadcast_to(slope, self.value.shape) for slope in slopes]

    def __array_ufunc__(self, ufunc: Any, _: str, *inputs: Any, **options: Any) -> Any:
        a, *rest = part(inputs)
        b = rest[0] if rest else None
        if "where" in options:  # a division where a condition holds; the result is zero elsewhere
            b = np.where(options["where"], b, np.inf)
        value = ufunc(a, b) if rest else ufunc(a)
        slope: Callable[..., Any] | None = {
            np.add: lambda da, db: da + db, np.subtract: lambda da, db: da - db,
            np.multiply: lambda da, db: da * b + a * db,
            np.matmul: lambda da, db: (0 * a + da) @ b + a @ (0 * b + db),
            np.divide: lambda da, db: (da - a / b * db) / b, np.negative: lambda da: -da,
            np.log: lambda da: da / a, np.exp: lambda da: value * da,
            np.sqrt: lambda da: 0.5 * da / value,
            np.absolute: lambda da: np.sign(a) * da,
            np.maximum: lambda da, db: np.where(a > b, da, db)}.get(ufunc)
        if slope is None:  # comparisons and roundings
            return value
        return Dual(value, [slope(*(x.slopes[k] if isinstance(x, Dual) else 0.0 for x in inputs))
                            for k in range(len(self.slopes))])

    def __array_function__(self, function: Any, _: Any, inputs: Any, options: Any) -> Any:
        count, values = range(len(self.slopes)), part(inputs)
        if function is np.einsum:  # linear in each operand
            def slope(k: int) -> Any:
                return sum(np.einsum(*values[:i], x.slopes[k], *values[i + 1:])
                           for i, x in enumerate(inputs) if isinstance(x, Dual))
            return Dual(np.einsum(*values), [slope(k) for k in count])
        if function is np.linalg.det:
            value, inverse = np.linalg.det(self.value), np.linalg.inv(self.value)
            return Dual(value, [value * np.trace(inverse @ d, axis1=1, axis2=2)
                                for d in self.slopes])
        if function is np.linalg.eigh:  # of matrices of one number
            return self[..., 0], np.ones_like(self.value)
        if function in (np.linalg.svd, np.ones_like, np.zeros_like):  # no derivatives in 1-D
            return function(*values, **options)
        # Functions that are linear in all duals: stack, trace, diff, bincount, where.
        return Dual(function(*values, **options),
                    [function(*part(inputs, k), **options) for k in count])

    def __getitem__(self, index: Any) -> Dual:
        return Dual(self.value[index], [slope[index] for slope in self.slopes])

    def __getattr__(self, name: str) -> Any:
        if name in ("astype", "min", "shape"):
            return getattr(self.value, name)
        return lambda *inputs, **options: Dual(
            getattr(self.value, name)(*inputs, **options),
            [getattr(slope, name)(*inputs, **options) for slope in self.slopes])


def part(x: Any, k: int | None = None) -> Any:
    """`x`, and all that a sequence holds, with the values of duals, or with their slopes `k`."""
    if isinstance(x, (list, tuple)):
        return type(x)(part(inner, k) for inner in x)
    if isinstance(x, Dual):
        return x.value if k is None else x.slopes[k]
    return x


def replaced(field: Any, nodes: Array, values: Array) -> Any:
    """A nodal field with other values, without derivatives, at some nodes."""
    kept, given = np.ones((field.shape[0], 1)), np.zeros(field.shape)
    kept[nodes], given[nodes] = 0, values
    return kept * field + given


def bsplines(degree: int, s: Array, cell: Array, cells: int, periodic: bool) -> tuple[Array, Array]:
    """Values and slopes, per cell, of the `degree + 1` functions that do not vanish at `s` (in
    cells), a row each: the recursion of Cox and de Boor. Knots are repeated at walls."""
    knots = [cell + 1.0 + k - degree for k in range(2 * degree)]
    if not periodic:
        knots = [np.clip(knot, 0, cells) for knot in knots]
    value, lower = [np.ones_like(s)], []
    for p in range(1, degree + 1):
        lower, value, saved = value, [], np.zeros_like(s)
        for r in range(p):
            left, right = knots[degree + r - p], knots[degree + r]
            share = lower[r] / (right - left)
            value.append(saved + (right - s) * share)
            saved = (s - left) * share
        value.append(saved)
    spans = [knots[degree + r] - knots[r] for r in range(degree)]
    terms = [degree * low / span for low, span in zip(lower, spans)]
    return np.stack(value), -np.diff(np.stack(terms), axis=0, prepend=0, append=0)


def rotation(f: Array) -> Array:
    """Rotation R of F = R U: in two dimensions that of the sum of F and its cofactors."""
    if f.shape[1] != 2:
        u, _, vt = np.linalg.svd(f)
        return u @ vt
    cos, sin = f[:, 0, 0] + f[:, 1, 1], f[:, 1, 0] - f[:, 0, 1]
    rows = [np.stack([cos, -sin], axis=1), np.stack([sin, cos], axis=1)]
    return np.stack(rows, axis=1) / np.sqrt(cos * cos + sin * sin)[:, None, None]


class Mpm:
    """The solver: n particles, each with k nodes around it, in d dimensions."""

    name = "numpy-mpm"
    version = "1.0"
    formal_order = 2
    capabilities = {
        "dimensions": [1, 2, 3],
        "laws": ["linear_elastic", "neo_hookean", "hencky", "corotated", "drucker_prager",
                 "mohr_coulomb", "polytropic"],
        "conditions": ["free", "fixed", "roller", "periodic", "velocity"],
        "loads": ["gravity", "body_force", "damping", "traction", "force"],
        "columns": ["stress", "deformation_gradient"],
        "manufactured": True,
        "initial_deformation": True,
        "initial_stress": True,
        "varying_density": True,
    }

    def __init__(self, basis: str, scheme: str, flip: float, start: str,
                 gradient: bool = False) -> None:
        self.degree, self.scheme, self.flip, self.start = DEGREES[basis], scheme, flip, start
        if gradient:
            own = self.capabilities
            self.capabilities = {
                **own, "laws": [*own["laws"], "j2"], "conditions": [*own["conditions"], "friction"],
                "gradients": ["young", "poisson", "density", "yield", "hardening", "friction",
                              "initial_velocity"]}

    def setup(self, problem: Problem) -> None:
        self.problem, self.d = problem, problem.dimension
        law, parameters = problem.materials[0]["law"], problem.materials[0]["parameters"]
        if law == "j2" and (self.d > 1 or problem.reference_stress.any()):
            raise Cannot("plasticity in one dimension and without initial stress only")
        self.parameters = parameters
        if law != "polytropic":
            self.set_moduli(parameters["young"], parameters["poisson"])
        self.yield_stress = parameters.get("yield")
        self.hardening = parameters.get("hardening", 0.0)
        self.update_stress = {"linear_elastic": self.rate, "neo_hookean": self.neo_hookean,
                              "hencky": self.hencky, "corotated": self.corotated,
                              "j2": self.j2, "drucker_prager": self.plasticity,
                              "mohr_coulomb": self.plasticity,
                              "polytropic": self.polytropic}[law]
        self.x, self.v = problem.position.copy(), problem.velocity.copy()
        self.f, self.sigma = problem.deformation_gradient.copy(), problem.stress.copy()
        self.m, self.vol = problem.mass, problem.volume.copy()
        self.vol0 = self.vol / np.linalg.det(self.f)
        self.plastic = self.hardened = np.zeros_like(self.vol)
        if law in ("drucker_prager", "mohr_coulomb"):
            if not np.allclose(self.f, np.eye(self.d), rtol=0, atol=1e-12) or self.sigma.any():
                raise Cannot("soils that start undeformed and without stress only")
            self.soil = getattr(self, law)
            self.plastic = np.broadcast_to(np.eye(3), (len(self.x), 3, 3))  # Cp^-1
        # With knots repeated at walls, the first and the last function alone do not vanish there.
        self.counts = [n if periodic else n + self.degree
                       for n, periodic in zip(problem.cells, problem.periodic)]
        self.free = np.ones((*self.counts, self.d))
        numbers = np.arange(np.prod(self.counts)).reshape(self.counts)
        places = self.node_places()
        self.driven, self.rough = [], []
        for face in problem.faces:
            end = (slice(None),) * face["axis"] + (-1 if face["high"] else 0,)
            if face["condition"] == "velocity":
                nodes = numbers[end].ravel()
                self.driven.append((face, nodes, places[nodes]))
            if face["condition"] == "friction":
                if self.d > 2 or self.scheme != "usl" or self.flip < 1:
                    raise Cannot("friction up to two dimensions, with USL and FLIP only")
                at = np.zeros(len(places))
                at[numbers[end]] = 1
                self.rough.append([face["values"]["coefficient"], face, at])
            if face["condition"] == "fixed":
                self.free[end] = 0
            elif face["condition"] == "roller":
                self.free[(*end, ..., face["axis"])] = 0
        self.free = self.free.reshape(-1, self.d)
        self.crossings, self.min_j, self.started = 0, (self.vol / self.vol0).min(), False
        self.velocity_time = 0.0  # of the velocities of the particles
        self.tractions, self.forces, self.damping = [], [], []
        for index, load in enumerate(problem.loads):
            if load["load"] == "traction":
                self.tractions.append((index, *self.surface(load["face"])))
            elif load["load"] == "force":
                low, high = load["region"]["from"], load["region"]["to"]
                x0 = problem.reference_position
                inside = np.all((x0 >= low) & (x0 <= high), axis=1)
                self.forces.append((index, inside * self.vol0 / self.vol0[inside].sum()))
            elif load["load"] == "damping":
                self.damping.append(index)
        self.locate()

    def set_moduli(self, young: Any, poisson: Any) -> None:
        self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        self.mu = young / (2 * (1 + poisson))

    def node_places(self) -> Array:
        """Places of the nodes (m): with B-splines, the means of the knots of each function."""
        problem, axes = self.problem, []
        for a, cells in enumerate(problem.cells):
            index = np.arange(self.counts[a])[:, None]
            knots = index + np.arange(self.degree) + 1 - self.degree
            if not problem.periodic[a]:
                knots = np.clip(knots, 0, cells)
            axes.append(problem.origin[a] + problem.h * knots.mean(axis=1))
        return np.stack([x.ravel() for x in np.meshgrid(*axes, indexing="ij")], axis=1)

    def surface(self, name: str) -> tuple[Any, Array, Array, Array]:
        """The layer of particles at a face: their numbers, the middles X of their shares of the
        face (m), the vectors from the particles to these (m), and the areas of the shares."""
        [face] = [face for face in self.problem.faces if face["name"] == name]
        x0, axis = self.problem.reference_position, face["axis"]
        depth = np.abs(face["at"] - x0[:, axis])
        layer = np.flatnonzero(depth < 2 * depth.min())
        arm = np.zeros((len(layer), self.d))
        arm[:, axis] = face["at"] - x0[layer, axis]
        return layer, x0[layer] + arm, arm, self.vol0[layer] / (2 * depth[layer])

    def locate(self) -> None:
        """Finds the places of the particles in the grid, and their cells."""
        problem = self.problem
        self.s = (self.x - problem.origin) / problem.h
        ends, periodic = np.array(problem.cells), np.array(problem.periodic)
        self.s -= np.where(periodic, ends * np.floor(self.s / ends), 0)
        outside = ~np.all((self.s >= 0) & (self.s <= ends), axis=1)
        if outside.any():
            p = np.argmax(outside)
            raise ArithmeticError(f"particle {p} left the grid, at {part(self.x)[p].tolist()}")
        self.cell = np.minimum(self.s.astype(int), ends - 1)

    def weigh(self) -> None:
        """Nodes (n, k) around the particles, their functions (n, k) and gradients (n, k, d)."""
        k = self.degree + 1
        axes = []
        for a, (cells, periodic) in enumerate(zip(self.problem.cells, self.problem.periodic)):
            along = bsplines(self.degree, self.s[:, a], self.cell[:, a], cells, periodic)
            axes.append((np.arange(k)[:, None] + self.cell[:, a], *along))
        nodes, values, gradients = [], [], []
        for offsets in itertools.product(range(k), repeat=self.d):
            node = 0
            for (index, _, _), r, count in zip(axes, offsets, self.counts):
                node = node * count + index[r] % count
            nodes.append(node)
            value = [n[r] for (_, n, _), r in zip(axes, offsets)]
            slope = [dn[r] / self.problem.h for (_, _, dn), r in zip(axes, offsets)]
            values.append(math.prod(value))
            gradients.append(np.stack([math.prod([*value[:a], slope[a], *value[a + 1:]])
                                       for a in range(self.d)]))
        self.nodes, self.n = np.array(nodes).T.copy(), np.stack(values).transpose(1, 0).copy()
        self.dn = np.stack(gradients).transpose(2, 0, 1).copy()
        self.mass = self.add(self.n * self.m[:, None])

    def add(self, terms: Array) -> Array:
        """Sums at the nodes of terms (n, k)."""
        size = len(self.free)
        sums: Array = np.bincount(self.nodes.ravel(), terms.ravel(), size)
        return sums

    def per_mass(self, terms: Array) -> Array:
        """Sums at the nodes of terms (n, k, d), divided by the nodal mass; zero where held."""
        sums = np.stack([self.add(terms[..., a]) for a in range(self.d)], axis=1)
        mass = self.mass[:, None]
        return self.free * np.divide(sums, mass, out=np.zeros_like(sums), where=mass > 0)

    def gather(self, field: Array) -> Array:
        """A nodal field at the particles."""
        values: Array = np.einsum("pk,pkd->pd", self.n, field[self.nodes])
        return values

    def velocity(self) -> Array:
        """Velocities of the nodes (m/s), from those of the particles."""
        field = self.per_mass(self.n[..., None] * (self.m[:, None] * self.v)[:, None])
        for face, nodes, places in self.driven:
            values = self.face_velocity(face, self.velocity_time, places) * self.free[nodes]
            field = replaced(field, nodes, values)
        return field

    def face_velocity(self, face: Message, t: float, places: Array) -> Array:
        """Velocity of a face (m/s); before the start it is continued through its value there."""
        if t < 0:
            return 2 * self.face_velocity(face, 0.0, places) - self.face_velocity(face, -t, places)
        return self.problem.face_velocity(face, t, places)

    def acceleration(self, time: float, dt: float) -> Array:
        """Accelerations of the nodes (m/s2), from stresses and loads at `time` (s). They take the
        velocities to the time `time + dt/2`."""
        stress = np.einsum("pkb,pab->pka", self.dn, self.vol[:, None, None] * self.sigma)
        force = self.m[:, None] * self.problem.body_force(time)
        for index, share in self.forces:
            force += share[:, None] * self.problem.load(index, time)
        terms = self.n[..., None] * force[:, None] - stress
        for index, layer, places, arm, area in self.tractions:
            # The functions at the surface, as far as their slopes at the particles give them.
            moved = np.einsum("pab,pb->pa", self.f[layer], arm)
            at_surface = self.n[layer] + np.einsum("pka,pa->pk", self.dn[layer], moved)
            pull = area[:, None] * self.problem.load(index, time, places)
            terms[layer] += at_surface[..., None] * pull[:, None]
        field = self.per_mass(terms)
        for face, nodes, places in self.driven:
            before, after = (self.face_velocity(face, t, places)
                             for t in (self.velocity_time, time + 0.5 * dt))
            field = replaced(field, nodes, (after - before) / dt * self.free[nodes])
        for coefficient, face, at in self.rough:
            field = field + self.reaction(self.velocity() + dt * field, coefficient, face, at) / dt
        return field

    def reaction(self, velocity: Array, coefficient: Any, face: Message, at: Array) -> Array:
        """Changes of nodal velocities by a wall with friction: it ends the motion into the wall,
        and slows sliding by at most the coefficient times that change."""
        inward, change = -1.0 if face["high"] else 1.0, [0.0 * velocity[:, 0]] * self.d
        stop = np.maximum(-inward * velocity[:, face["axis"]], 0.0) * at
        change[face["axis"]] = inward * stop
        for axis in {0, 1}.intersection(range(self.d)) - {face["axis"]}:
            speed = np.absolute(velocity[:, axis])
            slowed = np.maximum(speed - coefficient * stop, 0.0)
            change[axis] = np.sign(velocity[:, axis]) * (slowed - speed)
        return self.free * np.stack(change, axis=1)

    def advance(self, steps: int, dt: float, time: float) -> None:
        for step in range(steps):
            self.step(dt, time + step * dt)

    def step(self, dt: float, time: float) -> None:
        self.weigh()
        if not self.started and self.start == "half_step_back":
            self.velocity_time = -0.5 * dt
        acceleration = self.acceleration(time, dt)
        change = dt * self.gather(acceleration)
        if not self.started and self.start == "half_step_back":
            self.v -= 0.5 * change
        self.started = True
        if self.scheme == "usl" or self.flip < 1:
            velocity = self.velocity() + dt * acceleration
        self.v += change
        if self.flip < 1:
            self.v = self.flip * self.v + (1 - self.flip) * self.gather(velocity)
        self.velocity_time = time + 0.5 * dt
        for index in self.damping:
            self.v *= np.exp(-self.problem.load(index, time)[0] * dt)
        if self.scheme == "musl":
            velocity = self.velocity()
        self.strain(dt * np.einsum("pka,pkb->pab", velocity[self.nodes], self.dn))
        self.x += dt * self.gather(velocity)
        before = self.cell
        self.locate()
        self.crossings += np.any(self.cell != before, axis=1).sum()

    def strain(self, step: Array) -> None:
        """Deformation, volume and stress after `step`, the velocity gradient times dt."""
        self.f += step @ self.f
        self.update_stress(step)
        j = self.vol / self.vol0
        if not j.min() > 0:
            p = np.argmax(~(j > 0))
            raise ArithmeticError(f"particle {p} is inside out: J = {part(j)[p]}")
        self.min_j = min(self.min_j, j.min())

    def rate(self, step: Array) -> None:
        """sigma += lambda tr(d eps) I + 2 mu d eps; strain is plane or uniaxial."""
        one, strain = np.eye(self.d), 0.5 * (step + step.transpose(0, 2, 1))
        self.vol *= np.linalg.det(one + step)
        trace = np.trace(strain, axis1=1, axis2=2)[:, None, None]
        self.sigma += self.lam * trace * one + 2 * self.mu * strain

    def neo_hookean(self, _: Array) -> None:
        """sigma = (lambda ln(J)/J) I + (mu/J) (F F^T - I)."""
        left = self.f @ self.f.transpose(0, 2, 1)
        log = np.log(np.linalg.det(self.f))[:, None, None]
        self.kirchhoff((self.lam * log - self.mu) * np.eye(self.d) + self.mu * left)

    def hencky(self, _: Array) -> None:
        """sigma = (lambda tr(eps) I + 2 mu eps)/J, eps = ln(F F^T)/2."""
        squares, axes = np.linalg.eigh(self.f @ self.f.transpose(0, 2, 1))
        log = 0.5 * np.log(squares)
        principal = self.lam * log.sum(axis=1, keepdims=True) + 2 * self.mu * log
        self.kirchhoff(np.einsum("pai,pi,pbi->pab", axes, principal, axes))

    def j2(self, _: Array) -> None:
        """sigma = (lambda eps + 2 mu (eps - p))/J in uniaxial strain, eps = ln F, with the plastic
        strain p by radial return: abs(2 mu eps - 3 mu p) <= yield + hardening sum abs(dp)."""
        log = np.log(self.f[:, 0, 0])
        trial = 2 * self.mu * log - 3 * self.mu * self.plastic
        beyond = np.absolute(trial) - (self.yield_stress + self.hardening * self.hardened)
        flow = np.maximum(beyond, 0.0) / (3 * self.mu + self.hardening)
        self.plastic = self.plastic + np.sign(trial) * flow
        self.hardened = self.hardened + flow
        tau = self.lam * log + 2 * self.mu * (log - self.plastic)
        self.kirchhoff(tau[:, None, None])

    def plasticity(self, _: Array) -> None:
        """sigma = tau/J, tau = lambda tr(eps) I + 2 mu eps, with the elastic strain eps = ln(be)/2,
        be = F Cp^-1 F^T. The principal values of tau are returned to the yield surface."""
        f = np.broadcast_to(np.eye(3), (len(self.x), 3, 3)).copy()
        f[:, :self.d, :self.d] = self.f
        squares, axes = np.linalg.eigh(f @ self.plastic @ f.transpose(0, 2, 1))
        log = 0.5 * np.log(squares)  # in ascending order
        tau = self.soil(self.lam * log.sum(axis=1, keepdims=True) + 2 * self.mu * log)
        mean = tau.sum(axis=1, keepdims=True) / 3
        log = (tau - mean) / (2 * self.mu) + mean / (3 * self.lam + 2 * self.mu)
        inverse = np.linalg.inv(f)
        elastic = np.einsum("pai,pi,pbi->pab", axes, np.exp(2 * log), axes)
        self.plastic = inverse @ elastic @ inverse.transpose(0, 2, 1)
        self.kirchhoff(np.einsum("pai,pi,pbi->pab", axes, tau, axes)[:, :self.d, :self.d])

    def drucker_prager(self, tau: Array) -> Array:
        """Return to the cone sqrt(J2) + friction p = strength, or to its apex."""
        friction, dilation = self.parameters["friction"], self.parameters["dilation"]
        strength, bulk = self.parameters["strength"], self.lam + 2 * self.mu / 3
        mean = tau.mean(axis=1, keepdims=True)
        shear = np.sqrt(0.5 * ((tau - mean) ** 2).sum(axis=1, keepdims=True))
        excess = np.maximum(shear + friction * mean - strength, 0)
        flow = excess / (self.mu + bulk * friction * dilation)
        is_apex = self.mu * flow > shear
        left = 1 - np.divide(self.mu * flow, shear, out=np.ones_like(flow), where=shear > 0)
        cone = mean - bulk * dilation * flow + np.where(excess > 0, left, 1) * (tau - mean)
        return np.where(is_apex, strength / max(friction, 1e-300), cone)

    def mohr_coulomb(self, tau: Array) -> Array:
        """Return to a face, an edge or the apex of (t1 - t3) + (t1 + t3) sin(phi) = 2 c cos(phi)."""
        phi, psi = (math.radians(self.parameters[key])
                    for key in ("friction_angle", "dilation_angle"))
        strength = 2 * self.parameters["cohesion"] * math.cos(phi)
        found = self.returned(tau, [(2, 0)], phi, psi, strength)
        # On an edge the largest or the smallest two stresses are equal.
        for planes, [low, high] in (([(2, 0), (1, 0)], [1, 2]), ([(2, 0), (2, 1)], [0, 1])):
            is_wrong = found[:, low] > found[:, high]
            edge = self.returned(tau, planes, phi, psi, strength)
            found = np.where(is_wrong[:, None], edge, found)
        if phi > 0:
            apex = strength / (2 * math.sin(phi))
            found = np.where(found.mean(axis=1, keepdims=True) > apex, apex, found)
        return found

    def returned(self, tau: Array, planes: list[tuple[int, int]], phi: float, psi: float,
                 strength: float) -> Array:
        """Return to the planes between these pairs of a larger and a smaller principal stress."""
        def normal(plane: tuple[int, int], angle: float) -> Array:
            gradient = np.zeros(3)
            gradient[plane[0]], gradient[plane[1]] = 1 + math.sin(angle), math.sin(angle) - 1
            return gradient

        normals = np.array([normal(plane, phi) for plane in planes])
        flows = np.array([normal(plane, psi) for plane in planes])
        change = self.lam * flows.sum(axis=1, keepdims=True) + 2 * self.mu * flows
        excess = tau @ normals.T - strength
        share = np.linalg.solve(normals @ change.T, excess.T).T
        flows_now = (excess[:, :1] > 0) | (excess[:, -1:] > 0)
        returned: Array = np.where(flows_now, tau - share @ change, tau)
        return returned

    def corotated(self, _: Array) -> None:
        """sigma = (2 mu/J) (F - R) F^T + lambda (J - 1) I, with the rotation R of F."""
        j = np.linalg.det(self.f)[:, None, None]
        shear = 2 * self.mu * (self.f - rotation(self.f)) @ self.f.transpose(0, 2, 1)
        self.kirchhoff(shear + self.lam * (j - 1) * j * np.eye(self.d))

    def polytropic(self, _: Array) -> None:
        """sigma = -K rho^g I with the density rho of the particle, its mass per volume."""
        self.vol = np.linalg.det(self.f) * self.vol0
        pressure = self.parameters["stiffness"] * (self.m / self.vol) ** self.parameters["exponent"]
        self.sigma = -pressure[:, None, None] * np.eye(self.d)

    def kirchhoff(self, tau: Array) -> None:
        """Stress and volume of a law of the whole deformation, from its Kirchhoff stress and the
        stress S0 of the reference configuration: sigma = (tau + F S0 F^T)/J."""
        j = np.linalg.det(self.f)
        self.vol = j * self.vol0
        initial = self.f @ self.problem.reference_stress @ self.f.transpose(0, 2, 1)
        self.sigma = (tau + initial) / j[:, None, None]

    def differentiate(self, of: Message, with_respect_to: list[str], steps: int, dt: float
                      ) -> tuple[float, list[float]]:
        """The functional `of` and its derivatives: all steps on duals."""
        self.refuse(of)
        self.seed(with_respect_to)
        self.advance(steps, dt, 0.0)
        value = self.functional(of)
        return value.value, value.slopes

    def refuse(self, of: Message) -> None:
        """Raises `Cannot` if the functional `of` has no derivatives here."""
        most = {self.polytropic: 0, self.hencky: 1, self.corotated: 2}  # dimensions
        if self.d > most.get(self.update_stress, 3):
            raise Cannot("no gradients of this law in so many dimensions")
        if of["functional"] == "position_of" and of["particle"] >= len(self.x):
            raise Cannot(f"there is no particle {of['particle']}")

    def seed(self, names: list[str]) -> None:
        """Gives the parameters with these names the derivative 1 with respect to themselves."""
        def dual(value: Any, name: str, slope: Any) -> Any:
            return Dual(value, [slope if name == one else 0.0 for one in names])

        material = self.problem.materials[0]
        young, poisson = material["parameters"]["young"], material["parameters"]["poisson"]
        self.set_moduli(dual(young, "young", 1.0), dual(poisson, "poisson", 1.0))
        if self.update_stress == self.j2:
            self.yield_stress = dual(self.yield_stress, "yield", 1.0)
            self.hardening = dual(self.hardening, "hardening", 1.0)
        for wall in self.rough:
            wall[0] = dual(wall[0], "friction", 1.0)
        self.m = dual(self.m, "density", self.m / material["density"])
        self.v = dual(self.v, "initial_velocity", self.v)
        zeros = dual(np.zeros_like(self.x), "", 0.0)
        self.x, self.f = self.x + zeros, self.f + zeros[:, None]
        self.sigma, self.vol = self.sigma + zeros[:, None], self.vol + zeros[:, 0]
        self.locate()

    def functional(self, of: Message) -> Any:
        """A functional of the present state."""
        u, name = self.x - self.problem.reference_position, of["functional"]
        if name == "mean_displacement":
            return (self.m * u[:, of["axis"]]).sum() / self.m.sum()
        if name == "mean_square_displacement":
            return (self.m * (u * u).sum(axis=1)).sum() / self.m.sum()
        if name == "kinetic_energy":
            return 0.5 * (self.m * (self.v * self.v).sum(axis=1)).sum()
        if name == "position_of":
            return self.x[of["particle"], of["axis"]]
        raise Cannot(f"no gradient of {name}")

    def state(self) -> Message:
        return {"displacement": self.x - self.problem.reference_position, "velocity": self.v,
                "stress": self.sigma, "deformation_gradient": self.f,
                "crossings": self.crossings, "left_domain": 0, "min_j": self.min_j}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--basis", choices=DEGREES, default="linear")
    parser.add_argument("--scheme", choices=["usl", "musl"], default="musl")
    parser.add_argument("--flip", type=float, default=1.0, help="share of FLIP; the rest is PIC")
    parser.add_argument("--start", choices=["at_zero", "half_step_back"], default="at_zero",
                        help="time of the first velocity; the latter takes it to -dt/2")
    parser.add_argument("--gradient", action="store_true", help="adds derivatives, J2 and friction")
    serve(Mpm(**vars(parser.parse_args())))
