#!/usr/bin/env python3
"""Render the fields of a scene: pictures.py RESULT_DIRECTORY PICTURE.png

Every body is drawn deformed (displacements scaled so that they show, unless they are as large as the bodies), coloured by the magnitude of
the displacement, or in a run with a target error by the degree of its cells, with the edges of cells; bodies are pulled apart a little so that the tied
faces can be seen. Needs pyvista (PyPI)."""
import glob
import json
import os
import sys
import xml.etree.ElementTree

import numpy
import pyvista


def moments(directory, name):
    """The files of a body that are drawn, with a caption: of a run of several steps those at half of the time and at
    its end."""
    collection = os.path.join(directory, name + ".pvd")
    if not os.path.exists(collection):
        return [(os.path.join(directory, name + ".vtu"), "")]
    entries = [(float(e.get("timestep")), e.get("file")) for e in xml.etree.ElementTree.parse(collection).iter("DataSet")]
    half = min(entries, key=lambda entry: abs(entry[0] - 0.5 * entries[-1][0]))
    return [(os.path.join(directory, file), f"t = {time:g}") for time, file in (half, entries[-1])]


def draw(plotter, meshes, size, largest, degrees, magnified):
    scalars, limits, title = ("degree", degrees, "degree") if degrees else ("displacement magnitude", (0, largest), "|u|")
    middle = numpy.mean([m.center for m in meshes], axis=0)
    for mesh in meshes:
        mesh["displacement magnitude"] = numpy.linalg.norm(mesh["displacement"], axis=1)
        apart = 0.5 * (numpy.array(mesh.center) - middle) if len(meshes) > 1 else numpy.zeros(3)
        mesh.points = mesh.points + (0.08 * size / largest if magnified else 1.0) * mesh["displacement"] + apart * magnified
        surface = mesh.extract_surface(algorithm="dataset_surface", nonlinear_subdivision=3)
        plotter.add_mesh(surface, scalars=scalars, clim=limits, cmap="viridis",
                         ambient=0.45, diffuse=0.6, scalar_bar_args={"title": title, "color": "black", "fmt": "%.3g", "vertical": True,
                                          "position_x": 0.91, "position_y": 0.2, "height": 0.6})
        edges = mesh.separate_cells().extract_surface(algorithm="dataset_surface", nonlinear_subdivision=3).extract_feature_edges(
            feature_angle=40, boundary_edges=True, manifold_edges=False, non_manifold_edges=False)
        if edges.n_points:
            plotter.add_mesh(edges, color="black", line_width=1)
    direction = numpy.array([-1.5, -2.2, 1.1])
    plotter.camera_position = [middle + direction * size * 0.7, middle, (0, 0, 1)]
    plotter.reset_camera()  # keeps the direction and fits all bodies, pulled apart, into the window


def main(directory, picture):
    last = json.load(open(os.path.join(directory, "summary.json")))["steps"][-1]
    names = [b["name"] for b in last["bodies"]]
    degrees = (min(b["degree_min"] for b in last["bodies"]), max(b["degree_max"] for b in last["bodies"])) if "adaptivity" in last else None
    files = [moments(directory, name) for name in names]
    scenes = [[pyvista.read(file) for file, _ in at_time] for at_time in zip(*files)]
    low = numpy.min([m.bounds[0::2] for m in scenes[0]], axis=0)
    high = numpy.max([m.bounds[1::2] for m in scenes[0]], axis=0)
    size = numpy.linalg.norm(high - low)
    largest = max(numpy.linalg.norm(m["displacement"], axis=1).max() for meshes in scenes for m in meshes)

    plotter = pyvista.Plotter(off_screen=True, window_size=(1100 * len(scenes), 850), shape=(1, len(scenes)), border=False)
    plotter.set_background("white")
    for column, meshes in enumerate(scenes):
        plotter.subplot(0, column)
        draw(plotter, meshes, size, largest, degrees, largest < 0.2 * size)
        if files[0][column][1]:
            plotter.add_text(files[0][column][1], color="black", font_size=14)
    plotter.screenshot(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
