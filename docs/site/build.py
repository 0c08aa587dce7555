#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Builds the site out of docs/: ./dev docs calls this.

The pages stay what they are on a forge: Markdown that links to files. They are copied to a folder of their
own, where the pages of the API, the gallery and the navigation are written beside them; Sphinx makes HTML of
all; and every link of it is followed. docs/README.md is the first page: its headings and lists are the
navigation, so a page that is not in it is an error.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

import api
import check_links
import gallery


def fail(*lines):
    print("\n".join(lines), file=sys.stderr)
    sys.exit(1)


def said(began, what):
    print(f"docs: {what} ({time.monotonic() - began:.1f} s)", file=sys.stderr)


LINK = re.compile(r"(\]\()([^)\s]+)(\))")
IMAGE = re.compile(r'(src=")([^"]+)(")')
EXTRA = {ROOT / "README.md": "readme.md", ROOT / "CHANGELOG.md": "changelog.md"}  # pages outside docs/


def place_of(file, headers):
    """Where a file of the repository is in the site's source, or None: it has no place there."""
    if file.is_relative_to(ROOT / "docs"):
        inside = file.relative_to(ROOT / "docs")
        return inside.with_name("index.md") if inside.name == "README.md" else inside
    inside = file.relative_to(ROOT).as_posix()
    if inside in headers:
        return Path("api") / (inside[:-4] + ".rst")
    if any(h.startswith(inside + "/") for h in headers):
        return Path("api") / (inside.replace("/", "-") + ".rst")
    if file in EXTRA:
        return Path(EXTRA[file])
    if file.is_file() and file.suffix in ("", ".txt"):
        return Path("files") / file.name
    return None


def relinked(text, page, headers, source):
    """Links as the site has them: README.md is index.md, a public header its page."""
    home = place_of(page, headers).parent

    def moved(link):
        link, _, anchor = link.partition("#")
        if not link or "://" in link:
            return None
        file = (page.parent / link).resolve()
        place = place_of(file, headers)
        if place is None:
            fail(f"{page.relative_to(ROOT)}: {link} is not on the site: neither a page nor a public header")
        if place.parts[0] == "files":
            (source / "files").mkdir(exist_ok=True)
            shutil.copy(file, source / place)
        return os.path.relpath(place, home or ".") + ("#" + anchor if anchor else "")

    def target(match):
        new = moved(match.group(2))
        return match.group(1) + (new or match.group(2)) + match.group(3)

    pieces = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    text = "".join(p if p.startswith("```") else IMAGE.sub(target, LINK.sub(target, p)) for p in pieces)
    return re.sub(r"^```mermaid\n(.*?)^```$", diagram, text, flags=re.M | re.S)


def diagram(match):
    """The one kind of mermaid's diagrams that the pages have, as one of Graphviz."""
    edges = re.findall(r"(\w+) --> (\w+)", match.group(1))
    return ("```{graphviz}\ndigraph {\n  node [shape=box, style=\"rounded\", fontname=\"sans-serif\", fontsize=11]\n"
            + "".join(f"  {a} -> {b}\n" for a, b in edges) + "}\n```")


def pages():
    return sorted(p for p in (ROOT / "docs").rglob("*.md") if not p.is_relative_to(HERE))


def stage(source, headers):
    if source.exists():
        shutil.rmtree(source)
    for page in pages():
        inside = page.relative_to(ROOT / "docs")
        target = source / (inside.with_name("index.md") if inside.name == "README.md" else inside)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(relinked(page.read_text(), page, headers, source))
    for picture in sorted((ROOT / "docs").rglob("*")):
        if picture.suffix in (".png", ".svg") and not picture.is_relative_to(HERE):
            target = source / picture.relative_to(ROOT / "docs")
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(picture, target)
    for page, name in EXTRA.items():
        (source / name).write_text(relinked(page.read_text(), page, headers, source))


def navigation(source):
    """Toctrees of docs/README.md: a heading is a caption, the links of the list below it are its pages."""
    text = (source / "index.md").read_text()
    trees, listed = [], {"index"}
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        caption, _, body = part.partition("\n")
        entries = re.findall(r"^ *[*-] \[([^\]]+)\]\(([^)#]+)\)", body, flags=re.M)
        names = [re.sub(r"\.(md|rst)$", "", link) for _, link in entries]
        if names:
            listed.update(names)
            trees.append(f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n"
                         + "\n".join(f"{label} <{name}>" for (label, _), name in zip(entries, names)) + "\n```\n")
    (source / "index.md").write_text(text + "\n" + "\n".join(trees))
    # An index of a folder has the pages of that folder below it.
    for index in sorted(source.rglob("index.md")):
        folder = index.parent.relative_to(source).as_posix()
        if folder == ".":
            continue
        inside = list(dict.fromkeys(
            name for name in re.findall(r"\]\((\w+)\.md\)", index.read_text()) if (index.parent / f"{name}.md").exists()))
        listed.update(f"{folder}/{name}" for name in inside)
        with index.open("a") as file:
            file.write("\n```{toctree}\n:hidden:\n\n" + "\n".join(inside) + "\n```\n")
    lost = [p.relative_to(source).with_suffix("").as_posix() for p in sorted(source.rglob("*.md"))]
    lost = [p for p in lost if p not in listed]
    if lost:
        fail(*[f"docs/{p}.md: no heading of docs/README.md lists this page" for p in lost])


def sphinx(source, site, work):
    command = [sys.executable, "-m", "sphinx", "-b", "html", "-c", str(HERE), "-W", "--keep-going", "-q",
               "-j", os.environ.get("YOKE_JOBS", "auto"), "-d", str(work / "doctrees"), str(source), str(site)]
    if subprocess.run(command).returncode != 0:
        fail("docs: Sphinx has warnings, see above")
    for leftover in (".buildinfo", "objects.inv"):
        (site / leftover).unlink(missing_ok=True)


def main():
    options = argparse.ArgumentParser(description="Builds the site.")
    options.add_argument("--yoke", type=Path, required=True, help="the program yoke, which runs the cases")
    options.add_argument("--quick", action="store_true", help="pictures at rest: no case is run")
    options.add_argument("site", type=Path, help="folder of the site")
    given = options.parse_args()
    began = time.monotonic()
    work = ROOT / "build/docs"
    work.mkdir(parents=True, exist_ok=True)

    broken = check_links.markdown(ROOT)
    if broken:
        fail(*broken, "docs: links of the Markdown are broken")
    headers, silent = api.read(ROOT, work / "api")
    list_of_rooms = (ROOT / "docs/api.md").read_text()
    for room in api.public_rooms(ROOT):
        if f"(../{room})" not in list_of_rooms:
            fail(f"docs/api.md: does not list the public room {room}/")
    if silent:
        fail(*silent, f"docs: {len(silent)} public symbols are not documented")
    said(began, f"{len(headers)} public headers read")
    source = work / "source"
    stage(source, {h.path for h in headers})
    navigation(source)
    api.write(headers, source / "api")
    gallery.write(ROOT, source, work / "runs", given.yoke.resolve(), given.quick)
    said(began, "pictures" if given.quick else "cases run")
    site = given.site.resolve()
    if site.exists():
        if any(site.iterdir()) and not (site / "index.html").exists():
            fail(f"docs: {site} holds something else than a site")
        shutil.rmtree(site)
    sphinx(source, site, work)
    gallery.copy_files(source, site)
    said(began, "pages made")
    broken, links = check_links.site(site)
    if broken:
        fail(*broken, f"docs: {len(broken)} links are broken")
    said(began, f"{links} links followed")
    print(site / "index.html")


if __name__ == "__main__":
    main()
