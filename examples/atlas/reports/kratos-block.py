"""Small problems for Kratos MPM, with expected results: `python3 kratos-block.py NAME`."""

import json
import sys
from itertools import product

import KratosMultiphysics as Km
import KratosMultiphysics.MPMApplication as Mpm
import numpy as np
from KratosMultiphysics.MPMApplication import python_solvers_wrapper_mpm as wrapper

EXPLICIT = {"solver_type": "dynamic", "time_integration_method": "explicit", "analysis_type": "linear",
            "scheme_type": "forward_euler", "stress_update": "usl"}
IMPLICIT = {"analysis_type": "non_linear", "convergence_criterion": "residual_criterion",
            "residual_relative_tolerance": 1e-9, "residual_absolute_tolerance": 1e-20,
            "linear_solver_settings": {"solver_type": "skyline_lu_factorization"}}
NEWMARK = {"solver_type": "dynamic", "time_integration_method": "implicit", "scheme_type": "newmark", **IMPLICIT}
STATIC = {"solver_type": "static", **IMPLICIT}


class Block:
    """Particles at `places`, in a grid of `cells` x `cells` squares of size 1."""

    def __init__(self, places, cells=3, density=1.0, young=1.0, dt=0.01, kind=EXPLICIT):
        Km.Logger.GetDefaultOutput().SetSeverity(Km.Logger.Severity.WARNING)
        existing, model = {"input_type": "use_input_model_part"}, Km.Model()
        settings = {"model_part_name": "MPM_Material", "domain_size": 2, "time_stepping": {"time_step": dt},
                    "grid_model_import_settings": existing, "model_import_settings": existing, **kind}
        self.solver = wrapper.CreateSolverByParameters(model, Km.Parameters(json.dumps(settings)), "OpenMP")
        self.solver.AddVariables()
        grid = self.grid = model["Background_Grid"]
        body = model["Initial_MPM_Material"].CreateSubModelPart("body")
        properties, n = body.CreateNewProperties(1), cells + 1
        law = Km.KratosGlobals.GetConstitutiveLaw("HyperElasticNeoHookeanPlaneStrain2DLaw").Clone()
        values = {Km.CONSTITUTIVE_LAW: law, Km.YOUNG_MODULUS: young, Km.POISSON_RATIO: 0.3, Km.DENSITY: density,
                  Km.THICKNESS: 1.0, Mpm.MATERIAL_POINTS_PER_ELEMENT: 1}
        for variable, value in values.items():
            properties.SetValue(variable, value)
        for k in range(n * n):
            grid.CreateNewNode(k + 1, k % n, k // n, 0)
        for k, at in enumerate((x, y) for y in range(cells) for x in range(cells)):
            first = at[1] * n + at[0] + 1
            grid.CreateNewElement("Element2D4N", k + 1, [first, first + 1, first + n + 1, first + n], properties)
        for k, place in enumerate(places):  # the particle is at the centre of a square of size 0.5
            for c, corner in enumerate([(-1, -1), (1, -1), (1, 1), (-1, 1)]):
                body.CreateNewNode(4 * k + c + 1, *(np.array(place) + np.array(corner) / 4), 0)
            body.CreateNewElement("Element2D4N", k + 1, [4 * k + c for c in (1, 2, 3, 4)], properties)
        for step in (self.solver.PrepareModelPart, self.solver.AddDofs, self.solver.Initialize):
            step()
        self.points, self.info, self.time = list(model["MPM_Material"].Elements), grid.ProcessInfo, 0.0

    def give(self, variable, values):
        for point, value in zip(self.points, values):
            point.SetValuesOnIntegrationPoints(variable, [[*value, 0.0]], self.info)

    def take(self, variable):
        return np.array([[*point.CalculateOnIntegrationPoints(variable, self.info)[0]] for point in self.points])

    def step(self):
        solver = self.solver
        self.time = solver.AdvanceInTime(self.time)
        start = [solver.InitializeSolutionStep, solver.Predict]
        if "_SearchElement" in solver.Predict.__code__.co_names:  # as in the AnalysisStage of 10.4.2 and later
            start.reverse()
        for part in (*start, solver.SolveSolutionStep, solver.FinalizeSolutionStep):
            part()


def masses():
    """A particle moves freely at 1 m/s for one step of 0.01 s; its mass is 0.25 density."""
    for kind, density in product((EXPLICIT, NEWMARK), (1.0, 1e-12, 1e-15, 1e-18)):
        block = Block([(1.3, 1.4)], density=density, young=density, kind=kind)
        block.give(Mpm.MP_VELOCITY, [(1, 0)])
        block.step()
        print(f"{kind['time_integration_method']}, density {density:g}: displacement "
              f"{block.take(Mpm.MP_DISPLACEMENT)[0, 0]:.6f}, expected 0.01")


def tolerance():
    """Four particles, two of them just beyond a face, move at 1 m/s along X for one step of 0.01 s."""
    for beyond in (1e-9, 1e-6, 1e-3):
        for limit in (1e-5, 0.0):
            search = {"search_algorithm_type": "bin_based", "max_number_of_results": 1000,
                      "searching_tolerance": limit, "remove_entities_not_found": True}
            places = [(2 + beyond + x, 2.2 + y) for x in (0, 0.5) for y in (0, 0.5)]
            block = Block(places, 5, kind={**EXPLICIT, "element_search_settings": search})
            block.give(Mpm.MP_VELOCITY, [(1, 0)] * 4)
            block.step()
            strain = block.take(Mpm.MP_ALMANSI_STRAIN_VECTOR)[0]
            print(f"{beyond:g} beyond a face, tolerance {limit:g}: strains {np.round(strain, 6)}, expected 0")


def rotation(steps=100):
    """A square is stretched by 20 % along X, then turned by 90 degrees. Stiffness has no influence."""
    places = [(2.25 + x / 2, 2.25 + y / 2) for x in range(8) for y in range(8)]
    for kind in (EXPLICIT, NEWMARK):
        block = Block(places, 8, young=1e-6, dt=1 / steps, kind=kind)
        for k in range(2 * steps):
            x, y = (block.take(Mpm.MP_COORD)[:, :2] - 4).T
            stretching = np.transpose([0.2 / (1 + 0.2 * k / steps) * x, 0 * y])
            block.give(Mpm.MP_VELOCITY, stretching if k < steps else np.pi / 2 * np.transpose([-y, x]))
            block.step()
            if k + 1 in (steps, 2 * steps):
                stress = block.take(Mpm.MP_CAUCHY_STRESS_VECTOR).mean(0) / 1e-6
                print(f"{kind['time_integration_method']}, {k + 1} steps: mean stresses {np.round(stress, 3)} E")
    print("expected: xx and yy are exchanged after the second 100 steps, except for errors of the grid")


def stretch():
    """The grid is stretched by 20 % along X in one static step."""
    block = Block([(1.25, 1.25)], dt=1.0, kind=STATIC)
    for node in block.grid.Nodes:
        for d, value in ((Km.DISPLACEMENT_X, 0.2 * node.X), (Km.DISPLACEMENT_Y, 0.0)):
            node.Fix(d)
            node.SetSolutionStepValue(d, value)
    block.step()
    density = block.points[0].CalculateOnIntegrationPoints(Mpm.MP_DENSITY, block.info)[0]
    print(f"density {density:.6f}, expected {1 / 1.2:.6f}")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
