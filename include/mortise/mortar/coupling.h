// Mortar coupling of two surfaces: D and M as one matrix in the numbering of
// the scene, its parts for preconditioners, and its quality.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/base/types.h>
#include <mortise/contact/friction.h>
#include <mortise/mortar/contact_nodes.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/mortar/local_coupling.h>
#include <mortise/mortar/multiplier_space.h>

#include <functional>
#include <memory>
#include <vector>

namespace mortise
{
  /// One interface with its integrals.
  struct Coupling
  {
    InterfaceLaw law;
    /// Among the interfaces of the scene and the patches of their slaves, with
    /// those that meet no master.
    unsigned int number       = 0;
    bool         is_displaced = false; ///< its bodies, on all ranks
    /// Of the master, whose displacements it turns: u_slave = Q u_master. Its
    /// surface in the interface is the moved one.
    RigidMotion placement;
    bool        is_turned = false; ///< Q is not the identity
    std::unique_ptr<InterfaceHandler> interface;
    std::vector<std::vector<Frame>>   frames; ///< see slave_frames()
    std::vector<LocalCoupling>        local;  ///< by slave face
    std::unique_ptr<MultiplierSpace>  multipliers;
    /// Owned nodes of contact; else empty.
    std::vector<ContactNode> contact_nodes;

    /// See LocalCoupling; the same on all ranks.
    bool
    is_directed() const
    {
      return is_displaced &&
             (law.constrained == ConstrainedDirections::normal ||
              law.is_one_sided());
    }

    /// With friction, do its pairs follow the bodies?
    bool
    has_following_friction() const
    {
      return is_directed() && law.has_friction();
    }
  };

  /// By coupling and slave face; after the integration of all interfaces that
  /// share a slave surface.
  std::vector<std::vector<PartnerState>>
  partner_states(const std::vector<Coupling> &couplings);

  /// Owned rows and columns.
  struct CouplingPartition
  {
    const dealii::IndexSet &owned_displacement;
    const dealii::IndexSet &owned_multiplier;
    MPI_Comm                comm;
  };

  /// The constraint matrix B = [D, -M] of all interfaces, multipliers x free
  /// displacements; of sliding bodies its normal component at each slave node.
  /// Displacements are values at nodes. @p with_frames: with sliding bodies or
  /// springs. Collective.
  CouplingMatrix
  assemble_by_node(const std::vector<Coupling> &couplings,
                   const CouplingPartition     &partition,
                   bool                         with_frames);

  /// Set the stiffness at the nodes of slave faces from the law of @p coupling,
  /// if that is a spring.
  void
  set_springs(Coupling &coupling);

  /// The compliance S with B u - S lambda = g: S = int psi K^{-1} psi with the
  /// stiffness K of springs, lumped for dual multipliers. Rows of ties are
  /// zero. Collective.
  SparseMatrix
  assemble_compliance(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition);

  /// Set the fractions of LocalCoupling for the penalties of preconditioners.
  /// @p statuses: of the owned nodes of @p coupling. Collective.
  void
  select_nodes(const std::vector<NodeStatus> &statuses,
               const dealii::IndexSet        &owned_multiplier,
               MPI_Comm                       comm,
               Coupling                      &coupling);

  /// Moments of a multiplier with rigid motions: component c, divided by a
  /// bound of int |psi|.
  struct MultiplierMoment
  {
    dealii::Tensor<1, dim> weight; ///< int psi_c
    dealii::Tensor<2, dim> moment; ///< [c]: int psi_c x, a length
  };

  /// By owned multiplier of @p coupling. Collective.
  std::vector<MultiplierMoment>
  multiplier_moments(const Coupling         &coupling,
                     const dealii::IndexSet &owned_multiplier,
                     MPI_Comm                comm);

  /// Errors of constant and linear fields on an interface.
  struct TransferErrors
  {
    /// max_i |sum_j D_ij - sum_j M_ij| / max_i |sum_j D_ij| over the
    /// multipliers.
    double partition_of_unity = 0.;
    /// max_i |int lambda_i (x_master - x_slave)| / (int |lambda_i| h), h the
    /// size of a slave face.
    double linear_completeness = 0.;
  };

  /// Collective.
  TransferErrors
  transfer_errors(const Coupling         &coupling,
                  const dealii::IndexSet &owned_multiplier,
                  MPI_Comm                comm);

  /// Resultants of the tractions from the slave on the master.
  struct Resultants
  {
    dealii::Tensor<1, dim> force;  ///< int lambda
    dealii::Tensor<1, dim> moment; ///< int x_slave x lambda, about the origin
    /// |F_slave - F_master| / int |lambda|
    double force_residual = 0.;
    /// |M_slave - M_master| / (int |lambda| times the root of the area)
    double moment_residual = 0.;
  };

  /// @p multiplier: owned entries of the solution. Collective.
  Resultants
  resultants(const Coupling &coupling, const Vector &multiplier, MPI_Comm comm);

  /// By slave face of this rank and row of MultiplierSpace::rows(): the value
  /// of the function with the coefficients @p multiplier; zero on faces without
  /// multipliers. Collective.
  std::vector<std::vector<double>>
  values_by_row(const Coupling &coupling,
                const Vector   &multiplier,
                MPI_Comm        comm);

  /// By slave face of this rank: the coefficients of psi_k for component c,
  /// entry c (degree + 1)^2 + k. Collective.
  std::vector<std::vector<double>>
  multiplier_coefficients(const Coupling &coupling,
                          const Vector   &multiplier,
                          MPI_Comm        comm);

  /// The multiplier as polynomials that do the same work on the slave, which
  /// approximate the traction better than discontinuous dual functions: by
  /// slave face of this rank, entry c (degree + 1)^2 + k as in FaceTrace.
  /// Collective.
  std::vector<std::vector<double>>
  multiplier_on_faces(const Coupling &coupling,
                      const Vector   &multiplier,
                      MPI_Comm        comm);

  /// Add int psi . n offset to the right hand side of B u = g. @p offset: the
  /// gap in addition to the mesh gap, a length, at points of the slave.
  /// Collective.
  void
  add_offset(
    const Coupling                                                  &coupling,
    const std::function<double(const dealii::Point<dim> &position)> &offset,
    Vector                                                          &rhs);

  /// Likewise int psi . @p jump, a constant.
  void
  add_jump(const Coupling               &coupling,
           const dealii::Tensor<1, dim> &jump,
           Vector                       &rhs);

  /// Likewise int psi alpha with the distance alpha of the bodies where they
  /// are paired, for interfaces that follow the bodies without contact nodes.
  void
  add_distances(const Coupling &coupling, Vector &rhs);

  /// The inverse of multiplier_coefficients(), for owned multipliers.
  /// Collective.
  void
  set_multiplier(const Coupling                         &coupling,
                 const std::vector<std::vector<double>> &coefficients,
                 Vector                                 &multiplier);
} // namespace mortise
