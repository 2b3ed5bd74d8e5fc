#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/step_results.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  StepFields
  step_fields(const RunContext     &run,
              const Discretisation &discretisation,
              const SolvedStep     &solved)
  {
    StepFields fields;
    fields.solutions = discretisation.solutions(solved.load, solved.solution);
    for (const Coupling &coupling : discretisation.interfaces().all())
      {
        const Vector &multiplier = solved.solution.multiplier;
        fields.tractions.push_back(
          multiplier_on_faces(coupling, multiplier, run.comm));
        fields.multipliers.push_back(
          multiplier_coefficients(coupling, multiplier, run.comm));
      }
    return fields;
  }

  namespace
  {
    ErrorSummary
    errors_of(const Discretisation &discretisation,
              const ExactSolution  &exact,
              const StepFields     &fields)
    {
      const Bodies         &bodies     = discretisation.bodies();
      const SceneCouplings &interfaces = discretisation.interfaces();
      const SolutionErrors  errors =
        solution_errors(bodies, fields.solutions, exact);
      ErrorSummary result;
      result.displacement_l2 = errors.displacement_l2;
      result.displacement_h1 = errors.displacement_h1;
      result.energy          = errors.energy;
      if (discretisation.linear_system().mixed())
        result.pressure_l2 = errors.pressure_l2;
      if (interfaces.all().empty())
        return result;
      std::vector<TiedBodies> tied;
      for (unsigned int i = 0; i < interfaces.all().size(); ++i)
        tied.push_back(
          {interfaces.sides()[i].slave.body, interfaces.given_slave(i)});
      result.multiplier_l2 = multiplier_error(
        bodies, interfaces.all(), tied, fields.tractions, exact);
      return result;
    }

    std::vector<double>
    components(const Tensor<1, dim> &value)
    {
      return {value[0], value[1], value[2]};
    }

    /// @p pressure, @p gap, @p active: by owned multiplier of the interface.
    ContactSummary
    contact_summary(const std::vector<NormalMultiplier>    &multipliers,
                    const double                           *pressure,
                    const double                           *gap,
                    const std::vector<bool>::const_iterator active,
                    const MPI_Comm                          comm)
    {
      ContactSummary result;
      Tensor<1, dim> force, moment;
      double         work = 0., least = std::numeric_limits<double>::max();
      for (unsigned int k = 0; k < multipliers.size(); ++k)
        {
          const NormalMultiplier &of = multipliers[k];
          least                      = std::min(least, gap[k]);
          ++(active[k] ? result.active : result.inactive);
          if (!active[k])
            continue;
          result.area += of.area;
          work += pressure[k] * of.area;
          force -= pressure[k] * of.normal;
          moment -= pressure[k] * of.moment;
          result.pressure_max = std::max(result.pressure_max, pressure[k]);
        }
      result.area          = Utilities::MPI::sum(result.area, comm);
      work                 = Utilities::MPI::sum(work, comm);
      result.pressure_mean = result.area > 0. ? work / result.area : 0.;
      result.pressure_max  = Utilities::MPI::max(result.pressure_max, comm);
      result.gap_min       = Utilities::MPI::min(least, comm);
      result.force         = components(Utilities::MPI::sum(force, comm));
      result.moment        = components(Utilities::MPI::sum(moment, comm));
      result.active        = Utilities::MPI::sum(result.active, comm);
      result.inactive      = Utilities::MPI::sum(result.inactive, comm);
      return result;
    }

    /// Displacements of vertices on one side of an interface, by component
    /// from the least to the largest.
    class MotionRange
    {
    public:
      void
      add(const Body           &body,
          const BodyVector     &displacement,
          const SideParameters &side)
      {
        for (const BoundaryFace &face :
             boundary_faces(body, body.boundary_id(side.boundary, "")))
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

    /// Throws InputError where a face without a partner could have met one.
    void
    check_partners(const RunContext     &run,
                   const Discretisation &discretisation,
                   const unsigned int    i,
                   const StepFields     &fields)
    {
      const InterfaceParameters &sides = discretisation.interfaces().sides()[i];
      const InterfaceHandler    &interface =
        *discretisation.interfaces().all()[i].interface;
      MotionRange range;
      for (const SideParameters *side : {&sides.slave, &sides.master})
        range.add(*discretisation.bodies()[side->body],
                  fields.solutions[side->body].displacement,
                  *side);
      const double       moved = range.width(run.comm);
      std::ostringstream text;
      for (unsigned int s = 0; s < interface.coverage().size(); ++s)
        if (const SurfaceFace &face = interface.slave().faces[s];
            interface.coverage()[s] < 0.99 && text.str().empty() &&
            moved > sides.search_distance * face.size)
          text << "Interface " << interface.name()
               << ": its sides move by up to " << RunLog::number(moved)
               << " against each other, but the face at "
               << interface.slave()
                    .cells[s]
                    ->face(interface.slave().face_numbers[s])
                    ->center()
               << " has looked for partners only as far as "
               << RunLog::number(sides.search_distance * face.size)
               << ", so that contact there would go unseen; allowed: a larger "
                  "Search distance, or smaller displacements";
      throw_if_any(text.str(), run.comm);
    }

    void
    add_contact(const RunContext     &run,
                const Discretisation &discretisation,
                const SolvedStep     &solved,
                const StepFields     &fields,
                StepSummary          &summary)
    {
      const auto &interfaces = discretisation.interfaces().all();
      for (unsigned int i = 0; i < interfaces.size(); ++i)
        if (interfaces[i].is_contact)
          check_partners(run, discretisation, i, fields);
      const Vector  gaps = discretisation.gaps(solved.load, solved.solution);
      const double *gap  = gaps.begin();
      const double *pressure = solved.solution.multiplier.begin();
      auto          active   = discretisation.linear_system().active->begin();
      for (unsigned int i = 0; i < interfaces.size(); ++i)
        {
          if (interfaces[i].is_contact)
            summary.interfaces[i].contact = contact_summary(
              discretisation.pressing()[i], pressure, gap, active, run.comm);
          const auto n = interfaces[i].multipliers->n_owned();
          gap += n;
          pressure += n;
          active += n;
        }
    }
  } // namespace

  void
  evaluate_step(const RunContext     &run,
                const Discretisation &discretisation,
                const SolvedStep     &solved,
                const StepFields     &fields,
                StepSummary          &summary)
  {
    const Bodies &bodies     = discretisation.bodies();
    const auto   &interfaces = discretisation.interfaces().all();
    for (unsigned int i = 0; i < interfaces.size(); ++i)
      {
        const ResultantErrors errors =
          resultant_errors(interfaces[i], solved.solution.multiplier, run.comm);
        summary.interfaces[i].force_residual  = errors.force;
        summary.interfaces[i].moment_residual = errors.moment;
      }
    if (discretisation.interfaces().have_contact())
      add_contact(run, discretisation, solved, fields, summary);
    if (const auto &exact = solved.data.exact())
      summary.errors = errors_of(discretisation, *exact, fields);
    for (const PointQuantity &quantity : run.parameters.output.points)
      {
        const auto value =
          point_value(*bodies[quantity.body],
                      fields.solutions[quantity.body].displacement,
                      quantity.point);
        if (!value)
          run.log.warning("Output/Points: " + quantity.name +
                          " lies outside of body " +
                          bodies[quantity.body]->name);
        summary.quantities.emplace_back(quantity.name,
                                        value ? components(*value) :
                                                std::vector<double>{});
      }
    for (const ResultantQuantity &quantity : run.parameters.output.resultants)
      {
        const Body &body = *bodies[quantity.body];
        summary.quantities.emplace_back(
          quantity.name,
          components(resultant(body,
                               fields.solutions[quantity.body],
                               body.boundary_id(quantity.boundary, ""))));
      }
  }
} // namespace mortise
