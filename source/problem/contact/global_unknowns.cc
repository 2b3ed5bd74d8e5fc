#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/input/periodic_cell.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Cosine in the mean between normals and their mean.
    constexpr double flat = 0.99;
  } // namespace

  GlobalUnknowns::GlobalUnknowns(const RunContext     &run,
                                 const Discretisation &discretisation,
                                 LinearSolver         &solver)
    : run(run)
    , discretisation(discretisation)
    , solver(solver)
  {
    const Pairing &couplings = discretisation.interfaces();
    for (unsigned int i = 0; i < couplings.all().size(); ++i)
      if (const InterfaceParameters &given = couplings.sides()[i];
          given.preload)
        {
          const Coupling &coupling = couplings.all()[i];
          Tensor<1, dim>  sum;
          double          number = 0.;
          for (const auto &of_face : coupling.frames)
            for (const Frame &frame : of_face)
              {
                sum += frame[0];
                number += 1.;
              }
          const auto n_patches =
            std::count_if(couplings.sides().begin(),
                          couplings.sides().end(),
                          [&](const InterfaceParameters &other) {
                            return other.name == given.name;
                          });
          if (n_patches > 1)
            run.parameters.fail("Interface " + given.name + "/Preload",
                                "an interface with edges, in " +
                                  std::to_string(n_patches) + " smooth patches",
                                "a nearly flat interface");
          sum    = Utilities::MPI::sum(sum, run.comm);
          number = Utilities::MPI::sum(number, run.comm);
          if (sum.norm() < flat * number)
            run.parameters.fail(
              "Interface " + given.name + "/Preload",
              "an interface whose normals differ (their mean has length " +
                RunLog::number(sum.norm() / number) + ")",
              "a nearly flat interface, whose normal is the direction of the force");
          indices.push_back(i);
          values.push_back(0.);
        }
    if (!translations(run.parameters).empty())
      {
        volume = cell_volume(run.parameters);
        if (volume == 0.)
          volume = discretisation.volume();
        values.resize(indices.size() + run.parameters.mean_strain.size());
      }
    first_motion = values.size();
    forces.resize(first_motion);
    all.resize(first_motion);
    pair_again();
    find_enclosure();
  }

  void
  GlobalUnknowns::pair_again()
  {
    for (unsigned int j = 0; j < first_motion; ++j)
      {
        all[j].rhs  = discretisation.linear_system().zero_vector();
        Vector &gap = all[j].rhs.multiplier;
        if (j < indices.size())
          add_offset(
            discretisation.interfaces().all()[indices[j]],
            [](const Point<dim> &) { return 1.; },
            gap);
        else
          for (const Coupling &coupling : discretisation.interfaces().all())
            if (!coupling.is_turned)
              add_jump(coupling,
                       unit_strain(j - indices.size()) *
                         coupling.placement.translation,
                       gap);
      }
    for (unsigned int j = first_motion; j < all.size(); ++j)
      set_lift(all[j]);
    for (Unknown &unknown : all)
      unknown.has_x = unknown.known = false;
  }

  void
  GlobalUnknowns::add_shortenings(SceneLoad &load) const
  {
    for (unsigned int j = 0; j < first_motion; ++j)
      load.rhs.multiplier.add(values[j], all[j].rhs.multiplier);
  }

  std::vector<bool>
  GlobalUnknowns::have_forces() const
  {
    std::vector<bool> result(discretisation.interfaces().all().size(), false);
    for (unsigned int j = 0; j < indices.size(); ++j)
      result[indices[j]] = forces[j].has_value();
    return result;
  }

  void
  GlobalUnknowns::store(State &state) const
  {
    state.shortenings.assign(discretisation.interfaces().all().size(), 0.);
    for (unsigned int j = 0; j < indices.size(); ++j)
      state.shortenings[indices[j]] = values[j];
    state.shortenings.insert(state.shortenings.end(),
                             values.begin() + indices.size(),
                             values.begin() + first_motion);
    state.motions.clear();
    for (const Motion &motion : at)
      state.motions.insert(state.motions.end(), motion.begin(), motion.end());
  }

  double
  GlobalUnknowns::work(const std::vector<double> &d,
                       const Vector              &opening) const
  {
    double sum = 0.;
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j])
        sum +=
          *forces[j] * (j < first_motion ? part_of_opening(j, opening) : d[j]);
    return sum;
  }

  void
  GlobalUnknowns::add_gaps(const std::vector<double> &d,
                           const double               factor,
                           Vector                    &gaps) const
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      gaps.add(factor * d[j], all[j].rhs.multiplier);
  }

  double
  GlobalUnknowns::part_of_opening(const unsigned int j,
                                  const Vector      &opening) const
  {
    const Vector &w      = all[j].rhs.multiplier;
    const double  square = w * w;
    return square > 0. ? (w * opening) / square : 0.;
  }

  double
  GlobalUnknowns::product(const unsigned int j, const SystemVector &x) const
  {
    const Unknown &unknown = all[j];
    double         result  = 0.;
    if (unknown.is_motion())
      {
        result += unknown.rhs.displacement * x.displacement;
        if (x.pressure.size() > 0)
          result += unknown.rhs.pressure * x.pressure;
      }
    if (x.multiplier.size() > 0)
      result += unknown.rhs.multiplier * x.multiplier;
    return result;
  }

  double
  GlobalUnknowns::force(const unsigned int j, const SystemVector &x) const
  {
    return -product(j, x);
  }

  void
  GlobalUnknowns::begin(const SceneData &data,
                        const State     &last,
                        SceneLoad       &load)
  {
    const unsigned int n = discretisation.interfaces().all().size();
    for (unsigned int j = 0; j < first_motion; ++j)
      {
        const bool         is_tie = j < indices.size();
        const unsigned int k      = is_tie ? 0 : j - indices.size(),
                           of     = is_tie ? indices[j] : n + k;
        values[j] = of < last.shortenings.size() ? last.shortenings[of] : 0.;
        if (is_tie)
          forces[j] =
            data.preload(discretisation.interfaces().sides()[indices[j]]);
        else if (const auto strain = data.mean_strain(k))
          values[j] = *strain;
        else
          forces[j] = work_of_stress(k) * data.mean_stress(k);
      }
    begin_values = values;
    check_volume();
    add_shortenings(load);
    parts = data.rigid_parts(discretisation.bodies());
    if (parts.empty())
      return;
    add_motions();
    for (unsigned int j = first_motion; j < all.size(); ++j)
      {
        const unsigned int p = all[j].part;
        values[j]            = 0.;
        for (unsigned int i = 0; i < 6; ++i)
          if (6 * p + i < last.motions.size())
            values[j] += all[j].direction[i] * last.motions[6 * p + i];
      }
    set_motions();
    begin_values      = values;
    others.prescribed = load.prescribed;
    if (load.prescribed_at_nodes.size() > 0)
      others.at_nodes = load.prescribed_at_nodes;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        Unknown moved = lift(p, parts[p].displacement(at[p]));
        set_product(moved);
        add_to_load(moved, 1., load);
      }
    for (unsigned int j = first_motion; j < all.size(); ++j)
      {
        set_lift(all[j]);
        all[j].known = false;
      }
    if (!discretisation.linear_system().bulk->is_nonlinear())
      set_loads_of_motions(load);
  }

  void
  GlobalUnknowns::add_to_load(const Unknown &unknown,
                              const double   d,
                              SceneLoad     &load) const
  {
    if (d == 0.)
      return;
    if (load.rhs.multiplier.size() > 0)
      load.rhs.multiplier.add(d, unknown.rhs.multiplier);
    if (!unknown.is_motion())
      return;
    for (const auto &[dof, value] : unknown.prescribed)
      load.prescribed[dof] += d * value;
    if (discretisation.linear_system().bulk->is_nonlinear())
      {
        load.prescribed_at_nodes.add(d, unknown.at_nodes);
        return;
      }
    load.rhs.displacement.add(d, unknown.rhs.displacement);
    if (load.rhs.pressure.size() > 0)
      load.rhs.pressure.add(d, unknown.rhs.pressure);
  }

  void
  GlobalUnknowns::change(const unsigned int j,
                         const double       d,
                         SceneLoad         &load,
                         SystemVector      *x)
  {
    values[j] += d;
    add_to_load(all[j], d, load);
    if (all[j].is_motion())
      {
        set_motions();
        for (unsigned int i = first_motion; i < all.size(); ++i)
          *forces[i] -= d * stiffness_of(i, j);
      }
    if (x != nullptr)
      add_scaled(*x, d, all[j].x);
  }
} // namespace mortise
