// Sums over what faces give to multipliers, for reports; only sources of this
// room include it.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/coupling.h>

#include <array>

namespace mortise
{
  /// Sum over the functions of a face that are not zero on constants: those
  /// of its vertices.
  inline double
  on_constants(const dealii::FullMatrix<double> &local,
               const unsigned int                i,
               const TraceBasis                 &basis)
  {
    double sum = 0.;
    for (unsigned int v = 0; v < basis.n_vertices(); ++v)
      sum += local(i, basis.vertex_function(v));
    return sum;
  }

  /// int psi_i of slave face @p s.
  inline double
  integral(const Coupling &coupling, const unsigned int s, const unsigned int i)
  {
    return on_constants(coupling.local[s].constraint,
                        i,
                        coupling.interface->slave().traces[s].basis());
  }

  /// The same of integrals with d, see LocalCoupling::directed.
  inline dealii::Tensor<1, dim>
  on_constants(const std::array<dealii::FullMatrix<double>, dim> &directed,
               const unsigned int                                 i,
               const TraceBasis                                  &basis)
  {
    dealii::Tensor<1, dim> sum;
    for (unsigned int c = 0; c < dim; ++c)
      sum[c] = on_constants(directed[c], i, basis);
    return sum;
  }

  /// int psi_i of slave face @p s less that of its partners.
  inline double
  row_difference(const Coupling    &coupling,
                 const unsigned int s,
                 const unsigned int i)
  {
    double sum = integral(coupling, s, i);
    for (const auto &partner : coupling.local[s].partners)
      sum -= on_constants(
        partner.constraint,
        i,
        coupling.interface->master_traces()[partner.master].basis());
    return sum;
  }

  /// int psi_i (x_master - x_slave) of slave face @p s along @p direction.
  inline double
  opening(const Coupling               &coupling,
          const unsigned int            s,
          const unsigned int            i,
          const dealii::Tensor<1, dim> &direction)
  {
    const LocalCoupling &local = coupling.local[s];
    const double         all   = local.gap_moment[i] * direction;
    if (!local.is_directed())
      return all;
    if (!coupling.law.has_friction())
      return local.distance_moment[i];
    const dealii::Tensor<1, dim> &normal = coupling.frames[s][i][0];
    return all + (normal * direction) *
                   (local.distance_moment[i] - local.gap_moment[i] * normal);
  }

  /// int psi_i psi_j
  inline double
  multiplier_product(const LocalCoupling &local,
                     const unsigned int   i,
                     const unsigned int   j)
  {
    double sum = 0.;
    for (unsigned int k = 0; k < local.mass.m(); ++k)
      sum += local.constraint(i, k) * local.multiplier(j, k);
    return sum;
  }

  /// Calls visit(slave face, row, multiplier, its weight).
  template <typename Visit>
  void
  for_each_entry(const Coupling &coupling, const Visit &visit)
  {
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (!coupling.local[s].partners.empty())
        {
          const auto &rows = coupling.multipliers->rows()[s];
          for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
            for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
              visit(s, r, rows.index[e], rows.weight[e]);
        }
  }

  /// Calls visit(slave face, node, direction, multiplier, its weight).
  template <typename Visit>
  void
  for_each_part(const Coupling &coupling, const Visit &visit)
  {
    for_each_entry(coupling,
                   [&](const unsigned int s,
                       const unsigned int r,
                       const auto         index,
                       const double       weight) {
                     coupling.multipliers->rows()[s].for_each_direction(
                       r,
                       [&](const unsigned int            node,
                           const dealii::Tensor<1, dim> &direction) {
                         visit(s, node, direction, index, weight);
                       });
                   });
  }

  /// @p owned and those that the faces of this rank touch.
  inline dealii::IndexSet
  touched_multipliers(const Coupling &coupling, const dealii::IndexSet &owned)
  {
    dealii::IndexSet touched = owned;
    for (const auto &rows : coupling.multipliers->rows())
      touched.add_indices(rows.index.begin(), rows.index.end());
    return touched;
  }

  /// Entries by multiplier, those that the faces of this rank touch included.
  inline std::vector<Vector>
  make_sums(const unsigned int      n,
            const Coupling         &coupling,
            const dealii::IndexSet &owned_multiplier,
            const MPI_Comm          comm)
  {
    std::vector<Vector> sums(n);
    for (auto &sum : sums)
      sum.reinit(owned_multiplier,
                 touched_multipliers(coupling, owned_multiplier),
                 comm);
    return sums;
  }
} // namespace mortise
