"""Structured meshes of the elements of Abaqus and CalculiX, for decks.py."""

# vertices of a cell in its lattice of halves, and which of them are at S1, S2, ...
CUBE = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
HEX_FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
WEDGE_FACES = [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]
TET_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
WEDGES = [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)]


def shapes(kind):
    """Cells of a cube, their edges and faces, and whether edges have nodes."""
    number = int("".join(c for c in kind[3:] if c.isdigit()))
    if number in (8, 20):
        return [tuple(range(8))], HEX_EDGES, HEX_FACES, number == 20
    if number in (6, 15):
        return WEDGES, WEDGE_EDGES, WEDGE_FACES, number == 15
    return TETS, TET_EDGES, TET_FACES, number == 10


class Mesh:
    """Nodes and elements of a deck, numbered from 1; sets by places."""

    def __init__(self):
        self.nodes, self.elements, self.faces = [], [], []

    def block(self, kind, cells, place, name="BODY"):
        """A lattice of cells[0] x cells[1] x cells[2] cubes, whose points (i, j, k) in [0, 1]^3 are at place(i, j, k)."""
        parts, edges, faces, middles = shapes(kind)
        known = {}

        def node(at):
            if at not in known:
                self.nodes.append(place(*(a / (2 * n) for a, n in zip(at, cells))))
                known[at] = len(self.nodes)
            return known[at]

        for k in range(cells[2]):
            for j in range(cells[1]):
                for i in range(cells[0]):
                    corners = [(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in CUBE]
                    for part in parts:
                        at = [corners[v] for v in part]
                        points = at + [tuple((at[a][d] + at[b][d]) // 2 for d in range(3)) for a, b in edges if middles]
                        self.elements.append((kind, name, [node(p) for p in points]))
                        self.faces.append([[node(at[v]) for v in face] for face in faces])
        return self

    def at(self, where):
        """Numbers of the nodes whose place satisfies where(x, y, z)."""
        return [n + 1 for n, x in enumerate(self.nodes) if where(*x)]

    def node(self, *x):
        """The number of the node nearest to x."""
        return min(range(len(self.nodes)), key=lambda n: sum((a - b) ** 2 for a, b in zip(self.nodes[n], x))) + 1

    def sides(self, where, name=None):
        """(element, side) of the faces all of whose vertices satisfy where(x, y, z)."""
        return [(e + 1, f + 1) for e, faces in enumerate(self.faces) if name in (None, self.elements[e][1])
                for f, face in enumerate(faces) if all(where(*self.nodes[v - 1]) for v in face)]

    def nodes_text(self):
        return "*NODE, NSET=NALL\n" + "".join("%d, %.15g, %.15g, %.15g\n" % (n + 1, *x) for n, x in enumerate(self.nodes))

    def elements_text(self):
        text, last = "", None
        for e, (kind, name, nodes) in enumerate(self.elements):
            if (kind, name) != last:
                text += "*ELEMENT, TYPE=%s, ELSET=%s\n" % (kind, name)
                last = kind, name
            words = [str(e + 1)] + [str(n) for n in nodes]
            text += "".join(", ".join(words[i:i + 12]) + (",\n" if i + 12 < len(words) else "\n") for i in range(0, len(words), 12))
        return text

    def text(self):
        return self.nodes_text() + self.elements_text()


def nset(name, nodes):
    return "*NSET, NSET=%s\n" % name + "".join(", ".join(map(str, nodes[i:i + 12])) + ",\n" for i in range(0, len(nodes), 12))


def surface(name, sides):
    return "*SURFACE, NAME=%s, TYPE=ELEMENT\n" % name + "".join("%d, S%d\n" % side for side in sides)


def box(x0, y0, z0, x1, y1, z1):
    return lambda i, j, k: (x0 + i * (x1 - x0), y0 + j * (y1 - y0), z0 + k * (z1 - z0))


def near(a, b):
    return abs(a - b) < 1e-9
