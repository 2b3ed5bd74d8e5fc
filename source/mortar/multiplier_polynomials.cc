// The traction on slave faces as polynomials: multiplier_on_faces().
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/vector.h>

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Multipliers = LinearAlgebra::distributed::Vector<double>;

    /// The nodal functions of the slave faces, combined as the multipliers are:
    /// phi_I = sum_k R_kI phi_k.
    class ProjectionOnPolynomials
    {
    public:
      ProjectionOnPolynomials(const Coupling &coupling,
                              const IndexSet &owned,
                              const MPI_Comm  comm)
        : coupling(coupling)
      {
        IndexSet ghosts = owned;
        for (const auto &rows : coupling.multipliers->rows())
          ghosts.add_indices(rows.index.begin(), rows.index.end());
        all.reinit(owned, ghosts, comm);
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          {
            const FaceTrace &trace = coupling.interface->slave().traces[s];
            const BlockSide  side{trace.shape, trace.degree, trace.degree};
            masses.emplace_back();
            if (!coupling.local[s].partners.empty())
              masses.back() = nodal_block(coupling.local[s].mass, side, side);
            entries.emplace_back();
            for (const auto index : coupling.multipliers->rows()[s].index)
              entries.back().push_back(
                all.get_partitioner()->global_to_local(index));
          }
        diagonal.reinit(all);
        for_each_row([&](const unsigned int s,
                         const unsigned int k,
                         const Tensor<1, dim> &,
                         const unsigned int entry,
                         const double       weight) {
          diagonal.local_element(entry) += weight * weight * masses[s](k, k);
        });
        diagonal.compress(VectorOperation::add);
        // those of other interfaces are left at zero
        for (double &value : diagonal)
          value = value > 0. ? 1. / value : 1.;
      }

      void
      initialize(Multipliers &v) const
      {
        v.reinit(all);
      }

      /// dst_I = int phi_I sum_J src_J phi_J.
      void
      vmult(Multipliers &dst, const Multipliers &src) const
      {
        apply(dst, src, false);
      }

      /// dst_I = int phi_I sum_J src_J psi_J.
      void
      moments(Multipliers &dst, const Multipliers &src) const
      {
        apply(dst, src, true);
      }

      Multipliers diagonal; ///< inverse

    private:
      /// visit(s, k, direction, entry, weight) for what the rows of node k of
      /// face s are made of.
      template <typename Visit>
      void
      for_each_row(const Visit &visit) const
      {
        for (unsigned int s = 0; s < masses.size(); ++s)
          if (masses[s].m() > 0)
            {
              const auto        &rows = coupling.multipliers->rows()[s];
              const unsigned int n    = rows.n_nodes();
              for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
                for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                  visit(s, r % n, rows.direction(r), entries[s][e], rows.weight[e]);
            }
      }

      void
      apply(Multipliers       &dst,
            const Multipliers &src,
            const bool         of_multipliers) const
      {
        Multipliers from(all);
        from.copy_locally_owned_data_from(src);
        from.update_ghost_values();
        std::vector<std::array<dealii::Vector<double>, dim>> values, products;
        for (const auto &mass : masses)
          {
            values.emplace_back();
            for (auto &component : values.back())
              component.reinit(mass.m());
          }
        products = values;
        for_each_row([&](const unsigned int s,
                         const unsigned int k,
                         const Tensor<1, dim> &direction,
                         const unsigned int entry,
                         const double       weight) {
          for (unsigned int c = 0; c < dim; ++c)
            values[s][c](k) +=
              direction[c] * weight * from.local_element(entry);
        });
        for (unsigned int s = 0; s < masses.size(); ++s)
          for (unsigned int c = 0; c < dim && masses[s].m() > 0; ++c)
            if (const LocalCoupling &local = coupling.local[s];
                of_multipliers && local.is_dual())
              for (unsigned int k = 0; k < masses[s].m(); ++k)
                products[s][c](k) = local.weights[k] * values[s][c](k);
            else
              masses[s].vmult(products[s][c], values[s][c]);
        dst.reinit(all);
        for_each_row([&](const unsigned int s,
                         const unsigned int k,
                         const Tensor<1, dim> &direction,
                         const unsigned int entry,
                         const double       weight) {
          for (unsigned int c = 0; c < dim; ++c)
            dst.local_element(entry) +=
              direction[c] * weight * products[s][c](k);
        });
        dst.compress(VectorOperation::add);
      }

      const Coupling                 &coupling;
      std::vector<FullMatrix<double>> masses; ///< of nodal functions
      std::vector<std::vector<unsigned int>>
                  entries; ///< of vectors, by face as rows().index
      Multipliers all;
    };

    /// @p multiplier in polynomials that do the same work on the slave.
    Vector
    project(const Coupling &coupling,
            const Vector   &multiplier,
            const MPI_Comm  comm)
    {
      constexpr double              accuracy = 1e-13;
      const ProjectionOnPolynomials matrix(coupling,
                                           multiplier.locally_owned_elements(),
                                           comm);
      Multipliers                   lambda, moments, x;
      for (auto *v : {&lambda, &moments, &x})
        matrix.initialize(*v);
      std::copy(multiplier.begin(), multiplier.end(), lambda.begin());
      matrix.moments(moments, lambda);
      SolverControl control(1000, accuracy * moments.l2_norm(), false, false);
      DiagonalMatrix<Multipliers> preconditioner;
      preconditioner.get_vector() = matrix.diagonal;
      try
        {
          SolverCG<Multipliers>(control).solve(matrix,
                                               x,
                                               moments,
                                               preconditioner);
        }
      catch (const SolverControl::NoConvergence &)
        {} // rounding: what was reached is as good
      Vector result(multiplier);
      std::copy(x.begin(), x.end(), result.begin());
      return result;
    }
  } // namespace

  std::vector<std::vector<double>>
  multiplier_on_faces(const Coupling &coupling,
                      const Vector   &multiplier,
                      const MPI_Comm  comm)
  {
    const bool some_dual =
      Utilities::MPI::max(std::any_of(coupling.local.begin(),
                                      coupling.local.end(),
                                      [](const LocalCoupling &local) {
                                        return local.is_dual();
                                      }) ?
                            1 :
                            0,
                          comm) == 1;
    auto coefficients =
      multiplier_coefficients(coupling,
                              some_dual && multiplier.size() > 0 ?
                                project(coupling, multiplier, comm) :
                                multiplier,
                              comm);
    for (unsigned int s = 0; s < coefficients.size(); ++s)
      {
        const FaceTrace          &trace = coupling.interface->slave().traces[s];
        const FullMatrix<double> &functions =
          face_nodal_basis(trace.shape, trace.degree).functions;
        const unsigned int     n = functions.m();
        dealii::Vector<double> at_nodes(n), result(n);
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto first = coefficients[s].begin() + c * n;
            std::copy_n(first, n, at_nodes.begin());
            functions.vmult(result, at_nodes);
            std::copy_n(result.begin(), n, first);
          }
      }
    return coefficients;
  }
} // namespace mortise
