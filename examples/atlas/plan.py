"""The suites and settings of each code."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

HERE = Path(__file__).resolve().parent

PLANE = ["translating-block", "falling-block", "free-bar-pulse", "free-bar-pulse-small",
         "moving-bar-pulse", "square-between-rollers", "mms-axis-aligned-2d"]
SPACE = ["translating-block-3d", "falling-block-3d", "free-bar-pulse-3d", "free-bar-pulse-small-3d",
         "free-bar-pulse-hencky-3d", "moving-bar-pulse-3d", "moving-bar-pulse-small-3d",
         "moving-bar-pulse-hencky-3d"]
SUITES = PLANE + SPACE
# For codes whose points keep their neighbours: finite elements and total-Lagrangian SPH.
LAGRANGIAN = ["translating-block", "falling-block", "free-bar-pulse", "free-bar-pulse-small",
              "moving-bar-pulse", "square-between-rollers", "shear-wave", "mms-axis-aligned-2d",
              "vibrating-bar", "vibrating-bar-small-amplitude", "free-bar-second-mode",
              "released-bar", "mms-fixed-bar-small", "mms-periodic-bar-sin",
              "mms-periodic-bar-cos", "free-bar-pulse-small-3d", "mms-axis-aligned-3d",
              "two-shears-nearly-incompressible", "lame-square",
              "lame-square-nearly-incompressible", "lame-block",
              "lame-block-nearly-incompressible"]
# Bodies with free faces only.
FREE_2D = ["lame-square", "lame-square-shifted", "lame-square-rotated",
           "lame-square-nearly-incompressible", "translating-body"]
FREE_3D = ["lame-block", "lame-block-shifted", "lame-block-nearly-incompressible"]
FREE = FREE_2D + FREE_3D
# Times (s) at which the runs of these small suites end. A gap of 3 cells closes with one cell per second.
GAPS = {"narrow-gap": [0.2, 0.3, 1.2, 1.3, 1.95, 2.05, 2.2, 2.3],
        "narrow-gap-3d": [1.2, 1.3, 2.2, 2.3]}
# For the MPM clients of this repository: locking and gases.
EXACT = ["two-shears-nearly-incompressible", "mms-graded-bar", "gas-cloud", "gas-cloud-2d",
         "gas-cloud-3d", "spinning-cloud", "spinning-cloud-radius"]

# Own methods for comparison with the codes, by the names of their cases.
OWN = {
    "mpm-linear-flip-usl": "linear, FLIP",
    "mpm-linear-flip-usl-at-zero": "linear, FLIP",
    "mpm-linear-flip-usl-half-step-back": "linear, FLIP",
    "mpm-linear-flip-musl-half-step-back": "linear, FLIP",
    "mpm-linear-flip-musl": "linear, FLIP",
    "mpm-quadratic-bspline-flip-musl": "quadratic, FLIP",
    "mpm-quadratic-bspline-flip-usl": "quadratic, FLIP",
    "mpm-quadratic-bspline-flip-usl-at-zero": "quadratic, FLIP",
    "mpm-quadratic-bspline-apic-usl": "quadratic, APIC",
    "mpm-quadratic-bspline-apic-usl-at-zero": "quadratic, APIC",
}

# Own methods in the table of the suites EXACT.
OWN_EXACT = {
    "mpm-linear-flip-musl": "linear",
    "mpm-linear-flip-musl-particle": "linear",
    "mpm-linear-flip-musl-averaged": "linear, averaged",
    "mpm-quadratic-bspline-flip-musl": "quadratic",
    "mpm-cubic-bspline-flip-musl": "cubic",
}

# Own methods in the table of the suites FREE.
OWN_FREE = {
    "mpm-linear-flip-usl": "linear, FLIP",
    "mpm-linear-flip-musl": "linear, FLIP",
    "mpm-linear-flip-musl-particle": "linear, FLIP",
    "mpm-linear-apic-usl": "linear, APIC",
    "mpm-quadratic-bspline-flip-usl": "quadratic, FLIP",
    "mpm-quadratic-bspline-apic-usl": "quadratic, APIC",
}


def own_cases(suite: str) -> dict[str, str]:
    """The own methods that are compared on a suite."""
    return OWN_EXACT if suite in EXACT else OWN_FREE if suite in FREE else OWN


def is_gradient(suite: str) -> bool:
    """Whether the suite verifies derivatives."""
    return suite.startswith("gradient-")


def is_rigid(suite: str) -> bool:
    """Whether nothing deforms, so that codes do not need the law."""
    return suite.startswith(("translating-block", "falling-block"))


@cache
def packages() -> dict[str, dict[str, str]]:
    """The packages of each release of each code, oldest first."""
    found: dict[str, dict[str, str]] = {}
    for line in (HERE / "releases.txt").read_text().splitlines():
        if not line.startswith("#"):
            code, release, wanted = line.split(maxsplit=2)
            found.setdefault(code, {})[release] = wanted
    return found


@dataclass
class Run:
    """One code with some settings on one suite, whose text is edited by `changes`."""

    suite: str
    variant: str
    arguments: list[str]
    changes: dict[str, str]


@dataclass
class Code:
    """A public code: variants that run on all suites of its dimensions, and further runs that isolate a
    cause, each with its suites; some edit the text of these."""

    name: str  # of the adapter, in releases.txt, and of a Cargo project
    label: str
    suites: list[str]
    variants: dict[str, list[str]]
    further: dict[str, tuple[list[str], list[str]]] = field(default_factory=dict)
    changes: dict[str, dict[str, str]] = field(default_factory=dict)
    crate: str | None = None
    adapter: str | None = None  # path from this folder, if it differs from the name; C++ is compiled
    takes_any_law: bool = True  # option `--any-law` for suites in which nothing deforms
    # Small runs of all releases: the suites (a key of PANELS), further modes of the newest release, and
    # the basis functions.
    panel: str = ""
    modes: dict[str, list[str]] = field(default_factory=dict)
    basis: str = "quadratic"
    examined: list[str] = field(default_factory=list)  # options for `doctor`
    about: str = ""  # dimensions and functions
    reports: dict[str, str] = field(default_factory=dict)  # texts in reports/, by the finding
    implicit: bool = False

    @property
    def title(self) -> str:
        """The label with the newest release."""
        newest = [*packages().get(self.name, {"here": ""})][-1]
        return self.label if newest == "here" else f"{self.label} {newest}"

    def runs(self) -> list[Run]:
        asked = [(suite, variant, arguments) for variant, arguments in self.variants.items()
                 for suite in self.suites]
        asked += [(suite, variant, arguments)
                  for variant, (arguments, suites) in self.further.items() for suite in suites]
        rigid = {True: ["--any-law"], False: []}
        return [Run(suite, variant, arguments + rigid[self.takes_any_law and is_rigid(suite)],
                    self.changes.get(variant, {}))
                for suite, variant, arguments in asked]


# Moves the lattice of particles off the cell faces by about a tenth of a cell. The offset is not exactly 0.1 of
# a cell, from which whole steps of 0.06 of a cell would lead to a face later.
OFF_FACES = {"grid: {from: [0, 0.375, 0.375], to: [1, 0.625, 0.625]}":
             "grid: {from: [0, 0.3723, 0.3723], to: [1, 0.6223, 0.6223]}"}

# A time step proportional to h, for a suite with one time step for all levels.
DT_AS_H = {"dt: 1e-3": 'dt: "0.2*h/sqrt(E/rho)"'}

CODES = [
    Code("kratos", "Kratos MPM", SUITES, {"USL": ["--scheme", "usl"]}, {
        "central difference": (["--scheme", "central_difference"],
                               ["falling-block", "free-bar-pulse-small", "square-between-rollers"]),
        "MUSL": (["--scheme", "musl"], ["free-bar-pulse-small", "mms-axis-aligned-2d",
                                        "free-bar-pulse-small-3d"]),
        "off faces": (["--scheme", "usl"], ["free-bar-pulse-small-3d",
                                            "moving-bar-pulse-small-3d"]),
        "MUSL, off faces": (["--scheme", "musl"], ["free-bar-pulse-small-3d"]),
    }, {"off faces": OFF_FACES, "MUSL, off faces": OFF_FACES}, panel="plane", basis="linear",
        about="2-D, 3-D; linear; walls",
        reports={"depends-on-units": "kratos-small-masses", "`narrow-gap` fails": "kratos-search-tolerance",
                 "ImportError": "kratos-missing-library"},
        modes={"MUSL": ["--scheme", "musl"], "central difference": ["--scheme", "central_difference"],
               "Newmark": ["--scheme", "newmark"], "Bossak": ["--scheme", "bossak"]}),
    Code("mpm99", "taichi mpm99", PLANE + FREE_2D,
         {"f32": ["--precision", "f32"], "f64": ["--precision", "f64"]}, panel="plane",
         about="2-D; quadratic; no walls", examined=["--gravity", "off"], further={
             f"f64, {title}": (["--precision", "f64", "--derivatives", option],
                               ["gradient-free-bar-pulse"])
             for option, title in [("tape", "tape"), ("checked", "tape with checks")]}),
    Code("torch_mpm", "mpm-pytorch", [*SPACE, *FREE_3D, "gradient-free-bar-pulse-3d"], {"f32": []}, {
        "f64": (["--precision", "f64"], ["translating-block-3d", "free-bar-pulse-hencky-3d",
                                         "moving-bar-pulse-3d", "moving-bar-pulse-hencky-3d",
                                         "free-bar-pulse-small-3d", "moving-bar-pulse-small-3d",
                                         *FREE_3D, "gradient-free-bar-pulse-3d"]),
    }, panel="space", about="3-D; quadratic; no walls", modes={"f64": ["--precision", "f64"]}),
    Code("newton_mpm", "newton", FREE_3D + SPACE, {"f32": []}, {
        "two substeps": (["--substeps", "2"], ["free-bar-pulse-hencky-3d"]),
        "dt as h^2": ([], ["free-bar-pulse-hencky-3d"]),
    }, {"dt as h^2": {'dt: "0.2*h/c"': 'dt: "6.4*h^2/c"'}}, panel="space",
        about="3-D; quadratic, or linear (before 1.1.0, Q1); friction walls", implicit=True,
        reports={"particles-on-faces": "newton-air-drag", "mass-or-volume-scaled": "newton-half-force",
                 "stress-not-cauchy": "newton-stress"}, modes={"velocities Q1, f32": ["--velocity-basis", "Q1"]}),
    Code("phyz", "phyz-particle", SPACE + FREE_3D, {"FLIP 0.95": []}, {
        "FLIP 1": (["--flip", "1"], ["translating-block-3d", "free-bar-pulse-small-3d",
                                     "lame-block"]),
        "FLIP 1, no stiffness": (["--flip", "1", "--stiffness", "0"],
                                 ["translating-block-3d", "falling-block-3d"]),
    }, crate="atlas-phyz", panel="space", about="3-D; cubic; no walls", examined=["--gravity", "off"],
        reports={"weights-do-not-sum-to-one": "phyz-particle-uniform-velocity"}),
    Code("scikit_fem", "scikit-fem", LAGRANGIAN,
         {"linear": [], "quadratic": ["--degree", "2"]}, {
             "quadrature points": (["--points", "quadrature"],
                                   ["vibrating-bar", "vibrating-bar-small-amplitude",
                                    "mms-fixed-bar-small", "mms-axis-aligned-3d"]),
             "dt as h": ([], ["vibrating-bar-small-amplitude"]),
         }, {"dt as h": DT_AS_H}, takes_any_law=False),
    Code("felupe_fem", "felupe", LAGRANGIAN,
         {"linear": [], "quadratic": ["--degree", "2"]}, takes_any_law=False),
    Code("sph", "SPH of this repository", LAGRANGIAN, {"radius 1.6": []}, {
        "radius 2.6": (["--radius", "2.6"], ["free-bar-pulse-small", "square-between-rollers",
                                             "free-bar-second-mode", "mms-axis-aligned-2d"]),
        "dt as h": ([], ["vibrating-bar-small-amplitude"]),
    }, {"dt as h": DT_AS_H}, adapter="../solvers/sph.py", takes_any_law=False),
    Code("numpy", "NumPy client", EXACT,
         {basis: ["--start", "half_step_back", "--basis", name] for basis, name in
          [("linear", "linear"), ("quadratic", "quadratic_bspline"), ("cubic", "cubic_bspline")]},
         adapter="../solvers/numpy_mpm.py", takes_any_law=False),
    Code("cpp", "C++ client", EXACT, {"linear": ["--start", "half_step_back"]},
         adapter="../solvers/cpp/mpm.cpp", takes_any_law=False),
]
