# Copyright: as Mortise, LGPL-2.1-or-later.
from spack.package import *


class Mortise(CMakePackage):
    """Mortar coupling and contact of elastic bodies with non-matching meshes in three dimensions."""

    maintainers = []
    license("LGPL-2.1-or-later")

    # There is no release to download yet: spack develop --path SOURCES mortise@0.1.0
    version("0.1.0")

    depends_on("cxx", type="build")
    depends_on("cmake@3.18:", type="build")
    depends_on("ninja", type="build")
    depends_on("dealii@9.4: +mpi+p4est+trilinos")
    depends_on("gmsh@4.8: +shared+opencascade")
    depends_on("metis@5")
    depends_on("mumps +mpi+double")
    depends_on("nlohmann-json@3:")
    depends_on("jemalloc")
    depends_on("blas")
    depends_on("lapack")
    depends_on("mpi")

    generator("ninja")

    def cmake_args(self):
        # Spack compiles for the processor that the spec names
        return [
            self.define("MORTISE_LEVELS", ""),
            self.define("CMAKE_BUILD_TYPE", "Release"),
        ]
