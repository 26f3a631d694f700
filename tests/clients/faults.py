"""Faults of MPM clients: mistakes that authors of solvers make, each as a change to a sound Python client.

`variant.py` runs a client with a fault, and `ci/doctor` measures which faults `mpm-verify doctor` and `run --gate`
detect. A fault changes the answers, beyond rounding, to some problem that the client claims to support.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Fault:
    """A mistake, in one or more settings of the client."""

    name: str
    description: str  # what the author did wrong
    cause: str  # the diagnosis that its author would accept
    settings: str | list[str] = ""  # options of the client; a list makes variants NAME, NAME-2, NAME-3
    edits: dict[str, str] = field(default_factory=dict)  # old text -> new text in the sources of the client
    patch: str = ""  # methods of a subclass of the client
    source: str = "invented"
    client: str = "numpy"
    points: str = ""  # the option `--points` of variant.py
    expected: frozenset[str] = frozenset()  # names of the finding that `doctor` is expected to report: EXPECTED
    also: frozenset[str] = frozenset()  # acceptable names of further defects
    half: frozenset[str] = frozenset()  # names that give the direction, but not the cause: HALF

    def command(self) -> list[str]:
        """Arguments of `variant.py`."""
        points = ["--points", self.points] if self.points else []
        return ["--client", self.client, "--fault", self.name, *points, *self.settings.split()]


# Abbreviations of settings.
LINEAR, QUADRATIC, CUBIC = "--basis linear", "--basis quadratic_bspline", "--basis cubic_bspline"
USL, MUSL, HALF_BACK = "--scheme usl", "--scheme musl", "--start half_step_back"
MOVE = "self.x += dt * self.gather(velocity)"
ON_FACES = "(np.abs(self.s - np.rint(self.s)) < 1e-9)"
FORCE = "self.problem.body_force(time)"
END = '(-1 if face["high"] else 0,)'
MASS = "self.m, self.vol = problem.mass, problem.volume.copy()"
MU = "self.mu = young / (2 * (1 + poisson))"
LAMBDA = "self.lam = young * poisson / ((1 + poisson) * (1 - 2 * poisson))"
STATE = "self.f, self.sigma = problem.deformation_gradient.copy(), problem.stress.copy()"
# Calls a method without setting the held components of nodal fields to zero.
UNHELD = """
    def unheld(self, method, *arguments):
        free, self.free = self.free, np.ones_like(self.free)
        field = method(*arguments)
        self.free = free
        return field
"""

POSITIONS = [
    Fault("position-from-mean-velocity",
          "Moves a particle by the mean of its old velocity and the new grid velocity.",
          "particles do not move with the grid velocity at their position",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}", f"{CUBIC} {MUSL} {HALF_BACK}"],
          {"self.weigh()": "self.weigh(); old = self.v.copy()",
           MOVE: "self.x += 0.5 * dt * (old + self.gather(velocity))"},
          source="B1: geomechanics/mpm #42"),
    Fault("position-from-particle-velocity",
          "Moves a particle with its own FLIP velocity instead of the grid velocity.",
          "particles do not move with the grid velocity at their position",
          [f"{QUADRATIC} {USL}", f"{LINEAR} {MUSL} {HALF_BACK}"],
          {MOVE: "self.x += dt * self.v"},
          source="B1: geomechanics/mpm #42, variant"),
    Fault("position-from-old-grid-velocity",
          "Moves particles with the grid velocity of the beginning of the step: explicit Euler for positions.",
          "positions use the grid velocity before the forces are applied",
          f"{QUADRATIC} {USL}",
          {"self.weigh()": "self.weigh(); old = self.velocity()", MOVE: "self.x += dt * self.gather(old)"}),
    Fault("position-from-old-grid-velocity-of-leapfrog",
          "Moves particles with the velocity of the beginning of the step, in a leapfrog scheme.",
          "positions use the grid velocity before the forces are applied",
          f"{QUADRATIC} {USL} {HALF_BACK}",
          {"self.weigh()": "self.weigh(); old = self.velocity()", MOVE: "self.x += dt * self.gather(old)"},
          source="M6, relative"),
    Fault("position-with-a-quarter-of-the-acceleration",
          "Adds a second half of the acceleration to the mean of the old and the new velocity.",
          "positions contain the acceleration with a wrong factor",
          f"{QUADRATIC} {USL}",
          {"self.weigh()": "self.weigh(); old = self.v.copy()",
           MOVE: "self.x += dt * (1.5 * self.gather(velocity) - 0.5 * old)"},
          source="M6, relative"),
    Fault("step-cut-at-the-end",
          "Cuts the last step of a run to 0.7 dt for positions, because it compares times without a tolerance.",
          "the last step of positions is shorter than dt",
          [f"{QUADRATIC} {USL}", f"{LINEAR} {MUSL} {HALF_BACK}"],
          {MOVE: "self.x += self.share(dt, time) * dt * self.gather(velocity)"},
          patch="""
              def share(self, dt, time):
                  return 0.7 if time + 1.5 * dt > self.problem.message["until"] else 1.0
          """, source="M3"),
    Fault("step-cut-at-the-start",
          "Takes a first step of half the length for positions, as a soft start does.",
          "the first step of positions is shorter than dt",
          f"{QUADRATIC} {USL}",
          {MOVE: "self.x += (0.5 if time < 0.5 * dt else 1.0) * dt * self.gather(velocity)"},
          source="M3, relative"),
    Fault("step-cut-now-and-then",
          "Takes a shorter step every eighth step for positions, to reach the time of an output file.",
          "some steps of positions are shorter than dt",
          f"{LINEAR} {USL}",
          {MOVE: "self.x += (0.4 if round(time / dt) % 8 == 5 else 1.0) * dt * self.gather(velocity)"},
          source="M3, relative"),
    Fault("position-nudged-off-faces",
          "Moves a particle that lies exactly on a cell face by a further v dt/1000.",
          "positions on cell faces are changed",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {MOVE: f"self.x += {ON_FACES} * 1e-3 * dt * self.v; {MOVE}"},
          source="M8"),
    Fault("position-pushed-off-faces",
          "Keeps particles a distance of 1e-5 h away from the low face of their cell.",
          "positions on cell faces are changed",
          f"{QUADRATIC} {USL}",
          {MOVE: f"self.x += {ON_FACES} * 1e-5 * self.problem.h; {MOVE}"},
          source="M8, relative"),
    Fault("position-left-on-faces",
          "Moves a particle that lies on a cell face by 0.99 v dt only.",
          "positions on cell faces are changed",
          f"{LINEAR} {USL}",
          {MOVE: f"self.x -= {ON_FACES} * 1e-2 * dt * self.v; {MOVE}"},
          source="M8, relative"),
    Fault("position-25-percent-short",
          "Multiplies the step of the positions by 0.75.",
          "displacements are three quarters of what the velocity gives",
          [f"{LINEAR} {USL} {HALF_BACK}", f"{QUADRATIC} {MUSL}"],
          {MOVE: "self.x += 0.75 * dt * self.gather(velocity)"},
          source="B8: fall stops at its first remark"),
    Fault("position-updated-twice",
          "Updates the positions in the loop over particles and again in the loop that finds their cells.",
          "positions are updated twice per step",
          f"{LINEAR} {MUSL}",
          {MOVE: f"{MOVE}; self.x += dt * self.gather(velocity)"}),
    Fault("position-half-a-step-ahead",
          "Returns x + v dt/2, a position half a step after the time asked for.",
          "displacements belong to a time half a step later",
          [f"{LINEAR} {MUSL} {HALF_BACK}", f"{CUBIC} {USL}"],
          patch="""
              def step(self, dt, time):
                  super().step(dt, time)
                  self.dt = dt

              def state(self):
                  state = super().state()
                  return {**state, "displacement": state["displacement"] + 0.5 * self.dt * self.v}
          """),
    Fault("position-clamped-near-grid-ends",
          "Keeps positions at least one cell away from the ends of the grid, also at walls.",
          "particles cannot enter the first and the last cell",
          f"{LINEAR} {MUSL}",
          {MOVE: f"{MOVE}; edge = np.where(self.problem.periodic, -np.inf, self.problem.h); "
                 "low = self.problem.origin; high = low + self.problem.h * np.array(self.problem.cells); "
                 "self.x = np.clip(self.x, low + edge, high - edge)"}),
    Fault("velocity-clamped",
          "Limits each component of the grid velocity to 1 m/s, for stability.",
          "velocities are limited by an absolute number",
          f"{QUADRATIC} {USL}",
          {"velocity = self.velocity() + dt * acceleration":
           "velocity = np.clip(self.velocity() + dt * acceleration, -1, 1)"}),
    Fault("displacement-wrapped",
          "Wraps positions into the periodic domain and returns differences of wrapped positions.",
          "displacements jump by a period when a particle crosses the periodic face",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def locate(self):
                  lengths = self.problem.h * np.array(self.problem.cells)
                  turns = np.floor((self.x - self.problem.origin) / lengths)
                  self.x = self.x - np.where(self.problem.periodic, turns * lengths, 0)
                  super().locate()
          """),
]

LOADS = [
    Fault("gravity-after-walls",
          "Adds body forces to the grid acceleration after the wall nodes were set to zero.",
          "body forces act on nodes that a wall holds",
          [f"{LINEAR} {USL}", f"{QUADRATIC} {USL} {HALF_BACK}", f"{LINEAR} {MUSL}"],
          patch=UNHELD + """
    def acceleration(self, time, *more):
        force = self.m[:, None] * self.problem.body_force(time)
        field = self.unheld(self.per_mass, self.n[..., None] * force[:, None])
        return super().acceleration(time, *more) + (1 - self.free) * field
          """, source="B2: taichi_elements PR #115"),
    Fault("gravity-sign",
          "Subtracts body forces.",
          "body forces have the opposite sign",
          f"{LINEAR} {MUSL}", {FORCE: f"-{FORCE}"}),
    Fault("gravity-twice",
          "Adds gravity to the nodal forces and again to the particle velocities.",
          "body forces act twice",
          [f"{QUADRATIC} {USL} {HALF_BACK}", f"{LINEAR} {MUSL}"], {FORCE: f"2 * {FORCE}"}),
    Fault("gravity-half",
          "Keeps the factor one half of a leapfrog kick in every step.",
          "body forces are halved",
          f"{LINEAR} {USL}", {FORCE: f"0.5 * {FORCE}"}),
    Fault("gravity-axes-exchanged",
          "Reads the components of body forces in reverse order.",
          "components of body forces are exchanged",
          f"{LINEAR} {MUSL}", {FORCE: f"{FORCE}[:, ::-1]"}),
    Fault("gravity-last-axis-only",
          "Uses the last component of the body force only.",
          "body forces act along the last axis only",
          f"{QUADRATIC} {MUSL}",
          {FORCE: f"({FORCE} * (np.arange(self.d) == self.d - 1))"}),
    Fault("gravity-ramped",
          "Increases body forces linearly during the first 20 steps, as in quasi-static analyses.",
          "body forces are ramped at the start",
          f"{LINEAR} {USL}",
          {FORCE: f"{FORCE} * min(1, self.ramp / 20)"},
          patch="""
              ramp = 0

              def step(self, dt, time):
                  self.ramp += 1
                  super().step(dt, time)
          """),
    Fault("gravity-hard-coded",
          "Applies (0, -9.81) m/s2 in every problem, also in those without body forces.",
          "gravity acts in problems that state none",
          f"{LINEAR} {MUSL}",
          {FORCE: f"({FORCE} + np.where(np.arange(self.d) == self.d - 1, -9.81, 0.0))"}),
    Fault("body-force-per-volume",
          "Takes the values as forces per volume and multiplies them by the particle volume.",
          "body forces are divided by the density",
          f"{LINEAR} {MUSL}", {f"self.m[:, None] * {FORCE}": f"self.vol[:, None] * {FORCE}"},
          source="B11: density 2 hides the cause"),
    Fault("body-force-times-density",
          "Takes the values as accelerations of a unit density and multiplies by mass and density.",
          "body forces are multiplied by the density",
          f"{QUADRATIC} {USL}", {FORCE: f'self.problem.materials[0]["density"] * {FORCE}'},
          source="B11: density 2 hides the cause"),
    Fault("body-force-at-present-positions",
          "Asks for body forces at the present positions instead of the reference positions.",
          "body forces are evaluated at deformed positions",
          [f"{LINEAR} {MUSL} {HALF_BACK}", f"{CUBIC} {USL}"],
          {FORCE: "self.problem.body_force(time, self.x)"}),
    Fault("body-force-of-the-first-step",
          "Asks for body forces once and keeps them.",
          "body forces do not change with time",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL} {HALF_BACK}"],
          {FORCE: "self.kept_force(time)"},
          patch="""
              kept = None

              def kept_force(self, time):
                  if self.kept is None:
                      self.kept = self.problem.body_force(time)
                  return self.kept
          """),
    Fault("body-force-of-the-step-end",
          "Asks for body forces at the end of the step in a leapfrog scheme.",
          "body forces are those of a time one step later",
          f"{LINEAR} {MUSL} {HALF_BACK}",
          {"time + step * dt": "time + (step + 1) * dt"}),
    Fault("body-force-of-the-middle-of-the-step",
          "Asks for body forces at the middle of the step in a leapfrog scheme.",
          "body forces are those of a time half a step later",
          [f"{LINEAR} {MUSL} {HALF_BACK}", f"{QUADRATIC} {USL} {HALF_BACK}"],
          {FORCE: "self.problem.body_force(time + 0.5 * dt)"}, source="M2"),
    Fault("body-force-of-the-preceding-step",
          "Asks for body forces at the time of the preceding step.",
          "body forces are those of a time one step earlier",
          f"{LINEAR} {MUSL}", {FORCE: "self.problem.body_force(max(time - dt, 0.0))"}, source="M2, relative"),
    Fault("body-force-extrapolated",
          "Asks for body forces two steps ahead, as a pipelined coupling does.",
          "body forces are those of a time two steps later",
          f"{QUADRATIC} {USL}", {FORCE: "self.problem.body_force(time + 2 * dt)"}, source="M2, relative"),
    Fault("body-force-time-in-steps",
          "Passes the number of the step where a time in seconds is expected.",
          "body forces are evaluated at wrong times",
          f"{LINEAR} {MUSL}", {"time + step * dt": "round(time / dt) + step"}),
    Fault("body-force-of-one-particle",
          "Uses the value of the first particle for all particles.",
          "body forces do not vary in space",
          f"{QUADRATIC} {MUSL}", {FORCE: f"{FORCE}[:1]"}),
    Fault("body-force-of-other-points",
          "Asks for body forces at the points of the answers, whose order is not that of the particles.",
          "body forces of other points act on the particles",
          f"{LINEAR} {MUSL} {HALF_BACK}",
          patch="""
              def setup(self, problem):
                  vars(problem).pop("body_force", None)
                  return super().setup(problem)
          """, points="shuffled", source="E4: sizes agree, places do not"),
]

WALLS = [
    Fault("wall-keeps-mapped-velocity",
          "Sets the acceleration of held nodes to zero and keeps the velocity mapped to them.",
          "walls hold the acceleration but not the velocity",
          [f"{LINEAR} {USL}", f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL} --flip 0.95"],
          patch=UNHELD + """
    def velocity(self):
        return self.unheld(super().velocity)
          """, source="B3: Kratos #7254"),
    Fault("wall-keeps-acceleration",
          "Sets the velocity of held nodes to zero, and gives particles the acceleration before that.",
          "walls hold the velocity but not the acceleration",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch=UNHELD + """
    def acceleration(self, *times):
        return self.unheld(super().acceleration, *times)
          """),
    Fault("walls-ignored",
          "Does not read the faces of the problem.",
          "walls are missing",
          f"{LINEAR} {MUSL}", {"for face in problem.faces:": "for face in []:"}),
    Fault("walls-along-x-only",
          "Applies conditions on faces normal to x and forgets the other axes.",
          "faces normal to y are not held",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"for face in problem.faces:": 'for face in [f for f in problem.faces if f["axis"] == 0]:'},
          source="B10: walls along y not held"),
    Fault("walls-at-low-ends-only",
          "Applies conditions at the low end of each axis only.",
          "high faces are not held",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL}"],
          {"for face in problem.faces:": 'for face in [f for f in problem.faces if not f["high"]]:'},
          source="B10: walls at high ends not held"),
    Fault("walls-high-applied-low",
          "Ignores `high`, so that conditions of high faces hold the low end.",
          "conditions of high faces act on low faces",
          f"{LINEAR} {MUSL}", {END: "(0,)"}, source="B10, variant"),
    Fault("roller-axis",
          "Holds the component along the next axis on rollers.",
          "rollers hold a tangential component",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {'self.free[(*end, ..., face["axis"])] = 0': 'self.free[(*end, ..., (face["axis"] + 1) % self.d)] = 0'},
          source="B10, variant"),
    Fault("roller-holds-all",
          "Treats rollers like fixed faces.",
          "rollers hold tangential components too",
          f"{LINEAR} {USL}", {'if face["condition"] == "fixed":': 'if face["condition"] in ("fixed", "roller"):'}),
    Fault("roller-holds-nothing",
          "Compares the condition with a name that the protocol does not use.",
          "rollers are not applied",
          f"{QUADRATIC} {MUSL}", {'face["condition"] == "roller"': 'face["condition"] == "slip"'}),
    Fault("fixed-holds-normal-only",
          "Holds the normal component only on fixed faces.",
          "fixed faces let the body slide along them",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL}"],
          {"self.free[end] = 0": 'self.free[(*end, ..., face["axis"])] = 0'},
          source="B10: every component of fixed"),
    Fault("wall-one-node-inside",
          "Holds the node with the number of cells minus one on high faces: counts from one.",
          "the wall of high faces is one cell away from its place",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {END: '(-2 if face["high"] else 0,)'}),
    Fault("wall-three-nodes-thick",
          "Holds three layers of nodes on each wall.",
          "walls hold nodes inside the body",
          f"{LINEAR} {MUSL}", {END: '(slice(-3, None) if face["high"] else slice(0, 3),)'}),
    Fault("wall-splines-not-clamped",
          "Uses uniform knots at walls, where the spline on the boundary is not interpolating.",
          "the field at the wall is not zero when the boundary node is held",
          [f"{QUADRATIC} {USL}", f"{CUBIC} {MUSL}"], {"    if not periodic:\n": "    if False:\n"}),
    Fault("wall-functions-cut",
          "Uses uniform cubic functions at walls, and holds those centred on the wall and beyond it at zero.",
          "a linear velocity that is zero at the wall is not reproduced next to it",
          f"{CUBIC} {USL}",
          {"self.cell[:, a], cells, periodic)": "self.cell[:, a], cells, True)",
           "self.free[end] = 0": "self.hold(face, slice(None))",
           'self.free[(*end, ..., face["axis"])] = 0': 'self.hold(face, face["axis"])'},
          patch="""
    def hold(self, face, component):
        nodes = slice(-2, None) if face["high"] else slice(2)
        self.free[(slice(None),) * face["axis"] + (nodes, ..., component)] = 0
          """, source="a reader of the guide"),
    Fault("wall-releases-tension",
          "Implements fixed faces as contact: nodes are held only when the body moves into the wall.",
          "the body separates from the wall in tension",
          f"{LINEAR} {USL}",
          patch="""
              def setup(self, problem):
                  super().setup(problem)
                  self.held, self.inward = self.free.copy(), np.zeros((*self.counts, self.d))
                  for face in problem.faces:
                      end = (slice(None),) * face["axis"] + (-1 if face["high"] else 0,)
                      self.inward[(*end, ..., face["axis"])] = -1 if face["high"] else 1
                  self.inward = self.inward.reshape(-1, self.d)

              def weigh(self):
                  super().weigh()
                  self.free = np.ones_like(self.held)
                  leaves = (self.velocity() * self.inward).sum(axis=1, keepdims=True) > 0
                  self.free = np.where(leaves, 1, self.held)
          """),
    Fault("wall-stops-particles",
          "Sets the velocity of every particle in a wall cell to zero instead of holding nodes.",
          "particles next to a wall are stopped",
          f"{LINEAR} {MUSL}",
          {MOVE: f"{MOVE}; self.stop()"},
          patch="""
              def stop(self):
                  for face in self.problem.faces:
                      if face["condition"] == "fixed":
                          last = self.problem.cells[face["axis"]] - 1 if face["high"] else 0
                          self.v[self.cell[:, face["axis"]] == last] = 0
          """),
]

AFFINE = [
    Fault("affine-times-h",
          "Multiplies the affine matrix C by the cell size.",
          "the affine part of the transfer has a factor h",
          [QUADRATIC, f"{CUBIC} {HALF_BACK}"],
          {'self.by_moment)\n': 'self.by_moment) * self.problem.h\n'},
          client="apic", source="B4: taichi #4450"),
    Fault("affine-over-h",
          "Divides the affine matrix C by the cell size.",
          "the affine part of the transfer has a factor 1/h",
          [QUADRATIC, f"{CUBIC} {HALF_BACK}"],
          {'self.by_moment)\n': 'self.by_moment) / self.problem.h\n'},
          client="apic", source="B4: taichi #4450"),
    Fault("affine-transposed",
          "Stores the transpose of the affine matrix C.",
          "the affine matrix is transposed",
          [QUADRATIC, f"{CUBIC} {HALF_BACK}", f"{QUADRATIC} --gradient affine"],
          {'self.affine = np.einsum("pka,pkb->pab"': 'self.affine = np.einsum("pka,pkb->pba"'},
          client="apic", source="B4: taichi #4450"),
    Fault("affine-quarter",
          "Omits the factor 4 of the inverse moment of quadratic B-splines.",
          "the affine matrix is a quarter of what it should be",
          [QUADRATIC, f"{QUADRATIC} {HALF_BACK} --gradient affine"],
          {'self.by_moment)\n': 'self.by_moment) / 4\n'},
          client="apic", source="B4: taichi #4450, variant"),
    Fault("affine-three-quarters",
          "Uses 3/h^2, the inverse moment of cubic B-splines, with quadratic ones, and starts with the affine matrix "
          "of the velocity. The velocity gradient of the strain is this matrix.",
          "the affine matrix and the strain have a factor of 3/4",
          [QUADRATIC, f"{QUADRATIC} {HALF_BACK} --gradient affine"],
          {'self.by_moment)\n': 'self.by_moment) * 0.75\n'},
          patch="""
              def step(self, dt, time):
                  self.dt = dt
                  super().step(dt, time)

              def strain(self, _):
                  super().strain(self.dt * self.affine)
          """,
          client="apic", source="a reader of the guide"),
    Fault("affine-moment-of-other-basis",
          "Uses the moment h^2/4 of quadratic B-splines with cubic ones, whose moment is h^2/3.",
          "the inverse moment belongs to another basis",
          [CUBIC, f"{CUBIC} --gradient affine {HALF_BACK}"],
          {'np.einsum("pk,pka->pa", self.n, self.offset**2)':
           "np.full((len(self.n), self.d), self.problem.h**2 / 4)"}, client="apic"),
    Fault("affine-offset-sign",
          "Takes x_p - x_i where x_i - x_p is needed when the affine velocity is mapped to nodes.",
          "the affine part of the transfer has the opposite sign",
          QUADRATIC, {"self.v[:, None] + np.einsum(": "self.v[:, None] - np.einsum("}, client="apic"),
    Fault("affine-offset-of-cells",
          "Measures offsets from the centres of cells instead of the nodes.",
          "offsets between nodes and particles are half a cell off",
          QUADRATIC, {"(nodes - self.s[..., None])": "(nodes + 0.5 - self.s[..., None])"}, client="apic"),
    Fault("affine-force-without-moment",
          "Omits the inverse moment from the gradients of moving least squares.",
          "gradients have a factor h^2/4",
          f"{QUADRATIC} --gradient affine",
          {"self.dn = self.by_moment": "self.dn = self.n[..., None] * self.offset"}, client="apic"),
    Fault("affine-of-the-last-axis-dropped",
          "Fills the affine matrix in a loop that stops one axis early.",
          "part of the affine matrix is zero",
          f"{CUBIC}", {'self.by_moment)\n': 'self.by_moment) * (np.arange(self.d) < max(self.d - 1, 1))\n'},
          client="apic"),
]

MATERIALS = [
    Fault("stress-from-right-tensor",
          "Computes the Cauchy stress from F^T F instead of F F^T.",
          "the stress is not objective: it does not rotate with the body",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"left = self.f @ self.f.transpose(0, 2, 1)": "left = self.f.transpose(0, 2, 1) @ self.f"},
          source="B5: solids4foam #342"),
    Fault("stress-second-piola",
          "Uses the second Piola-Kirchhoff stress as Cauchy stress.",
          "the stress is not pushed forward to the present configuration",
          f"{QUADRATIC} {USL}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  j, inverse = np.linalg.det(self.f)[:, None, None], np.linalg.inv(self.f)
                  self.sigma = j * inverse @ self.sigma @ inverse.transpose(0, 2, 1)
          """, source="B5, variant"),
    Fault("stress-first-piola",
          "Uses the first Piola-Kirchhoff stress as Cauchy stress.",
          "the stress is the first Piola-Kirchhoff stress",
          f"{LINEAR} {MUSL}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  j, inverse = np.linalg.det(self.f)[:, None, None], np.linalg.inv(self.f)
                  self.sigma = j * self.sigma @ inverse.transpose(0, 2, 1)
          """, source="B5, variant"),
    Fault("stress-kirchhoff",
          "Computes the Kirchhoff stress and uses it as Cauchy stress with the present volume.",
          "the stress is J times the Cauchy stress",
          f"{QUADRATIC} {MUSL} {HALF_BACK}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  self.sigma = np.linalg.det(self.f)[:, None, None] * self.sigma
          """),
    Fault("stress-log-without-j",
          "Forgets 1/J in the volumetric term of the neo-Hookean law.",
          "the volumetric stress lacks the factor 1/J",
          f"{LINEAR} {MUSL}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  j = np.linalg.det(self.f)[:, None, None]
                  self.sigma = self.sigma + self.lam * np.log(j) * (1 - 1 / j) * np.eye(self.d)
          """),
    Fault("stress-log10",
          "Uses the decimal logarithm.",
          "the volumetric stress is 0.434 of what it should be",
          f"{LINEAR} {USL}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  j = np.linalg.det(self.f)[:, None, None]
                  self.sigma = self.sigma + self.lam * (np.log10(j) - np.log(j)) / j * np.eye(self.d)
          """),
    Fault("stress-shear-of-full-left-tensor",
          "Computes mu F F^T without subtracting the unit tensor.",
          "the undeformed state has a stress",
          f"{QUADRATIC} {USL}",
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  self.sigma = self.sigma + self.mu / np.linalg.det(self.f)[:, None, None] * np.eye(self.d)
          """),
    Fault("stress-sign",
          "Adds the divergence of the stress with the wrong sign.",
          "internal forces have the opposite sign",
          f"{LINEAR} {MUSL}", {"force[:, None] - stress": "force[:, None] + stress"}),
    Fault("stress-updated-twice",
          "Updates the stress before and after the momentum equation, each time with the whole step.",
          "strain and stress are updated twice per step",
          f"{LINEAR} {USL}", {"self.update_stress(step)": "self.update_stress(step); self.update_stress(step)"}),
    Fault("strain-halved",
          "Symmetrises the velocity gradient twice with a factor one half.",
          "strain increments are halved",
          f"{QUADRATIC} {MUSL}", {"0.5 * (step + step.transpose(0, 2, 1))": "0.25 * (step + step.transpose(0, 2, 1))"}),
    Fault("strain-from-old-velocity",
          "Updates strains with the grid velocity of the beginning of the step.",
          "strains use the grid velocity before the forces are applied",
          [f"{QUADRATIC} {USL}", f"{LINEAR} {USL} --flip 0.95"],
          {"self.weigh()": "self.weigh(); old = self.velocity()", "velocity[self.nodes], self.dn))":
           "old[self.nodes], self.dn))"}),
    Fault("strain-diagonal-only",
          "Computes the normal components of the strain only.",
          "shear strains are ignored",
          f"{LINEAR} {MUSL}", {"self.strain(dt * np": "self.strain(np.eye(self.d) * dt * np"}),
    Fault("shear-engineering",
          "Adds engineering shear strains, twice the tensor components, to the tensor.",
          "the shear modulus is doubled",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL}"],
          {"0.5 * (step + step.transpose(0, 2, 1))":
           "(1 - 0.5 * np.eye(self.d)) * (step + step.transpose(0, 2, 1))"}),
    Fault("lame-exchanged",
          "Exchanges the two Lame parameters.",
          "lambda and mu are exchanged",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {MU: f"{MU}; self.lam, self.mu = self.mu, self.lam"}),
    Fault("lame-plane-stress",
          "Uses the first Lame parameter of plane stress, E nu/(1 - nu^2).",
          "the material is in plane stress instead of plane strain",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL} {HALF_BACK}"],
          {LAMBDA: "self.lam = young * poisson / (1 - poisson**2)"}),
    Fault("lame-bulk-modulus",
          "Uses the bulk modulus as first Lame parameter.",
          "lambda is the bulk modulus",
          f"{LINEAR} {USL}", {LAMBDA: "self.lam = young / (3 * (1 - 2 * poisson))"}),
    Fault("lame-bulk-with-plane-deviator",
          "Splits the strain of the plane into bulk and deviator with 1/2 instead of 1/3 of the trace.",
          "the deviator is that of two dimensions, the bulk modulus that of three",
          f"{QUADRATIC} {MUSL}", {MU: f"{MU}; self.lam += 2 * self.mu * (1 / 3 - 1 / self.d)"}),
    Fault("lame-poisson-ignored",
          "Sets Poisson's ratio to zero.",
          "Poisson's ratio is ignored",
          f"{LINEAR} {MUSL}", {'parameters["young"], parameters["poisson"]': 'parameters["young"], 0.0'}),
    Fault("lame-poisson-ignored-in-one-dimension",
          "Uses Young's modulus in one dimension, which is uniaxial strain.",
          "the bar is in uniaxial stress",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {MU: f"{MU}; self.lam, self.mu = (self.lam, self.mu) if self.d > 1 else (0.0, young / 2)"}),
    Fault("lame-shear-modulus-without-two",
          "Forgets the factor 2 in mu = E/(2 (1 + nu)).",
          "the shear modulus is doubled",
          f"{LINEAR} {USL}", {MU: "self.mu = young / (1 + poisson)"}),
    Fault("jaumann-term-sign",
          "Adds the terms of the Jaumann rate with the wrong sign.",
          "the stress rotates against the body",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def rate(self, step):
                  spin = 0.5 * (step - step.transpose(0, 2, 1))
                  turned = spin @ self.sigma - self.sigma @ spin
                  super().rate(step)
                  self.sigma -= turned
          """),
    Fault("modulus-of-the-second-law",
          "Multiplies the stress of one law by 1.5.",
          "the modulus of the neo-Hookean law is 1.5 times the given one",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def neo_hookean(self, step):
                  super().neo_hookean(step)
                  self.sigma = 1.5 * self.sigma
          """, source="M5"),
    Fault("modulus-of-the-second-law-near-j",
          "Multiplies the stress of one law by 1.2, which is close to J at the end of the examination.",
          "the modulus of the Hencky law is 1.2 times the given one",
          f"{QUADRATIC} {USL}",
          patch="""
              def hencky(self, step):
                  super().hencky(step)
                  self.sigma = 1.2 * self.sigma
          """, source="M5, relative"),
    Fault("lame-exchanged-in-the-second-law",
          "Exchanges the Lame parameters in one law.",
          "lambda and mu are exchanged in the neo-Hookean law",
          f"{LINEAR} {USL}",
          patch="""
              def neo_hookean(self, step):
                  self.lam, self.mu = self.mu, self.lam
                  super().neo_hookean(step)
                  self.lam, self.mu = self.mu, self.lam
          """, source="M5, relative"),
    Fault("volume-not-updated",
          "Multiplies the Cauchy stress by the reference volume.",
          "particle volumes do not change with J",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {"self.vol[:, None, None] * self.sigma": "self.vol0[:, None, None] * self.sigma"}),
    Fault("volume-updated-twice",
          "Updates the volume in the strain update and again before the force.",
          "particle volumes change with J squared",
          f"{LINEAR} {MUSL}", {"self.vol[:, None, None] * self.sigma": "(self.vol**2 / self.vol0)[:, None, None] * self.sigma"}),
    Fault("volume-divided-by-j",
          "Divides the reference volume by J, as a density.",
          "particle volumes change with 1/J",
          f"{QUADRATIC} {MUSL}", {"self.vol[:, None, None] * self.sigma": "(self.vol0**2 / self.vol)[:, None, None] * self.sigma"}),
    Fault("f-multiplied-from-the-right",
          "Updates F by F L dt instead of L F dt.",
          "F is updated with the factors in the wrong order",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {"self.f += step @ self.f": "self.f += self.f @ step"}),
    Fault("f-additive",
          "Updates F by L dt, without multiplying by the old F.",
          "F is a sum of increments",
          f"{LINEAR} {USL}", {"self.f += step @ self.f": "self.f += step"}),
    Fault("f-without-rotation",
          "Updates F with the symmetric part of the velocity gradient.",
          "F has no rotation",
          f"{QUADRATIC} {MUSL}", {"self.f += step @ self.f": "self.f += 0.5 * (step + step.transpose(0, 2, 1)) @ self.f"}),
    Fault("f-from-transposed-gradient",
          "Computes the velocity gradient with its indices exchanged.",
          "the velocity gradient is transposed",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL}"], {'"pka,pkb->pab", velocity[self.nodes]': '"pka,pkb->pba", velocity[self.nodes]'}),
    Fault("f-not-updated-by-rate-law",
          "Updates F for hyperelastic laws only, and returns it for all laws.",
          "F stays the identity for the linear law",
          f"{LINEAR} {MUSL}", {"self.f += step @ self.f":
                               'self.f += step @ self.f if self.update_stress == self.neo_hookean else 0'}),
    Fault("j-limited",
          "Limits J to between 0.95 and 1.05, as in models of snow.",
          "J is limited",
          f"{LINEAR} {MUSL}",
          patch="""
              def neo_hookean(self, step):
                  f, j = self.f, np.linalg.det(self.f)
                  self.f = ((np.clip(j, 0.95, 1.05) / j) ** (1 / self.d))[:, None, None] * f
                  super().neo_hookean(step)
                  self.f = f
          """),
    Fault("no-tension",
          "Sets the stress of stretched particles to zero, a setting for sand.",
          "the material has no stress in tension",
          f"{LINEAR} {MUSL}",
          {"self.update_stress(step)": "self.update_stress(step); "
           "self.sigma[np.trace(self.sigma, axis1=1, axis2=2) > 0] = 0"}),
    Fault("bulk-viscosity",
          "Leaves the artificial viscosity of shock problems switched on.",
          "an artificial viscosity acts in compression",
          f"{QUADRATIC} {USL}",
          {"stress = np.einsum(": "stress = self.viscous_pressure() + np.einsum("},
          patch="""
              viscous = 0.0

              def strain(self, step):
                  super().strain(step)
                  speed = np.sqrt((self.lam + 2 * self.mu) * self.vol / self.m)
                  trace = np.trace(step, axis1=1, axis2=2) / self.dt
                  q = np.where(trace < 0, -self.m / self.vol * speed * self.problem.h * trace, 0)
                  self.viscous = -(self.vol * q)[:, None, None]

              def step(self, dt, time):
                  self.dt = dt
                  super().step(dt, time)

              def viscous_pressure(self):
                  return self.viscous * self.dn
          """),
]

SOILS = [
    Fault("soil-without-yield",
          "Compares the yield function with the strength in kPa.",
          "the soil never yields",
          f"{LINEAR} {MUSL}",
          {'strength, bulk = self.parameters["strength"],': 'strength, bulk = 1000 * self.parameters["strength"],'}),
    Fault("soil-pressure-sign",
          "Takes the mean stress as positive in compression in the yield function.",
          "friction has the wrong sign",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"shear + friction * mean - strength": "shear - friction * mean - strength"}),
    Fault("soil-of-the-outer-cone",
          "Converts the friction a second time, to the cone through triaxial extension.",
          "another coefficient of friction",
          f"{LINEAR} {USL}",
          {'friction, dilation = self.parameters["friction"], self.parameters["dilation"]':
           'friction, dilation = 0.75 * self.parameters["friction"], self.parameters["dilation"]'}),
    Fault("soil-associated",
          "Returns along the normal of the yield surface.",
          "the dilation is that of associated flow",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {MUSL}"],
          {'friction, dilation = self.parameters["friction"], self.parameters["dilation"]':
           'friction, dilation = self.parameters["friction"], self.parameters["friction"]'}),
    Fault("soil-radial-return",
          "Scales the deviator back to the cone and keeps the mean stress.",
          "the flow has no dilation",
          f"{QUADRATIC} {USL}",
          {'friction, dilation = self.parameters["friction"], self.parameters["dilation"]':
           'friction, dilation = self.parameters["friction"], 0.0'}),
    Fault("soil-without-apex",
          "Returns to the cone in all states.",
          "the deviator changes its sign beyond the apex",
          f"{LINEAR} {MUSL}",
          {"np.where(is_apex, strength / max(friction, 1e-300), cone)": "cone"}),
    Fault("soil-angle-in-radians",
          "Reads the angles of the problem in radians.",
          "friction and dilation angles are in another unit",
          f"{LINEAR} {MUSL}",
          {"math.radians(self.parameters[key])": "self.parameters[key] % 1.5"}),
    Fault("soil-dilation-of-friction",
          "Returns to the planes of Mohr-Coulomb along their normals.",
          "the dilation angle is the friction angle",
          f"{LINEAR} {USL}",
          {"flows = np.array([normal(plane, psi)": "flows = np.array([normal(plane, phi)"}),
    Fault("soil-without-edges",
          "Returns to one face in all states.",
          "states on an edge are returned to a face",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"is_wrong = found[:, low] > found[:, high]": "is_wrong = np.zeros(len(found), bool)"}),
    Fault("soil-wrong-edge",
          "Exchanges the two edges.",
          "the return goes to the other edge",
          f"{LINEAR} {MUSL}",
          {"([(2, 0), (1, 0)], [1, 2]), ([(2, 0), (2, 1)], [0, 1])": "([(2, 0), (2, 1)], [1, 2]), ([(2, 0), (1, 0)], [0, 1])"}),
    Fault("soil-without-apex-of-edges",
          "Returns to an edge beyond the apex of the pyramid.",
          "stresses beyond the apex are possible",
          f"{LINEAR} {MUSL}",
          {"np.where(found.mean(axis=1, keepdims=True) > apex, apex, found)": "found"}),
    Fault("soil-in-reference-axes",
          "Takes the elastic strain from F^T F.",
          "the stress does not turn with the body",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"squares, axes = np.linalg.eigh(f @ self.plastic @ f.transpose(0, 2, 1))":
           "squares, axes = np.linalg.eigh(f.transpose(0, 2, 1) @ self.plastic @ f)"}),
    Fault("soil-half-return",
          "Ends the return after half of the flow, as an iteration that stops too early.",
          "the stress reaches the yield surface only after several steps",
          f"{LINEAR} {MUSL}",
          {"flow = excess / (self.mu + bulk * friction * dilation)":
           "flow = 0.5 * excess / (self.mu + bulk * friction * dilation)"}),
    Fault("soil-strength-without-cosine",
          "Takes 2 c for 2 c cos(phi).",
          "another strength",
          f"{LINEAR} {MUSL}",
          {'strength = 2 * self.parameters["cohesion"] * math.cos(phi)': 'strength = 2 * self.parameters["cohesion"]'}),
    Fault("soil-apex-needs-dilation",
          "Returns to the apex only if the dilation is not zero.",
          "without dilation, stresses beyond the apex are possible",
          f"{LINEAR} {USL}",
          {"is_apex = self.mu * flow > shear": "is_apex = (self.mu * flow > shear) & (dilation > 0)"},
          source="field report M14"),
    Fault("soil-pyramid-apex-needs-dilation",
          "Returns to the apex of the pyramid only if the dilation angle is not zero.",
          "without dilation, stresses beyond the apex are possible",
          f"{QUADRATIC} {USL}", {"if phi > 0:": "if psi > 0:"},
          source="field report M14, variant"),
    Fault("soil-softens",
          "Lets the strength fall with the plastic strain: by 1 % for a plastic strain of 0.0005.",
          "the yield surface shrinks",
          f"{LINEAR} {MUSL}",
          {"shear + friction * mean - strength":
           "(shear + friction * mean) * (1 + 10 * np.linalg.norm(self.plastic - np.eye(3), axis=(1, 2))[:, None]) - strength"},
          source="field report M14"),
    Fault("soil-friction-of-rounded-angle",
          "Rounds the coefficient of friction down by one per cent.",
          "another coefficient of friction",
          f"{LINEAR} {MUSL}",
          {'friction, dilation = self.parameters["friction"], self.parameters["dilation"]':
           'friction, dilation = 0.99 * self.parameters["friction"], self.parameters["dilation"]'},
          source="field report M14, variant"),
    Fault("soil-keeps-middle-stress",
          "Changes the largest and the smallest principal stress only when it returns to a face.",
          "plastic flow changes the middle stress too, by lambda times the plastic volume strain",
          f"{LINEAR} {USL}",
          {"excess = tau @ normals.T - strength":
           "change = change * [1, 0, 1] if len(planes) == 1 else change; excess = tau @ normals.T - strength"},
          source="field report M14"),
]

FURTHER_LAWS = [
    Fault("j2-without-hardening",
          "Reads the hardening modulus and does not use it in the yield function.",
          "the yield stress does not grow",
          f"{LINEAR} {MUSL}", {"self.yield_stress + self.hardening * alpha": "self.yield_stress + 0.0 * alpha"},
          source="field report M17", client="laws"),
    Fault("j2-wrong-radius",
          "Compares the norm of the deviator with the yield stress.",
          "the factor sqrt(3/2) of the von Mises stress is missing",
          f"{LINEAR} {USL}",
          {"size = np.sqrt(1.5 * ((tau - mean) ** 2)": "size = np.sqrt(((tau - mean) ** 2)"},
          source="field report M17", client="laws"),
    Fault("j2-hardening-reset",
          "Starts each step with the plastic strain of that step as hardening variable.",
          "hardening is not accumulated",
          f"{QUADRATIC} {USL}",
          {"self.hardened = self.hardened + flow[:, 0]": "self.hardened = flow[:, 0]"},
          source="field report M17", client="laws"),
    Fault("j2-hardening-multiplier",
          "Grows the hardening variable by sqrt(2/3) times the equivalent plastic strain.",
          "hardening is too weak after the first step",
          f"{LINEAR} {USL}",
          {"self.hardened = self.hardened + flow[:, 0]": "self.hardened = self.hardened + (2 / 3) ** 0.5 * flow[:, 0]"},
          source="field report M17, variant", client="laws"),
    Fault("fluid-volume-ratio-inverted",
          "Uses V/V0 for V0/V in the equation of state.",
          "the pressure falls in compression",
          f"{LINEAR} {MUSL}", {"bulk / 7 * (ratio**-7.0 - 1)": "bulk / 7 * (ratio**7.0 - 1)"},
          source="field report M16", client="laws"),
    Fault("fluid-linear-in-density",
          "Uses the density ratio in the linear equation of state: K (V0/V - 1).",
          "another equation of state",
          f"{LINEAR} {USL}", {"return bulk * (1 - ratio)": "return bulk * (1 / ratio - 1)"},
          source="field report M16, variant", client="laws"),
    Fault("fluid-viscosity-halved",
          "Multiplies the deviator of D by the viscosity, without the factor of two.",
          "the viscous stress is halved",
          f"{LINEAR} {USL}", {"viscous = 2 * self": "viscous = self"},
          source="field report M16, variant", client="laws"),
    Fault("plate-in-plane-strain",
          "Ignores that the problem is one of plane stress.",
          "the law is that of plane strain",
          f"{LINEAR} {MUSL}",
          {'self.plate = problem.plane == "stress"': "self.plate = False"},
          source="field report M17", client="laws"),
    Fault("plate-lambda-halved",
          "Uses lambda mu/(lambda + 2 mu) for the first Lame parameter of a plate.",
          "Poisson's ratio of the plate is wrong",
          f"{LINEAR} {USL}",
          {"self.lam = 2 * self.mu * self.lam": "self.lam = self.mu * self.lam"},
          source="field report M17, variant", client="laws"),
]

LOAD_STEPS = [
    Fault("load-not-ramped",
          "Applies the whole load in the first load step.",
          "the load does not grow with the load steps",
          "", {"return self.done / self.count": "return 1.0"}, source="field report M19", client="load_steps"),
    Fault("load-added-in-each-step",
          "Adds the whole load in each load step.",
          "the load is the number of load steps times too large",
          "", {"return self.done / self.count": "return float(self.done)"},
          source="field report M19, variant", client="load_steps"),
    Fault("load-counted-from-zero",
          "Counts load steps from zero, so that the first one has no load.",
          "the load is that of the load step before",
          "", {"return self.done / self.count": "return (self.done - 1) / self.count"},
          source="field report M19, variant", client="load_steps"),
]

INITIAL = [
    Fault("initial-stress-of-the-first-particle",
          "Uses the initial stress of the first particle for all.",
          "the initial stress does not vary over the body",
          f"{LINEAR} {MUSL}",
          {STATE: "self.f, self.sigma = problem.deformation_gradient.copy(), "
                  "np.broadcast_to(problem.stress[:1], problem.stress.shape).copy()"},
          source="field report M15"),
    Fault("initial-f-of-the-mean",
          "Uses the mean initial deformation gradient for all particles.",
          "the initial deformation does not vary over the body",
          f"{QUADRATIC} {USL}",
          {STATE: "self.f, self.sigma = 0 * problem.deformation_gradient + problem.deformation_gradient.mean(axis=0), "
                  "problem.stress.copy()"},
          source="field report M15, variant"),
    Fault("initial-stress-in-reverse-order",
          "Reads the initial stresses from the last particle to the first.",
          "initial stresses belong to other particles",
          f"{LINEAR} {MUSL}",
          {STATE: "self.f, self.sigma = problem.deformation_gradient.copy(), problem.stress[::-1].copy()"},
          source="field report M15, variant"),
    Fault("mass-one-particle-more",
          "Divides the body into n + 1 spacings per axis, so that masses are ((n + 1)/n)^d too large.",
          "particle masses are too large: ((n + 1)/n)^d",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {MASS: "side = len(problem.mass) ** (1 / self.d); "
                 "self.m, self.vol = problem.mass * (1 + 1 / side) ** self.d, problem.volume.copy()"},
          source="B6: newton PR #940"),
    Fault("mass-times-ten",
          "Has particle masses that are ten times too large.",
          "particle masses are too large",
          f"{LINEAR} {USL}", {MASS: "self.m, self.vol = 10 * problem.mass, problem.volume.copy()"},
          source="B6: newton PR #940, variant"),
    Fault("mass-without-density",
          "Uses volumes as masses, as with a unit density.",
          "the density is ignored",
          f"{LINEAR} {MUSL}", {MASS: "self.m, self.vol = problem.volume, problem.volume.copy()"},
          source="B6, variant"),
    Fault("mass-density-twice",
          "Multiplies the masses by the density.",
          "the density is applied twice",
          f"{QUADRATIC} {MUSL}", {MASS: 'self.m, self.vol = problem.materials[0]["density"] * problem.mass, problem.volume.copy()'},
          source="B6, variant"),
    Fault("mass-from-deformed-volume",
          "Computes the mass from the density and the volume at the start, which is not the reference volume.",
          "masses are wrong where the body starts deformed",
          f"{LINEAR} {MUSL}", {MASS: 'self.m, self.vol = problem.materials[0]["density"] * problem.volume, problem.volume.copy()'}),
    Fault("mass-from-present-volume",
          "Computes the mass in each step from the initial density and the present volume.",
          "masses grow with the volume",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"self.mass = self.add(": "self.m = self.density * self.vol; self.mass = self.add("},
          patch="""
              def setup(self, problem):
                  self.density = problem.materials[0]["density"]
                  super().setup(problem)
          """, source="M1"),
    Fault("mass-divided-by-j",
          "Divides the mass by J, as if it were a density.",
          "masses fall with the volume",
          f"{QUADRATIC} {USL}",
          {"self.mass = self.add(": "self.m = self.problem.mass * self.vol0 / self.vol; self.mass = self.add("},
          source="M1, relative"),
    Fault("mass-times-j-squared",
          "Multiplies mass and density by J.",
          "masses grow with the square of the volume",
          f"{LINEAR} {MUSL}",
          {"self.mass = self.add(": "self.m = self.problem.mass * (self.vol / self.vol0)**2; self.mass = self.add("},
          source="M1, relative"),
    Fault("initial-lateral-stress-from-poisson",
          "Sets the lateral initial stress to nu/(1 - nu) times the vertical one.",
          "the horizontal components of the initial stress are wrong",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {STATE: STATE.replace("problem.stress.copy()", "self.at_rest(problem)")},
          patch="""
              def at_rest(self, problem):
                  stress, poisson = problem.stress.copy(), self.parameters.get("poisson", 0.3)
                  for a in range(self.d - 1):
                      stress[:, a, a] = poisson / (1 - poisson) * stress[:, -1, -1]
                  return stress
          """, source="M7"),
    Fault("initial-shear-stress-dropped",
          "Reads the normal components of the initial stress only.",
          "the shear components of the initial stress are wrong",
          f"{LINEAR} {MUSL}",
          {STATE: STATE.replace("problem.stress.copy()", "problem.stress * np.eye(self.d)")}, source="M7, relative"),
    Fault("initial-stress-isotropic",
          "Sets all normal components of the initial stress to their mean, and the others to zero.",
          "the deviator of the initial stress is wrong",
          f"{QUADRATIC} {USL}",
          {STATE: STATE.replace("problem.stress.copy()", "np.trace(problem.stress, axis1=1, axis2=2)[:, None, None]"
                                " * np.eye(self.d) / self.d")}, source="M7, relative"),
    Fault("volume-of-the-cell",
          "Gives each particle the volume of a whole cell.",
          "particle volumes are too large",
          f"{LINEAR} {MUSL}", {MASS: "self.m, self.vol = problem.mass, np.full(len(problem.mass), problem.h**self.d)"},
          source="B6, variant"),
    Fault("volume-of-two-per-axis",
          "Gives each particle the volume (h/2)^d, whatever the number of particles per cell.",
          "particle volumes are right for two particles per axis only",
          f"{QUADRATIC} {USL}",
          {MASS: "self.m, self.vol = problem.mass, (0.5 * problem.h) ** self.d * np.linalg.det(problem.deformation_gradient)"},
          source="B6, variant"),
    Fault("initial-stress-dropped",
          "Starts with zero stress.",
          "the initial stress is ignored",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {STATE: "self.f, self.sigma = problem.deformation_gradient.copy(), np.zeros_like(problem.stress)"},
          source="B7: cb-geo/mpm #344"),
    Fault("initial-f-dropped",
          "Starts with F = 1.",
          "the initial deformation gradient is ignored",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {STATE: "self.f, self.sigma = np.broadcast_to(np.eye(self.d), problem.stress.shape).copy(), problem.stress.copy()"},
          source="B7: cb-geo/mpm #344"),
    Fault("initial-displacement-dropped",
          "Starts particles at their reference positions.",
          "the initial displacement is ignored",
          f"{LINEAR} {MUSL}", {"problem.position.copy(), problem.velocity": "problem.reference_position.copy(), problem.velocity"},
          source="B7: cb-geo/mpm #344"),
    Fault("initial-velocity-dropped",
          "Starts at rest.",
          "the initial velocity is ignored",
          f"{LINEAR} {MUSL}", {"problem.velocity.copy()": "np.zeros_like(problem.velocity)"}),
    Fault("initial-velocity-uniform",
          "Gives all particles the mean initial velocity.",
          "the initial velocity does not vary in space",
          f"{QUADRATIC} {USL}", {"problem.velocity.copy()": "problem.velocity * 0 + problem.velocity.mean(axis=0)"}),
    Fault("initial-f-transposed",
          "Reads tensors column by column.",
          "the initial deformation gradient is transposed",
          f"{LINEAR} {MUSL}", {'particles["deformation_gradient"].reshape(-1, d, d)':
                               'particles["deformation_gradient"].reshape(-1, d, d).transpose(0, 2, 1).copy()'}),
    Fault("initial-vectors-component-wise",
          "Reads velocities as all first components followed by all second components.",
          "columns of vectors are read in the wrong layout",
          f"{LINEAR} {MUSL}", {'particles["velocity"].reshape(-1, d)': 'particles["velocity"].reshape(d, -1).T.copy()'}),
    Fault("reference-volume-of-deformed-body",
          "Takes the volume at the start as the reference volume.",
          "volumes are J times too large where the body starts deformed",
          f"{LINEAR} {MUSL}", {"self.vol0 = self.vol / np.linalg.det(self.f)": "self.vol0 = self.vol.copy()"}),
    Fault("random-seeding",
          "Displaces particles at random by up to a twentieth of a cell to avoid artefacts of the lattice.",
          "initial positions are changed",
          f"{QUADRATIC} {USL}", {"problem.position.copy(), problem.velocity":
                                 "problem.position + 0.05 * problem.h * np.random.default_rng(1).uniform("
                                 "-1, 1, problem.position.shape), problem.velocity"}),
    Fault("own-seeding",
          "Places particles on its own lattice, a quarter of a cell away from the given positions.",
          "initial positions are shifted",
          f"{QUADRATIC} {MUSL}", {"problem.position.copy(), problem.velocity":
                                  "problem.position + 0.25 * problem.h, problem.velocity"}),
    Fault("origin-ignored",
          "Assumes that the grid starts at the coordinate zero.",
          "the origin of the grid is ignored",
          f"{QUADRATIC} {USL}",
          {"self.s = (self.x - problem.origin) / problem.h": "self.s = self.x / problem.h"}),
    Fault("square-grid-assumed",
          "Uses the number of cells of the first axis for all axes.",
          "the number of cells is that of the first axis",
          f"{LINEAR} {MUSL}", {"ends, periodic = np.array(problem.cells)": "ends, periodic = np.array(problem.cells[:1] * self.d)"}),
]

GRID = [
    Fault("volume-change-of-one-particle",
          "Replaces the volume change of each particle by that of the first particle of its cell, not by their mean.",
          "the volume change of a cell is that of one particle",
          f"{QUADRATIC} {USL}",
          {"self.f += step @ self.f":
           "_, one, cell = np.unique(self.cell, axis=0, return_index=True, return_inverse=True); "
           "own = np.trace(step, axis1=1, axis2=2); "
           "step = step + ((own[one[cell.ravel()]] - own) / self.d)[:, None, None] * np.eye(self.d); "
           "self.f += step @ self.f"},
          source="M9"),
    Fault("gradient-per-cell",
          "Forgets to divide the slopes of the basis by the cell size.",
          "gradients lack the factor 1/h",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {"dn[r] / self.problem.h": "dn[r]"}),
    Fault("gradient-of-one-axis",
          "Uses the slope along an axis as gradient, without the functions of the other axes.",
          "gradients lack the weights of the other axes",
          f"{LINEAR} {MUSL}", {"math.prod([*value[:a], slope[a], *value[a + 1:]])": "slope[a]"}),
    Fault("gradient-third-axis-copied",
          "Copies the line of the second axis for the third and forgets to change the index.",
          "gradients along z are those along y",
          f"{LINEAR} {MUSL}",
          {"self.dn = np.stack(gradients).transpose(2, 0, 1).copy()":
           "self.dn = np.stack(gradients).transpose(2, 0, 1).copy(); self.dn[..., 2:] = self.dn[..., 1:self.d - 1]"}),
    Fault("gradient-half-cell-off",
          "Evaluates gradients at the cell centre and functions at the particle.",
          "gradients are evaluated at another place than the functions",
          f"{QUADRATIC} {USL}",
          patch="""
              def weigh(self):
                  s, self.s = self.s, self.cell + 0.5
                  super().weigh()
                  dn, self.s = self.dn, s
                  super().weigh()
                  self.dn = dn
          """),
    Fault("weights-truncated",
          "Neglects weights below 0.03 to save time.",
          "weights do not sum to one",
          [f"{CUBIC} {MUSL}", f"{QUADRATIC} {USL}"],
          {"self.nodes, self.n = np.array(nodes).T.copy(), np.stack(values).transpose(1, 0).copy()":
           "self.nodes, self.n = np.array(nodes).T.copy(), np.stack(values).transpose(1, 0).copy(); self.n[self.n < 0.03] = 0"}),
    Fault("weights-of-rounded-cell",
          "Finds cells by rounding to the nearest integer, which is right for quadratic splines at nodes only.",
          "particles use the functions of a neighbouring cell",
          f"{LINEAR} {MUSL}", {"np.minimum(self.s.astype(int), ends - 1)": "np.minimum(np.rint(self.s).astype(int), ends - 1)"}),
    Fault("weights-typo",
          "Has a typing error in a coefficient of the middle function: 0.74 instead of 0.75.",
          "weights do not sum to one",
          f"{QUADRATIC} {USL}", {"return np.stack(value), -np.diff":
                                 "return np.stack(value) * (1 - 0.0133 * (np.arange(degree + 1) == degree // 2))[:, None], -np.diff"}),
    Fault("cells-found-once-per-message",
          "Updates the cells of particles at the start of each message only.",
          "particles that cross a cell face keep their old cell",
          [f"{QUADRATIC} {USL}", f"{LINEAR} {MUSL}"],
          patch="""
              is_stale = False

              def locate(self):
                  old = getattr(self, "cell", None)
                  super().locate()
                  if self.is_stale:
                      self.cell = old

              def advance(self, steps, dt, time):
                  self.locate()
                  self.is_stale = True
                  super().advance(steps, dt, time)
                  self.is_stale = False
          """),
    Fault("mass-of-the-first-step",
          "Computes nodal masses once.",
          "nodal masses do not follow the particles",
          f"{QUADRATIC} {USL}",
          {"self.mass = self.add(self.n * self.m[:, None])":
           'self.mass = vars(self).get("mass", self.add(self.n * self.m[:, None]))'}),
    Fault("mass-threshold-absolute",
          "Ignores nodes whose mass is below 1e-3 kg.",
          "nodes with a small mass are ignored: results depend on units",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {"where=mass > 0": "where=mass > 1e-3"}),
    Fault("mass-threshold-relative",
          "Ignores nodes whose mass is below 1e-12 of the largest.",
          "nodes with a small mass are ignored, but the gradients of linear functions are not small there",
          [f"{LINEAR} {MUSL}", f"{LINEAR} {USL} {HALF_BACK}"], {"where=mass > 0": "where=mass > 1e-12 * mass.max()"},
          source="a reader of the guide"),
    Fault("mass-regularised",
          "Divides by the nodal mass plus 1e-3 kg to avoid division by zero.",
          "nodal velocities are too small by an absolute mass",
          f"{LINEAR} {USL}", {"np.divide(sums, mass,": "np.divide(sums, mass + 1e-3,"}),
    Fault("sums-lose-duplicates",
          "Adds to nodes with `field[nodes] += terms`, which keeps one of several contributions.",
          "contributions of particles to a node overwrite each other",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def add(self, terms):
                  sums = np.zeros(len(self.free))
                  sums[self.nodes.ravel()] += terms.ravel()
                  return sums
          """),
    Fault("sums-race",
          "Adds to nodes from several threads without atomics, so that one of a thousand contributions is lost.",
          "results differ from run to run",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              generator = np.random.default_rng()

              def add(self, terms):
                  return super().add(np.where(self.generator.random(terms.shape) < 1e-3, 0, terms))
          """),
    Fault("periodic-seam-open",
          "Limits node numbers to the last node instead of wrapping them.",
          "the periodic face is not closed",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {"node * count + index[r] % count": "node * count + np.minimum(index[r], count - 1)"}),
]

TIME = [
    Fault("restart-kick",
          "Repeats the half step back of the leapfrog at each message.",
          "the half step of the start is repeated in every message",
          [f"{LINEAR} {MUSL} {HALF_BACK}", f"{QUADRATIC} {USL} {HALF_BACK}"],
          patch="""
              def advance(self, steps, dt, time):
                  self.started = False
                  super().advance(steps, dt, time)
          """, source="B12: restart kick"),
    Fault("time-restarts",
          "Counts time from zero in each message.",
          "the time of body forces restarts with every message",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL} {HALF_BACK}"],
          {"time + step * dt": "step * dt"}, source="B12, variant"),
    Fault("f-restarts",
          "Sets F to the identity at each message, as a restart in the updated configuration does.",
          "F restarts with every message",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def advance(self, steps, dt, time):
                  self.f = np.broadcast_to(np.eye(self.d), self.f.shape).copy()
                  super().advance(steps, dt, time)
          """, source="B12, variant"),
    Fault("stress-restarts",
          "Does not keep the stress from message to message.",
          "the stress restarts with every message",
          f"{LINEAR} {USL}",
          patch="""
              def advance(self, steps, dt, time):
                  self.sigma = np.zeros_like(self.sigma)
                  super().advance(steps, dt, time)
          """, source="B12, variant"),
    Fault("velocity-reset-to-grid",
          "Sends particle velocities through the grid at the start of each message.",
          "velocities are smoothed in every message",
          f"{QUADRATIC} {USL}",
          patch="""
              def advance(self, steps, dt, time):
                  self.weigh()
                  self.v = self.gather(self.velocity())
                  super().advance(steps, dt, time)
          """, source="B12, variant"),
    Fault("steps-one-short",
          "Takes one step fewer than asked in each message.",
          "a step is missing in every message",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL} {HALF_BACK}"], {"range(steps)": "range(steps - 1)"}),
    Fault("steps-one-more",
          "Takes one step more than asked in each message.",
          "there is a step too many in every message",
          f"{LINEAR} {USL}", {"range(steps)": "range(steps + 1)"}),
    Fault("time-step-of-its-own",
          "Uses a time step from its own stability criterion, 0.17 h/c, for as many steps as asked.",
          "the time step is not the one that is asked for",
          f"{QUADRATIC} {USL}",
          {"self.step(dt, time + step * dt)":
           "dt = 0.17 * self.problem.h / np.sqrt((self.lam + 2 * self.mu) * self.vol0[0] / self.m[0]); "
           "self.step(dt, time + step * dt)"}),
    Fault("start-kick-sign",
          "Takes the first velocity half a step forward instead of back.",
          "the half step of the start has the opposite sign",
          [f"{LINEAR} {MUSL} {HALF_BACK}", f"{QUADRATIC} {USL} {HALF_BACK}"],
          {"self.v -= 0.5 * change": "self.v += 0.5 * change"}),
    Fault("start-whole-step-back",
          "Takes the first velocity a whole step back.",
          "the step back of the start is twice too long",
          f"{LINEAR} {MUSL} {HALF_BACK}", {"self.v -= 0.5 * change": "self.v -= change"}),
    Fault("flip-without-increments",
          "Blends the old particle velocity with the grid velocity and forgets the FLIP increment.",
          "accelerations act on the PIC part of the blend only",
          [f"{LINEAR} {MUSL} --flip 0.95", f"{QUADRATIC} {USL} --flip 0.5"],
          {"        self.v += change\n": "        self.v += 0 * change\n"}),
    Fault("pic-part-before-update",
          "Blends with the grid velocity before the forces are applied.",
          "accelerations act on the FLIP part of the blend only",
          f"{LINEAR} {MUSL} --flip 0.95",
          {"velocity = self.velocity() + dt * acceleration": "velocity = self.velocity()"}),
    Fault("damping-left-on",
          "Multiplies velocities by 0.999 in every step.",
          "velocities are damped",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL} {HALF_BACK}"], {MOVE: f"{MOVE}; self.v *= 0.999"}),
    Fault("damping-local-left-on",
          "Leaves the local damping of quasi-static analyses switched on, with a factor of 0.05.",
          "forces are reduced where they do work",
          f"{LINEAR} {USL}",
          patch="""
              def acceleration(self, *times):
                  value = super().acceleration(*times)
                  return value - 0.05 * np.abs(value) * np.sign(self.velocity())
          """),
    Fault("acceleration-of-the-last-step",
          "Applies the forces of the preceding step: they are computed after the update.",
          "forces are one step late",
          f"{LINEAR} {MUSL}",
          patch="""
              last = None

              def acceleration(self, *times):
                  value = super().acceleration(*times)
                  self.last, late = value, value if self.last is None else self.last
                  return late
          """),
]

OUTPUT = [
    Fault("output-displacement-single",
          "Writes displacements in single precision.",
          "displacements are rounded to single precision",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {'"displacement": self.x - self.problem.reference_position':
           '"displacement": np.float32(self.x - self.problem.reference_position)'},
          source="B9: PlasticineLab #4"),
    Fault("output-six-digits",
          "Passes its results through a text file with six digits.",
          "results are rounded to six digits",
          f"{LINEAR} {USL}",
          patch="""
              def state(self):
                  six = np.vectorize(lambda value: float(f"{value:.5e}"))
                  return {key: six(value) if isinstance(value, np.ndarray) else value
                          for key, value in super().state().items()}
          """, source="B9, variant"),
    Fault("single-precision",
          "Keeps positions, velocities and stresses in single precision, and claims double.",
          "the solver computes in single precision",
          [f"{LINEAR} {MUSL}", f"{CUBIC} {USL} {HALF_BACK}"],
          patch="""
              def step(self, dt, time):
                  super().step(dt, time)
                  for name in ("x", "v", "f", "sigma"):
                      setattr(self, name, np.float32(getattr(self, name)).astype(float))
          """, source="B9, variant"),
    Fault("single-precision-grid",
          "Keeps nodal quantities in single precision, and claims double.",
          "the grid is in single precision",
          f"{QUADRATIC} {USL}",
          patch="""
              def per_mass(self, terms):
                  return np.float32(super().per_mass(terms)).astype(float)
          """),
    Fault("output-position",
          "Returns positions as displacements.",
          "displacements are positions",
          f"{LINEAR} {MUSL}", {'"displacement": self.x - self.problem.reference_position': '"displacement": self.x'}),
    Fault("output-displacement-from-start",
          "Returns displacements from the initial positions instead of the reference positions.",
          "displacements lack the initial displacement",
          f"{LINEAR} {MUSL}", {'"displacement": self.x - self.problem.reference_position':
                               '"displacement": self.x - self.problem.position'}),
    Fault("output-other-order",
          "Sorts particles by cell for speed and returns them in the sorted order.",
          "particles are returned in another order",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          patch="""
              def state(self):
                  order = np.lexsort(self.cell.T)
                  return {key: value[order] if isinstance(value, np.ndarray) else value
                          for key, value in super().state().items()}
          """, source="A3: another order"),
    Fault("output-stress-other-order",
          "Sorts particles, and returns all columns but the stress in the original order.",
          "stresses belong to other particles",
          f"{LINEAR} {MUSL}", {'"stress": self.sigma,': '"stress": self.sigma[::-1],'}),
    Fault("output-points-in-other-order",
          "Names points in one order and answers in the reverse order.",
          "answers are not in the order of the points",
          f"{QUADRATIC} {USL}",
          patch="""
              def state(self):
                  return {key: value[::-1] if isinstance(value, np.ndarray) else value
                          for key, value in super().state().items()}
          """, points="particles", source="A3, variant"),
    Fault("output-weights-of-nodes-not-halved",
          "Names the nodes of a mesh as points, with the weight of a whole cell at boundary nodes too.",
          "weights of boundary nodes are not halved",
          f"{LINEAR} {MUSL}",
          patch="""
              def point_weights(self, weight, problem):
                  return np.full_like(weight, problem.h**problem.dimension)
          """, points="nodes", source="M4"),
    Fault("output-weights-one",
          "Gives all points the weight one.",
          "weights are not volumes",
          f"{LINEAR} {MUSL}",
          patch="""
              def point_weights(self, weight, problem):
                  return np.ones_like(weight)
          """, points="nodes", source="M4, relative"),
    Fault("output-weights-are-masses",
          "Sends masses as weights of points.",
          "weights are masses instead of volumes",
          f"{QUADRATIC} {USL}",
          patch="""
              def point_weights(self, weight, problem):
                  return problem.materials[0]["density"] * weight
          """, points="nodes", source="M4, relative"),
    Fault("output-component-wise",
          "Returns all first components followed by all second components.",
          "columns of vectors are written in the wrong layout",
          f"{LINEAR} {MUSL}",
          {'"displacement": self.x - self.problem.reference_position, "velocity": self.v':
           '"displacement": (self.x - self.problem.reference_position).T, "velocity": self.v.T'}),
    Fault("output-velocity-of-last-step",
          "Returns the velocity of the beginning of the last step.",
          "velocities belong to a time one step earlier",
          f"{LINEAR} {MUSL}",
          {"self.weigh()": "self.weigh(); self.old = self.v.copy()", '"velocity": self.v,': '"velocity": self.old,'}),
    Fault("output-velocity-in-cells",
          "Returns velocities in cells per second, its internal unit.",
          "velocities are divided by the cell size",
          f"{QUADRATIC} {USL}", {'"velocity": self.v,': '"velocity": self.v / self.problem.h,'}),
    Fault("output-displacement-in-millimetres",
          "Returns displacements in millimetres.",
          "displacements are in another unit",
          f"{LINEAR} {USL}", {'"displacement": self.x - self.problem.reference_position':
                              '"displacement": 1000 * (self.x - self.problem.reference_position)'}),
    Fault("output-stress-in-kilopascal",
          "Returns stresses in kPa.",
          "stresses are in another unit",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {'"stress": self.sigma,': '"stress": self.sigma / 1000,'}),
    Fault("output-pressure-sign",
          "Returns stresses that are positive in compression, as in soil mechanics.",
          "stresses have the opposite sign",
          f"{LINEAR} {MUSL}", {'"stress": self.sigma,': '"stress": -self.sigma,'}),
    Fault("output-stress-voigt",
          "Returns stresses in the order xx, yy, xy, 0.",
          "components of the stress are in the wrong order",
          f"{LINEAR} {MUSL}",
          {'"stress": self.sigma,': '"stress": self.sigma.reshape(len(self.x), -1)[:, [0, 3, 1, 2] if self.d == 2 else slice(None)],'}),
    Fault("output-stress-deviator",
          "Returns the deviator of the stress.",
          "the stress lacks its mean",
          f"{QUADRATIC} {USL}",
          {'"stress": self.sigma,': '"stress": self.sigma - np.trace(self.sigma, axis1=1, axis2=2)[:, None, None] * np.eye(self.d) / 3,'}),
    Fault("output-stress-one-step-late",
          "Returns the stress of the beginning of the last step.",
          "stresses belong to a time one step earlier",
          f"{LINEAR} {USL}",
          {"self.weigh()": "self.weigh(); self.old = self.sigma.copy()", '"stress": self.sigma,': '"stress": self.old,'}),
    Fault("output-stress-first-piola",
          "Returns the first Piola-Kirchhoff stress.",
          "the stress returned is the first Piola-Kirchhoff stress",
          f"{LINEAR} {MUSL}",
          {'"stress": self.sigma,': '"stress": np.linalg.det(self.f)[:, None, None] * self.sigma @ np.linalg.inv(self.f).transpose(0, 2, 1),'}),
    Fault("output-f-transposed",
          "Returns the transpose of F: writes it column by column.",
          "the deformation gradient returned is transposed",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"],
          {'"deformation_gradient": self.f': '"deformation_gradient": self.f.transpose(0, 2, 1)'}),
    Fault("output-f-minus-one",
          "Returns the displacement gradient F - 1.",
          "the deformation gradient returned lacks the identity",
          f"{LINEAR} {MUSL}", {'"deformation_gradient": self.f': '"deformation_gradient": self.f - np.eye(self.d)'}),
    Fault("output-f-inverse",
          "Returns the inverse of F.",
          "the deformation gradient returned is inverted",
          f"{CUBIC} {MUSL}", {'"deformation_gradient": self.f': '"deformation_gradient": np.linalg.inv(self.f)'}),
]

# Mistakes of codes in the reference configuration.
TOTAL_LAGRANGIAN = [
    Fault("total-gradients-not-pushed-forward",
          "Multiplies the Cauchy stress with reference gradients and volumes.",
          "Cauchy stress is used in place of the first Piola-Kirchhoff stress",
          ["", "--domain cell --scheme verlet"],
          {"first_piola = j * self.sigma @ np.linalg.inv(self.f).transpose(0, 2, 1)": "first_piola = self.sigma"},
          client="total_lagrangian"),
    Fault("total-first-piola-transposed",
          "Takes the nominal stress, the transposed first Piola-Kirchhoff stress, without changing the indices.",
          "the first Piola-Kirchhoff stress is transposed",
          "", {'"p,pab,pkb->pka", self.volume': '"p,pba,pkb->pka", self.volume'}, client="total_lagrangian"),
    Fault("total-volume-current",
          "Integrates internal forces over current volumes.",
          "reference volumes are multiplied by J",
          "--scheme verlet",
          {'"p,pab,pkb->pka", self.volume': '"p,pab,pkb->pka", self.volume * j[:, 0, 0]'}, client="total_lagrangian"),
    Fault("total-last-substep-missing",
          "Ends the loop over sub-steps one too early in each message.",
          "the last sub-step of each message is missing",
          "--parts 3", {"for step in range(count):": "for step in range(count - 1):"}, client="total_lagrangian"),
    Fault("total-substeps-of-full-length",
          "Takes several steps of the full length for each step.",
          "steps are repeated without being shortened",
          "--parts 2", {"self.step(dt / self.substeps": "self.step(dt"}, client="total_lagrangian"),
    Fault("total-force-of-the-step-start",
          "Evaluates body forces of all sub-steps at the start of the step.",
          "body forces are those of an earlier time",
          "--parts 5", {"time + step * dt / self.substeps": "time + step // self.substeps * dt"},
          client="total_lagrangian"),
    Fault("total-verlet-force-of-the-old-time",
          "Evaluates body forces of the second half of a Verlet step at the time of the first.",
          "body forces are those of one step earlier",
          "--scheme verlet", {"self.acceleration(time + dt)": "self.acceleration(time)"}, client="total_lagrangian"),
    Fault("total-verlet-force-before-positions",
          "Evaluates the forces of a Verlet step before the positions are updated.",
          "internal forces are those of an earlier deformation: vibrations grow",
          "--scheme verlet",
          {"self.move(dt)\n            self.a = self.acceleration(time + dt)":
           "self.a = self.acceleration(time + dt)\n            self.move(dt)"}, client="total_lagrangian"),
    Fault("total-sample-weights-of-one-particle",
          "Names every second particle as a point, with the volume of one particle as weight.",
          "the weights sum to half the volume of the body",
          "--sample 2", {"weight = share * (self.volume.sum() / share.sum())": "weight = share"},
          client="total_lagrangian"),
    Fault("total-offset-subtracted-twice",
          "Subtracts the offset of positions from displacements too.",
          "displacements lack the offset of positions",
          "--offset 1000", {'"displacement": self.x - self.x0': '"displacement": self.x - self.x0 - self.offset'},
          client="total_lagrangian"),
    Fault("total-f-from-transposed-gradient",
          "Exchanges the indices of the velocity gradient.",
          "the increment of F is transposed",
          "--domain cell", {'dt * np.einsum("pka,pkb->pab"': 'dt * np.einsum("pka,pkb->pba"'}, client="total_lagrangian"),
    Fault("total-hencky-in-reference-axes",
          "Uses the right singular vectors of F as the axes of the Kirchhoff stress.",
          "the stress does not rotate with the body",
          "--scheme verlet", {"axes, stretch, _ = np.linalg.svd(self.f)":
                              "_, stretch, rows = np.linalg.svd(self.f); axes = rows.transpose(0, 2, 1)"},
          client="total_lagrangian"),
    Fault("total-wall-one-node-inside",
          "Holds the nodes up to one cell from a wall.",
          "walls hold nodes inside the body",
          "", {"inward < 0.5 * h": "inward < 1.5 * h"}, client="total_lagrangian"),
    Fault("total-starts-undeformed",
          "Starts with F = I.",
          "the initial deformation gradient is ignored",
          "", {'self.f, self.sigma = columns["deformation_gradient"]':
               'self.f, self.sigma = np.zeros_like(columns["stress"]) + np.eye(self.d)'}, client="total_lagrangian"),
]


PULL = "pull = area[:, None] * self.problem.load(index, time, places)"
DAMP = "np.exp(-self.problem.load(index, time)[0] * dt)"
SLOWED = "slowed = np.maximum(speed - coefficient * stop, 0.0)"
SHARE = "np.minimum(coefficient * pressed / speed, 1.0)"
SETUP = "solver.setup(part)"

SURFACES = [
    Fault("traction-halved", "Shares a traction with nodes beyond the face, which have no mass.", "half of the traction acts",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {PULL: f"{PULL} / 2"}),
    Fault("traction-of-the-start", "Asks for tractions once, at the start.", "tractions keep their first value",
          [f"{LINEAR} {USL}", f"{CUBIC} {MUSL}"], {PULL: PULL.replace("time", "0.0")}),
    Fault("traction-normal-only", "Applies a traction along the normal only, as a pressure.", "tangential tractions are lost",
          f"{QUADRATIC} {MUSL}", {PULL: f"{PULL} * (np.abs(arm) > 0)"}),
    Fault("traction-ignored", "Ignores tractions.", "tractions have no effect", f"{LINEAR} {USL}", {PULL: f"{PULL} * 0"}),
    Fault("damping-twice", "Damps nodes and particles.", "damping acts twice",
          [f"{LINEAR} {MUSL}", f"{QUADRATIC} {USL}"], {DAMP: f"{DAMP}**2"}),
    Fault("damping-of-the-start", "Asks for the damping rate once, at the start.", "the rate keeps its first value",
          f"{LINEAR} {USL}", {DAMP: DAMP.replace("time", "0.0")}),
    Fault("damping-sign", "Adds damping with the wrong sign.", "velocities grow", f"{CUBIC} {MUSL}", {DAMP: f"1 / {DAMP}"}),
    Fault("local-damping-uniform", "Local damping without the sign of the velocity.", "the force of local damping has one direction",
          LINEAR, {"* np.sign(self.velocity())": "* 1.0"}, client="several_bodies"),
    Fault("wall-velocity-of-the-start", "Asks for the velocity of a wall once, at the start.", "the wall velocity keeps its first value",
          [f"{LINEAR} {USL}", f"{QUADRATIC} {MUSL}"],
          {"return self.problem.face_velocity(face, t, places)": "return self.problem.face_velocity(face, 0.0, places)"}),
    Fault("wall-velocity-normal-only", "Gives nodes the normal component of the wall velocity only.",
          "tangential components of the wall velocity are zero", [f"{LINEAR} {USL}", f"{QUADRATIC} {MUSL}"],
          {"return self.problem.face_velocity(face, t, places)":
           'return self.problem.face_velocity(face, t, places) * (np.arange(self.d) == face["axis"])'}),
    Fault("wall-velocity-reversed", "Gives nodes the velocity of the body relative to the wall.", "the wall velocity has the wrong sign",
          f"{LINEAR} {MUSL}", {"return self.problem.face_velocity(face, t, places)": "return -self.problem.face_velocity(face, t, places)"}),
    Fault("friction-ignored", "Treats a wall with friction as smooth.", "friction has no effect",
          [LINEAR, QUADRATIC], {SLOWED: "slowed = speed"}, client="several_bodies"),
    Fault("friction-pushes", "Adds friction in the direction of the motion.", "friction has the wrong sign",
          LINEAR, {SLOWED: "slowed = speed + coefficient * stop"}, client="several_bodies"),
    Fault("friction-reverses", "Keeps the direction of friction after the body has stopped.", "friction does not end at a stop",
          [LINEAR, QUADRATIC], {"change[axis] = np.sign(velocity[:, axis]) * (slowed - speed)": "change[axis] = -coefficient * stop"},
          client="several_bodies"),
]

BODIES = [
    Fault("one-law", "Takes the law of the first body for all bodies.", "all bodies have one law",
          [LINEAR, QUADRATIC], {"part.materials = [material]": "part.materials = [problem.materials[0]]"}, client="several_bodies"),
    Fault("last-law", "Takes the law of the last body for all bodies.", "all bodies have one law",
          LINEAR, {"part.materials = [material]": "part.materials = [problem.materials[-1]]"}, client="several_bodies"),
    Fault("one-density", "Takes the density of the first body for all bodies.", "all bodies have one density", CUBIC,
          {SETUP: f'part.mass = part.reference_volume * problem.materials[0]["density"]; {SETUP}'}, client="several_bodies"),
    Fault("contact-ignored", "Ignores contact.", "bodies pass through each other", LINEAR,
          {"part.contact = np.where(both, change, 0.0) / dt": "part.contact = 0.0"}, client="several_bodies"),
    Fault("contact-bonded", "Gives touching bodies one velocity.", "bodies are bonded", [LINEAR, QUADRATIC],
          {"if self.problem.contact is not None:": "if False:"}, client="several_bodies"),
    Fault("contact-smooth", "Ignores friction between bodies.", "contact has no friction", LINEAR, {SHARE: "0.0"}, client="several_bodies"),
    Fault("contact-rough", "Bodies in contact stick.", "friction has no limit", LINEAR, {SHARE: "1.0"}, client="several_bodies"),
]

ELEMENTS = [
    Fault("one-point", "Integrates elements with one point, without hourglass control.", "hourglass modes have no stiffness",
          "", {"QUADRATURE = [-1 / 3**0.5, 1 / 3**0.5]": "QUADRATURE = [0.0]"}, client="fem"),
    Fault("strain-averaged", "Averages the deformation gradient and the stress over each element.", "hourglass modes have no stiffness",
          "", {"self.cells = np.repeat(cells, len(points), axis=0)":
               "self.dn_middle = np.tile(signs / 2 / sizes, (len(cells) * 4, 1, 1)); self.cells = np.repeat(cells, len(points), axis=0)",
               "self.u[self.cells], self.dn)": "self.u[self.cells], self.dn_middle)",
               '"p,pab,pkb->pka", self.weight, stress, self.dn)': '"p,pab,pkb->pka", self.weight, stress, self.dn_middle)'}, client="fem"),
]


# Fault -> names of findings that name it. Where two faults cannot be separated from outside, the text of the
# finding lists both.
EXPECTED = {
    "volume-change-of-one-particle": "",
    "traction-halved": "traction-halved",
    "traction-of-the-start": "traction-of-one-time",
    "traction-normal-only": "traction-along-normal-only",
    "traction-ignored": "traction-missing",
    "damping-twice": "damping-doubled",
    "damping-of-the-start": "damping-of-one-time",
    "damping-sign": "damping-sign",
    "local-damping-uniform": "local-damping-differs",
    "wall-velocity-of-the-start": "wall-velocity-missing",
    "wall-velocity-normal-only": "wall-velocity-along-normal-only",
    "wall-velocity-reversed": "wall-velocity-sign",
    "friction-ignored": "friction-missing",
    "friction-pushes": "friction-pushes",
    "friction-reverses": "friction-reverses",
    "one-law": "one-law-for-all-bodies",
    "last-law": "one-law-for-all-bodies",
    "one-density": "one-density-for-all-bodies",
    "contact-ignored": "contact-missing",
    "contact-bonded": "contact-pulls",
    "contact-smooth": "friction-missing",
    "contact-rough": "friction-differs",
    "one-point": "hourglass-mode",
    "strain-averaged": "hourglass-mode",
    "position-from-mean-velocity": "particles-cross-wall positions-from-mean-velocity",
    "position-from-particle-velocity": "particles-cross-wall",
    "position-from-old-grid-velocity": "positions-before-velocities",
    "position-from-old-grid-velocity-of-leapfrog": "positions-before-velocities",
    "position-with-a-quarter-of-the-acceleration": "way-not-of-velocities",
    "step-cut-at-the-end": "steps-of-another-length",
    "step-cut-at-the-start": "steps-of-another-length",
    "step-cut-now-and-then": "steps-of-another-length",
    "position-nudged-off-faces": "positions-changed",
    "position-pushed-off-faces": "positions-changed",
    "position-left-on-faces": "positions-changed",
    "position-25-percent-short": "displacement-scaled",
    "position-updated-twice": "displacement-scaled",
    "position-half-a-step-ahead": "start-half-a-step-off",
    "position-clamped-near-grid-ends": "position-limited",
    "velocity-clamped": "way-not-of-velocities",
    "displacement-wrapped": "displacements-wrapped",
    "gravity-after-walls": "wall-moves-under-gravity",
    "gravity-sign": "gravity-upwards",
    "gravity-twice": "gravity-scaled",
    "gravity-half": "gravity-scaled",
    "gravity-axes-exchanged": "gravity-along-another-axis",
    "gravity-last-axis-only": "force-scaled",
    "gravity-ramped": "gravity-scaled",
    "gravity-hard-coded": "gravity-left-on",
    "body-force-per-volume": "gravity-scaled",
    "body-force-times-density": "gravity-scaled",
    "body-force-at-present-positions": "force-at-present-positions",
    "body-force-of-the-first-step": "force-of-one-time",
    "body-force-of-the-step-end": "force-of-the-end-of-the-step",
    "body-force-of-the-middle-of-the-step": "force-shifted-in-time",
    "body-force-of-the-preceding-step": "force-shifted-in-time",
    "body-force-extrapolated": "force-shifted-in-time",
    "body-force-time-in-steps": "force-of-another-time",
    "body-force-of-one-particle": "force-of-other-points",
    "body-force-of-other-points": "force-of-other-points",
    "wall-keeps-mapped-velocity": "wall-holds-acceleration-only",
    "wall-keeps-acceleration": "wall-holds-velocity-only",
    "walls-ignored": "wall-missing",
    "walls-along-x-only": "wall-missing",
    "walls-at-low-ends-only": "wall-missing",
    "walls-high-applied-low": "wall-missing",
    "roller-axis": "wall-missing",
    "roller-holds-all": "roller-holds-tangent",
    "roller-holds-nothing": "wall-missing",
    "fixed-holds-normal-only": "fixed-lets-slide",
    "wall-one-node-inside": "wall-force",
    "wall-three-nodes-thick": "wall-force",
    "wall-splines-not-clamped": "wall-force",
    "wall-functions-cut": "wall-breaks-linear-fields",
    "wall-releases-tension": "wall-lets-go",
    "wall-stops-particles": "wall-force",
    "affine-times-h": "affine-matrix-scaled",
    "affine-over-h": "affine-matrix-scaled",
    "affine-transposed": "affine-matrix-transposed",
    "affine-quarter": "momentum-spreads",
    "affine-three-quarters": "velocity-gradient-scaled affine-matrix-scaled",
    "affine-moment-of-other-basis": "affine-matrix-scaled",
    "affine-offset-sign": "affine-matrix-scaled",
    "affine-offset-of-cells": "affine-matrix-scaled",
    "affine-force-without-moment": "stress-scaled mass-or-volume-scaled",
    "affine-of-the-last-axis-dropped": "affine-matrix-scaled",
    "stress-from-right-tensor": "stress-not-objective",
    "stress-second-piola": "stress-at-finite-strain",
    "stress-first-piola": "stress-at-finite-strain",
    "stress-kirchhoff": "stress-not-cauchy",
    "stress-log-without-j": "stress-at-finite-strain",
    "stress-log10": "stress-at-finite-strain law-differs",
    "stress-shear-of-full-left-tensor": "stress-at-finite-strain stress-at-rest",
    "stress-sign": "stress-sign",
    "stress-updated-twice": "stress-scaled",
    "strain-halved": "velocity-gradient-scaled stress-scaled",
    "strain-from-old-velocity": "vibration-grows",
    "strain-diagonal-only": "shear-missing",
    "shear-engineering": "shear-doubled",
    "lame-exchanged": "lame-parameters-exchanged",
    "lame-plane-stress": "plane-stress",
    "lame-bulk-modulus": "bulk-modulus-for-lambda",
    "lame-bulk-with-plane-deviator": "plane-deviator",
    "lame-poisson-ignored": "poisson-ratio-ignored",
    "lame-poisson-ignored-in-one-dimension": "poisson-ratio-ignored",
    "lame-shear-modulus-without-two": "mu-doubled",
    "jaumann-term-sign": "stress-at-finite-strain",
    "soil-without-yield": "soil-does-not-yield",
    "soil-pressure-sign": "soil-yield-surface",
    "soil-of-the-outer-cone": "soil-yield-surface",
    "soil-associated": "soil-flow-direction",
    "soil-radial-return": "soil-flow-direction",
    "soil-without-apex": "soil-apex",
    "soil-angle-in-radians": "soil-yield-surface",
    "soil-dilation-of-friction": "soil-flow-direction",
    "soil-without-edges": "soil-edge",
    "soil-wrong-edge": "soil-edge",
    "soil-without-apex-of-edges": "soil-apex",
    "soil-in-reference-axes": "soil-not-objective",
    "soil-half-return": "soil-depends-on-steps",
    "soil-strength-without-cosine": "soil-yield-surface soil-apex",
    "modulus-of-the-second-law": "law-scaled",
    "modulus-of-the-second-law-near-j": "law-scaled",
    "lame-exchanged-in-the-second-law": "law-differs",
    "soil-apex-needs-dilation": "soil-apex",
    "soil-softens": "soil-yield-surface",
    "soil-friction-of-rounded-angle": "soil-yield-surface",
    "soil-keeps-middle-stress": "soil-middle-stress",
    "j2-without-hardening": "j2-without-hardening",
    "j2-wrong-radius": "j2-yield-radius j2-return",
    "j2-hardening-reset": "j2-not-accumulated",
    "j2-hardening-multiplier": "j2-not-accumulated",
    "fluid-volume-ratio-inverted": "equation-of-state",
    "fluid-linear-in-density": "equation-of-state",
    "fluid-viscosity-halved": "viscous-stress",
    "plate-in-plane-strain": "plane-strain",
    "plate-lambda-halved": "plane-stress-differs",
    "load-not-ramped": "load-not-ramped",
    "load-added-in-each-step": "load-per-step",
    "load-counted-from-zero": "load-one-step-late",
    "initial-stress-of-the-first-particle": "initial-stress-uniform",
    "initial-f-of-the-mean": "initial-stress-uniform",
    "initial-stress-in-reverse-order": "initial-stress-gradient",
    "soil-pyramid-apex-needs-dilation": "soil-apex",
    "volume-not-updated": "volume-at-finite-strain",
    "volume-updated-twice": "volume-at-finite-strain",
    "volume-divided-by-j": "volume-at-finite-strain",
    "f-multiplied-from-the-right": "deformation-gradient-update",
    "f-additive": "deformation-gradient-update",
    "f-without-rotation": "deformation-gradient-column",
    "f-from-transposed-gradient": "deformation-gradient-transposed",
    "f-not-updated-by-rate-law": "deformation-gradient-column",
    "j-limited": "stress-at-finite-strain",
    "no-tension": "tension-differs",
    "bulk-viscosity": "viscosity",
    "mass-one-particle-more": "mass-or-volume-scaled",
    "mass-times-ten": "mass-or-volume-scaled",
    "mass-without-density": "mass-or-volume-scaled",
    "mass-density-twice": "mass-or-volume-scaled",
    "mass-from-deformed-volume": "force-of-deformed-body",
    "mass-from-present-volume": "mass-at-finite-strain",
    "mass-divided-by-j": "mass-at-finite-strain force-of-deformed-body",
    "mass-times-j-squared": "mass-at-finite-strain",
    "initial-lateral-stress-from-poisson": "initial-stress-components",
    "initial-shear-stress-dropped": "initial-stress-components",
    "initial-stress-isotropic": "initial-stress-components",
    "volume-of-the-cell": "mass-or-volume-scaled",
    "volume-of-two-per-axis": "mass-or-volume-scaled",
    "initial-stress-dropped": "initial-stress-dropped",
    "initial-f-dropped": "initial-deformation-dropped",
    "initial-displacement-dropped": "initial-displacement-ignored",
    "initial-velocity-dropped": "initial-velocity-dropped",
    "initial-velocity-uniform": "initial-velocity-dropped",
    "initial-f-transposed": "initial-deformation-transposed",
    "initial-vectors-component-wise": "vectors-in-another-layout",
    "reference-volume-of-deformed-body": "force-of-deformed-body",
    "random-seeding": "stress-at-rest",
    "own-seeding": "displaced-from-the-start",
    "origin-ignored": "does-not-get-through",
    "square-grid-assumed": "does-not-get-through",
    "gradient-per-cell": "velocity-gradient-scaled stress-scaled mass-or-volume-scaled",
    "gradient-of-one-axis": "velocity-gradient-scaled stress-scaled mass-or-volume-scaled",
    "gradient-third-axis-copied": "stress-not-symmetric",
    "gradient-half-cell-off": "gradients-do-not-sum-to-zero",
    "weights-truncated": "weights-do-not-sum-to-one",
    "weights-of-rounded-cell": "light-nodes-left-out weights-do-not-sum-to-one",
    "weights-typo": "weights-do-not-sum-to-one",
    "cells-found-once-per-message": "steps-depend-on-messages",
    "mass-of-the-first-step": "weights-do-not-sum-to-one",
    "mass-threshold-absolute": "light-nodes-left-out depends-on-units",
    "mass-threshold-relative": "light-nodes-left-out",
    "mass-regularised": "weights-do-not-sum-to-one",
    "sums-lose-duplicates": "momentum-lost",
    "sums-race": "another-way-each-time",
    "periodic-seam-open": "periodic-axis",
    "restart-kick": "steps-depend-on-messages",
    "time-restarts": "steps-depend-on-messages",
    "f-restarts": "steps-depend-on-messages",
    "stress-restarts": "steps-depend-on-messages",
    "velocity-reset-to-grid": "steps-depend-on-messages",
    "steps-one-short": "steps-depend-on-messages",
    "steps-one-more": "steps-depend-on-messages",
    "time-step-of-its-own": "steps-depend-on-messages own-step",
    "start-kick-sign": "velocity-of-another-time",
    "start-whole-step-back": "velocity-of-another-time",
    "flip-without-increments": "gravity-scaled",
    "pic-part-before-update": "gravity-scaled",
    "damping-left-on": "speed-lost-each-step drag",
    "damping-local-left-on": "gravity-scaled",
    "acceleration-of-the-last-step": "velocity-of-another-time force-of-an-earlier-state",
    "output-displacement-single": "single-precision",
    "output-six-digits": "single-precision",
    "single-precision": "single-precision",
    "single-precision-grid": "single-precision",
    "output-position": "positions-for-displacements",
    "output-displacement-from-start": "initial-displacement-ignored",
    "output-other-order": "force-of-other-points",
    "output-stress-other-order": "stress-column",
    "output-points-in-other-order": "force-of-other-points",
    "output-weights-of-nodes-not-halved": "weights-of-points",
    "output-weights-one": "weights-of-points",
    "output-weights-are-masses": "weights-of-points",
    "output-component-wise": "vectors-in-another-layout",
    "output-velocity-of-last-step": "velocity-of-another-time",
    "output-velocity-in-cells": "velocity-scaled",
    "output-displacement-in-millimetres": "displacement-scaled",
    "output-stress-in-kilopascal": "stress-column",
    "output-pressure-sign": "stress-column",
    "output-stress-voigt": "stress-column",
    "output-stress-deviator": "stress-column",
    "output-stress-one-step-late": "stress-at-finite-strain stress-column",
    "output-stress-first-piola": "stress-at-finite-strain",
    "output-f-transposed": "deformation-gradient-transposed",
    "output-f-minus-one": "deformation-gradient-column",
    "output-f-inverse": "deformation-gradient-column",
    "total-gradients-not-pushed-forward": "stress-at-finite-strain force-of-deformed-body",
    "total-first-piola-transposed": "stress-at-finite-strain stress-not-objective force-of-deformed-body",
    "total-volume-current": "volume-at-finite-strain",
    "total-last-substep-missing": "steps-depend-on-messages",
    "total-substeps-of-full-length": "displacement-scaled",
    "total-force-of-the-step-start": "force-of-another-time",
    "total-verlet-force-of-the-old-time": "force-of-another-time force-shifted-in-time",
    "total-verlet-force-before-positions": "vibration-grows force-of-an-earlier-state",
    "total-sample-weights-of-one-particle": "weights-of-points",
    "total-offset-subtracted-twice": "displaced-from-the-start",
    "total-f-from-transposed-gradient": "deformation-gradient-transposed",
    "total-hencky-in-reference-axes": "stress-not-objective",
    "total-wall-one-node-inside": "wall-force",
    "total-starts-undeformed": "initial-deformation-dropped",
}

# Fault -> further names whose text gives the direction, but not the cause.
HALF = {
    "j2-without-hardening": "j2-not-accumulated",
    "position-from-mean-velocity": "hourglass-mode",
    "step-cut-at-the-start": "start-half-a-step-off",
    "wall-functions-cut": "wall-velocity-missing",
}
# A run that does not end is quoted without a cause.
WITHOUT_CAUSE = frozenset({"silent", "does-not-get-through"})

# Fault -> why `doctor` does not name it.
UNNAMED = {
    "j2-without-hardening": "the yield stress is right at first yield, and falls behind afterwards",
    "soil-keeps-middle-stress": "in plane strain the middle stress is out of the plane, and shows later as a strength "
                                "that differs by 1 %",
    "total-force-of-the-step-start": "the force of the start of a step is what explicit schemes use; the order in time "
                                     "of `ramped-load` shows it",
    "volume-change-of-one-particle": "volume changes differ within a cell only next to a wall under gravity; `diagnose` "
                                     "names the number of particles",
    "position-from-mean-velocity-2": "with quadratic functions and USL, the mean of the old and the new velocity is a "
                                     "consistent update of smooth motions; the alternating mode shows it",
    "step-cut-at-the-start": "after a first step of half the length, all positions are half a step behind",
    "wall-functions-cut": "the second row of nodes of a wall, which is held, does not get the velocity of the wall",
    "affine-offset-of-cells": "a particle is inverted within six steps, so that the client stops in the first examination",
    "gradient-half-cell-off": "a particle is inverted at finite strain, so that the client stops; small strains are right",
}


def variants(fault):
    """A fault for each of its settings."""
    fault.expected = frozenset(EXPECTED[fault.name].split())
    fault.half = WITHOUT_CAUSE | frozenset(HALF.get(fault.name, "").split())
    if isinstance(fault.settings, str):
        return [fault]
    names = [fault.name, *(f"{fault.name}-{k}" for k in range(2, len(fault.settings) + 1))]
    return [Fault(**{**vars(fault), "name": name, "settings": settings})
            for name, settings in zip(names, fault.settings)]


FAMILIES = {"positions": POSITIONS, "loads": LOADS, "walls": WALLS, "loads and walls with values": SURFACES,
            "several bodies": BODIES, "elements": ELEMENTS, "affine transfer": AFFINE, "materials": MATERIALS, "soils": SOILS,
            "further laws": FURTHER_LAWS, "load steps": LOAD_STEPS,
            "initial state": INITIAL, "grid and basis": GRID, "time": TIME, "output": OUTPUT,
            "reference configuration": TOTAL_LAGRANGIAN}
FAULTS = {fault.name: fault for family in FAMILIES.values() for each in family for fault in variants(each)}

# Faults that fail none of the suites of `ci/doctor --gate`, and why.
UNDETECTED = {
    "j2-without-hardening": "the suite with hardening, `plastic-bar-hardening`, has three levels and no bound for any "
                            "method",
    "soil-keeps-middle-stress": "no suite that is gated depends on the middle stress",
    "displacement-wrapped": "no particle passes a periodic face where displacements are judged",
    "displacement-wrapped-2": "no particle passes a periodic face where displacements are judged",
    "gravity-after-walls-3":
        "a scheme that starts at t = 0 has order 1 in the suites with gravity and a wall, with and without this "
        "fault",
    "stress-log-without-j":
        "classical MPM with linear functions passes the suites that show this by a bound, which is above this error",
    "stress-log10":
        "classical MPM with linear functions passes the suites that show this by a bound, which is above this error",
    "lame-poisson-ignored-in-one-dimension": "these suites in one dimension have Poisson's ratio 0",
    "lame-poisson-ignored-in-one-dimension-2":
        "these suites in one dimension have Poisson's ratio 0; `geostatic-column-moving` and "
        "`mms-axis-aligned-1d` detect it",
    "volume-updated-twice":
        "classical MPM with linear functions passes the suites that show this by a bound, which is above this error",
    "f-not-updated-by-rate-law": "no suite judges F with a law in rate form",
    "j-limited": "strains of these suites are within the limits, except for one that classical MPM passes by a bound",
    "mass-from-deformed-volume": "bodies that start deformed have small strains in these suites",
    "initial-f-transposed": "no body of these suites starts with an F that is not symmetric",
    "reference-volume-of-deformed-body": "bodies that start deformed have small strains in these suites",
    "square-grid-assumed": "no node beyond the number of the first axis is needed in these suites",
    "gradient-third-axis-copied": "these suites have no problem in three dimensions",
    "jaumann-term-sign": "the suites with large rotations have laws of F",
    "jaumann-term-sign-2": "the suites with large rotations have laws of F",
    "mass-threshold-relative": "no particle reaches a node by less than 1e-12 of a cell, other than by rounding",
    "mass-threshold-relative-2": "no particle reaches a node by less than 1e-12 of a cell, other than by rounding",
    "output-stress-other-order":
        "the stress is the same at all points where it is judged, or classical MPM passes by a bound",
    "output-velocity-of-last-step":
        "one step changes the velocities by less than the error of the suite that judges them",
    "output-stress-one-step-late": "one step changes the stress by less than the error of linear functions",
}

# Solvers that differ from the definitions of the protocol and are sound.
VARIATIONS = {variation.name: variation for variation in [
    Fault("jaumann-rate",
          "Integrates linear elasticity with the Jaumann rate.",
          "another definition of the law",
          patch="""
              def rate(self, step):
                  spin = 0.5 * (step - step.transpose(0, 2, 1))
                  turned = spin @ self.sigma - self.sigma @ spin
                  super().rate(step)
                  self.sigma += turned
          """, source="a reader of the guide"),
]}

# Mistakes in derivatives: the states are sound, and so are all suites without gradients.
GRADIENT_FAULTS = {fault.name: fault for fault in [
    Fault("gradient-stress-detached",
          "Detaches the stress from the derivatives before it enters the force.",
          "derivatives do not pass through the stress",
          "--gradient",
          patch="""
              def acceleration(self, time, dt):
                  sigma, self.sigma = self.sigma, part(self.sigma)
                  field = super().acceleration(time, dt)
                  self.sigma = sigma
                  return field
          """),
    Fault("gradient-mass-detached",
          "Detaches the nodal mass from the derivatives.",
          "derivatives do not pass through the nodal mass",
          "--gradient",
          patch="""
              def weigh(self):
                  super().weigh()
                  self.mass = part(self.mass)
          """),
    Fault("gradient-of-velocity-only",
          "Differentiates with respect to the initial velocity only, and reports 0 for the rest.",
          "parameters of the material have no derivative",
          "--gradient",
          patch="""
              def seed(self, names):
                  super().seed([name if name == "initial_velocity" else "" for name in names])
          """),
    Fault("gradient-doubled",
          "Differentiates the square of a norm and forgets the factor 1/2.",
          "derivatives are twice the correct ones",
          "--gradient",
          patch="""
              def differentiate(self, *arguments):
                  value, slopes = super().differentiate(*arguments)
                  return value, [2 * slope for slope in slopes]
          """),
    Fault("gradient-in-another-order",
          "Sorts the parameters by name and reports the derivatives in that order.",
          "derivatives belong to other parameters",
          "--gradient",
          patch="""
              def differentiate(self, of, names, steps, dt):
                  return super().differentiate(of, sorted(names), steps, dt)
          """),
    Fault("gradient-positions-detached",
          "Detaches the positions from the derivatives before it computes functions and gradients.",
          "derivatives do not pass through the positions",
          "--gradient",
          patch="""
              def locate(self):
                  super().locate()
                  self.s = part(self.s)
          """),
    Fault("gradient-not-cleared",
          "Adds the derivatives of all earlier parameters, because it does not clear them.",
          "derivatives are not cleared between parameters",
          "--gradient",
          patch="""
              def differentiate(self, *arguments):
                  value, slopes = super().differentiate(*arguments)
                  return value, np.cumsum(slopes).tolist()
          """),
    Fault("gradient-in-single-precision",
          "Stores derivatives in single precision.",
          "single-precision",
          "--gradient",
          patch="""
              def differentiate(self, *arguments):
                  value, slopes = super().differentiate(*arguments)
                  return value, [np.float32(slope) for slope in slopes]
          """),
    Fault("gradient-not-a-number",
          "Divides zero by zero in one derivative.",
          "the derivative with respect to density is nan",
          "--gradient",
          patch="""
              def differentiate(self, of, names, steps, dt):
                  value, slopes = super().differentiate(of, names, steps, dt)
                  return value, [np.nan if name == "density" else x for name, x in zip(names, slopes)]
          """),
    Fault("gradient-one-step-short",
          "Differentiates the state before the last step.",
          "value and derivatives belong to an earlier time",
          "--gradient",
          patch="""
              def differentiate(self, of, names, steps, dt):
                  return super().differentiate(of, names, steps - 1, dt)
          """),
]}

# Mistakes in the masses of a body whose density varies: all suites of bodies with a uniform density are sound.
DENSITY_FAULTS = {fault.name: fault for fault in [
    Fault("density-largest",
          "Multiplies volumes by the density of the material, which is the largest of the body.",
          "the density does not vary",
          edits={MASS: 'self.m, self.vol = problem.materials[0]["density"] * problem.reference_volume, problem.volume.copy()'}),
    Fault("density-at-centres",
          "Multiplies volumes by the density at the centre of each particle.",
          "masses are not integrals of the density: particles at a rim without density are too light or too heavy",
          patch="""
              def setup(self, problem):
                  text = problem.materials[0]["varying_density"].replace("^", "**")
                  place = dict(zip("XYZ", problem.reference_position.T))
                  names = {"A": 1.0, "rho": 1e3, "sqrt": np.sqrt, "max": np.maximum, **place}
                  problem.mass = eval(text, names) * problem.reference_volume
                  super().setup(problem)
          """),
]}
