"""The page on words of the trade answers those by which people search, or says who does."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "words.md").read_text("utf-8")
ROWS = [line for line in PAGE.splitlines() if line.startswith("| ")][1:]


@pytest.mark.parametrize(
    "word",
    [
        *("O-ring", "gasket", "AFM tip", "DIC", "xlsx", "TIFF", "Abbott", "Rk", "PSD", "Hurst"),
        *("JKR", "Persson", "contact resistance", "TCR", "leak rate", "Cattaneo", "fretting"),
        *("roll-off", "lay", "Ra"),
    ],
)
def test_a_word_of_the_trade_leads_to_a_page(word):
    rows = [row for row in ROWS if re.search(rf"\b{word}\b", row.split(" | ")[0])]
    assert rows
    assert all("](" in row for row in rows)
