// See penetration.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/penetration.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const Offset            &offset,
                      const MPI_Comm           comm)
  {
    InterfaceHandler &interface = *coupling.interface;
    InterfacePoints   point_at(interface, displacement, offset, comm);
    double            largest = 0.;
    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      point_at.reinit(s);
      for (unsigned int q = 0; q < points.size(); ++q)
        largest = std::max(largest, -coupling.law.gap(point_at(m, points, q)));
    });
    return Utilities::MPI::max(largest, comm);
  }
} // namespace mortise
