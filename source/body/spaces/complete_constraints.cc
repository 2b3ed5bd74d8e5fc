#include <deal.II/base/mpi.h>

#include <mortise/body/spaces/hp_constraints.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Dofs = std::vector<types::global_dof_index>;

    /// Constraint lines as flat arrays, to be sent.
    struct FlatLines
    {
      Dofs                      dofs;            ///< constrained
      std::vector<double>       inhomogeneities; ///< of each
      std::vector<unsigned int> n_entries;       ///< of each
      Dofs                columns; ///< of all entries, one line after the other
      std::vector<double> weights; ///< of all entries

      void
      add(const AffineConstraints<double>::ConstraintLine &line)
      {
        dofs.push_back(line.index);
        inhomogeneities.push_back(line.inhomogeneity);
        n_entries.push_back(line.entries.size());
        for (const auto &[column, weight] : line.entries)
          {
            columns.push_back(column);
            weights.push_back(weight);
          }
      }

      void
      append(const FlatLines &other)
      {
        const auto join = [](auto &to, const auto &from) {
          to.insert(to.end(), from.begin(), from.end());
        };
        join(dofs, other.dofs);
        join(inhomogeneities, other.inhomogeneities);
        join(n_entries, other.n_entries);
        join(columns, other.columns);
        join(weights, other.weights);
      }

      void
      write_to(AffineConstraints<double> &constraints) const
      {
        std::size_t next = 0;
        for (std::size_t i = 0; i < dofs.size(); ++i)
          {
            constraints.add_line(dofs[i]);
            constraints.set_inhomogeneity(dofs[i], inhomogeneities[i]);
            for (unsigned int e = 0; e < n_entries[i]; ++e, ++next)
              constraints.add_entry(dofs[i], columns[next], weights[next]);
          }
      }

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &dofs &inhomogeneities &n_entries &columns &weights;
      }
    };

    /// The lines of @p constraints for those of @p requested that are constrained.
    FlatLines
    find_lines(
      const std::map<types::global_dof_index,
                     const AffineConstraints<double>::ConstraintLine *> &lines,
      const Dofs &requested)
    {
      FlatLines found;
      for (const types::global_dof_index dof : requested)
        {
          const auto line = lines.find(dof);
          if (line != lines.end())
            found.add(*line->second);
        }
      return found;
    }

    /// Requested degrees of freedom by the rank that owns them.
    std::map<unsigned int, Dofs>
    sort_by_owner(const Dofs     &requested,
                  const IndexSet &owned,
                  const MPI_Comm  comm)
    {
      IndexSet set(owned.size());
      set.add_indices(requested.begin(), requested.end());
      const std::vector<unsigned int> owners =
        Utilities::MPI::compute_index_owner(owned, set, comm);
      std::map<unsigned int, Dofs> by_owner;
      unsigned int                 place = 0;
      for (const types::global_dof_index dof : set)
        by_owner[owners[place++]].push_back(dof);
      return by_owner;
    }
    /// Sorted, each once, without those that this rank owns (which it knows
    /// anyway).
    Dofs
    without_owned(Dofs dofs, const IndexSet &owned)
    {
      std::sort(dofs.begin(), dofs.end());
      dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
      dofs.erase(std::remove_if(dofs.begin(),
                                dofs.end(),
                                [&](const auto dof) {
                                  return owned.is_element(dof);
                                }),
                 dofs.end());
      return dofs;
    }
  } // namespace

  void
  complete_constraints(const DoFHandler<3>       &dof_handler,
                       AffineConstraints<double> &constraints)
  {
    const MPI_Comm comm = dof_handler.get_communicator();
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    IndexSet        known = constraints.get_local_lines();

    // What owners say is final: it replaces what this rank had found for the
    // same line.
    std::map<types::global_dof_index,
             const AffineConstraints<double>::ConstraintLine *>
              own;
    FlatLines all;
    for (const auto &line : constraints.get_lines())
      if (owned.is_element(line.index))
        {
          own.emplace(line.index, &line);
          all.add(line);
        }

    IndexSet wanted = known;
    wanted.subtract_set(owned);
    Dofs requested;
    wanted.fill_index_vector(requested);
    while (Utilities::MPI::max(requested.size(), comm) > 0)
      {
        const auto questions =
          Utilities::MPI::some_to_some(comm,
                                       sort_by_owner(requested, owned, comm));
        std::map<unsigned int, FlatLines> answers;
        for (const auto &[rank, dofs] : questions)
          answers[rank] = find_lines(own, dofs);
        requested.clear();
        for (const auto &[rank, lines] :
             Utilities::MPI::some_to_some(comm, answers))
          {
            all.append(lines);
            // New masters may be constrained themselves: ask in the next round.
            for (const types::global_dof_index column : lines.columns)
              if (!known.is_element(column))
                requested.push_back(column);
          }
        requested = without_owned(requested, owned);
        known.add_indices(requested.begin(), requested.end());
      }

    constraints.reinit(known);
    all.write_to(constraints);
  }
} // namespace mortise
