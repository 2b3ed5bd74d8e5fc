// Coupling of two surfaces by multipliers: D and M as one matrix over the
// numbering of the scene, what preconditioners need of it, and how well it
// couples.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/base/types.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/mortar/local_coupling.h>
#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/normal_multipliers.h>

#include <functional>
#include <memory>
#include <vector>

namespace mortise
{
  /// One interface with everything that was integrated over it.
  struct Coupling
  {
    InterfaceLaw                      law;
    std::unique_ptr<InterfaceHandler> interface;
    std::vector<std::vector<Frame>>   frames; ///< see slave_frames()
    std::vector<LocalCoupling>        local;  ///< by slave face
    std::unique_ptr<MultiplierSpace>  multipliers;
    /// By owned multiplier, of contact; else empty.
    std::vector<NormalMultiplier> normal_multipliers;
  };

  /// By coupling and slave face; after the integration of all that share a
  /// slave surface.
  std::vector<std::vector<PartnerState>>
  partner_states(const std::vector<Coupling> &couplings);

  /// Who owns which rows and columns.
  struct CouplingPartition
  {
    const dealii::IndexSet &owned_displacement;
    const dealii::IndexSet &owned_multiplier;
    MPI_Comm                comm;
  };

  /// The constraint B u = 0 of all interfaces: B = [D, -M], where bodies slide
  /// its component along the normal of each slave node; multipliers x
  /// displacements that are free. Displacements are values at nodes, which the
  /// partition numbers: the traces have them. @p with_frames: bodies slide or hang on springs. Collective.
  CouplingMatrix
  assemble_by_node(const std::vector<Coupling> &couplings,
                   const CouplingPartition     &partition,
                   bool                         with_frames);

  /// Set the stiffness of the law of @p coupling at the nodes of slave faces,
  /// where it is compliant.
  void
  set_springs(Coupling &coupling);

  /// C with B u - C lambda = g: int psi K^{-1} psi of springs, K their
  /// stiffness; lumped where multipliers are dual, which is as good as these
  /// are. Rows of ties are zero. Collective.
  SparseMatrix
  assemble_compliance(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition);

  /// Set which multipliers take part, for what preconditioners see of it. @p active: by owned
  /// multiplier. Collective.
  void
  select_multipliers(const std::vector<bool> &active,
                     const dealii::IndexSet  &owned_multiplier,
                     MPI_Comm                 comm,
                     Coupling                &coupling);

  /// What a multiplier feels of rigid motions: that of component c over a bound
  /// of int |psi|.
  struct MultiplierMoment
  {
    dealii::Tensor<1, dim> weight; ///< int psi_c
    dealii::Tensor<2, dim> moment; ///< [c]: int psi_c x, a length
  };

  /// By owned multiplier of @p coupling; zero where it has no weight anywhere. Collective.
  std::vector<MultiplierMoment>
  multiplier_moments(const Coupling         &coupling,
                     const dealii::IndexSet &owned_multiplier,
                     MPI_Comm                comm);

  /// How exactly constant and linear fields pass an interface.
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

  /// What the multipliers carry from the slave to the master.
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

  /// By slave face of this rank and row of MultiplierSpace::rows(), the value
  /// of what
  /// has @p multiplier for coefficients; zero where nothing is coupled. Collective.
  std::vector<std::vector<double>>
  values_by_row(const Coupling &coupling,
                const Vector   &multiplier,
                MPI_Comm        comm);

  /// Coefficients of the multiplier on the slave faces of this rank, those of
  /// psi_k, by slave face: entry c (degree + 1)^2 + k. Collective.
  std::vector<std::vector<double>>
  multiplier_coefficients(const Coupling &coupling,
                          const Vector   &multiplier,
                          MPI_Comm        comm);

  /// The multiplier as polynomials on the slave faces of this rank, which do
  /// the same work on the slave: by slave face, entry c (degree + 1)^2 + k as
  /// in FaceTrace. Dual multipliers jump from face to face and say less of the
  /// traction than the forces on the slave do. Collective.
  std::vector<std::vector<double>>
  multiplier_on_faces(const Coupling &coupling,
                      const Vector   &multiplier,
                      MPI_Comm        comm);

  /// Add int psi . n offset to the right hand side of B u = g: the gap that is
  /// left between the bodies, on top of that between their meshes. @p offset: at
  /// points of the slave, a length. Collective.
  void
  add_offset(
    const Coupling                                                  &coupling,
    const std::function<double(const dealii::Point<dim> &position)> &offset,
    Vector                                                          &rhs);

  /// What undoes multiplier_coefficients(), for the owned multipliers.
  void
  set_multiplier(const Coupling                         &coupling,
                 const std::vector<std::vector<double>> &coefficients,
                 Vector                                 &multiplier);
} // namespace mortise
