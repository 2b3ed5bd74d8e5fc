"""Runs the tutorials of doc/guide/notebooks, whose cells assert what they show: notebooks.py MORTISE SOURCE_DIRECTORY [--write]

--write keeps what the cells print in the notebooks."""

import contextlib
import io
import json
import os
import pathlib
import sys

from verdict import end, need, verdict

need("numpy")
os.environ["MORTISE"] = sys.argv[1]
source = pathlib.Path(sys.argv[2]).resolve()
write = "--write" in sys.argv


def run(file):
    """The error of the first cell that fails, or nothing."""
    notebook = json.loads(file.read_text())
    names = {"__name__": "__main__"}
    for number, cell in enumerate((c for c in notebook["cells"] if c["cell_type"] == "code"), 1):
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile("".join(cell["source"]), f"{file.name}, cell {number}", "exec"), names)
        except Exception as error:
            return f"cell {number}: {error!r}"
        cell["execution_count"] = number
        cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": printed.getvalue().splitlines(True)}] if printed.getvalue() else []
    if write:
        file.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")
    return ""


files = sorted((source / "doc/guide/notebooks").glob("*.ipynb"))
verdict(len(files) == 3, "three tutorials", files)
here = pathlib.Path.cwd()
for file in files:
    # as a notebook is run: beside its file's tree, with results where they do no harm
    os.environ["MORTISE_SOURCE"] = str(source)
    os.chdir(here)
    problem = run(file)
    verdict(not problem, file.name, problem)
end()
