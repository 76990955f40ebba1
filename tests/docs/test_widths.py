"""Pages with wide tables, as a browser sets them in a window of 1200 pixels."""

from pathlib import Path

from markdown_it import MarkdownIt

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted(path for path in DOCS.glob("*.md") if "\n|--" in path.read_text("utf-8"))
STYLE = (
    "body { font: 16px/1.5 'DejaVu Sans', sans-serif; margin: 0 32px } "
    "table { border-collapse: collapse } "
    "td, th { padding: 6px 13px; border: 1px solid #ccc } img { max-width: 100% }"
)


def test_tables_do_not_run_out_of_the_page(browser):
    reader = MarkdownIt("commonmark").enable("table")
    studies = ("area", "averaging", "correlations", "finite_size", "friction", "paper", "sealing")
    assert {f"{name}.md" for name in studies} <= {p.name for p in PAGES}
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    for path in PAGES:
        page.set_content(f"<style>{STYLE}</style>{reader.render(path.read_text('utf-8'))}")
        widths = page.evaluate("() => [document.body.scrollWidth, document.body.clientWidth]")
        assert widths[0] <= widths[1], f"{path.name} is {widths[0]} pixels wide"
    page.close()
