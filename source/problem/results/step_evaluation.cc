#include <mortise/problem/input/periodic_cell.h>
#include <mortise/problem/results/step_evaluation.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The cached @p value, computed by @p make the first time.
    template <typename T, typename Make>
    const T &
    once(std::optional<T> &value, const Make &make)
    {
      if (!value)
        value.emplace(make());
      return *value;
    }

    /// @p of(coupling, multiplier, comm) for all interfaces.
    template <typename Of>
    StepEvaluation::OnFaces
    on_all_faces(const StepEvaluation &step, const Of &of)
    {
      StepEvaluation::OnFaces result;
      for (const Coupling &coupling : step.discretisation.interfaces().all())
        result.push_back(
          of(coupling, step.solved.solution.multiplier, step.run.comm));
      return result;
    }
  } // namespace

  const std::vector<BodySolution> &
  StepEvaluation::solutions() const
  {
    return once(by_body, [&] {
      auto result = discretisation.solutions(solved.load, solved.solution);
      auto histories =
        discretisation.linear_system().bulk->by_cell(solved.history);
      for (unsigned int b = 0; b < histories.size(); ++b)
        result[b].history = std::move(histories[b]);
      return result;
    });
  }

  const StepEvaluation::OnFaces &
  StepEvaluation::multipliers() const
  {
    return once(coefficients,
                [&] { return on_all_faces(*this, multiplier_coefficients); });
  }

  const StepEvaluation::OnFaces &
  StepEvaluation::tractions() const
  {
    return once(on_faces,
                [&] { return on_all_faces(*this, multiplier_on_faces); });
  }

  const std::vector<double> &
  StepEvaluation::gaps() const
  {
    return once(all_gaps, [&] {
      return discretisation.gaps(
        discretisation.weighted_gaps(solved.load, solved.solution));
    });
  }

  const TraceDisplacement &
  StepEvaluation::traces() const
  {
    return once(on_traces, [&] {
      return discretisation.trace_displacement(solved.load, solutions());
    });
  }

  const BoundaryForces &
  StepEvaluation::forces() const
  {
    return once(at_boundaries, [&] {
      return BoundaryForces(discretisation, solved, solutions());
    });
  }

  Offset
  StepEvaluation::offset(const unsigned int i) const
  {
    Offset result{solved.data.offset(discretisation.interfaces().sides()[i]),
                  {}};
    const double shortening =
      solved.shortenings.empty() ? 0. : solved.shortenings[i];
    if (shortening != 0.)
      result.gap = [given = result.gap, shortening](const Point<dim> &x) {
        return (given ? given(x) : 0.) + shortening;
      };
    const std::size_t n        = discretisation.interfaces().all().size();
    const Coupling   &coupling = discretisation.interfaces().all()[i];
    if (!coupling.is_turned)
      for (std::size_t j = n; j < solved.shortenings.size(); ++j)
        result.jump += solved.shortenings[j] *
                       (unit_strain(j - n) * coupling.placement.translation);
    return result;
  }

  const InterfaceEvaluation &
  StepEvaluation::evaluation_of(const unsigned int i) const
  {
    return once(of_points[i], [&] {
      const Pairing &interfaces = discretisation.interfaces();
      return evaluate_interface(interfaces.all()[i],
                                traces(),
                                tractions()[i],
                                offset(i),
                                interfaces.all()[i].law.has_friction() ?
                                  solved.data.friction(interfaces.sides()[i]) :
                                  BoundOfFriction(),
                                run.comm);
    });
  }

  double
  StepEvaluation::penetration(const unsigned int i) const
  {
    return of_points[i] ?
             of_points[i]->penetration :
             largest_penetration(discretisation.interfaces().all()[i],
                                 traces(),
                                 offset(i),
                                 run.comm);
  }
} // namespace mortise
