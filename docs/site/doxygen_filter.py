# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""What Doxygen reads in place of a header: the comments that document, as they stand.

The headers' comments are written for people: the comment at the head explains what the header is
for, a comment behind a member its unit and sign. Doxygen would take neither for documentation, and
would read commands into formulas. So this filter turns `// text` behind a declaration and `/// text`
before one into documentation without any markup, and gives the comment at the head to the type that
the file is named after, if that has none of its own. Lines stay where they are.
"""
import re
import sys
from pathlib import Path

OPEN, CLOSE = "\\verbatim ", " \\endverbatim"
DECLARES = re.compile(r"^(?:template <.*> )?(?:struct|class|enum class) (?:\[\[\w+\]\] )?(\w+)\b(?!;)")


def trailing_comment(line):
    """(code, comment) of a line with code and a comment behind it, else None."""
    in_string, i = False, 0
    while i < len(line) - 1:
        c = line[i]
        if in_string:
            if c == "\\":
                i += 1
            elif c == '"':
                in_string = False
        elif c == '"':
            in_string = True
        elif c == "/" and line[i + 1] == "/":
            code = line[:i].rstrip()
            return (code, line[i:]) if code.strip() else None
        i += 1
    return None


def stripped(comment):
    """The text of one line of comment, its own indentation kept."""
    text = re.sub(r"^//[/!]?<?", "", comment.strip())
    return text[1:] if text.startswith(" ") else text


def head_of(lines):
    """Where the comment at the head of the file stands: behind the licence, before #pragma once."""
    begin = 0
    while begin < len(lines) and re.match(r"// (SPDX|Copyright)", lines[begin]):
        begin += 1
    if begin < len(lines) and lines[begin].strip() == "//":
        begin += 1
    end = begin
    while end < len(lines) and lines[end].startswith("//"):
        end += 1
    return begin, end


def spoken_for(lines, i):
    """Whether the declaration on line i has a comment of its own."""
    while i > 0 and re.match(r"\s*(template <|requires )", lines[i - 1]):
        i -= 1
    return i > 0 and lines[i - 1].lstrip().startswith("///")


def block(texts, opener):
    texts = [t.replace("*/", "* /") for t in texts]
    return [opener + OPEN + texts[0]] + texts[1:-1] + ([texts[-1]] if len(texts) > 1 else [])


def filtered(path):
    lines = path.read_text().split("\n")
    begin, end = head_of(lines)
    head = [stripped(l) for l in lines[begin:end]]
    wanted = "".join(part.capitalize() for part in path.stem.split("_")).lower()
    out, i = [], 0
    while i < len(lines):
        line = lines[i]
        if i == begin and head:
            lead = block(head, "/** \\file " + path.name + " ")
            lead[-1] += CLOSE + " */"
            out += lead
            i = end
            continue
        if line.lstrip().startswith("///"):
            texts = []
            while i < len(lines) and lines[i].lstrip().startswith("///"):
                texts.append(stripped(lines[i]))
                i += 1
            made = block(texts, "/** ")
            made[-1] += CLOSE + " */"
            out += made
            continue
        found = DECLARES.match(line)
        if found and found.group(1).lower() == wanted and head and not spoken_for(lines, i):
            # On the same line, so that no line moves.
            line = "/** " + OPEN + "@head" + CLOSE + " */ " + line
            out.append(line)
            i += 1
            continue
        comment = trailing_comment(line)
        if comment and re.match(r"\s*enum class \w+ \{.*\};", comment[0]):
            out.append("/** " + OPEN + stripped(comment[1]) + CLOSE + " */ " + comment[0])
            i += 1
            continue
        if comment and (comment[1].startswith("///<") or
                        not comment[0].rstrip().endswith(("{", "(", "&&", "||", "?", ":"))):
            code, text = comment
            texts = [stripped(text)]
            column = line.index(text)
            while (i + 1 < len(lines) and lines[i + 1].strip().startswith("//")
                   and not lines[i + 1].strip().startswith("///")
                   and len(lines[i + 1]) - len(lines[i + 1].lstrip()) >= max(column - 2, 8)):
                i += 1
                texts.append(stripped(lines[i]))
            made = block(texts, code + "  /**< ")
            made[-1] += CLOSE + " */"
            out += made
            i += 1
            continue
        out.append(line)
        i += 1
    return "\n".join(out)


if __name__ == "__main__":
    sys.stdout.write(filtered(Path(sys.argv[1])))
