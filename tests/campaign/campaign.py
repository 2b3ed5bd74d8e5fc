#!/usr/bin/env python3
"""Hard knocks: inputs drawn at random, and faults of the machine, until something is wrong. See README.md beside it.

    campaign.py KIND --mortise PROGRAM [--batch PROGRAM] [--seed S] [--first N] [--draws N] [--seconds T] [--ranks R]

KIND is scenes, meshes, checkpoints, stacks, kills or faults. A draw is determined by its seed and number. Ends with 1
if there are findings, each printed with the command that repeats it.
"""
import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the tree stays clean

import checkpoints
import kills
import meshes
import minimise
import runner
import scenes
import stacks

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.join(HERE, "..", "..")


def random_of(*words):
    return random.Random(" ".join(str(w) for w in words))


class Campaign:
    def __init__(self, options):
        self.options, self.slow, self.in_batch_only = options, [], []
        self.codes = {}
        self.work = tempfile.mkdtemp(prefix="campaign")
        self.batch = runner.Batch(options.batch, options.ranks) if options.batch else None

    def clean(self):
        for name in os.listdir(self.work):
            path = os.path.join(self.work, name)
            shutil.rmtree(path) if os.path.isdir(path) and not os.path.islink(path) else os.unlink(path)

    def path(self, name):
        return os.path.join(self.work, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode("latin-1", "replace"))
        return self.path(name)

    def once(self, arguments, batch, limit):
        if batch and self.batch:
            return self.batch.run(arguments, self.work, limit)
        return runner.run(self.options.mortise, arguments, self.work, self.options.ranks, 3 * limit)

    def scene(self, file, runs, batch=True):
        """Validate a scene, run it if it is valid and may be run; what is wrong, or None."""
        output = self.path("results")
        arguments = ["--output", output, file]
        result = self.once(["--validate"] + arguments, batch, 10.)
        wrong = runner.what_is_wrong(result, output, validates=True)
        if wrong is None and result.code == 0 and runs:
            result = self.once(arguments, batch, self.options.limit)
            wrong = runner.what_is_wrong(result, output)
            if self.options.limit < result.seconds:
                self.slow.append(self.number)
        self.count(result)
        if wrong is None and result.code == 4 and self.options.kind == "meshes":
            wrong = "memory: too little for a file of some kilobytes"
        return wrong

    def count(self, result):
        self.codes[result.code] = self.codes.get(result.code, 0) + 1

    # a draw returns what is wrong, and the parts that are made smaller with a function that tries some of them

    def draw_scenes(self, number):
        draws = random_of("scenes", self.options.seed, number)
        scene, operations = scenes.draw(draws, self.corpus, self.corpus.chosen)
        runs = os.path.basename(scene.file)[:-4] in self.corpus.quick

        def attempt(operations, batch=True):
            self.clean()
            file = self.write("scene.prm", scenes.apply(random_of, self.corpus, scene, operations))
            return self.scene(file, runs, batch)
        return attempt, operations

    def draw_meshes(self, number):
        draws = random_of("meshes", self.options.seed, number)
        shape, operations = meshes.draw(draws)
        text = meshes.scene(draws, "mesh.msh")

        def attempt(operations, batch=True):
            self.clean()
            self.write("mesh.msh", meshes.apply(random_of, shape, operations))
            return self.scene(self.write("scene.prm", text), True, batch)
        return attempt, operations

    def draw_checkpoints(self, number):
        draws = random_of("checkpoints", self.options.seed, number)
        name, operations = checkpoints.draw(draws, self.bases)

        def attempt(operations, batch=True):
            self.clean()
            base = self.bases[name]
            os.mkdir(self.path("results"))
            content = checkpoints.apply(random_of, self.bases, name, operations)
            self.write("results/checkpoint.bin", content)
            result = self.once(["--restart", self.path("results")] + base.further(self.path("results")), batch, self.options.limit)
            self.count(result)
            wrong = runner.what_is_wrong(result, self.path("results"))
            if wrong is None and result.code == 4:
                wrong = "memory: too little for a file of some kilobytes"
            if wrong is None and result.code != 2 and content != base.content and {kind for kind, _ in operations} == {"raw"}:
                wrong = "accepted: damaged bytes, exit code %s" % result.code
            return wrong
        return attempt, operations

    def draw_stacks(self, number):
        draws = random_of("stacks", self.options.seed, number)
        stack = stacks.draw(draws)

        def attempt(variants, batch=True):
            self.clean()
            return stacks.check(self, stack, variants, batch)
        return attempt, stacks.variants(stack, self.options.ranks)

    def draw_kills(self, number):
        return self.of_machine(kills.kill, "kills", number)

    def draw_faults(self, number):
        return self.of_machine(kills.fault, "faults", number)

    def of_machine(self, what, kind, number):
        def attempt(_, batch=True):
            self.clean()
            return what(self, random_of(kind, self.options.seed, number))
        return attempt, [None]

    def prepare(self):
        kind = self.options.kind
        if kind == "scenes":
            reference = subprocess.run([self.options.mortise, "--parameters"], capture_output=True, text=True, env=runner.environment(1)).stdout
            directories = self.options.corpus or [os.path.join(TOP, "prm"), os.path.join(TOP, "tests", "field"), HERE]
            self.corpus = scenes.Corpus(directories, reference)
            with open(os.path.join(HERE, "quick_scenes.txt")) as file:
                self.corpus.quick = set(file.read().split())
            if self.options.corpus:
                self.corpus.quick |= set(self.corpus.by_name)
            self.corpus.chosen = [s for s in self.corpus.scenes if not self.options.quick or os.path.basename(s.file)[:-4] in self.corpus.quick]
        if kind == "checkpoints":
            self.bases = checkpoints.bases(self, TOP)

    def report(self, number, wrong, attempt, parts):
        """What is wrong is tried with the program itself, made smaller, kept, and printed. Returns whether it is a finding."""
        if len(parts) > 1:
            kind = runner.kind_of(wrong)

            def fails(some):
                other = runner.kind_of(attempt(some))
                if other and other != kind and other.startswith(("exit code", "sanitizer")):
                    print("draw %d: on the way, parts %s: %s" % (number, some, other), flush=True)
                return other == kind
            parts = minimise.smallest(parts, fails, 1 if kind in ("slow", "deaf") else 60)
        again = attempt(parts, False)
        if again is None:
            self.in_batch_only.append(number)
            print("draw %d: not with the program itself: %s, parts %s" % (number, wrong, parts), flush=True)
            return False
        wrong = again
        own = os.path.relpath(os.path.abspath(__file__))
        print("FINDING draw %d: %s" % (number, wrong))
        print("  python3 %s %s --mortise %s --seed %d --first %d --draws 1 --ranks %d%s --parts \"%s\"" % (
            own, self.options.kind, self.options.mortise, self.options.seed, number, self.options.ranks,
            "".join(" --corpus " + c for c in self.options.corpus or []) + (" --quick" if self.options.quick else ""), parts))
        if self.options.keep:
            kept = os.path.join(self.options.keep, "%s-%d-%d" % (self.options.kind, self.options.seed, number))
            shutil.rmtree(kept, ignore_errors=True)
            shutil.copytree(self.work, kept, symlinks=True)
            print("  kept in " + kept)
        sys.stdout.flush()
        return True

    def run(self):
        self.prepare()
        start, findings, number = time.time(), 0, self.options.first
        draw = getattr(self, "draw_" + self.options.kind)
        while number < self.options.first + self.options.draws and time.time() - start < self.options.seconds:
            self.number = number
            attempt, parts = draw(number)
            if self.options.parts:
                parts = ast.literal_eval(self.options.parts)
            wrong = attempt(parts)
            if wrong and self.report(number, wrong, attempt, parts):
                findings += 1
                if findings >= self.options.findings:
                    number += 1
                    break
            number += 1
        seconds = time.time() - start
        done = number - self.options.first
        print("%s, seed %d, %d ranks: %d draws in %.0f s (%.1f per second), %d findings; runs by exit code: %s; longer than the limit: %d"
              % (self.options.kind, self.options.seed, self.options.ranks, done, seconds, done / max(seconds, 1e-9), findings,
                 ", ".join("%s: %d" % item for item in sorted(self.codes.items(), key=str)), len(self.slow)))
        if self.slow:
            print("  slow: " + ", ".join(map(str, self.slow[:50])))
        return findings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=["scenes", "meshes", "checkpoints", "stacks", "kills", "faults"])
    parser.add_argument("--mortise", required=True, type=os.path.abspath)
    parser.add_argument("--batch", type=os.path.abspath, help="campaign_batch, which is faster")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--draws", type=int, default=10 ** 9)
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--limit", type=float, default=10., help="seconds of a run")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--findings", type=int, default=10 ** 9, help="stop after so many")
    parser.add_argument("--corpus", action="append", type=os.path.abspath, help="directories of scenes")
    parser.add_argument("--quick", action="store_true", help="only scenes of quick_scenes.txt")
    parser.add_argument("--parts", help="those of a finding, as printed")
    parser.add_argument("--keep", type=os.path.abspath, help="directory for what is found")
    options = parser.parse_args()
    campaign = Campaign(options)
    try:
        return 1 if campaign.run() else 0
    finally:
        if campaign.batch:
            campaign.batch.end()
        shutil.rmtree(campaign.work, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
