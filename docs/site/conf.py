# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Settings of Sphinx; build.py calls it."""
import os
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

project = "Yoke"
author = "the Yoke authors"
copyright = "2026 the Yoke authors"
release = re.search(r'version = "([\d.]+)"', (ROOT / "core/version.hpp").read_text()).group(1)

extensions = ["myst_parser", "sphinx.ext.graphviz", "katex_math", "site_links", "offline_search"]
root_doc = "index"
exclude_patterns = []
nitpicky = True

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
myst_dmath_double_inline = False
math_numfig = False
suppress_warnings = ["myst.header"]

html_math_renderer = "katex"
graphviz_output_format = "svg"

html_theme = "furo"
html_title = f"Yoke {release}"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_use_index = False
html_theme_options = {
    # A line of code, 100 characters, fits.
    "light_css_variables": {"code-font-size": "0.73rem", "color-brand-primary": "#24588f", "color-brand-content": "#24588f"},
    "dark_css_variables": {"color-brand-primary": "#8ab4e8", "color-brand-content": "#8ab4e8"},
}
highlight_language = "none"
pygments_style = "friendly"
pygments_dark_style = "material"
