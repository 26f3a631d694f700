"""The protocol of `mpm-verify` for a solver in Python: see docs/protocol.md.

An adapter is a class with three attributes and three methods, those of `Solver`, and one call:

    serve(MySolver())

Whatever the solver prints goes to standard error, so that it cannot get between the messages.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Message = dict[str, Any]

PROTOCOL = 1


class Cannot(Exception):
    """A problem that the solver was not made for: raised by `Solver.setup` with the reason."""


class Solver(Protocol):
    """A solver as the harness sees it."""

    name: str  # letters, digits, `-`, `_` and `.`
    version: str
    capabilities: Message  # what is not named is lacking
    # `formal_order`, if the order in h that theory gives the displacements is not 2;
    # `precision`, `"single"` if that is what it computes in.

    def setup(self, problem: Problem) -> Message | None:
        """Takes the initial state. Returns the `points` at which states will be given, with their
        `reference_position` and `weight`, or None if they are given at the particles."""

    def advance(self, steps: int, dt: float, time: float) -> None:
        """Takes `steps` steps of length `dt` (s), the first from `time` (s) on."""

    def state(self) -> Message:
        """The state now: arrays `displacement` (m) and `velocity` (m/s); if known, `stress` (Pa),
        `deformation_gradient` and `temperature`; numbers `crossings`, `left_domain`, `min_j`."""


@dataclass
class Problem:
    """The initial state of one level of refinement, in m, s and kg."""

    message: Message  # as it came
    channel: Channel

    def __post_init__(self) -> None:
        grid, d = self.message["grid"], self.message["dimension"]
        self.dimension: int = d
        self.origin: Array = np.array(grid["origin"], float)
        self.h: float = grid["h"]
        self.cells: list[int] = grid["cells"]
        self.periodic: list[bool] = grid["periodic"]
        self.faces: list[Message] = self.message["faces"]
        self.materials: list[Message] = self.message["materials"]
        self.dt: float = self.message["dt"]
        particles = {k: self.channel.column(v) for k, v in self.message["particles"].items()}
        self.reference_position: Array = particles["reference_position"].reshape(-1, d)
        self.position: Array = particles["position"].reshape(-1, d)
        self.velocity: Array = particles["velocity"].reshape(-1, d)
        self.mass: Array = particles["mass"]
        self.volume: Array = particles["volume"]
        self.deformation_gradient: Array = particles["deformation_gradient"].reshape(-1, d, d)
        self.stress: Array = particles["stress"].reshape(-1, d, d)
        self.body: NDArray[np.int64] = particles["body"].astype(int)
        self.constant_force = self.channel.column(self.message.get("body_force_value", []))

    def body_force(self, t: float, places: Array | None = None) -> Array:
        """Force per unit of mass (m/s2) at time `t` (s) at the particles, or at these reference
        positions (n by dimension, m). The harness is asked if no constant says it."""
        shape = self.reference_position.shape if places is None else places.shape
        if self.message["body_force"] == "none":
            return np.zeros(shape)
        if self.message["body_force"] == "constant":
            return np.broadcast_to(self.constant_force, shape)
        request = {"type": "body_force", "t": float(t)}
        self.channel.write(request if places is None else {**request, "reference_position": places})
        return self.channel.column(self.channel.read()["values"]).reshape(shape)


class Channel:
    """Messages to and from the harness: a line of JSON, and the bytes of its columns behind it."""

    def __init__(self) -> None:
        sys.stdout.flush()
        self.input = sys.stdin.buffer
        self.output = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)  # what compiled code prints goes to standard error too
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
        """A column of the message read last: numbers, or the place of their bytes."""
        if isinstance(value, dict):
            offset, count = value["f64"]
            return np.frombuffer(self.block, "<f8", count, offset).copy()
        return np.array(value, float)

    def write(self, message: Message) -> None:
        """Sends a message; arrays in it go as bytes."""
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


def answer(solver: Solver, request: Message, channel: Channel) -> Message:
    """The answer of `solver` to a request."""
    if request["type"] == "hello":
        order = getattr(solver, "formal_order", 2)
        precision = getattr(solver, "precision", "double")
        capabilities = {**solver.capabilities, "binary": True}
        return {"type": "hello", "protocol": PROTOCOL, "name": solver.name,
                "version": solver.version, "formal_order": order, "precision": precision,
                "capabilities": capabilities}
    if request["type"] == "problem":
        points = solver.setup(Problem(request, channel))
        return {"type": "ready"} if points is None else {"type": "ready", "points": points}
    if request["type"] == "advance":
        solver.advance(request["steps"], request["dt"], request["from"])
        state = solver.state()
        columns = {k: np.asarray(v, float) for k, v in state.items() if k not in COUNTERS}
        counters = {k: v for k, v in state.items() if k in COUNTERS}
        return {"type": "state", "columns": columns, **counters}
    raise ValueError(f"the request {request['type']} is not part of protocol {PROTOCOL}")


def serve(solver: Solver) -> None:
    """Answers the harness until it says goodbye. An error of the solver ends a run, and the
    harness is told: in one line, with the traceback on standard error."""
    channel = Channel()
    while (request := channel.read())["type"] != "bye":
        try:
            channel.write(answer(solver, request, channel))
        except Cannot as reason:
            channel.write({"type": "cannot", "reason": str(reason)})
        except Exception as error:
            traceback.print_exc()
            line = " ".join(f"{type(error).__name__}: {error}".split())
            channel.write({"type": "failed", "reason": line})
