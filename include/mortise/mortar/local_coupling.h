// Integrals of shape functions over one slave face and its partners: the local
// blocks of D and M. They are the same for the three components.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/interface/interface_handler.h>

#include <vector>

namespace mortise
{
  /// Integrals over the covered part of one slave face. Functions are those of
  /// FaceTrace.
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
    };

    dealii::FullMatrix<double>
      mass; ///< int N_i^slave N_j^slave; empty: no partner
    std::vector<dealii::Tensor<1, dim>>
      gap_moment; ///< int N_i^slave (x_master - x_slave)
    std::vector<dealii::Tensor<1, dim>>
                         position_moment; ///< int N_i^slave x_slave
    std::vector<Partner> partners;
    double               penalty =
      0.; ///< scale of jump penalties: 2.5 E / h of the softer side, or of the
          ///< slave where a master leads, since it is what moves
  };

  /// Clip @p interface and integrate; one entry per slave face. Collective.
  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler &interface, bool with_master_mass);
} // namespace mortise
