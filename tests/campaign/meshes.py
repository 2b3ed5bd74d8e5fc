"""Mesh files of gmsh's formats, made here so that a draw is the same everywhere, and damaged at random."""
import struct

EDGES_OF_HEX = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
FACES_OF_HEX = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
EDGES_OF_TET = [(0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
TETS = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
NODES = {2: 3, 3: 4, 4: 4, 5: 8, 9: 6, 10: 9, 11: 10, 12: 27, 15: 1, 1: 2, 6: 6, 7: 5, 16: 8, 17: 20}


class Mesh:
    """nodes: [tag, x, y, z]; elements: [tag, type, dimension, entity, physical group, nodes]; names: (dimension, tag, name)."""

    def __init__(self, nodes, elements, names):
        self.nodes, self.elements, self.names = nodes, elements, names


def box(n, tetrahedra, second_order):
    """The unit cube in n cells, low its face z = 0 and high that at z = 1."""
    factor = 2 if second_order else 1
    size = [factor * m + 1 for m in n]
    place = {}
    nodes, elements = [], []

    def node(p):
        if p not in place:
            place[p] = len(nodes) + 1
            nodes.append([place[p]] + [p[d] / (size[d] - 1.) for d in range(3)])
        return place[p]

    def add(kind, dimension, entity, group, points):
        elements.append([len(elements) + 1, kind, dimension, entity, group, [node(p) for p in points]])

    def middle(points):
        return tuple(sum(p[d] for p in points) // len(points) for d in range(3))

    def with_middles(points, edges, faces=(), centre=False):
        result = list(points)
        if second_order:
            result += [middle([points[a] for a in e]) for e in edges] + [middle([points[a] for a in f]) for f in faces]
            if centre:
                result.append(middle(points))
        return result
    cells = [(i, j, k) for k in range(n[2]) for j in range(n[1]) for i in range(n[0])]
    for side, group in ((0, 1), (1, 2)):
        for i, j, k in cells:
            if k != (n[2] - 1 if side else 0):
                continue
            corners = [tuple(factor * (o + c) for o, c in zip((i, j, k), CORNERS[v])) for v in ((4, 5, 6, 7) if side else (0, 3, 2, 1))]
            if tetrahedra:
                # as the cells: cut along the diagonal 0-2 or 4-6
                for triangle in ((0, 1, 2), (0, 2, 3)):
                    add(9 if second_order else 2, 2, group, group,
                        with_middles([corners[v] for v in triangle], [(0, 1), (1, 2), (2, 0)]))
            else:
                add(10 if second_order else 3, 2, group, group,
                    with_middles(corners, [(0, 1), (1, 2), (2, 3), (3, 0)], centre=True))
    for i, j, k in cells:
        corners = [tuple(factor * (o + c) for o, c in zip((i, j, k), corner)) for corner in CORNERS]
        if tetrahedra:
            for tet in TETS:
                add(11 if second_order else 4, 3, 1, 3, with_middles([corners[v] for v in tet], EDGES_OF_TET))
        else:
            add(12 if second_order else 5, 3, 1, 3, with_middles(corners, EDGES_OF_HEX, FACES_OF_HEX, True))
    return Mesh(nodes, elements, [(2, 1, "low"), (2, 2, "high"), (3, 3, "cube")])


def written(mesh, version, binary):
    """The file as bytes."""
    parts = []

    def text(line):
        parts.append((line + "\n").encode("latin-1"))

    def integers(kind, *values):
        bits = 8 * struct.calcsize("<" + kind)
        parts.append(struct.pack("<%d%s" % (len(values), kind), *[((v + (1 << bits - 1)) % (1 << bits)) - (1 << bits - 1)
                                                               if kind == "i" else v % (1 << bits) for v in values]))

    def reals(*values):
        parts.append(struct.pack("<%dd" % len(values), *values))

    def put(values, kinds):
        """A line of text, or bytes."""
        if not binary:
            return text(" ".join("%.16g" % v if isinstance(v, float) else str(v) for v in values))
        for v, k in zip(values, kinds):
            reals(v) if k == "d" else integers(k, int(v))
    text("$MeshFormat")
    text("%s %d 8" % (version, binary))
    if binary:
        integers("i", 1)
        text("")
    text("$EndMeshFormat")
    text("$PhysicalNames")
    text(str(len(mesh.names)))
    for dimension, tag, name in mesh.names:
        text('%d %d "%s"' % (dimension, tag, name))
    text("$EndPhysicalNames")
    if version == "4.1":
        text("$Entities")
        entities = sorted({(e[2], e[3], e[4]) for e in mesh.elements if 0 <= e[2] <= 3})
        put([sum(e[0] == d for e in entities) for d in range(4)], "QQQQ")
        for dimension, entity, group in entities:
            n = 3 if dimension == 0 else 6
            values, kinds = [entity] + [0.] * n + [1, group], "i" + "d" * n + "Qi"
            if dimension > 0:
                values, kinds = values + [0], kinds + "Q"
            put(values, kinds)
        text("") if binary else None
        text("$EndEntities")
    text("$Nodes")
    if version == "4.1":
        tags = [n[0] for n in mesh.nodes] or [0]
        put([1, len(mesh.nodes), min(tags), max(tags)], "QQQQ")
        put([3, 1, 0, len(mesh.nodes)], "iiiQ")
        for n in mesh.nodes:
            put(n[:1], "Q")
        for n in mesh.nodes:
            put(n[1:], "ddd")
    else:
        text(str(len(mesh.nodes)))
        for n in mesh.nodes:
            put(n, "iddd")
    text("") if binary else None
    text("$EndNodes")
    text("$Elements")
    if version == "4.1":
        blocks = {}
        for e in mesh.elements:
            blocks.setdefault((e[2], e[3], e[1]), []).append(e)
        tags = [e[0] for e in mesh.elements] or [0]
        put([len(blocks), len(mesh.elements), min(tags), max(tags)], "QQQQ")
        for (dimension, entity, kind), block in blocks.items():
            put([dimension, entity, kind, len(block)], "iiiQ")
            for e in block:
                put([e[0]] + e[5], "Q" * (1 + len(e[5])))
    else:
        text(str(len(mesh.elements)))
        for e in mesh.elements:
            if binary:
                put([e[1], 1, 2, e[0], e[4], e[3]] + e[5], "i" * (6 + len(e[5])))
            else:
                put([e[0], e[1], 2, e[4], e[3]] + e[5], "")
    text("") if binary else None
    text("$EndElements")
    return b"".join(parts)


WILD = [0., -0., 1., -1., 0.5, 1e-300, 1e300, -1e308, float("nan"), float("inf"), 1e-12, 1e12, 0.1]
WILD_INTEGERS = [0, 1, 2, 3, -1, 7, 1000003, 2 ** 31 - 1, 2 ** 31, 2 ** 32 + 1, 2 ** 63, 2 ** 64 - 1]


def move_node(random, mesh):
    if mesh.nodes:
        node = random.choice(mesh.nodes)
        d = random.randrange(1, 4)
        node[d] = random.choice(WILD) if random.random() < 0.4 else node[d] + random.gauss(0., random.choice([1e-9, 0.05, 0.3, 3.]))


def scale(random, mesh):
    factor, d = random.choice([0., -1., 1e-9, 1e-6, 1e6, 1e9, 1e-160, 1e160]), random.randrange(4)
    for node in mesh.nodes:
        for e in range(1, 4):
            if d in (0, e):
                node[e] *= factor


def far_away(random, mesh):
    distance = random.choice([1e3, 1e6, 1e9, 1e15])
    for node in mesh.nodes:
        node[1] += distance


def merge_nodes(random, mesh):
    if len(mesh.nodes) > 1:
        a, b = random.sample(mesh.nodes, 2)
        a[1:] = b[1:]


def node_tag(random, mesh):
    if mesh.nodes:
        random.choice(mesh.nodes)[0] = random.choice(WILD_INTEGERS + [random.choice(mesh.nodes)[0]])


def renumber(random, mesh):
    """Tags with holes, in another order: allowed."""
    gap = random.choice([1, 7, 1000])
    new = {n[0]: gap * (i + 1) for i, n in enumerate(random.sample(mesh.nodes, len(mesh.nodes)))}
    for node in mesh.nodes:
        node[0] = new[node[0]]
    for e in mesh.elements:
        e[5] = [new.get(v, v) for v in e[5]]


def drop(random, mesh):
    values = random.choice([mesh.nodes, mesh.elements, mesh.elements, mesh.names])
    if values:
        i = random.randrange(len(values))
        del values[i:i + random.choice([1, 1, 2, len(values)])]


def twice(random, mesh):
    values = random.choice([mesh.nodes, mesh.elements, mesh.names])
    if values:
        new = random.choice(values)
        values.insert(random.randrange(len(values)), [x[:] if isinstance(x, list) else x for x in new] if isinstance(new, list) else new)
        if random.random() < 0.7 and values is mesh.elements:
            values[-1][0] = len(values) + 1000


def element_nodes(random, mesh):
    if mesh.elements and mesh.nodes:
        nodes = random.choice(mesh.elements)[5]
        how = random.randrange(5)
        if how == 0 and nodes:
            nodes[random.randrange(len(nodes))] = random.choice(mesh.nodes)[0]
        elif how == 1:
            random.shuffle(nodes)
        elif how == 2 and nodes:
            nodes[random.randrange(len(nodes))] = random.choice(WILD_INTEGERS)
        elif how == 3 and nodes:
            del nodes[random.randrange(len(nodes)):]
        elif len(nodes) > 1:
            a, b = random.sample(range(len(nodes)), 2)
            nodes[a] = nodes[b]


def mirror(random, mesh):
    """All cells turned inside out, or one."""
    chosen = mesh.elements if random.random() < 0.3 else [random.choice(mesh.elements)] if mesh.elements else []
    for e in chosen:
        e[5][:2] = e[5][1::-1]


def element_words(random, mesh):
    if mesh.elements:
        e = random.choice(mesh.elements)
        k = random.choice([0, 1, 1, 2, 3, 4, 4])
        e[k] = random.choice([0, 1, 2, 3, 4, 5, 9, 11, 15, 6, 7, 92, 99] + WILD_INTEGERS) if k != 1 else random.choice(list(NODES) + [0, -1, 93, 1000])
        if k == 1 and e[1] in NODES and random.random() < 0.7:
            e[5] = [random.choice(e[5] or [1]) for _ in range(NODES[e[1]])]


def groups(random, mesh):
    """Faces of other groups, cells of several groups."""
    for e in random.sample(mesh.elements, len(mesh.elements) // random.choice([1, 2, 3]) if mesh.elements else 0):
        e[4] = random.choice([0, 1, 2, 3, 4, -1])
        e[3] = random.choice([e[3], e[4]])


def name(random, mesh):
    if mesh.names:
        i = random.randrange(len(mesh.names))
        dimension, tag, old = mesh.names[i]
        mesh.names[i] = random.choice([(dimension, tag, random.choice(["", "low", "high", "a" * 5000, "\xff\0", "a\"b", "zmin", "a: b, c"])),
                                       (random.choice(WILD_INTEGERS), tag, old), (dimension, random.choice(WILD_INTEGERS), old)])


def inner_face(random, mesh):
    """A face that no cell has, or one within the body."""
    if mesh.nodes:
        kind = random.choice([2, 3, 9, 10])
        mesh.elements.append([len(mesh.elements) + 1, kind, 2, 1, 1, [random.choice(mesh.nodes)[0] for _ in range(NODES[kind])]])


def damaged(random, content):
    """Bytes or words of the finished file."""
    how = random.randrange(8)
    if not content:
        return content
    at = random.randrange(len(content))
    if how == 0:
        return content[:at]
    if how == 1:
        return content[:at] + bytes([content[at] ^ (1 << random.randrange(8))]) + content[at + 1:]
    if how == 2:
        return content[:at] + bytes(random.randrange(256) for _ in range(random.choice([1, 4, 8, 40]))) + content[at + random.choice([0, 4, 8]):]
    if how == 3:
        return content[:at] + content[random.randrange(len(content)):]
    if how == 4:
        return content.replace(b"\n", b"\r\n")
    if how == 5:
        return content[:at] + b"\0" * 100 + content[at + 100:]
    lines = content.split(b"\n")
    i = random.choice([k + random.choice([0, 1, 1, 2]) for k, line in enumerate(lines) if line.startswith(b"$")] or [0])
    i = min(i, len(lines) - 1)
    if how == 6:
        words = lines[i].split() or [b""]
        words[random.randrange(len(words))] = str(random.choice(WILD_INTEGERS)).encode()
        lines[i] = b" ".join(words)
    else:
        if random.random() < 0.5:
            del lines[i]
        else:
            lines.insert(i, random.choice(lines))
    return b"\n".join(lines)


STRUCTURAL = [move_node, move_node, scale, far_away, merge_nodes, node_tag, renumber, drop, twice, element_nodes, element_nodes,
              mirror, element_words, groups, name, inner_face]
SHAPES = [((n, tets, second), version, binary) for n in ((1, 1, 1), (2, 2, 1), (2, 3, 2)) for tets in (False, True)
          for second in (False, True) for version in ("2.2", "4.1") for binary in (False, True)]


def draw(random):
    """A shape and the operations on it."""
    shape = random.choice(SHAPES)
    operations = []
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        operations.append(("damage" if random.random() < 0.35 else random.choice(STRUCTURAL).__name__, random.getrandbits(32)))
    return shape, operations


def apply(random_of, shape, operations):
    (n, tets, second), version, binary = shape
    mesh = box(n, tets, second)
    for name_of, seed in operations:
        if name_of != "damage":
            globals()[name_of](random_of(seed), mesh)
    content = written(mesh, version, binary)
    for name_of, seed in operations:
        if name_of == "damage":
            content = damaged(random_of(seed), content)
    return content


def scene(random, file):
    """A scene of which the file is a body, alone or below a box."""
    alone = random.random() < 0.4
    degree = random.choice([1, 1, 2])
    lines = ["set Bodies = cube" + ("" if alone else ", top"), "set Interfaces = " + ("" if alone else "glue")]
    lines += ["subsection Body cube", "set Degree = %d" % degree, "subsection Mesh", "set Source = file", "set File = " + file]
    if random.random() < 0.2:
        lines.append("set Part = cube")
    if random.random() < 0.2:
        lines.append("set Curved boundaries = high: " + random.choice(["sphere", "cylinder", "sphere 0, 0, 0", "cylinder 0, 0, 0, 0, 0, 1, 1"]))
    if random.random() < 0.2:
        lines.append("set Refinements = 1")
    if random.random() < 0.2:
        lines.append("set Cells = tetrahedra")
    lines += ["end", "subsection Material", "set Young modulus = 1", "end", "subsection Boundary low", "set Displacement = 0, 0, 0", "end"]
    if alone:
        lines += ["subsection Boundary high", "set Pressure = 0.1", "end"]
    lines += ["end"]
    if not alone:
        law = random.choice(["tie", "tie", "contact", "slide"])
        lines += ["subsection Body top", "subsection Mesh", "set Extent = 0, 0, 1, 1, 1, 2", "set Subdivisions = 2, 1, 1", "end",
                  "subsection Material", "set Young modulus = 2", "end", "subsection Boundary zmax",
                  "set Displacement = 0, 0, -0.01", "end", "end", "subsection Interface glue", "set Law = " + law]
        lines += random.choice([["set Slave = cube: high", "set Master = top: zmin"], ["set Slave = top: zmin", "set Master = cube: high"]])
        lines += ["end"]
    return "\n".join(lines) + "\n"
