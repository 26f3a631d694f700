"""mpm-pytorch: quadratic B-splines, APIC, three dimensions, single precision by default.

Positions are clipped to a box and F to [-2, 2]; neither limit is reached.
"""

from __future__ import annotations

import argparse
from importlib.metadata import version

from box import PRECISION, Array, Box, Message, Problem, aside, laws
from mpm_verify import serve

with aside():
    import torch
    from mpm_pytorch import MPMSolver
    from mpm_pytorch.constitutive_models.elasticity import CorotatedElasticity, SigmaElasticity

LAWS = {"corotated": CorotatedElasticity, "hencky": SigmaElasticity}
PAD = 4


class MpmPytorch:
    name = "mpm-pytorch"
    version = version("mpm-pytorch")

    def __init__(self, precision: str, any_law: bool) -> None:
        self.precision = PRECISION[precision]
        torch.set_default_dtype({"f32": torch.float32, "f64": torch.float64}[precision])
        self.capabilities = {"dimensions": [3], "laws": laws(list(LAWS), any_law),
                             "conditions": ["free"], "loads": ["gravity"]}

    def setup(self, problem: Problem) -> None:
        # Nodal masses below 1e-15 are ignored: in units of the box there are none.
        self.box = box = Box(problem, PAD)
        n = len(box.x)
        self.x, self.v = tensor(box.x), tensor(box.v)
        self.c, self.f = torch.zeros(n, 3, 3), torch.eye(3).repeat(n, 1, 1)
        law = LAWS.get(problem.materials[0]["law"], CorotatedElasticity)
        self.law = law(E=box.young, nu=box.poisson)
        if torch.get_default_dtype() == torch.float64:
            # The function of the package supports only single precision.
            del self.law.svd
            self.law.svd = torch.linalg.svd
        self.solver = MPMSolver(
            self.x, rho=1.0, num_grids=box.n, dt=problem.dt, gravity=box.gravity().tolist(),
            size=[n * box.volume, 1.0, 1.0], device="cpu")

    @torch.no_grad()
    def advance(self, steps: int, dt: float, time: float) -> None:
        for _ in range(steps):
            stress = self.law(self.f)
            self.x, self.v, self.c, self.f = self.solver(self.x, self.v, self.c, self.f, stress)

    def state(self) -> Message:
        return self.box.motion(self.x.numpy(), self.v.numpy())


def tensor(values: Array) -> torch.Tensor:
    return torch.tensor(values, dtype=torch.get_default_dtype())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--precision", choices=["f32", "f64"], default="f32")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    torch.set_num_threads(1)
    serve(MpmPytorch(**vars(parser.parse_args())))
