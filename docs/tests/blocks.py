"""The fenced blocks of a Markdown page, and the comparison of what they print with what the page shows."""

import dataclasses
import re
import typing

FENCE = re.compile(
    r"^(?P<margin> *)```(?P<info>[^`\n]*)\n(?P<text>.*?)^(?P=margin)```$", re.MULTILINE | re.DOTALL
)
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")


class Difference(Exception):
    pass


@dataclasses.dataclass
class Block:
    language: str
    text: str
    line: int  # of its opening fence
    nightly: bool = False
    name: str = ""  # of the file that a block of JSON is
    program: str = ""  # of the file that a block of C++ is compiled to
    output: typing.Optional[str] = None  # what the page says it prints


def of_page(path, checkout):
    """The blocks of a page that can be run or checked; a block of text just behind one is its output."""
    page = path.read_text()
    stem = re.sub(r"\W+", "_", str(path.relative_to(checkout).with_suffix("")))
    found, end = [], 0
    for match in FENCE.finditer(page):
        words = match["info"].split()
        language = words[0] if words else ""
        text = re.sub(rf"^{match['margin']}", "", match["text"], flags=re.MULTILINE)
        follows = found and not page[end : match.start()].strip()
        end = match.end()
        if language == "text" and follows and found[-1].language in ("sh", "cpp"):
            found[-1].output = None if "varies" in words else text
        block = Block(language, text, page.count("\n", 0, match.start()) + 1, "nightly" in words)
        if language == "cpp":
            block.program = f"{stem}_{sum(other.language == 'cpp' for other in found) + 1}"
        if language == "json" and len(words) > 1:
            block.name = words[1]
        found.append(block)
    return [block for block in found if block.language in ("sh", "cpp", "json", "bash")]


def alike(shown, printed):
    """Two lines that differ by no more than one unit in the last digit of each number."""
    if NUMBER.sub("#", shown).split() != NUMBER.sub("#", printed).split():
        return False
    return all(
        abs(float(a) - float(b)) <= 1.01 * last_digit(a) + 1e-9 * abs(float(a))
        for a, b in zip(NUMBER.findall(shown), NUMBER.findall(printed))
    )


def last_digit(number):
    """One unit of the last digit of a number as written: 0.01 of 3.14."""
    mantissa, _, exponent = number.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def compare(shown, printed):
    """Raises Difference unless the output is as shown; a line … stands for any lines, also none."""
    expected = [line.rstrip() for line in shown.strip("\n").splitlines()]
    actual = [line.rstrip() for line in printed.strip("\n").splitlines()]
    if not matches(expected, actual):
        lines = ["the page shows", *expected, "but it prints", *actual[:60]]
        raise Difference("\n".join(lines))


def matches(expected, actual):
    if not expected:
        return not actual
    if expected[0].strip() == "…":
        return any(matches(expected[1:], actual[skipped:]) for skipped in range(len(actual) + 1))
    return bool(actual) and alike(expected[0], actual[0]) and matches(expected[1:], actual[1:])
