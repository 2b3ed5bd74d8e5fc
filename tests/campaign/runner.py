"""Runs of mortise with limits of time and memory, and what is wrong with how they end."""
import json
import math
import os
import re
import resource
import select
import shutil
import signal
import subprocess
import tempfile
import time

SIGNALS_OF_CRASHES = {4, 6, 7, 8, 11}
MEMORY = 4 << 30  # bytes of address space of a process
LONGEST_MESSAGE = 30  # lines
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_odls_base_sigkill_timeout": "0", "OMPI_MCA_pml": "ob1",
    "ASAN_OPTIONS": "detect_leaks=0:abort_on_error=0:allocator_may_return_null=1", "UBSAN_OPTIONS": "print_stacktrace=1"}
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0"}
MPI = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "mpi.sh")


class Result:
    """How a run ended: code as a shell has it, None where it was ended by the limit of time."""

    def __init__(self, code, out, err, seconds, deaf=False):
        self.code, self.out, self.err, self.seconds, self.deaf = code, out, err, seconds, deaf


def environment(ranks):
    result = dict(os.environ, **ENVIRONMENT)
    if ranks == 1:
        result.update(ALONE)
    return result


def limits(memory=MEMORY, file_size=None):
    """What a child sets before it becomes the program."""
    def set_them():
        if memory and not os.environ.get("CAMPAIGN_SANITIZED"):  # its shadow memory is terabytes
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if file_size is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))
    return set_them


def text_of(file):
    try:
        with open(file, errors="replace") as opened:
            return opened.read(1 << 20)
    except OSError:
        return ""


def stop(process, group=True, patience=10.):
    """End it by SIGTERM; if it is deaf to that, by SIGKILL. Returns whether it was deaf."""
    def send(number):
        try:
            (os.killpg if group else os.kill)(process.pid, number)
        except ProcessLookupError:
            pass
    send(signal.SIGTERM)
    try:
        process.wait(patience)
        deaf = False
    except subprocess.TimeoutExpired:
        deaf = True
    send(signal.SIGKILL)
    process.wait()
    return deaf


def command_line(mortise, arguments, ranks):
    own = [mortise] + arguments
    return own if ranks == 1 else [MPI, str(ranks)] + own


def run(mortise, arguments, directory, ranks=1, limit=60., memory=MEMORY, file_size=None, interrupt=None, out=None):
    """One run of the program; interrupt is (seconds, signal)."""
    start = time.time()
    with open(out or os.path.join(directory, "out"), "w") as output, open(os.path.join(directory, "err"), "w") as error:
        process = subprocess.Popen(command_line(mortise, arguments, ranks), stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=error, env=environment(ranks), start_new_session=True,
                                   preexec_fn=limits(memory, file_size))
        code, deaf = None, False
        try:
            if interrupt:
                try:
                    process.wait(interrupt[0])
                except subprocess.TimeoutExpired:
                    process.send_signal(interrupt[1])
            code = process.wait(limit)
        except subprocess.TimeoutExpired:
            deaf = stop(process)
    if code is not None and code < 0:
        code = 128 - code
    return Result(code, text_of(os.path.join(directory, "out")), text_of(os.path.join(directory, "err")),
                  time.time() - start, deaf)


class Batch:
    """Many runs in one process, or one set of ranks: campaign_batch, begun again after each crash."""

    def __init__(self, program, ranks=1):
        self.program, self.ranks, self.process = program, ranks, None
        self.pipe = os.path.join(tempfile.mkdtemp(prefix="campaign"), "requests")
        os.mkfifo(self.pipe)

    def begin(self):
        self.requests = os.open(self.pipe, os.O_RDWR)  # mpirun does not hand on all that it is given
        self.process = subprocess.Popen(command_line(self.program, [self.pipe], self.ranks), stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment(self.ranks),
                                        start_new_session=True, preexec_fn=limits())
        self.answers = b""

    def end(self):
        if self.process:
            os.close(self.requests)
            try:
                self.process.wait(5)
            except subprocess.TimeoutExpired:
                stop(self.process)
            self.process.stdout.close()
            self.process = None
        shutil.rmtree(os.path.dirname(self.pipe), ignore_errors=True)

    def answer(self, limit):
        """A line, "" where the process is gone, None where time is over."""
        until = time.time() + limit
        while b"\n" not in self.answers:
            ready, _, _ = select.select([self.process.stdout], [], [], max(0., until - time.time()))
            if not ready:
                return None
            more = os.read(self.process.stdout.fileno(), 4096)
            if not more:
                return ""
            self.answers += more
        line, _, self.answers = self.answers.partition(b"\n")
        return line.decode(errors="replace")

    def run(self, arguments, directory, limit=20.):
        if self.process is None:
            self.begin()
        out, err = os.path.join(directory, "out"), os.path.join(directory, "err")
        for file in (out, err):
            open(file, "w").close()
        start = time.time()
        request = "\n".join([str(len(arguments)), directory] + arguments) + "\n"
        os.write(self.requests, request.encode("latin-1"))
        line = self.answer(limit)
        code, deaf = None, False
        if line is None:
            deaf = stop(self.process)
        elif line == "":
            code = self.process.wait()
            code = 128 - code if code < 0 else code
        else:
            code = int(line)
        if line in (None, ""):
            os.close(self.requests)
            self.process.stdout.close()
            self.process = None
        return Result(code, text_of(out), text_of(err), time.time() - start, deaf)


def not_finite(value, path=""):
    """The place of a number in a summary that is nan or inf, or of a null."""
    if isinstance(value, dict):
        places = (not_finite(v, path + "/" + k) for k, v in value.items())
    elif isinstance(value, list):
        places = (not_finite(v, path + "/" + str(i)) for i, v in enumerate(value))
    else:
        bad = value is None or (isinstance(value, float) and not math.isfinite(value))
        return path + " = " + str(value) if bad else None
    return next((place for place in places if place), None)


def wrong_summary(file):
    if not os.path.exists(file):
        return "no summary.json"
    try:
        with open(file) as opened:
            return not_finite(json.load(opened))
    except ValueError as error:
        return "summary.json cannot be read: %s" % error


def unfinished(directory):
    """Files that only a killed run may leave."""
    return [name for name in (os.listdir(directory) if os.path.isdir(directory) else []) if ".unfinished" in name]


def what_is_wrong(result, output=None, validates=False, sent=None):
    """In words, or None. The words before a colon say what kind of finding it is."""
    said = result.err + result.out
    if re.search(r"AddressSanitizer|LeakSanitizer|runtime error: ", said):
        found = re.search(r"(ERROR: AddressSanitizer: \S+|[^\n/]*:\d+:\d+: runtime error: [^\n]*)", said)
        return "sanitizer: " + (found.group(1) if found else "")
    if result.deaf:
        return "deaf: SIGTERM does not end it"
    if result.code is None:
        return "slow: it takes longer than %.0f s" % result.seconds if validates else None
    allowed = {0, 2, 3, 4} | ({128 + sent} if sent else set())
    if result.code not in allowed:
        last = result.err.strip().splitlines()
        return "exit code %d: %s" % (result.code, " | ".join(last[-3:])[:300])
    if result.code != 0 and not result.err.strip() and not (sent and not result.out):  # it may not have begun
        return "silence: exit code %d without a message" % result.code
    if len(result.err.splitlines()) > LONGEST_MESSAGE:
        return "long message: of %d lines" % len(result.err.splitlines())
    if re.search(r"\b(what\(\)|std::|terminate called|Assertion|dealii::|boost::|An error occurred in line)", result.err):
        return "words of developers: " + result.err[:200]
    if output:
        if unfinished(output):
            return "leftover: " + ", ".join(unfinished(output))
        if validates and os.path.exists(output):
            return "leftover: an output directory of --validate"
        if result.code == 0 and not validates:
            problem = wrong_summary(os.path.join(output, "summary.json"))
            if problem:
                return "summary: " + problem
    return None


def kind_of(finding):
    """What has to stay the same while a finding is made smaller."""
    return finding.split(":")[0] if finding else None
