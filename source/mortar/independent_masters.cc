#include "independent_masters.h"

#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Fewest iterations: doc/measurements/tuning.md.
    constexpr double penalty_factor = 1.8;

    /// Of the layer of cells behind a face; layers one behind the other add up.
    double
    compliance(const FaceTrace &trace)
    {
      return trace.depth / (2. * penalty_factor * trace.modulus);
    }

    /// A face whose displacement is prescribed does not give way.
    bool
    is_held(const FaceTrace &trace)
    {
      return trace.column.empty();
    }

    /// Of the layers on both sides; an independent master has none.
    double
    compliance(const FaceTrace &slave,
               const FaceTrace &master,
               const bool       is_independent)
    {
      if (is_independent || is_held(master))
        return compliance(slave);
      return compliance(master) + (is_held(slave) ? 0. : compliance(slave));
    }

    /// Nodes on an area, but for a factor that all shapes share.
    double
    density(const SurfaceFace &face, const FaceTrace &trace)
    {
      return trace.degree * trace.degree /
             cross_product_3d(face.frame.tangent[0], face.frame.tangent[1])
               .norm();
    }

    /// How many times as many nodes on an area a slave needs at least to
    /// follow. Where multipliers do not move the master's nodes, those that
    /// meet on a large face do not couple with each other, but two projections
    /// are needed in place of one: doc/measurements/tuning.md.
    double
    least_density_ratio(const unsigned int degree)
    {
      return degree == 1 ? 16. : 3.;
    }

    /// A slave that is stiffer than this follows badly where it is covered in
    /// part: doc/measurements/tuning.md.
    constexpr double largest_modulus_ratio = 100.;

    /// Nodes with dual multipliers follow at no cost, so that they do wherever
    /// that takes no more than one iteration: doc/measurements/tuning.md.
    constexpr double       largest_dual_modulus_ratio = 4.;
    constexpr unsigned int largest_dual_degree        = 4;

    bool
    is_independent(const InterfaceHandler &interface,
                   const LocalCoupling    &local,
                   const unsigned int      s,
                   const unsigned int      m)
    {
      const FaceTrace &slave  = interface.slave().traces[s];
      const FaceTrace &master = interface.master_traces()[m];
      if (slave.nodes.empty())
        return false;
      const double ratio = slave.modulus / master.modulus;
      return (local.is_dual() && slave.degree <= largest_dual_degree &&
              ratio <= largest_dual_modulus_ratio) ||
             (ratio <= largest_modulus_ratio &&
              density(interface.slave().faces[s], slave) >
                least_density_ratio(slave.degree) *
                  density(interface.master_faces()[m], master));
    }
  } // namespace

  void
  set_independent_masters(const InterfaceHandler &interface,
                          const unsigned int      s,
                          const bool              may_be_independent,
                          LocalCoupling          &local)
  {
    local.penalty = std::numeric_limits<double>::infinity();
    for (auto &partner : local.partners)
      {
        partner.is_independent =
          may_be_independent &&
          is_independent(interface, local, s, partner.master);
        const FaceTrace &slave  = interface.slave().traces[s];
        const FaceTrace &master = interface.master_traces()[partner.master];
        local.penalty =
          std::min(local.penalty,
                   1. / compliance(slave, master, partner.is_independent));
      }
  }
} // namespace mortise
