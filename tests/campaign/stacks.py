"""Stacks of bodies of all materials and interface laws under a constant stress: what every mesh holds exactly.

All bodies have the displacement gradient H of their own, alike in the plane of the interfaces, so that the traction t is
the same everywhere. Sides have the exact displacements or tractions, the lowest face is held, the highest one pulled.
"""
import json
import math
import os

import runner
from tensors import axes, cross_column, law_of, product, transposed

FACES = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
SMALL = ["linear elastic", "linear elastic", "orthotropic", "J2 plasticity"]
FINITE = ["neo-Hookean", "St. Venant-Kirchhoff", "Mooney-Rivlin", "Ogden", "logarithmic"]
METHODS = ["direct", "auto", "saddle point", "condensed"]


class Body:
    pass


def draw(random):
    """A stack as numbers; what is not named among the parts of a trial is as simple as can be."""
    stack = Body()
    n = random.choice([2, 2, 3, 4])
    stack.finite = random.random() < 0.3
    stack.law_of_interfaces = random.choice(["tie", "tie", "slide", "contact", "friction", "tresca", "spring"])
    stack.size = [random.choice([1., 2., 0.7, 30.]) for _ in range(2)]
    length = max(stack.size)
    young = random.choice([1., 900., 2e5, 1e9])
    ties = stack.law_of_interfaces in ("tie", "friction", "tresca", "spring")
    extent = 0.05 if stack.finite else 0.01
    # the columns along the interfaces; with finite strains interfaces stay horizontal
    stack.H = [[random.uniform(-extent, extent) for _ in range(2)] for _ in range(3)]
    if stack.finite:
        stack.H[2] = [0., 0.]
    tangential = [random.uniform(-1., 1.) * (0.2 if stack.law_of_interfaces in ("friction", "tresca") else 1.) if ties else 0. for _ in range(2)]
    # pressed so much that it is no contact of rounding
    normal = random.choice([-1., 1.]) if stack.law_of_interfaces in ("tie", "slide", "spring") else -1.
    stack.traction = [0.3 * extent * young * c for c in tangential + [normal * random.uniform(0.6, 1.)]]
    stack.spring = [young / length * random.choice([0.5, 10., 1000.]) for _ in range(2)]
    stack.angles = [random.choice([0., 30., 90., 17.5, -120.]) for _ in range(3)]
    stack.shift = [random.choice([0., 5., -100.]) * length for _ in range(3)]
    stack.bodies = []
    z = 0.
    for i in range(n):
        body = Body()
        body.z = [z, z + length * random.choice([0.3, 0.5, 1.])]
        z = body.z[1]
        body.cells = [random.choice([1, 2, 2, 3]) for _ in range(3)]
        body.degree = random.choice([1, 2, 2, 3])
        body.tetrahedra, body.mixed = random.random() < 0.3, random.random() < 0.5
        body.distort = random.choice([0.1, 0.2])
        body.refine = [random.choice([0., s]) for s in stack.size] + [random.choice(body.z)]
        body.material = random.choice(FINITE if stack.finite else SMALL)
        body.young, body.poisson = young * random.choice([1., 1., 2., 10.]), random.choice([0., 0.25, 0.3, 0.4])
        body.ratios = [random.uniform(0., 0.3) for _ in range(3)]
        body.moduli = [body.young * random.uniform(0.5, 2.) for _ in range(6)]
        body.axes = [random.uniform(-90., 90.) for _ in range(3)]
        body.free = [f for f in (1, 3) if random.random() < 0.4]
        body.exchanged, body.dual = random.random() < 0.5, random.random() < 0.5
        # where strains are finite pairs follow, and the sides would not face each other altogether
        slips = stack.law_of_interfaces in ("slide", "contact") and not stack.finite
        body.slip = [random.uniform(-0.01, 0.01) * length if slips else 0. for _ in range(2)]
        body.points = [[random.random() for _ in range(3)] for _ in range(2)]
        stack.bodies.append(body)
    return stack


def variants(stack, ranks):
    """What can be left out of a trial: solvers, and whatever makes the stack less simple."""
    result = [("solve", "direct", False), ("solve", "auto", True)]
    if ranks == 1:
        result += [("solve", "auto", False), ("solve", "saddle point", False)]
    result.append(("rotated",))
    for i, body in enumerate(stack.bodies):
        result += [(name, i) for name in ("material", "cells", "degree", "distort", "free", "refine", "dual", "poisson")]
        if body.tetrahedra:
            result.append(("tetrahedra", i))
        if body.mixed and not stack.finite and body.poisson > 0. and body.material != "orthotropic":
            result.append(("mixed", i))
    return result


def material(stack, body, has):
    """Its lines, and the law that gives the first Piola-Kirchhoff stress of a displacement gradient, in local axes."""
    name = body.material if has("material") else ("neo-Hookean" if stack.finite else "linear elastic")
    nu = body.poisson if has("poisson") else 0.25
    lines = ["set Law = " + ("linear elastic" if name == "logarithmic" else name)]
    if name == "orthotropic":
        E, G = body.moduli[:3], body.moduli[3:]
        lines += ["set Young moduli = %.16g, %.16g, %.16g" % tuple(E), "set Shear moduli = %.16g, %.16g, %.16g" % tuple(G),
                  "set Poisson ratios = %.16g, %.16g, %.16g" % tuple(body.ratios), "set Axes = %.16g, %.16g, %.16g" % tuple(body.axes)]
        return lines, ("orthotropic", E, G, body.ratios, axes(body.axes))
    lam, mu = body.young * nu / (1. + nu) / (1. - 2. * nu), body.young / 2. / (1. + nu)
    if name == "Mooney-Rivlin":
        lines += ["set C10 = %.16g" % (0.3 * mu), "set C01 = %.16g" % (0.2 * mu), "set Poisson ratio = %.16g" % nu]
    elif name == "Ogden":
        lines += ["set Ogden terms = %.16g, 1.5; %.16g, -2" % (0.8 * mu, -0.4 * mu), "set Poisson ratio = %.16g" % nu]
    else:
        lines += ["set Young modulus = %.16g" % body.young, "set Poisson ratio = %.16g" % nu]
    if name == "J2 plasticity":
        lines += ["set Yield stress = %.16g" % (10. * body.young), "set Strain = small"]
    if name == "logarithmic":
        lines.append("set Strain = finite")
    return lines, (name, lam, mu)


def solved(stack, parts):
    """For each body the lines of its material, H, the nominal stress, and the constant c of u = H x + c, in local axes."""
    result, c, below = [], [0., 0., 0.], None
    rotation = axes(stack.angles) if ("rotated",) in parts else axes([0., 0., 0.])
    for i, body in enumerate(stack.bodies):
        lines, law = material(stack, body, lambda name: (name, i) in parts)
        # the axes of a material are those of the scene
        stress = law_of(law, rotation)
        H = cross_column(stress, stack.H, stack.traction)
        if below is not None:
            # c such that the displacements at the interface differ by the jump
            z, jump = body.z[0], body.slip + [0.]
            if stack.law_of_interfaces == "spring":
                jump = [stack.traction[0] / stack.spring[1], stack.traction[1] / stack.spring[1], stack.traction[2] / stack.spring[0]]
            c = [c[d] + (below[d][2] - H[d][2]) * z + jump[d] for d in range(3)]
        below = H
        result.append((lines, H, stress(H), list(c)))
    return result, rotation


def scene(stack, parts, solution, method, exchanged):
    """The text, by the name of a point its exact displacement, and the force of interfaces if it is to be compared."""
    states, R = solution
    rotated = ("rotated",) in parts
    shift = stack.shift if rotated else [0., 0., 0.]
    names = ["b%d" % i for i in range(len(stack.bodies))]
    glue = ["i%d" % i for i in range(len(names) - 1)]
    text = ["set Bodies = " + ", ".join(names), "set Interfaces = " + ", ".join(glue)]
    exact, points, carried = {}, [], True

    def linear(row, constant):
        return "%.17g*(x-(%.17g)) + %.17g*(y-(%.17g)) + %.17g*(z-(%.17g)) + %.17g" % (row[0], shift[0], row[1], shift[1], row[2], shift[2], constant)
    for i, (body, (lines, H, P, c)) in enumerate(zip(stack.bodies, states)):
        has = lambda name: (name, i) in parts
        Hg, Pg = product(product(R, H), transposed(R)), product(product(R, P), transposed(R))
        cg = [sum(R[d][e] * c[e] for e in range(3)) for d in range(3)]
        cells, degree = (body.cells if has("cells") else [2, 2, 1]), (body.degree if has("degree") else 1)
        text += ["subsection Body " + names[i], "set Degree = %d" % max(degree, 2 if has("mixed") else 1)]
        if has("mixed"):
            text.append("set Formulation = mixed")
        text += ["subsection Mesh", "set Extent = 0, 0, %.17g, %.17g, %.17g, %.17g" % (body.z[0], *stack.size, body.z[1]),
                 "set Subdivisions = %d, %d, %d" % tuple(cells)]
        if has("tetrahedra"):
            text.append("set Cells = tetrahedra")
        elif has("refine"):
            text.append("set Refine near = %s, 0.05, 1" % ", ".join(
                "%.17g" % (sum(R[d][e] * body.refine[e] for e in range(3)) + shift[d]) for d in range(3)))
        if has("distort"):
            text.append("set Distort = %g" % body.distort)
        if rotated:
            text += ["set Rotate = %g, %g, %g" % tuple(stack.angles), "set Translate = %.17g, %.17g, %.17g" % tuple(shift)]
        text += ["end", "subsection Material"] + lines + ["end"]
        u = ", ".join(linear(Hg[d], cg[d]) for d in range(3))
        for f in range(6):
            d, sign = f // 2, (1. if f % 2 else -1.)
            if (f == 4 and i > 0) or (f == 5 and i + 1 < len(names)):
                continue
            text.append("subsection Boundary " + FACES[f])
            if f == 5 or (f in body.free and has("free")):
                n = [sign * R[e][d] for e in range(3)]
                text.append("set Traction = " + "; ".join("%.17g" % sum(Pg[a][b] * n[b] for b in range(3)) for a in range(3)))
            else:
                text.append("set Displacement = " + u)
            text.append("end")
        text.append("end")
        # a slave all of whose nodes are on held sides has no multiplier
        carried = carried and min(cells[:2]) * max(degree, 2 if has("mixed") else 1) > 1
        for k, point in enumerate(body.points):
            local = [point[0] * stack.size[0], point[1] * stack.size[1], body.z[0] + point[2] * (body.z[1] - body.z[0])]
            u = [sum(H[d][e] * local[e] for e in range(3)) + c[d] for d in range(3)]
            exact["p%d_%d" % (i, k)] = [sum(R[d][e] * u[e] for e in range(3)) for d in range(3)]
            points.append("p%d_%d: b%d: " % (i, k, i) + ", ".join(
                "%.17g" % (sum(R[d][e] * local[e] for e in range(3)) + shift[d]) for d in range(3)))
    law = stack.law_of_interfaces
    for i, name in enumerate(glue):
        body = stack.bodies[i]
        sides = ["b%d: zmax" % i, "b%d: zmin" % (i + 1)]
        if body.exchanged != exchanged:
            sides.reverse()
        text += ["subsection Interface " + name, "set Slave = " + sides[0], "set Master = " + sides[1],
                 "set Law = " + ("contact" if law == "friction" else law), "set Multiplier = " + ("dual" if ("dual", i) in parts and body.dual else "standard")]
        if law == "friction":
            text.append("set Friction coefficient = 0.9")
        if law == "tresca":
            text.append("set Friction bound = %.17g" % (2. * abs(stack.traction[2])))
        if law == "spring":
            text += ["set Normal stiffness = %.17g" % stack.spring[0], "set Tangential stiffness = %.17g" % stack.spring[1]]
        text.append("end")
    text += ["subsection Solver", "set Method = " + method, "set Tolerance = 1e-12", "end", "subsection Output", "set Fields =",
             "set Points = " + "; ".join(points), "end"]
    force = [stack.size[0] * stack.size[1] * sum(R[d][e] * stack.traction[e] for e in range(3)) for d in range(3)]
    return "\n".join(text) + "\n", exact, force if carried else None


def difference(file, exact, force, tolerance):
    """What of the summary is not as it must be."""
    with open(file) as opened:
        step = json.load(opened)["steps"][-1]
    scale = max(abs(v) for u in exact.values() for v in u)
    points = step["quantities"]
    for name, u in exact.items():
        error = max(abs(a - b) for a, b in zip(points[name], u)) / scale
        if not error < tolerance:
            return "point %s: displacement %s, exact %s, relative error %.2g" % (name, points[name], u, error)
    if force is None:
        return None
    size = math.sqrt(sum(f * f for f in force))
    for interface in step["interfaces"]:
        # the sign depends on which side is slave
        error = min(max(abs(a - s * b) for a, b in zip(interface["force"], force)) for s in (1., -1.)) / size
        # Newton's method stops at a residual of 1e-7 of all forces, of which those of interfaces may be a small part
        if not error < (500. if tolerance > 1e-6 else 10.) * tolerance:
            return "interface %s: force %s, exact %s or its opposite, relative error %.2g" % (interface["name"], interface["force"], force, error)
    return None


def check(campaign, stack, parts, batch):
    states = solved(stack, parts)
    for part in parts:
        if part[0] != "solve":
            continue
        text, exact, force = scene(stack, parts, states, part[1], part[2])
        campaign.clean()
        file, output = campaign.write("scene.prm", text), campaign.path("results")
        result = campaign.once(["--output", output, file], batch, 30.)
        campaign.count(result)
        wrong = runner.what_is_wrong(result, output)
        if wrong:
            return wrong
        where = "%s solver%s, law %s: " % (part[1], ", sides exchanged" if part[2] else "", stack.law_of_interfaces)
        if result.code != 0:
            if result.code == 2 and part[1] == "saddle point":
                continue
            return "refused: " + where + "exit code %s: %s" % (result.code, result.err.strip()[:300])
        other = difference(os.path.join(output, "summary.json"), exact, force, 2e-6 if stack.finite else 1e-7)
        if other:
            return "number: " + where + other
    return None
