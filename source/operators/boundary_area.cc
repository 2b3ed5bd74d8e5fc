#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/operators/boundary_area.h>
#include <mortise/operators/cells/face_values.h>

#include <map>
#include <memory>
#include <vector>

namespace mortise
{
  using namespace dealii;

  BoundaryArea
  boundary_area(const Body &body, const types::boundary_id boundary)
  {
    // moments about the origin would lose digits where a body is far from it
    Point<dim>          origin;
    std::vector<double> first(4); // area, moments of first order
    std::vector<double> second(6);
    const MPI_Comm      comm = body.triangulation().get_communicator();
    std::map<std::pair<unsigned int, unsigned int>, std::unique_ptr<FaceValues>>
               faces;
    const auto for_each_point = [&](const auto &visit) {
      for (const auto &[cell, f] : boundary_faces(body, boundary))
        if (cell->is_locally_owned())
          {
            auto &face = faces[{cell->active_fe_index(), f}];
            if (!face)
              face = std::make_unique<FaceValues>(
                body, cell, f, traction_points(cell->get_fe()));
            face->reinit(cell);
            for (unsigned int q = 0; q < face->points.size(); ++q)
              visit(face->points[q] - origin, face->weights[q]);
          }
    };
    for_each_point([&](const Tensor<1, dim> &x, const double weight) {
      first[0] += weight;
      for (unsigned int c = 0; c < dim; ++c)
        first[1 + c] += weight * x[c];
    });
    Utilities::MPI::sum(first, comm, first);
    BoundaryArea result;
    result.area = first[0];
    for (unsigned int c = 0; c < dim; ++c)
      origin[c] = first[1 + c] / first[0];
    result.centroid = origin;
    for_each_point([&](const Tensor<1, dim> &r, const double weight) {
      for (unsigned int i = 0, k = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j, ++k)
          second[k] += weight * ((i == j ? r.norm_square() : 0.) - r[i] * r[j]);
    });
    Utilities::MPI::sum(second, comm, second);
    for (unsigned int i = 0, k = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j, ++k)
        result.inertia[i][j] = second[k];
    return result;
  }

  std::function<Tensor<1, dim>(const Point<dim> &)>
  equivalent_traction(const BoundaryArea   &boundary,
                      const Tensor<1, dim> &force,
                      const Tensor<1, dim> &moment)
  {
    const Tensor<1, dim> uniform = force / boundary.area;
    Tensor<1, dim>       w;
    if (moment.norm_square() > 0.)
      w = invert(boundary.inertia) * moment;
    return [uniform, w, centroid = boundary.centroid](const Point<dim> &x) {
      return uniform + cross_product_3d(w, x - centroid);
    };
  }
} // namespace mortise
