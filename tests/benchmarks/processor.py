"""What the benchmarks tell programs about the processor."""


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
