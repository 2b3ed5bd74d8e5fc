#include <deal.II/base/mpi.h>

#include <mortise/body/spaces/numbering.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  FieldNumbering::FieldNumbering(
    const std::vector<const DoFHandler<3> *> &handlers,
    const MPI_Comm                            comm)
    : n_bodies(handlers.size())
    , body_start(handlers.size())
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int me      = Utilities::MPI::this_mpi_process(comm);

    std::vector<std::vector<Index>> n_owned(n_bodies);
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        n_owned[b] = Utilities::MPI::all_gather(
          comm, handlers[b] ? Index(handlers[b]->n_locally_owned_dofs()) : 0);
        body_start[b].assign(n_ranks + 1, 0);
        for (unsigned int r = 0; r < n_ranks; ++r)
          body_start[b][r + 1] = body_start[b][r] + n_owned[b][r];
      }

    Index next = 0, mine = 0, mine_end = 0;
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        if (r == me)
          mine = next;
        for (unsigned int b = 0; b < n_bodies; ++b)
          {
            system_start.push_back(next);
            next += n_owned[b][r];
          }
        if (r == me)
          mine_end = next;
      }
    owned_set.set_size(next);
    owned_set.add_range(mine, mine_end);
    owned_set.compress();
  }

  unsigned int
  FieldNumbering::owner(const unsigned int body, const Index dof) const
  {
    // the last rank whose first dof is not larger; empty ranks share the start
    // of their successor
    const auto &start = body_start[body];
    Assert(dof < start.back(), ExcIndexRange(dof, 0, start.back()));
    return std::upper_bound(start.begin(), start.end(), dof) - start.begin() -
           1;
  }

  void
  FieldNumbering::add_to(const unsigned int body,
                         const IndexSet    &body_set,
                         IndexSet          &scene_set) const
  {
    for (auto interval = body_set.begin_intervals();
         interval != body_set.end_intervals();
         ++interval)
      {
        // split at the boundaries of ranks, where the numbering jumps
        Index       first = *interval->begin();
        const Index end   = interval->last() + 1;
        while (first < end)
          {
            const Index stop =
              std::min<Index>(end, body_start[body][owner(body, first) + 1]);
            const Index image = (*this)(body, first);
            scene_set.add_range(image, image + (stop - first));
            first = stop;
          }
      }
  }
} // namespace mortise
