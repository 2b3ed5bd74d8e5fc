"""Proves that the report of a run has its numbers, warnings and tables, of whatever end the run came to:
report.py MORTISE SOURCE_DIRECTORY"""

import csv
import html.parser
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

from verdict import end, verdict

program, source = sys.argv[1], pathlib.Path(sys.argv[2])


class Page(html.parser.HTMLParser):
    """Tables by name as rows of texts, sections by id, all text, and what is loaded from elsewhere."""

    def __init__(self, file):
        super().__init__()
        self.tables, self.sections, self.text, self.outside, self.open, self.images = {}, {}, "", [], [], []
        self.section, self.rows, self.cell = "", None, None
        self.feed(file.read_text(encoding="utf-8"))
        self.whole = not self.open

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag not in ("meta", "link", "img", "path", "rect", "circle", "polyline"):
            self.open.append(tag)
        if tag == "img":
            self.images.append(given)
        elif tag == "section":
            self.section = given["id"]
            self.sections[self.section] = ""
        elif tag == "table":
            self.rows = self.tables.setdefault(given["data-name"], [])
        elif tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
            self.cell = True
        for name in ("src", "href"):
            value = given.get(name) or ""
            if tag != "a" and value and not value.startswith("data:"):
                self.outside.append(value)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag in ("td", "th"):
            self.cell = None
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_data(self, data):
        self.text += data
        if self.section:
            self.sections[self.section] += data
        if self.cell:
            self.rows[-1][-1] += data


def mortise(*arguments, **options):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, **options)


def report(directory):
    done = mortise("--report", directory)
    file = pathlib.Path(directory) / "report.html"
    verdict(done.returncode == 0 and done.stdout.strip() == str(file) and file.exists(), f"report of {directory}", done.stderr)
    page = Page(file)
    verdict(page.whole and not page.outside, "a whole page that loads nothing", page.open + page.outside)
    return page


def of_run():
    mortise("--output", "sphere", source / "prm/thick_sphere.prm", "--set", "Output/Fields=", check=True)
    page = report("sphere")
    summary = json.loads(pathlib.Path("sphere/summary.json").read_text())
    step = summary["steps"][-1]
    verdict(list(page.sections)[0] == "warnings" and "None." in page.sections["warnings"], "warnings come first", list(page.sections))
    names = ("largest-values", "quantities", "quality-of-the-coupling", "equilibrium", "convergence", "meshes", "scene", "times", "pictures")
    verdict(all(name in page.sections for name in names), "its sections", list(page.sections))
    verdict(page.tables["quantities"][1][:2] == ["at r 1", f"{step['quantities']['at r 1'][0]:.4g}"], "quantities",
            page.tables["quantities"])
    verdict([row[0] for row in page.tables["meshes"]] == ["body", "inner", "outer"] and page.tables["meshes"][1][3] == "96", "bodies",
            page.tables["meshes"])
    coverage = page.tables["coupling"][0].index("coverage")
    verdict(page.tables["coupling"][1][coverage] == "1", "coverage", page.tables["coupling"])
    verdict(["Young modulus", "10", "force per area"] in page.tables["scene Body inner/Material"], "parameters with their units",
            page.tables.get("scene Body inner/Material"))
    with open("sphere/report_bodies.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    verdict([row["name"] for row in rows] == ["inner", "outer"]
            and float(rows[0]["displacement_max"]) == step["bodies"][0]["displacement_max"]["value"]
            and float(rows[1]["von_mises_max_at_z"]) == step["bodies"][1]["von_mises_max"]["at"][2],
            "the table of bodies as a file, with all digits", rows)
    files = sorted(file.name for file in pathlib.Path("sphere").glob("*.csv"))
    verdict(files == [f"report_{name}.csv" for name in ("bodies", "interfaces", "quantities", "steps", "timings")], "all tables", files)


def of_steps():
    mortise("--output", "steps", source / "prm/shrink_fit_torque.prm", "--set", "Output/Fields=", "--set", "Title=<b>fit & \"torque\"</b>",
            check=True)
    page = report("steps")
    n = len(json.loads(pathlib.Path("steps/summary.json").read_text())["steps"])
    verdict(len(page.tables["history"]) == n + 1 > 2 and len(page.tables["convergence"]) == n + 1, "a row for each step",
            len(page.tables["history"]))
    text = pathlib.Path("steps/report.html").read_text(encoding="utf-8")
    verdict('<b>fit & "torque"</b>' in page.text and "<b>fit" not in text, "a title with marks of HTML is a text")
    with open("steps/report_steps.csv", newline="") as stream:
        verdict(len(list(csv.DictReader(stream))) == n, "and in the file")


def pictures():
    mortise("--output", "drawn", source / "prm/patch.prm", check=True)
    page = report("drawn")
    if subprocess.run(["python3", "-c", "import pyvista"], capture_output=True).returncode:
        verdict("pip install pyvista" in page.sections["pictures"], "without PyVista a note in place of pictures", page.sections["pictures"])
        return
    captions = [image["alt"].split(" (")[0] for image in page.images]
    verdict(captions == ["Displacement", "Von Mises stress", "Traction of glue"], "pictures", captions)
    verdict(all(len(image["src"]) > 10000 and image["src"].startswith("data:image/png;base64,iVBOR") for image in page.images), "drawn")


def of_other_ends():
    done = mortise("--output", "failed", source / "prm/thick_sphere.prm", "--set", "Solver/Max iterations=2")
    page = report("failed")
    verdict(done.returncode == 3 and "not converged" in page.text and "did not converge" in page.sections["warnings"],
            "a run that did not converge says so first", page.sections["warnings"])
    mortise("--output", "idle", source / "tests/field/nothing_acts.prm")
    page = report("idle")
    verdict("nothing acts" in page.sections["warnings"], "warnings of the program", page.sections["warnings"])
    # with its first step done, killed while it does the others
    run = subprocess.Popen([program, "--output", "killed", str(source / "prm/shrink_fit_torque.prm"), "--set", "Steps/Step=0.005",
                            "--set", "Output/Fields="], stdout=subprocess.DEVNULL)
    while run.poll() is None and not os.path.exists("killed/summary.json"):
        time.sleep(0.02)
    run.kill()
    verdict(run.wait() != 0, "a run of many steps is killed")
    page = report("killed")
    verdict("not finished" in page.sections["warnings"] and "inner" in page.text, "what is left of it has a report",
            page.sections["warnings"])


def errors():
    os.makedirs("nothing", exist_ok=True)
    os.makedirs("damaged", exist_ok=True)
    pathlib.Path("damaged/summary.json").write_text('{"title": ')
    for directory, words in (("nothing", "no summary.json"), ("damaged", "cannot be read"), ("absent", "no such directory")):
        done = mortise("--report", directory)
        verdict(done.returncode == 2 and words in done.stderr and done.stderr.count("\n") == 1 and not done.stdout
                and not pathlib.Path(directory, "report.html").exists(), f"{directory}: {words}", done)
    done = mortise("--report", "sphere", env={**os.environ, "PATH": "/nonexistent"})
    verdict(done.returncode == 2 and "python3" in done.stderr, "no Python", done)
    # as an installation has it
    os.makedirs("install/bin")
    shutil.copy(program, "install/bin/mortise")
    shutil.copytree(source / "source/python/mortise", "install/share/mortise/python/mortise")
    beside = pathlib.Path("install/share/mortise/python/mortise/report.py")
    beside.write_text("print('that of the installation')\n")
    done = subprocess.run(["install/bin/mortise", "--report", "sphere"], capture_output=True, text=True)
    verdict(done.stdout == "that of the installation\n", "an installed program takes the package beside it", done)


of_run()
of_steps()
pictures()
of_other_ends()
errors()
end()
