"""Version 2 of the solver protocol of `mpm-verify` for a solver in Python: see docs/protocol.md.

An adapter is a class with the attributes and methods of `Solver`, and one call:

    serve(MySolver())

Everything that the solver prints goes to standard error, so that it cannot mix with the messages.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from dataclasses import dataclass, field
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Message = dict[str, Any]

PROTOCOL = 2


class Cannot(Exception):
    """A problem that the solver does not support: raised by `Solver.setup` with the reason."""


class NoValues(Exception):
    """Values that the problem does not define, with the reason given by the harness."""


class Solver(Protocol):
    """The interface of an adapter."""

    name: str  # letters, digits, `-`, `_` and `.`
    version: str
    capabilities: Message  # abilities that are not named are lacking
    # Optional: `formal_order`, the order in h of the displacements if it is not 2;
    # `precision`, `"single"` for a solver that computes in single precision;
    # `differentiate(of, with_respect_to, steps, dt)` for the capability `gradients`.

    def setup(self, problem: Problem) -> Message | None:
        """Takes the initial state. Returns the `points` at which states will be given, with their
        `reference_position` and `weight`, or None if states are given at the particles."""

    def advance(self, steps: int, dt: float, time: float) -> None:
        """Takes `steps` steps of length `dt` (s), starting at `time` (s)."""

    def state(self) -> Message:
        """The present state: arrays `displacement` (m) and `velocity` (m/s); optional arrays
        `stress` (Pa), `deformation_gradient` and `temperature`; optional numbers `crossings`,
        `left_domain` and `min_j`."""


class Differentiable(Protocol):
    """A solver with the capability `gradients`, a list of names of parameters."""

    def differentiate(self, of: Message, with_respect_to: list[str], steps: int, dt: float
                      ) -> tuple[float, list[float]]:
        """The functional `of` after `steps` steps of length `dt` (s) from t = 0, and its
        derivatives with respect to the parameters, in their order. Called after `setup`, in place
        of `advance`. Raises `Cannot` if the solver does not have this derivative."""


@dataclass
class Problem:
    """The initial state of one level of refinement, in m, s and kg.

    Methods that take `places` expect reference positions (n by dimension, m) in the body. Without
    `places` they return values at the particles; after `setup` has returned points of its own, at
    these points."""

    message: Message  # the message `problem`
    channel: Channel
    points: Array | None = field(default=None, init=False)  # the solver's own points

    def __post_init__(self) -> None:
        grid, d = self.message["grid"], self.message["dimension"]
        self.dimension: int = d
        self.origin: Array = np.array(grid["origin"], float)
        self.h: float = grid["h"]
        self.cells: list[int] = grid["cells"]
        self.periodic: list[bool] = grid["periodic"]
        self.faces: list[Message] = self.message["faces"]
        self.materials: list[Message] = self.message["materials"]
        self.bodies: list[Message] = self.message["bodies"]  # shapes
        self.loads: list[Message] = self.message["loads"]
        self.plane: str = self.message["plane"]  # strain, stress or axisymmetric
        self.contact: Message | None = self.message["contact"]
        self.dt: float = self.message["dt"]
        particles = {k: self.channel.column(v) for k, v in self.message["particles"].items()}
        n = len(particles["mass"])
        self.reference_position: Array = particles["reference_position"].reshape(-1, d)
        self.position: Array = particles["position"].reshape(-1, d)
        self.velocity: Array = particles["velocity"].reshape(-1, d)
        self.mass: Array = particles["mass"]
        self.reference_volume: Array = particles["reference_volume"]
        self.volume: Array = particles["volume"]
        self.deformation_gradient: Array = particles["deformation_gradient"].reshape(-1, d, d)
        self.stress: Array = particles["stress"].reshape(-1, d, d)
        self.body: NDArray[np.int64] = particles["body"].astype(int)
        none = np.zeros(n * d * d)
        self.reference_stress: Array = particles.get("initial_stress", none).reshape(-1, d, d)
        self.constant_force = self.channel.column(self.message.get("body_force_value", []))

    def values(self, of: str, t: float | None = None, places: Array | None = None, *,
               body: int | None = None, displacement: Array | None = None) -> Array:
        """Values of a field, one after the other, as the harness gives them: `of` is `body_force`,
        `displacement`, `velocity`, `deformation_gradient`, `stress`, `initial_stress`,
        `initial_stress_across`, `load:INDEX` or `face:NAME`. Raises `NoValues` if the problem does not define them."""
        request: Message = {"type": "values", "of": of}
        if t is not None:
            request["t"] = float(t)
        for key, column in (("reference_position", places), ("displacement", displacement)):
            if column is not None:
                request[key] = np.asarray(column, float)
        if body is not None:
            request["body"] = int(body)
        self.channel.write(request)
        answer = self.channel.read()
        if "error" in answer:
            raise NoValues(f"values of {of}: {answer['error']}")
        return self.channel.column(answer["values"])

    def body_force(self, t: float, places: Array | None = None, *, body: int | None = None,
                   displacement: Array | None = None) -> Array:
        """Force per unit of mass (n by dimension, m/s2) at time `t` (s). The harness is asked
        unless the force is zero or constant."""
        shape = self._places(places).shape
        if self.message["body_force"] == "none":
            return np.zeros(shape)
        if self.message["body_force"] == "constant":
            return np.broadcast_to(self.constant_force, shape)
        values = self.values("body_force", t, places, body=body, displacement=displacement)
        return self._shaped(values, shape)

    def initial_displacement(self, places: Array | None = None, body: int | None = None) -> Array:
        """Displacement at t = 0 (n by dimension, m)."""
        return self._initial("displacement", 1, places, body)

    def initial_velocity(self, places: Array | None = None, body: int | None = None) -> Array:
        """Velocity at t = 0 (n by dimension, m/s)."""
        return self._initial("velocity", 1, places, body)

    def initial_deformation_gradient(self, places: Array | None = None,
                                     body: int | None = None) -> Array:
        """Deformation gradient F at t = 0 (n by dimension by dimension)."""
        return self._initial("deformation_gradient", 2, places, body)

    def initial_stress(self, places: Array | None = None, body: int | None = None) -> Array:
        """Cauchy stress at t = 0 (n by dimension by dimension, Pa)."""
        return self._initial("stress", 2, places, body)

    def stress_of_reference(self, places: Array | None = None, body: int | None = None) -> Array:
        """Stress S0 of the reference configuration (n by dimension by dimension, Pa)."""
        return self._initial("initial_stress", 2, places, body)

    def load(self, index: int, t: float, places: Array | None = None, *,
             displacement: Array | None = None) -> Array:
        """Value of `loads[index]` at time `t` (s): a row for each place, or one row for a load that
        is the same at all places; a number instead of a row for damping and pressure."""
        load = self.loads[index]
        return self._quantity(load, f"load:{index}", t, places, displacement)

    def face_velocity(self, face: Message, t: float, places: Array) -> Array:
        """Velocity (n by dimension, m/s) of a face with the condition `velocity` at time `t` (s),
        at places on the face."""
        return self._quantity(face, f"face:{face['name']}", t, places, None)

    def _quantity(self, owner: Message, of: str, t: float, places: Array | None,
                  displacement: Array | None) -> Array:
        constants = [v for k, v in owner["values"].items() if k != "volume"]
        is_scalar = any(key in ("rate", "pressure") for key in (*owner["values"], *owner["asked"]))
        width = () if is_scalar else (self.dimension,)
        count = 1 if places is None else len(places)
        if not owner["asked"]:
            return np.broadcast_to(np.asarray(constants[0], float), (count, *width))
        # Where the quantity is the same at all places, one value is enough.
        [depends] = owner["asked"].values()
        if depends == ["t"]:
            return np.broadcast_to(self.values(of, t).reshape(width), (count, *width))
        values = self.values(of, t, places, displacement=displacement)
        shape = (len(self._places(places)), *width)
        return self._shaped(values, shape)

    def _initial(self, of: str, rank: int, places: Array | None, body: int | None) -> Array:
        values = self.values(of, None, places, body=body)
        return self._shaped(values, (len(self._places(places)), *rank * (self.dimension,)))

    def _places(self, places: Array | None) -> Array:
        if places is None:
            return self.reference_position if self.points is None else self.points
        places = np.asarray(places, float)
        if places.ndim != 2 or places.shape[1] != self.dimension:
            raise ValueError(f"places have the shape {places.shape}, expected (n, {self.dimension})")
        return places

    @staticmethod
    def _shaped(values: Array, shape: tuple[int, ...]) -> Array:
        if values.size != np.prod(shape, dtype=int):
            raise ValueError(f"the harness gave {values.size} values, expected the shape {shape}")
        return values.reshape(shape)


class Channel:
    """Messages to and from the harness: a line of JSON, followed by the bytes of its columns."""

    def __init__(self) -> None:
        sys.stdout.flush()
        self.input = sys.stdin.buffer
        self.output = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)  # output of compiled code goes to standard error too
        sys.stdout = sys.stderr
        self.block = b""

    def read(self) -> Message:
        """The next message; the program ends if there is none."""
        line = self.input.readline()
        if not line:
            sys.exit("the harness has closed the connection")
        message: Message = json.loads(line)
        self.block = self.input.read(message.get("bytes", 0))
        return message

    def column(self, value: Any) -> Array:
        """A column of the message that was read last: numbers, or the position of their bytes."""
        if isinstance(value, dict):
            offset, count = value["f64"]
            return np.frombuffer(self.block, "<f8", count, offset).copy()
        return np.array(value, float)

    def write(self, message: Message) -> None:
        """Sends a message; its arrays are sent as bytes."""
        block = bytearray()

        def pack(value: Any) -> Any:
            if isinstance(value, dict):
                return {key: pack(inner) for key, inner in value.items()}
            if not isinstance(value, np.ndarray):
                return value.item() if isinstance(value, np.generic) else value
            block.extend(value.astype("<f8").tobytes())
            return {"f64": [len(block) - 8 * value.size, value.size]}

        packed = pack(message)
        if block:
            packed["bytes"] = len(block)
        line = json.dumps(packed, allow_nan=False).encode() + b"\n"
        self.output.write(line + block)
        self.output.flush()


COUNTERS = ("crossings", "left_domain", "min_j")


@dataclass
class Session:
    """A conversation with the harness."""

    solver: Solver
    channel: Channel
    has_points: bool = False  # whether states are given at points of the solver

    def answer(self, request: Message) -> Message:
        """The answer of the solver to a request."""
        solver = self.solver
        if request["type"] == "hello":
            order = getattr(solver, "formal_order", 2)
            precision = getattr(solver, "precision", "double")
            capabilities = {**solver.capabilities, "binary": True}
            return {"type": "hello", "protocol": PROTOCOL, "name": solver.name,
                    "version": solver.version, "formal_order": order, "precision": precision,
                    "capabilities": capabilities}
        if request["type"] == "problem":
            problem = Problem(request, self.channel)
            points = solver.setup(problem)
            self.has_points = points is not None
            if points is None:
                return {"type": "ready"}
            points = {key: np.asarray(value, float) for key, value in points.items()}
            problem.points = points["reference_position"].reshape(-1, problem.dimension)
            return {"type": "ready", "points": points}
        if request["type"] == "advance":
            solver.advance(request["steps"], request["dt"], request["from"])
            state = solver.state()
            columns = {k: np.asarray(v, float) for k, v in state.items() if k not in COUNTERS}
            counters = {k: v for k, v in state.items() if k in COUNTERS}
            return {"type": "state", "columns": columns, **counters}
        if request["type"] == "differentiate":
            value, gradient = cast(Differentiable, solver).differentiate(
                request["of"], request["with_respect_to"], request["steps"], request["dt"])
            named = zip(["value", *request["with_respect_to"]], [value, *gradient])
            for name, number in named:
                if not np.isfinite(number):
                    raise ArithmeticError(f"the derivative with respect to {name} is {number}"
                                          if name != "value" else f"the value is {number}")
            return {"type": "gradient", "value": float(value),
                    "gradient": [float(entry) for entry in gradient]}
        raise ValueError(f"the request {request['type']} is not part of protocol {PROTOCOL}")


def serve(solver: Solver) -> None:
    """Answers the harness until it ends the conversation. An exception of the solver fails the
    level: the harness receives one line, and the traceback goes to standard error."""
    channel = Channel()
    session = Session(solver, channel)
    while (request := channel.read())["type"] != "bye":
        try:
            channel.write(session.answer(request))
        except Cannot as reason:
            channel.write({"type": "cannot", "reason": str(reason)})
        except Exception as error:
            traceback.print_exc()
            line = " ".join(f"{type(error).__name__}: {error}".split())
            if "broadcast" in line and session.has_points:
                line += (" (`setup` has returned points: without `places`, values are given at these"
                         " points; pass `places=problem.reference_position` for the particles)")
            channel.write({"type": "failed", "reason": line})
