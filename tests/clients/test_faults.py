"""Tests of the faults themselves: each applies to the sources of its client, and changes an answer beyond rounding.

    python3 -m pytest tests/clients    # or: python3 tests/clients/test_faults.py

The problems are small, and take a few steps in several messages. They need no `mpm-verify`.
"""

from __future__ import annotations

import io
import sys

import numpy as np

sys.dont_write_bytecode = True
import variant
from faults import FAULTS

sys.path.append(str(variant.SOLVERS))
import mpm_verify

MESSAGES = [3, 1, 4, 2]  # steps of each message
ROUNDING = 1e-9  # of the largest value of a column
SOILS = {"drucker_prager": {"friction": 0.3, "dilation": 0.1, "strength": 1.0},
         "mohr_coulomb": {"friction_angle": 30.0, "dilation_angle": 10.0, "cohesion": 1.0},
         "j2": {"yield": 2.0, "hardening": 50.0}, "newtonian": {"bulk": 500.0, "viscosity": 0.5},
         "linear_fluid": {"bulk": 500.0}}
ROOM = {"free": 1.0, "fixed": 0.0, "roller": 0.0, "periodic": 0.0, "velocity": 0.0, "friction": 0.0}  # cells of the grid beyond a face


class Harness:
    """Takes the place of the channel: answers requests for body forces."""

    def __init__(self):
        self.places, self.values = None, None

    def column(self, value):
        return np.array(value, float)

    def write(self, request):
        x, t = request.get("reference_position", self.places), request["t"]
        if "of" in request and request["of"] != "body_force":  # a load or a wall that depends on time
            self.values = self.message["asked"][request["of"]] * (1 + 50 * t)
            return
        self.values = np.sin(3 * x + 40 * t + np.arange(x.shape[1])) * (2 + x.sum(axis=1, keepdims=True))

    def read(self):
        return {"type": "body_force", "values": self.values.ravel()}


def problem(law, faces, cells, per_axis, force="none", speed=0.0, strain=0.0, turn=0.0, shift=0.0, grade=0.0,
            more=None):
    """A box of some cells, moving and rotating, with an initial deformation and stress; `shift` (cells) in its grid."""
    d, h, density, dt = len(cells), 0.13, 3.0, 0.0013
    conditions = [faces[axis * 2: axis * 2 + 2] for axis in range(d)]
    room = np.array([[ROOM[c] for c in pair] for pair in conditions])
    start, count = np.array([0.7, -0.4, 1.9])[:d], np.array(cells)
    lattice = [start[a] + h * (shift + (np.arange(n * per_axis) + 0.5) / per_axis) for a, n in enumerate(cells)]
    x0 = np.stack(np.meshgrid(*lattice, indexing="ij"), axis=-1).reshape(-1, d)
    n, middle = len(x0), start + 0.5 * h * count
    gradient = strain * (np.triu(np.full((d, d), 0.8), 1) + np.diag(np.arange(1.0, d + 1)))
    is_free = all(c == "free" for c in faces)
    u = (x0 - middle) @ gradient.T if is_free else np.zeros_like(x0)
    f = np.broadcast_to(np.eye(d) + (gradient if is_free else 0), (n, d, d))
    stress = np.broadcast_to(strain * 50.0 * (np.eye(d) + 0.5), (n, d, d))
    gradient = grade * (x0 - middle)[:, :1, None] * np.eye(d)  # of F and stress over the body
    f, stress = f + gradient, stress + 60 * gradient
    spin = turn * (np.tri(d, k=-1) - np.tri(d, k=-1).T)
    velocity = speed * (1 + 0.3 * np.sin(9 * x0)) + (x0 - middle) @ spin.T
    volume = (h / per_axis) ** d
    message = {
        "type": "problem", "suite": "small", "dimension": d,
        "grid": {"origin": (start - h * room[:, 0]).tolist(), "h": h,
                 "cells": (count + room.sum(axis=1)).astype(int).tolist(),
                 "periodic": [pair[0] == "periodic" for pair in conditions]},
        "faces": [{"name": f"{axis}{high}", "axis": axis, "high": bool(high), "condition": conditions[axis][high],
                   "values": {"coefficient": 0.9}, "asked": {"velocity": ["t"]},
                   "at": float(start[axis] + high * h * count[axis])} for axis in range(d) for high in (0, 1)],
        "materials": [{"law": law, "parameters": {"young": 700.0, "poisson": 0.3, **SOILS.get(law, {})},
                       "density": density}],
        "asked": {},
        "bodies": [], "plane": "strain", "contact": None, "loads": [], "body_force": force, "body_force_value": [40.0, -70.0, 20.0][:d],
        "particles_per_cell": per_axis**d, "steps": sum(MESSAGES), "dt": dt, "until": sum(MESSAGES) * dt,
        "instants": np.cumsum(MESSAGES).tolist(),
        "particles": {"reference_position": x0, "position": x0 + u, "velocity": velocity,
                      "mass": np.full(n, density * volume), "reference_volume": np.full(n, volume),
                      "volume": volume * np.linalg.det(f), "deformation_gradient": f, "stress": stress,
                      "body": np.zeros(n)},
    }
    message.update(more or {})
    for key, value in message["particles"].items():
        message["particles"][key] = np.asarray(value).ravel()
    return message


def two_bodies(message):
    """Two bodies that touch: the part of the box at low y and the part at high y, which moves down and along."""
    particles = message["particles"]
    height = particles["reference_position"][1::2]
    particles["body"] = (height > height.mean()).astype(float)
    particles["velocity"] = np.outer(particles["body"], [9.0, -3.0]).ravel()
    material = message["materials"][0]
    second = {**material, "parameters": {**material["parameters"], "young": 1900.0}, "density": 5.0}
    particles["mass"] = np.where(particles["body"] > 0, 5.0 / 3.0, 1.0) * particles["mass"]
    return {**message, "materials": [material, second], "contact": {"law": "coulomb", "coefficient": 0.3}}


def alternating(message):
    """Velocities that alternate from cell to cell along both axes."""
    cells = (message["particles"]["reference_position"].reshape(-1, 2) - message["grid"]["origin"]) / message["grid"]["h"]
    message["particles"]["velocity"] = np.stack([np.cos(np.pi * cells).prod(axis=1), 0 * cells[:, 0]], axis=1).ravel()
    return message


def supports(capabilities, message):
    """Whether the client claims all that a problem needs."""
    needs = [("conditions", {face["condition"] for face in message["faces"]}), ("dimensions", {message["dimension"]}),
             ("laws", {material["law"] for material in message["materials"]}),
             ("loads", {load["load"] for load in message["loads"]})]
    return (all(wanted <= set(capabilities[key]) for key, wanted in needs)
            and (len(message["materials"]) == 1 or capabilities.get("contact", False))
            and (message["plane"] == "strain" or capabilities.get("plane_stress", False))
            and ("load_steps" in message) == capabilities.get("load_steps", False))


FREE, PERIODIC = ["free"] * 6, ["periodic"] * 6
PROBLEMS = {
    "walls at low ends": problem("linear_elastic", ["fixed", "free", "roller", "free"], (4, 5), 2, "constant", -3.0),
    "walls at high ends": problem("linear_elastic", ["free", "roller", "free", "fixed"], (5, 4), 2, "asked", 4.0),
    "between walls": problem("neo_hookean", ["fixed"] * 4, (6, 4), 3, "constant", 8.0),
    "rotating and strained": problem("neo_hookean", FREE[:4], (4, 5), 3, "none", 0.5, -0.05, 12.0),
    "rotating and stressed": problem("linear_elastic", FREE[:4], (3, 4), 2, "none", 0.5, -0.1, 15.0),
    "periodic": problem("neo_hookean", PERIODIC[:4], (5, 4), 2, "asked", 18.0),
    "rotating cone of soil": problem("drucker_prager", FREE[:4], (4, 5), 2, "none", 3.0, turn=12.0),
    "rotating pyramid of soil": problem("mohr_coulomb", FREE[:4], (4, 5), 2, "none", 3.0, turn=12.0),
    "block of the Hencky law": problem("hencky", FREE[:4], (4, 3), 2, "none", 0.5, -0.05, 5.0),
    "graded": problem("linear_elastic", FREE[:4], (4, 5), 2, "none", 0.5, grade=0.1),
    "graded hyperelastic": problem("neo_hookean", FREE[:4], (4, 5), 2, "none", 0.5, grade=0.1),
    "soil without dilation": problem("drucker_prager", FREE[:4], (4, 5), 2, "none", 3.0, turn=12.0,
                                     more={"materials": [{"law": "drucker_prager", "density": 3.0, "parameters": {
                                         "young": 700.0, "poisson": 0.3, "friction": 0.3, "dilation": 0.0, "strength": 1e-4}}]}),
    "pyramid without dilation": problem(
        "mohr_coulomb", FREE[:4], (4, 5), 2, "none", 3.0, turn=12.0,
        more={"materials": [{"law": "mohr_coulomb", "density": 3.0, "parameters": {
            "young": 700.0, "poisson": 0.3, "friction_angle": 30.0, "dilation_angle": 0.0, "cohesion": 1e-4}}]}),
    "yielding metal": problem("j2", FREE[:4], (4, 5), 2, "none", 3.0, turn=12.0),
    "viscous fluid": problem("newtonian", FREE[:4], (4, 5), 2, "none", 3.0),
    "acoustic fluid": problem("linear_fluid", FREE[:4], (4, 5), 2, "none", 3.0),
    "plate": problem("linear_elastic", FREE[:4], (4, 5), 2, "none", 3.0, more={"plane": "stress"}),
    "load steps": problem("hencky", ["fixed", "free"], (6,), 2, "constant", more={
        "load_steps": 10, "bodies": [{"shape": "box", "from": [0.7], "to": [0.7 + 6 * 0.13]}]}),
    "falling": problem("linear_elastic", FREE[:4], (4, 3), 2, "constant", 1.0),
    "bar": problem("linear_elastic", ["fixed", "free"], (6,), 2, "asked", -5.0),
    "block": problem("linear_elastic", FREE, (2, 3, 2), 2, "none", 0.5, -0.05, 5.0),
    # Particles reach beyond a face by a distance that leaves a node nearly without mass.
    "bar next to faces": problem("neo_hookean", FREE[:2], (6,), 2, "none", 3.0, shift=0.25 + 1e-13),
    "pulled": problem("linear_elastic", FREE[:4], (4, 3), 2, more={
        "loads": [{"load": "traction", "face": "01", "values": {}, "asked": {"traction": ["t"]}}],
        "asked": {"load:0": np.array([3.0, -2.0])}}),
    "damped": problem("linear_elastic", FREE[:4], (4, 3), 2, speed=2.0, more={
        "loads": [{"load": "damping", "values": {}, "asked": {"rate": ["t"]}}], "asked": {"load:0": np.array([9.0])}}),
    "locally damped": problem("linear_elastic", FREE[:4], (4, 3), 2, "constant", -2.0, more={
        "loads": [{"load": "local_damping", "values": {"share": 0.4}, "asked": {}}]}),
    "driven": problem("linear_elastic", ["velocity", "free", "free", "free"], (4, 3), 2, more={
        "asked": {"face:00": np.array([3.0, -2.0])}}),
    "rubbed": problem("linear_elastic", ["free", "free", "friction", "free"], (4, 3), 2, "constant", 0.02),
    "colliding": two_bodies(problem("linear_elastic", FREE[:4], (4, 4), 2)),
    "alternating": alternating(problem("neo_hookean", FREE[:4], (4, 4), 2)),
    "fast bar": problem("neo_hookean", PERIODIC[:2], (6,), 3, "constant", 30.0),
}


def solver(client, fault, options, points=""):
    """A solver as its main program makes it."""
    module, name, program = variant.load(client, fault)
    if points:
        module.__dict__[name] = type(name, (variant.POINTS[points], module.__dict__[name]), {})
    made = []
    module.__dict__["serve"] = made.append
    sys.argv[1:] = options.split()
    exec(program, module.__dict__)
    return made[0], module.Problem


def answers(client, fault, options, points, message):
    """The states after each message, or the error of the solver."""
    harness = Harness()
    try:
        subject, kind = solver(client, fault, options, points)
        if not supports(subject.capabilities, message):
            return None
        harness.message = message
        made = kind(message, harness)
        named = subject.setup(made)
        harness.places = named["reference_position"] if named else made.reference_position
        states, taken = [], 0
        for steps in MESSAGES:
            subject.advance(steps, message["dt"], taken * message["dt"])
            taken += steps
            states.append({key: np.array(value, float) for key, value in subject.state().items()
                           if isinstance(value, np.ndarray)})
        return [*states, {"weight": np.array(named["weight"])}] if named else states
    except (ArithmeticError, ValueError, IndexError) as error:
        return str(error)


def differ(a, b):
    """Whether two lists of states differ beyond rounding."""
    if isinstance(a, str) or isinstance(b, str):
        return a != b
    return any(x[key].shape != y[key].shape or not np.abs(x[key] - y[key]).max() <= ROUNDING * np.abs(x[key]).max()
               for x, y in zip(a, b) for key in x)


def effects():
    """The problems whose answers each fault changes."""
    sound, changed = {}, {}
    for name, fault in FAULTS.items():
        changed[name] = []
        for label, message in PROBLEMS.items():
            key = (fault.client, fault.settings, fault.points, label)
            if key not in sound:
                sound[key] = answers(fault.client, None, fault.settings, fault.points, message)
                assert not isinstance(sound[key], str), (key, sound[key])
            if sound[key] is not None:
                faulty = answers(fault.client, fault, fault.settings, fault.points, message)
                if differ(sound[key], faulty):
                    changed[name].append(label)
    return changed


def test_forces_at_other_points_have_a_hint():
    """A client of protocol 1 that names points, and asks for forces without `places`."""
    sent = []

    class Channel:
        def __init__(self):
            self.requests = iter([{"type": "advance"}, {"type": "bye"}])

        def read(self):
            return next(self.requests)

        def write(self, message):
            sent.append(message)

    class Session:
        has_points = True

        def __init__(self, *_):
            pass

        def answer(self, _):
            return np.ones((3, 1)) + np.ones((4, 2))

    kept = mpm_verify.Channel, mpm_verify.Session, sys.stderr
    mpm_verify.Channel, mpm_verify.Session, sys.stderr = Channel, Session, io.StringIO()
    try:
        mpm_verify.serve(None)
    finally:
        mpm_verify.Channel, mpm_verify.Session, sys.stderr = kept
    assert "broadcast" in sent[0]["reason"] and "`places=problem.reference_position`" in sent[0]["reason"], sent


def test_every_fault_changes_an_answer():
    assert not [name for name, problems in effects().items() if not problems]


def test_points_in_another_order_have_the_same_answers():
    for label, message in PROBLEMS.items():
        plain = answers("numpy", None, "", "", message)
        if plain is None:  # not supported
            continue
        order = np.random.default_rng(39).permutation(len(plain[0]["displacement"]))
        for points, expected in (("particles", slice(None)), ("shuffled", order)):
            states = answers("numpy", None, "", points, message)
            assert not differ([{key: value[expected] for key, value in state.items()} for state in plain], states), label


if __name__ == "__main__":
    np.seterr(all="ignore")
    changed_problems = effects()
    for name, problems in changed_problems.items():
        print(f"{name:40} {', '.join(problems) or 'NO EFFECT'}")
    test_points_in_another_order_have_the_same_answers()
    test_forces_at_other_points_have_a_hint()
    sys.exit(not all(changed_problems.values()))
