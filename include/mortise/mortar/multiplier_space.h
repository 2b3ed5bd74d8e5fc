// The multiplier space of one interface: the trace space of the slave's
// displacements, component by component, reduced for stability (inf-sup).
//
// The reduction of each component:
// - rims: if all displacements of a slave face's edge are prescribed
//   (Dirichlet, or dofs of an earlier interface), the degree across the edge is
//   one less in that face, so that there are as many multipliers as free
//   displacements and constants remain; at degree 1 the vertex on the rim has
//   the mean of its neighbours off the rim; on a patch of faces without a free
//   vertex one constant remains if some displacement of either side is free;
// - hanging nodes and mixed degrees: the conforming trace space;
// - partial coverage: multipliers of degree 1 below nine tenths; below a tenth
//   the extension of the values at vertices shared with other faces, so that
//   constants remain. Sources: Bernardi, Maday, Patera (1994); Wohlmuth (2000);
//   Seshaiyer, Suri (2000).
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/body.h>
#include <mortise/interface/body_surface.h>
#include <mortise/mortar/coupling_matrix.h>
#include <mortise/mortar/multiplier_faces.h>
#include <mortise/mortar/slave_frames.h>

#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace mortise
{
  struct Coupling;

  /// The multipliers of one coupling among the owned ones of all couplings.
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
      std::vector<double> of_values; ///< weights of the values at nodes
    };

    /// Multipliers on one face: value_c(xi) = sum_k psi_k(xi) sum_j weight_j
    /// lambda_index_j with row = c (degree + 1)^2 + k, k the nodes of the face,
    /// psi as in LocalCoupling. Most nodes have a multiplier of their own.
    /// Along normals, value_c(xi) = sum_i psi_i(xi) sum_k directions_ki,c sum_j
    /// weight_j lambda_index_j with row = k: the normal of the frame of node k,
    /// where k = i, or along_normals.
    struct FaceMultipliers
    {
      std::vector<unsigned int> begin;
      std::vector<Index>  index; ///< numbering of all multipliers of the scene
      std::vector<double> weight;
      /// By entry: is there a multiplier of an earlier component at the node
      /// whose row of B has the same entries?
      std::vector<bool> is_represented;
      /// Multipliers that are coefficients, not values at nodes.
      std::vector<Coefficient> coefficients;
      /// By component (equal for all along normals): is the constant function
      /// on the face a multiplier, so that constant tractions are exact?
      std::array<bool, dim> reproduce_constants{};
      /// By node: the directions of its multipliers, in rows; the axes if all
      /// components are constrained.
      std::vector<Frame> frames;
      /// See LocalCoupling.
      std::vector<dealii::Tensor<1, dim>> along_normals;

      /// Calls visit(node, direction) for the nodes with a traction from
      /// @p row: direction times the sum of its multipliers.
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

    /// Choose the multipliers of @p coupling, whose slave belongs to @p body.
    /// @p partners: by slave face. @p constrained: by owned displacement dof,
    /// whether it is prescribed or belongs to an earlier interface. Multipliers
    /// of a one-sided law have the sign of the pressure: values at nodes if
    /// dual, else Bernstein coefficients of the same polynomials. Collective.
    MultiplierSpace(const Body                      &body,
                    const Coupling                  &coupling,
                    const std::vector<PartnerState> &partners,
                    const std::vector<bool>         &constrained);

    /// Multipliers owned by this rank.
    unsigned int
    n_owned() const
    {
      return owned_dofs.size();
    }

    /// Global index of the first one; valid after number().
    Index
    first() const
    {
      return first_number;
    }

    /// Owned displacement dofs (DoFHandler's numbering) of the owned
    /// multipliers.
    const std::vector<Index> &
    slave_dofs() const
    {
      return owned_dofs;
    }

    /// By owned multiplier, the dof of the first component at its node.
    std::vector<Index>
    nodes() const
    {
      std::vector<Index> result;
      for (const auto &[node, component] : nodes_and_components)
        result.push_back(node);
      return result;
    }

    /// Owned multipliers; valid after number().
    const MultiplierRange &
    range() const
    {
      return owned_range;
    }

    /// Number the owned multipliers from @p first on and collect the rows of
    /// slave faces. @p first_owned: number of owned multipliers of earlier
    /// couplings. Collective.
    void
    number(const BodySurface &slave, Index first, unsigned int first_owned = 0);

    struct Rows
    {
      std::vector<FaceMultipliers>     by_face; ///< of the slave
      std::vector<CouplingMatrix::Row> owned;
    };

    /// By slave face; valid after number().
    const std::vector<FaceMultipliers> &
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

    /// The rows of B_c (see CouplingMatrix), which act on one component each
    /// and of which multipliers are combinations; for ties one row is one
    /// multiplier.
    struct ComponentRows
    {
      Rows rows; ///< of all directions, in numbers of component rows
      /// By face: those of tractions across the normals, where
      /// LocalCoupling::directed is that of the others, or of masters that are
      /// turned; else empty.
      std::vector<FaceMultipliers> across;
      /// (multiplier, component row, weight), repeated for each face.
      std::vector<std::tuple<Index, Index, double>> frames;
    };

    /// Component rows owned by this rank. Collective.
    unsigned int
    n_component_rows(const BodySurface &slave) const;

    /// Valid after number(). @p first: index of the first owned row.
    /// Collective.
    ComponentRows
    component_rows(const BodySurface &slave, Index first) const;

  private:
    /// Q u of the master at the nodes of the slave. Collective.
    void
    add_turned_masters(const BodySurface &slave,
                       Index              first,
                       ComponentRows     &rows) const;
    /// Rows with owned multipliers numbered from @p first on. Collective.
    Rows
    make_rows(const BodySurface &slave, Index first) const;

    const Body                     &body;
    std::vector<std::vector<Frame>> frames; ///< by face, see FaceMultipliers
    unsigned int n_directions;              ///< dim, or 1: along the normals
    bool         one_sided;
    bool         directed; ///< see LocalCoupling::is_directed()
    /// Q of a master that is turned.
    std::optional<dealii::Tensor<2, dim>> turn;
    /// By face and node, if tractions across them have multipliers, too.
    std::vector<std::vector<dealii::Tensor<1, dim>>> normals;
    std::vector<bool>                                has_dual; ///< by face
    /// By face: have all components the same functions, since the pressure at a
    /// node of friction is a sum of several?
    std::vector<bool>                                together;
    std::vector<std::vector<dealii::Tensor<1, dim>>> along_normals; ///< by face
    std::vector<Index>                               owned_dofs;
    std::vector<bool> at_vertices; ///< by owned multiplier
    /// By owned multiplier: the dof of the first component at its node, its
    /// component.
    std::vector<std::pair<Index, unsigned int>> nodes_and_components;
    dealii::AffineConstraints<double>
                    reduction; ///< in the body's numbering; closed
    Rows            numbered;
    Index           first_number = 0;
    MultiplierRange owned_range;
  };
} // namespace mortise
