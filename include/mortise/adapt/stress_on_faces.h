// The nominal stress of one body as polynomials on its cells and faces.
#pragma once

#include <mortise/adapt/cell_states.h>
#include <mortise/adapt/neighbour_face.h>
#include <mortise/adapt/stress_polynomials.h>
#include <mortise/operators/cells/cell_fields.h>
#include <mortise/operators/cells/face_values.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  class StressOnFaces
  {
  public:
    /// References must live on. @p visit is called with each owned cell and its
    /// fields at StressPolynomials::nodes(). @p with_cofactors: keeps cof F of
    /// owned cells at the boundary.
    StressOnFaces(const Body                                    &body,
                  const BodySolution                            &solution,
                  bool                                           with_cofactors,
                  const std::function<void(const Body::CellIterator &,
                                           const CellFields &)> &visit);

    /// The force per undeformed volume at points of StressPolynomials::rule().
    std::vector<dealii::Tensor<1, dim>>
    divergence(const Body::CellIterator &cell)
    {
      return polynomials(cell).divergence(cell,
                                          stresses[cell->active_cell_index()]);
    }

    StressPolynomials &
    polynomials(const Body::CellIterator &cell);

    /// On a face of an owned or ghost cell, to be multiplied by factors of its
    /// points.
    std::vector<dealii::Tensor<2, dim>>
    stress(const Body::CellIterator &cell, const unsigned int f)
    {
      return polynomials(cell).on_face(f, stresses[cell->active_cell_index()]);
    }

    /// The same of cof F; empty where it is not kept.
    std::vector<dealii::Tensor<2, dim>>
    cofactors(const Body::CellIterator &cell, unsigned int f);

    /// The sum of @p tensors of a face times their @p factors, times @p normal.
    static dealii::Tensor<1, dim>
    traction(const double                              *factors,
             const std::vector<dealii::Tensor<2, dim>> &tensors,
             const dealii::Tensor<1, dim>              &normal);

    /// Of face_rule() with @p n points per direction; until the next call for
    /// the same element, face and n.
    FaceGeometry &
    geometry(const Body::CellIterator &cell, unsigned int f, unsigned int n);

    /// At its points, one after the other.
    const std::vector<double> &
    factors(const Body::CellIterator &cell, unsigned int f, unsigned int n);

    /// At the same points, those of face @p f of @p cell, of its neighbour
    /// there.
    const std::vector<double> &
    factors_beyond(const Body::CellIterator &cell,
                   unsigned int              f,
                   unsigned int              n,
                   const Body::CellIterator &neighbour,
                   const NeighbourFace      &beyond);

  private:
    using Key = std::array<unsigned int, 3>; ///< element, face, points or 0

    /// Made once for each @p key.
    template <typename Points>
    const std::vector<double> &
    factors_at(const Body::CellIterator        &cell,
               unsigned int                     f,
               const std::vector<unsigned int> &key,
               const Points                    &points);

    const Body                                      &body;
    std::vector<std::vector<dealii::Tensor<2, dim>>> stresses; ///< by cell
    std::map<unsigned int, std::vector<dealii::Tensor<2, dim>>>
      all_cofactors; ///< by cell
    std::map<unsigned int, std::unique_ptr<StressPolynomials>> by_element;
    std::map<Key, std::unique_ptr<FaceGeometry>>               geometries;
    std::map<std::pair<Key, std::vector<unsigned int>>, std::vector<double>>
      all_factors;
  };
} // namespace mortise
