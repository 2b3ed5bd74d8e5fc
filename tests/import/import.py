#!/usr/bin/env python3
"""import.py MORTISE [NAME...]: imports the decks of decks.py, runs their scenes, and holds what comes out beside the checks of each deck, and what is told
to be left out beside what has to be. One line for each deck; exit code 1 if one fails."""
import json
import os
import re
import subprocess
import sys
import tempfile

from decks import DECKS


def write(deck, name, folder):
    path = os.path.join(folder, name + ".inp")
    for file, text in [(name + ".inp", deck.text)] + list(deck.files.items()):
        with open(os.path.join(folder, file), "w", encoding="utf-8") as f:
            f.write(text)
    return path


def mortise(program, deck, name, folder):
    """What is told by --import, and the quantities of the run in its last step."""
    def call(*arguments):
        result = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=300, check=False)
        if result.returncode:
            raise RuntimeError("mortise %s: exit code %d\n%s" % (" ".join(arguments), result.returncode, (result.stdout + result.stderr)[-2000:]))
        return result.stdout

    told = call("--import", write(deck, name, folder))
    call("--output", "results", "--set", "Output/Fields=", name + ".prm")
    with open(os.path.join(folder, "results/summary.json"), encoding="utf-8") as f:
        return told, json.load(f)["steps"][deck.step]["quantities"]


def failures(deck, told, quantities):
    for quantity, component, value, tolerance, *_ in deck.checks:
        got = quantities.get(quantity, [float("nan")] * 3)[component]
        if not abs(got - value) <= tolerance * abs(value):
            yield "%s, component %d: %.9g in place of %.9g" % (quantity, component, got, value)
    remarks = [line.strip() for line in told.splitlines() if line.startswith("  ")]
    for what in deck.told:
        if not any(re.match(r"line \d+", remark) and what in remark for remark in remarks):
            yield "%s is not told with its line: %s" % (what, remarks)
    for remark in remarks:
        if not any(what in remark for what in deck.told):
            yield "told without need: " + remark


def main():
    program, names, wrong = os.path.abspath(sys.argv[1]), sys.argv[2:] or list(DECKS), 0
    for name in names:
        deck = DECKS[name]()
        with tempfile.TemporaryDirectory() as folder:
            try:
                told, quantities = mortise(program, deck, name, folder)
                problems = list(failures(deck, told, quantities))
            except (RuntimeError, OSError, KeyError, subprocess.TimeoutExpired) as error:
                problems = [repr(error) if not isinstance(error, RuntimeError) else str(error)]
        wrong += bool(problems)
        print(("FAILED  " if problems else "OK  ") + name + "".join("\n        " + p for p in problems), flush=True)
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
