// Proves what signs of multipliers say: each node's
// value is a mean of multipliers with weights that are not negative, and where
// these are Bernstein coefficients
// nowhere between nodes is a pressure below the least of them; polynomials
// of the degree that is left are among them, and multipliers come back from
// values. Held sides, hanging nodes, several degrees and faces covered in part
// included.
#include <verdict.h>

#include "tied_scene.h"

namespace mortise::testing
{
  using namespace dealii;

  /// The largest of |sum of weights - 1| and of what is negative.
  double
  weight_error(const TiedScene &scene)
  {
    double error = 0.;
    for (const auto &rows : scene.coupling().multipliers->rows())
      for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
        {
          double sum = 0.;
          for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
            {
              sum += rows.weight[e];
              error = std::max(error, -rows.weight[e]);
            }
          error = std::max(error, std::fabs(sum - 1.));
        }
    return Utilities::MPI::max(error, scene.comm);
  }

  /// How far the polynomials that multipliers between 0 and 1 give, of which
  /// many are 0, go below 0, between nodes, too.
  double
  undershoot(const TiedScene &scene)
  {
    mortise::Vector multiplier = scene.multiplier();
    for (const auto i : scene.owned_multiplier)
      multiplier(i) = i % 3 == 0 ? 0.1 * (i % 11) : 0.;
    const auto values =
      multiplier_coefficients(scene.coupling(), multiplier, scene.comm);
    double least = 0.;
    for (unsigned int s = 0; s < values.size(); ++s)
      {
        const TraceBasis &basis =
          scene.coupling().interface->slave().traces[s].basis();
        const auto &functions =
          face_nodal_basis(basis.shape, basis.degree).functions;
        const unsigned int  n = basis.size();
        std::vector<double> at(n);
        constexpr unsigned  fine = 12;
        for (unsigned int a = 0; a <= fine; ++a)
          for (unsigned int b = 0; b <= fine; ++b)
            if (basis.shape == FaceShape::quadrilateral || a + b <= fine)
              {
                basis.evaluate(a / double(fine), b / double(fine), at.data());
                double pressure = 0.;
                for (unsigned int k = 0; k < n; ++k)
                  for (unsigned int j = 0; j < n; ++j)
                    pressure += at[j] * functions(j, k) * values[s][2 * n + k];
                least = std::min(least, pressure);
              }
      }
    return -Utilities::MPI::min(least, scene.comm);
  }

  /// Of a polynomial of @p degree along z: values to multipliers and back.
  double
  polynomial_error(const TiedScene &scene, const unsigned int degree)
  {
    const auto given =
      values_at_nodes(scene.coupling().interface->slave(),
                      [&](const Point<dim> &x) {
                        Tensor<1, dim> value;
                        value[2] =
                          std::pow(0.3 + 0.4 * x[0] - 0.5 * x[1], degree);
                        return value;
                      });
    mortise::Vector multiplier = scene.multiplier();
    set_multiplier(scene.coupling(), given, multiplier);
    const auto values =
      multiplier_coefficients(scene.coupling(), multiplier, scene.comm);
    double error = 0.;
    for (unsigned int s = 0; s < values.size(); ++s)
      if (scene.states[s].cover != FaceCoverage::none)
        for (unsigned int k = 0; k < values[s].size(); ++k)
          error = std::max(error, std::fabs(values[s][k] - given[s][k]));
    return Utilities::MPI::max(error, scene.comm);
  }

  void
  check(const std::string    &name,
        const TiedBody       &slave,
        const unsigned int    degree,
        const MultiplierBasis basis  = MultiplierBasis::standard,
        const double          length = 1.)
  {
    const TiedScene scene(slave,
                          {box_mesh({0., 0., 1., length, 1., 2.}, {2, 4, 1}),
                           "zmin",
                           slave.degree,
                           {},
                           {}},
                          MPI_COMM_WORLD,
                          false,
                          basis,
                          true);
    verdict(name + ": weights of means", weight_error(scene), 1e-11);
    if (basis == MultiplierBasis::standard)
      verdict(name + ": nowhere below the least", undershoot(scene), 1e-11);
    for (unsigned int q = 0; q <= degree; ++q)
      verdict(name + ": polynomials of degree " + std::to_string(q),
              polynomial_error(scene, q),
              1e-9);
  }

  void
  check_all()
  {
    const std::vector<double>       cube  = {0., 0., 0., 1., 1., 1.};
    const std::vector<unsigned int> cells = {3, 2, 1};
    const std::vector<Held>         side  = {{"xmin"}};
    for (const bool tetrahedra : {false, true})
      for (const unsigned int p : {2, 3, 4, 7})
        {
          const MeshParameters mesh = box_mesh(cube, cells, tetrahedra);
          const std::string    name =
            (tetrahedra ? "triangles, p = " : "quadrilaterals, p = ") +
            std::to_string(p);
          check(name, {mesh, "zmax", p, {}, {}}, p);
          check(name + ", a side held", {mesh, "zmax", p, side, {}}, p - 1);
          check(name + ", covered in part",
                {mesh, "zmax", p, {}, {}},
                1,
                MultiplierBasis::standard,
                0.8);
        }
    MeshParameters refined = box_mesh(cube, {2, 2, 1});
    refined.refine_near    = "0, 0, 1, 0.3, 1";
    MeshParameters twice   = refined;
    twice.refine_near      = "0, 0, 1, 0.3, 2";
    for (const unsigned int p : {2, 3, 5})
      {
        const std::string name = "hanging nodes, p = " + std::to_string(p);
        check(name, {refined, "zmax", p, {}, {}}, p);
        check(name + ", dual",
              {refined, "zmax", p, {}, {}},
              p,
              MultiplierBasis::dual);
        check(name + ", a side held", {twice, "zmax", p, side, {}}, p - 1);
      }
    MeshParameters regions = box_mesh(cube, cells);
    regions.refine_near    = "1, 1, 1, 0.2, 1";
    check("hanging nodes, degrees 2 and 4",
          {regions, "zmax", 2, {}, {{0, 2}, {3, 4}}},
          2);
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mortise::testing::check_all();
}
