"""What tests of the Python package print, and how they end."""

import sys

failed = 0


def verdict(good, what, got="nothing"):
    global failed
    print(f"{'OK' if good else 'FAILED'}  {what}" + ("" if good else f": got {got}"), flush=True)
    failed += not good


def raised(kind, action):
    """The exception of this kind that action raises; None, and a failure, without one."""
    try:
        action()
    except kind as error:
        return error
    except Exception as error:  # what came in its place
        verdict(False, f"{kind.__name__} is raised", repr(error))
        return None
    verdict(False, f"{kind.__name__} is raised")
    return None


def need(module):
    """End the test as skipped where a module is missing."""
    try:
        return __import__(module)
    except ImportError:
        print(f"skipped: {sys.executable} has no {module}")
        sys.exit(77)


def end():
    sys.exit(1 if failed else 0)
