"""The directive {room}: what the installed headers of one folder say, a section per header.

    ```{room} hts/phi
    ```

The build warns of a folder of installed headers that no page names.
"""

import pathlib

from breathe.renderer.sphinxrenderer import SphinxRenderer, WithContext
from docutils import nodes
from docutils.statemachine import StringList
from sphinx import addnodes
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

SECTIONS = ("briefdescription detaileddescription innernamespace innerclass public-type public-static-func"
            " public-func public-attrib public-static-attrib concept enum typedef func var")
logger = logging.getLogger(__name__)


def headers_of(root, folder):
    """Names of the headers of a folder, but for hts/hts.hpp and its like, which only include others."""
    return sorted(path.name for path in (pathlib.Path(root) / folder).glob("*.hpp") if path.stem != folder)


class FlatRenderer:
    """Stands in for two methods of Breathe, which would declare the namespace anew for every header and warn
    of it: here what a namespace holds comes without it, by its full name."""

    def visit_namespace(self, node):
        file_data = self.compound_parser.parse(node.refid)
        context = self.context.create_child_context(file_data)
        with WithContext(self, context.create_child_context(file_data.compounddef)):
            return self.render(file_data, context)

    def get_qualification(self):
        stack = self.context.node_stack
        if self.nesting_level > 0 or stack[0].node_type != "memberdef":
            return []
        around = [node.compoundname for node in stack
                  if node.node_type == "compounddef" and node.kind == "namespace"]
        return around[0].split("::") if around else []


class Room(SphinxDirective):
    required_arguments = 1
    has_content = False

    def run(self):
        folder = self.arguments[0]
        headers = headers_of(self.config.hts_headers, folder)
        if not headers:
            raise self.error(f"no installed header in {folder}")
        self.env.rooms.setdefault(self.env.docname, []).append(folder)
        return [self.section(f"{folder}/{name}") for name in headers]

    def section(self, header):
        title = nodes.title("", "", nodes.literal(header, header))
        section = nodes.section("", title, ids=[nodes.make_id(header)], names=[header])
        self.state.document.note_explicit_target(section)
        lines = ["```{eval-rst}", f".. doxygenfile:: {header}", f"   :sections: {SECTIONS}", "```"]
        self.state.nested_parse(StringList(lines, source=self.env.doc2path(self.env.docname)), 0, section)
        file = next((node for node in section.findall(addnodes.desc) if node["objtype"] == "file"), None)
        if file is not None:  # else Breathe has complained
            file.parent.replace(file, file[-1].children)  # what it holds, without "file hts/phi.hpp" above
        return section


def start(app):
    app.env.rooms = getattr(app.env, "rooms", {})


def forget(app, env, docname):
    env.rooms.pop(docname, None)


def merge(app, env, docnames, other):
    env.rooms.update({name: other.rooms[name] for name in docnames if name in other.rooms})


def check(app, env):
    root = pathlib.Path(app.config.hts_headers)
    named = {folder for folders in env.rooms.values() for folder in folders}
    folders = {str(path.parent.relative_to(root)) for path in root.rglob("*.hpp")}
    for folder in sorted(folders - named):
        if headers_of(root, folder):
            logger.warning("no page of docs/reference/ has the headers of %s/", folder)


def setup(app):
    SphinxRenderer.visit_namespace = FlatRenderer.visit_namespace
    SphinxRenderer.get_qualification = FlatRenderer.get_qualification
    app.add_config_value("hts_headers", "", "env")
    app.add_directive("room", Room)
    app.connect("builder-inited", start)
    app.connect("env-purge-doc", forget)
    app.connect("env-merge-info", merge)
    app.connect("env-check-consistency", check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
