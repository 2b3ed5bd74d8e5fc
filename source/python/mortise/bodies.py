"""Parameters of a body (made by source/python/generate.py from mortise --parameters=json)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, Literal, Optional, Sequence

from .section import Section, parameter, subsection, subsections
from .values import Expression, Expressions


@dataclass
class Mesh(Section):
    """The parameters in `Body NAME/Mesh`."""

    source: Literal["box", "shell octant", "cylinder sector", "curved block", "file"] = parameter("Source", 'box', "selection")
    """Where the mesh comes from. Allowed: one of: box, shell octant, cylinder sector, curved block, file."""
    cells: Literal["auto", "hexahedra", "tetrahedra"] = parameter("Cells", 'auto', "selection")
    """Shape of the cells. auto: that of a file of hexahedra or tetrahedra, else tetrahedra into which pyramids, wedges and
    hexahedra of a file are cut; hexahedra from generators. tetrahedra: everything is cut. Allowed: one of: auto, hexahedra,
    tetrahedra."""
    extent: Sequence[float] = parameter("Extent", (), "list of reals", "length")
    """Size of a generated body [length]. box and curved block: x0, y0, z0, x1, y1, z1 (of the whole block); shell octant: r_in,
    r_out; cylinder sector: r_in, r_out, length. Allowed: 2, 3 or 6 numbers, as the generator needs."""
    subdivisions: Sequence[int] = parameter("Subdivisions", (), "list of integers")
    """Cells of a generated body. box: nx, ny, nz; shell octant: n, m (three patches of n x n, m radial); cylinder sector: around,
    radial, axial; curved block: nx, ny, nz, or nx, ny, nz_lower, nz_upper for both halves. Allowed: 2 to 4 integers of 1 or more,
    as the generator needs."""
    refinements: int = parameter("Refinements", 0, "integer")
    """How often all cells are cut into eight, after Subdivisions or File. Allowed: an integer of 0 or more."""
    refine_near: str = parameter("Refine near", '', "text", "length")
    """Local refinement after Refinements: cells that reach into a ball are cut the given number of times [length], after Rotate
    and Translate. Allowed: "x, y, z, radius, times; ..."."""
    file: str = parameter("File", '', "text")
    """For the source file: a mesh of gmsh (.msh, version 2.2 or 4.1, first or second order), one of Abaqus or CalculiX (.inp), of
    VTK (.vtu) or of another program that gmsh reads (.unv, .bdf, .nas, .vtk), or a geometry that gmsh meshes (.geo, .step,
    .brep). Looked for in the working directory, then beside the parameter file. Allowed: name of a file."""
    part: str = parameter("Part", '', "text")
    """The physical volume of the file that is this body. Empty: all. Allowed: name (or tag) of a physical volume."""
    mesh_size: float = parameter("Mesh size", 0.0, "real", "length")
    """Longest edge where gmsh meshes a geometry, and the value of mesh_size if a .geo file has DefineConstant[ mesh_size = ... ]
    [length]. 0: as the geometry specifies. Allowed: 0 or a positive number."""
    boundaries: str = parameter("Boundaries", '', "text", "length")
    """Names for boundaries of a file, chosen by place and shape, before Rotate and Translate; they take their faces from the
    boundaries that the file names. plane: faces in it; box: faces within it; cylinder, sphere, free: faces of a geometry, or of a
    mesh those that meet smoothly, of that shape; near: the nearest of them, with what goes on on the same surface; faces: by the
    numbers of mortise --boundaries FILE; named: boundaries of the file [length]. Allowed: "name: plane x = 1; name: plane through
    x, y, z normal nx, ny, nz; name: box x0, y0, z0, x1, y1, z1; name: cylinder [radius r] [near x, y, z]; name: sphere ...; name:
    free ...; name: faces 7, 9; name: named A, B; name: ... and ..."."""
    curved_boundaries: str = parameter("Curved boundaries", '', "text", "length")
    """True shapes of boundaries of a file of first order, which refined cells and cells of higher degree follow, before Rotate
    and Translate; centre, axis (a point on it and a direction) and radius are fitted to the vertices where they are left out
    [length]. Allowed: "boundary: sphere [x, y, z[, radius]]; boundary: cylinder [x, y, z, ax, ay, az[, radius]]; boundary: step
    FILE; ..."."""
    rotate: Sequence[float] = parameter("Rotate", (0.0, 0.0, 0.0), "list of reals", "degrees")
    """Rotates the body about the axes x, then y, then z [degrees]. Allowed: 3 numbers."""
    translate: Sequence[float] = parameter("Translate", (0.0, 0.0, 0.0), "list of reals", "length")
    """Moves the body, after Rotate [length]. Allowed: 3 numbers."""
    bottom_slope: Sequence[float] = parameter("Bottom slope", (0.0, 0.0), "list of reals", "-")
    """box: the face zmin lies in z = z0 + sx (x - x0) + sy (y - y0) [-]. Allowed: 2 numbers: sx, sy."""
    top_slope: Sequence[float] = parameter("Top slope", (0.0, 0.0), "list of reals", "-")
    """box: the face zmax lies in z = z1 + sx (x - x0) + sy (y - y0) [-]. Allowed: 2 numbers: sx, sy."""
    distort: float = parameter("Distort", 0.0, "real", "-")
    """box: largest shift of a vertex as a fraction of its cell's edges, the same on every run [-]. Allowed: a number from 0 to
    0.3."""
    half: Literal["lower", "upper", "both"] = parameter("Half", 'both', "selection")
    """curved block: which side of the curved surface. Allowed: one of: lower, upper, both."""
    surface: Literal["bump", "saddle", "wave"] = parameter("Surface", 'bump', "selection")
    """curved block: the surface in which the halves meet, z = z_middle + Amplitude f(s, t) with s, t in [-1, 1] across the block.
    bump: cos(pi s/2) cos(pi t/2); saddle: (s^2 - t^2 + s/2) / 1.5; wave: sin(pi s/2 + 1/2) cos(pi t/2). Allowed: one of: bump,
    saddle, wave."""
    amplitude: float = parameter("Amplitude", 0.0, "real", "length")
    """curved block: height of that surface [length]. Allowed: a number smaller in magnitude than the height of each half."""
    middle: float = parameter("Middle", 0.5, "real", "-")
    """curved block: z_middle as a fraction of the block's height [-]. Allowed: a number between 0 and 1."""


@dataclass
class Material(Section):
    """The parameters in `Body NAME/Material`."""

    law: Literal["linear elastic", "orthotropic", "neo-Hookean", "Mooney-Rivlin", "Ogden", "St. Venant-Kirchhoff", "J2 plasticity", "rigid"] = parameter("Law", 'linear elastic', "selection")
    """Material law; each takes its own of the constants below. rigid: none; the body moves as a rigid part, whose motion follows
    from the equilibrium as far as nothing prescribes it. Allowed: one of: linear elastic, orthotropic, neo-Hookean,
    Mooney-Rivlin, Ogden, St. Venant-Kirchhoff, J2 plasticity, rigid."""
    strain: Literal["auto", "small", "finite"] = parameter("Strain", 'auto', "selection")
    """Measure of strain. small: of the undeformed body, for which rotations are small, too. finite: linear elastic and J2
    plasticity then stand on the logarithmic strain. auto: finite for hyperelastic laws, else small. Allowed: one of: auto, small,
    finite."""
    young_modulus: Optional[float] = parameter("Young modulus", None, "real", "force per area")
    """Young's modulus at small strain of Law = linear elastic, neo-Hookean, St. Venant-Kirchhoff and J2 plasticity [force per
    area], which need one. Allowed: a positive number."""
    poisson_ratio: float = parameter("Poisson ratio", 0.3, "real", "-")
    """Poisson's ratio at small strain of all laws but orthotropic [-]. Allowed: a number above -1 and not above 0.5."""
    c10: float = parameter("C10", 0.0, "real", "force per area")
    """Constant of the first invariant of Law = Mooney-Rivlin [force per area]. Allowed: 0 or a positive number."""
    c01: float = parameter("C01", 0.0, "real", "force per area")
    """Constant of the second invariant of Law = Mooney-Rivlin [force per area]. Allowed: 0 or a positive number."""
    ogden_terms: str = parameter("Ogden terms", '', "text", "force per area; -")
    """Moduli and exponents of Law = Ogden, W = sum_p mu_p / alpha_p (sum_a l_a^alpha_p - 3) of isochoric stretches [force per
    area; -]. Allowed: "mu_1, alpha_1; mu_2, alpha_2; ..." with mu_p alpha_p > 0."""
    yield_stress: float = parameter("Yield stress", 0.0, "real", "force per area")
    """First yield stress of Law = J2 plasticity in tension [force per area]. Allowed: 0 or a positive number."""
    hardening_modulus: float = parameter("Hardening modulus", 0.0, "real", "force per area")
    """Linear isotropic hardening: stress per plastic strain [force per area]. Allowed: 0 or a positive number."""
    saturation_stress: float = parameter("Saturation stress", 0.0, "real", "force per area")
    """Yield stress that exponential hardening, added to the linear one, ends at [force per area]. 0: none. Allowed: 0 or a
    positive number."""
    saturation_exponent: float = parameter("Saturation exponent", 0.0, "real", "-")
    """How fast it does so: the rest falls as exp(-exponent times plastic strain) [-]. Allowed: 0 or a positive number."""
    kinematic_hardening_modulus: float = parameter("Kinematic hardening modulus", 0.0, "real", "force per area")
    """Linear kinematic hardening (Prager): back stress per plastic strain in tension [force per area]. Allowed: 0 or a positive
    number."""
    hardening_table: str = parameter("Hardening table", '', "text", "-, force per area")
    """Yield stress by equivalent plastic strain, linear between the points and constant beyond, in place of Yield stress,
    Hardening modulus and Saturation stress [-, force per area]. Allowed: "strain, stress; strain, stress; ...", strains ascending
    from 0, stresses not descending."""
    young_moduli: Sequence[float] = parameter("Young moduli", (0.0, 0.0, 0.0), "list of reals", "force per area")
    """E_x, E_y, E_z of Law = orthotropic, along the axes of the material [force per area]. Allowed: 3 positive numbers."""
    poisson_ratios: Sequence[float] = parameter("Poisson ratios", (0.0, 0.0, 0.0), "list of reals", "-")
    """nu_xy, nu_yz, nu_zx of Law = orthotropic [-]; nu_ij is the contraction along j per extension along i under tension along i,
    nu_ij / E_i = nu_ji / E_j. Allowed: 3 numbers with which the stiffness is positive definite."""
    shear_moduli: Sequence[float] = parameter("Shear moduli", (0.0, 0.0, 0.0), "list of reals", "force per area")
    """G_xy, G_yz, G_zx of Law = orthotropic [force per area]. Allowed: 3 positive numbers."""
    axes: Sequence[float] = parameter("Axes", (0.0, 0.0, 0.0), "list of reals", "degrees")
    """Rotates the axes of Law = orthotropic about those of the scene, x, then y, then z [degrees]. They do not follow the Rotate
    of the mesh. Allowed: 3 numbers."""
    density: float = parameter("Density", 0.0, "real", "mass per volume")
    """Mass density, on which Gravity acts [mass per volume]. 0: no weight. Allowed: 0 or a positive number."""
    thermal_expansion: float = parameter("Thermal expansion", 0.0, "real", "1 / temperature")
    """Strain per Temperature of the body, the same in all directions [1 / temperature]. Allowed: a number."""


@dataclass
class Boundary(Section):
    """The parameters in `Body NAME/Boundary NAME`."""

    pressure: Optional[Expression] = parameter("Pressure", None, "expression", "force per area")
    """Pressure, acting against the outward normal [force per area]. Empty: none. Allowed: an expression in x, y, z, t; or
    exact."""
    pressure_follows: Literal["auto", "true", "false"] = parameter("Pressure follows", 'auto', "selection")
    """Does Pressure act on the deformed face, along its normal and per its area? auto: in bodies with finite strains. Allowed:
    one of: auto, true, false."""
    traction: Expressions = parameter("Traction", (), "list of expressions", "force per area")
    """Force on the surface, added to Pressure [force per area]. Empty: none. Allowed: three expressions "tx; ty; tz"; or
    exact."""
    force: Expressions = parameter("Force", (), "list of expressions", "force")
    """Total force on the boundary, spread evenly over its area and added to the others [force]. Empty: none. Allowed: three
    expressions "Fx; Fy; Fz" in t."""
    reference_point: Sequence[float] = parameter("Reference point", (), "list of reals", "length")
    """Point on which Force acts and about which Rotation turns, in the boundary or away from it [length]. A Force there is spread
    over the boundary together with its moment. Empty: the centroid of the area. Allowed: 3 numbers."""
    coupling: Literal["distributing", "rigid"] = parameter("Coupling", 'distributing', "selection")
    """How the boundary is coupled to its Reference point. distributing: a Force there is spread over the boundary, which deforms.
    rigid: the boundary moves with the point as a rigid part; Displacement and Rotation are then those of the point, and - or
    nothing leaves them to the equilibrium with Force, Moment and the body. Allowed: one of: distributing, rigid."""
    moment: Expressions = parameter("Moment", (), "list of expressions", "force times length")
    """Total moment on the boundary about the centroid of its area [force times length], as a traction w x (x - centroid), which
    has no resultant. Empty: none. Allowed: three expressions "Mx; My; Mz" in t."""
    displacement: Expressions = parameter("Displacement", (), "list of expressions", "length")
    """Prescribed displacement [length]; - leaves a component free. normal: along the outward normal of the surface, free across
    it, as on rollers. Empty: all free. Allowed: three of: an expression, -, or exact, as in "-, -, 0"; exact for all three; or
    "normal: an expression"."""
    displacement_axes: Sequence[float] = parameter("Displacement axes", (0.0, 0.0, 0.0), "list of reals", "degrees")
    """Rotates the axes of Displacement about those of the scene, x, then y, then z [degrees]. Allowed: 3 numbers."""
    rotation: Expressions = parameter("Rotation", (), "list of expressions", "degrees")
    """Prescribed rotation of the boundary about the Reference point, a vector along the axis, added to the components that
    Displacement prescribes (all where that is empty) [degrees]. With finite strains it is a rotation by any angle, with small
    ones its linear part. Allowed: three expressions "rx; ry; rz" in t; with Coupling = rigid also - for what is free."""
    normal_stiffness: Optional[Expression] = parameter("Normal stiffness", None, "expression", "force per volume")
    """An elastic foundation: springs between the boundary and the ground, with this traction per displacement along the normal
    [force per volume]. Empty: none. Allowed: an expression in x, y, z, positive."""
    tangential_stiffness: Optional[Expression] = parameter("Tangential stiffness", None, "expression", "force per volume")
    """The same across the normal [force per volume], with a Normal stiffness. Empty: 0. Allowed: an expression in x, y, z,
    positive; or 0."""


@dataclass
class Body(Section):
    """The parameters in `Body NAME`."""

    degree: int = parameter("Degree", 1, "integer")
    """Polynomial degree of the displacement. Allowed: an integer from 1 to 8."""
    degree_by_region: str = parameter("Degree by region", '', "text")
    """Other degrees for cells with the given material ids of the mesh. Allowed: "material id: degree; ...", degrees from 1 to
    8."""
    degree_near: str = parameter("Degree near", '', "text")
    """Other degrees for cells with their centre or any vertex in a ball. The last ball that has a cell counts, and takes
    precedence over Degree by region. Allowed: entries "x, y, z, radius, degree" separated by ';', degrees from 1 to 8."""
    formulation: Literal["auto", "displacement", "mixed"] = parameter("Formulation", 'auto', "selection")
    """Unknowns: displacement alone, or (mixed) displacement and pressure, the latter one degree lower, which does not lock and
    allows nu = 0.5. auto: mixed from nu = 0.49 on. Allowed: one of: auto, displacement, mixed."""
    body_force: Expressions = parameter("Body force", 'auto', "list of expressions", "force per volume")
    """Force on the volume [force per volume]. auto: the force that balances the exact solution if that is given by expressions
    (it then includes Gravity), else zero. Allowed: three expressions "bx; by; bz" in x, y, z, t; exact; or auto."""
    displacement_at: Expressions = parameter("Displacement at", (), "list of expressions", "length")
    """Prescribed displacements at points, or along the straight edges between two points; - leaves a component free [length].
    Points are vertices of the mesh on the surface of the body. They hold rigid motions; a force on them, or on a line, has
    infinite stress, and the displacement there grows as the mesh becomes finer. Allowed: entries "x, y, z: ux, uy, uz" or "x, y,
    z, x2, y2, z2: ux, uy, uz" separated by ';', as in "0, 0, 0: 0, -, 0"."""
    temperature: Optional[Expression] = parameter("Temperature", None, "expression", "temperature")
    """Temperature above that of the state without strain [temperature], which acts by Thermal expansion. Empty: none. Allowed: an
    expression in x, y, z, t."""
    mesh: Mesh = subsection("Mesh", Mesh)
    """The section `Mesh`."""
    material: Material = subsection("Material", Material)
    """The section `Material`."""
    boundaries: Dict[str, Boundary] = subsections("Boundary", Boundary)
    """Sections `Boundary NAME` by NAME."""
