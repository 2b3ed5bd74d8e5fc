"""Parameters of a scene (made by source/python/generate.py from mortise --parameters=json)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Literal, Optional, Sequence

from .bodies import Body
from .scene_file import SceneFile
from .section import Section, parameter, subsection, subsections
from .values import Expression, Expressions


@dataclass
class Interface(Section):
    """The parameters in `Interface NAME`."""

    slave: str = parameter("Slave", '', "text")
    """The side that carries the multiplier; best the finer mesh or the softer body. Allowed: "body: boundary", or "body:
    boundary, boundary, ..."."""
    master: str = parameter("Master", '', "text")
    """The other side. Allowed: "body: boundary", or "body: boundary, boundary, ..."."""
    law: Literal["tie", "slide", "contact", "tresca", "spring"] = parameter("Law", 'tie', "selection")
    """Law of the interface. tie: no jump of the displacement. slide: no jump along the normal, free tangential motion; smooth
    patches of the slave between edges are interfaces of their own. contact: gap >= 0 and pressure >= 0, with friction if a
    coefficient is given; partners are those within Search distance at the start, or as Sliding says. tresca: the same with a
    given bound of the tangential traction. spring: a thin layer or glue with the stiffnesses below. Allowed: one of: tie, slide,
    contact, tresca, spring."""
    friction_coefficient: Optional[Expression] = parameter("Friction coefficient", None, "expression", "-")
    """Law = contact: Coulomb's coefficient [-], the tangential traction divided by the pressure where bodies slip. Empty: no
    friction. Allowed: an expression in x, y, z, t, not negative."""
    static_friction_coefficient: Optional[Expression] = parameter("Static friction coefficient", None, "expression", "-")
    """The coefficient [-] where bodies did not slip at the end of the last step; once they slip it is the Friction coefficient.
    Empty: the same. Allowed: an expression in x, y, z, t, at least the Friction coefficient."""
    friction_bound: Optional[Expression] = parameter("Friction bound", None, "expression", "force per area")
    """Law = tresca: the tangential traction at which bodies slip [force per area]. Allowed: an expression in x, y, z, t, not
    negative."""
    normal_stiffness: Optional[Expression] = parameter("Normal stiffness", None, "expression", "force per volume")
    """Law = spring: normal traction divided by opening [force per volume]. For a layer of thickness d it is the modulus divided
    by d. Allowed: an expression in x, y, z, positive."""
    tangential_stiffness: Optional[Expression] = parameter("Tangential stiffness", None, "expression", "force per volume")
    """The same in tangential directions [force per volume]; 0: free tangential motion. Allowed: an expression in x, y, z,
    positive; or 0."""
    offset: Expression = parameter("Offset", 0.0, "expression", "length")
    """Gap between the bodies in addition to that between their meshes, which only contact takes into account; negative: an
    interference, as of a press fit whose meshes coincide [length]. Allowed: an expression in x, y, z, t."""
    preload: Optional[Expression] = parameter("Preload", None, "expression", "force")
    """Law = tie: the normal force that the interface carries [force], positive in tension, as in a cut through the shank of a
    tightened bolt, negative in compression, as under the head of that bolt. The shortening, by which the sides approach each
    other in addition to Offset, is an unknown. Empty: none. Allowed: an expression in t."""
    preload_until: Optional[float] = parameter("Preload until", None, "real", "time")
    """Time from which on the shortening is kept and the force follows [time]. Empty: the force is given at all times. Allowed: a
    number."""
    mesh_gap: Literal["real", "ignored"] = parameter("Mesh gap", 'real', "selection")
    """Law = contact: meaning of gaps and overlaps of the meshes. real: a gap or an interference; ignored: the surfaces coincide,
    as facets of different size on one circle do. Offset is added. Allowed: one of: real, ignored."""
    sliding: Literal["auto", "small", "finite"] = parameter("Sliding", 'auto', "selection")
    """Which pairs of faces and normals Law = contact, tresca and slide have. small: those of the undeformed bodies; finite: those
    of the deformed bodies, found again in each iteration of Newton's method, so that bodies may slide and turn far. Search
    distance then holds for the motion of a step, and slide closes the gaps of the meshes. auto: finite where a body has a law of
    finite strain. Allowed: one of: auto, small, finite."""
    multiplier: Literal["standard", "dual"] = parameter("Multiplier", 'dual', "selection")
    """Space of the Lagrange multiplier (the traction): standard, the traces of the slave's displacements, or dual, functions
    biorthogonal to those of the slave's nodes, which are eliminated at no cost. Triangles have dual ones at degree 1 only, else
    standard ones. Allowed: one of: standard, dual."""
    periodic: Literal["none", "translation", "rotation"] = parameter("Periodic", 'none', "selection")
    """Law = tie: the master is moved to the slave before they are paired, as opposite faces of a cell that repeats itself are.
    translation: by Translation, and the displacement of the slave is that of the master and the Mean strain of the Periodic cell
    times Translation. rotation: by Rotation about Reference point, and the displacement of the slave is that of the master turned
    by it (cyclic symmetry). Allowed: one of: none, translation, rotation."""
    translation: Sequence[float] = parameter("Translation", (), "list of reals", "length")
    """Periodic = translation: the vector from the master to the slave [length]. Allowed: 3 numbers."""
    rotation: Sequence[float] = parameter("Rotation", (), "list of reals", "degrees")
    """Periodic = rotation: the rotation from the master to the slave, a vector along the axis [degrees]. Allowed: 3 numbers."""
    reference_point: Sequence[float] = parameter("Reference point", (), "list of reals", "length")
    """Periodic = rotation: a point of the axis [length]. Empty: the origin. Allowed: 3 numbers."""
    search_distance: str = parameter("Search distance", '0.5', "text", "-")
    """Largest distance of the two faces of a pair, as a fraction of the size of the larger face [-], or a length. Partners face
    the slave and are not hidden by a body. With Adaptivity the distance for contact is at least the relative motion of the sides
    in the last cycle. Allowed: a positive number, or "length NUMBER"."""
    quadrature_points: str = parameter("Quadrature points", 'auto', "text")
    """Quadrature points per direction on an integration cell. auto: by the degrees and the geometry. Allowed: auto, or an integer
    from 1 to 100."""


@dataclass
class PeriodicCell(Section):
    """The parameters in `Periodic cell`."""

    mean_strain: Expressions = parameter("Mean strain", '0; 0; 0; 0; 0; 0', "list of expressions", "-")
    """Components xx; yy; zz; yz; zx; xy of the mean strain of the cell that interfaces with Periodic = translation repeat [-];
    shears are those of the tensor, half of the angle. free: an unknown, to which Mean stress belongs. With finite strains it is
    the mean gradient of the displacement. Allowed: six expressions in t, or free, with ';' between them."""
    mean_stress: Expressions = parameter("Mean stress", '0; 0; 0; 0; 0; 0', "list of expressions", "force per area")
    """Components of the mean stress where Mean strain is free [force per area], per volume of the cell between three
    translations, or, with fewer, of the bodies. Allowed: six expressions in t with ';' between them."""


@dataclass
class ExactSolution(Section):
    """The parameters in `Exact solution`."""

    displacement: Expressions = parameter("Displacement", (), "list of expressions", "length")
    """Exact displacement [length]: relative errors are computed when it is given. Allowed: three expressions "ux; uy; uz" in x,
    y, z, t; thick sphere; or thick cylinder (which take pressure, radii and materials from the scene)."""
    pressure: Optional[Expression] = parameter("Pressure", None, "expression", "force per area")
    """Exact mean pressure, minus a third of the trace of the stress [force per area], for expressions in a scene with nu = 0.5,
    where it does not follow from the displacement. Allowed: an expression in x, y, z, t."""


@dataclass
class Solver(Section):
    """The parameters in `Solver`."""

    method: Literal["auto", "saddle point", "condensed", "direct"] = parameter("Method", 'auto', "selection")
    """Linear solver. auto: condensed, or saddle point if a body is in mixed form; up to 100,000 displacements direct, where
    moduli differ by more than a million, or springs are softer than bodies by more than a thousand million. Allowed: one of:
    auto, saddle point, condensed, direct."""
    tolerance: float = parameter("Tolerance", 1e-10, "real", "-")
    """Residual relative to the right hand side at which the solver stops [-]. Allowed: a number between 0 and 1, both
    excluded."""
    max_iterations: int = parameter("Max iterations", 1000, "integer")
    """Largest number of iterations; without convergence the run ends with exit code 3. Allowed: an integer of 1 or more."""
    multipliers_on_all_ranks: int = parameter("Multipliers on all ranks", 30000, "integer")
    """Largest number of multipliers for which all ranks factorise the Schur complement together; beyond it each rank factorises
    the part of its own multipliers and their neighbours. Allowed: an integer of 0 or more."""
    friction: Literal["newton", "fixed point"] = parameter("Friction", 'newton', "selection")
    """How the bound of Coulomb's law follows the pressure. newton: within a linear system, which is not symmetric; fixed point:
    from one symmetric linear system to the next. Allowed: one of: newton, fixed point."""
    print_iterations: bool = parameter("Print iterations", False, "boolean")
    """Print a line for each iteration. Allowed: true or false."""


@dataclass
class Adaptivity(Section):
    """The parameters in `Adaptivity`."""

    target_error: Optional[float] = parameter("Target error", None, "real", "-")
    """Estimated relative error at which the run ends [-], of the displacements in the energy norm, or of Quantity. Empty: no
    adaptivity. Allowed: a number between 0 and 1, both excluded."""
    quantity: str = parameter("Quantity", '', "text")
    """The quantity of interest of Target error: a component of an entry of Output/Points or Output/Resultants. Cells that
    contribute to its error are refined. Empty: the energy norm. Allowed: "NAME, x", "NAME, y" or "NAME, z"."""
    strategy: Literal["h", "p", "hp"] = parameter("Strategy", 'hp', "selection")
    """Refinement of cells with large errors from cycle to cycle, starting with the given mesh and degrees. p: the degree rises by
    one; h: hexahedra are cut into eight; hp: one of both, by the decay of Legendre coefficients. The degree of tetrahedra rises;
    with h and hp gmsh meshes those of a geometry (.geo, .step, .brep) again, up to three times, with small cells where solutions
    are not smooth. Allowed: one of: h, p, hp."""
    largest_number_of_unknowns: float = parameter("Largest number of unknowns", 2000000.0, "real")
    """If the next cycle needs more, the run ends with exit code 3 and the last result is written. Allowed: a positive number."""
    largest_degree: int = parameter("Largest degree", 8, "integer")
    """If the next cycle needs a higher degree, the run ends with exit code 3 and the last result is written. Allowed: an integer
    from 1 to 8."""


@dataclass
class Steps(Section):
    """The parameters in `Steps`."""

    end_time: Optional[float] = parameter("End time", None, "real", "time")
    """End of the last step [time]; the first begins at 0. Empty: the last of Step, or 1. Allowed: a positive number."""
    step: Sequence[float] = parameter("Step", (), "list of reals", "time")
    """Length of all steps, or the times at which they end [time]. Empty: one step. Allowed: a positive number, or ascending ones
    separated by commas."""
    control: Literal["load", "arc length"] = parameter("Control", 'load', "selection")
    """load: t is given. arc length: t is an unknown, and each step has the length Step along the path of equilibria, so that
    loads may pass a maximum and fall; with the first tangent of the run t would grow by Step. The run ends where t reaches End
    time. For nonlinear laws, without contact. Allowed: one of: load, arc length."""
    number_of_steps: Optional[int] = parameter("Number of steps", None, "integer")
    """Control = arc length: the run ends after so many steps; parts of one that failed count as one. Empty: 100. Allowed: an
    integer of 1 or more."""
    output_every: int = parameter("Output every", 1, "integer")
    """Fields are written at every n-th of these times, and at the end. Allowed: an integer of 1 or more."""
    largest_step: Optional[float] = parameter("Largest step", None, "real", "time")
    """Longest step in a nonlinear scene [time]; steps between the times of Step are cut evenly. Empty: no limit. Allowed: a
    positive number."""
    smallest_step: float = parameter("Smallest step", 0.001, "real", "-")
    """Steps that fail in a nonlinear scene are halved, down to this fraction of the planned step [-]; after those that converge
    easily the next ones are longer again. Allowed: a positive number."""


@dataclass
class Output(Section):
    """The parameters in `Output`."""

    directory: str = parameter("Directory", '', "text")
    """Directory of summary.json and the files of fields, made when the first is written. Empty: results/NAME for a parameter file
    NAME.prm. Allowed: name of a directory."""
    fields: Sequence[Literal["displacement", "stress", "pressure", "plastic_strain", "deformation_gradient", "traction", "degree", "estimate"]] = parameter("Fields", (), "list of selections")
    """Fields to write for ParaView (.vtu), a file for each body and, with traction (and gap), for each interface; degree, and
    with Adaptivity estimate (energy norm of the error beside that of the solution, or its part in the Quantity), are numbers for
    each cell. Empty: no files of fields. Allowed: a list of: displacement, stress, pressure, plastic_strain,
    deformation_gradient, traction, degree, estimate."""
    checkpoint_every: int = parameter("Checkpoint every", 0, "integer")
    """Number of steps, or cycles of Adaptivity, after which the state is written to DIRECTORY/checkpoint.bin, from which
    --restart DIRECTORY continues. 0: none. Allowed: an integer of 0 or more."""
    points: str = parameter("Points", '', "text", "length")
    """Displacements to report in the summary, at points of bodies [length]. Allowed: "name: body: x, y, z; ..."."""
    resultants: str = parameter("Resultants", '', "text")
    """Forces and moments on boundaries of bodies to report in the summary: loads, reactions of supports, forces of interfaces.
    Allowed: "name: body: boundary; ..."."""
    moments_about: Sequence[float] = parameter("Moments about", (0.0, 0.0, 0.0), "list of reals", "length")
    """Reference point of the moments of Resultants and interfaces [length]. Allowed: 3 numbers."""


@dataclass
class Scene(SceneFile):
    """A scene: what a parameter file contains."""

    title: str = parameter("Title", '', "text")
    """Title of the scene. Allowed: any text."""
    gravity: Expressions = parameter("Gravity", (), "list of expressions", "length per time squared")
    """Acceleration of all bodies with a Density [length per time squared], added to Body force. Empty: none. Allowed: three
    expressions "gx; gy; gz" in x, y, z, t."""
    bodies: Dict[str, Body] = subsections("Body", Body)
    """Sections `Body NAME` by NAME."""
    interfaces: Dict[str, Interface] = subsections("Interface", Interface)
    """Sections `Interface NAME` by NAME."""
    periodic_cell: PeriodicCell = subsection("Periodic cell", PeriodicCell)
    """The section `Periodic cell`."""
    exact_solution: ExactSolution = subsection("Exact solution", ExactSolution)
    """The section `Exact solution`."""
    solver: Solver = subsection("Solver", Solver)
    """The section `Solver`."""
    adaptivity: Adaptivity = subsection("Adaptivity", Adaptivity)
    """The section `Adaptivity`."""
    steps: Steps = subsection("Steps", Steps)
    """The section `Steps`."""
    output: Output = subsection("Output", Output)
    """The section `Output`."""
