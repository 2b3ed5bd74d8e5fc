"""Finding and running the program."""

from __future__ import annotations

import contextlib
import itertools
import os
import shutil
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

from .errors import MortiseError, ProgramNotFound, error_of
from .results import Results
from .scene_file import SceneFile
from .values import text_of

PathLike = Union[str, "os.PathLike[str]"]
SceneLike = Union[SceneFile, PathLike]


def find_program(program: Optional[PathLike] = None) -> Path:
    """The program: the argument, the environment variable MORTISE, on PATH, or in a directory build*
    of the checkout that this package is part of or that is the working directory."""
    for given, what in ((program, "the argument program"), (os.environ.get("MORTISE"), "the variable MORTISE")):
        if given:
            found = shutil.which(str(given))
            if not found:
                raise ProgramNotFound(f'{what} is "{given}", which is no program')
            return Path(found).resolve()
    on_path = shutil.which("mortise")
    if on_path:
        return Path(on_path).resolve()
    for top in (*list(Path(__file__).resolve().parents)[2:4], Path.cwd()):
        for candidate in sorted(top.glob("build*/mortise")):
            if os.access(candidate, os.X_OK):
                return candidate.resolve()
    raise ProgramNotFound("there is no program mortise: give the argument program, set MORTISE, put it on PATH, or build it")


def environment() -> Dict[str, str]:
    """One thread per rank; ranks that wait give way."""
    result = dict(os.environ)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "DEAL_II_NUM_THREADS", "OMPI_MCA_mpi_yield_when_idle"):
        result.setdefault(name, "1")
    return result


def _command(program: Path, ranks: int) -> List[str]:
    if ranks == 1:
        return [str(program)]
    if not shutil.which("mpirun"):
        raise ProgramNotFound("there is no mpirun on PATH, which several ranks need")
    command = ["mpirun", "-n", str(ranks), "--map-by", ":OVERSUBSCRIBE", "--bind-to", "none"]
    if os.geteuid() == 0:
        command.append("--allow-run-as-root")
    return command + [str(program)]


def _watched(process: "subprocess.Popen[str]", log: Optional[Callable[[str], Any]]) -> Dict[str, List[str]]:
    """All lines of both streams as they come."""
    lines: Dict[str, List[str]] = {"out": [], "err": []}

    def read(stream: Any, name: str) -> None:
        for line in stream:
            lines[name].append(line.rstrip("\n"))
            if log:
                log(lines[name][-1])

    threads = [threading.Thread(target=read, args=(process.stdout, "out")),
               threading.Thread(target=read, args=(process.stderr, "err"))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return lines


def _message(error_lines: Sequence[str]) -> str:
    """What the program says, without what mpirun adds."""
    starts = [i for i, line in enumerate(error_lines) if line.startswith(("error: ", "not converged: "))]
    lines = error_lines[starts[0] :] if starts else error_lines
    ends = [i for i, line in enumerate(lines) if line.startswith("-----")]
    return "\n".join(lines[: ends[0]] if ends else lines).strip()


def _execute(command: Sequence[str], directory: Optional[Path], log: Optional[Callable[[str], Any]],
             timeout: Optional[float]) -> "tuple[int, Dict[str, List[str]]]":
    process = subprocess.Popen(command, cwd=directory, env=environment(), stdin=subprocess.DEVNULL, text=True,
                               errors="replace", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    late = threading.Event()

    def end() -> None:
        late.set()
        process.terminate()

    timer = threading.Timer(timeout, end) if timeout else None
    if timer:
        timer.start()
    try:
        lines = _watched(process, log)
        code = process.wait()
        return (128 + signal.SIGTERM if late.is_set() and code else code), lines
    finally:
        if timer:
            timer.cancel()
        if process.poll() is None:
            process.terminate()  # the caller was interrupted
            process.wait()


def run(scene: SceneLike, *, ranks: int = 1, output: Optional[PathLike] = None,
        settings: Optional[Mapping[str, Any]] = None, program: Optional[PathLike] = None,
        log: Union[bool, Callable[[str], Any]] = False, timeout: Optional[float] = None) -> Results:
    """Run a scene and return its results.

    scene: a Scene, or the name of a parameter file.
    ranks: processes of MPI.
    output: directory of the results; by default that of the scene, or results/NAME.
    settings: values by path that go before those of the scene, as {"Body inner/Degree": 3}.
    program: see find_program().
    log: True prints the lines of the log as they come; a function is called with each.
    timeout: seconds after which the run is ended (Interrupted).

    Raises InputError, NotConverged (whose `results` are what was reached), OutOfMemory, Interrupted or
    ProgramDefect with the program's own message. The log is kept in OUTPUT/log.txt, and the scene, if
    it is no file, in OUTPUT/scene.prm."""
    directory: Optional[Path] = None
    if isinstance(scene, SceneFile):
        output = Path(output or scene.output.directory or "results/scene").absolute()  # type: ignore[attr-defined]
        made = not output.exists()
        output.mkdir(parents=True, exist_ok=True)
        file, directory = scene.write(output / "scene.prm"), scene.directory
    else:
        file, made = Path(scene).absolute(), False
        output = Path(output or Path("results") / file.stem).absolute()
    command = _command(find_program(program), ranks)
    for path, value in (settings or {}).items():
        command += ["--set", f"{path}={text_of(value)}"]
    printer = print if log is True else log or None
    code, lines = _execute([*command, "--output", str(output), str(file)], directory, printer, timeout)
    if not (output / "summary.json").exists() and made and not list(output.glob("*.vtu")):
        shutil.rmtree(output)  # nothing was computed
    else:
        output.mkdir(parents=True, exist_ok=True)
        (output / "log.txt").write_text("\n".join(lines["out"] + lines["err"]) + "\n")
    if code == 0:
        return Results(output)
    results = None
    with contextlib.suppress(OSError, ValueError):
        results = Results(output)
    message = _message(lines["err"])
    raise error_of(code, message or f"the program ended with code {code}", results)


class Outcome(NamedTuple):
    """One run of a sweep."""

    settings: Dict[str, Any]
    #: None if there are none
    results: Optional[Results]
    #: None if the run ended well
    error: Optional[MortiseError]


def sweep(scene: SceneLike, settings: Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]], *,
          jobs: Optional[int] = None, ranks: int = 1, output: PathLike = "results/sweep",
          **options: Any) -> List[Outcome]:
    """Run a scene with many settings, several at a time, and return the outcomes in their order.

    settings: values by path, of which all combinations are run, or a list of settings.
    jobs: processes at the same time; by default the processors divided by the ranks.
    output: run number i writes to OUTPUT/i, from 0 on.
    options: those of run().

    A run that fails does not end the others: its outcome has the error."""
    if isinstance(settings, Mapping):
        runs = [dict(zip(settings, values)) for values in itertools.product(*settings.values())]
    else:
        runs = [dict(one) for one in settings]
    width = len(str(max(len(runs) - 1, 0)))

    def one(i: int) -> Outcome:
        try:
            where = Path(output) / str(i).zfill(width)
            return Outcome(runs[i], run(scene, ranks=ranks, output=where, settings=runs[i], **options), None)
        except MortiseError as error:
            return Outcome(runs[i], error.results, error)

    processors = len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
    with ThreadPoolExecutor(jobs or max(1, processors // ranks)) as pool:
        return list(pool.map(one, range(len(runs))))
