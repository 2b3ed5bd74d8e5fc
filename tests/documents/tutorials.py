#!/usr/bin/env python3
"""tutorials.py MORTISE PAGE...: does what the pages say, in the current directory, and compares what they show.

A code block after "File `NAME`:" is written as that file. Each line of a block `sh` is a command, a block `python` is
a program. The lines of a block `text` must stand, in that order, in what was printed last: their words are some of
the words of the line there, in order, and numbers agree to a tolerance. What the text of a page says in numbers of
three digits or more, or with a decimal point, must stand in one of its blocks or of those of the pages before it.
"""
import re
import subprocess
import sys

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


class Wrong(Exception):
    pass


def same(expected, got, tolerance):
    if expected == got:
        return True
    if not (re.fullmatch(NUMBER, expected) and re.fullmatch(NUMBER, got)):
        return False
    a, b = float(expected), float(got)
    digits = len(expected.partition(".")[2]) if "e" not in expected.lower() else 99
    return abs(a - b) <= max(tolerance * max(abs(a), abs(b)), 0.51 * 10.0**-digits if digits and digits < 99 else 0)


def words(line):
    return re.sub(r"[(),;]", " ", line).split()


def contains(line, expected, tolerance):
    """Whether the words of expected are some of those of line, in order."""
    rest = iter(words(line))
    return all(any(same(word, got, tolerance) for got in rest) for word in words(expected))


def compare(block, printed, start, tolerance):
    """The place in printed behind the last line of the block."""
    for expected in block.splitlines():
        for i in range(start, len(printed)):
            if contains(printed[i], expected, tolerance):
                start = i + 1
                break
        else:
            raise Wrong(f'"{expected.strip()}" was not printed, or not in this order; printed was:\n' + "\n".join(printed))
    return start


def run(command, shell):
    done = subprocess.run(command, shell=shell, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
    if done.returncode != 0:
        raise Wrong(f"{command} ends with {done.returncode}:\n{done.stdout}")
    return done.stdout.splitlines()


def check_prose(text, blocks):
    """Numbers of the text stand in blocks, rounded as the text has them."""
    known = [float(n) for block in blocks for n in re.findall(NUMBER, block)]
    prose = re.sub(r"\]\([^)]*\)|<!--.*?-->", " ", text, flags=re.S)
    for number in re.findall(r"(?<![\w.])\d+\.\d+|(?<![\w.])\d{3,}", prose):
        digits = len(number.partition(".")[2])
        if not any(abs(abs(k) - float(number)) <= 0.51 * 10.0**-digits if digits else abs(k) == float(number) for k in known):
            raise Wrong(f"the text says {number}, which no block has")


def check(page, mortise, earlier):
    parts = re.split(r"^```(\w*)\n(.*?)^```$", open(page).read(), flags=re.S | re.M)
    tolerance = re.search(r"<!-- tolerance ([\d.e-]+)", parts[0])
    tolerance = float(tolerance[1]) if tolerance else 1e-3
    texts, languages, blocks = parts[::3], parts[1::3], parts[2::3]
    printed, place, compared = [], 0, 0
    for before, language, block in zip(texts, languages, blocks):
        file = re.search(r"File `([^`/]+)`:\s*$", before)
        if file:
            with open(file[1], "w") as stream:
                stream.write(block)
        elif language == "sh":
            printed, place = [], 0
            for command in block.splitlines():
                if not command.startswith("mortise "):
                    raise Wrong(f'"{command}" is no command of mortise')
                printed += run(mortise + command[len("mortise"):], True)
        elif language == "python":
            printed, place = run([sys.executable, "-c", block], False), 0
        elif language == "text":
            place = compare(block, printed, place, tolerance)
            compared += 1
    if compared == 0:
        raise Wrong("the page shows no result")
    earlier += blocks
    check_prose("\n".join(texts), earlier)


failed = False
blocks = []  # of this page and those before it
for page in sys.argv[2:]:
    try:
        check(page, sys.argv[1], blocks)
    except (Wrong, subprocess.TimeoutExpired) as wrong:
        print(f"FAILED  {page}: {wrong}")
        failed = True
sys.exit(failed)
