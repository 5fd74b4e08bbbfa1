"""The directive {command-reference}: the help text of hts and of each verb, asked of the command itself.

Every verb becomes a section, every verb of a verb (hts table build) one below it.
"""

import re
import subprocess

from docutils import nodes
from sphinx.util.docutils import SphinxDirective


def help_text(command, verbs=()):
    return subprocess.run([command, *verbs, "--help"], check=True, capture_output=True, text=True).stdout


def verbs_of(text):
    """The names under "Subcommands:" of a help text."""
    found = re.search(r"^Subcommands:\n((?:  .*\n|\n)*)", text, re.MULTILINE)
    return re.findall(r"^  (\w\S*)", found[1], re.MULTILINE) if found else []


class CommandReference(SphinxDirective):
    has_content = False

    def run(self):
        self.env.note_dependency(self.config.hts_command)
        whole = help_text(self.config.hts_command)
        return [self.block(whole), *(self.section((verb,)) for verb in verbs_of(whole))]

    def section(self, verbs):
        title = " ".join(("hts", *verbs))
        section = nodes.section("", nodes.title("", title), ids=[nodes.make_id(title)], names=[title])
        self.state.document.note_explicit_target(section)
        text = help_text(self.config.hts_command, verbs)
        section += self.block(text)
        section.extend(self.section((*verbs, verb)) for verb in verbs_of(text))
        return section

    @staticmethod
    def block(text):
        return nodes.literal_block(text.strip("\n"), text.strip("\n"), language="text", classes=["help"])


def setup(app):
    app.add_config_value("hts_command", "", "env")
    app.add_directive("command-reference", CommandReference)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
