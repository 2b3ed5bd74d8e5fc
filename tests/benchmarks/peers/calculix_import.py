#!/usr/bin/env python3
"""The decks of tests/import in CalculiX and, imported, in Mortise, side by side: doc/measurements/import.md.

    apt-get install calculix-ccx
    calculix_import.py MORTISE [--page] [NAME...]
    calculix_import.py MORTISE [--page] --suite FOLDER [NAME...]

Each row is a displacement of a node or a force on a support, as tests/import/decks.py chooses them. --suite: the
static decks of CalculiX's own tests in a folder (*.inp of Debian's calculix-ccx-test, unpacked) instead, with the largest
difference at eight nodes beside the largest displacement of the deck."""
import argparse
import glob
import importlib
import json
import os
import random
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "../../import"), os.path.dirname(HERE)]
from decks import DECKS  # noqa: E402
from page import write_part  # noqa: E402

runner = importlib.import_module("import")  # a keyword of Python


def calculix(deck, name, folder):
    """Displacements by node, and totals of forces by set, of the last increment."""
    runner.write(deck, name, folder)
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    process = subprocess.run(["ccx", "-i", name], cwd=folder, capture_output=True, text=True, timeout=600, env=environment, check=False)
    if "*ERROR" in process.stdout or "Job finished" not in process.stdout:
        raise RuntimeError("ccx: " + process.stdout[-1500:])
    values, kind = {}, ""
    with open(os.path.join(folder, name + ".dat"), encoding="utf-8") as f:
        for line in f:
            words = line.split()
            if words[:1] == ["displacements"]:
                kind = "node_"
            elif words[:2] == ["total", "force"]:
                kind = words[words.index("set") + 1]
            elif kind == "node_" and len(words) == 4:
                values[kind + words[0]] = [float(w) for w in words[1:]]
            elif kind and len(words) == 3:
                values[kind] = [float(w) for w in words]
    return values


def difference(a, b):
    return "%.1e" % abs(a / b - 1)


def row(check, ours, theirs):
    quantity, component, value = check[:3]
    # in a scene of several bodies the force of a set is that of BODY-SET
    name = quantity if quantity in theirs else next((n for n in theirs if quantity.endswith("-" + n)), None)
    got, exact = ours.get(quantity, [float("nan")] * 3)[component], len(check) == 4
    words = [quantity + ", " + "xyz"[component], "%.7g" % got]
    words += ["%.7g" % theirs[name][component], difference(got, theirs[name][component])] if name else ["", ""]
    words += ["%.7g" % value, difference(got, value)] if exact else ["", ""]
    return " | ".join(words) + " |"


def places(text):
    """Nodes of a deck without parts: {number: place}."""
    nodes, inside = {}, False
    for line in text.splitlines():
        words = [w.strip() for w in line.split(",")]
        if line.startswith("*"):
            inside = inside if line.startswith("**") else words[0].upper() == "*NODE"
        elif inside and words[0].isdigit():
            nodes[int(words[0])] = tuple(float((w or "0").upper().replace("D", "E")) for w in (words[1:4] + ["0"] * 3)[:3])
    return nodes


def bodies_at(folder):
    """The body of each place in the meshes that --import has written, of those that only one body has."""
    found, several = {}, set()
    for file in glob.glob(folder + "/*_*.inp"):
        with open(file, encoding="utf-8") as f:
            text = f.read()
        body = text.split(maxsplit=3)[2]  # ** body NAME
        for x in places(text).values():
            if found.setdefault(x, body) != body:
                several.add(x)
    return {x: body for x, body in found.items() if x not in several}


def displacements(file):
    """Those of the last step that a .dat file prints."""
    values, inside = {}, False
    if os.path.exists(file):
        with open(file, encoding="utf-8") as f:
            for line in f:
                words = line.split()
                if words and not words[0].isdigit():
                    inside = words[0] == "displacements"
                elif inside and len(words) == 4:
                    values[int(words[0])] = [float(w) for w in words[1:]]
    return values


def suite_deck(program, path, folder):
    """What became of a deck, the difference, the largest displacement, and what is told."""
    def call(*command):
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60, check=False, env=dict(os.environ, OMP_NUM_THREADS="1"))

    with open(path, encoding="utf-8", errors="replace") as f:
        text = f.read()
    imported = call(program, "--import", path, "--output", "scene")
    if imported.returncode:
        return "refused by --import", None, None, [imported.stderr.strip()[:150]]
    told = [line.strip() for line in imported.stdout.split("Approximated:")[0].splitlines() if line.startswith("  ")]
    if told or "the step is static" in imported.stdout:
        return "left out in part" if told else "steps that are not static", None, None, told
    nodes = places(text)
    first, last = re.search(r"(?im)^\*STEP", text).start(), list(re.finditer(r"(?im)^\*END STEP", text))[-1].start()
    with open(folder + "/job.inp", "w", encoding="utf-8") as f:
        f.write(text[:first] + "*NSET, NSET=ZZALL, GENERATE\n1, %d\n" % max(nodes) + text[first:last] + "*NODE PRINT, NSET=ZZALL\nU\n" + text[last:])
    call("ccx", "-i", "job")
    theirs, at = displacements(folder + "/job.dat"), bodies_at(folder + "/scene")
    known = sorted((n for n in theirs if nodes.get(n) in at), key=lambda n: -max(map(abs, theirs[n])))
    if not known:
        return "taken over, without a result of CalculiX", None, None, []
    random.seed(1)
    chosen = known[:2] + random.sample(known[2:], min(6, len(known[2:])))
    points = "; ".join("p%d: %s: %.15g, %.15g, %.15g" % (n, at[nodes[n]], *nodes[n]) for n in chosen)
    run = call(program, "--output", "results", "--set", "Output/Fields=", "--set", "Output/Points=" + points, *glob.glob(folder + "/scene/*.prm"))
    if run.returncode:
        return "taken over, refused or not converged", None, None, [run.stderr.strip()[:150]]
    with open(folder + "/results/summary.json", encoding="utf-8") as f:
        ours = json.load(f)["steps"][-1]["quantities"]
    largest = max(map(abs, theirs[known[0]]))
    off = max(abs(a - b) for n in chosen for a, b in zip(ours["p%d" % n], theirs[n]))
    approximated = imported.stdout.split("Approximated:")[1].strip().splitlines() if "Approximated:" in imported.stdout else []
    return "taken over", off / largest, largest, [re.sub(r"^.*?: ", "", a.strip(), count=1) for a in approximated]


def suite(program, folder, names):
    """Tables of the outcomes, and of decks of which nothing is left out."""
    outcomes, rows = {}, []
    for path in sorted(glob.glob(folder + "/*.inp")):
        name = os.path.basename(path)[:-4]
        with open(path, encoding="utf-8", errors="replace") as f:
            text = f.read().upper().replace(" ", "")
        if (names and name not in names) or "\n*STATIC" not in text or "TYPE=C3D" not in text:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            try:
                outcome, off, largest, told = suite_deck(program, path, scratch)
            except (subprocess.TimeoutExpired, ZeroDivisionError) as error:
                outcome, off, largest, told = "taken over, longer than a minute", None, None, [repr(error)[:100]]
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        print(name, outcome, off, largest, told, flush=True)
        if off is not None:
            rows.append("| `%s` | %.1e | %.3g | %s |" % (name, off, largest, "; ".join(told)))
    return ("| outcome | decks |\n|---|---|\n" + "".join("| %s | %d |\n" % o for o in sorted(outcomes.items())) +
            "\n| deck | difference | largest displacement | approximated |\n|---|---|---|---|\n" + "\n".join(rows))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mortise")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--suite")
    o = parser.parse_intermixed_args()
    if o.suite:
        text = suite(os.path.abspath(o.mortise), os.path.abspath(o.suite), o.names)
        print(text)
        if o.page:
            write_part("import.md", "suite", text)
        return
    text = "| deck (seconds of Mortise, CalculiX) | quantity | Mortise | CalculiX | difference | exact | difference of Mortise |\n|---|---|---|---|---|---|---|\n"
    for name in o.names or DECKS:
        deck = DECKS[name]()
        with tempfile.TemporaryDirectory() as folder:
            try:
                start = os.times()
                _, ours = runner.mortise(os.path.abspath(o.mortise), deck, name, folder)
                middle = os.times()
                theirs = calculix(deck, name, folder) if deck.calculix else {}
                end = os.times()
            except (RuntimeError, OSError, KeyError, subprocess.TimeoutExpired) as error:
                print(name, error, file=sys.stderr)
                continue
        seconds = [b.children_user + b.children_system - a.children_user - a.children_system for a, b in ((start, middle), (middle, end))]
        for i, check in enumerate(deck.checks):
            line = "| %s " % (("`%s` (%.1f s, %.1f s)" if deck.calculix else "`%s` (%.1f s)") % (name, *seconds[:1 + deck.calculix]) if i == 0 else "") + "| " + row(check, ours, theirs)
            print(line, flush=True)
            text += line + "\n"
    if o.page:
        write_part("import.md", "decks", text)


if __name__ == "__main__":
    main()
