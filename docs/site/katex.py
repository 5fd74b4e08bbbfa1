"""Mathematics by KaTeX from Debian's libjs-katex, copied into the site, so that pages need no network."""

import pathlib
import shutil

from docutils import nodes

PACKAGE = pathlib.Path("/usr/share/javascript/katex")
FILES = ("katex.min.css", "katex.min.js", "contrib/auto-render.js")


def visit_inline(self, node):
    self.body.append(self.starttag(node, "span", "", CLASS="math notranslate nohighlight"))
    self.body.append(r"\(" + self.encode(node.astext()) + r"\)</span>")
    raise nodes.SkipNode


def visit_display(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math notranslate nohighlight"))
    self.body.append(r"\[" + self.encode(node.astext()) + r"\]</div>")
    raise nodes.SkipNode


def copy_package(app):
    if app.builder.format == "html":
        target = pathlib.Path(app.outdir) / "_static" / "katex"
        shutil.copytree(PACKAGE / "fonts", target / "fonts", dirs_exist_ok=True)
        for file in FILES:
            shutil.copy(PACKAGE / file, target)


def setup(app):
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_display, None))
    app.config.html_math_renderer = "katex"
    app.connect("builder-inited", copy_package)
    app.add_css_file("katex/katex.min.css")
    app.add_js_file("katex/katex.min.js", loading_method="defer")
    app.add_js_file("katex/auto-render.js", loading_method="defer")
    app.add_js_file(
        None,
        body="addEventListener('load', () => renderMathInElement(document.body, {throwOnError: false}));",
    )
    return {"parallel_read_safe": True, "parallel_write_safe": True}
