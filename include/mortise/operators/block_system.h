// The linear operator of a whole scene, all bodies and all interfaces in one
// numbering,
//
//     [ K  G^T  B^T ] [ u      ]
//     [ G  -C    0  ] [ p      ]
//     [ B   0   -S  ] [ lambda ]
//
// with the pressures p of bodies in mixed form. Prescribed displacements are
// zero here; their contribution is part of a SceneLoad.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/base/types.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/free_pressures.h>

#include <memory>
#include <optional>
#include <vector>

namespace mortise
{
  /// (u, p, lambda), or dual vectors: loads (f, h, g) and residuals. p has size
  /// zero without mixed bodies, lambda without an interface.
  struct SystemVector
  {
    Vector displacement, pressure, multiplier;
    double time = 0.; ///< of the loads, an unknown with arc-length control

    SystemVector()                     = default;
    SystemVector(const SystemVector &) = default;
    SystemVector &
    operator=(const SystemVector &other);
  };

  /// x *= factor.
  void
  scale(SystemVector &x, double factor);

  /// x += factor y.
  void
  add_scaled(SystemVector &x, double factor, const SystemVector &y);

  /// What solvers have in place of the multipliers where friction turns the
  /// directions of nodes, so that one may slip along a direction and is held
  /// across it: lambda = Q^T lambda', and the constraint is Q B.
  struct MultiplierDirections
  {
    SparseMatrix   turn;    ///< Q, by node
    SparseMatrix   inverse; ///< Q^{-T}
    CouplingMatrix constraint;
    /// With Coulomb's law lambda = Q'^T lambda', where the pressure brings its
    /// tangential traction along, and forces are those of Q' B; absent: Q.
    std::optional<SparseMatrix>   turn_of_forces;
    std::optional<CouplingMatrix> forces;
    /// S of the multipliers lambda', springs included.
    SparseMatrix compliance;
  };

  /// Indices are global, numbered rank by rank: the owned displacements,
  /// pressures and multipliers are contiguous ranges, which may be empty.
  struct BlockSystem
  {
    MPI_Comm communicator = MPI_COMM_NULL;

    dealii::IndexSet owned_displacement;
    dealii::IndexSet owned_pressure; ///< empty (of size 0) without mixed bodies
    dealii::IndexSet owned_multiplier;

    /// K, G = -int q div u, C = int c p q with the compressibility c, and P
    /// = int p q (c + 1 / (2/3 mu + lambda_u)), spectrally equivalent to C + G
    /// K^{-1} G^T for all c; in cells at Dirichlet boundaries with
    /// element_schur() instead. Displacements and pressures have the indices of
    /// its finest level.
    std::unique_ptr<BulkSystem> bulk;

    /// Constant pressures in the kernel, which solutions do not contain.
    FreePressures free_pressures;

    /// B: rows are multipliers, columns displacements; columns of constrained
    /// dofs are zero. Empty when the scene has no interface.
    CouplingMatrix constraint;

    /// S, the compliance of springs: zero, or empty, where bodies are tied.
    SparseMatrix spring_compliance;

    /// Absent where they are those of the multipliers. What LinearSolver takes
    /// and returns are the multipliers all the same.
    std::optional<MultiplierDirections> directions;

    /// The active set, by owned multiplier in these directions; others are
    /// zero. Nothing, on all ranks: all are active.
    std::optional<std::vector<bool>> active;

    /// B, S, and the rows through which multipliers act, in these directions.
    const CouplingMatrix &
    directed_constraint() const
    {
      return directions ? directions->constraint : constraint;
    }

    const CouplingMatrix &
    directed_forces() const
    {
      return directions && directions->forces ? *directions->forces :
                                                directed_constraint();
    }

    const SparseMatrix &
    compliance() const
    {
      return directions ? directions->compliance : spring_compliance;
    }

    /// Is the system symmetric, and K positive definite as far as is known?
    bool
    suits_conjugate_gradients() const
    {
      return has_symmetric_coupling() && bulk->may_be_positive();
    }

    bool
    has_symmetric_coupling() const
    {
      return !directions || !directions->forces;
    }

    /// From right hand sides, and from solutions, to directions().
    void
    to_directions(SystemVector &rhs, SystemVector &solution) const;

    /// From solutions in directions to multipliers.
    void
    from_directions(SystemVector &solution) const;

    /// Are there bodies in mixed form?
    bool
    mixed() const
    {
      return owned_pressure.size() > 0;
    }

    /// Twice the energy of bodies and springs. Collective.
    double
    energy_product(const SystemVector &x) const;

    /// dst_u = K u + G^T p, dst_p = G u - C p, the latter without the free
    /// constants. Collective.
    void
    apply_mixed(Vector       &dst_u,
                Vector       &dst_p,
                const Vector &u,
                const Vector &p) const;

    /// Set @p rhs to the product of the system with @p u, which may be nonzero
    /// at constrained components; @p forces, if they are not null, to K u, also there. Collective.
    void
    apply_to_constrained(const Vector &u,
                         SystemVector &rhs,
                         Vector       *forces = nullptr) const;

    /// dst += B^T lambda, the forces of multipliers in directions(), as all
    /// below. Collective.
    void
    add_multiplier_force(Vector &dst, const Vector &lambda) const;

    /// dst = B u. Collective.
    void
    apply_constraint(Vector &dst, const Vector &u) const;

    /// dst -= S lambda, the opening of springs. Collective.
    void
    subtract_spring_opening(Vector &dst, const Vector &lambda) const;

    /// Set inactive multipliers to zero.
    void
    clear_inactive(Vector &multiplier) const;

    bool
    has_springs() const
    {
      return compliance().m() > 0;
    }

    /// Zero; displacements and pressures on the layouts of the finest level.
    /// Collective.
    SystemVector
    zero_vector() const
    {
      SystemVector zero;
      bulk->initialize(zero.displacement);
      if (mixed())
        bulk->initialize_pressure(zero.pressure);
      if (owned_multiplier.size() > 0)
        zero.multiplier.reinit(owned_multiplier, communicator);
      return zero;
    }
  };
} // namespace mortise
