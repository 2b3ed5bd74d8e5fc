"""Input decks of public kinds, as they run in CalculiX or Abaqus, and what has to come out.

DECKS maps names to functions that return a Deck. A check is (quantity, component, value, tolerance[, source]):
the displacement of a node or the force on a support as the scene calls it; without a source the value is exact, and
"CalculiX" is version 2.20 (tests/benchmarks/peers/calculix_import.py); the tolerance is relative."""
import math

from meshes import Mesh, box, near, nset, surface


class Deck:
    def __init__(self, text, checks, calculix=True, told=(), files=None, step=-1):
        self.text, self.checks, self.calculix, self.told, self.files, self.step = text, checks, calculix, told, files or {}, step


def material(name, *lines):
    return "*MATERIAL, NAME=%s\n" % name + "".join(line + "\n" for line in lines)


def section(elset, name, orientation=""):
    return "*SOLID SECTION, ELSET=%s, MATERIAL=%s%s\n" % (elset, name, ", ORIENTATION=" + orientation if orientation else "")


def step(*lines, options="", static="*STATIC"):
    return "*STEP%s\n%s\n" % (options, static) + "".join(line if line.endswith("\n") else line + "\n" for line in lines) + "*NODE PRINT, NSET=PROBE, GLOBAL=YES\nU\n*END STEP\n"


ELASTIC = ("*ELASTIC", "210000., 0.3")


def probe(*nodes):
    return nset("PROBE", list(nodes))


def symmetric(mesh, *axes):
    """Node sets X0, Y0, Z0 at x = 0, ..., held along their axis."""
    text, lines = "", ""
    for axis in axes:
        name = axis.upper() + "0"
        d = "xyz".index(axis)
        text += nset(name, mesh.at(lambda *x: near(x[d], 0.)))
        lines += "%s, %d, %d\n" % (name, d + 1, d + 1)
    return text + "*BOUNDARY\n" + lines


def cantilever(kind, cells, tolerance, reference, load="nodes"):
    """A beam of 10 x 1 x 1, clamped at x = 0, under a force of -100 along z at its end or a pressure of 10 on its top."""
    mesh = Mesh().block(kind, cells, box(0, 0, 0, 10, 1, 1))
    tip = mesh.node(10, .5, .5)
    text = mesh.text() + nset("FIX", mesh.at(lambda x, y, z: near(x, 0))) + probe(tip)
    if load == "nodes":
        end = mesh.at(lambda x, y, z: near(x, 10))
        text += nset("END", end)
        act = "*CLOAD\nEND, 3, %.12g" % (-100. / len(end))
    else:
        text += surface("TOP", mesh.sides(lambda x, y, z: near(z, 1)))
        act = "*DSLOAD\nTOP, P, 10."
    text += material("STEEL", *ELASTIC) + section("BODY", "STEEL")
    text += "*BOUNDARY\nFIX, 1, 3\n" + step(act)
    return Deck(text, [("node_%d" % tip, 2, reference, tolerance, "CalculiX")], told=("*CLOAD",) if load == "nodes" else ())


def plate_with_hole():
    """A quarter of a plate of 10 x 10 x 1 with a hole of radius 2, pulled by 100."""
    def place(i, j, k):
        angle = math.pi / 2 * (1 - i)
        edge = (10., 10. * math.tan(angle)) if i >= .5 else (10. / math.tan(angle), 10.)
        hole = (2. * math.cos(angle), 2. * math.sin(angle))
        return tuple(h + (e - h) * j ** 1.5 for h, e in zip(hole, edge)) + (k,)

    mesh = Mesh().block("C3D20R", (6, 4, 1), place)
    rim, far = mesh.node(0, 2, 0), mesh.node(10, 0, 0)
    text = mesh.text() + probe(rim, far) + surface("RIGHT", mesh.sides(lambda x, y, z: near(x, 10)))
    text += material("STEEL", *ELASTIC) + section("BODY", "STEEL") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nRIGHT, P, -100.")
    return Deck(text, [("node_%d" % far, 0, 0.005832869, 3e-3, "CalculiX"), ("node_%d" % rim, 1, -0.001214559, 1e-2, "CalculiX")])


def quarter_ring(inner, outer, length):
    def place(i, j, k):
        r, angle = inner + j * (outer - inner), math.pi / 2 * (1. - i)
        return (r * math.cos(angle), r * math.sin(angle), k * length)
    return place


def thick_cylinder():
    """A quarter of a cylinder of radii 1 and 2 in plane strain, under an inner pressure of 100."""
    E, nu, a, b, p = 210000., .3, 1., 2., 100.
    mesh = Mesh().block("C3D20", (6, 4, 1), quarter_ring(a, b, .5))
    inner, outer = mesh.node(a, 0, 0), mesh.node(b, 0, 0)
    text = mesh.text() + probe(inner, outer) + material("STEEL", *ELASTIC) + section("BODY", "STEEL")
    text += nset("ENDS", mesh.at(lambda x, y, z: near(z, 0) or near(z, .5))) + symmetric(mesh, "x", "y") + "ENDS, 3\n"
    text += step("*DLOAD\n" + "".join("%d, P%d, %g\n" % (e, s, p) for e, s in mesh.sides(lambda x, y, z: near(math.hypot(x, y), a))))

    def u(r):
        return (1 + nu) / E * p * a * a / (b * b - a * a) * ((1 - 2 * nu) * r + b * b / r)
    return Deck(text, [("node_%d" % inner, 0, u(a), 2e-3), ("node_%d" % outer, 0, u(b), 2e-3)])


def tied_blocks():
    """Two blocks of unlike meshes on each other, tied, under a tension of 100."""
    mesh = Mesh().block("C3D8", (2, 2, 2), box(0, 0, 0, 2, 2, 1), "LOWER").block("C3D8", (3, 3, 2), box(0, 0, 1, 2, 2, 2), "UPPER")
    top = mesh.node(2, 2, 2)
    text = mesh.text() + probe(top) + surface("UNDER", mesh.sides(lambda x, y, z: near(z, 1), "UPPER")) + surface("OVER", mesh.sides(lambda x, y, z: near(z, 1), "LOWER"))
    text += surface("TOP", mesh.sides(lambda x, y, z: near(z, 2))) + "*TIE, NAME=GLUE, POSITION TOLERANCE=0.1\nUNDER, OVER\n"
    text += material("STEEL", *ELASTIC) + section("LOWER", "STEEL") + section("UPPER", "STEEL") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nTOP, P, -100.")
    return Deck(text, [("node_%d" % top, 2, 2 * 100 / 210000., 1e-6), ("node_%d" % top, 0, -.3 * 2 * 100 / 210000., 1e-6)])


def bimetal():
    """Half a strip of two layers, which share nodes, is warmed by 100 and bends."""
    mesh = Mesh().block("C3D20R", (8, 1, 1), box(0, 0, 0, 20, 1, .5), "STEEL").block("C3D20R", (8, 1, 1), box(0, 0, .5, 20, 1, 1), "BRASS")
    # nodes at one place are one
    first, number = {}, []
    for x in mesh.nodes:
        number.append(first.setdefault(tuple(round(c, 9) for c in x), len(first) + 1))
    mesh.nodes = list(first)
    mesh.elements = [(kind, name, [number[n - 1] for n in nodes]) for kind, name, nodes in mesh.elements]
    tip = mesh.node(20, 0, .5)
    text = mesh.text() + probe(tip)
    text += material("STEEL", *ELASTIC, "*EXPANSION, ZERO=20.", "1.2e-5") + material("BRASS", "*ELASTIC", "100000., 0.35", "*EXPANSION, ZERO=20.", "1.9e-5")
    text += section("STEEL", "STEEL") + section("BRASS", "BRASS") + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n" + symmetric(mesh, "x", "y")
    text += nset("FOOT", mesh.at(lambda x, y, z: near(x, 0))) + "*BOUNDARY\nFOOT, 3\n"
    text += step("*TEMPERATURE\nNALL, 120.")
    return Deck(text, [("node_%d" % tip, 2, -0.2065714, 3e-2, "CalculiX")])


def hertz():
    """An eighth of a ball of radius 10 is pushed by 0.1 into a block."""
    R = 10.

    def ball(i, j, k):
        # a cube is pushed out to a ball, its corner at the lowest point finer
        p = [v * 1. for v in (i, j, 1 - k)]
        q = [v ** 1.3 for v in p]
        m, n = max(q), math.sqrt(sum(v * v for v in q))
        s = R * (m / n if n > 0 else 1.) if m > 0 else 0.
        return (s * q[0], s * q[1], R - s * q[2])

    mesh = Mesh().block("C3D8", (5, 5, 5), ball, "BALL").block("C3D8", (6, 6, 4), lambda i, j, k: (8 * i ** 1.5, 8 * j ** 1.5, -8 + 8 * (1 - (1 - k) ** 1.5)), "BASE")
    top = mesh.at(lambda x, y, z: near(z, R))
    text = mesh.text() + nset("TOP", top) + nset("FLOOR", mesh.at(lambda x, y, z: near(z, -8)))
    text += surface("SKIN", mesh.sides(lambda x, y, z: near(math.sqrt(x * x + y * y + (z - R) ** 2), R) and z < 6, "BALL")) + surface("PLANE", mesh.sides(lambda x, y, z: near(z, 0), "BASE"))
    text += material("RUBBER", "*ELASTIC", "1000., 0.3") + material("STEEL", *ELASTIC) + section("BALL", "RUBBER") + section("BASE", "STEEL")
    text += "*SURFACE INTERACTION, NAME=HARD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE\nSKIN, PLANE\n"
    text += symmetric(mesh, "x", "y") + "FLOOR, 1, 3\n" + probe(top[0])
    text += step("*BOUNDARY\nTOP, 3, 3, -0.4", "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY\nRF\n")
    return Deck(text, [("BASE-FLOOR", 2, 338.6998, 4e-2, "CalculiX")], told=("PRESSURE-OVERCLOSURE=LINEAR",))


def press_fit():
    """Two rings in plane strain, a quarter, whose meshes overlap by 0.01."""
    mesh = Mesh().block("C3D20R", (6, 2, 1), quarter_ring(1, 2.01, .4), "BUSH").block("C3D20R", (5, 2, 1), quarter_ring(2, 3, .4), "HUB")
    inner, outer = mesh.node(1, 0, 0), mesh.node(3, 0, 0)
    text = mesh.text() + probe(inner, outer) + surface("OUTSIDE", mesh.sides(lambda x, y, z: near(math.hypot(x, y), 2.01))) + surface("BORE", mesh.sides(lambda x, y, z: near(math.hypot(x, y), 2), "HUB"))
    text += material("SOFT", "*ELASTIC", "1000., 0.3") + material("HARD", "*ELASTIC", "500., 0.25") + section("BUSH", "SOFT") + section("HUB", "HARD")
    text += nset("ENDS", mesh.at(lambda x, y, z: near(z, 0) or near(z, .4))) + symmetric(mesh, "x", "y") + "ENDS, 3\n"
    text += "*SURFACE INTERACTION, NAME=FIT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e6\n*CONTACT PAIR, INTERACTION=FIT, TYPE=SURFACE TO SURFACE\nOUTSIDE, BORE\n"
    text += step()
    # p of DESIGN.md: linear elasticity on meshes that overlap truly
    p = 0.7516810022
    a, b, c = 1., 2.01, 3.
    inside = -p * 2 * (1 - .3 ** 2) * a * b * b / (1000 * (b * b - a * a))
    outside = p * 2 * (1 - .25 ** 2) * 4 * c / (500 * (c * c - 4))
    return Deck(text, [("node_%d" % inner, 0, inside, 2e-2), ("node_%d" % outer, 0, outside, 2e-2)], told=("PRESSURE-OVERCLOSURE=LINEAR",))


def block_under_gravity():
    """A column of height 4 under its weight, without contraction; the length of a direction does not count."""
    mesh = Mesh().block("C3D20", (1, 1, 3), box(0, 0, 0, 1, 1, 4))
    top = mesh.node(1, 1, 4)
    text = mesh.text() + probe(top) + nset("FOOT", mesh.at(lambda x, y, z: near(z, 0)))
    text += material("STONE", "*ELASTIC", "1000., 0.", "*DENSITY", "2.") + section("BODY", "STONE") + "*BOUNDARY\nFOOT, 1, 3\n"
    text += step("*DLOAD\nBODY, GRAV, 9.81, 0., 0., -2.", "*NODE PRINT, NSET=FOOT, TOTALS=ONLY\nRF\n")
    return Deck(text, [("node_%d" % top, 2, -2 * 9.81 * 16 / 2 / 1000, 1e-6), ("FOOT", 2, 2 * 9.81 * 4, 1e-6)])


def bar(kind="C3D8", cells=(3, 1, 1)):
    """A bar of 3 x 1 x 1 along x with symmetry at x = 0, y = 0, z = 0; its end and its probe."""
    mesh = Mesh().block(kind, cells, box(0, 0, 0, 3, 1, 1))
    end = mesh.node(3, 1, 1)
    return mesh, end, mesh.text() + probe(end) + surface("END", mesh.sides(lambda x, y, z: near(x, 3))) + nset("NEND", mesh.at(lambda x, y, z: near(x, 3)))


def plastic_bar():
    """A bar is pulled beyond its yield stress, with linear hardening."""
    mesh, end, text = bar()
    text += material("METAL", "*ELASTIC", "1000., 0.3", "*PLASTIC", "10., 0.", "12., 0.02", "13., 0.04") + section("BODY", "METAL") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nEND, P, -12.5", static="*STATIC\n0.25, 1., 1e-5, 0.25")
    strain, plastic = 12.5 / 1000 + .03, .03
    return Deck(text, [("node_%d" % end, 0, 3 * strain, 1e-5), ("node_%d" % end, 1, -.3 * .0125 - plastic / 2, 1e-5)])


def large_beam():
    """A slender beam of 20 x 1 x 1 is bent far by a force at its end."""
    mesh = Mesh().block("C3D20", (10, 1, 1), box(0, 0, 0, 20, 1, 1))
    tip = mesh.node(20, 0, .5)
    end = mesh.sides(lambda x, y, z: near(x, 20))
    face = [n for n in mesh.at(lambda x, y, z: near(x, 20))]
    corner = [n for n in face if all(near(c, round(c)) for c in mesh.nodes[n - 1])]
    text = mesh.text() + probe(tip) + nset("FIX", mesh.at(lambda x, y, z: near(x, 0))) + surface("END", end)
    text += material("SOFT", "*ELASTIC", "1.2e6, 0.") + section("BODY", "SOFT") + "*BOUNDARY\nFIX, 1, 3\n"
    # consistent forces of a serendipity face: -1/12 at corners, 1/3 at middles
    text += step("*CLOAD\n" + "".join("%d, 3, %.12g\n" % (n, 600. * (-1 / 12. if n in corner else 1 / 3.)) for n in face), options=", NLGEOM", static="*STATIC\n0.05, 1.")
    return Deck(text, [("node_%d" % tip, 0, -4.009947, 5e-3, "CalculiX"), ("node_%d" % tip, 2, 10.89204, 2e-3, "CalculiX")], told=("*CLOAD",))


def neo_hooke():
    """A block of rubber is shortened by a quarter, free at its sides."""
    mesh, end, text = bar("C3D20R", (2, 1, 1))
    text += material("RUBBER", "*HYPERELASTIC, NEO HOOKE", "0.5, 0.1") + section("BODY", "RUBBER") + symmetric(mesh, "x", "y", "z")
    text += step("*BOUNDARY\nNEND, 1, , -0.75", "*NODE PRINT, NSET=NEND, TOTALS=ONLY\nRF\n", options=", NLGEOM", static="*STATIC\n0.25, 1.")
    return Deck(text, [("NEND", 0, -1.013652, 3e-4, "CalculiX"), ("node_%d" % end, 1, 0.1472661, 1e-3, "CalculiX")], told=("*HYPERELASTIC",))


def blocks_in_contact(behaviour, *lines, friction=""):
    mesh = Mesh().block("C3D8", (2, 2, 2), box(0, 0, 0, 2, 2, 1), "LOWER").block("C3D8", (3, 3, 2), box(0, 0, 1, 2, 2, 2), "UPPER")
    top = mesh.node(2, 2, 2)
    text = mesh.text() + probe(top) + surface("UNDER", mesh.sides(lambda x, y, z: near(z, 1), "UPPER")) + surface("OVER", mesh.sides(lambda x, y, z: near(z, 1), "LOWER"))
    text += surface("TOP", mesh.sides(lambda x, y, z: near(z, 2))) + nset("NTOP", mesh.at(lambda x, y, z: near(z, 2))) + nset("FLOOR", mesh.at(lambda x, y, z: near(z, 0)))
    text += "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=%s\n%s" % (behaviour, "".join(line + "\n" for line in lines)) + friction
    text += "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nUNDER, OVER\n"
    return mesh, top, text + material("STEEL", "*ELASTIC", "1000., 0.") + section("LOWER", "STEEL") + section("UPPER", "STEEL")


def contact_of_blocks():
    """Two blocks are pressed on each other by 10; without contraction."""
    mesh, top, text = blocks_in_contact("HARD")
    text += symmetric(mesh, "x", "y", "z") + step("*DSLOAD\nTOP, P, 10.")
    return Deck(text, [("node_%d" % top, 2, -2 * 10 / 1000., 1e-5), ("LOWER-Z0", 2, 40., 1e-5)])


def linear_overclosure():
    """The same with a contact stiffness of 1e5: penetration by 1e-4 in CalculiX."""
    mesh, top, text = blocks_in_contact("LINEAR", "1e5")
    text += symmetric(mesh, "x", "y", "z") + step("*DSLOAD\nTOP, P, 10.")
    return Deck(text, [("node_%d" % top, 2, -2 * 10 / 1000., 1e-5)], told=("PRESSURE-OVERCLOSURE=LINEAR",))


def friction_block():
    """A block is pressed on another by 0.02 and then pushed until it slips: mu = 0.3."""
    mesh, top, text = blocks_in_contact("LINEAR", "1e6", friction="*FRICTION\n0.3, 1e6\n")
    text += nset("Y0", mesh.at(lambda x, y, z: near(y, 0))) + "*BOUNDARY\nFLOOR, 1, 3\nY0, 2, 2\n"
    text += step("*BOUNDARY\nNTOP, 3, 3, -0.02\nNTOP, 1, 1, 0.", static="*STATIC\n0.5, 1.") + step("*BOUNDARY\nNTOP, 1, 1, 0.05", "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY\nRF\n", static="*STATIC\n0.2, 1.")
    return Deck(text, [("LOWER-FLOOR", 0, -.3 * 40, 2e-2), ("LOWER-FLOOR", 2, 40., 1e-2)], told=("PRESSURE-OVERCLOSURE=LINEAR",))


def wedges():
    """A bar of second-order wedges under tension."""
    mesh, end, text = bar("C3D15", (3, 2, 1))
    text += material("STEEL", *ELASTIC) + section("BODY", "STEEL") + symmetric(mesh, "x", "y", "z") + step("*DSLOAD\nEND, P, -100.")
    return Deck(text, [("node_%d" % end, 0, 300 / 210000., 1e-6), ("node_%d" % end, 2, -30 / 210000., 1e-6)])


def orthotropic():
    """An orthotropic bar, whose axes are turned by 90 degrees about z, under tension along its second axis."""
    mesh, end, text = bar("C3D8", (2, 1, 1))
    text += material("WOOD", "*ELASTIC, TYPE=ENGINEERING CONSTANTS", "12000., 800., 500., 0.4, 0.35, 0.45, 700., 600.,", "60., 0.")
    text += "*ORIENTATION, NAME=TURNED, SYSTEM=RECTANGULAR\n0., 1., 0., -1., 0., 0.\n" + section("BODY", "WOOD", "TURNED") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nEND, P, -1.")
    # tension along 2: strains 1/E2, -nu12/E1 along 1 (y), -nu23/E2 along 3
    return Deck(text, [("node_%d" % end, 0, 3 / 800., 1e-6), ("node_%d" % end, 1, -.4 / 12000., 1e-6), ("node_%d" % end, 2, -.45 / 800., 1e-6)])


def prescribed_displacement():
    """All nodes at the surface of a cube of tetrahedra have the displacement A x, each in a line of its own."""
    mesh = Mesh().block("C3D10", (2, 2, 2), box(0, 0, 0, 1, 1, 1))
    A = [[1e-3, 2e-3, 0], [0, -1e-3, 5e-4], [3e-4, 0, 2e-3]]
    middle = mesh.node(.5, .5, .5)
    text = mesh.text() + probe(middle) + material("STEEL", *ELASTIC) + section("BODY", "STEEL") + "*BOUNDARY\n"
    outer = mesh.at(lambda *x: any(near(c, 0) or near(c, 1) for c in x))
    text += "".join("%d, %d, %d, 0.\n" % (n, d, d) for n in outer for d in (1, 2, 3))
    text += step("*BOUNDARY\n" + "".join("%d, %d, %d, %.12g\n" % (n, d + 1, d + 1, sum(a * x for a, x in zip(A[d], mesh.nodes[n - 1]))) for n in outer for d in range(3)))
    return Deck(text, [("node_%d" % middle, d, sum(A[d]) / 2, 1e-6) for d in range(3)])


def rotating_disc():
    """A quarter of a thin disc of radii 1 and 4 turns about z at 100 per second."""
    E, nu, rho, w2, a, b = 210000., .3, 7.8e-9, 1e8, 1., 4.
    mesh = Mesh().block("C3D20R", (6, 5, 1), quarter_ring(a, b, .1))
    inner, outer = mesh.node(a, 0, 0), mesh.node(b, 0, 0)
    text = mesh.text() + probe(inner, outer) + material("STEEL", *ELASTIC, "*DENSITY", "7.8e-9") + section("BODY", "STEEL") + symmetric(mesh, "x", "y", "z")
    text += step("*DLOAD\nBODY, CENTRIF, 1e8, 0., 0., 0., 0., 0., 1.")

    def u(r):  # plane stress
        return rho * w2 * (3 + nu) * (1 - nu) / 8 / E * r * (a * a + b * b - (1 + nu) / (3 + nu) * r * r + (1 + nu) / (1 - nu) * a * a * b * b / r / r)
    return Deck(text, [("node_%d" % inner, 0, u(a), 3e-3), ("node_%d" % outer, 0, u(b), 3e-3)])


def assembly():
    """Two instances of one part, of which one is turned, tied, in the format of Abaqus; in an assembly sets belong to instances."""
    mesh = Mesh().block("C3D8", (2, 2, 2), box(0, 0, 0, 1, 1, 1))
    top = surface("Top", mesh.sides(lambda x, y, z: near(z, 1))).replace("*SURFACE", "*Surface")
    part = "*Part, name=Block\n" + mesh.text() + "*Nset, nset=Foot\n" + ", ".join(map(str, mesh.at(lambda x, y, z: near(z, 0)))) + "\n"
    part += nset("Left", mesh.at(lambda x, y, z: near(x, 0))) + nset("Front", mesh.at(lambda x, y, z: near(y, 0))) + top + "** Section\n*Solid Section, elset=BODY, material=Steel\n,\n*End Part\n"
    corner = mesh.node(1, 1, 0)
    text = "*Heading\n" + part + "*Assembly, name=Assembly\n*Instance, name=Lower, part=Block\n*End Instance\n"
    # turned about the axis through (0.5, *, 1) along y by 180 degrees: on top of the other one
    text += "*Instance, name=Upper-1, part=Block\n0., 0., 0.\n0.5, 0., 1., 0.5, 1., 1., 180.\n*End Instance\n"
    text += "*Elset, elset=_Over_S1, internal, instance=Upper-1, generate\n1, 4, 1\n*Surface, type=ELEMENT, name=Over\n_Over_S1, S1\n"
    text += "*Nset, nset=Probe, instance=Upper-1\n%d,\n" % corner
    right = ", ".join(map(str, mesh.at(lambda x, y, z: near(x, 1))))
    text += "*Nset, nset=Sides, instance=Upper-1\n" + right + "\n*Nset, nset=Sides, instance=Lower\n" + ", ".join(map(str, mesh.at(lambda x, y, z: near(x, 0)))) + "\n"
    text += "*Tie, name=Glue, adjust=no\nLower.Top, Upper-1.Top\n*End Assembly\n*Material, name=Steel\n*Elastic\n210000., 0.3\n"
    text += "*Boundary\nLower.Foot, ZSYMM\nSides, 1, 1\nLower.Front, YSYMM\nUpper-1.Front, 2, 2\n"
    text += "*Step, name=Step-1, nlgeom=NO\n*Static\n1., 1., 1e-05, 1.\n*Dsload\nOver, P, -100.\n*Output, field\n*Node Output, nset=Probe\nU\n*End Step\n"
    return Deck(text, [("node_%d" % corner, 2, 200 / 210000., 1e-6), ("node_%d" % corner, 1, -30 / 210000., 1e-6)], calculix=False)


def steps_in_sequence():
    """A bar is pulled beyond its yield stress and let go, and pressed with an amplitude of its own."""
    mesh, end, text = bar()
    text += "*AMPLITUDE, NAME=HALF\n0., 0., 0.5, 0.5, 1., 1.\n" + material("METAL", "*ELASTIC", "1000., 0.3", "*PLASTIC", "10., 0.", "20., 0.1") + section("BODY", "METAL") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nEND, P, -12.", static="*STATIC\n0.25, 1., 1e-5, 0.25") + step("*DSLOAD\nEND, P, 0.") + step("*DSLOAD, AMPLITUDE=HALF\nEND, P, 5.")
    return Deck(text, [("node_%d" % end, 0, 3 * (.02 - .005), 1e-5)])


def included():
    """The bar of wedges with its mesh in a file of its own, and parts of the deck that have no counterpart."""
    deck = wedges()
    mesh, end, _ = bar("C3D15", (3, 2, 1))
    # lines of data and keywords
    text = deck.text.replace(mesh.text(), "*NODE, NSET=NALL\n*INCLUDE, INPUT=included_nodes.inc\n*INCLUDE, INPUT=included_elements.inc\n")
    n = len(mesh.nodes)
    text = text.replace("*STEP", "*NODE\n%d, 5., 0., 0.\n*EQUATION\n2\n%d, 1, 1., %d, 1, -1.\n*STEP" % (n + 1, end, n + 1))
    text = text.replace("*NODE PRINT", "*CLOAD\n%d, 2, 0.\n%d, 3, 1.\n*NODE PRINT" % (end, n + 1))
    deck = Deck(text, deck.checks, calculix=False, told=("*EQUATION", "*CLOAD"), files={"included_nodes.inc": mesh.nodes_text().split("\n", 1)[1], "included_elements.inc": mesh.elements_text()})
    return deck


def held_points():
    """Two blocks of 2 x 1 x 1 under a tension of 10: one held at three points, of which the second one is moved and turns it; one on two edges of its
    base, the nodes of the second one moved along it."""
    E, nu, e, turn = 1000., .25, .01, .002
    mesh = Mesh().block("C3D8", (3, 2, 2), box(0, 0, 0, 2, 1, 1), "POINTS").block("C3D20", (3, 2, 2), box(0, 3, 0, 2, 4, 1), "EDGES")
    one, two = mesh.node(2, 1, 1), mesh.node(2, 4, 1)
    left, right = ([n for n in mesh.at(lambda x, y, z: near(x, d) and near(z, 0) and y >= 3)] for d in (0, 2))
    text = mesh.text() + probe(one, two) + nset("L", left) + nset("R", right) + material("SOFT", "*ELASTIC", "%g, %g" % (E, nu))
    text += section("POINTS", "SOFT") + section("EDGES", "SOFT") + surface("ENDS", mesh.sides(lambda x, y, z: near(x, 0)) + mesh.sides(lambda x, y, z: near(x, 2)))
    text += "*BOUNDARY\n%d, 1, 3\n%d, 2, 2\n%d, 3, 3\nL, 1\nL, 3\nR, 3, 3\nR, 1, 1, %g\n" % (mesh.node(0, 0, 0), mesh.node(2, 0, 0), mesh.node(0, 1, 0), 2 * e)
    text += "%d, 3, 3, %g\n" % (mesh.node(2, 0, 0), -2 * turn)
    text += "".join("%d, 2, 2, %.12g\n" % (n, -nu * e * (mesh.nodes[n - 1][1] - 3)) for n in right)
    text += step("*DSLOAD\nENDS, P, -10.")
    checks = [("node_%d" % one, 0, 2 * e + turn, 1e-6), ("node_%d" % one, 1, -nu * e, 1e-6), ("node_%d" % one, 2, -nu * e - 2 * turn, 1e-6)]
    return Deck(text, checks + [("node_%d" % two, d, v, 1e-6) for d, v in enumerate((2 * e, -nu * e, -nu * e))])


def tilted(place):
    """The places of a mesh with its z axis along (1, 1, 1)."""
    axes = [(1 / math.sqrt(2), -1 / math.sqrt(2), 0.), (1 / math.sqrt(6), 1 / math.sqrt(6), -2 / math.sqrt(6)), [1 / math.sqrt(3)] * 3]
    return axes, lambda *ijk: tuple(sum(a[d] * x for a, x in zip(axes, place(*ijk))) for d in range(3))


def tilted_ring():
    """A quarter of a ring of radii 1 and 2 in plane strain, whose outer face moves inwards; all supports are along its own axes."""
    nu, a, b, inwards = .3, 1., 2., .01
    axes, place = tilted(quarter_ring(a, b, .5))
    plain = Mesh().block("C3D20", (6, 3, 1), quarter_ring(a, b, .5))
    mesh = Mesh().block("C3D20", (6, 3, 1), place)
    inner = plain.node(a, 0, 0)
    text = mesh.text() + probe(inner) + material("STEEL", *ELASTIC) + section("BODY", "STEEL") + "*TRANSFORM, NSET=NALL, TYPE=C\n0., 0., 0., 1., 1., 1.\n"
    text += nset("OUTER", plain.at(lambda x, y, z: near(math.hypot(x, y), b))) + nset("CUTS", plain.at(lambda x, y, z: near(x, 0) or near(y, 0)))
    text += nset("ENDS", plain.at(lambda x, y, z: near(z, 0) or near(z, .5))) + "*BOUNDARY\nCUTS, 2\nENDS, 3\n" + step("*BOUNDARY\nOUTER, 1, 1, %g" % -inwards)
    # u = A r + B / r without radial stress at a
    B = -inwards / (b * (1 - 2 * nu) / a ** 2 + 1 / b)
    u = B * ((1 - 2 * nu) / a + 1 / a)
    return Deck(text, [("node_%d" % inner, d, u * axes[0][d], 2e-3) for d in (0, 1)])


def tilted_bar():
    """A bar along (1, -1, 0) with supports and forces along its own axes."""
    axes, place = tilted(box(0, 0, 0, 3, 1, 1))
    plain, mesh = Mesh().block("C3D8", (3, 1, 1), box(0, 0, 0, 3, 1, 1)), Mesh().block("C3D8", (3, 1, 1), place)
    end = plain.node(3, 1, 1)
    text = mesh.text() + probe(end) + nset("END", plain.at(lambda x, y, z: near(x, 3))) + material("STEEL", *ELASTIC) + section("BODY", "STEEL")
    text += "*TRANSFORM, NSET=NALL\n" + ", ".join("%.15g" % x for x in [*axes[0], *axes[1]]) + "\n" + symmetric(plain, "x", "y", "z") + step("*CLOAD\nEND, 1, 25.")
    u = [sum(a[d] * x for a, x in zip(axes, (300 / 210000., -30 / 210000., -30 / 210000.))) for d in range(3)]
    return Deck(text, [("node_%d" % end, d, u[d], 1e-6) for d in range(3)], told=("*CLOAD",))


def couplings():
    """The ends of three bars of 2 x 1 x 4, clamped at z = 0: one is turned by 0.01 about a point away from it, the others pulled beside their centres."""
    E, P, arm = 1000., 10., .5
    mesh = Mesh().block("C3D20", (2, 2, 4), box(-1, -.5, 0, 1, .5, 4), "TURNED").block("C3D20", (2, 2, 4), box(4, -.5, 0, 6, .5, 4), "PULLED")
    mesh.block("C3D20", (2, 2, 4), box(9, -.5, 0, 11, .5, 4), "RIGID")
    one, two, three, n = mesh.node(1, 0, 4), mesh.node(6, 0, 4), mesh.node(11, 0, 4), len(mesh.nodes)
    text = mesh.text() + "*NODE\n%d, 0., 0., 2.\n%d, %g, 0., 5.\n%d, %g, 0., 5.\n" % (n + 1, n + 2, 5 + arm, n + 3, 10 + arm)
    text += probe(one, two, three) + nset("FIX", mesh.at(lambda x, y, z: near(z, 0))) + surface("PLATE", mesh.sides(lambda x, y, z: near(z, 4), "RIGID"))
    text += nset("HEAD", mesh.at(lambda x, y, z: near(z, 4) and x < 2)) + surface("FACE", mesh.sides(lambda x, y, z: near(z, 4), "PULLED"))
    text += surface("HEADFACE", mesh.sides(lambda x, y, z: near(z, 4), "TURNED"))
    text += material("SOFT", "*ELASTIC", "%g, 0." % E) + section("TURNED", "SOFT") + section("PULLED", "SOFT") + section("RIGID", "SOFT") + "*BOUNDARY\nFIX, 1, 3\n"
    text += "*COUPLING, REF NODE=%d, SURFACE=HEADFACE, CONSTRAINT NAME=C1\n*KINEMATIC\n1, 3\n*COUPLING, REF NODE=%d, SURFACE=FACE, CONSTRAINT NAME=C2\n*DISTRIBUTING\n1, 6\n" % (n + 1, n + 2)
    text += "*COUPLING, REF NODE=%d, SURFACE=PLATE, CONSTRAINT NAME=C3\n*KINEMATIC\n1, 3\n" % (n + 3)
    text += step("*BOUNDARY\n%d, 1, 6, 0.\n%d, 5, 5, 0.01\n*CLOAD\n%d, 3, %g\n%d, 3, %g" % (n + 1, n + 1, n + 2, P, n + 3, P))
    curvature = P * arm / (E * 8 / 12.)
    checks = [("node_%d" % one, 0, .02, 1e-6), ("node_%d" % one, 2, -.01, 1e-6)]
    for end in (two, three):
        checks += [("node_%d" % end, 0, -curvature * 8, 1e-6), ("node_%d" % end, 2, 4 * P / 2 / E + 4 * curvature, 1e-6)]
    return Deck(text, checks, told=("*DISTRIBUTING",))


def bolt():
    """A bar between two walls is tightened by 10 at a cut in its middle; then a wall moves while the bolt keeps its length."""
    mesh = Mesh().block("C3D8", (1, 1, 4), box(0, 0, 0, 1, 1, 4))
    lower, upper = mesh.node(0, 0, 1), mesh.node(0, 0, 3)
    text = mesh.text() + "*NODE\n1000, 0., 0., 0.\n" + probe(lower, upper) + nset("FOOT", mesh.at(lambda x, y, z: near(z, 0))) + nset("HEAD", mesh.at(lambda x, y, z: near(z, 4)))
    text += surface("CUT", mesh.sides(lambda x, y, z: near(z, 2))[:1]) + material("SOFT", "*ELASTIC", "1000., 0.") + section("BODY", "SOFT")
    text += "*PRE-TENSION SECTION, SURFACE=CUT, NODE=1000\n0., 0., -1.\n*BOUNDARY\nFOOT, 1, 3\nHEAD, 1, 3\n" + step("*CLOAD\n1000, 1, -10.") + step("*BOUNDARY, FIXED\n1000, 1, 1\n*BOUNDARY\nHEAD, 3, 3, 0.02")
    return Deck(text, [("node_%d" % lower, 2, .015, 1e-6), ("node_%d" % upper, 2, .005, 1e-6)])


def bedded_block():
    """A block without contraction is pressed by 2 on an elastic foundation, as Abaqus has it."""
    mesh = Mesh().block("C3D8", (2, 2, 2), box(0, 0, 0, 1, 1, 1))
    top = mesh.node(1, 1, 1)
    text = mesh.text() + probe(top) + surface("TOP", mesh.sides(lambda x, y, z: near(z, 1))) + material("SOFT", "*ELASTIC", "1000., 0.") + section("BODY", "SOFT") + symmetric(mesh, "x", "y")
    text += "*FOUNDATION\n" + "".join("%d, F%d, 100.\n" % side for side in mesh.sides(lambda x, y, z: near(z, 0))) + step("*DSLOAD\nTOP, P, 2.")
    return Deck(text, [("node_%d" % top, 2, -2 / 100. - 2 / 1000., 1e-6)], calculix=False)


def load_at_once():
    """A bar is pulled beyond its yield stress; in the second step the load is a smaller one at once."""
    mesh, end, text = bar()
    text += material("METAL", "*ELASTIC", "1000., 0.3", "*PLASTIC", "10., 0.", "20., 0.1") + section("BODY", "METAL") + symmetric(mesh, "x", "y", "z")
    text += step("*DSLOAD\nEND, P, -12.") + step("*DSLOAD\nEND, P, -5.", options=", AMPLITUDE=STEP")
    return Deck(text, [("node_%d" % end, 0, 3 * (.02 + .005), 1e-5)])


def small_on_large():
    """A small block, which is the slave and held across the normal, is pressed on a large one of a single element."""
    mesh = Mesh().block("C3D8", (1, 1, 1), box(0, 0, 0, 1, 1, 1), "LARGE").block("C3D8", (1, 1, 1), box(.4, .4, 1, .6, .6, 1.2), "SMALL")
    text = mesh.text() + probe(1) + nset("FIX", mesh.at(lambda x, y, z: near(z, 0))) + nset("GUIDE", mesh.at(lambda x, y, z: near(z, 1) and .3 < x < .7))
    text += surface("UNDER", mesh.sides(lambda x, y, z: near(z, 1), "SMALL")) + surface("OVER", mesh.sides(lambda x, y, z: near(z, 1), "LARGE")) + surface("TOP", mesh.sides(lambda x, y, z: near(z, 1.2)))
    text += material("STEEL", "*ELASTIC", "1000., 0.") + section("LARGE", "STEEL") + section("SMALL", "STEEL") + "*BOUNDARY\nFIX, 1, 3\nGUIDE, 1, 2\n"
    text += "*SURFACE INTERACTION, NAME=TOUCH\n*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nUNDER, OVER\n" + step("*DSLOAD\nTOP, P, 10.")
    return Deck(text, [("LARGE-FIX", 2, .4, 1e-6)], calculix=False, told=("the slave's faces",))


DECKS = {
    "cantilever_c3d8": lambda: cantilever("C3D8", (20, 2, 2), 1e-3, -1.66801),
    "cantilever_c3d8i": lambda: cantilever("C3D8I", (10, 2, 2), 2e-2, -1.874078),
    "cantilever_c3d20r": lambda: cantilever("C3D20R", (10, 2, 2), 4e-3, -0.711623, "pressure"),
    "cantilever_c3d10": lambda: cantilever("C3D10", (10, 2, 2), 1e-6, -0.7060729, "pressure"),
    "plate_with_hole": plate_with_hole,
    "thick_cylinder": thick_cylinder,
    "tied_blocks": tied_blocks,
    "bimetal": bimetal,
    "hertz": hertz,
    "press_fit": press_fit,
    "block_under_gravity": block_under_gravity,
    "plastic_bar": plastic_bar,
    "large_beam": large_beam,
    "neo_hooke": neo_hooke,
    "contact_of_blocks": contact_of_blocks,
    "linear_overclosure": linear_overclosure,
    "friction_block": friction_block,
    "wedges": wedges,
    "orthotropic": orthotropic,
    "prescribed_displacement": prescribed_displacement,
    "rotating_disc": rotating_disc,
    "assembly": assembly,
    "steps_in_sequence": steps_in_sequence,
    "included": included,
    "held_points": held_points,
    "tilted_ring": tilted_ring,
    "tilted_bar": tilted_bar,
    "couplings": couplings,
    "bolt": bolt,
    "bedded_block": bedded_block,
    "load_at_once": load_at_once,
    "small_on_large": small_on_large,
}
