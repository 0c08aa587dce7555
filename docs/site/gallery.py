# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""The gallery of the cases: a picture of each, its animation and its report, made by the program."""
import concurrent.futures
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import moving

# How a case is run for its page, where that is not by its defaults under its first law: parameters, laws,
# and the stretch [s] that the animation shows.
SHOWN = {
    "scotch_yoke": {"law": ["johnson", "table11-johnson"]},
    "slider_crank_clearance": {"set": ["turns=2"]},
    "quick_return": {"set": ["clearance=0.1mm"]},
    "leaning_rod": {"set": ["angle=50deg"]},
}


def cases_in(index):
    """[(heading, [(name, what it is)])] of the tables in docs/cases/README.md."""
    groups = []
    for part in re.split(r"^## ", index, flags=re.M)[1:]:
        heading, _, body = part.partition("\n")
        rows = re.findall(r"^\| \[(\w+)\]\(\w+\.md\) \| (.*?) \|$", body, flags=re.M)
        if rows:
            groups.append((heading, rows))
    return groups


def run(command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stdout, done.stderr, file=sys.stderr)
        raise SystemExit("docs: failed: " + " ".join(str(c) for c in command))


def replay_in(folder):
    """What is to be animated: of several laws the first in the alphabet."""
    found = sorted(folder.rglob("replay.json"))
    return json.loads(found[0].read_text())


def first_law(yoke, name, settings):
    """[the first law a case offers], or none, also if it has no contacts with these settings."""
    help_ = subprocess.run([yoke, "run", name, "--help"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"^Laws \(--law NAME\)\n +(\S+)", help_, flags=re.M)
    if not found:
        return []
    with tempfile.TemporaryDirectory() as folder:
        taken = subprocess.run([yoke, "view", name, *settings, "--law", found.group(1), "-o", folder], capture_output=True)
    return [found.group(1)] if taken.returncode == 0 else []


def command_of(yoke, name):
    shown = SHOWN.get(name, {})
    settings = [w for setting in shown.get("set", []) for w in ("--set", setting)]
    laws = shown["law"] if "law" in shown else first_law(yoke, name, settings)
    return ["run", name] + settings + [w for law in laws for w in ("--law", law)]


def make_case(yoke, name, runs, pictures, quick):
    run([yoke, "view", name, "-o", runs / name])
    (pictures / f"{name}.svg").write_text(moving.still(moving.replay_of_page(runs / name / "view.html")))
    if quick:
        return
    folder = runs / name / "run"
    run([yoke, *command_of(yoke, name), "--quiet", "--no-plots", "--samples", "801", "--jobs", "1", "-o", folder])
    begin, end = SHOWN.get(name, {}).get("stretch", (None, None))
    (pictures / f"{name}-moving.svg").write_text(moving.animation(replay_in(folder), begin, end, 5.0))


def write(root, source, runs, yoke, quick):
    """Pictures into source/pictures/gallery, the gallery into cases/index.md, a figure into each page."""
    index = source / "cases/index.md"
    groups = cases_in(index.read_text())
    names = [name for _, rows in groups for name, _ in rows]
    pictures = source / "pictures/gallery"
    pictures.mkdir(parents=True, exist_ok=True)
    if runs.exists():
        shutil.rmtree(runs)
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("YOKE_JOBS") or os.cpu_count() or 2)) as pool:
        for done in [pool.submit(make_case, yoke, name, runs, pictures, quick) for name in names]:
            done.result()
    welcome(source, ("scotch_yoke", "geneva", "jansen_leg"), quick)
    text = index.read_text()
    for heading, rows in groups:
        cards = "".join(
            f'<a href="{name}.html"><img src="../pictures/gallery/{name}.svg" alt=""><strong>{name}</strong>'
            f"<span>{html.escape(what)}</span></a>" for name, what in rows)
        table = re.search(rf"^## {re.escape(heading)}\n+((?:\|.*\n)+)", text, flags=re.M)
        text = text.replace(table.group(1), f'```{{raw}} html\n<div class="gallery">{cards}</div>\n```\n')
    index.write_text(text)
    for name in names:
        page = source / f"cases/{name}.md"
        kind = name if quick else f"{name}-moving"
        said = html.escape(" ".join(["yoke", *command_of(yoke, name)])) if not quick else ""
        below = "" if quick else (f'<p><code>{said}</code><br><a href="../reports/{name}.html">The report of this run</a>: '
                                  "mechanism, lens, plots.</p>")
        figure = f'<div class="moving"><img src="../pictures/gallery/{kind}.svg" alt="{name}, drawn from its geometry">{below}</div>'
        title, _, rest = page.read_text().partition("\n")
        page.write_text(f"{title}\n\n```{{raw}} html\n{figure}\n```\n{rest}")


def welcome(source, names, quick):
    """On the first page, mechanisms in place of the picture that a forge shows."""
    page = source / "index.md"
    cards = "".join(f'<a href="cases/{name}.html"><img src="pictures/gallery/{name}{"" if quick else "-moving"}.svg" alt="{name}"></a>'
                    for name in names)
    text, count = re.subn(r'^<img [^>]*>$', f'```{{raw}} html\n<div class="gallery">{cards}</div>\n```', page.read_text(), 1, re.M)
    if count != 1:
        raise SystemExit("docs: docs/README.md shows no picture to put mechanisms in the place of")
    page.write_text(text)


def copy_files(source, site):
    """What pages of HTML name themselves: pictures, and the reports."""
    shutil.copytree(source / "pictures", site / "pictures")
    for report in sorted((source.parent / "runs").glob("*/run/report.html")):
        target = site / "reports" / f"{report.parents[1].name}.html"
        target.parent.mkdir(exist_ok=True)
        shutil.copy(report, target)
