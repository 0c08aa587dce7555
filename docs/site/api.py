# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""The pages of the API: Doxygen reads the public headers, this writes a page for each.

A public symbol that nothing is said about is an error: `read` returns them with file and line.
"""
import html
import json
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import CppLexer

import common_members
import doxygen_filter

DOXYFILE = """
PROJECT_NAME = Yoke
OUTPUT_DIRECTORY = {out}
INPUT = {headers}
FILE_PATTERNS = *.hpp
RECURSIVE = YES
STRIP_FROM_PATH = {headers}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
MARKDOWN_SUPPORT = NO
AUTOLINK_SUPPORT = NO
EXTRACT_ALL = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = NO
ENABLE_PREPROCESSING = YES
MACRO_EXPANSION = NO
PREDEFINED = DOXYGEN
"""

@dataclass
class Symbol:
    name: str
    kind: str
    signature: str
    text: str
    file: str
    line: int
    protected: bool = False
    anchor: str = ""
    members: list = field(default_factory=list)
    bases: list = field(default_factory=list)
    one_line: bool = False  # of an enum


@dataclass
class Header:
    path: str  # core/model.hpp
    head: str
    symbols: list


def public_rooms(root):
    """The rooms CMake installs: the one list there is."""
    text = (root / "CMakeLists.txt").read_text()
    return re.search(r"set\(yoke_public_rooms\s+([^)]*)\)", text).group(1).split()


def run_doxygen(root, work):
    """Doxygen's XML of the filtered headers; the folder it is in."""
    headers = work / "headers"
    for room in public_rooms(root):
        for header in sorted((root / room).glob("*.hpp")):
            target = headers / room / header.name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(doxygen_filter.filtered(header))
    settings = work / "Doxyfile"
    settings.write_text(DOXYFILE.format(out=work, headers=headers))
    subprocess.run(["doxygen", str(settings)], check=True)
    return work / "xml", headers


def flat(node):
    return re.sub(r"\s+", " ", "".join(node.itertext())).strip() if node is not None else ""


def doc_of(node):
    """What the comments at a symbol say, as they are written."""
    found = []
    for part in ("briefdescription", "detaileddescription"):
        child = node.find(part)
        if child is not None:
            found += ["".join(v.itertext()).rstrip() for v in child.iter("verbatim")]
    return "\n\n".join(dedented(text) for text in found)


def dedented(text):
    """The first line comes without its indentation, the others with."""
    return "\n".join(line.rstrip() for line in text.strip("\n ").split("\n"))


def template_of(node):
    params = node.find("templateparamlist")
    if params is None:
        return ""
    parts = []
    for p in params.findall("param"):
        text = flat(p.find("type"))
        name, default = flat(p.find("declname")), flat(p.find("defval"))
        parts.append(text + (" " + name if name and not text.endswith(name) else "")
                     + (" = " + default if default else ""))
    requires = flat(node.find("requiresclause"))
    return "template <" + ", ".join(parts) + ">\n" + ("requires " + requires + "\n" if requires else "")


def signature_of(node):
    kind = node.get("kind")
    type_, name = flat(node.find("type")), flat(node.find("name"))
    args, initial = flat(node.find("argsstring")), flat(node.find("initializer"))
    if kind == "enum":
        scoped = "enum class " if node.get("strong") == "yes" else "enum "
        return scoped + name
    if kind == "typedef":
        return f"using {name} = {type_}" if "using" in flat(node.find("definition")) else f"typedef {type_} {name}"
    front = template_of(node)
    if node.get("explicit") == "yes":
        front += "explicit "
    if node.get("static") == "yes" and "static" not in type_:
        front += "static "
    if node.get("virt") in ("virtual", "pure-virtual") and not args.rstrip().endswith("override"):
        front += "virtual "
    args = re.sub(r"=0$", " = 0", args)
    initial = " " + initial if initial.startswith("=") else initial
    if len(initial) > 80 or "\n" in initial:
        initial = ""
    return tidied(f"{front}{type_} {name}{args}{initial}".replace("  ", " ").strip().replace("\n ", "\n"))


def tidied(text):
    """Spaces as the headers have them: std::vector<Vec2>, const Model& model."""
    text = re.sub(r"< (?=\S)", "<", text)
    text = re.sub(r"(?<=[\w>*&]) (?=>)", "", text)
    return re.sub(r" ([&*]+) ?(?=[\w)])", r"\1 ", text).replace("& )", "&)").replace("* )", "*)")


def place(node, headers):
    location = node.find("location")
    file = location.get("declfile") or location.get("file")
    return str(Path(file)).replace(str(headers) + "/", ""), int(location.get("declline") or location.get("line") or 0)


def member(node, headers, outer):
    file, line = place(node, headers)
    symbol = Symbol(flat(node.find("name")), node.get("kind"), signature_of(node), doc_of(node), file,
                    line, node.get("prot") == "protected")
    if symbol.kind == "enum":
        symbol.one_line = "}" in (headers / file).read_text().split("\n")[line - 1]
        for value in node.findall("enumvalue"):
            init = flat(value.find("initializer"))
            symbol.members.append(Symbol(flat(value.find("name")), "value",
                                         flat(value.find("name")) + (" " + init if init else ""),
                                         doc_of(value), file, line))
    return symbol


def wanted_member(node, class_name):
    if node.get("prot") not in ("public", "protected") or node.get("kind") == "friend":
        return False
    name = flat(node.find("name"))
    return name and not name.startswith("~") and "delete" not in flat(node.find("argsstring"))[-8:]


def compound(node, compounds, headers):
    """A class, struct or concept with its members and public types inside."""
    file, line = place(node, headers)
    full = re.sub(r"^yoke::", "", flat(node.find("compoundname")))
    kind = node.get("kind")
    name = full.split("::")[-1] if "<" not in full else full
    bases = [flat(b) for b in node.findall("basecompoundref") if b.get("prot") == "public"]
    front = template_of(node)
    if kind == "concept":
        signature = concept_source((headers / file).read_text().split("\n"), line - 1)
    else:
        signature = f"{front}{kind} {name}" + (" : " + ", ".join(bases) if bases else "")
    symbol = Symbol(full, kind, signature, doc_of(node), file, line, node.get("prot") == "protected",
                    bases=bases)
    for section in node.findall("sectiondef"):
        for m in section.findall("memberdef"):
            if wanted_member(m, name):
                symbol.members.append(member(m, headers, full))
    for inner in node.findall("innerclass"):
        if inner.get("prot") == "public":
            symbol.members.append(compound(compounds[inner.get("refid")], compounds, headers))
    symbol.members.sort(key=lambda s: s.line)
    share(symbol.members)
    return symbol


def share(symbols):
    """One comment stands for all that one line declares, and for the overloads of a function."""
    for s in symbols:
        if s.text:
            continue
        for other in symbols:
            one_line = other.line == s.line and other.kind == s.kind != "function"
            overload = other.name == s.name and s.kind == "function" and other.kind == "function"
            if other.text and (one_line or overload):
                s.text = other.text if one_line else "Overload: see " + s.name + "()."


def concept_source(lines, begin):
    """A concept as its header has it, without comments: Doxygen puts it on one line."""
    end = begin
    while end < len(lines) - 1 and not lines[end].startswith("};"):
        end += 1
    while begin > 0 and lines[begin - 1].startswith("template"):
        begin -= 1
    text = "\n".join(lines[begin:end + 1])
    return re.sub(r"\n */\*\*.*?\*/", "", text, flags=re.S)


def read(root, work):
    """All public headers, and what nothing is said about: "core/model.hpp:12: Model::add"."""
    xml, headers = run_doxygen(root, work)
    index = ElementTree.parse(xml / "index.xml").getroot()
    compounds = {}
    for entry in index.findall("compound"):
        if entry.get("kind") in ("class", "struct", "concept", "namespace", "file"):
            tree = ElementTree.parse(xml / (entry.get("refid") + ".xml")).getroot()
            compounds[entry.get("refid")] = tree.find("compounddef")
    found = {}
    for room in public_rooms(root):
        for header in sorted((root / room).glob("*.hpp")):
            path = f"{room}/{header.name}"
            lines = header.read_text().split("\n")
            begin, end = doxygen_filter.head_of(lines)
            head = "\n".join(doxygen_filter.stripped(l) for l in lines[begin:end])
            found[path] = Header(path, head, [])
    inner = {i.get("refid") for c in compounds.values() if c.get("kind") in ("class", "struct")
             for i in c.findall("innerclass")}
    for refid, node in compounds.items():
        kind, name = node.get("kind"), flat(node.find("compoundname"))
        if kind in ("class", "struct", "concept"):
            if refid in inner or not name.startswith("yoke::"):
                continue  # Eigen's traits are no matter of the reader's
            symbol = compound(node, compounds, headers)
            found[symbol.file].symbols.append(symbol)
        elif kind == "namespace" and name.startswith("yoke"):
            for section in node.findall("sectiondef"):
                for m in section.findall("memberdef"):
                    symbol = member(m, headers, name)
                    if symbol.file in found and symbol.name:
                        found[symbol.file].symbols.append(symbol)
    silent = []
    classes = {s.name: s for h in found.values() for s in h.symbols if s.kind in ("class", "struct")}
    for header in found.values():
        header.symbols.sort(key=lambda s: s.line)
        share(header.symbols)
        if not header.head:
            silent.append(f"{header.path}:1: no comment at the head")
        for symbol in header.symbols:
            complete(symbol, None, classes, silent)
    return list(found.values()), sorted(set(silent))


def complete(symbol, outer, classes, silent):
    """Gives anchors, and the words of members that mean the same everywhere."""
    full = f"{outer.name}::{symbol.name}" if outer and "::" not in symbol.name else symbol.name
    symbol.anchor = re.sub(r"[^A-Za-z0-9_.~+*/<>=!-]", "", full.replace("::", "."))
    if not symbol.text and outer and symbol.kind == "function":
        symbol.text = common_members.inherited(symbol, outer.bases, classes)
    if not symbol.text:
        symbol.text = common_members.text_of(symbol, outer)
    if not symbol.text:
        silent.append(f"{symbol.file}:{symbol.line}: {full}")
    # `enum class Side { left, right };  // of the curve`: the comment says what there is to say.
    if symbol.kind == "enum" and symbol.text and symbol.one_line:
        return
    for m in symbol.members:
        complete(m, symbol, classes, silent)


# How it is written.

FORMATTER = HtmlFormatter(nowrap=True)


def code(text):
    return f'<div class="highlight"><pre>{highlight(text, CppLexer(), FORMATTER).rstrip()}</pre></div>'


def inline(text, links):
    """Text with `code` and names of headers as code; names that have a page become links."""
    def linked(word):
        shown = f'<code class="docutils literal notranslate">{html.escape(word)}</code>'
        target = links.get(word.replace("()", ""))
        return f'<a href="{target}">{shown}</a>' if target else shown
    parts = re.split(r"(`[^`\n]+`|(?:core|joints|contact|integrators)/[\w/]+\.hpp|\b[A-Z][a-z]+[A-Z]\w+\b)", text)
    out = []
    for part in parts:
        if part.startswith("`") and part.endswith("`") and len(part) > 2:
            out.append(linked(part[1:-1]))
        elif part in links:
            out.append(linked(part))
        else:
            out.append(html.escape(part))
    return "".join(out)


def prose(text, links):
    """A comment as HTML: paragraphs, lists, and lines that are indented as they stand."""
    out, paragraph, fixed = [], [], []

    def flush():
        if paragraph:
            out.append("<p>" + inline(" ".join(paragraph), links) + "</p>")
            paragraph.clear()
        if fixed:
            while fixed and not fixed[-1].strip():
                fixed.pop()
            margin = min((len(l) - len(l.lstrip()) for l in fixed if l.strip()), default=0)
            out.append('<pre class="formula">' + inline("\n".join(l[margin:] for l in fixed), links) + "</pre>")
            fixed.clear()

    for line in text.split("\n"):
        if not line.strip():
            if fixed:
                fixed.append("")
            else:
                flush()
        elif line.startswith("  "):
            if paragraph:
                flush()
            fixed.append(line)
        else:
            if fixed:
                flush()
            paragraph.append(line.strip())
    flush()
    return "\n".join(out)


def members_html(symbol, links):
    rows = []
    for m in symbol.members:
        label = '<span class="protected">protected</span> ' if m.protected else ""
        signature = m.signature + (";" if m.kind not in ("value", "concept") else "")
        rows.append(f'<div class="member" id="{html.escape(m.anchor)}">{code(signature)}'
                    f'<div class="said">{label}{prose(m.text, links)}</div>'
                    + (members_html(m, links) if m.members else "") + "</div>")
    return '<div class="members">' + "\n".join(rows) + "</div>"


def indented(text):
    return "\n".join("   " + l if l else "" for l in text.split("\n"))


def page(header, links):
    title, room = header.path, header.path.rsplit("/", 1)[0]
    up = "../" * room.count("/") + "../" + room.replace("/", "-")
    # Not in the navigation, which would double: the page of the room lists it.
    out = [":orphan:", "", title, "=" * len(title), "", f":doc:`API </api>` / :doc:`{room}/ <{up}>`", "",
           ".. code-block:: cpp", "",
           f"   #include <yoke/{header.path}>", ""]
    if header.head:
        out += [".. raw:: html", "", indented(prose(header.head, links)), ""]
    for group in grouped(header.symbols):
        symbol = group[0]
        name = symbol.name
        shown = name.replace("*", "\\*").replace("_", "\\_").replace("|", "\\|")
        out += ["", ".. _api-" + re.sub(r"\W", "-", header.path + "-" + name + str(symbol.line)) + ":", "",
                shown, "-" * (len(shown) + 2), "", ".. raw:: html", ""]
        for s in group:
            text = "" if s.text == "@head" else prose(s.text, links)
            signature = s.signature + (";" if s.kind not in ("concept",) else "")
            out.append(indented(f'<div class="symbol" id="{html.escape(s.anchor)}">{code(signature)}{text}'
                                + (members_html(s, links) if s.members else "") + "</div>"))
        out.append("")
    return "\n".join(out) + "\n"


def grouped(symbols):
    """Functions of one name stand together."""
    groups = []
    for s in symbols:
        if groups and groups[-1][0].name == s.name:
            groups[-1].append(s)
        else:
            groups.append([s])
    return groups


def first_sentence(text):
    text = re.split(r"\n\n|\n {2,}", text)[0].replace("\n", " ")
    found = re.match(r"(.+?[.:;])(?: |$)", text)
    return (found.group(1) if found else text).rstrip(".:;,")


def all_links(headers, up):
    """What a name links to, seen from a page `up` ("../") below api/. Ambiguous names have none."""
    links, taken = {}, set()
    for h in headers:
        target = up + h.path[:-4] + ".html"
        links[h.path] = target
        for s in h.symbols:
            if s.name in links and s.name not in taken:
                if links[s.name].split("#")[0] != target:
                    taken.add(s.name)
                continue
            if s.kind in ("function", "variable") and len(s.name) < 4:
                continue
            links[s.name] = target + "#" + s.anchor
    for name in taken:
        links.pop(name, None)
    return links


def write(headers, folder):
    """One page a header, one a room; docs/api.md has the list of the rooms, and gets them below it."""
    rooms = {}
    for h in headers:
        rooms.setdefault(h.path.rsplit("/", 1)[0], []).append(h)
    for room, inside in rooms.items():
        depth = room.count("/") + 1
        links = all_links(headers, "../" * depth)
        for h in inside:
            target = folder / (h.path[:-4] + ".rst")
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(page(h, links))
        flat_name = room.replace("/", "-")
        out = [room + "/", "=" * (len(room) + 1), "", ".. list-table::", "   :widths: 40 60", ""]
        for h in inside:
            out += [f"   - - :doc:`{h.path.rsplit('/', 1)[1]} <{h.path[:-4]}>`",
                    f"     - {escaped(first_sentence(h.head))}"]
        (folder / f"{flat_name}.rst").write_text("\n".join(out) + "\n")
    (folder / "names.rst").write_text(names_page(headers))
    (folder / "names.json").write_text(json.dumps(all_links(headers, "api/")))
    with folder.with_suffix(".md").open("a") as page_of_all:
        page_of_all.write("\n[All names](api/names.rst), by the alphabet.\n\n```{toctree}\n:hidden:\n\n"
                          + "".join(f"{room}/ <api/{room.replace('/', '-')}>\n" for room in rooms)
                          + "All names <api/names>\n```\n")


def names_page(headers):
    entries = sorted({(s.name, s.kind, h.path, s.anchor) for h in headers for s in h.symbols},
                     key=lambda e: e[0].lower())
    items = "".join(f'<li><a href="{p[:-4]}.html#{html.escape(a)}"><code>{html.escape(n)}</code></a> '
                    f"<small>{k}, {p}</small></li>" for n, k, p, a in entries)
    return "All names\n=========\n\n.. raw:: html\n\n   <ul class=\"names\">" + items + "</ul>\n"


def escaped(text):
    return re.sub(r"([\\`*|_])", r"\\\1", text)
