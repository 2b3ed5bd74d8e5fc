#include <mortise/adapt/stress_on_faces.h>

namespace mortise
{
  using namespace dealii;

  StressOnFaces::StressOnFaces(
    const Body         &body,
    const BodySolution &solution,
    const bool          with_cofactors,
    const std::function<void(const Body::CellIterator &, const CellFields &)>
      &visit)
    : body(body)
    , stresses(body.triangulation().n_active_cells())
  {
    CellFields fields(body, [&](const FiniteElement<dim> &element) {
      return StressPolynomials::nodes(body, element);
    });
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const unsigned int index = cell->active_cell_index();
          fields.reinit(cell, solution);
          for (unsigned int q = 0; q < fields.points.size(); ++q)
            stresses[index].push_back(fields.respond(q).nominal);
          if (!cell->is_locally_owned())
            continue;
          if (with_cofactors && cell->at_boundary())
            for (const Tensor<2, dim> &gradient : fields.gradients)
              {
                const Tensor<2, dim> F = deformation_gradient(gradient);
                all_cofactors[index].push_back(determinant(F) *
                                               transpose(invert(F)));
              }
          visit(cell, fields);
        }
  }

  StressPolynomials &
  StressOnFaces::polynomials(const Body::CellIterator &cell)
  {
    auto &result = by_element[cell->active_fe_index()];
    if (!result)
      result = std::make_unique<StressPolynomials>(body, cell->get_fe());
    return *result;
  }

  std::vector<Tensor<2, dim>>
  StressOnFaces::cofactors(const Body::CellIterator &cell, const unsigned int f)
  {
    const auto found = all_cofactors.find(cell->active_cell_index());
    return found == all_cofactors.end() ?
             std::vector<Tensor<2, dim>>() :
             polynomials(cell).on_face(f, found->second);
  }

  Tensor<1, dim>
  StressOnFaces::traction(const double                      *factors,
                          const std::vector<Tensor<2, dim>> &tensors,
                          const Tensor<1, dim>              &normal)
  {
    Tensor<2, dim> sum;
    for (unsigned int k = 0; k < tensors.size(); ++k)
      sum += factors[k] * tensors[k];
    return sum * normal;
  }

  FaceGeometry &
  StressOnFaces::geometry(const Body::CellIterator &cell,
                          const unsigned int        f,
                          const unsigned int        n)
  {
    auto &result = geometries[{{cell->active_fe_index(), f, n}}];
    if (!result)
      result = std::make_unique<FaceGeometry>(body,
                                              f,
                                              face_rule(cell->get_fe(), f, n));
    result->reinit(cell);
    return *result;
  }

  template <typename Points>
  const std::vector<double> &
  StressOnFaces::factors_at(const Body::CellIterator        &cell,
                            const unsigned int               f,
                            const std::vector<unsigned int> &key,
                            const Points                    &points)
  {
    auto &result = all_factors[{{{cell->active_fe_index(), f, 0}}, key}];
    if (result.empty())
      for (const Point<dim> &x : points())
        for (const double factor : polynomials(cell).factors_on_face(f, x))
          result.push_back(factor);
    return result;
  }

  const std::vector<double> &
  StressOnFaces::factors(const Body::CellIterator &cell,
                         const unsigned int        f,
                         const unsigned int        n)
  {
    return factors_at(cell, f, {n}, [&] {
      return face_rule(cell->get_fe(), f, n).get_points();
    });
  }

  const std::vector<double> &
  StressOnFaces::factors_beyond(const Body::CellIterator &cell,
                                const unsigned int        f,
                                const unsigned int        n,
                                const Body::CellIterator &neighbour,
                                const NeighbourFace      &beyond)
  {
    return factors_at(
      neighbour,
      beyond.number,
      {n,
       cell->active_fe_index(),
       f,
       beyond.corners[0],
       beyond.corners[1],
       beyond.corners[2],
       beyond.child ? *beyond.child + 1 : 0},
      [&] { return points_in_neighbour(cell->get_fe(), f, n, beyond); });
  }
} // namespace mortise
