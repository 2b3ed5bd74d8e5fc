// Proves that coarse levels see the constraint as multipliers do: linear
// displacements of both sides cost nothing, the meshes may be any; a constant
// jump costs gamma times the area, by dual multipliers exactly, by standard
// ones at least a tenth of it and not more; and that the tie of thin bodies
// whose meshes do not match is no harder than that of cubes at degree 1. The
// same on every number of ranks.
#include <mortise/operators/levels/nodal_level.h>
#include <scenes/active_sets.h>
#include <scenes/scene.h>

using namespace mortise;
using namespace mortise::testing;
using namespace dealii;

namespace
{
  std::string
  blocks(const double height = 1.)
  {
    return tied("lower, upper", "lower: zmax", "upper: zmin") +
           box("lower", "0, 0, 0, 1, 1, " + number(height), "zmin", "") +
           box("upper",
               "0, 0, " + number(height) + ", 1, 1, " + number(2. * height),
               "",
               "zmax") +
           "subsection Exact solution\n"
           "  set Displacement = 0.1*y + 0.2*z; -0.1*z; 0.2*x + 0.1*z\nend\n";
  }

  Settings
  meshes(const std::string &lower,
         const std::string &upper,
         const unsigned int p)
  {
    Settings result{"Body lower/Mesh/Subdivisions=3, 3, 2",
                    "Body upper/Mesh/Subdivisions=4, 4, 2",
                    "Body lower/Degree=" + std::to_string(p),
                    "Body upper/Degree=" + std::to_string(p)};
    if (lower == "hanging")
      result.push_back("Body lower/Mesh/Refine near=0, 0, 1, 0.3, 1");
    else
      result.push_back("Body lower/Mesh/Cells=" + lower);
    result.push_back("Body upper/Mesh/Cells=" + upper);
    return result;
  }

  /// The energy of @p function(body, x) in the penalty of the level of degree 1.
  double
  energy(const BlockSystem &system,
         const std::function<Tensor<1, dim>(unsigned int, const Point<dim> &)>
           &function)
  {
    const NodalLevel   &level = system.nodal->levels().back();
    LevelVector<double> u(level.layout), force(level.layout);
    level.space->for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        for (const unsigned int v : cell->vertex_indices())
          for (unsigned int c = 0; c < dim; ++c)
            if (level.layout->in_local_range(dim * nodes[v] + c))
              u(dim * nodes[v] + c) = function(body.index, cell->vertex(v))[c];
      });
    u.update_ghost_values();
    for (const NodalPenalty &penalty : level.penalties)
      PenaltyProduct<double>(penalty).add(u.begin(), force.begin());
    u.zero_out_ghost_values();
    force.compress(VectorOperation::add);
    return u * force;
  }

  void
  check_energies(const std::string &lower,
                 const std::string &upper,
                 const unsigned int p)
  {
    const EquationsOfScene scene(blocks(),
                                 meshes(lower, upper, p),
                                 MPI_COMM_WORLD);
    const BlockSystem     &system = scene.discretisation.linear_system();
    const std::string      name =
      lower + " on " + upper + ", p = " + std::to_string(p);
    const auto linear = [](const unsigned int, const Point<dim> &x) {
      Tensor<1, dim> u;
      u[0] = x[0] - 2. * x[1];
      u[1] = 3. * x[1] + x[2];
      u[2] = 1. + x[0] + x[1];
      return u;
    };
    const auto jump = [](const unsigned int body, const Point<dim> &) {
      Tensor<1, dim> u;
      u[2] = body == 0 ? 1. : 0.;
      return u;
    };
    const double of_jump = energy(system, jump);
    verdict(name + ": a linear displacement costs nothing",
            std::fabs(energy(system, linear)) / of_jump,
            1e-12);
    // what gamma would be for a whole face, over all faces
    double exact = 0.;
    for (const Coupling &coupling : scene.discretisation.interfaces().all())
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        {
          const FaceTrace      &trace = coupling.interface->slave().traces[s];
          const FaceNodalBasis &basis =
            face_nodal_basis(trace.shape, trace.degree);
          dealii::Vector<double> one(trace.n_functions()), modes(one);
          one = 1.;
          basis.functions.vmult(modes, one);
          exact += 0.4 * trace.degree * trace.degree *
                   coupling.local[s].penalty *
                   coupling.local[s].mass.matrix_norm_square(modes);
        }
    const double ratio = of_jump / Utilities::MPI::sum(exact, MPI_COMM_WORLD);
    const bool   dual  = lower != "tetrahedra" || p == 1;
    // where nodes hang gamma is a mean of faces of two sizes
    verdict(name + ": a constant jump costs gamma times the area",
            std::max(0., dual ? std::fabs(ratio - 1.) : ratio - 1.),
            lower == "hanging" ? 0.01 : 1e-10);
    verdict(name + ": or at least a tenth", ratio > 0.1 ? 0. : 1., 0.);
  }

  void
  check_thin(const std::string &cells)
  {
    for (const double height : {1., 0.1, 0.01, 0.001})
      {
        const Summary summary = run_scene(blocks(height),
                                          meshes(cells, cells, 1) +
                                            Settings{"Solver/Tolerance=1e-8"});
        verdict(cells + ", layers of height " + number(height) +
                  ", degree 1: at most 15 iterations",
                static_cast<double>(*summary.steps.back().solver->iterations),
                15);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {1, 2, 3})
    for (const auto &[lower, upper] :
         std::vector<std::pair<std::string, std::string>>{
           {"hexahedra", "hexahedra"},
           {"hanging", "tetrahedra"},
           {"tetrahedra", "hexahedra"},
           {"tetrahedra", "tetrahedra"}})
      check_energies(lower, upper, p);
  for (const std::string cells : {"hexahedra", "tetrahedra"})
    check_thin(cells);
}
