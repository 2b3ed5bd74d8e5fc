// See weak_jumps.h.
#include <deal.II/base/exceptions.h>

#include <Epetra_Import.h>
#include <mortise/operators/levels/weak_jumps.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// f of the header.
    constexpr double strength = 300.;

    /// The rows of the scalar matrix that the owned multipliers of @p B move; with frames some may
    /// be of other ranks.
    struct ScalarRows
    {
      /// Of row @p i of B_c: a global row of the scalar matrix, and a component.
      struct Row
      {
        int          scalar;
        unsigned int component;
      };

      explicit ScalarRows(const CouplingMatrix &B);

      const Epetra_CrsMatrix &
      matrix() const
      {
        return imported ? *imported : own;
      }

      /// By column of the frames, or row of B_c without.
      std::vector<Row> rows;

    private:
      const Epetra_CrsMatrix           &own;
      std::unique_ptr<Epetra_CrsMatrix> imported;
    };

    ScalarRows::ScalarRows(const CouplingMatrix &B)
      : own(B.scalar())
    {
      const Epetra_Map  &map = own.RowMap();
      Epetra_MultiVector all(map, 2); // integers, which doubles hold
      for (int i = 0; i < map.NumMyElements(); ++i)
        {
          all[0][i] = map.GID(B.representative(i));
          all[1][i] = B.component(i);
        }
      const auto take = [this](const Epetra_MultiVector &from) {
        for (int i = 0; i < from.MyLength(); ++i)
          rows.push_back({static_cast<int>(from[0][i]),
                          static_cast<unsigned int>(from[1][i])});
      };
      if (!B.has_frames() || B.frames().Importer() == nullptr)
        {
          take(all);
          return;
        }
      Epetra_MultiVector on_frames(B.frames().ColMap(), 2);
      on_frames.Import(all, *B.frames().Importer(), Insert);
      take(on_frames);
      std::set<int> needed;
      for (const Row &row : rows)
        needed.insert(row.scalar);
      const std::vector<int> numbers(needed.begin(), needed.end());
      const Epetra_Map       target(
        -1, static_cast<int>(numbers.size()), numbers.data(), 0, map.Comm());
      imported = std::make_unique<Epetra_CrsMatrix>(Copy, target, 0);
      imported->Import(own, Epetra_Import(target, map), Insert);
      imported->FillComplete(own.DomainMap(), map);
    }

    class JumpFinder
    {
    public:
      JumpFinder(const CouplingMatrix                   &B,
                 const LevelVector<double>              &diagonal,
                 const Epetra_Vector                    *compliance,
                 const std::optional<std::vector<bool>> &active)
        : B(B)
        , compliance(compliance)
        , active(active)
        , scalar(B)
        , flexibility(on_columns(diagonal))
      {}

      std::vector<WeakJump>
      run()
      {
        const Epetra_CrsMatrix &rows = scalar.matrix();
        if (B.has_frames())
          for (int k = 0; k < B.frames().NumMyRows(); ++k)
            add_in_frame(k);
        else
          for (int i = 0; i < rows.NumMyRows(); ++i)
            {
              Tensor<1, dim> direction;
              direction[scalar.rows[i].component] = 1.;
              add(i, {{rows.LRID(scalar.rows[i].scalar), direction}});
            }
        std::vector<WeakJump> jumps;
        for (const auto &[row, stiffness] : stiffnesses)
          {
            jumps.push_back({{}, stiffness});
            const View view = row_of(rows, row);
            for (int k = 0; k < view.length; ++k)
              jumps.back().entries.emplace_back(rows.GCID(view.columns[k]),
                                                view.values[k]);
          }
        return jumps;
      }

    private:
      struct View
      {
        int     length = 0, *columns = nullptr;
        double *values = nullptr;
      };

      static View
      row_of(const Epetra_CrsMatrix &A, const int i)
      {
        View view;
        A.ExtractMyRowView(i, view.length, view.values, view.columns);
        return view;
      }

      Epetra_MultiVector
      on_columns(const LevelVector<double> &diagonal) const
      {
        std::vector<double> inverse;
        for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
          inverse.push_back(1. / diagonal.local_element(i));
        return B.on_columns(inverse.data(), scalar.matrix());
      }

      /// A multiplier that moves along R_ki the row i of B_c.
      void
      add_in_frame(const int k)
      {
        std::map<int, Tensor<1, dim>> directions;
        const View                    view = row_of(B.frames(), k);
        for (int e = 0; e < view.length; ++e)
          {
            const auto &row = scalar.rows[view.columns[e]];
            directions[scalar.matrix().LRID(row.scalar)][row.component] +=
              view.values[e];
          }
        add(k, directions);
      }

      /// Multiplier @p k, by rows of the scalar matrix.
      void
      add(const int k, const std::map<int, Tensor<1, dim>> &directions)
      {
        if (active && !(*active)[k])
          return;
        double square = 0., least = std::numeric_limits<double>::max();
        for (const auto &[row, direction] : directions)
          {
            const View view = row_of(scalar.matrix(), row);
            for (int e = 0; e < view.length; ++e)
              for (unsigned int c = 0; c < dim; ++c)
                if (const double value = direction[c] * view.values[e],
                    of_node            = flexibility[c][view.columns[e]];
                    value != 0. && of_node > 0.)
                  {
                    square += value * value;
                    least = std::min(least, of_node);
                  }
          }
        if (!(square > 0.))
          return;
        const double given    = compliance == nullptr ? 0. : (*compliance)[k];
        const double softness = square * least / strength + given;
        for (const auto &[row, direction] : directions)
          stiffnesses[row] += outer_product(direction, direction) / softness;
      }

      const CouplingMatrix                   &B;
      const Epetra_Vector                    *compliance;
      const std::optional<std::vector<bool>> &active;
      const ScalarRows                        scalar;
      const Epetra_MultiVector                flexibility;
      std::map<int, Tensor<2, dim>>           stiffnesses; ///< by scalar row
    };
  } // namespace

  std::vector<WeakJump>
  find_weak_jumps(const CouplingMatrix                   &coupling,
                  const LevelVector<double>              &diagonal,
                  const Epetra_Vector                    *compliance,
                  const std::optional<std::vector<bool>> &active)
  {
    return JumpFinder(coupling, diagonal, compliance, active).run();
  }

  std::vector<types::global_dof_index>
  nodes_beside_flat_bodies(const std::vector<WeakJump> &jumps,
                           const NodalSpace            &space,
                           const std::vector<bool>     &flat,
                           const MPI_Comm               comm)
  {
    std::vector<types::global_dof_index> nodes;
    for (const WeakJump &jump : jumps)
      for (const auto &entry : jump.entries)
        nodes.push_back(entry.first);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    IndexSet relevant(space.owned_nodes().size());
    relevant.add_indices(nodes.begin(), nodes.end());
    LevelVector<double> is_flat(space.owned_nodes(), relevant, comm);
    space.for_each_cell(
      [&](const Body &body, const auto &, const auto &of_cell) {
        for (const auto node : of_cell)
          if (flat[body.index] && space.owned_nodes().is_element(node))
            is_flat(node) = 1.;
      });
    is_flat.update_ghost_values();
    std::vector<types::global_dof_index> result;
    for (const WeakJump &jump : jumps)
      {
        const auto is = [&](const auto &entry) {
          return is_flat(entry.first) != 0.;
        };
        if (std::any_of(jump.entries.begin(), jump.entries.end(), is))
          for (const auto &entry : jump.entries)
            if (!is(entry))
              result.push_back(entry.first);
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
} // namespace mortise
