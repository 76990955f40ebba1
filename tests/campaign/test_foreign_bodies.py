"""Plans of contact laws and half-spaces that no line of the package names."""

import numpy as np
import pytest

import roughline as rl
from campaign.linear_pull import Foundation, LinearPull
from campaign.test_hardness import compute
from roughline import campaign
from roughline.campaign import batch as batches
from roughline.campaign.by_name import described
from roughline.campaign.writer import writing
from small_campaign import tree

PLAN = """
name = "foreign"
seed = 3

[[ensemble]]
name = "soft"
model = "full"
fractal_dimensions = 2.2
points = 16
realisations = 3
roll_off_ratios = 2
cutoff_ratio = 4
force_bars = [0.05, 0.5]
law = { name = "campaign.linear_pull:LinearPull", largest = 0.4, range = 0.6 }
half_space = { name = "campaign.linear_pull:Foundation", E_star = 2.0, stiffness = 4.0 }
"""


@pytest.fixture
def plan_file(tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN, encoding="utf-8")
    return tmp_path / "plan.toml"


def test_a_case_is_what_a_press_gives_on_moduli_over_those_of_the_half_space(plan_file):
    ensemble = campaign.read_plan(plan_file).ensembles[0]
    assert (ensemble.law, ensemble.half_space) == (LinearPull(0.4, 0.6), Foundation(2.0, 4.0))
    body = ensemble.spectrum(2.2).surface(16, ensemble.body_seed(1))
    curve = rl.press(
        body,
        half_space=Foundation(1.0, 2.0),
        law=LinearPull(0.4, 0.6),
        forces=[0.05, 0.5, -1.0],
        throw=False,
    )
    case = batches.evaluate_case(ensemble, 2.2, 1)
    np.testing.assert_array_equal(case["stiffness"], curve.stiffness[:2])
    np.testing.assert_array_equal(case["pulling_fraction"], curve.pulling_fraction[:2])
    assert float(case["pull_off_force"]) == pytest.approx(curve.pull_off_force, rel=1e-3)


@pytest.mark.parametrize("where", ["here", "in a process"])
def test_a_store_goes_on_from_what_is_there_and_is_the_same_wherever_it_is_computed(
    plan_file, tmp_path, where
):
    plan = campaign.read_plan(plan_file)
    compute(plan, tmp_path / "one.zarr")
    with writing(tmp_path / "two.zarr", plan) as writer:  # one of three cases is there
        (batch,) = writer.missing(plan.ensembles[0])
        first = batch.split()[0]
        writer.put(first, batches.evaluate(first, 1, rl.__version__))
    if where == "here":
        assert compute(plan, tmp_path / "two.zarr") == 1
    else:
        assert dict(campaign.run(plan, tmp_path / "two.zarr", workers=1).done) == {"soft": 2}
    assert tree(tmp_path / "two.zarr") == tree(tmp_path / "one.zarr")
    assert campaign.Store(tmp_path / "two.zarr").lost("soft") == []
    kept = campaign.Store(tmp_path / "two.zarr").dataset("soft").attrs
    assert '"largest": 0.4' in kept["law"]
    changed = PLAN.replace("largest = 0.4", "largest = 0.5")
    plan_file.write_text(changed, encoding="utf-8")
    with pytest.raises(rl.StoreError, match="other settings: its law is"):
        compute(campaign.read_plan(plan_file), tmp_path / "two.zarr")


class Plain(rl.ContactLaw):
    """A law that is neither a dataclass nor one of attrs."""

    def __init__(self, hardness):
        self.hardness, self._kept = hardness, "not told"

    def bounds(self, nodes):
        return 0.0, self.hardness

    def scaled(self, pressure, length):
        return Plain(self.hardness / pressure)


def test_a_body_is_told_by_the_name_of_its_class_and_its_own_fields():
    assert described(rl.Dugdale(0.2, 0.4)) == {
        "name": "Dugdale",
        "work_of_adhesion": 0.2,
        "range": 0.4,
    }
    name = "campaign.linear_pull:LinearPull"
    assert described(LinearPull(1.0, 2.0)) == {"name": name, "largest": 1.0, "range": 2.0}
    both = described(rl.Layered(1.0, 0.3, 0.1, np.inf) + rl.Homogeneous(2.0))
    assert both["name"] == "TwoBodies"
    assert both["first"]["base_young"] == "inf"
    of_shear = {"poisson": None, "beta": 0.0}
    assert both["second"] == {"name": "Homogeneous", "E_star": 2.0, "periodic": False, **of_shear}
    assert described(Plain(np.float64(0.3))) == {"name": f"{__name__}:Plain", "hardness": 0.3}
    with pytest.raises(rl.InputError, match="holds an object; numbers, texts, arrays"):
        described(Plain(object()))


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('{ largest = 1.0 }', "its name is needed"),
        ('{ name = "no_such_module:Law" }', "No module named .*PYTHONPATH"),
        ('{ name = "Layered" }', "is Layered, which is no rl.ContactLaw"),
        ('{ name = "LinearPull" }', "is LinearPull, which is no rl.ContactLaw"),
        ('{ name = "campaign.linear_pull:LinearPull", range = 1.0 }', "LinearPull.*largest"),
        ('{ name = "JKR", work_of_adhesion = 1.0 }', "of a Profile; a Surface sticks by"),
        ('{ name = "Yielding", hardness = 0.3 }', "which is less than 0.3: give smaller"),
        ('"Dugdale"', "a table such as"),
        ("[]", "at least one law is needed"),
    ],
)  # fmt: skip
def test_what_is_no_law_of_a_plan_is_refused_in_one_line(plan_file, line, told):
    lines = [f"law = {line}" if each.startswith("law") else each for each in PLAN.splitlines()]
    plan_file.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(rl.InputError, match=told) as refused:
        campaign.read_plan(plan_file)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ('boundary = "free"', "boundary is 'free'; the half-space has 'periodic'"),
        ("hardness_bar = 1000", "law and hardness_bar are given; one of the two"),
        ("work_bar = 0.1", "give law = .*Dugdale"),
        ('attraction = "exponential"', "give law = .*Exponential"),
    ],
)
def test_what_does_not_go_with_a_law_and_a_half_space_is_refused(plan_file, changed, told):
    plan_file.write_text(PLAN + changed, encoding="utf-8")
    with pytest.raises(rl.InputError, match=told):
        campaign.read_plan(plan_file)
