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
                      const GapOfSurfaces     &gap,
                      const MPI_Comm           comm)
  {
    InterfaceHandler &interface = *coupling.interface;
    DisplacementJump  jump_at(interface, displacement, comm);
    double            largest = 0.;
    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      jump_at.reinit(s);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Point<2> xi(points.slave_xi[0][q], points.slave_xi[1][q]);
          const auto     normal = face_normal(interface.slave().faces[s], xi);
          largest =
            std::max(largest,
                     -gap.open(points, q, normal, jump_at(m, points, q)));
        }
    });
    return Utilities::MPI::max(largest, comm);
  }
} // namespace mortise
