"""{live}`text <address>` links to the live page with a state, where ./run page has built it; elsewhere the text stands alone.

The address is what stands behind # in the page's own: "sigma=0.1&index=Au", or nothing for what the page begins with.
"""

import pathlib
import re
import shutil

from docutils import nodes

PAGE = pathlib.Path(__file__).resolve().parents[2] / "build/page/hts.html"


def live(name, rawtext, text, lineno, inliner, options=None, content=None):
    match = re.fullmatch(r"(.*?)\s*<(.*)>", text, re.DOTALL)
    words, address = match.groups() if match else (text, "")
    if not PAGE.exists():
        return [nodes.Text(words)], []
    source = pathlib.Path(inliner.document["source"]).resolve()
    depth = len(source.relative_to(pathlib.Path(__file__).resolve().parents[1]).parts) - 1
    target = "../" * depth + "hts.html" + (f"#{address}" if address else "")
    return [nodes.reference(rawtext, words, refuri=target)], []


def copy_page(app, exception):
    if exception is None and app.builder.format == "html" and PAGE.exists():
        shutil.copy(PAGE, app.outdir)


def setup(app):
    app.add_role("live", live)
    app.connect("build-finished", copy_page)
    return {"parallel_read_safe": True}
