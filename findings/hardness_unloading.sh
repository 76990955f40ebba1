#!/usr/bin/env bash
# A hardness means plastic flow in one contact program and a reversible cap on the pressure in another.
#
# One would guess that two solvers for the contact of rough surfaces with a hardness agree: the peaks
# that reached the hardness have yielded, so the surface unloads along another, stiffer curve.
# What happens, the same periodic waves, E* = 1, hardness 0.1, loads 0.005 to 0.04 and back:
#   Both agree while the load grows, to the point of the grid.
#   ContactMechanics 1.8.3 (on SurfaceTopography 1.27.1) keeps the flattened peaks: on return the contact
#   is 1.6 and 2.7 times as large, and the greatest pressure falls below the hardness.
#   Tamaas 2.9.0, KatoSaturated, returns along the way it came: the same contact, still at the hardness,
#   and tractions equal to those of a model that has never been loaded.
# Output seen (points of 1024 in contact; greatest pressure):
#   load                  0.005  0.020  0.040  0.020  0.005
#   ContactMechanics         74    218    470    354    202
#                         0.100  0.100  0.100  0.070  0.039
#   Tamaas                   74    218    470    218     74
#                         0.100  0.100  0.100  0.100  0.100
# Why it matters: stiffness on unloading, residual gaps and a second loading need the flattened surface.
# A saturated pressure says nothing of them, although it gives the first loading right.
# In roughline: Peaks that have yielded keep their dents, and a curve has two stiffnesses: for more load, and
# for less.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/pip" install -q --only-binary :all: \
  'tamaas==2.9.0' 'ContactMechanics==1.8.3' 'SurfaceTopography==1.27.1'
OMP_NUM_THREADS=1 "$folder/env/bin/python" - <<'PYTHON'
import numpy as np
import tamaas
from ContactMechanics.Factory import make_plastic_system
from SurfaceTopography import PlasticTopography, Topography

N, HARDNESS, LOADS = 32, 0.1, (0.005, 0.02, 0.04, 0.02, 0.005)
wave = np.cos(2 * np.pi * np.arange(N) / N)
heights = 0.05 * np.outer(wave, wave)
tamaas.initialize(1)
tamaas.set_log_level(tamaas.LogLevel.error)


def saturated(loads):
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [N, N])
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.KatoSaturated(model, heights, 1e-12, HARDNESS)
    solver.max_iter = 100_000
    states = []
    for load in loads:
        assert solver.solve(load) < 1e-10
        states.append(np.array(model.traction))
    return states


def flattened(loads):
    surface = PlasticTopography(Topography(heights, (1.0, 1.0), periodic=True), hardness=HARDNESS)
    system = make_plastic_system(surface, young=1.0)
    states = []
    for load in loads:
        result = system.minimize_proxy(external_force=load)
        assert result.success
        states.append(np.array(result.jac) * N * N)
    return states


print("load            ", *(f"{load:6.3f}" for load in LOADS))
counts, peaks = {}, {}
for name, solve in (("ContactMechanics", flattened), ("Tamaas", saturated)):
    pressures = solve(LOADS)
    counts[name] = [int((p > 0).sum()) for p in pressures]
    peaks[name] = [p.max() for p in pressures]
    print(f"{name:16}", *(f"{count:6}" for count in counts[name]))
    print(" " * 16, *(f"{peak:6.3f}" for peak in peaks[name]))
assert counts["ContactMechanics"] == [74, 218, 470, 354, 202]
assert counts["Tamaas"] == [74, 218, 470, 218, 74]
assert np.allclose(peaks["ContactMechanics"], (0.1, 0.1, 0.1, 0.070, 0.039), atol=5e-4)
assert np.allclose(peaks["Tamaas"], 0.1)
assert np.allclose(saturated(LOADS)[-1], saturated(LOADS[-1:])[0], atol=1e-9)
PYTHON
