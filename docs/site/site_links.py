# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""`Revolute` and `core/model.hpp` in a page link to what the API says of them."""
import json
from pathlib import Path

from docutils import nodes
from sphinx.util import relative_uri

# Words that are names of the API and also mean something else in a sentence.
PLAIN = {"ground", "pi", "verify", "draw", "cross", "motion", "chain", "circle", "equilibrium", "modes", "resume",
         "dwell", "version", "pin", "slot", "cubic", "formulations"}


def link(app, doctree, docname):
    if docname.startswith("api/"):
        return
    names = app.env.yoke_names
    here = app.builder.get_target_uri(docname)
    for node in list(doctree.findall(nodes.literal)):
        if isinstance(node.parent, nodes.reference) or any(isinstance(p, nodes.title) for p in ancestors(node)):
            continue
        word = node.astext()
        word = word[:-2] if word.endswith("()") else word
        if word in PLAIN or word not in names:
            continue
        page, _, anchor = names[word].partition("#")
        uri = relative_uri(here, page) + ("#" + anchor if anchor else "")
        reference = nodes.reference("", "", internal=True, refuri=uri)
        node.replace_self(reference)
        reference += node


def ancestors(node):
    while node.parent is not None:
        node = node.parent
        yield node


def read_names(app):
    path = Path(app.srcdir) / "api" / "names.json"
    app.env.yoke_names = json.loads(path.read_text()) if path.exists() else {}


def setup(app):
    app.connect("builder-inited", read_names)
    app.connect("doctree-resolved", link)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
