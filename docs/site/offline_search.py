# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Lines from the pages found, also where the site is opened as files.

Sphinx's search fetches each page that it has found to show where. A browser fetches nothing for a page opened
from disk. So the search page gets the texts of all pages with it, and its questions are answered from there.
"""
import html
import json
import re
from pathlib import Path

from docutils import nodes

ANSWER = """
if (location.protocol === "file:") {
  window.fetch = (address) => {
    const page = Object.keys(YOKE_TEXTS).find((name) => String(address).split("#")[0].endsWith(name));
    return Promise.resolve({text: () => Promise.resolve(page ? YOKE_TEXTS[page] : "")});
  };
}
"""


def words(node):
    """The text of a page, what stands in it as HTML too."""
    if isinstance(node, nodes.raw):
        return html.unescape(re.sub(r"<[^>]+>", " ", node.astext())) if node.get("format") == "html" else ""
    if isinstance(node, nodes.Text):
        return node.astext()
    between = "" if isinstance(node, (nodes.TextElement, nodes.literal)) else " "
    return between.join(words(child) for child in node.children)


def write(app, error):
    if error or app.builder.format != "html":
        return
    texts = {}
    for name in sorted(app.env.found_docs):
        text = re.sub(r"\s+", " ", words(app.env.get_doctree(name)))
        texts["/" + app.builder.get_target_uri(name)] = f'<div role="main"><p>{html.escape(text)}</p></div>'
    script = "const YOKE_TEXTS = " + json.dumps(texts, ensure_ascii=False) + ";" + ANSWER
    (Path(app.outdir) / "_static" / "search_texts.js").write_text(script)


def add(app, pagename, templatename, context, doctree):
    if pagename == "search":
        app.add_js_file("search_texts.js", priority=200)


def setup(app):
    app.connect("html-page-context", add)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
