#include <deal.II/base/mpi.h>

#include <mortise/mortar/isolated_vertices.h>

#include <algorithm>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr double not_isolated = -1.;
  }

  IsolatedVertices::IsolatedVertices(const Body                        &body,
                                     const std::vector<MultiplierFace> &faces,
                                     const std::map<Index, bool> &any_free)
    : owned(body.dof_handler.locally_owned_dofs())
  {
    const MPI_Comm comm = body.triangulation().get_communicator();
    if (Utilities::MPI::max(any_free.size(), comm) == 0)
      return;
    smallest.reinit(owned, body.relevant_dofs, comm);
    follow.reinit(smallest);
    smallest = not_isolated;
    for (const auto &[dof, follows] : any_free)
      if (owned.is_element(dof))
        {
          smallest(dof) = dof;
          follow(dof)   = follows ? 1. : 0.;
        }
    do
      exchange();
    while (Utilities::MPI::max(spread(faces) ? 1 : 0, comm) > 0);
    exchange();
  }

  void
  IsolatedVertices::add_representatives(IndexSet &set) const
  {
    if (follow.size() == 0)
      return;
    for (const auto dof : owned)
      if (follow(dof) != 0.)
        set.add_index(static_cast<Index>(smallest(dof)));
    set.compress();
  }

  bool
  IsolatedVertices::spread(const std::vector<MultiplierFace> &faces)
  {
    const auto state = [&](const Index dof) -> std::pair<double, double> & {
      return states.try_emplace(dof, smallest(dof), follow(dof)).first->second;
    };
    bool again = true, changed = false;
    while (again)
      {
        again = false;
        for (const MultiplierFace &face : faces)
          for (unsigned int c = 0; c < dim; ++c)
            {
              std::pair<double, double> best(
                std::numeric_limits<double>::infinity(), 0.);
              const auto visit = [&](const auto &action) {
                for (unsigned int v = 0; v < face.basis->n_vertices(); ++v)
                  if (auto &s =
                        state(face.dofs[c][face.basis->vertex_function(v)]);
                      s.first != not_isolated)
                    action(s);
              };
              visit([&](const auto &s) {
                best = {std::min(best.first, s.first),
                        std::max(best.second, s.second)};
              });
              visit([&](auto &s) {
                again = again || s != best;
                s     = best;
              });
            }
        changed = changed || again;
      }
    smallest.zero_out_ghost_values();
    follow.zero_out_ghost_values();
    for (const auto &[dof, s] : states)
      if (owned.is_element(dof))
        {
          smallest(dof) = s.first;
          follow(dof)   = s.second;
        }
    return changed;
  }
} // namespace mortise
