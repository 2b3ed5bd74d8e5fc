// Where slip counts from: the pairs of the last accepted state, for interfaces
// with friction that follow the bodies.
//
// A point of the slave slips by the way from the point of the master that it
// was at to the one that it is at, both where they are now, so that a common
// motion of the bodies is no slip. Source: Puso, Laursen (2004). What is kept
// belongs to slave faces and not to multipliers, since these change with the
// part of a face that is covered.
#pragma once

#include <mortise/mortar/coupling.h>

#include <map>
#include <vector>

namespace mortise
{
  class SlipOrigin
  {
  public:
    /// Keep the pairs of @p couplings, made at this @p displacement of nodes.
    /// Collective.
    SlipOrigin(const std::vector<Coupling> &couplings,
               const dealii::IndexSet      &owned_displacement,
               const Vector                &displacement,
               MPI_Comm                     comm);

    struct Opening
    {
      /// With an entry for each multiplier: the mean of x_master - x_slave,
      /// with the master's points that were partners, where the bodies are
      /// now. On faces that had no partner it is that of the present ones.
      dealii::Tensor<1, dim> mean;
      bool                   has_partner = false; ///< had any face one?
    };

    /// By node of contact of @p couplings, the present ones, at this
    /// @p displacement. Collective.
    std::vector<Opening>
    openings(const std::vector<Coupling> &couplings,
             const Vector                &displacement,
             const dealii::IndexSet      &owned_multiplier) const;

  private:
    struct Face
    {
      bool         has_partner = false;
      unsigned int first       = 0; ///< owned row
      /// Of x_master - x_slave in the functions N of LocalCoupling.
      std::vector<dealii::Tensor<1, dim>> opening;
    };

    /// By Coupling::number and slave face.
    std::map<unsigned int, std::vector<Face>> faces;
    /// What a displacement subtracts from these, functions x nodes.
    SparseMatrix closing;
    Vector       displacement;
    MPI_Comm     comm;
  };
} // namespace mortise
