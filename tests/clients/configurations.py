"""Sound configurations of the clients: `mpm-verify doctor` must report no defect in any of them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

BASES = ["linear", "quadratic_bspline", "cubic_bspline"]
SCHEMES = ["usl", "musl"]
STARTS = ["at_zero", "half_step_back"]
BLENDS = [1.0, 0.95, 0.0]
NUMPY = ["{python}", "examples/solvers/numpy_mpm.py"]
APIC = ["{python}", "tests/clients/apic_mpm.py"]
VARIANT = ["{python}", "tests/clients/variant.py"]
LAWS = {"soils": ["drucker_prager", "mohr_coulomb"], "metal-and-fluids": ["j2", "newtonian", "linear_fluid", "polytropic"]}


@dataclass
class Configuration:
    """A command line; {python}, {cpp} and {fortran} stand for programs that `ci/doctor` finds or builds."""

    family: str
    name: str
    command: list[str]
    # Whether theory gives displacements of the order 2 that the client claims. A share of PIC diffuses momentum,
    # and the start at t = 0 costs an order in time.
    is_second_order: bool


def points_options(kind):
    return ["--points", kind] if kind else []


def numpy_configurations(kind, blends, starts=tuple(STARTS)):
    family = f"NumPy client, points: {kind or 'none'}"
    for basis, scheme, start, flip in itertools.product(BASES, SCHEMES, starts, blends):
        options = ["--basis", basis, "--scheme", scheme, "--start", start, "--flip", str(flip)]
        name = "-".join(["numpy", basis, scheme, start, f"flip-{flip}", *([kind] if kind else [])])
        command = [*VARIANT, *points_options(kind), *options] if kind else [*NUMPY, *options]
        yield Configuration(family, name, command, flip == 1.0 and start == "half_step_back")


def apic_configurations():
    for basis, gradient, start, kind in itertools.product(
            BASES[1:], ["basis", "affine"], STARTS, ["", "particles", "shuffled", "nodes"]):
        options = ["--basis", basis, "--gradient", gradient, "--start", start]
        name = "-".join(["apic", basis, gradient, start, *([kind] if kind else [])])
        command = [*VARIANT, "--client", "apic", *points_options(kind), *options] if kind else [*APIC, *options]
        yield Configuration("APIC client", name, command, start == "half_step_back")


def jaumann_configurations():
    for basis, scheme in itertools.product(BASES, SCHEMES):
        yield Configuration("NumPy client with the Jaumann rate", f"jaumann-{basis}-{scheme}",
                            [*VARIANT, "--fault", "jaumann-rate", "--basis", basis, "--scheme", scheme], False)


def shifted_configurations():
    for basis, scheme, start in itertools.product(BASES, SCHEMES, STARTS):
        options = ["--basis", basis, "--scheme", scheme, "--start", start]
        for shift in ["1000"] if basis == "linear" else ["1000", "1e5"]:
            yield Configuration("NumPy client with an offset of positions", f"shift-{shift}-{basis}-{scheme}-{start}",
                                [*VARIANT, "--shift", shift, *options], False)


def sph_configurations():
    """Images of the particles complete the kernels at walls."""
    for radius, kind in itertools.product(range(15, 25), ["", "particles", "shuffled"]):
        name = "-".join(["sph", f"{radius / 10}", *([kind] if kind else [])])
        yield Configuration("SPH with images at walls", name,
                            [*VARIANT, "--client", "sph", *points_options(kind), "--radius", f"{radius / 10}"], False)


def total_lagrangian_configurations():
    client = [*VARIANT, "--client", "total_lagrangian"]
    for domain, grid, scheme in itertools.product(["particle", "cell"], ["body", "problem"],
                                                  ["leapfrog", "verlet", "euler"]):
        name, options = f"{domain}-{grid}-{scheme}", ["--domain", domain, "--grid", grid, "--scheme", scheme]
        more = {"": [], "-small-strain": ["--laws", "small_strain"]}
        if grid == "body":
            more |= {f"-sample-{n}": ["--sample", n] for n in "23"}
        if scheme != "euler":
            more |= {f"-offset-{offset}": ["--offset", offset] for offset in ["1000", "1e5"]}
        for suffix, each in more.items():
            # Nodes of the problem's grid have less mass where a body ends in a cell.
            yield Configuration("total Lagrangian GIMP", f"total-{name}{suffix}", [*client, *each, *options],
                                not suffix and (domain, grid) == ("particle", "body") and scheme != "euler")
    for scheme, steps in itertools.product(["leapfrog", "verlet", "euler"], "235"):
        yield Configuration("total Lagrangian GIMP", f"total-{scheme}-substeps-{steps}",
                            [*client, "--scheme", scheme, "--parts", steps], scheme != "euler")


def substep_configurations():
    for basis, scheme, start, steps in itertools.product(BASES, SCHEMES, STARTS, ["2", "3", "5"]):
        options = ["--substeps", steps, "--basis", basis, "--scheme", scheme, "--start", start]
        yield Configuration("NumPy client with sub-steps", f"substeps-{steps}-{basis}-{scheme}-{start}",
                            [*VARIANT, *options], start == "half_step_back")
    for start, steps in itertools.product(STARTS, ["4", "10", "2,3,5", "0.3+0.7"]):
        yield Configuration("NumPy client with sub-steps", f"substeps-{steps}-quadratic_bspline-usl-{start}",
                            [*VARIANT, "--substeps", steps, "--basis", BASES[1], "--start", start], False)
    for basis, start, steps in itertools.product(BASES[1:], STARTS, ["2", "3", "5"]):
        options = ["--substeps", steps, "--basis", basis, "--start", start]
        yield Configuration("APIC client with sub-steps", f"apic-substeps-{steps}-{basis}-{start}",
                            [*VARIANT, "--client", "apic", *options], start == "half_step_back")
    for flip, steps in itertools.product(BLENDS[1:], "235"):
        yield Configuration("NumPy client with sub-steps", f"substeps-{steps}-quadratic_bspline-usl-flip-{flip}",
                            [*VARIANT, "--substeps", steps, "--basis", BASES[1], "--flip", str(flip)], False)


def cpp_configurations():
    for basis, scheme, start in itertools.product(BASES, SCHEMES, STARTS):
        yield Configuration("C++ client", f"cpp-{basis}-{scheme}-{start}",
                            ["{cpp}", "--basis", basis, "--scheme", scheme, "--start", start],
                            start == "half_step_back")


def other_configurations():
    for basis, start in itertools.product(BASES, STARTS):
        yield Configuration("Client for several bodies", f"several-bodies-{basis}-{start}",
                            ["{python}", "tests/clients/several_bodies.py", "--basis", basis, "--start", start], False)
    yield Configuration("FEM client", "fem", ["{python}", "tests/clients/fem.py"], False)


def small_strain_configurations():
    fem = [*VARIANT, "--client", "small-fem"]
    sph = [*VARIANT, "--client", "sph", "--laws", "small_strain", "--radius"]
    for name, command in [("small-fem-points", fem), ("small-fem-nodes", [*fem, "--at", "nodes"]),
                          ("small-sph-1.6", [*sph, "1.6"]), ("small-sph-1.8", [*sph, "1.8"])]:
        yield Configuration("Small strains", name, command, True)


def law_configurations():
    laws = [*VARIANT, "--client", "laws"]
    for form, basis in itertools.product(["finite", "rate"], BASES[:2]):
        for family, names in LAWS.items():
            yield Configuration(f"Further laws, {form} form", f"laws-{family}-{form}-{basis}",
                                [*laws, "--laws", "linear_elastic", *names, "--basis", basis, "--form", form], False)
    for name, options in {"pic": ["--flip", "0.0"], "blend": ["--flip", "0.95", "--basis", BASES[2]],
                          "rate-musl": ["--form", "rate", "--scheme", "musl"],
                          "half-step-back": ["--start", "half_step_back", "--scheme", "usl"]}.items():
        yield Configuration("Further laws, all", f"laws-{name}", [*laws, *options], False)
    yield Configuration("Small strains", "small-fem-plates", [*VARIANT, "--client", "small-fem", "--plates"], True)
    for dimension, at in itertools.product("12", ["nodes", "points"]):
        yield Configuration("Load steps only", f"load-steps-{dimension}-{at}",
                            [*VARIANT, "--client", "load_steps", "--dimension", dimension, "--at", at], False)


def sample_configurations():
    for basis, kind, scheme in itertools.product(BASES, ["every-second", "every-third"], SCHEMES):
        yield Configuration("Points that are a sample", f"numpy-{basis}-{scheme}-{kind}",
                            [*VARIANT, "--points", kind, "--basis", basis, "--scheme", scheme], False)


CONFIGURATIONS = [
    *other_configurations(),
    *numpy_configurations("", BLENDS),
    *numpy_configurations("particles", [1.0, 0.95]),
    *numpy_configurations("shuffled", [1.0, 0.0]),
    *numpy_configurations("nodes", [1.0, 0.95]),
    *apic_configurations(),
    *jaumann_configurations(),
    *shifted_configurations(),
    *sph_configurations(),
    *total_lagrangian_configurations(),
    *substep_configurations(),
    *cpp_configurations(),
    *small_strain_configurations(),
    *sample_configurations(),
    *law_configurations(),
    Configuration("Fortran client", "fortran", ["{fortran}"], False),
]
CONFIGURATIONS = {configuration.name: configuration for configuration in CONFIGURATIONS}
