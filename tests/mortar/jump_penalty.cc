// Proves that the jump penalty is symmetric and positive semi-definite, blind
// to polynomials that are the same on both sides, and gamma times the square of
// the jump where they are not, on flat surfaces of any mesh, hanging nodes and
// mixed degrees included. The same on every number of ranks.
#include <deal.II/lac/lapack_full_matrix.h>

#include "assembled.h"

namespace mortise::testing
{
  /// All eigenvalues of @p J, over the largest.
  std::vector<double>
  eigenvalues(const mortise::SparseMatrix &J, const MPI_Comm comm)
  {
    const unsigned int  n = J.m();
    std::vector<double> sums(n * n);
    for (const auto i : J.locally_owned_range_indices())
      for (auto entry = J.begin(i); entry != J.end(i); ++entry)
        sums[i * n + entry->column()] = entry->value();
    Utilities::MPI::sum(sums, comm, sums);
    LAPACKFullMatrix<double> dense(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        dense(i, j) = sums[i * n + j];
    FullMatrix<double>     vectors;
    dealii::Vector<double> values;
    dense.compute_eigenvalues_symmetric(-1e12, 1e12, 1e-14, values, vectors);
    std::vector<double> result(values.begin(), values.end());
    for (double &value : result)
      value /= values(n - 1);
    return result;
  }

  /// @p p: of polynomials that both sides hold.
  void
  check_penalty(const std::string &what,
                const TiedBody    &slave,
                const TiedBody    &master,
                const unsigned int p)
  {
    const Assembled       tied(slave, master);
    const TiedScene      &scene = tied.scene;
    const mortise::Vector u = random(scene.field.numbering.owned(), scene.comm);
    mortise::Vector       Ju(u), Jv(u), v = u;
    for (const auto i : scene.field.numbering.owned())
      v(i) = std::cos(5. * i);
    tied.J.vmult(Ju, u);
    tied.J.vmult(Jv, v);
    verdict(what + ": penalty symmetric 1e-13",
            std::fabs(Ju * v - Jv * u) / (Ju.l2_norm() * v.l2_norm()),
            1e-13);
    for (const unsigned int degree : {0u, 1u, p})
      {
        const Field same = polynomial(degree);
        v                = tied.interpolate(same, same);
        tied.J.vmult(Jv, v);
        verdict(what + ": penalty of the same polynomial of degree " +
                  std::to_string(degree) + " 1e-11",
                Jv.linfty_norm() / (tied.J.linfty_norm() * v.linfty_norm()),
                1e-11);
      }

    // int gamma |a - b|^2, polynomials that differ
    const Field a = polynomial(p), b = polynomial(p, 0.2);
    v = tied.interpolate(a, b);
    tied.J.vmult(Jv, v);
    double             expected = 0.;
    const BodySurface &surface  = scene.coupling().interface->slave();
    for (unsigned int s = 0; s < surface.faces.size(); ++s)
      {
        const auto &along = surface.faces[s].frame.tangent;
        const auto  rule  = face_rule(surface.traces[s].shape, 8);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto x = face_point(surface.faces[s], rule.point(q));
            expected += scene.coupling().local[s].penalty * rule.weight(q) *
                        cross_product_3d(along[0], along[1]).norm() *
                        (a(x) - b(x)).norm_square();
          }
      }
    expected = Utilities::MPI::sum(expected, scene.comm);
    verdict(what + ": penalty of a jump 1e-11",
            std::fabs(v * Jv / expected - 1.),
            1e-11);
    const Assembled alone(slave, master, MPI_COMM_SELF);
    verdict(what + ": penalty as on one rank 1e-13",
            std::fabs(tied.J.frobenius_norm() / alone.J.frobenius_norm() - 1.),
            1e-13);
  }

  void
  check_all()
  {
    check_penalty("hexahedra 1, 1", lower(1), upper(1), 1);
    check_penalty("hexahedra 5, 4", lower(5), upper(4), 4);
    check_penalty("hexahedra 2, tetrahedra 3", lower(2), upper(3, true), 2);
    check_penalty("tetrahedra 4, 5", lower(4, true), upper(5, true), 4);
    TiedBody slave = lower(3), master = upper(2);
    turn(slave);
    turn(master);
    check_penalty("turned", slave, master, 2);
    slave                   = lower(3);
    master                  = upper(2);
    slave.mesh.refine_near  = "0, 0, 1, 0.1, 2; 1, 1, 1, 0.1, 1";
    master.mesh.refine_near = "1, 0, 1, 0.1, 1";
    check_penalty("hanging nodes", slave, master, 2);
    slave                   = lower(2);
    slave.mesh.subdivisions = {4, 2, 2};
    slave.degree_by_region  = {{4, 3}, {5, 2}, {6, 4}, {7, 3}};
    check_penalty("mixed degrees", slave, upper(2), 2);
  }

  void
  check_eigenvalues()
  {
    for (const bool tetrahedra : {false, true})
      {
        const Assembled   tied(lower(2, tetrahedra), upper(2));
        const auto        values = eigenvalues(tied.J, tied.scene.comm);
        const std::string what   = tetrahedra ? "tetrahedra" : "hexahedra";
        verdict(what + ": penalty semi-definite, eigenvalues above -1e-13",
                -values.front(),
                1e-13);
      }
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mortise::testing::check_all();
  mortise::testing::check_eigenvalues();
}
