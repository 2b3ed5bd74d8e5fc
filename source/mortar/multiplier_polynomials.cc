// The traction on slave faces as polynomials: multiplier_on_faces().
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/vector.h>

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
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
        all.reinit(owned, touched_multipliers(coupling, owned), comm);
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          {
            const FaceTrace &trace = coupling.interface->slave().traces[s];
            const BlockSide  side{trace.shape, trace.degree, trace.degree};
            masses.emplace_back();
            if (coupling.local[s].partners.empty())
              continue;
            masses.back() = nodal_block(coupling.local[s].mass, side, side);
            add_terms(coupling.multipliers->rows()[s]);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int k = 0; k < masses.back().m(); ++k)
                products.push_back(masses.back()(k, k)); // for the diagonal
          }
        diagonal.reinit(all);
        for (const Term &term : terms)
          diagonal.local_element(term.entry) +=
            std::pow(term.weight, 2) * products[term.value];
        diagonal.compress(VectorOperation::add);
        // those of other interfaces are left at zero
        for (double &value : diagonal)
          value = value > 0. ? 1. / value : 1.;
      }

      void
      initialize(Vector &v) const
      {
        v.reinit(all);
      }

      /// dst_I = int phi_I sum_J src_J phi_J.
      void
      vmult(Vector &dst, const Vector &src) const
      {
        apply(dst, src, false);
      }

      /// dst_I = int phi_I sum_J src_J psi_J.
      void
      moments(Vector &dst, const Vector &src) const
      {
        apply(dst, src, true);
      }

      Vector diagonal; ///< inverse

    private:
      /// A multiplier's part of a value.
      struct Term
      {
        unsigned int value, entry;
        double       weight;
      };

      /// Those of the next face.
      void
      add_terms(const MultiplierSpace::FaceMultipliers &rows)
      {
        const unsigned int n = rows.n_nodes(), first = values.size();
        for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
          rows.for_each_direction(
            r, [&](const unsigned int i, const Tensor<1, dim> &direction) {
              for (unsigned int c = 0; c < dim; ++c)
                if (direction[c] != 0.)
                  for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1];
                       ++e)
                    terms.push_back(
                      {first + c * n + i,
                       all.get_partitioner()->global_to_local(rows.index[e]),
                       direction[c] * rows.weight[e]});
            });
        values.resize(first + dim * n);
      }

      void
      apply(Vector &dst, const Vector &src, const bool of_multipliers) const
      {
        all.copy_locally_owned_data_from(src);
        all.update_ghost_values();
        std::fill(values.begin(), values.end(), 0.);
        for (const Term &term : terms)
          values[term.value] += term.weight * all.local_element(term.entry);
        unsigned int first = 0;
        for (unsigned int s = 0; s < masses.size(); ++s)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const unsigned int   n     = masses[s].m();
              const double        *from  = values.data() + first;
              double              *to    = products.data() + first;
              const LocalCoupling &local = coupling.local[s];
              if (n > 0 && of_multipliers && local.is_dual())
                for (unsigned int k = 0; k < n; ++k)
                  to[k] = local.weights[k] * from[k];
              else
                for (unsigned int k = 0; k < n; ++k)
                  to[k] =
                    std::inner_product(from, from + n, &masses[s](k, 0), 0.);
              first += n;
            }
        all = 0.;
        for (const Term &term : terms)
          all.local_element(term.entry) += term.weight * products[term.value];
        all.compress(VectorOperation::add);
        dst.copy_locally_owned_data_from(all);
      }

      const Coupling                 &coupling;
      std::vector<FullMatrix<double>> masses; ///< of nodal functions, by face
      std::vector<Term>               terms;  ///< face by face
      /// By face, component, node.
      mutable std::vector<double> values, products;
      mutable Vector              all;
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
      Vector                        lambda, moments, x;
      for (auto *v : {&lambda, &moments, &x})
        matrix.initialize(*v);
      lambda.copy_locally_owned_data_from(multiplier);
      matrix.moments(moments, lambda);
      SolverControl control(1000, accuracy * moments.l2_norm(), false, false);
      DiagonalMatrix<Vector> preconditioner;
      preconditioner.get_vector() = matrix.diagonal;
      try
        {
          SolverCG<Vector>(control).solve(matrix, x, moments, preconditioner);
        }
      catch (const SolverControl::NoConvergence &)
        {} // rounding: what was reached is as good
      return x;
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
