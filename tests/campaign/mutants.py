#!/usr/bin/env python3
"""Changes of one sign, index or bound of the sources, and whether the tests see them.

    mutants.py run TREE BUILD [--room ROOM]... [--seed S] [--draws N] [--first N] [--record FILE]
    mutants.py page

TREE is a copy of the sources that nobody needs, BUILD where it is built (with -DMORTISE_UNITY=OFF only the changed
file is compiled again). A mutant is drawn among all places of a room where one operator or constant can be
exchanged, outside of comments, messages, assertions and includes, one a line. The tests of its room run, then some
quick scenes of tests/field; the first test that fails ends it. page writes doc/measurements/mutants.md from the record, where those that survive
have a "verdict" written by hand.
"""
import argparse
import json
import os
import random
import re
import resource
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.join(HERE, "..", "..")
PLACE = os.path.join(TOP, "doc", "measurements")
ROOMS = ["interface", "mortar", "contact", "solvers"]
# Patterns of tests in turn, and what they leave out: first what is quick; ROOM stands for the room, SCENES for a part of quick_scenes.txt
EVERY = 8
SLOW = "solvers/(contrast|hanging_nodes|inf_sup|iterations|multigrid|multipliers_by_parts)"
STAGES = [("^ROOM/.*=1$", SLOW), ("^ROOM/.*=3$", SLOW), ("^field/(SCENES)$", "-"), ("^ROOM/iterations.*=1$", "-")]
SECONDS = 40  # of the processor for one process of a test: more is a hang

# What stands in the source between what stands before and after, and what replaces it
EXCHANGES = [(r"(?<= )%s(?=\s)" % re.escape(a), b) for a, b in [
    ("-", "+"), ("*", "/"), ("/", "*"), ("+=", "-="), ("-=", "+="), ("<", "<="), ("<=", "<"), (">", ">="), (">=", ">"),
    ("==", "!="), ("!=", "=="), ("&&", "||"), ("||", "&&")]]
EXCHANGES += [(r"(?<=[^#] )\+(?=\s+[^#\s])", "-"), (r"\[0\]", "[1]"), (r"\[1\]", "[0]"), (r" \+ 1(?![\w.])", ""), (r" - 1(?![\w.])", ""), (r"(?<= = )0;", "1;"),
              (r"(?:(?<=[(,=?:] )|(?<=[(\[{])|(?<=return ))-(?=[\w(])", ""), (r"(?<=[(&| ])!(?=[\w(])", ""), (r"std::min(?=\()", "std::max"),
              (r"std::max(?=\()", "std::min"), (r"(?<![\w.])0\.5(?!\w)", "1."), (r"(?<![\w.])2\.(?![\w])", "1.")]
# What is no code of the method: comments, includes, words, assertions with their messages
IGNORED = re.compile(r'//[^\n]*|/\*.*?\*/|^#[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|\b(?:Assert\w*|static_assert|throw|ExcMessage)\b(?:"(?:\\.|[^"\\])*"|[^;"])*;',
                     re.DOTALL | re.MULTILINE)


def places(tree, room):
    """All mutants of a room: file, position, what stands there, what is to stand there."""
    result = []
    for directory, folders, names in os.walk(os.path.join(tree, "source", room)):
        folders.sort()
        for name in sorted(n for n in names if n.endswith((".cc", ".h"))):
            file = os.path.join(directory, name)
            with open(file) as opened:
                text = IGNORED.sub(lambda found: re.sub(r"\S", "#", found.group()), opened.read())
            result += [(os.path.relpath(file, tree), found.start(), found.group(), new) for old, new in EXCHANGES for found in re.finditer(old, text)]
    return result


def change(tree, file, position, old, new):
    """Make the change; returns its line's number and text before and after, and the whole file before."""
    with open(os.path.join(tree, file)) as opened:
        before = opened.read()
    after = before[:position] + new + before[position + len(old):]
    with open(os.path.join(tree, file), "w") as opened:
        opened.write(after)
    number = before.count("\n", 0, position)
    return number + 1, before.split("\n")[number].strip(), after.split("\n")[number].strip(), before


def first_failure(build, pattern, left_out):
    """The first test of a pattern that fails, or None."""
    done = subprocess.run(["ctest", "--test-dir", build, "-R", pattern, "-E", left_out, "--stop-on-failure"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS)))
    failed = re.search(r"FAILED:\s+\d+ - (\S+) \((.+)\)", done.stdout)
    return None if done.returncode == 0 else " ".join(failed.groups()) if failed else "ctest: " + done.stdout[-300:]


def targets(build, room):
    listed = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
    return ["mortise", "test_field_run"] + re.findall(r"^tests/(test_%s_\w+): CXX_EXE" % room, listed, re.MULTILINE)


def verdict(build, room):
    """What the compiler and the tests say: the first test that fails, or None."""
    ninja = ["ninja", "-C", build, "-j1"] + targets(build, room)
    if subprocess.run(ninja, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False).returncode != 0:
        return "the compiler"
    with open(os.path.join(HERE, "quick_scenes.txt")) as file:
        scenes = "|".join(file.read().split()[::EVERY])
    for pattern, left_out in STAGES:
        caught = first_failure(build, pattern.replace("ROOM", room).replace("SCENES", scenes), left_out)
        if caught:
            return caught
    return None


def draw(options, room):
    """Mutants of a room, no two of a line."""
    drawn = {}
    some = places(options.tree, room)
    random.Random("mutants %s %d" % (room, options.seed)).shuffle(some)
    for mutant in some:
        with open(os.path.join(options.tree, mutant[0])) as file:
            drawn.setdefault((mutant[0], file.read(mutant[1]).count("\n")), mutant)
        if len(drawn) == options.draws:
            break
    return list(enumerate(drawn.values()))


def run(options):
    for room in options.room or ROOMS:
        if options.first is None:
            wrong = verdict(options.build, room)
            if wrong:
                sys.exit("%s: fails without a change: %s" % (room, wrong))
        for number, mutant in draw(options, room)[options.first or 0:]:
            start = time.time()
            line, before, after, whole = change(options.tree, *mutant)
            try:
                caught = verdict(options.build, room)
            finally:
                with open(os.path.join(options.tree, mutant[0]), "w") as file:
                    file.write(whole)
            row = {"room": room, "seed": options.seed, "draw": number, "file": mutant[0], "line": line, "before": before, "after": after, "caught": caught,
                   "seconds": round(time.time() - start)}
            print(json.dumps(row), flush=True)
            with open(options.record, "a") as file:
                file.write(json.dumps(row) + "\n")


def page(_):
    with open(os.path.join(PLACE, "mutants.jsonl")) as file:
        rows = [json.loads(line) for line in file]

    def code(text):
        return "`" + text.replace("|", "\\|") + "`"
    kinds = ["caught", "new test", "equivalent", "open", "compiler"]

    def kind(row):
        return "compiler" if row["caught"] == "the compiler" else "caught" if row["caught"] else row["verdict"].split(":")[0]
    lines = ["| room | drawn | caught | a test was written | equivalent | open | does not compile |", "|---|---|---|---|---|---|---|"]
    for room in ROOMS:
        own = [kind(row) for row in rows if row["room"] == room]
        lines.append("| %s | %d | " % (room, len(own)) + " | ".join(str(own.count(k)) for k in kinds) + " |")
    lines += ["", "| room, draw | where | before | after | what sees it |", "|---|---|---|---|---|"]
    for row in rows:
        lines.append("| %s %d | %s:%d | %s | %s | %s |" % (row["room"], row["draw"], row["file"].split("/", 2)[2], row["line"], code(row["before"]),
                                                       code(row["after"]), row["caught"] or row["verdict"]))
    sys.path.insert(0, os.path.join(TOP, "tests", "benchmarks"))
    sys.dont_write_bytecode = True  # the tree stays clean
    import page as pages
    pages.write_part("mutants.md", "mutants", "\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = parser.add_subparsers(required=True)
    of_run = kinds.add_parser("run")
    of_run.set_defaults(do=run)
    of_run.add_argument("tree", type=os.path.abspath)
    of_run.add_argument("build", type=os.path.abspath)
    of_run.add_argument("--room", action="append", choices=ROOMS)
    of_run.add_argument("--seed", type=int, default=52)
    of_run.add_argument("--draws", type=int, default=15)
    of_run.add_argument("--first", type=int, help="draw to begin with; without it all tests run without a change first")
    of_run.add_argument("--record", default=os.path.join(PLACE, "mutants.jsonl"))
    kinds.add_parser("page").set_defaults(do=page)
    options = parser.parse_args()
    options.do(options)


if __name__ == "__main__":
    main()
