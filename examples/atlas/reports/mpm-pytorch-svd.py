"""mpm-pytorch: derivatives of shear stresses at a diagonal F, and the laws in double precision."""

from importlib.metadata import version

import torch
from mpm_pytorch.constitutive_models.elasticity import CorotatedElasticity, SigmaElasticity

PAIRS = ((0, 1), (1, 2))


def stress(law: torch.nn.Module, f: torch.Tensor, pair: tuple[int, int]) -> torch.Tensor:
    return law(f)[(0, *pair)]


print(f"mpm-pytorch {version('mpm-pytorch')}, torch {torch.__version__}, warp {version('warp-lang')}")
for make in (CorotatedElasticity, SigmaElasticity):
    law = make(E=1.0, nu=0.0)
    for stretches in ([1.0, 1.0, 1.0], [1.1, 0.9, 0.9], [1.1, 1.0, 0.9]):
        f, rows = torch.diag(torch.tensor(stretches))[None].requires_grad_(), []
        for pair in PAIRS:
            (slope,) = torch.autograd.grad(stress(law, f, pair), f)
            change = torch.zeros(1, 3, 3)
            change[(0, *pair)] = 0.01
            expected = (stress(law, f + change, pair) - stress(law, f - change, pair)) / 0.02
            rows.append(f"{slope[(0, *pair)]:.3f}, expected {expected:.3f}")
        print(f"{make.__name__}, F = diag{tuple(stretches)}: d s12/d F12 {rows[0]}; d s23/d F23 {rows[1]}")
eye = torch.eye(3, dtype=torch.float64)[None].requires_grad_()
try:
    print("double precision:", stress(law, eye, (0, 1)))
except RuntimeError as error:
    print("double precision:", error)
