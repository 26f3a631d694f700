"""mpm-pytorch: quadratic B-splines, APIC, three dimensions, single precision by default.

Positions are clipped to a box and F to [-2, 2]; neither limit is reached. Derivatives are those of
PyTorch, in reverse mode through the functions of the package; each step is a checkpoint.
"""

from __future__ import annotations

import argparse
from importlib.metadata import version

from box import PRECISION, Array, Box, Cannot, Message, Problem, aside, laws
from mpm_verify import serve

with aside():
    import torch
    from mpm_pytorch import MPMSolver
    from mpm_pytorch.constitutive_models.elasticity import CorotatedElasticity, SigmaElasticity
    from torch.utils.checkpoint import checkpoint

LAWS = {"corotated": CorotatedElasticity, "hencky": SigmaElasticity}
PAD = 4


class MpmPytorch:
    name = "mpm-pytorch"
    version = version("mpm-pytorch")

    def __init__(self, precision: str, any_law: bool) -> None:
        self.precision = PRECISION[precision]
        torch.set_default_dtype({"f32": torch.float32, "f64": torch.float64}[precision])
        self.capabilities = {"dimensions": [3], "laws": laws(list(LAWS), any_law),
                             "conditions": ["free"], "loads": ["gravity"], "several_bodies": True,
                             "gradients": ["young", "poisson", "density", "initial_velocity"]}

    def setup(self, problem: Problem) -> None:
        # Nodal masses below 1e-15 are ignored: in units of the box there are none.
        self.box = box = Box(problem, PAD)
        n = len(box.x)
        self.x, self.v = tensor(box.x), tensor(box.v)
        self.c, self.f = torch.zeros(n, 3, 3), torch.eye(3).repeat(n, 1, 1)
        law = LAWS.get(problem.materials[0]["law"], CorotatedElasticity)
        self.law = law(E=box.young, nu=box.poisson)
        self.moduli: dict[str, torch.Tensor] = {}  # those of the law, if none are given
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
            self.x, self.v, self.c, self.f = self.step(self.x, self.v, self.c, self.f)

    def step(self, *state: torch.Tensor) -> tuple[torch.Tensor, ...]:
        return self.solver(*state, self.law(state[-1], **self.moduli))

    def state(self) -> Message:
        return self.box.motion(self.x.numpy(), self.v.numpy())

    def differentiate(self, of: Message, with_respect_to: list[str], steps: int, dt: float
                      ) -> tuple[float, list[float]]:
        """The functional `of` and its derivatives. Density and velocity have factors."""
        young, poisson = self.law.log_E.exp().item(), self.law.nu.item()
        values = {"young": young, "poisson": poisson, "density": 1.0, "initial_velocity": 1.0}
        leaves = {name: tensor(value).requires_grad_() for name, value in values.items()}
        self.moduli = {"log_E": leaves["young"].log(), "nu": leaves["poisson"]}
        self.solver.p_mass = self.solver.p_mass * leaves["density"]
        state = (self.x, self.v * leaves["initial_velocity"], self.c, self.f)
        for _ in range(steps):
            state = checkpoint(self.step, *state, use_reentrant=False)
        value = self.functional(of, *state[:2], leaves["density"])
        slopes = torch.autograd.grad(value, [leaves[name] for name in with_respect_to])
        for name, slope in zip(with_respect_to, slopes):
            if not slope.isfinite():
                raise ArithmeticError(f"the derivative with respect to {name} is {slope.item()}")
        units = {"young": young / self.box.problem.materials[0]["parameters"]["young"],
                 "density": 1 / self.box.density}
        return value.item(), [float(slope) * units.get(name, 1.0)
                              for name, slope in zip(with_respect_to, slopes)]

    def functional(self, of: Message, x: torch.Tensor, v: torch.Tensor, density: torch.Tensor
                   ) -> torch.Tensor:
        """A functional of positions and velocities in the units of the box, in m, s and kg. All
        particles have the same mass."""
        box, name = self.box, of["functional"]
        x, v = x.double() / box.metre, v.double() / box.metre
        start = torch.from_numpy(box.problem.reference_position - box.origin).double()
        u = x - start
        if name == "mean_displacement":
            return u[:, of["axis"]].mean()
        if name == "mean_square_displacement":
            return (u * u).sum(dim=1).mean()
        if name == "kinetic_energy":
            return 0.5 * density * float(box.problem.mass.sum()) * (v * v).sum(dim=1).mean()
        if name == "position_of":
            return x[of["particle"], of["axis"]] + float(box.origin[of["axis"]])
        raise Cannot(f"no gradient of {name}")


def tensor(values: Array | float) -> torch.Tensor:
    return torch.tensor(values, dtype=torch.get_default_dtype())


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--precision", choices=["f32", "f64"], default="f32")
    parser.add_argument("--any-law", action="store_true", help="where nothing deforms")
    torch.set_num_threads(1)
    serve(MpmPytorch(**vars(parser.parse_args())))
