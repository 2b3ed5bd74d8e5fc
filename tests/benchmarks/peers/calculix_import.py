#!/usr/bin/env python3
"""The decks of tests/import in CalculiX and, imported, in Mortise, side by side: doc/measurements/import.md.

    apt-get install calculix-ccx
    calculix_import.py MORTISE [--page] [NAME...]

Each row is a displacement of a node or a force on a support, as tests/import/decks.py chooses them."""
import argparse
import importlib
import os
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


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mortise")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--page", action="store_true")
    o = parser.parse_args()
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
            line = "| %s " % ("`%s` (%.1f s, %.1f s)" % (name, *seconds) if i == 0 else "") + "| " + row(check, ours, theirs)
            print(line, flush=True)
            text += line + "\n"
    if o.page:
        write_part("import.md", "decks", text)


if __name__ == "__main__":
    main()
