"""How even what a fluid leaves of the load is along a seal: contact and flow solved together.

An assessment presses a map with the load less the mean pressure of the fluid: faces that stay
parallel leave the same everywhere. Here a map is repeated along the way through a seal, on a
periodic half-space with all its waves, with the fluid's own pressure in all that is open: contact
and flow take turns, with Aitken's factor, until both stand still. The fluid is a liquid that is at
P1 where it enters and at nothing where it leaves, with P1 = 2/3 p, so that it carries a third of
the load p. ``python benchmarks/fluid_load.py`` prints, in some seconds:

    maps    p/E*      r  parallel  together even load      excess rounds
       1  0.0005   0.03     1.199     1.194     1.248   0.681 0.681      2
       1  0.0020   0.13     1.390     1.386     1.435   0.686 0.686      2
       4  0.0020   0.51     1.396     1.407     1.442   0.600 0.718      3
      16  0.0020   2.04     1.397     1.423     1.444   0.547 0.739      4
       1  0.0060   0.38     2.146     2.133     2.406   0.695 0.695      3
       4  0.0060   1.53     2.161     2.293     2.428   0.546 0.736      4
      16  0.0060   6.11     2.164     2.380     2.433   0.486 0.768      5

The ratio r = 2 p B / (pi h E*) is that of the stiffness of the interface, about 2 p / h, and that
of the bodies to waves as long as the way B, pi E* / B: the softer one gives way. "parallel" is the
leak with the same excess everywhere, as assessments take it, "even load" that of bodies so soft
that the load itself is even: the excess is then p - P(x), and the leak the mean of those under it
over the pressures. Both are over the leak without what the fluid carries. "excess" is that of the
solution on the first and the last map, over p.
"""

import numpy as np
from scipy import ndimage

import roughline as rl

POINTS, MOST_ROUNDS, STILL = 64, 40, 1e-4
HEIGHT = 0.01  # rms, over the side of the map
CASES = ((1, 0.0005), (1, 0.002), (4, 0.002), (16, 0.002), (1, 0.006), (4, 0.006), (16, 0.006))
SHARE = 1 / 3  # of the load, that the fluid carries


def repeated(times):
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=HEIGHT, q_roll=4 * np.pi, q_high=32 * np.pi)
    return np.tile(spectrum.surface(POINTS, 3).heights, (times, 1))


def moved(pressure):
    """Displacement of a periodic half-space under a pressure, less its mean; E* = 1."""
    nx, ny = pressure.shape
    q = np.hypot(np.fft.fftfreq(nx)[:, np.newaxis], np.fft.rfftfreq(ny)) * 2 * np.pi * POINTS
    q[0, 0] = np.inf
    return np.fft.irfft2(2 / q * np.fft.rfft2(pressure), pressure.shape)


def pressed(heights, pressure):
    """Fields of what is pressed with a mean pressure, and the flow along x, between its ends."""
    sizes = (len(heights) / POINTS, 1.0)
    force = pressure * sizes[0]
    surface = rl.Surface(heights, sizes)
    (fields,) = rl.press(surface, E_star=1.0, periodic=True, forces=[force], fields=True).fields
    return fields, rl.flow(np.maximum(fields.gap, 0.0) * ~fields.contact, sizes, sides="y")


def everywhere(flow):
    """The fluid's pressure, in contact and in closed pockets that of the nearest that flows."""
    places = ndimage.distance_transform_edt(
        np.isnan(flow.pressure), return_distances=False, return_indices=True
    )
    return flow.pressure[tuple(places)]


def together(heights, load, inlet):
    """The flow, and the pressure of the contact above the fluid's, when both stand still."""
    _, flow = pressed(heights, load - inlet / 2)
    fluid, factor, before = inlet * everywhere(flow), 1.0, None
    for rounds in range(1, MOST_ROUNDS + 1):
        fields, flow = pressed(heights - moved(fluid), load - fluid.mean())
        change = inlet * everywhere(flow) - fluid
        if np.sqrt(np.mean(change**2)) < STILL * inlet:
            return flow, fields.pressure, rounds
        if before is not None:
            turn = change - before
            factor *= -np.sum(before * turn) / np.sum(turn**2)
            factor = min(max(factor, 0.1), 1.0)
        fluid, before = fluid + factor * change, change
    raise AssertionError("contact and flow do not stand still")


def row(times, load):
    heights, inlet = repeated(times), 2 * SHARE * load
    alone = pressed(heights, load)[1].permeance
    parallel = pressed(heights, load * (1 - SHARE))[1].permeance
    nodes, weights = np.polynomial.legendre.leggauss(4)
    fluids = inlet * (nodes + 1) / 2
    even = [pressed(heights, load - each)[1].permeance for each in fluids] @ weights / 2
    flow, contact, rounds = together(heights, load, inlet)
    first, *_, last = contact.reshape(times, -1).mean(axis=1)[[0, -1]] / load
    leaks = " ".join(f"{each / alone:9.3f}" for each in (parallel, flow.permeance, even))
    ratio = 2 * load * times / (np.pi * HEIGHT)
    return f"{times:4d} {load:7.4f} {ratio:6.2f} {leaks}   {first:.3f} {last:.3f} {rounds:6d}"


if __name__ == "__main__":
    print("maps    p/E*      r  parallel  together even load      excess rounds")
    for case in CASES:
        print(row(*case), flush=True)
