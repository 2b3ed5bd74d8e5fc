"""Pictures of fields by PyVista, without a screen: python3 -m mortise.pictures RESULTS DIRECTORY

writes pictures into DIRECTORY, and their captions and names, line by line, to the standard output. It is a program of its
own, since on some machines without a screen the process that draws is ended."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Dict, List

from .results import Results

most_interfaces = 6


def _surface(mesh: Any) -> Any:
    # curved cells by planes: more of them where cells are large
    return mesh.extract_surface(algorithm="dataset_surface", nonlinear_subdivision=3 if mesh.n_cells < 300 else 2)


def _edges(mesh: Any) -> Any:
    return _surface(mesh.separate_cells()).extract_feature_edges(
        feature_angle=40, boundary_edges=True, manifold_edges=False, non_manifold_edges=False)


def _draw(plotter: Any, file: Path, meshes: List[Any], scalars: str, title: str) -> None:
    import numpy

    plotter.clear()
    values = numpy.concatenate([numpy.ravel(mesh[scalars]) for mesh in meshes])
    values = values[numpy.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    if high - low < 1e-3 * max(abs(low), abs(high)):  # the same everywhere, but for rounding
        low, high = 0.5 * (low + high) - 0.01 * abs(high), 0.5 * (low + high) + 0.01 * abs(high)
    bar = {"title": title + "\n", "color": "black", "fmt": "%.3g", "vertical": True, "position_x": 0.86, "position_y": 0.15,
           "height": 0.7, "width": 0.06, "title_font_size": 24, "label_font_size": 22}
    for mesh in meshes:
        plotter.add_mesh(_surface(mesh), scalars=scalars, clim=(low, high), cmap="viridis", ambient=0.4, diffuse=0.65, nan_color="#d0d4d9",
                         scalar_bar_args=bar)
        edges = _edges(mesh)
        if edges.n_points:
            plotter.add_mesh(edges, color="#202830", line_width=1)
    plotter.view_vector((-1.5, -2.2, 1.1), viewup=(0, 0, 1))
    plotter.add_axes(color="black")
    plotter.camera.Dolly(1.15)
    plotter.camera.SetWindowCenter(0.1, 0.0)  # leaves the bar its place
    plotter.renderer.ResetCameraClippingRange()
    plotter.render()
    plotter.screenshot(str(file))


def _bodies(results: Results) -> Dict[str, Any]:
    names = [body["name"] for body in results.last["bodies"] if results.field_files(body["name"])]
    return {name: results.mesh(name) for name in names}


def _deform(meshes: List[Any]) -> str:
    """Move the points by the displacement, magnified so that it shows; returns what was done."""
    import numpy

    if not all("displacement" in mesh.point_data for mesh in meshes):
        return "undeformed"
    low = numpy.min([mesh.bounds[0::2] for mesh in meshes], axis=0)
    high = numpy.max([mesh.bounds[1::2] for mesh in meshes], axis=0)
    size = float(numpy.linalg.norm(high - low))
    largest = max(float(numpy.linalg.norm(mesh["displacement"], axis=1).max()) for mesh in meshes)
    factor = 1.0 if largest >= 0.05 * size or largest == 0 else float(f"{0.05 * size / largest:.1g}")
    for mesh in meshes:
        mesh["|u|"] = numpy.linalg.norm(mesh["displacement"], axis=1)
        mesh.points = mesh.points + factor * mesh["displacement"]
    return "deformed, displacements as they are" if factor == 1 else f"deformed, displacements times {factor:,.0f}"


def draw(results: Results, directory: Path) -> None:
    import numpy
    import pyvista

    plotter = pyvista.Plotter(off_screen=True, window_size=(1100, 800), border=False)  # takes seconds where a processor draws
    plotter.set_background("white")
    bodies = list(_bodies(results).values())
    number = 0

    def picture(meshes: List[Any], scalars: str, title: str, caption: str) -> None:
        nonlocal number
        number += 1
        file = directory / f"{number:02}.png"
        _draw(plotter, file, meshes, scalars, title)
        print(f"{file.name}\t{caption}", flush=True)

    if bodies:
        how = _deform(bodies)
        for scalars, title, what in (("|u|", "displacement", "Displacement"), ("von_mises", "von Mises", "Von Mises stress"),
                                     ("plastic_strain", "plastic strain", "Equivalent plastic strain")):
            if all(scalars in mesh.array_names for mesh in bodies):
                picture(bodies, scalars, title, f"{what} ({how})")
    for interface in results.last["interfaces"][:most_interfaces]:
        if not results.field_files(interface["name"]):
            continue
        mesh = results.mesh(interface["name"])
        if "pressure" in mesh.point_data:
            picture([mesh], "pressure", "pressure", f"Contact pressure of {interface['name']}")
        elif "traction" in mesh.point_data:
            mesh["|t|"] = numpy.linalg.norm(mesh["traction"], axis=1)
            picture([mesh], "|t|", "traction", f"Traction of {interface['name']}")


if __name__ == "__main__":
    draw(Results(sys.argv[1]), Path(sys.argv[2]))
