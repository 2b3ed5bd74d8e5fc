"""The report of a run: one HTML page, and its tables as CSV files.

python3 -m mortise.report DIRECTORY    writes DIRECTORY/report.html and DIRECTORY/report_*.csv"""

from __future__ import annotations

import base64
import datetime
import importlib.util
import os
import subprocess
import sys
import tempfile
from html import escape
from pathlib import Path
from typing import List, Tuple, Union

from . import report_sections as sections
from .page import page, paragraph, section
from .results import Results


def _pictures(results: Results) -> str:
    """Figures of the fields, or why there are none."""
    if not results.field_names:
        return paragraph("The run wrote no fields; Output/Fields asks for them.", "note")
    if importlib.util.find_spec("pyvista") is None:
        return paragraph("Pictures are drawn where PyVista is installed for the python3 on PATH: pip install pyvista.", "note")
    figures: List[Tuple[str, bytes]] = []
    problem = ""
    with tempfile.TemporaryDirectory() as directory:
        environment = dict(os.environ, PYTHONPATH=str(Path(__file__).parents[1]) + ":" + os.environ.get("PYTHONPATH", ""))
        command = [sys.executable, "-B", "-m", "mortise.pictures", str(results.directory), directory]
        try:
            done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600)
            output, problem = done.stdout, done.returncode and (done.stderr.strip().splitlines() or [f"code {done.returncode}"])[-1]
        except subprocess.TimeoutExpired as late:
            output, problem = (late.stdout or b"").decode(), "it took more than ten minutes"
        for line in output.splitlines():
            name, _, caption = line.partition("\t")
            if caption and (Path(directory) / name).exists():
                figures.append((caption, (Path(directory) / name).read_bytes()))
    text = "".join(f'<figure><img alt="{escape(caption)}" src="data:image/png;base64,{base64.b64encode(data).decode()}">'
                   f"<figcaption>{escape(caption)}</figcaption></figure>" for caption, data in figures)
    note = paragraph(f"Not all pictures could be drawn: {problem}", "note") if problem else ""
    return (f'<div class="row">{text}</div>' if text else "") + note


def _write_whole(file: Path, text: str) -> None:
    unfinished = file.with_name(f"{file.name}.unfinished.{os.getpid()}")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(file)


def write_report(directory: Union[str, "os.PathLike[str]"]) -> Path:
    """Write report.html and report_*.csv into a directory of results. Raises OSError or ValueError where there is
    no summary.json, or a damaged one."""
    results = Results(directory)
    tables = {name: table for name, table in results.tables.items() if len(table)}
    for name, table in tables.items():
        table.write_csv(results.directory / f"report_{name}.csv")
    links = ", ".join(f'<a href="report_{name}.csv">{name}</a>' for name in tables)
    written = datetime.datetime.fromtimestamp((results.directory / "summary.json").stat().st_mtime)
    summary = results.summary
    title = summary["title"] or results.directory.resolve().name
    header = (f"<h1>{escape(title)}</h1><p>{sections.status_badge(results)} {escape(results.directory.resolve().name)} · "
              f"{written:%d %B %Y, %H:%M} · {escape(summary['program']['name'])} {escape(summary['program']['version'])}</p>")
    body = "".join([
        sections.facts(results),
        section("Warnings", sections.warnings(results)),
        section("Pictures", _pictures(results) if results.steps else ""),
        section("Largest values", sections.peaks(results)),
        section("Quantities", sections.quantities(results)),
        section("Quality of the coupling", sections.coupling(results)),
        section("Equilibrium", sections.equilibrium(results)),
        section("History", sections.history(results)),
        section("Convergence", sections.convergence(results)),
        section("Meshes", sections.meshes(results)),
        section("Scene", sections.scene(results)),
        section("Times", sections.times(results)),
        section("Log", sections.log(results)),
        f"<footer>Tables of all steps with all digits: {links}. Units are those of the scene. Written by mortise --report.</footer>",
    ])
    file = results.directory / "report.html"
    _write_whole(file, page(title, header, body))
    return file


def main(arguments: List[str]) -> int:
    """The program; returns its exit code."""
    names = [argument for argument in arguments if argument != "--"]
    if len(names) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    directory = Path(names[0])
    try:
        print(write_report(directory))
        return 0
    except FileNotFoundError as error:
        there = "there is no such directory" if not directory.is_dir() else (
            "it has no summary.json, which a run writes at its end and with each checkpoint (Output/Checkpoint every)")
        problem = there if str(error.filename).endswith("summary.json") or not directory.is_dir() else str(error)
    except (OSError, ValueError, KeyError, TypeError) as error:
        problem = f"the results cannot be read or the page not be written: {type(error).__name__}: {error}"
    print(f'error: --report "{directory}": {problem}', file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
