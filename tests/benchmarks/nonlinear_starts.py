"""Starts of adaptivity_starts.py whose bodies have nonlinear laws: displacements that are given on linear starts, with gradients up
to 0.6, and perfectly plastic spheres close to their collapse."""
import math

from adaptivity_starts import amount, one_box, shells, two_boxes, value_at

STEP = 1e-6  # of differences, relative to the size of the body


def largest_gradient(components, lower, upper):
    """Of a displacement, in Frobenius' norm, at points of a box."""
    size = max(u - l for l, u in zip(lower, upper))
    largest = 0.
    for n in range(9 ** 3):
        point = [l + (u - l) * (k + 0.47) / 9 for l, u, k in zip(lower, upper, (n % 9, n // 9 % 9, n // 81))]
        square = 0.
        for d in range(3):
            ahead, behind = ([x + way * STEP * size * (c == d) for c, x in enumerate(point)] for way in (1, -1))
            square += sum(((value_at(f, ahead) - value_at(f, behind)) / (2 * STEP * size)) ** 2 for f in components)
        largest = max(largest, math.sqrt(square))
    return largest


def law(lot, gradient, young, nu):
    """Settings of a material for strains of the size of the gradient."""
    name = lot.choice(["neo-Hookean", "Mooney-Rivlin", "Ogden", "St. Venant-Kirchhoff", "linear elastic", "J2 plasticity", "J2 plasticity"])
    result = [f"Law={name}", f"Poisson ratio={amount(min(nu, 0.4) if name == 'St. Venant-Kirchhoff' else nu)}"]
    if name == "Mooney-Rivlin":
        part = lot.choice([0., 0.2, 0.5, 0.9])
        return name, result + [f"C10={amount(young / 6 * (1 - part))}", f"C01={amount(young / 6 * part)}"]
    if name == "Ogden":
        a, b = lot.choice([1.3, 2., 3., 5., 8.]), lot.choice([1., 2., 4.])
        return name, result + [f"Ogden terms={amount(young / 3 * 1.6 / a)}, {a}; {amount(-young / 3 * 0.4 / b)}, {-b}"]
    result.append(f"Young modulus={amount(young)}")
    if name == "linear elastic":
        return name, result + ["Strain=finite"]
    if name == "J2 plasticity":
        strength = young * gradient * lot.choice([0.1, 0.3, 0.6, 0.9])
        result += [f"Strain={lot.choice(['small', 'finite'])}"]
        kind = lot.choice(["linear", "linear", "kinematic", "saturation", "table"])
        modulus = young * lot.choice([0., 0.01, 0.1, 0.5])
        result += {"linear": [f"Yield stress={amount(strength)}", f"Hardening modulus={amount(modulus)}"],
                   "kinematic": [f"Yield stress={amount(strength)}", f"Kinematic hardening modulus={amount(max(modulus, 0.01 * young))}"],
                   "saturation": [f"Yield stress={amount(strength)}", f"Saturation stress={amount(2 * strength)}", f"Saturation exponent={amount(1 / gradient)}"],
                   "table": [f"Hardening table=0, {amount(strength)}; {amount(0.2 * gradient)}, {amount(1.3 * strength)}; {amount(0.8 * gradient)}, {amount(1.5 * strength)}"]}[kind]
    return name, result


def deformed(lot):
    """A box, two that are tied, or shells, in a displacement that is given."""
    while True:
        name, (field, components), settings = lot.choice([one_box, one_box, two_boxes, shells])(lot)
        if components is not None:
            break
    outside = [2., 2., 2.] if name in ("shell octant", "cylinder sector") else [1., 1., 1.]
    gradient = lot.choice([1e-6, 1e-4, 1e-2, 0.05, 0.1, 0.3, 0.6])
    if field in ("point", "edge"):
        gradient = min(gradient, 0.01)
    scale = gradient / max(1e-9, largest_gradient(components, [0.] * 3, outside))
    young = 10. ** lot.uniform(-3., 6.)
    # bodies of two materials meet without traction, see two_boxes()
    alike = len({s.rsplit("=", 1)[1] for s in settings if "/Material/Young" in s}) == 1
    kinds = []
    for body in [s for s in settings if s.startswith("Bodies=")][0][7:].split(", "):
        start = f"Body {body}/Material/"
        nu = [float(s.rsplit("=", 1)[1]) for s in settings if s.startswith(start + "Poisson")][0]
        if not kinds or not alike:
            kind, material = law(lot, gradient, young * (10. ** lot.uniform(-3., 3.) if kinds else 1.), nu)
            kinds.append(kind)
        settings = [s for s in settings if not s.startswith(start)] + [start + m for m in material]
        if nu > 0.49:
            settings.append(f"Body {body}/Formulation=displacement")
    return f"{name}, {' and '.join(kinds)}, gradient {gradient:g}", (field, [f"{scale:.12g}*({c})" for c in components]), settings


def plastic_sphere(lot):
    """Hill's thick sphere, up to its collapse; the front is where its radius says."""
    b, young, nu = lot.choice([1.1, 1.3, 2., 3., 5.]), lot.choice([100., 1000., 1e5]), lot.choice([0., 0.3, 0.45])
    c = 1 + (b - 1) * lot.choice([lot.uniform(0.1, 0.9), lot.uniform(0.8, 0.99), 0.99])
    pressure = 2 * math.log(c) + 2 / 3 * (1 - (c / b) ** 3)
    cube = c ** 3 / young
    r2 = "(x^2+y^2+z^2)"
    k = (1 - 2 * nu) / young
    inside = f"({k:.17g}*({-pressure:.17g}+log({r2}))+{(1 - nu) * cube:.17g}/{r2}^1.5)"
    outside = f"({k * 2 / 3 * (c / b) ** 3:.17g}+{(1 + nu) * cube / 3:.17g}/{r2}^1.5)"
    components = [f"{x}*if({r2}<{c * c:.17g},{inside},{outside})" for x in "xyz"]
    settings = ["Mesh/Source=shell octant", f"Mesh/Extent=1, {b}", f"Mesh/Subdivisions={lot.choice([1, 1, 2, 3])}, {lot.choice([1, 1, 2, 3])}",
                f"Mesh/Cells={lot.choice(['hexahedra', 'hexahedra', 'hexahedra', 'tetrahedra'])}", f"Degree={lot.choice([1, 2, 2, 3, 4])}", "Body force=0, 0, 0",
                "Material/Law=J2 plasticity", "Material/Yield stress=1", f"Material/Young modulus={young}", f"Material/Poisson ratio={nu}",
                f"Boundary inside/Pressure={pressure:.17g}", "Boundary xmin/Displacement=0, -, -", "Boundary ymin/Displacement=-, 0, -", "Boundary zmin/Displacement=-, -, 0"]
    return f"plastic sphere, outside {b}", (f"front {(c - 1) / (b - 1):.3f}", components), ["Bodies=b"] + [f"Body b/{s}" for s in settings]


GENERATORS = (deformed, deformed, deformed, plastic_sphere, plastic_sphere)
