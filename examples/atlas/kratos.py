"""Kratos' MPM application: linear functions on a mesh of squares or cubes. Explicit in
time, implicit in time (`--scheme newmark` or `bossak`), or in quasi-static load steps (`static`).

Each particle is created from a separate small element, at its centre. Walls are constrained nodes,
along any axis.
"""

from __future__ import annotations

import argparse
import itertools
import json

import numpy as np
from box import Array, Cannot, Message, Problem, aside, common_material, laws, uniform
from mpm_verify import serve

with aside():
    import KratosMultiphysics as Km
    import KratosMultiphysics.MPMApplication as Mpm
    from KratosMultiphysics.MPMApplication import python_solvers_wrapper_mpm as wrapper

DYNAMIC = {"solver_type": "dynamic", "time_integration_method": "implicit"}
IMPLICIT = {"static": {"solver_type": "static"}, "newmark": {**DYNAMIC, "scheme_type": "newmark"},
            "bossak": {**DYNAMIC, "scheme_type": "bossak"}}
ELEMENTS = {2: "Element2D4N", 3: "Element3D8N"}
LAWS = {
    (2, "linear_elastic"): "LinearElasticIsotropicPlaneStrain2DLaw",
    (3, "linear_elastic"): "LinearElasticIsotropic3DLaw",
    (2, "neo_hookean"): "HyperElasticNeoHookeanPlaneStrain2DLaw",
    (3, "neo_hookean"): "HyperElasticNeoHookean3DLaw",
}
AXES = "XYZ"
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CORNERS = {2: SQUARE, 3: [(*xy, z) for z in (0, 1) for xy in SQUARE]}


class Kratos:
    name = "kratos-mpm"
    version = Km.KratosGlobals.Kernel.Version().split("-")[0].replace('"', "")

    def __init__(self, scheme: str, search: float, any_law: bool) -> None:
        self.scheme, self.search = scheme, search
        self.is_forward_euler = scheme in ("usf", "usl", "musl")
        self.capabilities = {
            "dimensions": [2, 3], "laws": laws(["linear_elastic", "neo_hookean"], any_law),
            "conditions": ["free", "fixed", "roller"], "loads": ["gravity", "body_force"],
            "manufactured": True, "load_steps": scheme == "static", "several_bodies": True}

    def setup(self, problem: Problem) -> None:
        self.problem, self.d = problem, problem.dimension
        Km.Logger.GetDefaultOutput().SetSeverity(Km.Logger.Severity.WARNING)
        model = Km.Model()
        self.solver = wrapper.CreateSolverByParameters(model, self.settings(), "OpenMP")
        self.solver.AddVariables()
        self.add_grid(model["Background_Grid"])
        self.add_body(model["Initial_MPM_Material"].CreateSubModelPart("body"))
        self.solver.PrepareModelPart()
        self.solver.AddDofs()
        self.hold(model["Background_Grid"])
        self.solver.Initialize()
        self.model, self.time = model, 0.0
        self.points = list(model["MPM_Material"].Elements)
        if len(self.points) != len(problem.position):
            raise Cannot(f"{len(self.points)} particles of {len(problem.position)} were made")
        self.give(Mpm.MP_VELOCITY, problem.velocity)
        if not self.is_forward_euler and self.scheme != "static" and problem.message["body_force"] != "none":
            self.give(Mpm.MP_ACCELERATION, problem.body_force(0.0))  # of a body without stress; Kratos starts with zero

    def settings(self) -> Km.Parameters:
        """Parameters of the solver. A load step is a unit of time."""
        existing = {"input_type": "use_input_model_part"}
        dt = 1.0 if self.scheme == "static" else self.problem.dt
        common = {"model_part_name": "MPM_Material", "domain_size": self.d, "time_stepping": {"time_step": dt},
                  "grid_model_import_settings": existing, "model_import_settings": existing,
                  "element_search_settings": {
                      "search_algorithm_type": "bin_based", "max_number_of_results": 1000,
                      "searching_tolerance": self.search, "remove_entities_not_found": True}}
        if self.scheme in IMPLICIT:
            return Km.Parameters(json.dumps(common | IMPLICIT[self.scheme] | {
                "analysis_type": "non_linear", "convergence_criterion": "residual_criterion",
                "residual_relative_tolerance": 1e-12, "residual_absolute_tolerance": 1e-12,
                "max_iteration": 50, "linear_solver_settings": {"solver_type": "skyline_lu_factorization"}}))
        central = self.scheme == "central_difference"
        return Km.Parameters(json.dumps(common | {
            "solver_type": "dynamic", "time_integration_method": "explicit", "analysis_type": "linear",
            "scheme_type": "central_difference" if central else "forward_euler",
            "stress_update": "usf" if central else self.scheme}))

    def add_grid(self, part: Km.ModelPart) -> None:
        problem, spare = self.problem, 1
        counts = [cells + 2 * spare for cells in problem.cells]
        number = {}
        for index in itertools.product(*(range(n + 1) for n in counts)):
            at = problem.origin + (np.array(index) - spare) * problem.h
            number[index] = len(number) + 1
            part.CreateNewNode(number[index], *self.in_space(at))
        properties = part.CreateNewProperties(0)
        for k, cell in enumerate(itertools.product(*map(range, counts))):
            nodes = [number[tuple(np.add(cell, corner))] for corner in CORNERS[self.d]]
            part.CreateNewElement(ELEMENTS[self.d], k + 1, nodes, properties)

    def add_body(self, part: Km.ModelPart) -> None:
        problem, material = self.problem, common_material(self.problem)
        properties = part.CreateNewProperties(1)
        law = LAWS.get((self.d, material["law"]), LAWS[self.d, "neo_hookean"])
        properties.SetValue(Km.CONSTITUTIVE_LAW, Km.KratosGlobals.GetConstitutiveLaw(law).Clone())
        properties.SetValue(Km.YOUNG_MODULUS, material["parameters"]["young"])
        properties.SetValue(Km.POISSON_RATIO, material["parameters"]["poisson"])
        properties.SetValue(Km.DENSITY, uniform("densities", problem.mass / problem.volume))
        properties.SetValue(Km.THICKNESS, 1.0)
        properties.SetValue(Mpm.MATERIAL_POINTS_PER_ELEMENT, 1)
        side, corners = uniform("volumes", problem.volume) ** (1 / self.d), CORNERS[self.d]
        for k, middle in enumerate(problem.position):
            first = len(corners) * k + 1
            for c, corner in enumerate(corners):
                place = middle + (np.array(corner) - 0.5) * side
                part.CreateNewNode(first + c, *self.in_space(place))
            nodes = list(range(first, first + len(corners)))
            part.CreateNewElement(ELEMENTS[self.d], k + 1, nodes, properties)

    def hold(self, part: Km.ModelPart) -> None:
        """Constrains the nodes on faces and beyond them."""
        for face in self.problem.faces:
            condition, axis = face["condition"], face["axis"]
            held = {"free": [], "fixed": range(self.d), "roller": [axis]}[condition]
            outwards = 1 if face["high"] else -1
            for node in part.Nodes:
                beyond = outwards * ([node.X, node.Y, node.Z][axis] - face["at"])
                if beyond > -1e-6 * self.problem.h:
                    for a in held:
                        node.Fix(getattr(Km, f"DISPLACEMENT_{AXES[a]}"))

    def in_space(self, vector: Array) -> list[float]:
        return [*map(float, vector), 0.0][:3]

    def give(self, variable: object, values: Array) -> None:
        info = self.model["MPM_Material"].ProcessInfo
        for point, value in zip(self.points, values):
            point.SetValuesOnIntegrationPoints(variable, [self.in_space(value)], info)

    def take(self, variable: object) -> Array:
        info = self.model["MPM_Material"].ProcessInfo
        values = [point.CalculateOnIntegrationPoints(variable, info)[0] for point in self.points]
        return np.array(values, float)[:, :self.d]

    def advance(self, steps: int, dt: float, time: float) -> None:
        has_force = self.problem.message["body_force"] != "none"
        start = [self.solver.InitializeSolutionStep, self.solver.Predict]
        if "_SearchElement" in self.solver.Predict.__code__.co_names:  # releases from 10.4.2 on predict first
            start.reverse()
        late = 0 if self.is_forward_euler else 1  # the others use the force at the end of a step
        for step in range(steps):
            if has_force:
                self.give(Mpm.MP_VOLUME_ACCELERATION, self.load(time + (step + late) * dt))
            self.time = self.solver.AdvanceInTime(self.time)
            for part in (*start, self.solver.SolveSolutionStep, self.solver.FinalizeSolutionStep):
                part()

    def load(self, time: float) -> Array:
        """Body force per mass: at a time, or its share in the next load step."""
        if self.scheme != "static":
            return self.problem.body_force(time)
        return self.problem.body_force(0.0) * (self.time + 1) / self.problem.message["load_steps"]

    def state(self) -> Message:
        return {"displacement": self.take(Mpm.MP_COORD) - self.problem.reference_position,
                "velocity": self.take(Mpm.MP_VELOCITY)}


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    schemes = ["usf", "usl", "musl", "central_difference", *IMPLICIT]
    parser.add_argument("--scheme", choices=schemes, default="usl")
    parser.add_argument("--search", type=float, default=1e-5, help="how far beyond the faces of a "
                        "cell a particle still counts as inside; Kratos' default is 1e-5")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    serve(Kratos(**vars(parser.parse_args())))
