// Integrals over one slave face and its partners: the element matrices D_e and
// M_e, the same for the three components.
//
// Multipliers belong to the nodes of the slave face (Gauss-Lobatto points on
// quadrilaterals). Standard ones are the nodal functions phi_i. Dual ones are
// psi = A phi, A = W M^{-1}, M = int phi phi^T, W = diag(int phi_i), so that
// int psi_i phi_j = w_i delta_ij and sum psi_i = 1: Lamichhane and Wohlmuth
// (2007). They are used on fully covered faces with positive weights w_i:
// moderately distorted quadrilaterals and triangles of degree 1.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/contact/interface_law.h>
#include <mortise/interface/interface_handler.h>
#include <mortise/mortar/slave_frames.h>

#include <array>
#include <vector>

namespace mortise
{
  enum class MultiplierBasis : unsigned char
  {
    standard,
    dual
  };

  /// Integrals over the covered part of one slave face. Functions N are those
  /// of FaceTrace, multipliers psi one for each node.
  struct LocalCoupling
  {
    struct Partner
    {
      unsigned int master; ///< among InterfaceHandler::master_faces()
      /// Is the master so much coarser that preconditioners move it alone and
      /// let the slave follow? For values at nodes.
      bool                       is_independent = false;
      dealii::FullMatrix<double> mixed; ///< int N_i^slave N_j^master
      dealii::FullMatrix<double>
        mass; ///< int N_i^master N_j^master; empty unless asked for
      dealii::FullMatrix<double> constraint; ///< int psi_i N_j^master
      /// See LocalCoupling; int psi_i N_j^master d.
      std::array<dealii::FullMatrix<double>, dim> directed;
    };

    dealii::FullMatrix<double>
      mass; ///< int N_i^slave N_j^slave; empty: no partner
    /// psi_i = sum_j multiplier_ij N_j.
    dealii::FullMatrix<double> multiplier;
    dealii::FullMatrix<double> constraint; ///< int psi_i N_j^slave
    /// By component of d, of contact that follows the bodies: int psi_i
    /// N_j^slave d, d = nu / (n . nu) with the normals n of the slave, along
    /// which points are projected, and nu of the master, into the slave's side.
    /// A displacement changes the distance of the sides by d . (u_master -
    /// u_slave), where they touch. Else empty.
    std::array<dealii::FullMatrix<double>, dim> directed;
    /// Likewise: int psi_i alpha of that distance.
    std::vector<double> distance_moment;
    /// Dual multipliers: int psi_i; else empty.
    std::vector<double> weights;
    std::vector<dealii::Tensor<1, dim>>
      gap_moment; ///< int psi_i (x_master - x_slave)
    std::vector<dealii::Tensor<1, dim>> position_moment; ///< int psi_i x_slave
    /// The same where the slave was; empty where it is not displaced.
    std::vector<dealii::Tensor<1, dim>> undeformed_moment;
    std::vector<Partner>                partners;
    std::vector<InterfaceStiffness>     springs; ///< by node; empty: a tie
    /// Standard multipliers along a normal that turns: entry k n + i is the
    /// traction of psi_k at node i of n, the projection of psi_k n, n
    /// interpolated between nodes, onto the polynomials of the face. A body
    /// then turns freely in its bore, which psi_k n_k would prevent, since
    /// psi_k changes sign from degree 2 on. Empty: psi_k n_k.
    std::vector<dealii::Tensor<1, dim>> along_normals;
    double penalty = 0.; ///< of jumps: about E / h of the softer side that
                         ///< gives way, not an independent master

    /// Fractions of the multipliers that hold along the normal and
    /// tangentially, see select_nodes().
    double active_fraction = 1., sticking_fraction = 1.;

    /// int psi_i X, X the place in the body.
    const std::vector<dealii::Tensor<1, dim>> &
    places() const
    {
      return undeformed_moment.empty() ? position_moment : undeformed_moment;
    }

    /// Are pressures normal to the master at each point, and not to the slave
    /// at its nodes?
    bool
    is_directed() const
    {
      return !distance_moment.empty();
    }

    bool
    is_dual() const
    {
      return !weights.empty();
    }
  };

  /// By slave face and node, unit vectors: the direction of pressures that are
  /// normal to the master at each point, projected onto the polynomials of the
  /// face, or their mean where little of it is covered; empty without a
  /// partner.
  std::vector<std::vector<dealii::Tensor<1, dim>>>
  normals_of_master(const InterfaceHandler           &interface,
                    const std::vector<LocalCoupling> &couplings);

  /// Clip @p interface and integrate; one entry per slave face. @p may_be_independent:
  /// may Partner::is_independent be set? @p frames: slave_frames() for multipliers along
  /// normals, else empty. Collective.
  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler &interface,
                     bool              with_master_mass,
                     MultiplierBasis   basis,
                     bool              may_be_independent          = true,
                     const std::vector<std::vector<Frame>> &frames = {});
} // namespace mortise
