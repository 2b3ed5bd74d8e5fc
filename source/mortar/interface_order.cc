#include <deal.II/base/mpi.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/interface_order.h>

#include <algorithm>
#include <iterator>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A master face of which a pair covers less does not count: so little does
    /// not make constraints dependent.
    constexpr double least_share = 0.01;

    void
    add_columns(const FaceTrace &trace, IndexSet &set)
    {
      set.add_indices(trace.column.begin(), trace.column.end());
    }

    double
    area(const FullMatrix<double> &mixed,
         const TraceBasis         &rows,
         const TraceBasis         &columns)
    {
      double sum = 0.;
      for (unsigned int v = 0; v < rows.n_vertices(); ++v)
        for (unsigned int w = 0; w < columns.n_vertices(); ++w)
          sum += mixed(rows.vertex_function(v), columns.vertex_function(w));
      return sum;
    }

    void
    add_masters(const Coupling &coupling, const unsigned int s, IndexSet &set)
    {
      const InterfaceHandler &interface = *coupling.interface;
      const double            size      = interface.slave().faces[s].size;
      for (const auto &partner : coupling.local[s].partners)
        {
          const FaceTrace &trace = interface.master_traces()[partner.master];
          const double     smaller =
            std::min(size, interface.master_faces()[partner.master].size);
          if (area(partner.mixed,
                   interface.slave().traces[s].basis(),
                   trace.basis()) > least_share * smaller * smaller)
            add_columns(trace, set);
        }
    }

    /// The owned ones among those that any rank names. Collective.
    std::vector<unsigned int>
    gather(const IndexSet &owned, IndexSet &named, const MPI_Comm comm)
    {
      named.compress();
      LinearAlgebra::distributed::Vector<double> flags(owned, named, comm);
      for (const auto index : named)
        flags(index) = 1.;
      flags.compress(VectorOperation::add);
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < flags.locally_owned_size(); ++i)
        if (flags.local_element(i) > 0.)
          result.push_back(i);
      return result;
    }
  } // namespace

  InterfaceOrder::InterfaceOrder(
    const std::vector<Coupling>                  &couplings,
    const std::vector<std::vector<PartnerState>> &states,
    const FieldNumbering                         &numbering,
    const MPI_Comm                                comm)
    : is_coupled(numbering.owned().n_elements(), false)
  {
    if (couplings.size() > 1 || couplings.front().is_turned)
      for (unsigned int i = 0; i < couplings.size(); ++i)
        {
          IndexSet slave(numbering.size()), master(numbering.size());
          for (unsigned int s = 0; s < couplings[i].local.size(); ++s)
            {
              if (states[i][s].cover >= FaceCoverage::partial)
                add_columns(couplings[i].interface->slave().traces[s], slave);
              add_masters(couplings[i], s, master);
            }
          slaves.push_back(gather(numbering.owned(), slave, comm));
          masters.push_back(gather(numbering.owned(), master, comm));
          coupled_by.emplace_back();
          std::set_union(slaves.back().begin(),
                         slaves.back().end(),
                         masters.back().begin(),
                         masters.back().end(),
                         std::back_inserter(coupled_by.back()));
        }
    sort(couplings, comm);
  }

  std::vector<unsigned int>
  InterfaceOrder::on_axis(const unsigned int i) const
  {
    Displacements result;
    std::set_intersection(slaves[i].begin(),
                          slaves[i].end(),
                          masters[i].begin(),
                          masters[i].end(),
                          std::back_inserter(result));
    return result;
  }

  void
  InterfaceOrder::sort(const std::vector<Coupling> &couplings,
                       const MPI_Comm               comm)
  {
    const unsigned int n = couplings.size();
    // at i * n + k: how many displacements of slave k interface i moves
    std::vector<double> common(n * n, 0.), sizes(n, 0.);
    for (unsigned int i = 0; i < coupled_by.size(); ++i)
      for (unsigned int k = 0; k < slaves.size(); ++k)
        {
          Displacements both;
          std::set_intersection(coupled_by[i].begin(),
                                coupled_by[i].end(),
                                slaves[k].begin(),
                                slaves[k].end(),
                                std::back_inserter(both));
          common[i * n + k] = i == k ? 0. : both.size();
          sizes[k]          = slaves[k].size();
        }
    Utilities::MPI::sum(common, comm, common);
    Utilities::MPI::sum(sizes, comm, sizes);

    std::vector<unsigned int> left(n);
    for (unsigned int i = 0; i < n; ++i)
      left[i] = i;
    std::sort(left.begin(), left.end(), [&](const auto a, const auto b) {
      return couplings[a].interface->name() < couplings[b].interface->name();
    });
    const auto loss = [&](const unsigned int i) {
      double sum = 0.;
      for (const unsigned int k : left)
        sum += common[i * n + k] / std::max(1., sizes[k]);
      return sum;
    };
    while (!left.empty())
      {
        const auto first = std::min_element(left.begin(),
                                            left.end(),
                                            [&](const auto a, const auto b) {
                                              return loss(a) < loss(b);
                                            });
        sequence.push_back(*first);
        left.erase(first);
      }
  }
} // namespace mortise
