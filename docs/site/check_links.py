# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Follows links: those of the Markdown as a forge shows it, and those of the site. The network is left alone."""
import html.parser
import re
import urllib.parse
from pathlib import Path


def slug(heading):
    """The anchor that forges give a heading."""
    text = re.sub(r"[`*]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip()))
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^ *```.*?^ *```$", "", text, flags=re.M | re.S))


def anchors(path):
    text = re.sub(r"^```.*?^```$", "", path.read_text(), flags=re.M | re.S)
    found, seen = set(), {}
    for heading in re.findall(r"^#+ (.+)$", text, flags=re.M):
        name = slug(heading)
        count = seen.get(name, 0)
        seen[name] = count + 1
        found.add(name if count == 0 else f"{name}-{count}")
    return found | set(re.findall(r'id="([^"]+)"', text))


def markdown(root):
    """What is broken in README.md, CHANGELOG.md and docs/, as lines."""
    broken = []
    pages = [root / "README.md", root / "CHANGELOG.md", *sorted((root / "docs").rglob("*.md"))]
    for page in pages:
        text = without_code(page.read_text())
        for target in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text):
            link, _, anchor = target.partition("#")
            if "://" in link or link.startswith("mailto:"):
                continue
            file = (page.parent / link).resolve() if link else page
            where = f"{page.relative_to(root)}: {target}"
            if not file.exists():
                broken.append(f"{where}: no such file")
            elif anchor and file.suffix == ".md" and anchor not in anchors(file):
                broken.append(f"{where}: no such heading")
    return broken


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.ids, self.links, self.loaded = set(), [], []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag == "link" and given.get("rel") in ("stylesheet", "icon", "preload"):
            self.loaded.append(given.get("href") or "")
        elif tag != "a" and given.get("src"):
            self.loaded.append(given["src"])
        for name, value in attributes:
            if name == "id" or (name == "name" and tag == "a"):
                self.ids.add(value)
            elif name in ("href", "src", "data") and value is not None and tag != "use":
                self.links.append(value)


def site(folder):
    """(what is broken, how many links there are) of the HTML in a folder. Also what is loaded from elsewhere."""
    pages = {}
    for path in sorted(folder.rglob("*.html")):
        if "reports" in path.relative_to(folder).parts:
            continue  # pages of the program, which its own tests look at
        page = Page()
        page.feed(path.read_text())
        pages[path.resolve()] = page
    broken, count = [], 0
    for path, page in pages.items():
        broken += [f"{path.relative_to(folder.resolve())}: loads {link} from elsewhere"
                   for link in page.loaded if re.match(r"(https?:)?//", link)]
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ("http", "https", "mailto", "data"):
                continue
            count += 1
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            anchor = urllib.parse.unquote(parts.fragment)
            where = f"{path.relative_to(folder.resolve())}: {link}"
            if not target.exists():
                broken.append(f"{where}: no such file")
            elif anchor and target in pages and anchor not in pages[target].ids:
                broken.append(f"{where}: no such place")
    return sorted(set(broken)), count
