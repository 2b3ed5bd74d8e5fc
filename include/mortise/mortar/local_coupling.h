// Integrals over one slave face and its partners: of shape functions, and of
// multipliers, which are the local blocks of D and M. They are the same for the
// three components.
//
// Multipliers belong to the nodes of the slave face (Gauss-Lobatto points on
// quadrilaterals). Standard ones are the nodal functions phi_i themselves. Dual
// ones are psi = A phi with A = W M^{-1}, M = int phi phi^T, W = diag(int
// phi_i), so that int psi_i phi_j = w_i delta_ij and the sum of all is 1: see
// Lamichhane and Wohlmuth (2007). They take the place of standard ones on faces
// that are covered as a whole and whose weights w_i are all positive:
// quadrilaterals that are not distorted too much, and triangles of degree 1.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/contact/interface_law.h>
#include <mortise/interface/interface_handler.h>
#include <mortise/mortar/slave_frames.h>

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
      /// In values at nodes: is the master so much coarser that preconditioners
      /// let the slave follow it, rather than move both?
      bool                       leads = false;
      dealii::FullMatrix<double> mixed; ///< int N_i^slave N_j^master
      dealii::FullMatrix<double>
        mass; ///< int N_i^master N_j^master; empty unless asked for
      dealii::FullMatrix<double> constraint; ///< int psi_i N_j^master
    };

    dealii::FullMatrix<double>
      mass; ///< int N_i^slave N_j^slave; empty: no partner
    /// psi_i = sum_j multiplier_ij N_j.
    dealii::FullMatrix<double> multiplier;
    dealii::FullMatrix<double> constraint; ///< int psi_i N_j^slave
    /// Dual multipliers: int psi_i; else empty.
    std::vector<double> weights;
    std::vector<dealii::Tensor<1, dim>>
      gap_moment; ///< int psi_i (x_master - x_slave)
    std::vector<dealii::Tensor<1, dim>> position_moment; ///< int psi_i x_slave
    std::vector<Partner>                partners;
    std::vector<Stiffness>              springs; ///< by node; empty: a tie
    /// Standard multipliers that stand for pressures, where the normal turns:
    /// the traction of psi_k at node i of n, at k n + i; else empty, and it is
    /// the normal at node k there. It is psi_k n, n interpolated from the
    /// normals at nodes, as a polynomial of the face that does the same work on
    /// those: a body then turns freely in its bore. psi_k n_k would hold it,
    /// since psi_k has both signs from degree 2 on.
    std::vector<dealii::Tensor<1, dim>> along_normals;
    double                              penalty =
      0.; ///< scale of jump penalties: about E / h of the softer side, or of
          ///< the slave where a master leads, since it is what moves

    /// How much of the face's multipliers take part, see select_multipliers().
    double active_share = 1.;

    bool
    is_dual() const
    {
      return !weights.empty();
    }
  };

  /// Clip @p interface and integrate; one entry per slave face. @p may_lead: let slaves follow
  /// where that pays. @p frames: slave_frames() where multipliers are along normals,
  /// else empty. Collective.
  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler                      &interface,
                     bool                                   with_master_mass,
                     MultiplierBasis                        basis,
                     bool                                   may_lead = true,
                     const std::vector<std::vector<Frame>> &frames   = {});
} // namespace mortise
