"""The state of the view "Explore" is read from texts, and checked."""

from __future__ import annotations

from dataclasses import replace

from roughline.lab.controls import ControlError, Texts, refuse_strange, sent_texts, usable
from roughline.lab.explore import physics
from roughline.lab.explore.controls import CONTROLS, LOAD
from roughline.lab.explore.state import SURFACE_KEYS, ExploreState
from roughline.lab.server.tasks import Arguments


def usable_state(arguments: Arguments) -> tuple[ExploreState, dict[str, str]]:
    """The state that a page asks about, and what of its texts is not used, by control."""
    return usable(arguments, read_state, ExploreState.texts)


def state_in(arguments: Arguments) -> ExploreState:
    """The state that a page asks about, all of whose texts can be used."""
    return read_state(sent_texts(arguments))


def read_state(texts: Texts) -> ExploreState:
    """Read the parameters of an address, or the texts of the controls.

    Those that are missing have their defaults.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    known = {*CONTROLS, *(each.key for each in physics.PHYSICS), *physics.numbers(), "H"}
    refuse_strange(texts, known)
    read_as = {"D_f": f"H = {texts['H']}", **texts} if "H" in texts else texts
    controls, state = {**CONTROLS, "shown": physics.second_map_choice()}, ExploreState()
    load = controls.pop(LOAD)
    for key, control in controls.items():
        state = replace(state, **{key: control.read_in(read_as, state)})
    _refuse_waves(state)
    state = replace(state, F=load.read_in(texts, state))
    added = (each for kind in physics.PHYSICS if (each := kind.read(texts, state)))
    state = replace(state, added=tuple(added))
    _refuse_together(state)
    return replace(state, typed_texts=texts)


def _refuse_waves(state: ExploreState) -> None:
    """Refuse a cutoff or a grid that does not go with the roll-off."""
    if not state.cutoff < state.roll_off:
        raise ControlError(
            f"the cutoff, {state.cutoff:.4g} sides, is not shorter than the roll-off, "
            f"{state.roll_off:.4g} sides: shorten it, or lengthen the roll-off",
            "cutoff",
            "roll_off",
        )
    if 2 / state.n >= state.roll_off:
        raise ControlError(
            f"{state.n} points carry no waves shorter than the roll-off, {state.roll_off:.4g} "
            "sides: take more points, or a longer roll-off",
            "n",
            "roll_off",
        )


def _refuse_together(state: ExploreState) -> None:
    """Refuse physics that do not go with each other, with the grid or with the load."""
    keys = [each.key for each in state.added]
    for each in state.added:
        for other, why in each.excludes.items():
            if other in keys:
                raise ControlError(why, each.key, other)
        each.check(state)
    most = state.most_force_bar
    if most <= state.F:
        raise ControlError(
            f"the surface bears less than its hardness everywhere, F̄ = {most:.3g}: give a smaller "
            "load, or a larger hardness",
            "F",
            *(key for each in state.added for key in each.numbers),
            *SURFACE_KEYS,
        )
