#!/usr/bin/env python3
"""Estimated error at an edge of slip, uniform meshes beside adaptive ones: slip_edge.py build/mortise

A block of width 1 on a wider one, of equal moduli (E = 1000, nu = 0.3), plane strain, degree 2, mu = 0.5, pressed by 1 and sheared by 0.3 on its top: it slips near the
edges of the contact and sticks between them. Both columns are the estimate of Adaptivity, relative in energy; the adaptive run halves cells (Strategy = h)."""
import math
import os
import re
import subprocess
import sys
import tempfile

BODY = """subsection Body %s
  set Degree = 2
  subsection Mesh
    set Source       = box
    set Extent       = %s
    set Subdivisions = %d, %d, %d
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
  subsection Boundary ymin
    set Displacement = -, 0, -
  end
  subsection Boundary ymax
    set Displacement = -, 0, -
  end
%send
"""
SCENE = """set Bodies     = lower, upper
set Interfaces = touch
%ssubsection Interface touch
  set Slave  = upper: zmin
  set Master = lower: zmax
  set Law    = contact
  set Friction coefficient = 0.5
end
subsection Adaptivity
  set Target error = %g
  set Strategy     = h
end
subsection Output
  set Fields =
end
"""


def scene(n, target):
    """n cells on a length of 1 of the lower block; three quarters of that in the upper one."""
    layers, upper = max(1, n // 5), 3 * n // 4
    held = "  subsection Boundary zmin\n    set Displacement = 0, 0, 0\n  end\n"
    loaded = "  subsection Boundary zmax\n    set Traction = 0.3; 0; -1\n  end\n"
    return SCENE % (BODY % ("lower", "-1, 0, -1, 2, 0.2, 0", 3 * n, layers, n, held) + BODY % ("upper", "0, 0, 0, 1, 0.2, 0.5", 3 * n // 2, layers, max(1, upper), loaded), target)


def run(program, n, target):
    """Of each cycle: unknown displacements, estimated error."""
    with tempfile.TemporaryDirectory() as directory:
        name = os.path.join(directory, "scene.prm")
        with open(name, "w", encoding="utf-8") as f:
            f.write(scene(n, target))
        log = subprocess.run([program, "--output", os.path.join(directory, "results"), name], capture_output=True, text=True, check=True).stdout
    sizes = [int(x) for x in re.findall(r"spaces .* s   (\d+) displacement dofs", log)]
    errors = [float(x) for x in re.findall(r"estimated error ([0-9.e-]+)", log)]
    return list(zip(sizes[-len(errors):], errors))


def rows(kind, points):
    for k, (size, error) in enumerate(points):
        rate = "" if k == 0 else "%.2f" % (math.log(points[k - 1][1] / error) / math.log(size / points[k - 1][0]))
        print("| %s | %d | %.5f | %s |" % (kind, size, error, rate))


print("| meshes | displacements | estimated error | rate in displacements |")
print("|---|---|---|---|")
rows("uniform", [run(sys.argv[1], n, 0.9)[-1] for n in (5, 10, 20)])
rows("adaptive", run(sys.argv[1], 5, 0.01))
