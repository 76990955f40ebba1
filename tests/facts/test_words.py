"""Every kind of fact has words, in full and in one short line."""

import pickle

import pytest

import roughline as rl
from known_facts import all_kinds, examples
from roughline.cli.flags import FLAGS
from roughline.errors.words import speaking
from roughline.facts.fact import LIMITS, LINE, Fact, grave_first, kind
from roughline.facts.heights import (
    beyond_chance,
    bowed,
    differs_between_places,
    drifts,
    flat,
    heights_in_steps,
    heights_on_a_level,
    levelled_before,
    levelled_by_lines,
    long_tailed,
    many_filled,
    map_jumps,
    no_roll_off,
    skewed,
    slopes_differ_by_direction,
    slopes_differ_by_height,
    tilted,
)
from roughline.facts.intervals import departs, line_stands_for_surface
from roughline.facts.own_words import in_own_words, on_body, on_maps
from roughline.facts.pressed import few_heights, stiff_heights

KINDS = all_kinds()


@pytest.mark.parametrize("caller", [None, FLAGS], ids=["python", "terminal"])
@pytest.mark.parametrize("name", KINDS)
def test_every_kind_is_worded_in_full_and_in_one_short_line(name, caller):
    with speaking(caller):
        look_at_words(examples(KINDS[name]))


def departures():
    """What a map or a scan shows, as it is told with what it takes down."""
    kinds = (
        *(differs_between_places, drifts, slopes_differ_by_direction, skewed, long_tailed),
        slopes_differ_by_height,
    )
    for fact in [each for some in kinds for each in examples(some)]:
        yield from (beyond_chance(fact, what) for what in ("map", "scan"))
    kinds = (
        *(heights_in_steps, many_filled, heights_on_a_level, map_jumps, no_roll_off),
        *(levelled_by_lines, levelled_before, tilted, bowed, few_heights, stiff_heights),
    )
    yield from (each for some in kinds for each in examples(some))


@pytest.mark.parametrize("caller", [None, FLAGS], ids=["python", "terminal"])
def test_departures_are_short_with_what_they_take_down(caller):
    with speaking(caller):
        for fact in departures():
            look_at_words([departs(fact, takes_all=True, takes_theories=True)])
            look_at_words([line_stands_for_surface(fact)])
            assert str(departs(fact, takes_all=True, takes_theories=True)).startswith(str(fact))


def look_at_words(found):
    assert found
    for fact in found:
        words = fact.kind.words(**fact.numbers)
        short, full = (words, words) if isinstance(words, str) else words
        assert (str(fact), fact.in_short) == (full, short)  # so short that nothing is cut off
        for text in (short, full):
            assert text
            assert "\n" not in text
            assert "  " not in text
            assert not text.endswith(".")
        assert len(short) <= LINE
        assert len(short) <= len(full) + 20


def test_a_fact_without_words_is_refused_at_birth():
    with pytest.raises(rl.InputError, match="a kind of fact, which has words, is needed"):
        Fact("nothing of the kind")
    with pytest.raises(TypeError, match="missing a required argument: 'what'"):
        Fact(bowed)
    with pytest.raises(TypeError, match="height"):
        flat(height=1.0)


def test_what_a_fact_is_of_stays_where_something_further_is_said():
    inner = in_own_words("heights are odd").grave().concerning("mean_gap")
    outer = inner.within(on_body(inner, "second"))
    assert (outer.weight, outer.of, outer.about) == ("grave", ("mean_gap",), LIMITS)
    assert outer.innermost is inner
    assert str(outer) == "second body: heights are odd"


def test_facts_that_differ_in_their_numbers_alone_are_alike():
    first, other = (bowed("map", "bow", rms, 1e-8, "m") for rms in (1e-6, 2e-6))
    assert first != other
    assert first.without_numbers == other.without_numbers
    scan = bowed("scan", "bow", 1e-6, 1e-8, "m")
    assert scan.without_numbers != first.without_numbers
    parts = [departs(each, takes_all=True, takes_theories=False) for each in (first, other, scan)]
    assert parts[0].without_numbers == parts[1].without_numbers != parts[2].without_numbers


def test_a_fact_travels_to_other_processes():
    fact = on_maps(bowed("map", "bow", 1e-6, 1e-8, "m").grave(), ("a", "b"), "a")
    there = pickle.loads(pickle.dumps(fact))
    assert there == fact
    assert hash(there) == hash(fact)
    assert there.innermost.kind is bowed
    assert str(there) == str(fact)


def test_a_long_name_is_cut_off_in_short_alone():
    fact = in_own_words("a " * 100 + "end")
    assert len(fact.in_short) <= LINE
    assert fact.in_short.endswith("…")
    assert str(fact).endswith("end")


def test_grave_facts_come_first_and_others_stay_in_order():
    @kind(LIMITS)
    def told(number: int):
        """Whatever it is."""
        return f"number {number}"

    facts = [told(1), told(2).grave(), told(3).as_("note"), told(4).grave()]
    assert [each.numbers["number"] for each in grave_first(facts)] == [2, 4, 1, 3]
    assert [each.is_warning for each in facts] == [True, True, False, True]
