#include <mortise/body/boundary_faces.h>
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/cells/face_values.h>
#include <mortise/operators/follower_pressures.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  FollowerPressures::Functions
  FollowerPressures::make_functions(const Body               &body,
                                    const Body::CellIterator &cell,
                                    const unsigned int        f,
                                    const Quadrature<dim>    &rule)
  {
    const auto &element = cell->get_fe();
    const auto  along   = FaceGeometry(body, f, rule).reference_tangents();
    CellOrder   order(element);
    const auto &scalar = element.base_element(0);
    Functions   result;
    // functions of nodes by the hierarchical ones
    for (unsigned int node = 0; node < order.values.size(); ++node)
      {
        std::fill(order.values.begin(), order.values.end(), 0.);
        order.values[node] = 1.;
        order.transform_to_modes();
        std::vector<double> values, slopes[2];
        double              largest = 0.;
        for (const dealii::Point<dim> &x : rule.get_points())
          {
            double  value = 0.;
            Vector3 slope;
            for (unsigned int i = 0; i < order.values.size(); ++i)
              if (order.values[i] != 0.)
                {
                  value +=
                    order.values[i] * scalar.shape_value(order.scalar[i], x);
                  slope +=
                    order.values[i] * scalar.shape_grad(order.scalar[i], x);
                }
            values.push_back(value);
            for (unsigned int d = 0; d < 2; ++d)
              slopes[d].push_back(slope * along[d]);
            largest = std::max(largest, std::fabs(value));
          }
        constexpr double rounding = 1e-10;
        if (largest < rounding)
          continue;
        result.nodes.push_back(order.scalar[node]);
        result.values.insert(result.values.end(), values.begin(), values.end());
        for (unsigned int d = 0; d < 2; ++d)
          result.slopes[d].insert(result.slopes[d].end(),
                                  slopes[d].begin(),
                                  slopes[d].end());
      }
    // from [function][point]
    const unsigned int n = result.nodes.size(), m = rule.size();
    const auto         transpose = [&](std::vector<double> &table) {
      std::vector<double> turned(table.size());
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int q = 0; q < m; ++q)
          turned[q * n + k] = table[k * m + q];
      table = std::move(turned);
    };
    transpose(result.values);
    for (auto &slopes : result.slopes)
      transpose(slopes);
    return result;
  }

  FollowerPressures::FollowerPressures(const MultigridLevel     &level,
                                       const std::vector<Loads> &loads)
  {
    std::map<std::array<unsigned int, 3>, std::shared_ptr<const Functions>>
                                   functions; // by body, element and face
    std::vector<NodalSpace::Index> nodes;
    for (const Body *body : level.space->bodies())
      for (const PressureCondition &condition :
           loads[body->index].follower_pressures)
        for (const auto &[cell, f] : boundary_faces(*body, condition.boundary))
          {
            if (!cell->is_locally_owned())
              continue;
            const Quadrature<dim> rule =
              face_rule(cell->get_fe(), f, traction_points(cell->get_fe()));
            const std::array<unsigned int, 3> key{
              {body->index, cell->active_fe_index(), f}};
            auto &of_face = functions[key];
            if (!of_face)
              of_face = std::make_shared<const Functions>(
                make_functions(*body, cell, f, rule));
            FaceGeometry geometry(*body, f, rule);
            geometry.reinit(cell);
            level.space->get_nodes(body->index, cell, nodes);
            Face face{body, condition.boundary, of_face, {}, {}};
            for (const unsigned int node : of_face->nodes)
              face.indices.push_back(
                level.layout->global_to_local(dim * nodes[node]));
            for (unsigned int q = 0; q < rule.size(); ++q)
              face.points.push_back(
                {condition.pressure(geometry.points[q]) * rule.weight(q),
                 geometry.tangents[q],
                 {}});
            faces.push_back(std::move(face));
          }
  }

  std::array<FollowerPressures::Vector3, 2>
  FollowerPressures::tangents(const Face        &face,
                              const unsigned int q,
                              const double      *u) const
  {
    std::array<Vector3, 2> result;
    const Functions       &of = *face.functions;
    const unsigned int     n  = of.nodes.size();
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < 2; ++d)
          result[d][c] += of.slopes[d][q * n + k] * u[face.indices[k] + c];
    return result;
  }

  void
  FollowerPressures::add_forces(const double            *u,
                                double                  *target,
                                const Body              *body,
                                const types::boundary_id boundary) const
  {
    for (const Face &face : faces)
      {
        if (body != nullptr && (face.body != body || face.boundary != boundary))
          continue;
        const unsigned int n = face.indices.size();
        for (unsigned int q = 0; q < face.points.size(); ++q)
          {
            const Point &point = face.points[q];
            auto         x     = tangents(face, q, u);
            for (unsigned int d = 0; d < 2; ++d)
              x[d] += point.along[d];
            const Vector3 force = -point.load * cross_product_3d(x[0], x[1]);
            for (unsigned int k = 0; k < n; ++k)
              for (unsigned int c = 0; c < dim; ++c)
                target[face.indices[k] + c] +=
                  force[c] * face.functions->values[q * n + k];
          }
      }
  }

  void
  FollowerPressures::linearise(const double *u)
  {
    for (Face &face : faces)
      for (unsigned int q = 0; q < face.points.size(); ++q)
        {
          Point &point   = face.points[q];
          point.deformed = tangents(face, q, u);
          for (unsigned int d = 0; d < 2; ++d)
            point.deformed[d] += point.along[d];
        }
  }

  void
  FollowerPressures::add_product(const double *du, double *dst) const
  {
    for (const Face &face : faces)
      {
        const Functions   &of = *face.functions;
        const unsigned int n  = face.indices.size();
        for (unsigned int q = 0; q < face.points.size(); ++q)
          {
            const Point  &point = face.points[q];
            const auto   &x     = point.deformed;
            const auto    dx    = tangents(face, q, du);
            const Vector3 force = point.load * (cross_product_3d(dx[0], x[1]) +
                                                cross_product_3d(x[0], dx[1]));
            for (unsigned int k = 0; k < n; ++k)
              for (unsigned int c = 0; c < dim; ++c)
                dst[face.indices[k] + c] += force[c] * of.values[q * n + k];
          }
      }
  }
} // namespace mortise
