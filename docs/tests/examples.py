#!/usr/bin/env python3
"""Runs what README.md and the pages of docs/ show, as printed. docs/for-developers.md says how to write it.

    examples.py programs OUTPUT PAGE …   writes the C++ programs of the pages to OUTPUT, prints their paths
    examples.py run PAGE …               runs the fenced blocks of each page in a copy of the checkout
    examples.py help                     runs the examples in the help text of every verb
        --hts FILE        the command under test
        --programs FOLDER what `programs` wrote was built into this folder
        --nightly         also what takes minutes
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import blocks
import help_examples

checkout = pathlib.Path(__file__).resolve().parents[2]


VERDICT = re.compile(r"^hts: .* does not meet the criteria$", re.MULTILINE)


class Failure(Exception):
    pass


class Copy:
    """A copy of what the checkout has under version control, without its sources, and `hts` in PATH."""

    folders = ("cli", "docs", "validation", "bench", "spectral", "tables")
    kinds = {".json", ".csv", ".yml", ".gsf", ".svg", ".png", ".md", ".txt", ".sh"}

    def __init__(self, hts):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hts-examples-"))
        self.root = self.folder / "hts"
        for folder in self.folders:
            for path in (checkout / folder).rglob("*"):
                if path.is_file() and path.suffix in self.kinds:
                    target = self.root / path.relative_to(checkout)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, target)
        (self.root / "out").mkdir()  # as ./run makes it
        (self.folder / "bin").mkdir()
        (self.folder / "bin/hts").symlink_to(pathlib.Path(hts).resolve())
        path = f"{self.folder}/bin:{os.environ['PATH']}"
        self.environment = {**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "HTS_CACHE": "off"}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def run(self, command):
        """Standard output of a command, a list or a script for bash; Failure unless it ends with 0, or with 1
        because a model does not meet the criteria of `hts compare`, which is an answer too."""
        words = ["bash", "-euo", "pipefail", "-c", command] if isinstance(command, str) else command
        done = subprocess.run(words, cwd=self.root, env=self.environment, capture_output=True, text=True)
        if done.returncode != 0 and not (done.returncode == 1 and VERDICT.search(done.stderr)):
            raise Failure(f"exit code {done.returncode}\n{done.stderr.strip()}")
        return done.stdout


def check_json(block, copy):
    """A material file is read and evaluated; a scene is that of a file of the checkout."""
    value = json.loads(block.text)
    if block.name:
        (copy.root / block.name).parent.mkdir(parents=True, exist_ok=True)
        (copy.root / block.name).write_text(block.text)
    if "model" in value:
        name = block.name or "shown.json"
        (copy.root / name).write_text(block.text)
        copy.run(f"hts eval --material {name} --clamp --wavelength 0.55 --theta-i 30 --theta-r 30 --phi 180")
    elif "materials" in value:
        shipped = [path for path in copy.root.rglob("*.json") if path.name != block.name]
        if not block.name and not any(json.loads(path.read_text()) == value for path in shipped):
            raise Failure("a scene that is no file of the checkout")


def check_bash(block):
    """What is not run must not be a command that could be."""
    for line in block.text.splitlines():
        if re.match(r"\$?\s*hts ", line):
            raise Failure(f"belongs into a block of sh, where it is run: {line}")


def run_block(block, copy, programs):
    """Standard output of the block, None for what has none."""
    if block.language == "sh":
        return copy.run(block.text)
    if block.language == "cpp":
        return copy.run([str(pathlib.Path(programs).resolve() / block.program)])
    if block.language == "json":
        check_json(block, copy)
    if block.language == "bash":
        check_bash(block)
    return None


def missing_files(page):
    """The files that a page links to or names by their path in the source, and that are not there."""
    text = (checkout / page).read_text()
    links = re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", text)
    rooms = "bench|cli|docs|hts|spectral|tables|validation"
    names = re.findall(rf"`((?:{rooms})/[\w./-]+\.(?:cpp|csv|hpp|json|md|sh|yml))`", text)
    names = [] if page.endswith("from-older-api.md") else names
    folder = (checkout / page).parent
    return [link for link in links if not (folder / link).exists()] + [
        name for name in names if not (checkout / name).exists()
    ]


def missing_programs(page, hts):
    """What a page names in the build folder and is not there; the benchmarks are not built unless they are asked for."""
    named = set(re.findall(r"build/release/([\w/]+)", (checkout / page).read_text()))
    return sorted(each for each in named - {"bin/hts_bench"} if not (pathlib.Path(hts).resolve().parents[1] / each).exists())


def run_page(page, options):
    """How many blocks and links of a page failed, each reported."""
    failures = ran = 0
    for name in missing_files(page):
        failures += 1
        print(f"{page}: {name} is not there", file=sys.stderr)
    for name in missing_programs(page, options.hts):
        failures += 1
        print(f"{page}: build/release/{name} is not there", file=sys.stderr)
    with Copy(options.hts) as copy:
        for block in blocks.of_page(checkout / page, checkout):
            if block.nightly and not options.nightly:
                continue
            start = time.monotonic()
            try:
                output = run_block(block, copy, options.programs)
                if block.output is not None:
                    blocks.compare(block.output, output)
            except (Failure, blocks.Difference, json.JSONDecodeError, FileNotFoundError) as error:
                failures += 1
                print(f"{page}:{block.line}: {error}\n---\n{block.text}---", file=sys.stderr)
            ran += 1
            print(f"{page}:{block.line}: {block.language}, {time.monotonic() - start:.1f} s")
    print(f"{page}: {ran} blocks, {failures} failed")
    return failures


def run_help(options):
    """How many examples of the help texts failed, each reported; each may use what those before it wrote."""
    failures = 0
    with Copy(options.hts) as copy:
        for verb, example in help_examples.of(options.hts):
            if help_examples.takes_minutes(example) and not options.nightly:
                continue
            start = time.monotonic()
            try:
                copy.run(example)
            except Failure as error:
                failures += 1
                print(f"hts {verb} --help: {example}\n{error}", file=sys.stderr)
            print(f"{time.monotonic() - start:5.1f} s  {example}")
    return failures


def write_programs(options):
    for page in options.pages:
        for block in blocks.of_page(checkout / page, checkout):
            if block.language == "cpp":
                path = pathlib.Path(options.output) / f"{block.program}.cpp"
                path.parent.mkdir(parents=True, exist_ok=True)
                if not path.exists() or path.read_text() != block.text:
                    path.write_text(block.text)
                print(path)


def main():
    layout = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=layout)
    verbs = parser.add_subparsers(dest="verb", required=True)
    programs = verbs.add_parser("programs")
    programs.add_argument("output")
    programs.add_argument("pages", nargs="*")
    run = verbs.add_parser("run")
    run.add_argument("pages", nargs="+")
    run.add_argument("--programs", default=".")
    for verb in (run, verbs.add_parser("help")):
        verb.add_argument("--hts", required=True)
        verb.add_argument("--nightly", action="store_true")
    options = parser.parse_args()
    if options.verb == "programs":
        write_programs(options)
    elif options.verb == "run":
        sys.exit(sum(run_page(page, options) for page in options.pages) > 0)
    else:
        sys.exit(run_help(options) > 0)


if __name__ == "__main__":
    main()
