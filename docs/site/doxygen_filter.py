"""Doxygen's input filter: our header comments, with columns aligned by spaces, as lists that Doxygen reads.

    ///   formula   1 / sqrt(1 + W0(K^2 / 8 pi))            - **formula** 1 / sqrt(…)
    ///   domain    0 <= K      range  [0, 1]          →    - **domain** 0 \\<= K
                                                            - **range** [0, 1]

Indented lines without columns are code. A comment at the head of a file is that of the file. Characters that
Doxygen would take for commands are escaped.
"""

import re
import sys

COMMENT = re.compile(r"^(\s*)///(?!<)(?: (.*)|)$")
MEMBER = re.compile(r"^(.*?///<)(.*)$")
ITEM = re.compile(r"^( {2,5})(\S+(?: \S+){0,7}) {2,}(\S.*)$")
GUIDE = re.compile(
    r"^(?:template <[^;{}]*?>\s+)?[A-Z]\w*\([^;{}()]*\)\s*->\s*[^;{}]+;", re.MULTILINE
)
BULLET = re.compile(r"^ {2,5}\* (.*)$")
CODE = re.compile(r";\s*(//.*)?$|^\s*#include")
SECOND_KEY = re.compile(r"\s{3,}(?=(?:range|error|domain|cost|limits|result|phi|theta)\s{2,}\S)")


def escaped(text):
    parts = re.split(r"""(`[^`]*`|"[^"]*")""", text)  # neither in code nor between quotation marks
    parts[::2] = (re.sub(r"([\\@<>&#%*~])", r"\\\1", part) for part in parts[::2])
    return "".join(parts)


def indentation(line):
    return len(line) - len(line.lstrip(" "))


def items(line):
    """(key, value) pairs of a line in columns; none if it has no columns."""
    pairs = []
    for part in SECOND_KEY.split(line):
        match = ITEM.match(part if not pairs else "  " + part.lstrip())
        if match:
            pairs.append((match[2], re.sub(r"\s{2,}", "  ", match[3])))
        elif pairs:
            pairs[-1] = (pairs[-1][0], pairs[-1][1] + "  " + part.strip())
    return pairs


def rendered(lines):
    """The comment's lines, without slashes, as Doxygen reads them."""
    out, state = [], "text"

    def become(new):
        nonlocal state
        if state == "code":
            out.append(r"\endcode")
        if new != state and new in ("list", "code"):
            out.append("")
        if new == "code":
            out.append(r"\code{.cpp}" if CODE.search(line) else r"\code{.unparsed}")
        if new == "text" and state in ("list", "code"):
            out.append("")
        state = new

    for line in lines:
        columns, bullet = items(line), BULLET.match(line)
        if bullet and state != "code":
            if state != "list":
                become("list")
            out.append(f"- {escaped(bullet[1])}")
        elif not line.strip():
            if state != "code":
                become("text")
            out.append("")
        elif state == "list" and not columns and indentation(line) >= 2:
            out.append("    " + escaped(line.strip()))
        elif columns and state != "code":
            if state != "list":
                become("list")
            out.extend(f"- **{escaped(key)}**  {escaped(value)}" for key, value in columns)
        elif indentation(line) >= 2:
            if state != "code":
                become("code")
            out.append(line[2:])
        else:
            if state != "text":
                become("text")
            out.append(escaped(line))
    become("text")
    return out


def without_deduction_guides(source):
    """Doxygen takes them for functions of the name of their class."""
    return GUIDE.sub(lambda match: "\n" * match[0].count("\n"), source)


def filtered(source):
    result, block, margin, head = [], [], "", True

    def flush():
        nonlocal head
        if block:
            lines = ([r"\file"] if head else []) + rendered(block)
            result.extend(f"{margin}/// {line}".rstrip() for line in lines)
            block.clear()
        head = False

    for line in source.split("\n"):
        comment = COMMENT.match(line)
        if comment:
            margin = comment[1]
            block.append(comment[2] or "")
            continue
        flush()
        member = MEMBER.match(line)
        result.append(member[1] + escaped(member[2]) if member else line)
    flush()
    return "\n".join(result)


if __name__ == "__main__":
    sys.stdout.write(filtered(without_deduction_guides(open(sys.argv[1], encoding="utf-8").read())))
