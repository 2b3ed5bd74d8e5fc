#!/usr/bin/env python3
"""Render the fields of a scene: pictures.py RESULT_DIRECTORY PICTURE.png

Every body is drawn deformed (displacements scaled so that they show), coloured by the magnitude of
the displacement, with the edges of its cells; bodies are pulled apart a little so that the tied
faces can be seen. Needs pyvista (PyPI)."""
import glob
import json
import os
import sys

import numpy
import pyvista


def main(directory, picture):
    names = [b["name"] for b in json.load(open(os.path.join(directory, "summary.json")))["steps"][-1]["bodies"]]
    meshes = [pyvista.read(os.path.join(directory, name + ".vtu")) for name in names]
    low = numpy.min([m.bounds[0::2] for m in meshes], axis=0)
    high = numpy.max([m.bounds[1::2] for m in meshes], axis=0)
    size = numpy.linalg.norm(high - low)
    largest = max(numpy.linalg.norm(m["displacement"], axis=1).max() for m in meshes)
    middle = numpy.mean([m.center for m in meshes], axis=0)

    plotter = pyvista.Plotter(off_screen=True, window_size=(1100, 850))
    plotter.set_background("white")
    for mesh in meshes:
        mesh["displacement magnitude"] = numpy.linalg.norm(mesh["displacement"], axis=1)
        apart = 0.5 * (numpy.array(mesh.center) - middle) if len(meshes) > 1 else numpy.zeros(3)
        mesh.points = mesh.points + 0.08 * size / largest * mesh["displacement"] + apart
        surface = mesh.extract_surface(algorithm="dataset_surface", nonlinear_subdivision=3)
        plotter.add_mesh(surface, scalars="displacement magnitude", clim=(0, largest), cmap="viridis",
                         ambient=0.45, diffuse=0.6, scalar_bar_args={"title": "|u|", "color": "black", "fmt": "%.3g", "vertical": True,
                                          "position_x": 0.91, "position_y": 0.2, "height": 0.6})
        edges = mesh.separate_cells().extract_surface(algorithm="dataset_surface", nonlinear_subdivision=3).extract_feature_edges(
            feature_angle=40, boundary_edges=True, manifold_edges=False, non_manifold_edges=False)
        if edges.n_points:
            plotter.add_mesh(edges, color="black", line_width=1)
    direction = numpy.array([-1.5, -2.2, 1.1])
    plotter.camera_position = [middle + direction * size * 0.7, middle, (0, 0, 1)]
    plotter.reset_camera()  # keeps the direction and fits all bodies, pulled apart, into the window
    plotter.screenshot(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
