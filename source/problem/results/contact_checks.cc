// See contact_checks.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/results/contact_checks.h>
#include <mortise/problem/support/side_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Displacements of vertices on one side of an interface, by component
    /// from the least to the largest.
    class MotionRange
    {
    public:
      void
      add(const std::vector<BoundaryFace> &faces,
          const BodyVector                &displacement)
      {
        for (const BoundaryFace &face : faces)
          if (face.cell->is_locally_owned())
            {
              const auto of_face = face.cell->face(face.number);
              for (unsigned int v = 0; v < of_face->n_vertices(); ++v)
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    const double u = displacement(of_face->vertex_dof_index(
                      v, c, face.cell->active_fe_index()));
                    least[c]       = std::min(least[c], u);
                    most[c]        = std::max(most[c], u);
                  }
            }
      }

      /// The most by which two of them differ. Collective.
      double
      width(const MPI_Comm comm) const
      {
        double square = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          square += std::pow(Utilities::MPI::max(most[c], comm) -
                               Utilities::MPI::min(least[c], comm),
                             2);
        return std::sqrt(square);
      }

    private:
      static constexpr double none = std::numeric_limits<double>::max();
      std::array<double, dim> least{{none, none, none}};
      std::array<double, dim> most{{-none, -none, -none}};
    };

    /// The size of a face of the slave, the mean. Collective.
    double
    size_of_face(const Coupling &coupling, const MPI_Comm comm)
    {
      const double n = coupling.interface->slave().faces.size();
      return std::sqrt(coupling.interface->report().slave_area /
                       Utilities::MPI::sum(n, comm));
    }
  } // namespace

  double
  relative_motion(const StepEvaluation &step, const unsigned int i)
  {
    const InterfaceParameters &sides =
      step.discretisation.interfaces().sides()[i];
    MotionRange range;
    for (const SideParameters *side : {&sides.slave, &sides.master})
      range.add(side_faces(step.discretisation.bodies(), *side, ""),
                step.solutions()[side->body].displacement);
    return range.width(step.run.comm);
  }

  void
  warn_of_large_slip(const StepEvaluation &step,
                     const unsigned int    i,
                     const double          slip)
  {
    constexpr double rounding = 1e-6;
    const Coupling  &coupling = step.discretisation.interfaces().all()[i];
    const double     face     = size_of_face(coupling, step.run.comm);
    Tensor<1, dim>   normals;
    double           count = 0.;
    for (const auto &of_face : coupling.frames)
      {
        count += of_face.size();
        for (const Frame &frame : of_face)
          normals += frame[0];
      }
    normals = Utilities::MPI::sum(normals, step.run.comm);
    count   = Utilities::MPI::sum(count, step.run.comm);
    if (!coupling.is_displaced && slip > face &&
        normals.norm() < (1. - rounding) * count)
      step.run.log.warning(
        "interface " + coupling.interface->name() +
        ": the bodies slip by up to " + RunLog::number(slip) +
        ", more than a face of the slave, about " + RunLog::number(face) +
        "; normals and pairs of faces stay those of the start, which holds for less slip on a curved surface. "
        "Allowed: Sliding = finite");
  }

  void
  warn_of_large_motion(const StepEvaluation &step,
                       const unsigned int    i,
                       const double          moved)
  {
    const Pairing             &interfaces = step.discretisation.interfaces();
    const InterfaceParameters &given      = interfaces.sides()[i];
    const auto                &bodies     = step.discretisation.bodies();
    const double half = 0.5 * size_of_face(interfaces.all()[i], step.run.comm);
    if (given.follows_bodies || moved < half ||
        !(bodies[given.slave.body]->material.has_finite_strain() ||
          bodies[given.master.body]->material.has_finite_strain()))
      return;
    const double least = half * std::exp2(std::floor(std::log2(moved / half)));
    step.run.log.warning(
      "interface " + given.name + ": its sides move by more than " +
      RunLog::number(least) +
      " against each other, half a face of the slave is about " +
      RunLog::number(half) +
      ", and they keep the pairs and normals of the undeformed bodies. Allowed: Sliding = finite");
  }

  void
  check_partners(const StepEvaluation &step,
                 const unsigned int    i,
                 const double          moved)
  {
    const Pairing             &interfaces = step.discretisation.interfaces();
    const InterfaceParameters &sides      = interfaces.sides()[i];
    const InterfaceHandler    &interface  = *interfaces.all()[i].interface;
    std::ostringstream         text;
    for (unsigned int s = 0; s < interface.coverage().size(); ++s)
      if (const SurfaceFace &face = interface.slave().faces[s];
          interface.coverage()[s] < 0.99 && text.str().empty() &&
          moved > sides.search_distance.of(face.size))
        text
          << "Interface " << interface.name() << ": its sides move by up to "
          << RunLog::number(moved) << " against each other, but the face at "
          << interface.slave()
               .cells[s]
               ->face(interface.slave().face_numbers[s])
               ->center()
          << " has partners only up to the distance "
          << RunLog::number(sides.search_distance.of(face.size))
          << ", beyond which contact would go unseen; allowed: a larger Search distance, or smaller displacements";
    throw_if_any(text.str(), step.run.comm);
  }
} // namespace mortise
