"""The examples at the end of each help text."""

import re
import subprocess

# Those that take longer than some five seconds.
SLOW = re.compile(
    r"hts (chart|compare|figures|fit|furnace|render fig|stability|table chart|truth|validate)"
    r"|hts table export .* --format (rgl|pbsdf)"
)


def help_text(hts, verbs):
    return subprocess.run([hts, *verbs, "--help"], check=True, capture_output=True, text=True).stdout


def verbs_of(text):
    found = re.search(r"^Subcommands:\n((?:  .*\n|\n)*)", text, re.MULTILINE)
    return re.findall(r"^  (\w\S*)", found[1], re.MULTILINE) if found else []


def examples_of(text):
    """The commands under "Examples:", a line that ends with a backslash joined with the next."""
    found = re.search(r"^Examples?:\n((?:  .*\n?)+)", text, re.MULTILINE)
    joined = re.sub(r"\\\n\s*", "", found[1]) if found else ""
    return [line.strip() for line in joined.splitlines() if line.strip()]


def of(hts, verbs=()):
    """(verb, example) of every verb that does something itself, in the order of the help text."""
    text = help_text(hts, verbs)
    below = verbs_of(text)
    if not below:
        yield from ((" ".join(verbs), example) for example in examples_of(text))
    for verb in below:
        yield from of(hts, (*verbs, verb))


def takes_minutes(example):
    return SLOW.match(example) is not None
