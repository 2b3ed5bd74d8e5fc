"""What the benchmarks tell programs about the processor, and how they start several ranks."""

import os

MPI = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "mpi.sh")


def on_ranks(ranks):
    """The start of a command on several ranks, which give way while they wait."""
    return ["env", "OMPI_MCA_mpi_yield_when_idle=1", MPI, str(ranks)]


def openblas():
    """The environment that names OpenBLAS' kernels: Debian's takes its slowest on processors newer than itself.
    As in `run`."""
    try:
        with open("/proc/cpuinfo") as file:
            flags = file.read().split()
    except OSError:
        return {}
    for flag, core in (("avx512dq", "SkylakeX"), ("avx2", "Haswell")):
        if flag in flags:
            return {"OPENBLAS_CORETYPE": core}
    return {}
