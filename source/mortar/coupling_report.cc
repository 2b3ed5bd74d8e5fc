#include <deal.II/base/mpi.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Nodes that slip hold bodies across their directions: coarse levels of a
    /// body that nothing else holds need something of that.
    constexpr double share_of_slip = 0.1;

    /// Of int |psi_i|: the root of the area times that of int psi_i^2.
    double
    weight_bound(const Coupling    &coupling,
                 const unsigned int s,
                 const unsigned int i)
    {
      // negative where the faces of an iterate fold
      return std::sqrt(std::fabs(multiplier_product(coupling.local[s], i, i))) *
             coupling.interface->slave().faces[s].size;
    }
  } // namespace

  std::vector<MultiplierMoment>
  multiplier_moments(const Coupling &coupling,
                     const IndexSet &owned_multiplier,
                     const MPI_Comm  comm)
  {
    if (owned_multiplier.size() == 0)
      return {};
    // the bound, then by component the weight and the moment
    constexpr unsigned int n_sums = 1 + dim + dim * dim;
    auto sums = make_sums(n_sums, coupling, owned_multiplier, comm);
    for_each_part(coupling,
                  [&](const unsigned int    s,
                      const unsigned int    i,
                      const Tensor<1, dim> &direction,
                      const auto            index,
                      const double          w) {
                    const LocalCoupling &local = coupling.local[s];
                    sums[0](index) += std::fabs(w) * direction.norm() *
                                      weight_bound(coupling, s, i);
                    const double weight = integral(coupling, s, i);
                    for (unsigned int c = 0; c < dim; ++c)
                      {
                        sums[1 + c](index) += w * direction[c] * weight;
                        for (unsigned int d = 0; d < dim; ++d)
                          sums[1 + dim + dim * c + d](index) +=
                            w * direction[c] * local.position_moment[i][d];
                      }
                  });
    for (auto &sum : sums)
      sum.compress(VectorOperation::add);

    std::vector<MultiplierMoment> result(coupling.multipliers->n_owned());
    for (unsigned int k = 0; k < result.size(); ++k)
      {
        const auto i = coupling.multipliers->first() + k;
        if (const double bound = sums[0](i))
          for (unsigned int c = 0; c < dim; ++c)
            {
              result[k].weight[c] = sums[1 + c](i) / bound;
              for (unsigned int d = 0; d < dim; ++d)
                result[k].moment[c][d] = sums[1 + dim + dim * c + d](i) / bound;
            }
      }
    return result;
  }

  void
  select_nodes(const std::vector<NodeStatus> &statuses,
               const IndexSet                &owned_multiplier,
               const MPI_Comm                 comm,
               Coupling                      &coupling)
  {
    if (owned_multiplier.size() == 0)
      return;
    // do they hold along the normal, and tangentially?
    auto flags = make_sums(2, coupling, owned_multiplier, comm);
    for (unsigned int i = 0; i < statuses.size(); ++i)
      {
        const ContactNode &node = coupling.contact_nodes[i];
        for (unsigned int r = 0; r < node.n_multipliers; ++r)
          {
            flags[0].local_element(node.multipliers[r]) =
              statuses[i] == NodeStatus::open ? 0. : 1.;
            flags[1].local_element(node.multipliers[r]) =
              statuses[i] == NodeStatus::stick ? 1. :
              statuses[i] == NodeStatus::slip  ? share_of_slip :
                                                 0.;
          }
      }
    for (auto &flag : flags)
      flag.update_ghost_values();
    std::vector<std::array<double, 2>> shares(coupling.local.size());
    std::vector<double>                sizes(shares.size());
    for_each_entry(coupling,
                   [&](const unsigned int s,
                       const unsigned int r,
                       const auto         index,
                       const double       w) {
                     const unsigned int i =
                       r % coupling.multipliers->rows()[s].n_nodes();
                     const double size =
                       w * w * multiplier_product(coupling.local[s], i, i);
                     sizes[s] += size;
                     for (unsigned int k = 0; k < 2; ++k)
                       shares[s][k] += flags[k](index) * size;
                   });
    for (unsigned int s = 0; s < shares.size(); ++s)
      if (LocalCoupling &local = coupling.local[s]; sizes[s] > 0.)
        {
          local.active_fraction   = shares[s][0] / sizes[s];
          local.sticking_fraction = shares[s][1] / sizes[s];
        }
  }

  TransferErrors
  transfer_errors(const Coupling &coupling,
                  const IndexSet &owned_multiplier,
                  const MPI_Comm  comm)
  {
    if (owned_multiplier.size() == 0)
      return {};
    // the entries of a multiplier come from all faces around it, on any rank
    enum
    {
      difference,
      weight,
      gap_x,
      gap_y,
      gap_z,
      scale,
      n_sums
    };
    auto sums = make_sums(n_sums, coupling, owned_multiplier, comm);

    for_each_entry(coupling,
                   [&](const unsigned int s,
                       const unsigned int r,
                       const auto         index,
                       const double       w) {
                     const unsigned int i =
                       r % coupling.multipliers->rows()[s].n_nodes();
                     const LocalCoupling &local = coupling.local[s];
                     sums[difference](index) +=
                       w * row_difference(coupling, s, i);
                     sums[weight](index) += w * integral(coupling, s, i);
                     for (unsigned int c = 0; c < dim; ++c)
                       sums[gap_x + c](index) += w * local.gap_moment[i][c];
                     sums[scale](index) +=
                       std::fabs(w) * weight_bound(coupling, s, i) *
                       coupling.interface->slave().faces[s].size;
                   });
    for (auto &sum : sums)
      sum.compress(VectorOperation::add);

    double worst_difference = 0., largest_weight = 0., worst_gap = 0.;
    for (unsigned int i = 0; i < sums[weight].locally_owned_size(); ++i)
      {
        worst_difference =
          std::max(worst_difference,
                   std::fabs(sums[difference].local_element(i)));
        largest_weight =
          std::max(largest_weight, std::fabs(sums[weight].local_element(i)));
        const double gap = std::hypot(sums[gap_x].local_element(i),
                                      sums[gap_y].local_element(i),
                                      sums[gap_z].local_element(i));
        if (sums[scale].local_element(i) > 0.)
          worst_gap = std::max(worst_gap, gap / sums[scale].local_element(i));
      }
    TransferErrors errors;
    largest_weight             = Utilities::MPI::max(largest_weight, comm);
    errors.partition_of_unity  = Utilities::MPI::max(worst_difference, comm);
    errors.linear_completeness = Utilities::MPI::max(worst_gap, comm);
    if (largest_weight > 0.)
      errors.partition_of_unity /= largest_weight;
    return errors;
  }

  std::vector<std::vector<double>>
  values_by_row(const Coupling &coupling,
                const Vector   &multiplier,
                const MPI_Comm  comm)
  {
    std::vector<std::vector<double>> values;
    for (const auto &rows : coupling.multipliers->rows())
      values.emplace_back(rows.begin.size() - 1);
    if (multiplier.size() == 0)
      return values;
    const IndexSet owned = multiplier.locally_owned_elements();
    Vector         ghosted(owned, touched_multipliers(coupling, owned), comm);
    ghosted = multiplier;
    ghosted.update_ghost_values();
    for (unsigned int s = 0; s < values.size(); ++s)
      {
        const auto &rows = coupling.multipliers->rows()[s];
        for (unsigned int r = 0; r < values[s].size(); ++r)
          for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
            values[s][r] += rows.weight[e] * ghosted(rows.index[e]);
      }
    return values;
  }

  std::vector<std::vector<double>>
  multiplier_coefficients(const Coupling &coupling,
                          const Vector   &multiplier,
                          const MPI_Comm  comm)
  {
    const auto values = values_by_row(coupling, multiplier, comm);
    std::vector<std::vector<double>> coefficients;
    for (unsigned int s = 0; s < values.size(); ++s)
      {
        const auto        &rows = coupling.multipliers->rows()[s];
        const unsigned int n    = rows.n_nodes();
        coefficients.emplace_back(dim * n, 0.);
        for (unsigned int r = 0; r < values[s].size(); ++r)
          rows.for_each_direction(
            r, [&](const unsigned int i, const Tensor<1, dim> &direction) {
              for (unsigned int c = 0; c < dim; ++c)
                coefficients[s][c * n + i] += values[s][r] * direction[c];
            });
      }
    return coefficients;
  }

  namespace
  {
    /// Coefficients by row, from those of components: what undoes
    /// multiplier_coefficients() on a face.
    std::vector<double>
    along_directions(const MultiplierSpace::FaceMultipliers &rows,
                     const std::vector<double>              &coefficients)
    {
      const unsigned int  n = rows.n_nodes();
      std::vector<double> result(rows.begin.size() - 1);
      for (unsigned int r = 0; r < result.size(); ++r)
        rows.for_each_direction(
          r, [&](const unsigned int i, const Tensor<1, dim> &direction) {
            for (unsigned int c = 0; c < dim; ++c)
              result[r] += direction[c] * coefficients[c * n + i];
          });
      if (rows.along_normals.empty())
        return result;
      // the directions of rows are not orthogonal to each other
      FullMatrix<double> products(n, n);
      for (unsigned int r = 0; r < n; ++r)
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int i = 0; i < n; ++i)
            products(r, q) +=
              rows.along_normals[r * n + i] * rows.along_normals[q * n + i];
      products.gauss_jordan();
      dealii::Vector<double> right(result.begin(), result.end()), values(n);
      products.vmult(values, right);
      return {values.begin(), values.end()};
    }
  } // namespace

  void
  set_multiplier(const Coupling                         &coupling,
                 const std::vector<std::vector<double>> &coefficients,
                 Vector                                 &multiplier)
  {
    if (multiplier.size() == 0)
      return;
    auto       sums  = make_sums(2,
                          coupling,
                          multiplier.locally_owned_elements(),
                          multiplier.get_mpi_communicator());
    Vector    &value = sums[0], &is_given = sums[1];
    const auto give = [&](const auto index, const double given) {
      value(index)    = given;
      is_given(index) = 1.;
    };
    for (unsigned int s = 0; s < coefficients.size(); ++s)
      {
        const auto        &rows   = coupling.multipliers->rows()[s];
        const unsigned int n      = rows.n_nodes();
        const auto         values = along_directions(rows, coefficients[s]);
        for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
          if (rows.begin[r + 1] == rows.begin[r] + 1)
            give(rows.index[rows.begin[r]],
                 values[r] / rows.weight[rows.begin[r]]);
        for (const auto &coefficient : rows.coefficients)
          give(coefficient.index,
               std::inner_product(coefficient.of_values.begin(),
                                  coefficient.of_values.end(),
                                  values.begin() + coefficient.direction * n,
                                  0.));
      }
    // faces of other processes give what none of the owner does
    std::vector<bool> is_known(multiplier.locally_owned_size());
    for (unsigned int i = 0; i < is_known.size(); ++i)
      if (is_given.local_element(i) > 0.)
        {
          is_known[i]                 = true;
          multiplier.local_element(i) = value.local_element(i);
          value.local_element(i) = is_given.local_element(i) = 0.;
        }
    for (Vector &sum : sums)
      sum.compress(VectorOperation::add);
    for (unsigned int i = 0; i < is_known.size(); ++i)
      if (const double n = is_given.local_element(i); n > 0. && !is_known[i])
        multiplier.local_element(i) = value.local_element(i) / n;
  }

  void
  add_offset(const Coupling                                  &coupling,
             const std::function<double(const Point<dim> &)> &offset,
             Vector                                          &rhs)
  {
    const BodySurface &slave = coupling.interface->slave();
    Vector             sum   = make_sums(1,
                           coupling,
                           rhs.locally_owned_elements(),
                           rhs.get_mpi_communicator())[0];
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (const LocalCoupling &local = coupling.local[s];
          !local.partners.empty())
        {
          const auto        &rows  = coupling.multipliers->rows()[s];
          const FaceTrace   &trace = slave.traces[s];
          const unsigned int n     = rows.n_nodes();
          FullMatrix<double> nodal(n, n); // int psi_i phi_k
          local.constraint.mmult(
            nodal, face_nodal_basis(trace.shape, trace.degree).functions);
          const auto nodes = face_nodes(trace.shape, trace.degree);
          std::vector<Tensor<1, dim>> values;
          for (unsigned int k = 0; k < n; ++k)
            values.push_back(
              offset(face_point(slave.undeformed_face(s), nodes[k])) *
              coupling.frames[s][k][0]);
          for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
            {
              double along = 0.;
              rows.for_each_direction(
                r, [&](const unsigned int i, const Tensor<1, dim> &direction) {
                  for (unsigned int k = 0; k < n; ++k)
                    along += nodal(i, k) * (values[k] * direction);
                });
              for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                sum(rows.index[e]) += rows.weight[e] * along;
            }
        }
    sum.compress(VectorOperation::add);
    rhs += sum;
  }

  namespace
  {
    /// Add of each multiplier the sum of what @p value gives by slave face, node
    /// and direction.
    template <typename Value>
    void
    add_by_node(const Coupling &coupling, const Value &value, Vector &rhs)
    {
      Vector sum = make_sums(1,
                             coupling,
                             rhs.locally_owned_elements(),
                             rhs.get_mpi_communicator())[0];
      for_each_part(coupling,
                    [&](const unsigned int    s,
                        const unsigned int    node,
                        const Tensor<1, dim> &direction,
                        const auto            index,
                        const double          weight) {
                      sum(index) += weight * value(s, node, direction);
                    });
      sum.compress(VectorOperation::add);
      rhs += sum;
    }
  } // namespace

  void
  add_jump(const Coupling &coupling, const Tensor<1, dim> &jump, Vector &rhs)
  {
    add_by_node(
      coupling,
      [&](const auto s, const auto node, const Tensor<1, dim> &direction) {
        return integral(coupling, s, node) * (jump * direction);
      },
      rhs);
  }

  void
  add_distances(const Coupling &coupling, Vector &rhs)
  {
    add_by_node(
      coupling,
      [&](const auto s, const auto node, const Tensor<1, dim> &direction) {
        return opening(coupling, s, node, direction);
      },
      rhs);
  }
} // namespace mortise
