"""Cells and rules of integration of GetFEM for hexahedra (`hex`) and for tetrahedra (`tet`), six in each hexahedron, shared by the scripts getfem_*.py of fit_report.py."""
import itertools
import math

import getfem as gf
import numpy as np


def parts(elements, reference):
    """Nodes of each cell in the unit cube, from those of its reference cell."""
    if elements == "hex":
        return [reference]
    result = []
    for order in itertools.permutations(range(3)):
        v = np.zeros((4, 3))
        for k, c in enumerate(order):
            v[k + 1:, c] += 1
        result.append(v[0] + reference @ (v[1:] - v[0]))
    return result


def integration(mesh, elements, order):
    if elements == "hex":
        return gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,%d)" % order))
    simple = "IM_TETRAHEDRON(%d)" % next((q for q in (1, 2, 3, 5, 6, 8) if q >= order), 8)
    return gf.MeshIm(mesh, gf.Integ(simple if order <= 8 else "IM_STRUCTURED_COMPOSITE(%s,%d)" % (simple, math.ceil(order / 8))))
