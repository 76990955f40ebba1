"""Pictures of bodies that are sheared."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from roughline.contact.sliding import SlidingFields
from roughline.plot.sliding import draw_loop, draw_stick_and_slip


def test_the_area_that_is_filled_is_the_energy_of_the_last_cycle():
    t = np.linspace(0, 4 * np.pi, 65)  # two cycles of 32 loads
    slide, force = 2e-6 * np.cos(t), 3.0 * np.cos(t + 0.4)
    axes = Figure().subplots()
    draw_loop(axes, slide, force, 32)
    (filled,) = axes.patches
    x, y = filled.get_xy().T
    area = abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2  # in µm N
    assert area == pytest.approx(np.pi * 2 * 3 * np.sin(0.4), rel=1e-2)


def sheared(contact):
    """Return fields of a contact that slips along y, which stick within."""
    never, shape = np.zeros_like(contact), contact.shape
    never[8:12, 8:12] = True
    slip = np.zeros((*shape, 2))
    slip[..., 1] = 1e-9
    nothing = np.zeros(shape)
    return SlidingFields(
        pressure=nothing,
        displacement=nothing,
        gap=nothing,
        contact=contact,
        plastic=~contact,
        pulling=~contact,
        indentation=nothing,
        sizes=(2e-3, 3e-3),
        periodic=False,
        shear=slip,
        slip=slip,
        slip_total=nothing,
        stick=never,
    )


def test_arrows_stand_where_points_slip_and_point_along_their_slip():
    contact = np.zeros((20, 30), bool)
    contact[5:15, 5:15] = True
    fields = sheared(contact)
    axes, never = Figure().subplots(), fields.stick
    draw_stick_and_slip(axes, fields, never, "m")
    (image,), (arrows,) = axes.images, axes.collections
    assert (contact.astype(int) + never == np.asarray(image.get_array()).T).all()
    places = (arrows.get_offsets() / 0.1 - 0.5).round().astype(int)  # a point is 0.1 mm wide
    assert len(places) > 10
    for x, y in places:
        assert contact[x, y]
        assert not never[x, y]
    assert (arrows.U == 0).all()
    assert (arrows.V > 0).all()


def test_a_small_contact_is_seen_in_a_piece_of_its_map_and_others_in_all_of_it():
    contact = np.zeros((200, 300), bool)  # points are 10 µm wide
    contact[5:15, 5:15] = True
    for spread, shown in ((False, (0, 0.24)), (True, (0, 2))):
        contact[150, 250] = spread
        fields = sheared(contact)
        axes = Figure().subplots()
        draw_stick_and_slip(axes, fields, fields.stick, "m")
        assert axes.get_xlim() == pytest.approx(shown)
        low, high = axes.get_ylim()[::-1]
        assert high - low == pytest.approx(3 if spread else 0.24)
