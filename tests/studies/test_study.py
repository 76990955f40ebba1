"""A study is a plan, a measure, claims and a text: here one that no shared line names."""

import math

import pytest

import roughline as rl
from roughline import campaign
from roughline.plot.style import new_figure
from roughline.report.page import Table
from roughline.statistics.power_law import scaling_exponent
from roughline.statistics.verdict import Verdict, around
from studies import study as skeleton
from studies.__main__ import main
from studies.judged import Found, claim_on
from studies.reduced_data import Reduced
from studies.study import Study, claims_table, filled

PLAN = """
name = "toy"
seed = 3
[[ensemble]]
name = "lines"
model = "reduced"
fractal_dimensions = [2.0, 2.5, 3.0]
points = 4096
realisations = 12
force_bars = { from = 1e-3, to = 1e-1, per_decade = 4 }
"""
TEXT = """# Do springs obey eq. 14?

The exponent is {exponents} on {count}
lines.

## Verdicts

- One claim,
  at three fractal dimensions.

{verdicts}

## Numbers

![Exponents](figures/toy/exponents.png)

{table}
"""
KEPT = ("stiffness", "status")


class Toy:
    """The study: what it keeps, a measure, a claim, and what its text names."""

    def __init__(self, folder):
        (folder / "plan.toml").write_text(PLAN, encoding="utf-8")
        (folder / "text.md").write_text(TEXT, encoding="utf-8")
        self.reduced = Reduced(folder, KEPT)
        self.study = Study(
            folder,
            verdicts=lambda: claims_table({"Verdict": self.claims()}),
            told=self.told,
            figures={"exponents": self.figure},
        )

    def measure(self):
        """Exponent of the stiffness by fractal dimension."""
        lines = self.reduced.data["lines"]
        return {
            float(d): rl.fit_power_law(
                lines.force_bar.values, lines.stiffness.sel(fractal_dimension=d).values, (1e-3, 0.1)
            )
            for d in lines.fractal_dimension.values
        }

    def claims(self):
        found = {
            f"at D_f = {d}": Found(
                law.exponent_interval[0], law.exponent, law.exponent, law.exponent_interval[1], 12
            )
            for d, law in self.measure().items()
        }
        allowed = {f"at D_f = {d}": around(scaling_exponent(d), 0.05) for d in self.measure()}
        return [claim_on("α = 1 / (4 - D_f), to ±0.05", "α", found, allowed, ".2f")]

    def told(self):
        rows = [(f"{d}", f"{law.exponent:.2f}") for d, law in self.measure().items()]
        exponents = ", ".join(cell for _, cell in rows)
        return {"exponents": exponents, "count": 12, "table": Table(("D_f", "α"), rows, (0, 1))}

    def figure(self):
        figure = new_figure(3, 2)
        alphas = [law.exponent for law in self.measure().values()]
        figure.add_subplot().plot(list(self.measure()), alphas, "o")
        return figure


@pytest.fixture(scope="module")
def toy(two_workers, tmp_path_factory):
    folder = tmp_path_factory.mktemp("studies") / "toy"
    folder.mkdir()
    found = Toy(folder)
    store = folder / "toy.zarr"
    campaign.run(found.reduced.plan, store, scheduler=two_workers)
    found.reduced.reduce(store)
    return found


def test_data_verdicts_page_and_figures_come_from_the_skeleton(toy, tmp_path, monkeypatch):
    monkeypatch.setattr(skeleton, "DOCS", tmp_path / "docs")
    toy.study.publish()
    assert toy.reduced.data["lines"].stiffness.shape == (3, 12, 9)
    assert toy.reduced.unsolved_loads() == (0, 3 * 12 * 9)
    assert toy.reduced.version == rl.__version__
    (claim,) = toy.claims()
    exponents = [f"{law.exponent:.2f}" for law in toy.measure().values()]
    assert claim.found == f"α: {', '.join(exponents)} at D_f = 2.0, 2.5, 3.0"
    assert claim.verdict is Verdict.REFUTED  # springs do not obey it at D_f = 3
    page = (tmp_path / "docs" / "toy.md").read_text("utf-8")
    assert page.startswith("# Do springs obey eq. 14?\n\nThe exponent is ")
    assert f"{exponents[2]} on 12 lines.\n\n## Verdicts\n\n- One claim, at three" in page
    assert f"| {claim.statement} | {claim.found} | {claim.interval} | {claim.cases} |" in page
    assert f"| 3.0 | {exponents[2]} |\n" in page
    assert "[As CSV, these rows](data/toy/table.csv)." in page
    assert (tmp_path / "docs" / "figures" / "toy" / "exponents.png").is_file()
    rows = (tmp_path / "docs" / "data" / "toy" / "table.csv").read_text("utf-8").splitlines()
    assert rows == [
        "D_f,α",
        *(f"{d},{one}" for d, one in zip(toy.measure(), exponents, strict=True)),
    ]


def test_a_page_whose_data_are_refused_leaves_what_is_there(toy, tmp_path, monkeypatch):
    monkeypatch.setattr(skeleton, "DOCS", tmp_path)
    figure = tmp_path / "figures" / toy.study.folder.name / "old.png"
    figure.parent.mkdir(parents=True)
    figure.write_bytes(b"drawn before")

    def refused():
        raise rl.StoreError("data.nc is damaged")

    with pytest.raises(rl.StoreError):
        Study(toy.study.folder, toy.study.verdicts, refused, toy.study.figures).publish()
    assert figure.read_bytes() == b"drawn before"


def test_a_page_shows_ten_rows_of_a_table_from_its_first_to_its_last():
    rows = [(f"{i}", "said at length", f"{i * i}") for i in range(28)]
    page = filled("{t}", {"t": Table(("i", "Basis", "i²"), rows, (0, 2))}, "toy")
    assert page.splitlines()[:3] == ["| i | i² |", "|--:|--:|", "| 0 | 0 |"]
    assert page.count("\n| ") == 10
    assert "| 27 | 729 |\n\n[As CSV, all 28 rows](data/toy/t.csv)." in page


def test_a_text_that_names_what_is_not_told_is_refused():
    assert filled("a\nb\n\n- c\n  d\n- {e}\n", {"e": 1}, "toy") == "a b\n\n- c d\n- 1\n"
    with pytest.raises(KeyError, match="f"):
        filled("{f}", {"e": 1}, "toy")


def test_numbers_are_told_each_or_by_the_smallest_and_the_largest():
    found = {f"at H = {h}": Found(h - 0.1, h, h, h + 0.1, 10) for h in (0.2, 0.5, 0.8)}
    each = claim_on("s", "H", found, (0.0, 0.7), ".1f")
    assert (each.found, each.interval) == (
        "H: 0.2, 0.5, 0.8 at H = 0.2, 0.5, 0.8",
        "0.1 to 0.3, 0.4 to 0.6, 0.7 to 0.9",
    )
    both = claim_on("s", "H", found, (0.0, 0.7), ".1f", each=False)
    assert (both.found, both.interval) == ("H: 0.2 to 0.8", "0.1 to 0.9")
    assert both.cases == each.cases
    # what the grid leaves open no more realisations decide
    open_one = Found(0.55, 0.6, 0.75, 0.8, 10).judged("", (0.0, 0.7))
    assert (open_one.verdict, open_one.enough) == (Verdict.UNDECIDED, math.inf)


@pytest.mark.parametrize(
    "arguments",
    [[], ["publish"], ["publish", "nothing"], ["draw", "area"], ["publish", "area", "x"]],
)
def test_what_is_no_study_is_told_with_the_usage(arguments):
    with pytest.raises(SystemExit, match="python -m studies reduce NAME"):
        main(arguments)
