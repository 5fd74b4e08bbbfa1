"""Sphinx configuration of the site. `./run docs` builds it; the parts of our own are in docs/site/."""

import os
import pathlib
import re
import sys

import furo

docs = pathlib.Path(__file__).resolve().parent
checkout = docs.parent
sys.path.insert(0, str(docs / "site"))

project = "hts"
author = "the hts contributors"
copyright = "2026 the hts contributors"
version = re.search(r"project\(hts VERSION (\S+)", (checkout / "CMakeLists.txt").read_text())[1]
release = version

extensions = ["myst_parser", "breathe", "katex", "command_reference", "live", "notebooks", "rooms"]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "colon_fence"]
myst_heading_anchors = 3
exclude_patterns = ["site", "tests", "examples", "pictures", "**/README.md"]
primary_domain = "cpp"
highlight_language = "text"
nitpicky = False

# Given by ./run docs: the command, the installed headers and what Doxygen read in them.
hts_command = os.environ.get("HTS_COMMAND", str(checkout / "build/release/bin/hts"))
hts_headers = os.environ.get("HTS_HEADERS", str(checkout / "build/docs/headers"))
breathe_projects = {"hts": os.environ.get("HTS_DOXYGEN_XML", str(checkout / "build/docs/doxygen/xml"))}
breathe_default_project = "hts"
breathe_domain_by_extension = {"hpp": "cpp"}
breathe_show_include = False

html_theme = "furo"
html_title = f"hts {version}"
html_static_path = ["site/static"]
html_css_files = ["hts.css"]
html_copy_source = False
html_show_sphinx = False
# Debian's furo has its dark colours for readers who chose dark on the page, but not for those whose system is
# dark: its style sheet lost that rule in compilation. Given as options, the same colours serve both.
furo_style = pathlib.Path(furo.__file__).parent / "theme/furo/static/styles/furo.css"
dark_rule = re.search(r'body\[data-theme="dark"\] \{(.*?)\}', furo_style.read_text(), re.DOTALL)[1]
html_theme_options = {
    "navigation_with_keys": True,
    "dark_css_variables": dict(re.findall(r"--([\w-]+): ([^;]+);", dark_rule)),
}
pygments_style = "friendly"
pygments_dark_style = "monokai"
