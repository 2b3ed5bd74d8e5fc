// The motions of rigid parts, members of GlobalUnknowns.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/global_unknowns.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The sum of the sizes of the terms of a^T b. Collective.
    double
    size_of_product(const Vector &a, const Vector &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
        sum += std::fabs(a.begin()[i] * b.begin()[i]);
      return Utilities::MPI::sum(sum, a.get_mpi_communicator());
    }
  } // namespace

  double
  GlobalUnknowns::size_of_product(const unsigned int  j,
                                  const SystemVector &x) const
  {
    const SystemVector &w = all[j].rhs;
    return mortise::size_of_product(w.displacement, x.displacement) +
           (x.multiplier.size() > 0 ?
              mortise::size_of_product(w.multiplier, x.multiplier) :
              0.);
  }

  void
  GlobalUnknowns::set_product(Unknown &unknown) const
  {
    const BlockSystem &system  = discretisation.linear_system();
    SystemVector       product = system.zero_vector();
    system.apply_to_constrained(unknown.at_nodes, product, &unknown.borne);
    scale(product, -1.);
    unknown.rhs = product;
  }

  void
  GlobalUnknowns::set_displacements(Unknown &unknown) const
  {
    const unsigned int p = unknown.part;
    Unknown at_present   = lift(p, parts[p].change(at[p], unknown.direction));
    unknown.prescribed   = std::move(at_present.prescribed);
    unknown.at_nodes     = at_present.at_nodes;
  }

  void
  GlobalUnknowns::set_lift(Unknown &unknown) const
  {
    if (parts[unknown.part].is_finite || unknown.at_nodes.size() == 0)
      set_displacements(unknown);
    set_product(unknown);
    unknown.has_lift = true;
  }

  GlobalUnknowns::Unknown
  GlobalUnknowns::lift(const unsigned int p, const AffineField &field) const
  {
    Unknown result;
    if (basis[p].empty())
      {
        result.prescribed = discretisation.lift(parts[p], field);
        result.at_nodes   = discretisation.at_nodes(result.prescribed);
        return result;
      }
    result.at_nodes.reinit(basis[p].front().at_nodes);
    const double scale = parts[p].where.size;
    for (unsigned int k = 0; k < basis[p].size(); ++k)
      {
        const double factor =
          k < dim ? field.value[k] :
                    scale * field.gradient[(k - dim) / dim][k % dim];
        result.at_nodes.add(factor, basis[p][k].at_nodes);
        for (const auto &[dof, value] : basis[p][k].prescribed)
          result.prescribed[dof] += factor * value;
      }
    return result;
  }

  void
  GlobalUnknowns::add_motions()
  {
    if (std::exchange(have_motions, true))
      return;
    basis.resize(parts.size());
    at.resize(parts.size());
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        std::vector<Unknown> own;
        for (unsigned int k = 0; k < dim + dim * dim && parts[p].is_finite; ++k)
          {
            AffineField field;
            if (k < dim)
              field.value[k] = 1.;
            else
              field.gradient[(k - dim) / dim][k % dim] =
                1. / parts[p].where.size;
            own.push_back(lift(p, field));
          }
        basis[p] = std::move(own);
        for (const Motion &direction : parts[p].free)
          {
            Unknown next;
            next.part      = p;
            next.direction = direction;
            all.push_back(std::move(next));
            values.push_back(0.);
            forces.emplace_back(0.);
          }
      }
    fluxes.grow_or_shrink(all.size());
  }

  void
  GlobalUnknowns::set_motions()
  {
    for (unsigned int p = 0; p < parts.size(); ++p)
      at[p] = parts[p].given;
    for (unsigned int j = first_motion; j < all.size(); ++j)
      for (unsigned int i = 0; i < 6; ++i)
        at[all[j].part][i] += values[j] * all[j].direction[i];
  }

  std::vector<double>
  GlobalUnknowns::values_of(const FreeMotions &free, const unsigned int k) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = first_motion; j < all.size(); ++j)
      {
        const RigidPart &part = parts[all[j].part];
        const Extent    &body = free.of_body[part.body];
        const Motion    &m    = free.motions[k][part.body];
        const auto       rows = part.rows_of(body);
        for (unsigned int i = 0; i < 6; ++i)
          result[j] +=
            all[j].direction[i] *
            std::inner_product(rows[i].begin(), rows[i].end(), m.begin(), 0.);
      }
    return result;
  }

  void
  GlobalUnknowns::set_loads_of_motions(const SceneLoad &load)
  {
    const BlockSystem &system = discretisation.linear_system();
    SystemVector       free   = system.zero_vector();
    Vector             borne;
    if (!load.prescribed.empty())
      system.apply_to_constrained(discretisation.at_nodes(load.prescribed),
                                  free,
                                  &borne);
    const std::vector<double> external = work_of(load.external),
                              internal = work_of(borne);
    for (unsigned int j = first_motion; j < all.size(); ++j)
      forces[j] = external[j] - internal[j] +
                  parts[all[j].part].work(at[all[j].part], all[j].direction);
  }

  std::vector<double>
  GlobalUnknowns::work_of(const Vector &forces) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = first_motion; j < all.size() && forces.size() > 0;
         ++j)
      result[j] = all[j].at_nodes * forces;
    return result;
  }

  void
  GlobalUnknowns::take_forces(const NodalForces &at_nodes)
  {
    for (unsigned int j = first_motion; j < all.size(); ++j)
      if (parts[all[j].part].is_finite)
        set_displacements(all[j]);
    const std::vector<double> external       = work_of(at_nodes.external),
                              internal       = work_of(at_nodes.internal),
                              of_multipliers = work_of(at_nodes.of_multipliers);
    lacks.assign(all.size(), 0.);
    sizes.assign(all.size(), 0.);
    for (unsigned int j = first_motion; j < all.size(); ++j)
      {
        const double loads =
          external[j] +
          parts[all[j].part].work(at[all[j].part], all[j].direction);
        lacks[j] = loads - internal[j] - of_multipliers[j];
        sizes[j] =
          std::fabs(loads) +
          mortise::size_of_product(all[j].at_nodes, at_nodes.internal) +
          mortise::size_of_product(all[j].at_nodes, at_nodes.of_multipliers);
        forces[j] = loads - internal[j];
      }
    Vector total = at_nodes.external;
    total -= at_nodes.internal;
    total -= at_nodes.of_multipliers;
    stiffness_of_forces.reinit(all.size(), all.size());
    for (unsigned int p = 0; p < parts.size(); ++p)
      if (!basis[p].empty())
        add_stiffness_of_forces(p, total);
  }

  void
  GlobalUnknowns::add_stiffness_of_forces(const unsigned int p,
                                          const Vector      &total)
  {
    constexpr double    step = 1e-5; // of angles
    std::vector<double> moments;
    for (const Unknown &of_entry : basis[p])
      moments.push_back(of_entry.at_nodes * total);
    const RigidPart &part = parts[p];
    const auto       work = [&](const Motion &motion, const Motion &direction) {
      const AffineField field = part.change(motion, direction);
      double            sum   = part.work(motion, direction);
      for (unsigned int k = 0; k < moments.size(); ++k)
        sum += moments[k] *
               (k < dim ?
                        field.value[k] :
                        part.where.size * field.gradient[(k - dim) / dim][k % dim]);
      return sum;
    };
    for (unsigned int i = first_motion; i < all.size(); ++i)
      for (unsigned int j = first_motion; j < all.size(); ++j)
        if (all[i].part == p && all[j].part == p)
          {
            Motion ahead = at[p], behind = at[p];
            for (unsigned int k = 0; k < 6; ++k)
              {
                ahead[k] += step * all[j].direction[k];
                behind[k] -= step * all[j].direction[k];
              }
            stiffness_of_forces(i, j) =
              (work(ahead, all[i].direction) - work(behind, all[i].direction)) /
              (2. * step);
          }
  }

  void
  GlobalUnknowns::count_from(const SystemVector &moved)
  {
    for (unsigned int j = first_motion; j < all.size(); ++j)
      {
        if (!all[j].has_lift)
          set_lift(all[j]);
        *forces[j] -= product(j, moved);
      }
  }

  void
  GlobalUnknowns::settle(SceneLoad &load) const
  {
    if (std::all_of(basis.begin(), basis.end(), [](const auto &of_part) {
          return of_part.empty();
        }))
      return;
    load.prescribed          = others.prescribed;
    Vector before            = load.prescribed_at_nodes;
    load.prescribed_at_nodes = others.at_nodes;
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const Unknown moved = lift(p, parts[p].displacement(at[p]));
        load.prescribed_at_nodes += moved.at_nodes;
        for (const auto &[dof, value] : moved.prescribed)
          load.prescribed[dof] += value;
      }
    before -= load.prescribed_at_nodes;
    if (load.rhs.multiplier.size() == 0)
      return;
    Vector gaps(load.rhs.multiplier);
    discretisation.linear_system().constraint.vmult_free(gaps, before);
    load.rhs.multiplier += gaps;
  }

  double
  GlobalUnknowns::stiffness_of(const unsigned int i, const unsigned int j) const
  {
    if (!all[i].is_motion() || !all[j].is_motion())
      return 0.;
    const double of_forces =
      stiffness_of_forces.empty() ? 0. : stiffness_of_forces(i, j);
    return all[i].at_nodes * all[j].borne - of_forces;
  }

  void
  GlobalUnknowns::go_back(SceneLoad &load)
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      if (values[j] != begin_values[j])
        change(j, begin_values[j] - values[j], load, nullptr);
    settle(load);
  }

  std::vector<double>
  GlobalUnknowns::on_motions(const Functional &functional) const
  {
    std::vector<double> result(all.size(), 0.);
    for (unsigned int j = first_motion; j < all.size(); ++j)
      result[j] = functional(all[j].prescribed, all[j].borne);
    return result;
  }
} // namespace mortise
