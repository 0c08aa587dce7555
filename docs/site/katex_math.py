# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Formulas as HTML in the pages themselves, by KaTeX while the site is built: a reader needs no script."""
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

from docutils import nodes
from sphinx.errors import ExtensionError
from sphinx.util import logging

HERE = Path(__file__).resolve().parent
KATEX = Path("/usr/share/javascript/katex")


class Katex:
    process, owner = None, None

    @classmethod
    def html(cls, tex, display):
        if cls.owner != os.getpid():  # Sphinx forks: each process asks a node of its own
            cls.owner = os.getpid()
            cls.process = subprocess.Popen(["node", str(HERE / "katex.mjs")], stdin=subprocess.PIPE,
                                           stdout=subprocess.PIPE, text=True)
        cls.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        cls.process.stdin.flush()
        line = cls.process.stdout.readline()
        if not line:
            raise ExtensionError("node does not answer: are katex and nodejs installed (packages.txt, group docs)?")
        return json.loads(line)


def visit(translator, node, display):
    answer = Katex.html(node.astext(), display)
    if "error" in answer:
        logging.getLogger(__name__).warning("formula: %s: %s", answer["error"], node.astext(), location=node)
        answer["html"] = ""
    if display:
        number = node.get("number")
        label = f'<span class="eqno">({number})</span>' if number else ""
        ids = node.get("ids", [])
        translator.body.append(f'<div class="math"{f" id={chr(34)}{ids[0]}{chr(34)}" if ids else ""}>{label}{answer["html"]}</div>\n')
    else:
        translator.body.append(f'<span class="math">{answer["html"]}</span>')
    raise nodes.SkipNode


def copy_style(app, error):
    if error or app.builder.format != "html":
        return
    if not (KATEX / "katex.min.css").exists():
        raise ExtensionError("KaTeX was not found: is libjs-katex installed (packages.txt, group docs)?")
    target = Path(app.outdir) / "_static" / "katex"
    (target / "fonts").mkdir(parents=True, exist_ok=True)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, target / "fonts")
    # The newest format of the fonts alone: what is not copied must not be asked for.
    older = re.compile(r",url\(fonts/[^)]*\.(?:woff|ttf)\) format\(.[a-z]+.\)")
    (target / "katex.min.css").write_text(older.sub("", (KATEX / "katex.min.css").read_text()))


def setup(app):
    app.add_html_math_renderer("katex", (lambda t, n: visit(t, n, False), lambda t, n: None),
                               (lambda t, n: visit(t, n, True), lambda t, n: None))
    app.add_css_file("katex/katex.min.css")
    app.connect("build-finished", copy_style)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
