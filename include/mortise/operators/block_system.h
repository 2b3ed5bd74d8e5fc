// The linear operator of a whole scene, all bodies and all interfaces in one
// numbering,
//
//     [ K  G^T  B^T ] [ u      ]
//     [ G  -C    0  ] [ p      ]
//     [ B   0   -S  ] [ lambda ]
//
// where the pressure p is that of bodies in mixed form, if there are any,
// together with what preconditioners need to know about it. Prescribed
// displacements are zero here: what they bring is part of a step's load.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/base/types.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/operators/free_pressures.h>
#include <mortise/operators/nodal_system.h>

#include <memory>
#include <optional>
#include <vector>

namespace mortise
{
  /// (u, p, lambda), or what is dual to them: loads (f, h, g) and residuals. p
  /// has size zero without mixed bodies, lambda without an interface.
  struct SystemVector
  {
    Vector displacement, pressure, multiplier;

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

  /// Indices are global, numbered rank by rank, so that what a rank owns is one
  /// contiguous range in the displacement and one in the multiplier numbering;
  /// either may be empty on a rank.
  struct BlockSystem
  {
    MPI_Comm communicator = MPI_COMM_NULL;

    dealii::IndexSet owned_displacement;
    dealii::IndexSet owned_pressure; ///< empty (of size 0) without mixed bodies
    dealii::IndexSet owned_multiplier;

    /// K, G = -int q div u, C = int c p q with the compressibility c, and
    /// P = int p q (c + 1 / (2/3 mu + lambda_u)), which C + G K^{-1} G^T is
    /// spectrally equivalent to, whatever c is; in cells some of whose
    /// displacements are prescribed, what element_schur() has instead. Indices
    /// of displacements and pressures are those of its finest level.
    std::unique_ptr<NodalSystem> nodal;

    /// Constants that the equations leave free: solutions have none of them.
    FreePressures free_pressures;

    /// B: rows are multipliers, columns displacements; columns of constrained
    /// dofs are zero. Empty when the scene has no interface.
    CouplingMatrix constraint;

    /// The rows through which multipliers act on bodies, in place of B^T above,
    /// as with friction; absent where they are those of the constraint.
    std::optional<CouplingMatrix> force_rows;

    const CouplingMatrix &
    forces() const
    {
      return force_rows ? *force_rows : constraint;
    }

    bool
    is_symmetric() const
    {
      return !force_rows;
    }

    /// By owned multiplier: does its constraint hold? The others are zero.
    /// Nothing, on all ranks: all do.
    std::optional<std::vector<bool>> active;

    /// S, the compliance of springs: zero, or empty, where bodies are tied.
    SparseMatrix spring_compliance;

    /// Are there bodies in mixed form?
    bool
    mixed() const
    {
      return owned_pressure.size() > 0;
    }

    /// Twice the energy of what bodies and springs carry. Collective.
    double
    energy_product(const SystemVector &x) const;

    /// dst_u = K u + G^T p, dst_p = G u - C p, the latter without the parts
    /// that belong to free constants. Collective.
    void
    apply_mixed(Vector       &dst_u,
                Vector       &dst_p,
                const Vector &u,
                const Vector &p) const;

    /// Set @p rhs to what the system is times @p u at nodes, which may be other than zero where components are
    /// constrained. Collective.
    void
    apply_to_constrained(const Vector &u, SystemVector &rhs) const;

    /// dst += B^T lambda, or what the force rows have; the forces of the
    /// multipliers. Collective.
    void
    add_multiplier_force(Vector &dst, const Vector &lambda) const;

    /// dst = B u, what the constraints see. Collective.
    void
    apply_constraint(Vector &dst, const Vector &u) const;

    /// dst -= S lambda, what springs give. Collective.
    void
    subtract_spring_opening(Vector &dst, const Vector &lambda) const;

    /// Zero those of @p multiplier that are not active.
    void
    clear_inactive(Vector &multiplier) const;

    bool
    has_springs() const
    {
      return spring_compliance.m() > 0;
    }

    /// Zero; displacements and pressures on the layouts of the finest level.
    /// Collective.
    SystemVector
    zero_vector() const
    {
      SystemVector zero;
      nodal->initialize(zero.displacement);
      if (mixed())
        nodal->initialize_pressure(zero.pressure);
      if (owned_multiplier.size() > 0)
        zero.multiplier.reinit(owned_multiplier, communicator);
      return zero;
    }
  };
} // namespace mortise
