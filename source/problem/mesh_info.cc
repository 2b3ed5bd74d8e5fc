#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/run_log.h>
#include <mortise/base/text_table.h>
#include <mortise/body/mesh/mesh_file.h>
#include <mortise/body/mesh/mesh_measures.h>
#include <mortise/problem/mesh_info.h>
#include <mortise/problem/mesh_request.h>

#include <cmath>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Rows = std::vector<std::vector<std::string>>;

    double
    sum_of(const std::vector<double> &numbers)
    {
      return std::accumulate(numbers.begin(), numbers.end(), 0.);
    }

    std::string
    triple(const Tensor<1, 3> &x, const double size)
    {
      std::string text;
      for (unsigned int d = 0; d < 3; ++d)
        text += (d > 0 ? ", " : "") +
                RunLog::number(std::fabs(x[d]) < 1e-9 * size ? 0. : x[d]);
      return text;
    }

    std::string
    whole(const MeshContents &contents, const MeshMeasures &measures)
    {
      const CoarseMesh &mesh = contents.mesh;
      const auto [low, high] =
        BoundingBox<3>(mesh.vertices).get_boundary_points();
      const double size = low.distance(high);
      Rows         rows = {
        {"cells", contents.cells},
        {"nodes",
                 std::to_string(contents.n_nodes) + ", of them vertices of cells: " +
                   std::to_string(mesh.vertices.size())},
        {"geometry", mesh.geometry == nullptr ? "of degree 1" : "of degree 2"},
        {"box",
                 "from " + triple(low, size) + " to " + triple(high, size) + ", size " +
                   triple(high - low, size)},
        {"volume", RunLog::number(sum_of(measures.volumes))},
        {"area", RunLog::number(sum_of(measures.areas))}};
      if (!mesh.remark.empty())
        rows.push_back({"remark", mesh.remark});
      return text_table(rows, false);
    }

    std::string
    parts(const CoarseMesh &mesh, const MeshMeasures &measures)
    {
      std::map<types::material_id, std::pair<std::size_t, double>> found;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          auto &[number, volume] = found[mesh.cells[c].material_id];
          ++number;
          volume += measures.volumes[c];
        }
      Rows rows = {{"part", "id", "cells", "volume"}};
      for (const auto &[id, part] : found)
        rows.push_back({mesh.names.materials.at(id),
                        std::to_string(id),
                        std::to_string(part.first),
                        RunLog::number(part.second)});
      return text_table(rows, true);
    }

    /// A row of @p faces.
    std::vector<std::string>
    boundary_row(const std::string              &name,
                 const std::string              &id,
                 const std::vector<std::size_t> &faces,
                 const MeshMeasures             &measures)
    {
      double area = 0.;
      for (const std::size_t f : faces)
        area += measures.areas[f];
      return {name, id, std::to_string(faces.size()), RunLog::number(area)};
    }

    std::string
    boundaries(const CoarseMesh &mesh, const MeshMeasures &measures)
    {
      std::map<types::boundary_id, std::vector<std::size_t>> faces;
      for (std::size_t f = 0; f < measures.areas.size(); ++f)
        faces[mesh.faces.boundary_quads[f].boundary_id].push_back(f);
      Rows rows = {{"boundary", "id", "faces", "area"}};
      for (const auto &[name, id] : mesh.names.boundaries)
        {
          rows.push_back(
            boundary_row(name, std::to_string(id), faces[id], measures));
          faces.erase(id);
        }
      // they overlap others, so that they are no boundaries by themselves
      for (const auto &[name, of_set] : mesh.overlapping_sets)
        rows.push_back(boundary_row(name, "set", of_set, measures));
      for (const auto &[id, without_name] : faces)
        rows.push_back(boundary_row("(no name)", "-", without_name, measures));
      return text_table(rows, true);
    }

    std::string
    quality(const CoarseMesh &mesh, const MeshMeasures &measures)
    {
      const auto cell = [&](const std::size_t c) {
        Tensor<1, 3> centre;
        for (const unsigned int v : mesh.cells[c].vertices)
          centre += mesh.vertices[v] / double(mesh.cells[c].vertices.size());
        return "cell " + std::to_string(mesh.cell_numbers[c]) + " at " +
               place_name(Point<3>(centre));
      };
      Rows       rows = {{"quality", "least", "mean", "greatest", "worst"}};
      const auto add  = [&](const std::string  &name,
                           const MeasureRange &range,
                           const std::size_t   worst) {
        rows.push_back({name,
                        RunLog::number(range.least),
                        RunLog::number(range.mean()),
                        RunLog::number(range.greatest),
                        cell(worst)});
      };
      add("length of edges", measures.edges, measures.edges.least_cell);
      add("longest / shortest edge",
          measures.edge_ratios,
          measures.edge_ratios.greatest_cell);
      add("scaled Jacobian",
          measures.scaled_jacobians,
          measures.scaled_jacobians.least_cell);
      return text_table(rows, false) +
             "  Straight edges; the scaled Jacobian is 1 for a cube and a "
             "regular tetrahedron, 0 or less for a cell that is folded.\n";
    }

    std::string
    findings(const CoarseMesh &mesh)
    {
      const auto lines = mesh.findings.lines();
      return lines.empty() ? "no faults were found\n" :
                             "faults:\n" + join_lines(lines, 30) + "\n";
    }
  } // namespace

  std::string
  mesh_info(const std::string &file,
            const Settings    &settings,
            const MPI_Comm     comm)
  {
    const MeshRequest request = read_mesh_request("--info", file, settings);
    std::string       problem, text;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          const MeshContents contents = read_contents(request.mesh, "--info");
          const CoarseMesh  &mesh     = contents.mesh;
          const MeshMeasures measures = measure(mesh);
          text = file + "\n" + whole(contents, measures) + "\n" +
                 parts(mesh, measures) + "\n" + boundaries(mesh, measures) +
                 "\n" + quality(mesh, measures) + "\n" + findings(mesh);
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    throw_if_any(problem, comm);
    return text;
  }
} // namespace mortise
