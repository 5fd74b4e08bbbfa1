"""The notebooks of python/notebooks as pages docs/notebooks/NAME.md, with the output that they were saved with."""

import pathlib

from nbconvert import MarkdownExporter
from traitlets.config import Config


def write_pages(app):
    folder = pathlib.Path(app.srcdir) / "notebooks"
    folder.mkdir(exist_ok=True)
    for notebook in sorted((pathlib.Path(app.srcdir).parent / "python/notebooks").glob("*.ipynb")):
        names = Config({"ExtractOutputPreprocessor": {"output_filename_template": notebook.stem + "-{cell_index}{extension}"}})
        page, resources = MarkdownExporter(config=names).from_filename(str(notebook))
        (folder / f"{notebook.stem}.md").write_text(page)
        for name, picture in resources["outputs"].items():
            (folder / name).write_bytes(picture)


def setup(app):
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True}
