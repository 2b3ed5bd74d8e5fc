"""Runs that are ended by signals at random moments and go on, full disks, and limits of memory."""
import json
import os
import shutil
import signal
import subprocess

import checkpoints
import runner

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# that take some tenths of a second and have several steps or cycles
SCENES = {
    "prm/patch.prm": ["Steps/Step=1", "Steps/End time=6"],
    "prm/thick_sphere.prm": ["Steps/Step=1", "Steps/End time=4"],
    "tests/field/pulled_and_pushed_beyond_yield.prm": [],
    "tests/field/frame_snaps_through.prm": ["Steps/Number of steps=8"],
    "tests/field/stretched_both_ways_neo_hooke_isochoric.prm": [],
    "tests/field/bolt_is_stretched_further.prm": [],
    "tests/field/sheared_to_and_fro_without_slip.prm": [],
    "tests/field/balloon_to_a_target.prm": ["Adaptivity/Target error=0.02"]}


def settings(words):
    return [w for s in words for w in ("--set", s)]


def options(scene):
    return [os.path.join(TOP, scene)] + settings(SCENES[scene] + ["Output/Checkpoint every=1", "Output/Fields=displacement"])


def results(file):
    """The numbers of the steps that are no iterations, residuals, or times."""
    with open(file) as opened:
        summary = json.load(opened)

    def numbers(value, path):
        if isinstance(value, dict):
            for k, v in value.items():
                if k in ("displacement_max", "quantities") or path and path[0] in ("displacement_max", "quantities"):
                    yield from numbers(v, path + [k])
        elif isinstance(value, list):
            for i, v in enumerate(value):
                yield from numbers(v, path + [str(i)])
        elif isinstance(value, float) and "at" not in path:
            yield value
    return [[x for body in step["bodies"] for x in numbers(body, [])] + list(numbers({"quantities": step.get("quantities", {})}, []))
            for step in summary["steps"]]


def difference(one, other, tolerance=1e-4):
    if len(one) != len(other):
        return "%d steps instead of %d" % (len(other), len(one))
    for i, (a, b) in enumerate(zip(one, other)):
        scale = max([abs(x) for x in a] + [1e-300])
        if len(a) != len(b) or any(not abs(x - y) < tolerance * scale for x, y in zip(a, b)):
            return "step %d: %s, undisturbed %s" % (i, b, a)
    return None


undisturbed = {}


def reference(campaign, scene):
    if scene not in undisturbed:
        output = campaign.path("undisturbed")
        done = runner.run(campaign.options.mortise, ["--output", output] + options(scene), campaign.work, limit=120.)
        wrong = runner.what_is_wrong(done, output)
        undisturbed[scene] = (wrong or None if done.code == 0 else "undisturbed: exit code %s" % done.code,
                              done.code == 0 and results(os.path.join(output, "summary.json")), done.seconds)
        shutil.rmtree(output, ignore_errors=True)
    return undisturbed[scene]


def kill(campaign, random):
    """Ended some times by signals, each time continued, maybe on another number of ranks: the same numbers."""
    scene = random.choice(list(SCENES))
    wrong, expected, seconds = reference(campaign, scene)
    if wrong:
        return wrong
    output = campaign.path("results")
    checkpoint = os.path.join(output, "checkpoint.bin")

    def arguments():
        return ["--restart", output] if os.path.exists(checkpoint) else ["--output", output] + options(scene)
    for _ in range(random.choice([1, 2, 4])):
        number = random.choice([signal.SIGTERM, signal.SIGINT, signal.SIGKILL, signal.SIGHUP, signal.SIGXCPU, signal.SIGUSR1, signal.SIGSEGV])
        ranks = random.choice([1, 1, campaign.options.ranks])
        killed = runner.run(campaign.options.mortise, arguments(), campaign.work, ranks, 120., interrupt=(random.uniform(0., 1.1 * seconds), number))
        campaign.count(killed)
        if ranks > 1 and number not in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            continue  # it ended mpi.sh alone
        if number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGXCPU):
            wrong = runner.what_is_wrong(killed, output, sent=number)
            if killed.code == 128 + number and wrong is None:
                said = killed.err.strip().splitlines()
                if len(said) > 1 or (said and not said[0].startswith("interrupted by SIG")):
                    wrong = "message: " + " | ".join(said)
            if wrong:
                return "%s by signal %d: " % (scene, number) + wrong if ":" not in wrong else wrong + " (%s, signal %d)" % (scene, number)
    last = runner.run(campaign.options.mortise, arguments(), campaign.work, random.choice([1, campaign.options.ranks]), 120.)
    campaign.count(last)
    wrong = runner.what_is_wrong(last)
    if wrong or last.code != 0:
        return wrong or "continued: exit code %s: %s" % (last.code, last.err[:200])
    other = difference(expected, results(os.path.join(output, "summary.json")))
    return other and "number: %s: %s" % (scene, other)


def all_whole(directory):
    """Every file that is there can be read to its end."""
    for name in os.listdir(directory) if os.path.isdir(directory) else []:
        path = os.path.join(directory, name)
        with open(path, "rb") as file:
            content = file.read()
        if name.endswith((".vtu", ".pvd")) and not content.rstrip().endswith(b"</VTKFile>"):
            return "leftover: %s ends early" % name
        if name == "summary.json":
            try:
                json.loads(content)
            except ValueError as error:
                return "summary: %s" % error
        if name == "checkpoint.bin":
            try:
                checkpoints.parse(content)
            except Exception as error:
                return "leftover: checkpoint.bin: %s" % error
    return None


def fault(campaign, random):
    """A disk that is full, files that may not grow, a memory too small: an allowed exit code, and whole files."""
    scene = random.choice(list(SCENES))
    output = campaign.path("results")
    how = random.choice(["file size", "memory", "full output", "full disk", "no directory"])
    arguments = ["--output", output] + options(scene)
    ranks = campaign.options.ranks
    if how == "file size":
        done = runner.run(campaign.options.mortise, arguments, campaign.work, ranks, 120., file_size=int(2. ** random.uniform(8., 18.)))
    elif how == "memory":
        # below that the loader of libraries or mpirun fails
        done = runner.run(campaign.options.mortise, arguments, campaign.work, ranks, 120.,
                          memory=int(random.uniform(450., 900.) * (1 << 20)))
        if done.code == 127 or (ranks > 1 and "mortise" not in done.err and done.code not in (0, 4)):
            return None
    elif how == "full output":
        done = runner.run(campaign.options.mortise, arguments, campaign.work, ranks, 120., out="/dev/full")
        if done.code == 0:
            return "silence: nothing could be printed, exit code 0"
    elif how == "no directory":
        bad = random.choice(["/proc/none", "/dev/full", "/dev/null/a", campaign.write("file", "x"), campaign.path("file2/\0" if False else "a" * 300)])
        done = runner.run(campaign.options.mortise, ["--output", bad] + options(scene), campaign.work, ranks, 120.)
        if done.code == 0:
            return "silence: no directory can be made, exit code 0"
    else:
        # a disk that only the run sees
        os.mkdir(campaign.path("disk"))
        size = int(2. ** random.uniform(3., 9.))
        inner = runner.command_line(campaign.options.mortise, ["--output", campaign.path("disk")] + options(scene), ranks)
        script = 'mount -t tmpfs -o size=%dk none "$0" 2>/dev/null || exit 77; "${@:2}"; code=$?; mkdir "$1"; cp -r "$0"/. "$1"; exit $code' % size
        with open(campaign.path("out"), "w") as out, open(campaign.path("err"), "w") as err:
            process = subprocess.run(["unshare", "-rm", "bash", "-c", script, campaign.path("disk"), output] + inner, stdout=out, stderr=err,
                                     env=runner.environment(ranks), timeout=180, check=False)
        if process.returncode == 77 or "unshare" in runner.text_of(campaign.path("err")):
            return None  # not allowed here
        done = runner.Result(process.returncode, runner.text_of(campaign.path("out")), runner.text_of(campaign.path("err")), 0.)
    campaign.count(done)
    wrong = runner.what_is_wrong(done, output if how != "no directory" else None)
    if wrong is None and how != "no directory":
        wrong = all_whole(output)
    if wrong is None and how == "memory" and done.code not in (0, 3, 4):
        wrong = "exit code %s: %s" % (done.code, done.err[:300])
    return wrong and wrong + " (%s, %s)" % (how, scene)
