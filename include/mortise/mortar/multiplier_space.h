// The multipliers of one interface: the trace space of the slave's
// displacements, component by component, reduced where that keeps the coupling
// stable.
//
// The reduction, without any flag from the user, per component c:
// - rims: where all displacements of a slave face's edge are prescribed
// (Dirichlet, or the dofs of an
//   earlier interface), the degree across the edge is one less in that face, so
//   that there are as many multipliers as free displacements and constants stay
//   representable; at degree 1 the vertex on the rim takes the mean of its
//   neighbours off the rim; where no vertex of a patch of faces is free, one
//   constant is left on it, where any displacement of either side is free;
// - hanging nodes and mixed degrees: the conforming trace space, by the body's
// constraints;
// - faces covered in part: those covered by less than nine tenths have only
// multipliers of degree 1, those
//   covered by less than a tenth go on with the values at the vertices that
//   they share with better covered ones, so that constants pass there, too.
// Sources: Bernardi, Maday, Patera (1994); Wohlmuth (2000); Seshaiyer, Suri
// (2000).
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/body.h>
#include <mortise/interface/body_surface.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/mortar/multiplier_faces.h>
#include <mortise/mortar/slave_frames.h>

#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace mortise
{
  struct Coupling;

  /// The multipliers of one coupling among those that this rank owns of all
  /// couplings.
  struct MultiplierRange
  {
    unsigned int first = 0, size = 0;

    unsigned int
    end() const
    {
      return first + size;
    }
  };

  class MultiplierSpace
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// A multiplier that is the coefficient of a function on a face.
    struct Coefficient
    {
      Index               index;
      unsigned int        direction; ///< component, 0 along normals
      std::vector<double> of_values; ///< what gives it from those at the nodes
    };

    /// Multipliers on one face: value_c(xi) = sum_k psi_k(xi) sum_j weight_j
    /// lambda_index_j with row = c (degree + 1)^2 + k, k the nodes of the face,
    /// psi as in LocalCoupling. Most nodes have a multiplier of their own.
    /// Along normals, value_c(xi) = sum_i psi_i(xi) sum_k directions_ki,c sum_j
    /// weight_j lambda_index_j with row = k: the normal of the frame of node k,
    /// where k = i, or along_normals.
    struct FaceRows
    {
      std::vector<unsigned int> begin;
      std::vector<Index>  index; ///< numbering of all multipliers of the scene
      std::vector<double> weight;
      /// By entry: has an earlier component a multiplier there whose row of B
      /// has the same entries?
      std::vector<bool> is_represented;
      /// Those that are no value at a node, but a coefficient.
      std::vector<Coefficient> coefficients;
      /// By component, the same for all along normals: is there a multiplier
      /// that is one on the whole face? If not, constant tractions do not pass.
      std::array<bool, dim> hold_constants{};
      /// By node: the directions of its multipliers, in rows, those of the
      /// axes where all components are held.
      std::vector<Frame> frames;
      /// See LocalCoupling.
      std::vector<dealii::Tensor<1, dim>> along_normals;

      /// Calls visit(node, direction) for the nodes where @p row has a part of
      /// the traction: direction times the sum of its multipliers.
      template <typename Visit>
      void
      for_each_direction(const unsigned int row, const Visit &visit) const
      {
        const unsigned int n = n_nodes();
        if (!along_normals.empty())
          for (unsigned int i = 0; i < n; ++i)
            visit(i, along_normals[row * n + i]);
        else
          visit(row % n, frames[row % n][row / n]);
      }

      unsigned int
      n_nodes() const
      {
        return frames.size();
      }
    };

    /// Decide which multipliers @p coupling has, whose slave is a boundary of @p body. @p partners: by slave
    /// face. @p blocked: whether a locally owned displacement dof (position in
    /// the owned range) is prescribed by a boundary condition or belongs to an
    /// earlier interface. Where the law is one-sided, multipliers have the sign
    /// of the pressure: values at nodes where they are dual, else Bernstein
    /// coefficients of the same polynomials. Collective.
    MultiplierSpace(const Body                      &body,
                    const Coupling                  &coupling,
                    const std::vector<PartnerState> &partners,
                    const std::vector<bool>         &blocked);

    /// Multipliers owned by this rank.
    unsigned int
    n_owned() const
    {
      return owned_dofs.size();
    }

    /// The number of the first of these; valid after number().
    Index
    first() const
    {
      return first_number;
    }

    /// Displacement dofs (DoFHandler's numbering, owned) that the owned
    /// multipliers sit on.
    const std::vector<Index> &
    slave_dofs() const
    {
      return owned_dofs;
    }

    /// Those of this rank; valid after number().
    const MultiplierRange &
    range() const
    {
      return owned_range;
    }

    /// Number the owned multipliers from @p first on and collect the rows of this rank's slave
    /// faces. @p first_owned: the number that this rank owns of couplings before. Collective.
    void
    number(const BodySurface &slave, Index first, unsigned int first_owned = 0);

    struct Rows
    {
      std::vector<FaceRows>            by_face; ///< of the slave
      std::vector<CouplingMatrix::Row> owned;
    };

    /// By slave face; valid after number().
    const std::vector<FaceRows> &
    rows() const
    {
      return numbered.by_face;
    }

    /// The rows of B by owned multiplier; valid after number().
    const std::vector<CouplingMatrix::Row> &
    matrix_rows() const
    {
      return numbered.owned;
    }

    /// The constraint in rows that move one component each: a multiplier is a
    /// combination of them. Where all directions are tied, both are the same
    /// but for their numbers.
    struct ComponentRows
    {
      Rows rows; ///< of all directions, in numbers of component rows
      /// (multiplier, component row, weight); those that several faces see are
      /// there several times.
      std::vector<std::tuple<Index, Index, double>> frames;
    };

    /// Component rows owned by this rank. Collective.
    unsigned int
    n_component_rows(const BodySurface &slave) const;

    /// Valid after number(). @p first: the number of the first row that this
    /// rank owns. Collective.
    ComponentRows
    component_rows(const BodySurface &slave, Index first) const;

  private:
    /// The rows with the owned multipliers numbered from @p first on. Collective.
    Rows
    make_rows(const BodySurface &slave, Index first) const;

    const Body                     &body;
    std::vector<std::vector<Frame>> frames; ///< by face, see FaceRows
    unsigned int      n_directions;         ///< dim, or 1: along the normals
    bool              presses_only;
    std::vector<bool> has_dual;                                     ///< by face
    std::vector<std::vector<dealii::Tensor<1, dim>>> along_normals; ///< by face
    std::vector<Index>                               owned_dofs;
    std::vector<bool> at_vertices; ///< by owned multiplier
    /// By owned multiplier: the dof of the first component there, its
    /// component.
    std::vector<std::pair<Index, unsigned int>> places;
    dealii::AffineConstraints<double>
                    reduction; ///< in the body's numbering; closed
    Rows            numbered;
    Index           first_number = 0;
    MultiplierRange owned_range;
  };
} // namespace mortise
