"""Every kind of fact has words, in full and in one short line, and is told somewhere."""

import ast
import pickle

import pytest
from architecture import SOURCE

import roughline as rl
from known_facts import examples, made_in, words_of_source
from roughline.cli.flags import FLAGS
from roughline.errors.words import speaking
from roughline.facts.fact import LINE, Fact, by_weight, own_words
from roughline.facts.kinds import INTERVALS, KINDS, LIMITS, FactKind


def test_every_kind_is_told_somewhere():
    assert KINDS.keys() <= words_of_source()


def test_every_fact_that_the_code_makes_has_words_and_their_numbers():
    wrong = [
        f"{path.name}, line {call.lineno}: {kind.value}"
        for path in sorted(SOURCE.rglob("*.py"))
        for call, names in made_in(ast.parse(path.read_text("utf-8")))
        for kind in ast.walk(call.args[0])
        if isinstance(kind, ast.Constant)
        and isinstance(kind.value, str)
        and (kind.value not in KINDS or (names is not None and names != KINDS[kind.value].numbers))
    ]
    assert wrong == []


@pytest.mark.parametrize("caller", [None, FLAGS], ids=["python", "terminal"])
@pytest.mark.parametrize("name", KINDS)
def test_every_kind_is_worded_in_full_and_in_one_short_line(name, caller):
    with speaking(caller):
        look_at_words(examples(name))


def departures():
    """What a map or a scan shows, as it is told with what it takes down."""
    kinds = (
        *("differs_between_places", "drifts", "slopes_differ_by_direction", "skewed"),
        *("long_tailed", "slopes_differ_by_height"),
    )
    for fact in [each for some in kinds for each in examples(some)]:
        yield from (Fact("beyond_chance", fact=fact, what=what) for what in ("map", "scan"))
    kinds = (
        *("heights_in_steps", "many_filled", "heights_on_a_level", "map_jumps", "no_roll_off"),
        *("levelled_by_lines", "levelled_before", "tilted", "bowed", "few_heights"),
        "stiff_heights",
    )
    yield from (each for some in kinds for each in examples(some))


def departs(fact, *, takes_theories=True):
    lost = {"takes_all": True, "takes_theories": takes_theories}
    return Fact("departs", fact=fact, answers=(), whole="", **lost)


@pytest.mark.parametrize("caller", [None, FLAGS], ids=["python", "terminal"])
def test_departures_are_short_with_what_they_take_down(caller):
    with speaking(caller):
        for fact in departures():
            look_at_words([departs(fact), Fact("line_stands_for_surface", fact=fact)])
            assert str(departs(fact)).startswith(str(fact))


def look_at_words(found):
    assert found
    for fact in found:
        short, full = fact.brief, str(fact)
        assert fact.in_short == short  # so short that nothing is cut off
        for text in (short, full):
            assert text
            assert "\n" not in text
            assert "  " not in text
            assert not text.endswith(".")
        assert len(short) <= LINE
        assert len(short) <= len(full) + 20


def test_a_fact_without_words_or_with_other_numbers_is_refused_at_birth(monkeypatch):
    monkeypatch.setitem(KINDS, "wordless", FactKind("", ""))
    with pytest.raises(rl.InputError, match="a kind of fact, which has words, is needed"):
        Fact("wordless")
    with pytest.raises(rl.InputError, match="a kind of fact, which has words, is needed"):
        Fact("nothing of the kind")
    with pytest.raises(rl.InputError, match="bowed name explained, rms, shape, unit"):
        Fact("bowed")
    with pytest.raises(rl.InputError, match='numbers is "height"; the words of flat name none'):
        Fact("flat", height=1.0)


def test_words_of_ones_own_are_a_fact_and_need_a_weight_that_there_is():
    assert own_words("tides are left out", "note").is_warning is False
    with pytest.raises(rl.InputError, match="weight"):
        rl.own_words("tides are left out", "hint")


def test_what_a_fact_is_of_stays_where_something_further_is_said():
    inner = own_words("heights are odd").grave().concerning("mean_gap")
    outer = inner.within(Fact("on_body", fact=inner, which="second"))
    assert (outer.weight, outer.of, outer.about) == ("grave", ("mean_gap",), LIMITS)
    assert outer.innermost is inner
    assert str(outer) == "second body: heights are odd"


def bowed(rms, what="map"):
    return Fact("bowed", what=what, shape="bow", rms=rms, explained=1e-8, unit="m")


def test_facts_that_differ_in_their_numbers_alone_are_alike():
    first, other, scan = bowed(1e-6), bowed(2e-6), bowed(1e-6, "scan")
    assert first != other
    assert first.without_numbers == other.without_numbers != scan.without_numbers
    parts = [departs(each, takes_theories=False) for each in (first, other, scan)]
    assert parts[0].without_numbers == parts[1].without_numbers != parts[2].without_numbers


def test_a_fact_travels_to_other_processes():
    fact = Fact("on_maps", fact=bowed(1e-6).grave(), maps=("a", "b"), first="a")
    there = pickle.loads(pickle.dumps(fact))
    assert there == fact
    assert hash(there) == hash(fact)
    assert there.innermost.kind == "bowed"
    assert str(there) == str(fact)


def test_what_is_about_data_or_intervals_says_so():
    assert Fact("steep", slope=1.0, limit=0.5).about == LIMITS
    assert departs(bowed(1e-6)).about == INTERVALS


def test_a_long_name_is_cut_off_in_short_alone():
    fact = own_words("a " * 100 + "end")
    assert len(fact.in_short) <= LINE
    assert fact.in_short.endswith("…")
    assert str(fact).endswith("end")


def test_facts_come_by_their_weight_once_and_otherwise_in_order():
    weights = ("warning", "grave", "note", "warning", "grave")
    facts = [own_words(str(place), weight) for place, weight in enumerate(weights)]
    assert [str(each) for each in by_weight([*facts, facts[1]])] == ["1", "4", "0", "3", "2"]
    assert [each.is_warning for each in facts] == [True, True, False, True, True]
