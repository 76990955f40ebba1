"""The handbook's settings for Sphinx; ``make docs`` builds it into ``out/docs``."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import made  # beside this file
from roughline import __version__

made.write_pages(Path(__file__).parent)

project = "roughline"
author = "The roughline developers"
project_copyright = author
version = release = __version__

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "sphinx-mathjax-offline",
]
exclude_patterns = ["gallery"]
templates_path = ["templates"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
autosummary_generate = True
autosummary_filename_map = made.FILES_OF_NAMES
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings tell types, with shapes and units
numpydoc_show_class_members = False
copybutton_prompt_text = r"\$ |>>> "
copybutton_prompt_is_regexp = True

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "made/gallery",
    "filename_pattern": "/",
    "within_subsection_order": "made.place_in_gallery",
    "abort_on_example_error": True,
    "remove_config_comments": True,
    "capture_repr": (),
    "show_memory": False,
    "write_computation_times": False,
}

WIDE = (
    *("paper", "trust", "averaging", "area", "finite_size", "sealing", "correlations"),
    "engineering",
    *("measured", "intervals_hold", "flow"),
    *("made/validation", "made/materials", "made/fluids", "made/formats"),
    *("architecture", "conventions", "other_programs", "science"),
)

html_theme = "pydata_sphinx_theme"
html_title = f"roughline {version}"
html_static_path = ["static"]
html_css_files = ["handbook.css"]
html_theme_options = {
    "show_toc_level": 2,
    "navigation_with_keys": False,
    # Pages with wide tables have the whole width.
    "secondary_sidebar_items": {"**": ["page-toc"]} | {page: [] for page in WIDE},
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
}
if "ROUGHLINE_HANDBOOKS" in os.environ:  # the address of all versions' handbooks, set by a release
    html_theme_options |= {
        "switcher": {
            "json_url": f"{os.environ['ROUGHLINE_HANDBOOKS']}/versions.json",
            "version_match": version,
        },
        "navbar_end": ["version-switcher", "theme-switcher", "navbar-icon-links"],
        "check_switcher": False,  # the file is written when the handbook is published
    }


def setup(app):
    """Let links lead to pages that are made, where the repository has what they are made of."""
    app.connect("source-read", _link_made_pages)


def _link_made_pages(app, page, source):
    if not page.startswith("made/"):
        source[0] = made.with_made_pages(page, source[0])
