"""The page on words of the trade answers those by which people search, or says who does."""

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "words.md").read_text("utf-8")
ROWS = [line for line in PAGE.splitlines() if line.startswith("| ")][1:]


@pytest.mark.parametrize(
    "word",
    [
        *("O-ring", "gasket", "AFM tip", "DIC", "xlsx", "TIFF", "Abbott", "Rk", "PSD", "Hurst"),
        *("JKR", "Persson", "contact resistance", "TCR", "leak rate", "Cattaneo", "fretting"),
        *("roll-off", "lay", "Ra"),
    ],
)
def test_a_word_of_the_trade_leads_to_pages_that_hold_it(word):
    rows = [row for row in ROWS if re.search(rf"\b{word}\b", row.split(" | ")[0])]
    assert rows
    for row in rows:
        linked = [DOCS / link for link in re.findall(r"\]\(([^)#]+)", row)]
        assert any(re.search(rf"\b{word}\b", page.read_text("utf-8")) for page in linked)
