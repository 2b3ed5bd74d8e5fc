"""The page of inf_sup.py: its tables, and between them what is measured and what is seen."""
import math


def ordered(values):
    return list(dict.fromkeys(values))


def pivot(rows, corner, row_of, column_of, text_of):
    """A table with one line for each row_of and one column for each column_of; entries of several rows are joined by ' / '."""
    lines, columns = ordered(map(row_of, rows)), sorted(ordered(map(column_of, rows)))
    text = ["| " + " | ".join([corner] + columns) + " |", "|---" * (len(columns) + 1) + "|"]
    for line in lines:
        entries = []
        for column in columns:
            found = [text_of(r) for r in rows if row_of(r) == line and column_of(r) == column]
            entries.append(" / ".join(found))
        text.append("| " + " | ".join([line] + entries) + " |")
    return "\n".join(text) + "\n"


def digits(text, n=3):
    return f"{float(text):.{n}f}"


def degree(row):
    return "p = " + row["degree"]


def n_cells(row):
    return "n = " + row["subdivisions"].split(",")[0]


def pair(row):
    return row["subdivisions"].split(",")[0] + " on " + row["master_subdivisions"].split(",")[0]


def pick(rows, *tables):
    return [r for r in rows if r["table"] in tables]


def rim(row):
    slave, master = bool(row["clamped"]), bool(row["master_clamped"])
    return {(0, 0): "free", (1, 1): "both clamped", (1, 0): "slave clamped", (0, 1): "master clamped"}[slave, master]


def constants(row):
    return f"{digits(row['beta'])} ({digits(row['slave'])})"


def by_degree(rows, corner, row_of):
    return pivot(rows, corner, row_of, degree, constants)


def beta(row):
    return digits(row["beta"])


def pressure_tables(rows):
    def shape(row):
        return row["cells"] or "shell octant"

    def shaped(cells, table):
        return pivot([r for r in pick(rows, table) if r["cells"] == cells], cells, degree, n_cells, beta)

    yield "### Displacements prescribed on the whole boundary, n x n x n cubes\n"
    for cells in ("hexahedra", "tetrahedra"):
        yield shaped(cells, "closed")
    yield "### Displacements prescribed on one face of the cube\n"
    for cells in ("hexahedra", "tetrahedra"):
        yield shaped(cells, "held")
    names = {"distorted": "vertices moved by up to 0.2 edges, 2 x 2 x 2", "hanging": "hanging nodes at a corner, 2 x 2 x 2",
             "hp": "the same, degrees p to p + 2", "curved": "shell octant, three curved cells, outside held"}
    yield "### Other meshes; the first three with the whole boundary held\n"
    yield pivot(pick(rows, *names), "", lambda r: names[r["table"]] + ("" if r["table"] == "curved" else ", " + shape(r)),
                degree, beta)
    yield "### Pressures of the displacement's own degree, whole boundary held, n = 2\n"
    assert all(r["kernel"] == "1" for r in pick(rows, "closed", "distorted", "hanging", "hp"))
    yield ("beta, and in brackets how many pressures no displacement feels; one of them is the constant, which is the only one "
           "in all\ntables above:\n")
    yield pivot(pick(rows, "equal"), "", shape, degree, lambda r: f"{beta(r)} ({r['kernel']})")
    yield "### Deformed states, whole boundary held\n"
    yield STRETCHED
    states = {"stretch": "stretched {} times", "press": "pressed, stretched {} times both ways", "shear": "sheared by {}",
              "twist": "twisted by {} right angle"}
    yield pivot(pick(rows, "stretched"), "", lambda r: states[r["state"]].format(r["size"]),
                lambda r: f"{r['cells']}, p = {r['degree']}, n = {r['subdivisions'][0]}", beta)


def multiplier_tables(rows):
    blocks = pick(rows, "block")
    coarse = [r for r in blocks if r["subdivisions"].startswith("2,")]
    fine = [r for r in blocks if not r["subdivisions"].startswith("2,")]
    for name, chosen in (("slave as coarse as the master or coarser", coarse), ("slave finer", fine)):
        for state in ("free", "both clamped"):
            yield f"### Squares, {name}, rims {state}\n"
            yield by_degree([r for r in chosen if rim(r) == state], "n on m", pair)
    strips = pick(rows, "strip")
    for state in ("free", "both clamped"):
        yield f"### Strips, ends {state}\n"
        yield by_degree([r for r in strips if rim(r) == state], "n on m", pair)
    yield "### Rims clamped on one side only\n"
    yield by_degree([r for r in blocks if "clamped" in rim(r) and rim(r) != "both clamped"], "", lambda r: pair(r) + ", " + rim(r))
    yield "### Tetrahedra, and vertices moved by up to 0.2 edges; 3 on 2\n"
    yield by_degree(pick(rows, "shapes", "distorted tie"), "",
                    lambda r: (f"{r['cells']} on {r['master_cells']}" if r["cells"] else "distorted hexahedra") + ", " + rim(r))
    yield "### Dual multipliers, squares\n"
    for state in ("free", "both clamped"):
        yield by_degree([r for r in pick(rows, "dual") if rim(r) == state], f"n on m, {state}", pair)
    yield by_degree(pick(rows, "distorted dual"), "3 on 2", lambda r: "distorted hexahedra, " + rim(r))
    yield "### A norm from a still richer space: 3 on 2, p = 1 with cells halved twice, p = 4 with degree p + 4\n"
    yield by_degree(pick(rows, "norm"), "", rim)
    yield "### Multipliers that ignore clamped rims\n"
    yield by_degree(pick(rows, "unreduced"), "n on m", pair)


def falls(rows, key="beta"):
    """How the constant changes from degree 2 to the highest, as a power of the degree."""
    values = {int(r["degree"]): float(r[key]) for r in rows}
    high = max(values)
    power = math.log(values[high] / values[2]) / math.log(high / 2)
    return f"{values[2]:.3f} at p = 2 to {values[high]:.3f} at p = {high}, as p^{power:.2f}"


def of_mesh(rows, table, **wanted):
    return [r for r in pick(rows, table) if all(r[k] == v for k, v in wanted.items())]


def seen_pressures(rows):
    def fall(table, cells):
        return falls(of_mesh(rows, table, cells=cells, subdivisions="2,2,2"))

    return f"""**Seen.** The constants do not fall with h: from n = 4 on they are the same to a hundredth, and where the whole boundary is held
n = 2 is the worst. They fall slowly with p, for n = 2:

- whole boundary held: hexahedra from {fall("closed", "hexahedra")},
  tetrahedra from {fall("closed", "tetrahedra")};
- one face held: hexahedra from {fall("held", "hexahedra")},
  tetrahedra from {fall("held", "tetrahedra")}.

So they are bounded from below in h, and over the degrees that were measured, but not uniformly in p. Moved vertices cost a hundredth;
hanging nodes nothing; mixed degrees lie between the constants of their degrees. Pressures of the displacement's own degree have
dozens of modes that no displacement feels, on every mesh: those constants are zero to rounding.
"""


def seen_multipliers(rows):
    squares = dict(subdivisions="3,3,2", master_subdivisions="2,2,1")
    simplices = falls(of_mesh(rows, "shapes", clamped="", cells="tetrahedra", master_cells="hexahedra"), "slave")
    held = falls(of_mesh(rows, "block", clamped="sides", master_clamped="sides", **squares), "slave")
    tied = [r for r in pick(rows, "block", "strip", "shapes", "distorted tie")]
    worst = min(tied, key=lambda r: float(r["beta"]))
    loose = [r for r in pick(rows, "block", "strip") if rim(r) == "free"]

    def span(key):
        return f"{min(float(r[key]) for r in loose):.2f} to {max(float(r[key]) for r in loose):.2f}"

    return f"""**Seen.** On hexahedra with free rims the slave's constant is {span("slave")} whatever size, ratio and degree; that
of the pair is {span("beta")}, between the slave's over sqrt(2), where the master feels nothing of a multiplier, and what a
fine master adds.

Beside clamped rims, where the multipliers have one degree less, the constants do not fall with h or the ratio of sizes, but they do
with p: 3 on 2, the slave's constant goes from {held}. Ratios of 10 and 20 are no
worse than 1, either way round: a coarse slave gains by what the fine master feels, a fine slave stands by itself. Tetrahedra
as slaves have lower constants than hexahedra, which fall with p without rims, too (on hexahedra, free,
from {simplices}). The least of all the cases above, without those that ignore the
rims, is {float(worst["beta"]):.3f} (p = {worst["degree"]}, {pair(worst)}, {rim(worst)}{", " + worst["cells"] if worst["cells"] else ""}).

The rule of an integration cell is exact for total degree 2p + 2, not for all products of two Q_p functions. Where cells are
triangles of a square slave face (a master of tetrahedra) that weakens the highest
modes of D: squares on triangles, free, have constants of the slave that fall with p, while those on squares do not; with 14 points
per direction they are the same.

The norm is rich enough: a richer space changes the constants by a hundredth or two.

A zero in brackets says that no displacement of the slave's is left to feel some multiplier. That happens once with the
reduction: one linear cell between two clamped ends has no free displacement, and the constant that is left on it is
carried by the master. Without the reduction it happens on every mesh with clamped rims; then all depends on the master, and a coarser
one leaves multipliers that nobody feels.
"""


def page(rows):
    text = [HEAD]
    text += [PRESSURES] + list(pressure_tables(rows)) + [seen_pressures(rows)]
    text += [MULTIPLIERS] + list(multiplier_tables(rows)) + [seen_multipliers(rows)]
    return "\n".join(text)


HEAD = """# Inf-sup constants

Regenerate: `ninja -C build benchmark_inf_sup && tests/benchmarks/inf_sup.py build/benchmark_inf_sup` (writes `inf_sup.csv` and
this page, about half an hour on two cores). `tests/solvers/inf_sup` checks a few of these numbers.

All constants are square roots of eigenvalues of dense matrices on small meshes. Spaces, constraints, G, A, M and B are made by
the classes that scenes use; the H1 product of the multipliers' part is assembled for this purpose alone. Inner products are
inverted by a sparse factorisation, and no preconditioner takes part. The constants have no unit: lengths and moduli
cancel, but for the size of the boxes in the H1 product below, which is 1.
"""

PRESSURES = """## Pressures

For the displacements of degree p and the continuous pressures of degree p - 1 of a body in mixed form,

    beta^2 = min over q of  q.(G A^{-1} G^T) q / q.M q,    u.A v = int eps(u):eps(v) + 1/4 div u div v,   q.M q = int q^2,

where A, with the Dirichlet conditions, is the displacement's own block of the program's mixed form (nu = 1/2, mu = 1/2), so that
beta is at most sqrt(12/7) = 1.309, and at most sqrt(4/5) = 0.894 where the whole boundary is held. In that case the constant
pressure, which no displacement feels, is left out.
"""

STRETCHED = """A neo-Hookean cube without pressure, deformed without change of volume: A is the tangent of the program there, mu int (grad u :
grad v^T + Grad u : Grad v) + 1/4 div u div v, and G, div and grad are those of the deformed configuration. Constants fall as those of the
deformed box do, whose cells get long, not with h, and with p as before; no state has a second pressure that no displacement feels.
"""

MULTIPLIERS = """## Multipliers

A slave below a master, boxes of 1 x 1 x 1/2, tied in the plane between them; n on m: the slave has n x n faces there and the
master m x m, with half as many layers of cells. With B = [D, -M] as the program assembles it,

    beta^2 = min over m of  m.(B A^{-1} B^T) m / m.N m,    u.A v = int grad u : grad v + u.v  on both bodies,
    N = sum over both sides of  D_f A_f^{-1} D_f^T.

N is a computed dual norm: m.N m is the square of sup int m (v_1 - v_2) / |(v_1, v_2)|_1 over displacements v_1, v_2 of a space
that is much richer than either body's: the slave's box, halved cells, degree p + 2 (at most 8), on the master's side its mirror image,
each with the Dirichlet conditions of its side. It is equivalent to the H^{-1/2} norm with constants that depend on the boxes
only, and beta = 1 would mean that the two bodies feel a multiplier as well as all displacements do. Where the slave is much finer
the master feels nearly nothing of its short waves, so that 1/sqrt(2) = 0.707 is the most to be had. In brackets: the same with the
slave's displacements alone against the slave's half of N, which is what the theory bounds;
it depends on the master only through the points that D is integrated with.
A couples no components, so that one of the three is enough.

Strips for large ratios: the interface is 1 long and 1/10 wide (1/20 for ratios of 20), one cell across, bodies as high as wide; the
numbers n on m are those along it, and "clamped" means its two ends.
"""
