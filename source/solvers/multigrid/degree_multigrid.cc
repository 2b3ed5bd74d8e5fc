#include <deal.II/base/mpi.h>

#include <mortise/operators/levels/degree_transfer.h>
#include <mortise/solvers/multigrid/chebyshev.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>
#include <mortise/solvers/multigrid/lower_smoothing_bound.h>
#include <mortise/solvers/multigrid/vertex_multigrid.h>
#include <mortise/solvers/multipliers/approximate_schur_complement.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  struct DegreeMultigrid::Implementation
  {
    virtual ~Implementation() = default;

    virtual void
    vmult(Vector &dst, const Vector &src) = 0;

    virtual std::string
    vertices_description() const = 0;

    virtual bool
    update_interfaces() = 0;

    virtual bool
    update_directions() = 0;

    std::unique_ptr<CouplingProduct<float>>     product;
    std::unique_ptr<ApproximateSchurComplement> schur;
    std::unique_ptr<ConstraintProjector>        projector;
    Vector                                      carried; ///< by springs
    bool                                        valid = true;
  };

  namespace
  {
    template <typename Number>
    struct SmoothedLevel
    {
      SmoothedLevel(const MultigridLevel              &level,
                    const double                       lower_bound,
                    const InterfaceCorrection<Number> *correction)
        : matrix(level, correction == nullptr)
        , smoother(matrix, lower_bound, correction)
      {
        matrix.initialize(x);
        matrix.initialize(b);
        matrix.initialize(r);
      }

      LevelOperator<Number> matrix;
      Chebyshev<Number>     smoother;
      LevelVector<Number>   x, b, r;
    };

    std::vector<ConstraintPenalty>
    weak_jumps(const BlockSystem &system)
    {
      if (system.owned_multiplier.size() == 0)
        return {};
      return find_constraint_penalties(system.directed_constraint(),
                                       system.bulk->node_diagonal(),
                                       system.has_springs() ?
                                         system.compliance().diagonal() :
                                         std::vector<double>(),
                                       system.active);
    }
  } // namespace

  template <typename Number>
  struct DegreeMultigrid::ImplementationOf : DegreeMultigrid::Implementation
  {
    ImplementationOf(const BlockSystem                    &system,
                     const std::size_t                     max_gathered,
                     const ThicknessCoarsening            *thickness,
                     const std::vector<ConstraintPenalty> &jumps)
      : system(system)
      , max_gathered(max_gathered)
    {
      const auto &all       = system.bulk->levels();
      Vector      stiffness = system.bulk->node_diagonal();
      for (const unsigned int index : all.front().constrained)
        stiffness.local_element(index) = 0.;
      root_of_stiffness = std::sqrt(stiffness.linfty_norm());
      // in front of all else: what algebraic multigrid needs for a while is the
      // largest part of the memory
      vertices =
        thickness ?
          std::make_unique<VertexMultigrid<Number>>(system, *thickness, jumps) :
          std::make_unique<VertexMultigrid<Number>>(all.back(), all.size() > 1);
      valid = vertices->is_valid();
      set_up_interfaces();
      // where nothing but vertices is below, the finest level is smoothed here
      // and stands for them, too
      const unsigned int n_smoothed = std::max<unsigned int>(1, all.size() - 1);
      for (unsigned int l = 0; l < n_smoothed; ++l)
        {
          levels.push_back(std::make_unique<SmoothedLevel<Number>>(
            all[l],
            lower_smoothing_bound(*all[l].space, l == 0, thickness),
            l == 0 ? correction.get() : nullptr));
          valid = valid && levels.back()->smoother.is_valid();
        }
      coarse_x.reinit(all.back().layout);
      coarse_b.reinit(all.back().layout);
      if (all.size() > 1)
        coarse = std::make_unique<LevelOperator<Number>>(all.back(), false);
      for (unsigned int l = 0; l + 1 < all.size(); ++l)
        transfers.push_back(std::make_unique<DegreeTransfer<Number>>(
          levels[l]->matrix,
          l + 1 < levels.size() ? levels[l + 1]->matrix : *coarse));
      valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator) == 1;
    }

    void
    set_up_interfaces()
    {
      // pairs before may have had multipliers
      correction.reset();
      projector.reset();
      schur.reset();
      own_product.reset();
      product.reset();
      carried = Vector();
      if (system.owned_multiplier.size() == 0)
        return;
      const RowsByEntity rows(system.directed_constraint());
      product = std::make_unique<CouplingProduct<float>>(system, rows);
      schur   = std::make_unique<ApproximateSchurComplement>(system,
                                                           rows,
                                                           *product,
                                                           max_gathered);
      valid   = schur->is_valid() && valid;
      const CouplingProduct<Number> *of_levels = nullptr;
      if constexpr (std::is_same_v<Number, float>)
        of_levels = product.get();
      else
        {
          own_product = std::make_unique<CouplingProduct<Number>>(system, rows);
          of_levels   = own_product.get();
        }
      correction = std::make_unique<InterfaceCorrection<Number>>(system,
                                                                 *of_levels,
                                                                 *schur);
      projector  = std::make_unique<ConstraintProjector>(system, rows, *schur);
      reinit_carried();
    }

    void
    reinit_carried()
    {
      carried = system.has_springs() ?
                  Vector(system.owned_multiplier, system.communicator) :
                  Vector();
    }

    /// levels[l]->x = an approximate solution for levels[l]->b, on the finest
    /// level one that satisfies the constraint.
    void
    cycle(const unsigned int l)
    {
      if (l == levels.size())
        {
          vertices->vmult(coarse_x, coarse_b);
          return;
        }
      SmoothedLevel<Number> &level  = *levels[l];
      const bool             last   = l + 1 == levels.size();
      auto                  &next_x = last ? coarse_x : levels[l + 1]->x,
           &next_b                  = last ? coarse_b : levels[l + 1]->b;
      level.smoother.smooth(level.x, level.b, true);
      const bool constrained = l == 0 && correction;
      level.matrix.vmult(level.r, level.x);
      if (constrained && correction->has_springs())
        correction->add_spring_forces(level.r);
      level.r.sadd(-1, 1, level.b);
      if (constrained)
        correction->project_residual(level.r);
      if (transfers.empty())
        next_b = level.r;
      else
        transfers[l]->restrict_to(next_b, level.r);
      cycle(l + 1);
      if (transfers.empty())
        level.x += next_x;
      else
        transfers[l]->prolongate_add(level.x, next_x);
      if (constrained)
        correction->project(level.x);
      level.smoother.smooth(level.x, level.b, false);
    }

    void
    vmult(Vector &dst, const Vector &src) override
    {
      auto &level = *levels.front();
      // single precision has room for forces and displacements if both are the
      // root of the stiffness
      const double scale = src.linfty_norm() / root_of_stiffness;
      if (scale == 0.)
        {
          dst     = 0.;
          carried = 0.;
          return;
        }
      const unsigned int n = level.b.locally_owned_size();
      for (unsigned int i = 0; i < n; ++i)
        level.b.local_element(i) =
          static_cast<Number>(src.local_element(i) / scale);
      level.matrix.clear_constrained(level.b);
      cycle(0);
      for (unsigned int i = 0; i < n; ++i)
        dst.local_element(i) =
          scale * static_cast<double>(level.x.local_element(i));
      if (carried.size() == 0)
        return;
      carried.equ(scale, correction->carried_by_springs());
      projector->clear_ties(carried);
    }

    bool
    update_interfaces() override
    {
      valid = true;
      set_up_interfaces();
      valid        = levels.front()->smoother.update(correction.get()) && valid;
      return valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator);
    }

    bool
    update_directions() override
    {
      if (!schur)
        return valid;
      product->take_frames(system);
      if (own_product)
        own_product->take_frames(system);
      projector->update_directions();
      reinit_carried();
      return valid = schur->update_directions();
    }

    std::string
    vertices_description() const override
    {
      return vertices->description();
    }

    const BlockSystem &system;
    const std::size_t  max_gathered;
    /// Where it is not that of the Schur complement.
    std::unique_ptr<CouplingProduct<Number>>            own_product;
    std::unique_ptr<InterfaceCorrection<Number>>        correction;
    std::vector<std::unique_ptr<SmoothedLevel<Number>>> levels;
    std::unique_ptr<LevelOperator<Number>> coarse; ///< for the last transfer
    std::vector<std::unique_ptr<DegreeTransfer<Number>>> transfers;
    LevelVector<Number>                                  coarse_x, coarse_b;
    std::unique_ptr<VertexMultigrid<Number>>             vertices;
    double                                               root_of_stiffness;
  };

  DegreeMultigrid::DegreeMultigrid(const BlockSystem &system,
                                   const std::size_t  max_gathered)
  {
    const auto &levels = system.bulk->levels();
    const auto &space  = *levels.front().space;
    if (levels.size() == 1 && coarsens_across_thickness(space.bodies()))
      {
        // a thin body bends so much more easily than it stretches that single
        // precision loses the way it bends
        const auto jumps     = weak_jumps(system);
        const auto thickness = make_thickness_coarsening(
          space,
          nodes_beside_flat_bodies(jumps,
                                   space,
                                   find_flat_bodies(space.bodies()),
                                   system.communicator),
          system.communicator);
        implementation = std::make_unique<ImplementationOf<double>>(
          system, max_gathered, &thickness, jumps);
      }
    else
      implementation = std::make_unique<ImplementationOf<float>>(
        system, max_gathered, nullptr, std::vector<ConstraintPenalty>());
  }

  DegreeMultigrid::~DegreeMultigrid() = default;

  bool
  DegreeMultigrid::is_valid() const
  {
    return implementation->valid;
  }

  bool
  DegreeMultigrid::update_active()
  {
    return !implementation->schur || implementation->schur->update_active();
  }

  bool
  DegreeMultigrid::update_interfaces()
  {
    return implementation->update_interfaces();
  }

  bool
  DegreeMultigrid::update_directions()
  {
    return implementation->update_directions();
  }

  void
  DegreeMultigrid::vmult(Vector &dst, const Vector &src) const
  {
    implementation->vmult(dst, src);
  }

  const Vector &
  DegreeMultigrid::spring_multipliers() const
  {
    return implementation->carried;
  }

  const ConstraintProjector *
  DegreeMultigrid::projector() const
  {
    return implementation->projector.get();
  }

  std::string
  DegreeMultigrid::description() const
  {
    const std::string multipliers =
      implementation->schur ? implementation->schur->description() : "";
    return "multigrid in the degree, " +
           implementation->vertices_description() +
           (multipliers.empty() ? "" : ", " + multipliers);
  }
} // namespace mortise
