// See independent_displacements.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/coupled_faces.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/operators/levels/independent_displacements.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    bool
    has_independent_master(const LocalCoupling &local)
    {
      return std::any_of(local.partners.begin(),
                         local.partners.end(),
                         [](const auto &partner) {
                           return partner.is_independent;
                         });
    }

    /// The node whose value function @p k of a face has; none where it hangs.
    std::optional<NodalSpace::Index>
    node_of(const FaceNodes &face, const unsigned int k)
    {
      if (!face.hang())
        return face.nodes[k];
      const unsigned int e = face.begin[k];
      if (face.begin[k + 1] == e + 1 && face.weight[e] == 1.)
        return face.nodes[face.column[e]];
      return {};
    }

    /// Values at the nodes of slave face @p s, which follow from those of each
    /// partner: the projection, or the mean where the face is covered in part.
    std::vector<FullMatrix<double>>
    follow(const Coupling &coupling, const unsigned int s)
    {
      const LocalCoupling &local = coupling.local[s];
      const FaceTrace     &slave = coupling.interface->slave().traces[s];
      const BlockSide      side{slave.shape, slave.degree, slave.degree};
      FullMatrix<double>   from_moments = nodal_block(local.mass, side, side);
      if (face_coverage(coupling.interface->coverage()[s], true) ==
          FaceCoverage::full)
        from_moments.gauss_jordan();
      else
        {
          double area = 0.; // functions sum to one
          for (unsigned int i = 0; i < from_moments.m(); ++i)
            for (unsigned int j = 0; j < from_moments.n(); ++j)
              area += from_moments(i, j);
          for (unsigned int i = 0; i < from_moments.m(); ++i)
            for (unsigned int j = 0; j < from_moments.n(); ++j)
              from_moments(i, j) = 1. / area;
        }
      std::vector<FullMatrix<double>> result;
      for (const auto &partner : local.partners)
        {
          const FaceTrace &master =
            coupling.interface->master_traces()[partner.master];
          const FullMatrix<double> moments = resolve_hanging(
            nodal_block(partner.mixed,
                        side,
                        {master.shape, master.degree, master.degree}),
            FaceNodes(),
            master.nodes[0]);
          result.emplace_back(moments.m(), moments.n());
          from_moments.mmult(result.back(), moments);
        }
      return result;
    }

    /// By displacement; ghosts, too.
    class SlaveNodes
    {
    public:
      /// @p layout: interface_layout().
      SlaveNodes(
        const MultigridLevel                                     &level,
        const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
        const LevelVector<double>                                &diagonal,
        const std::vector<Coupling>                              &couplings)
        : stiffness(layout)
        , n_faces(stiffness)
        , n_interfaces(stiffness)
        , is_free(stiffness)
      {
        for (const Coupling &coupling : couplings)
          count(coupling);
        for_each_face(couplings,
                      [&](const Coupling &coupling, const unsigned int s) {
                        const FaceTrace &slave =
                          coupling.interface->slave().traces[s];
                        for (const auto node : slave.nodes[0].nodes)
                          n_faces(dim * node) += 1.;
                      });
        n_faces.compress(VectorOperation::add);
        std::copy_n(diagonal.begin(),
                    diagonal.locally_owned_size(),
                    stiffness.begin());
        is_free = 1.;
        for (const unsigned int index : level.constrained)
          is_free.local_element(index) = 0.;
        // one number for a node: that of a component that is not constrained,
        // where it is no more than a 1
        for (unsigned int i = 0; i < diagonal.locally_owned_size(); i += dim)
          {
            double of_node = 0.;
            for (unsigned int c = 0; c < dim; ++c)
              if (is_free.local_element(i + c) > 0.)
                of_node = stiffness.local_element(i + c);
            stiffness.local_element(i) = of_node;
          }
        for (const auto *vector :
             {&stiffness, &n_faces, &n_interfaces, &is_free})
          vector->update_ghost_values();
      }

      /// K_ii over the number of slave faces that share node i.
      double
      share(const NodalSpace::Index node) const
      {
        return stiffness(dim * node) / n_faces(dim * node);
      }

      bool
      is_slave(const NodalSpace::Index node) const
      {
        return n_faces(dim * node) > 0.;
      }

      /// Has each component a node that is free, and does no other interface
      /// move any?
      bool
      has_free_displacement(const FaceNodes &face) const
      {
        if (std::any_of(face.nodes.begin(),
                        face.nodes.end(),
                        [&](const auto node) {
                          return n_interfaces(dim * node) > 1.;
                        }))
          return false;
        for (unsigned int c = 0; c < dim; ++c)
          if (std::none_of(face.nodes.begin(),
                           face.nodes.end(),
                           [&](const auto node) {
                             return is_free(dim * node + c) > 0.;
                           }))
            return false;
        return true;
      }

    private:
      /// The nodes that @p coupling moves.
      void
      count(const Coupling &coupling)
      {
        LevelVector<double> moved(n_interfaces);
        moved           = 0.;
        const auto mark = [&](const FaceTrace &trace) {
          for (const auto node : trace.nodes[0].nodes)
            moved(dim * node) = 1.;
        };
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          for (const auto &partner : coupling.local[s].partners)
            {
              mark(coupling.interface->slave().traces[s]);
              mark(coupling.interface->master_traces()[partner.master]);
            }
        moved.compress(VectorOperation::add);
        for (unsigned int i = 0; i < moved.locally_owned_size(); ++i)
          if (moved.local_element(i) > 0.)
            n_interfaces.local_element(i) += 1.;
      }

      LevelVector<double> stiffness, n_faces, n_interfaces, is_free;
    };
  } // namespace

  std::vector<IndependentDisplacement>
  find_independent_displacements(const MultigridLevel        &level,
                                 const LevelVector<double>   &diagonal,
                                 const std::vector<Coupling> &couplings)
  {
    bool any_independent = false;
    for_each_face(couplings,
                  [&](const Coupling &coupling, const unsigned int s) {
                    any_independent = any_independent ||
                                      has_independent_master(coupling.local[s]);
                  });
    if (Utilities::MPI::max(any_independent ? 1 : 0,
                            level.layout->get_mpi_communicator()) == 0)
      return {};
    const auto       layout = interface_layout(level, 0, couplings);
    const SlaveNodes slaves(level, layout, diagonal, couplings);
    // the first by displacement, the others by node, at its first component
    LevelVector<double> sums(layout), is_independent(sums), stays(sums);
    for_each_face(
      couplings, [&](const Coupling &coupling, const unsigned int s) {
        const FaceTrace &slave    = coupling.interface->slave().traces[s];
        const auto      &partners = coupling.local[s].partners;
        const auto      &masters  = coupling.interface->master_traces();
        const bool       has_independent_master =
                     mortise::has_independent_master(coupling.local[s]),
                   has_free_displacement =
                     slaves.has_free_displacement(slave.nodes[0]);
        if (!has_independent_master && has_free_displacement)
          return;
        const auto share_of = [&](const LocalCoupling::Partner &partner,
                                  const unsigned int            c) {
          return coupling.law.constrained == ConstrainedDirections::all ?
                   1. :
                   std::pow(coupling.interface->master_faces()[partner.master]
                              .frame.normal[c],
                            2);
        };
        std::vector<FullMatrix<double>> following;
        if (has_independent_master)
          following = follow(coupling, s);
        for (unsigned int k = 0; k < partners.size(); ++k)
          {
            const auto &nodes = masters[partners[k].master].nodes[0].nodes;
            for (unsigned int j = 0; j < nodes.size(); ++j)
              {
                double sum = 0.;
                for (unsigned int i = 0;
                     has_independent_master && i < slave.n_functions();
                     ++i)
                  if (const auto node = node_of(slave.nodes[0], i); node)
                    sum +=
                      slaves.share(*node) * std::pow(following[k](i, j), 2);
                for (unsigned int c = 0; c < dim; ++c)
                  sums(dim * nodes[j] + c) += share_of(partners[k], c) * sum;
                if (!has_free_displacement)
                  stays(dim * nodes[j]) = 1.;
                else if (partners[k].is_independent)
                  is_independent(dim * nodes[j]) = 1.;
              }
          }
      });
    for (auto *vector : {&sums, &is_independent, &stays})
      vector->compress(VectorOperation::add);
    std::vector<bool> is_constrained(diagonal.locally_owned_size());
    for (const unsigned int index : level.constrained)
      is_constrained[index] = true;
    std::vector<IndependentDisplacement> result;
    const auto first = level.layout->local_range().first;
    for (unsigned int i = 0; i < is_constrained.size(); ++i)
      if (const unsigned int node = i - i % dim;
          !is_constrained[i] && is_independent.local_element(node) > 0. &&
          stays.local_element(node) == 0. &&
          !slaves.is_slave((first + node) / dim))
        result.push_back({i, sums.local_element(i)});
    return result;
  }
} // namespace mortise
