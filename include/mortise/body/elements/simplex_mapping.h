// Curved tetrahedra: a mapping of any degree 1..8 whose points lie on the
// manifolds of the mesh and are computed once, as MappingQCache does for
// hexahedra. It never moves a vertex and never changes a manifold.
#pragma once

#include <deal.II/base/scalar_polynomials_base.h>

#include <deal.II/fe/mapping_fe.h>

#include <functional>
#include <memory>
#include <vector>

namespace mortise
{
  /// Polynomial of degree @p degree on each cell through the points of
  /// simplex_interpolation_points(), which lie on the manifolds of lines, faces
  /// and cells; a face or cell without one blends what is around it, see
  /// simplex_blending.h. Cells that share a line or face have the same points
  /// there whatever their numbering. Source of the seam: MappingFE of deal.II,
  /// of which only the origin of the points is replaced.
  class SimplexMapping : public dealii::MappingFE<3>
  {
  public:
    using CellIterator = dealii::Triangulation<3>::cell_iterator;

    /// Places of points of a cell's reference cell.
    using PointsOfCell = std::function<
      std::vector<dealii::Point<3>>(const CellIterator &,
                                    const std::vector<dealii::Point<3>> &)>;

    /// @p degree: 1..8. The points are those of all cells of
    /// @p triangulation that are not artificial, as it is now.
    SimplexMapping(unsigned int                    degree,
                   const dealii::Triangulation<3> &triangulation);

    /// The same with points from @p points_of_cell instead of manifolds; cells
    /// must agree where they meet.
    SimplexMapping(unsigned int                    degree,
                   const dealii::Triangulation<3> &triangulation,
                   const PointsOfCell             &points_of_cell);

    std::unique_ptr<dealii::Mapping<3>>
    clone() const override
    {
      return std::make_unique<SimplexMapping>(*this);
    }

    /// Points of @p cell, not artificial, in the order of reference_nodes().
    const std::vector<dealii::Point<3>> &
    nodes(const CellIterator &cell) const
    {
      return (*points)[cell->active_cell_index()];
    }

    /// simplex_interpolation_points() of the degree.
    std::vector<dealii::Point<3>>
    reference_nodes() const;

    /// The polynomials that are one at one of these points and zero at the
    /// others.
    const dealii::ScalarPolynomialsBase<3> &
    nodal_polynomials() const
    {
      return *nodal;
    }

    /// Make cells straight the determinant of whose Jacobian is not positive at one of @p unit_points: their lines, and
    /// faces and cells that share one. Number of such cells on all ranks.
    /// Collective; before anything else uses the mapping.
    unsigned int
    straighten_tangled_cells(const dealii::Triangulation<3>      &triangulation,
                             const std::vector<dealii::Point<3>> &unit_points);

    /// The same as the base class, but quick, and without the second
    /// derivatives that it wants. Also outside of the cell.
    dealii::Point<3>
    transform_unit_to_real_cell(const CellIterator     &cell,
                                const dealii::Point<3> &point) const override;

    /// By Newton's method. Throws ExcTransformationFailed.
    dealii::Point<3>
    transform_real_to_unit_cell(const CellIterator     &cell,
                                const dealii::Point<3> &point) const override;

  protected:
    std::vector<dealii::Point<3>>
    compute_mapping_support_points(const CellIterator &cell) const override;

  private:
    using Points = std::vector<std::vector<dealii::Point<3>>>;

    /// By active cell index; shared by all clones.
    std::shared_ptr<const Points>                           points;
    std::shared_ptr<const dealii::ScalarPolynomialsBase<3>> nodal;
  };
} // namespace mortise
