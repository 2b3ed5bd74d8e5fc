// Files for the tests of meshes, written by gmsh itself in any format.
#pragma once

#include <deal.II/base/mpi.h>

#include <gmsh.h>
#include <mortise/base/error.h>
#include <mortise/body/mesh/mesh_file.h>
#include <temporary_file.h>
#include <verdict.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gmsh_test
{
  /// Rank 0 writes @p content; returns the name of the file.
  inline std::string
  write_file(const std::string &name, const std::string &content)
  {
    const std::string file = temporary_file(name);
    MPI_Barrier(MPI_COMM_WORLD); // the file may have been in use
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(file, std::ios::binary) << content;
    MPI_Barrier(MPI_COMM_WORLD);
    return file;
  }

  inline std::string
  read_file(const std::string &name)
  {
    std::ifstream in(name, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(in)),
                       std::istreambuf_iterator<char>());
  }

  /// @p nodes "x y z" and @p elements (without their numbers) as a file.
  inline std::string
  mesh_text(const std::vector<std::string> &nodes,
            const std::vector<std::string> &elements)
  {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << nodes.size() << "\n";
    for (unsigned int i = 0; i < nodes.size(); ++i)
      text << i + 1 << " " << nodes[i] << "\n";
    text << "$EndNodes\n$Elements\n" << elements.size() << "\n";
    for (unsigned int i = 0; i < elements.size(); ++i)
      text << i + 1 << " " << elements[i] << "\n";
    return text.str() + "$EndElements\n";
  }

  struct Format
  {
    double version     = 4.1;
    bool   binary      = false;
    int    order       = 1;
    bool   serendipity = false;
    bool   save_all    = false;
  };

  /// Rank 0 meshes the text @p geometry and saves it.
  inline std::string
  write_mesh(const std::string &name,
             const std::string &geometry,
             const Format      &format)
  {
    const std::string geo = write_file(name + ".geo", geometry);
    const std::string msh = temporary_file(name + ".msh");
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::open(geo);
        gmsh::option::setNumber("Mesh.ElementOrder", format.order);
        gmsh::option::setNumber("Mesh.SecondOrderIncomplete",
                                format.serendipity);
        gmsh::option::setNumber("Mesh.MshFileVersion", format.version);
        gmsh::option::setNumber("Mesh.Binary", format.binary);
        gmsh::option::setNumber("Mesh.SaveAll", format.save_all);
        gmsh::model::mesh::generate(3);
        gmsh::write(msh);
        gmsh::finalize();
      }
    MPI_Barrier(MPI_COMM_WORLD);
    return msh;
  }

  inline mortise::MeshParameters
  file_parameters(const std::string &name, const std::string &part = "")
  {
    mortise::MeshParameters q;
    q.source = "file";
    q.file   = name;
    q.part   = part;
    return q;
  }

  /// Message of the error that reading gives.
  inline std::string
  message_of(const mortise::MeshParameters &q)
  {
    return ::message_of(
      [&] { mortise::read_mesh_file(q, "Mesh", MPI_COMM_WORLD); });
  }

  inline void
  refused(const std::string             &what,
          const mortise::MeshParameters &q,
          const std::string             &fragment)
  {
    const std::string message = message_of(q);
    verdict(message.find("Mesh") == 0 &&
              message.find(fragment) != std::string::npos,
            "refused: " + what,
            message);
  }
} // namespace gmsh_test
