// See interface_correction.h.
#include <mortise/operators/tensor_kernel.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface_correction.h>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  InterfaceCorrection<Number>::InterfaceCorrection(
    const BlockSystem     &system,
    const DiagonalLifting &lifting)
    : lifting(lifting)
    , jump(system.coupling.trilinos_matrix().RowMap())
    , multiplier(jump)
  {
    const auto &coupling = system.coupling.trilinos_matrix();
    const auto &map      = coupling.ColMap();
    IndexSet    touched(system.owned_displacement.size());
    for (int k = 0; k < map.NumMyElements(); ++k)
      touched.add_index(map.GID(k));
    touched.compress();
    const auto layout = std::make_shared<const Utilities::MPI::Partitioner>(
      system.owned_displacement, touched, system.communicator);
    values.reinit(layout);

    LevelVector<double> weights(layout);
    weights.copy_locally_owned_data_from(lifting.diagonal());
    weights.update_ghost_values();
    std::vector<unsigned int> place(map.NumMyElements());
    for (int k = 0; k < map.NumMyElements(); ++k)
      place[k] = layout->global_to_local(map.GID(k));
    std::size_t size = 0, widest = 0;
    for (const RowGroup &rows : group_rows(coupling))
      {
        const EpetraRow row(coupling, rows.first);
        groups.push_back({rows, {}});
        for (int k = 0; k < row.length; ++k)
          groups.back().columns.push_back(place[row.columns[k]]);
        size += rows.n_rows * padded<Number>(row.length);
        widest = std::max(widest, padded<Number>(row.length));
      }
    entries.resize(size);
    gathered.resize(widest);
    Number *entry = entries.data();
    for (const Group &group : groups)
      for (int i = 0; i < group.rows.n_rows; ++i)
        {
          const EpetraRow row(coupling, group.rows.first + i);
          for (int k = 0; k < row.length; ++k)
            entry[k] = static_cast<Number>(
              row.values[k] * weights.local_element(group.columns[k]));
          entry += padded<Number>(row.length);
        }

    // what any rank has a column of
    LevelVector<double> moved(layout);
    for (const unsigned int i : place)
      moved.local_element(i) = 1.;
    moved.compress(VectorOperation::add);
    for (unsigned int i = 0; i < moved.locally_owned_size(); ++i)
      if (moved.local_element(i) > 0.)
        {
          places.push_back(i);
          diagonal.push_back(
            static_cast<Number>(1. / weights.local_element(i)));
        }
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::apply() const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    Number                *v = values.begin(), *g = gathered.data();
    V                     *G     = reinterpret_cast<V *>(g);
    const V               *entry = reinterpret_cast<const V *>(entries.data());
    values.update_ghost_values();
    for (const Group &group : groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::fill(g + n, g + m, Number());
        for (unsigned int k = 0; k < n; ++k)
          g[k] = v[group.columns[k]];
        for (int i = 0; i < group.rows.n_rows; ++i, entry += m / w)
          {
            V sums = {};
            for (unsigned int k = 0; k < m / w; ++k)
              sums += entry[k] * G[k];
            Number sum = 0;
            for (unsigned int l = 0; l < w; ++l)
              sum += sums[l];
            jump[group.rows.first + i] = sum;
          }
      }
    values.zero_out_ghost_values();
    lifting.apply_inverse_schur(multiplier, jump);
    for (const unsigned int i : places)
      v[i] = 0;
    entry = reinterpret_cast<const V *>(entries.data());
    for (const Group &group : groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::fill(g, g + m, Number());
        for (int i = 0; i < group.rows.n_rows; ++i, entry += m / w)
          {
            const Number y =
              static_cast<Number>(multiplier[group.rows.first + i]);
            for (unsigned int k = 0; k < m / w; ++k)
              G[k] += y * entry[k];
          }
        for (unsigned int k = 0; k < n; ++k)
          v[group.columns[k]] += g[k];
      }
    values.compress(VectorOperation::add);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project(LevelVector<Number> &x) const
  {
    for (unsigned int k = 0; k < places.size(); ++k)
      values.local_element(places[k]) =
        diagonal[k] * x.local_element(places[k]);
    apply();
    for (const unsigned int i : places)
      x.local_element(i) -= values.local_element(i);
  }

  template <typename Number>
  void
  InterfaceCorrection<Number>::project_residual(LevelVector<Number> &r) const
  {
    for (const unsigned int i : places)
      values.local_element(i) = r.local_element(i);
    apply();
    for (unsigned int k = 0; k < places.size(); ++k)
      r.local_element(places[k]) -=
        diagonal[k] * values.local_element(places[k]);
  }

  template class InterfaceCorrection<float>;
  template class InterfaceCorrection<double>;
} // namespace mortise
