#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/nodal_block.h>
#include <mortise/mortar/slave_frames.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using ByDof = LinearAlgebra::distributed::Vector<double>;

    ByDof
    zeros(const Body &body)
    {
      return ByDof(body.dof_handler.locally_owned_dofs(),
                   body.relevant_dofs,
                   body.triangulation().get_communicator());
    }

    /// Calls visit(s, k, dofs) for the nodes of all slave faces, with the dofs
    /// of the three components; those that share no dof with other faces are
    /// left out.
    template <typename Visit>
    void
    for_each_node(const Body        &body,
                  const BodySurface &slave,
                  const Visit       &visit)
    {
      for (unsigned int s = 0; s < slave.faces.size(); ++s)
        {
          const auto dofs = face_dofs(slave.cells[s], slave.face_numbers[s]);
          const auto own =
            have_shared_nodes(slave.traces[s].basis(), dofs[0], body);
          for (unsigned int k = 0; k < dofs[0].size(); ++k)
            if (own[k])
              visit(s,
                    k,
                    std::array<types::global_dof_index, dim>{
                      {dofs[0][k], dofs[1][k], dofs[2][k]}});
        }
    }

    using Normals = std::vector<std::vector<Tensor<1, dim>>>;

    Normals
    face_normals(const BodySurface &slave)
    {
      Normals normals;
      for (unsigned int s = 0; s < slave.faces.size(); ++s)
        {
          normals.emplace_back();
          for (const Point<2> &xi :
               face_nodes(slave.traces[s].shape, slave.traces[s].degree))
            normals.back().push_back(face_normal(slave.faces[s], xi));
        }
      return normals;
    }

    /// Calls visit(s, k, mean) with the mean of @p normals at the nodes that
    /// faces may share. Collective.
    template <typename Visit>
    void
    for_each_mean(const Body        &body,
                  const BodySurface &slave,
                  const Normals     &normals,
                  const Visit       &visit)
    {
      std::array<ByDof, dim> sums{{zeros(body), zeros(body), zeros(body)}};
      for_each_node(body,
                    slave,
                    [&](const unsigned int s, const unsigned int k, auto dofs) {
                      for (unsigned int c = 0; c < dim; ++c)
                        sums[c](dofs[0]) += normals[s][k][c];
                    });
      for (ByDof &sum : sums)
        {
          sum.compress(VectorOperation::add);
          sum.update_ghost_values();
        }
      for_each_node(body,
                    slave,
                    [&](const unsigned int s, const unsigned int k, auto dofs) {
                      Tensor<1, dim> mean;
                      for (unsigned int c = 0; c < dim; ++c)
                        mean[c] = sums[c](dofs[0]);
                      visit(s, k, mean / mean.norm());
                    });
    }

    /// The cosine of 30 degrees, and rounding: the facets of a hexagon are a
    /// round surface, just so.
    constexpr double least_cosine = 0.866 - 1e-3;

    bool
    is_sharp(const Tensor<1, dim> &normal, const Tensor<1, dim> &mean)
    {
      return !(normal * mean > least_cosine);
    }
  } // namespace

  std::vector<bool>
  have_shared_nodes(const TraceBasis                           &basis,
                    const std::vector<types::global_dof_index> &dofs,
                    const Body                                 &body)
  {
    std::vector<bool> own(dofs.size(), true);
    for (unsigned int k = 0; k < dofs.size(); ++k)
      for (unsigned int l = 0; l < dofs.size() && own[k]; ++l)
        if (basis.functions[k].dimension == basis.functions[l].dimension &&
            basis.functions[k].entity == basis.functions[l].entity)
          own[k] = !body.conformity.is_constrained(dofs[l]);
    return own;
  }

  Frame
  frame_of(const Tensor<1, dim> &normal)
  {
    unsigned int across = 0;
    for (unsigned int c = 1; c < dim; ++c)
      if (std::fabs(normal[c]) < std::fabs(normal[across]))
        across = c;
    Tensor<1, dim> tangent = -normal[across] * normal;
    tangent[across] += 1.;
    Frame frame;
    frame[0] = normal;
    frame[1] = tangent / tangent.norm();
    frame[2] = cross_product_3d(frame[0], Tensor<1, dim>(frame[1]));
    return frame;
  }

  std::vector<std::vector<Frame>>
  slave_frames(const Body &body, const BodySurface &slave)
  {
    return slave_frames(body, slave, Normals(slave.faces.size()));
  }

  std::vector<std::vector<Frame>>
  slave_frames(const Body &body, const BodySurface &slave, const Normals &given)
  {
    Normals normals = face_normals(slave);
    for (unsigned int s = 0; s < given.size(); ++s)
      if (!given[s].empty())
        normals[s] = given[s];
    if (slave.direction)
      for (auto &of_face : normals)
        std::fill(of_face.begin(), of_face.end(), *slave.direction);
    else
      for_each_mean(body,
                    slave,
                    normals,
                    [&](const unsigned int    s,
                        const unsigned int    k,
                        const Tensor<1, dim> &mean) {
                      if (!is_sharp(normals[s][k], mean))
                        normals[s][k] = mean;
                    });
    std::vector<std::vector<Frame>> frames;
    for (const auto &of_face : normals)
      {
        frames.emplace_back();
        for (const Tensor<1, dim> &normal : of_face)
          frames.back().push_back(frame_of(normal));
      }
    return frames;
  }

  std::optional<Point<dim>>
  find_sharp_edge(const Body &body, const BodySurface &slave)
  {
    std::optional<Point<dim>> result;
    if (slave.direction)
      return result;
    const Normals normals = face_normals(slave);
    for_each_mean(body,
                  slave,
                  normals,
                  [&](const unsigned int    s,
                      const unsigned int    k,
                      const Tensor<1, dim> &mean) {
                    if (!result && is_sharp(normals[s][k], mean))
                      result =
                        face_point(slave.faces[s],
                                   face_nodes(slave.traces[s].shape,
                                              slave.traces[s].degree)[k]);
                  });
    return result;
  }

  std::vector<bool>
  constrained_normals(const Body                            &body,
                      const BodySurface                     &slave,
                      const std::vector<std::vector<Frame>> &frames,
                      const std::vector<bool>               &constrained)
  {
    /// Of the square of a normal: less of it is rounding and curvature.
    constexpr double least_free_part = 1e-6;

    ByDof is_constrained = zeros(body), free_parts = is_constrained,
          n = is_constrained;
    for (unsigned int i = 0; i < constrained.size(); ++i)
      is_constrained.local_element(i) = constrained[i] ? 1. : 0.;
    is_constrained.update_ghost_values();
    for_each_node(body,
                  slave,
                  [&](const unsigned int s, const unsigned int k, auto dofs) {
                    n(dofs[0]) += 1.;
                    for (unsigned int c = 0; c < dim; ++c)
                      if (is_constrained(dofs[c]) < 0.5)
                        free_parts(dofs[0]) += std::pow(frames[s][k][0][c], 2);
                  });
    n.compress(VectorOperation::add);
    free_parts.compress(VectorOperation::add);
    std::vector<bool> result;
    for (unsigned int i = 0; i < constrained.size(); ++i)
      result.push_back(n.local_element(i) > 0. &&
                       free_parts.local_element(i) <
                         least_free_part * n.local_element(i));
    return result;
  }
} // namespace mortise
