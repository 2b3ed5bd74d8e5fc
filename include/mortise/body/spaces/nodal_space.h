// The displacements (or pressures) of a whole scene by values at nodes
// (Gauss-Lobatto points of hexahedra, those of simplex_nodes.h of tetrahedra):
// the space of the hierarchical element, hp and hanging nodes included, in the
// basis that iterative solvers like better. One numbering of nodes for all
// bodies, with lower degrees on the same meshes for multigrid.
#pragma once

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <mortise/body/body.h>
#include <mortise/body/spaces/numbering.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace mortise
{
  /// Values at the nodes of a face, in the order of the functions of
  /// TraceBasis.
  struct FaceNodes
  {
    unsigned int degree = 1;
    /// One per function; where some of a face hang, those that its values
    /// follow from: value k is sum_e weight[e] u(nodes[column[e]]), e =
    /// begin[k] .. begin[k + 1] - 1.
    std::vector<dealii::types::global_dof_index> nodes;
    std::vector<unsigned int>                    begin, column;
    std::vector<double>                          weight;

    bool
    hang() const
    {
      return !begin.empty();
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &degree &nodes &begin &column &weight;
    }
  };

  class NodalSpace
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// Degree here of the cells that have degree @p displacement in @p body, which does not
    /// fall where that rises; 0: nothing there.
    using DegreeRule =
      std::function<unsigned int(const Body &body, unsigned int displacement)>;

    /// The bodies are kept by reference. Collective.
    NodalSpace(const std::vector<const Body *> &bodies,
               const DegreeRule                &rule,
               MPI_Comm                         comm);

    /// Here, of cells that have degree @p displacement in body @p body.
    unsigned int
    degree(const Body &body, const unsigned int displacement) const
    {
      return rule(body, displacement);
    }

    unsigned int
    degree(const Body &body, const Body::CellIterator &cell) const
    {
      return rule(body, body.degree(cell));
    }

    /// Those that have nodes.
    const std::vector<const Body *> &
    bodies() const
    {
      return scene;
    }

    /// Nodes of a cell of body @p body (one of its DoFHandler's), in the order
    /// of the modes of its element: of deal.II's FE_Q on hexahedra, see
    /// ascending_dof_indices() for tetrahedra. @p nodes is resized.
    void
    get_nodes(unsigned int              body,
              const Body::CellIterator &cell,
              std::vector<Index>       &nodes) const;

    /// Calls @p visit(body, cell, nodes) for the owned cells of all bodies, with
    /// the nodes of get_nodes().
    template <typename Visit>
    void
    for_each_cell(const Visit &visit) const
    {
      std::vector<Index> nodes;
      for (const Body *body : scene)
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              get_nodes(body->index, cell, nodes);
              visit(*body, cell, nodes);
            }
    }

    FaceNodes
    face_nodes(const Body               &body,
               const Body::CellIterator &cell,
               unsigned int              face_number) const;

    const dealii::IndexSet &
    owned_nodes() const
    {
      return numbering.owned();
    }

    /// All nodes of owned cells, and those that hanging ones follow from.
    const dealii::IndexSet &
    relevant_nodes() const
    {
      return relevant;
    }

    /// A line for each node of owned cells that hangs, beside larger cells or
    /// ones of lower degree: what its value follows from, nodes that do not
    /// hang.
    const dealii::AffineConstraints<double> &
    hanging_nodes() const
    {
      return hanging;
    }

  private:
    /// The nodes of one body.
    struct Lattice
    {
      dealii::DoFHandler<dim>        handler;
      std::unique_ptr<EntityDegrees> degrees;
    };

    Body::CellIterator
    lattice_cell(unsigned int body, const Body::CellIterator &cell) const;
    void
    distribute(const Body &body);
    void
    find_hanging_nodes();

    std::vector<const Body *>             scene;
    DegreeRule                            rule;
    std::vector<std::unique_ptr<Lattice>> lattices; ///< by body
    FieldNumbering                        numbering;
    dealii::IndexSet                      relevant;
    dealii::AffineConstraints<double>     hanging;
  };

  /// Levels of falling degree on the same meshes, the finest first.
  using NodalSpaces = std::vector<std::shared_ptr<const NodalSpace>>;

  /// Degree on the next level: half of it, from five on rounded up. On
  /// tetrahedra, whose nodes are less regular, by steps of two above four
  /// (doc/measurements/tuning.md).
  constexpr unsigned int
  lower_degree(const bool tetrahedra, const unsigned int degree)
  {
    if (tetrahedra && degree > 4)
      return degree - 2;
    return degree > 4 ? (degree + 1) / 2 : std::max(1U, degree / 2);
  }

  /// The degrees of all cells and those of lower_degree(), down to one; only
  /// the former where multigrid goes on by a ThicknessCoarsening. Collective.
  NodalSpaces
  make_nodal_spaces(const std::vector<const Body *> &bodies, MPI_Comm comm);

  /// The pressures of bodies in mixed form. Collective.
  std::unique_ptr<NodalSpace>
  make_nodal_pressures(const std::vector<const Body *> &bodies, MPI_Comm comm);

  /// Index 3 n + c of each n in @p nodes.
  dealii::IndexSet
  displacement_indices(const dealii::IndexSet &nodes);

  /// Values at the Gauss-Lobatto points of the functions of evaluate_lobatto(),
  /// both in the order of these functions (ends first): entry (node, mode).
  const dealii::FullMatrix<double> &
  modes_to_nodes(unsigned int degree);

  /// The inverse.
  const dealii::FullMatrix<double> &
  nodes_to_modes(unsigned int degree);
} // namespace mortise
