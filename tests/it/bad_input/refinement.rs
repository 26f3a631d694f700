//! Invalid refinement plans.

use super::refuse_all;

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar
[6, 12] → [12, ▸6] ⇒ a level with 6 cells after one with 12 … expected levels from coarse to fine
, dt: 1e-3, instants → , instants
run: → ▸run:
⇒ a run needs a time step … add `dt`, or a list of them to `refine`
[6, 12], ppc: 4 → 6, ppc: 4, ▸dt: [1e-3, 5e-4] ⇒ the time step is already stated in `run`
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: 6, ppc: 4, ▸dt: 1e-3}
⇒ a single time step refines nothing … move it to `run`
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: 6, ppc: 4, dt: [1e-3, ▸2e-3]}
⇒ a level with dt = 0.002 after one with 0.001 … expected levels from coarse to fine
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: 6, ppc: 4, dt: [1, ▸0.9]}
⇒ dt = 0.9 and 1 both become 0.5 s … both runs take 1 steps
dt: 1e-3 → dt: ▸3e-3
run:
   → reference:\n  equation: small_strain\n
    fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:
⇒ dt = 0.003 is changed to 0.0025 s, so that steps end at 50 instants … to 1 %
   … `instants: 42` keeps this step
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: 6, ppc: 4, dt: [1e-3, ▸"0/0"]}
⇒ with 6 cells the time step is NaN
refine: {cells: [6, 12], ppc: 4} → refine: {cells: [6, 12], ppc: ▸[1, 2]}
⇒ `ppc` is refined together with `cells` or `dt` … to refine `ppc`, state one number of cells
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: [6, 12], ppc: 4, dt: ▸[3e-3, 2e-3, 1e-3]}
⇒ 3 time steps for 2 levels of cells … as a formula of h
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: [6, 12], ppc: 4, dt: [2e-3, 1e-3], ▸full: 24}
⇒ `full` is one list, so it cannot refine both
ppc: 4} → ppc: 4, full: [24, ▸10]} ⇒ a level with 10 cells after one with 24
ppc: 4} → ppc: 4, full: ▸12} ⇒ a level with 12 cells appears twice
ppc: 4} → ppc: 8, full: ▸1e7} ⇒ with 10000000 cells along the first axis, 6.7e7 particles
refine: {cells: [6, 12], ppc: 4} → refine: {cells: 6, ppc: [1, 2]}
- fem: → - ▸fem:
⇒ but an FEM has none
too_few_levels\n → too_few_levels\n    ▸full: {verdict: divergent, because: none}\n
⇒ this expectation needs a full run, but `refine` has no `full`
ppc: 4} → ppc: 4, full: 24}
too_few_levels\n → too_few_levels\n    full: {▸case: x, verdict: divergent, because: none}\n
⇒ cannot have its own `case`
finest_pair: [1.5, 2.5] → floor: ▸tiem ⇒ tiem … time
run: → reference: {▸same_method: {dt: 1e-5}}\nrun: ⇒ measures only the error of the time step
run: → reference: {same_method: {dt: ▸2e-4}}\nrun:
dt: 1e-3, instants: 50}\nrefine: {cells: [6, 12], ppc: 4}
   → instants: 50}\nrefine: {cells: 6, ppc: 4, dt: [2e-3, 1e-3]}
⇒ the time step is 0.0002, but the finest level already has 0.001 … expected at most 1/8
run: → ▸reference: {}\nrun: ⇒ a reference needs `equation` and `fem`, or `same_method`
refine: → particles: ▸{shift: [0.4], perturb: 0.2}\nrefine:
⇒ particles are moved by up to 0.6 … expected at most 0.5
initial_velocity → loads:\n    - traction: {on: right, value: [0]}\n  initial_velocity
refine: → particles: {perturb: ▸0.3}\nrefine:
⇒ particles are moved by up to 0.3 … expected at most 0.25 at a face or rim with a load
refine: → particles: {shift: [0.1], ▸seed: 3}\nrefine:
⇒ `seed` has no effect without `perturb` … add `perturb: 0.2`
refine: → ▸particles: {shift: [0]}\nrefine: ⇒ `particles` moves no particle
refine: → particles: {shift: ▸[0.1, 0.1]}\nrefine: ⇒ 2 components in a scene of dimension 1
refine: → particles: {perturb: ▸-0.1}\nrefine: ⇒ the share of the spacing
# Suites in which a reference run on a fine grid is not allowed.
@bar
run: → reference: {same_method: {cells: ▸47}}\nrun:
⇒ the fine grid has 47 cells, but the finest level already has 12
   … expected at least 4 times as many
run: → reference: {same_method: {cells: ▸48.5}}\nrun: ⇒ the number of cells is 48.5
run: → reference: {▸same_method: {cells: 48}}\nrun:
, dt: 1e-3, instants → , instants
cells: [6, 12], ppc: 4 → cells: 6, ppc: 4, dt: [2e-3, 1e-3]
⇒ `same_method` on a fine grid measures only the error of the cell size … list `cells` in `refine`
run: → reference: {▸same_method: {cells: 48, dt: 1e-4}}\nrun:
⇒ either shorter steps (`dt`) or a fine grid (`cells`) … state one of them
run: → reference: {▸same_method: {}}\nrun:
⇒ either shorter steps (`dt`) or a fine grid (`cells`) … state one of them
run: → reference: {same_method: {cells: ▸48}}\nrun:
, dt: 1e-3, instants → , instants
cells: [6, 12], ppc: 4 → cells: [6, 12], ppc: 4, dt: [2e-3, 1e-3]
⇒ a time step for each level, but none for the fine grid … as a formula of h
run: → reference: {same_method: {cells: ▸50}}\nrun:
dt: 1e-3 → dt: "h/1000"
⇒ dt = 0.0006 is changed to … so that steps end at 50 instants
run: → reference: {same_method: {cells: ▸1000000}}\nrun:
⇒ 3.3e6 particles at 50 instants are too many to store
run: → reference: {▸same_method: {cells: 48}}\nparticles: {perturb: 0.2}\nrun:
⇒ regular particles of a single box, but the scene has moved `particles`
@plate
run: → reference: {same_method: {cells: ▸33}}\nrun:
{left: fixed} → {left: fixed, top: roller}
⇒ with 33 cells along the first axis the top face … a cell size that divides the length
run: → ▸reference: {same_method: {cells: 32}}\njudge: {of: stress}\nrun:
⇒ a reference does not provide the stress that this suite judges
   … judge the displacement or the velocity
run: → reference: {▸same_method: {cells: 32}}\nrun:
{box: {from: [0, 0], to: [1, 0.5]}} → {disk: {centre: [0, 0], radius: 1}}
boundary: {left: fixed} → # a free rim
exact:\n  equation: small_strain\n  displacement: ["sin(pi*X/2)*sin(omega*t)/omega", 0]\n →
parameters:\n  omega: "5*pi"\n →
⇒ regular particles of a single box, but the scene has a body of kind `disk`
@cube
run: → reference: {same_method: {cells: ▸1000}}\nrun:
⇒ with 1000 cells along the first axis, 1.6e9 nodes … expected at most 5e7 nodes
@vibrating-bar-of-two
run: → reference: {▸same_method: {cells: 4000}}\nrun:
⇒ regular particles of a single box, but the scene has several bodies
"#;
