"""Runs a Python client with a fault of `faults.py`, or with its states given at other points.

    python3 tests/clients/variant.py [--client NAME] [--fault NAME] [--points KIND] [--substeps K] OPTION ...

The remaining options are those of the client. `--points particles` names the particles' reference positions as
points, `--points shuffled` the same in a random order, `--points every-second` and `every-third` a sample of them with
weights of 2 or 3 volumes, and `--points nodes` the mesh nodes in the body.
`--laws` restricts the laws, and `--shift` moves the positions that the NumPy client holds.
`--substeps 3` takes three steps of dt/3 for each step, `--substeps 2,3,5` these numbers of steps in turn, and
`--substeps 0.3+0.7` steps of 0.3 dt and 0.7 dt.
"""

from __future__ import annotations

import argparse
import functools
import sys
import textwrap
import types
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
from faults import DENSITY_FAULTS, FAULTS, GRADIENT_FAULTS, VARIATIONS

ALL = {**FAULTS, **VARIATIONS, **GRADIENT_FAULTS, **DENSITY_FAULTS}
CLIENTS = Path(__file__).resolve().parent
SOLVERS = CLIENTS.parents[1] / "examples/solvers"
# Client name -> files to load in order, class name.
SOURCES = {
    "numpy": ([SOLVERS / "mpm_verify.py", SOLVERS / "numpy_mpm.py"], "Mpm"),
    "apic": ([SOLVERS / "mpm_verify.py", SOLVERS / "numpy_mpm.py", CLIENTS / "apic_mpm.py"], "Apic"),
    "sph": ([SOLVERS / "mpm_verify.py", SOLVERS / "lagrangian.py", SOLVERS / "sph.py"], "Sph"),
    "several_bodies": ([SOLVERS / "mpm_verify.py", SOLVERS / "numpy_mpm.py", CLIENTS / "several_bodies.py"], "Bodies"),
    "fem": ([CLIENTS / "fem.py"], "Fem"),
    "small-fem": ([SOLVERS / "mpm_verify.py", SOLVERS / "lagrangian.py", CLIENTS / "small_fem.py"], "SmallFem"),
    "total_lagrangian": ([CLIENTS / "total_lagrangian.py"], "TotalLagrangian"),
    "laws": ([SOLVERS / "mpm_verify.py", SOLVERS / "numpy_mpm.py", CLIENTS / "laws_mpm.py"], "Laws"),
    "load_steps": ([SOLVERS / "mpm_verify.py", CLIENTS / "load_steps.py"], "LoadSteps"),
}
MAIN = '\nif __name__ == "__main__":\n'


compiled = functools.lru_cache(64)(compile)


def apply_edits(texts, fault):
    """The sources with the edits of `fault`; each old text must occur exactly once in all of them."""
    for old, new in fault.edits.items():
        counts = [text.count(old) for text in texts]
        if sum(counts) != 1:
            sys.exit(f"{fault.name}: the sources of the client contain `{old}` {sum(counts)} times, not once")
        texts = [text.replace(old, new) for text in texts]
    return texts


def compile_parts(client, fault):
    """The code of each file of the client without its main program, of the patch of `fault`, and of the main program."""
    files, name = SOURCES[client]
    texts = [file.read_text() for file in files]
    parts = [text.partition(MAIN) for text in (apply_edits(texts, fault) if fault else texts)]
    heads = [(file, compiled(head, str(file), "exec")) for file, (head, _, _) in zip(files, parts)]
    patch = None
    if fault and fault.patch:
        text = f"class {name}({name}):\n" + textwrap.indent(textwrap.dedent(fault.patch).strip("\n"), "    ")
        patch = compiled(text, f"<{fault.name}>", "exec")
    return heads, patch, compiled(textwrap.dedent(parts[-1][2]), str(files[-1]), "exec")


def load(client, fault):
    """The module of the client, the name of its class, and the code of its main program."""
    heads, patch, main = compile_parts(client, fault)
    for file, head in heads:
        module = types.ModuleType(file.stem)
        module.__file__ = str(file)
        sys.modules[file.stem] = module
        exec(head, module.__dict__)
    if patch:
        exec(patch, module.__dict__)
    return module, SOURCES[client][1], main


def ask_at(problem, places):
    """Makes `places` the default positions of body forces; with points, the default of the protocol is the points."""
    ask = problem.body_force
    problem.body_force = lambda t, at=None, **more: ask(t, places if at is None else at, **more)


class AtParticles:
    """States at the particles, which are named as points."""

    def order(self, count):
        return np.arange(count)

    def setup(self, problem):
        self.chosen = self.order(len(problem.reference_position))
        volume = problem.volume / np.linalg.det(problem.deformation_gradient)
        weight = volume[self.chosen] * (volume.sum() / volume[self.chosen].sum())
        points = {"reference_position": problem.reference_position[self.chosen], "weight": weight}
        ask_at(problem, problem.reference_position)
        super().setup(problem)
        return points

    def state(self):
        return {key: value[self.chosen] if isinstance(value, np.ndarray) else value
                for key, value in super().state().items()}


class Shuffled(AtParticles):
    """States at the particles in a random order."""

    def order(self, count):
        return np.random.default_rng(39).permutation(count)


class EverySecond(AtParticles):
    """States at every second particle, each with the weight of two."""

    def order(self, count):
        return np.arange(0, count, 2)


class EveryThird(AtParticles):
    """States at every third particle, each with the weight of three."""

    def order(self, count):
        return np.arange(0, count, 3)


class AtNodes:
    """Displacements and velocities of the mesh nodes in the body: means over the particles, weighted with volumes and
    the linear function of the node. Reference positions are such means too: those of the nodes, but at the boundary
    further inside. Linear fields are reproduced exactly, and so are the sums of volume and momentum."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.capabilities = {**self.capabilities, "columns": []}

    def setup(self, problem):
        s = (problem.reference_position - problem.origin) / problem.h
        axes = [np.arange(cells + 1) for cells in problem.cells]
        nodes = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, problem.dimension)
        volume = problem.volume / np.linalg.det(problem.deformation_gradient)
        share = volume * np.maximum(1 - np.abs(s[None] - nodes[:, None]), 0).prod(axis=-1)
        share = share[share.sum(axis=1) > 1e-9 * volume.max()]
        weight = share.sum(axis=1)
        self.share = share / weight[:, None]
        weight = getattr(super(), "point_weights", lambda weight, _: weight)(weight, problem)
        ask_at(problem, problem.reference_position)
        super().setup(problem)
        return {"reference_position": self.share @ problem.reference_position, "weight": weight}

    def state(self):
        state = super().state()
        return {**{key: state[key] for key in ("crossings", "min_j") if key in state},
                **{key: self.share @ state[key] for key in ("displacement", "velocity")}}


class Offset:
    """Positions, and the grid, moved by the same distance along each axis: `offset` (m)."""

    offset = 0.0

    def setup(self, problem):
        problem.position = problem.position + self.offset
        problem.origin = problem.origin + self.offset
        return super().setup(problem)

    def node_places(self):
        return super().node_places() - self.offset

    def state(self):
        return {**super().state(), "displacement": self.x - (self.problem.reference_position + self.offset)}


class SubSteps:
    """Several shorter steps for each step: `plan` has the shares of dt for one or more steps, which alternate."""

    plan, taken = [[1.0]], 0

    def step(self, dt, time):
        for share in self.plan[self.taken % len(self.plan)]:
            super().step(share * dt, time)
            time += share * dt
        self.taken += 1


def shares_of(text):
    """Shares of dt for each step, from the value of `--substeps`."""
    if "+" in text:
        return [[float(share) for share in text.split("+")]]
    return [[1 / int(count)] * int(count) for count in text.split(",")]


POINTS = {"particles": AtParticles, "shuffled": Shuffled, "nodes": AtNodes,
          "every-second": EverySecond, "every-third": EveryThird}


def parse(words):
    """The arguments of this program, and the options of the client."""
    parser = argparse.ArgumentParser(allow_abbrev=False)
    parser.add_argument("--client", choices=SOURCES, default="numpy")
    parser.add_argument("--fault", choices=ALL, metavar="NAME")
    parser.add_argument("--points", choices=POINTS)
    parser.add_argument("--laws", nargs="+", metavar="LAW", help="the only laws that the client declares")
    parser.add_argument("--shift", type=float, help="offset of the positions that the NumPy client holds (m)")
    parser.add_argument("--substeps", type=shares_of, help="steps for each step that is requested")
    return parser.parse_known_args(words)


def prepare(words):
    """Compiles the client of a command line."""
    arguments, _ = parse(words)
    compile_parts(arguments.client, ALL.get(arguments.fault))


def main():
    arguments, rest = parse(sys.argv[1:])
    module, name, program = load(arguments.client, ALL.get(arguments.fault))
    if arguments.laws:
        own = module.__dict__[name]

        def restricted(self, *more, **options):
            own.__init__(self, *more, **options)
            self.capabilities = {**self.capabilities, "laws": arguments.laws}

        module.__dict__[name] = type(name, (own,), {"__init__": restricted})
    if arguments.shift:
        module.__dict__[name] = type(name, (Offset, module.__dict__[name]), {"offset": arguments.shift})
    if arguments.points:
        bases = (POINTS[arguments.points], module.__dict__[name])
        module.__dict__[name] = type(name, bases, {})
    if arguments.substeps:
        module.__dict__[name] = type(name, (SubSteps, module.__dict__[name]), {"plan": arguments.substeps})
    sys.argv[1:] = rest
    exec(program, module.__dict__)


if __name__ == "__main__":
    main()
