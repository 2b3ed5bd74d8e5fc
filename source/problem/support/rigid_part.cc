#include <deal.II/base/mpi.h>

#include <mortise/base/rigid_motion.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/problem/support/rigid_part.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// w x.
    Tensor<2, dim>
    cross(const Tensor<1, dim> &w)
    {
      Tensor<2, dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          result[(c + 2) % dim][(c + 1) % dim] = w[c];
          result[(c + 1) % dim][(c + 2) % dim] = -w[c];
        }
      return result;
    }

    Tensor<1, dim>
    translation(const Motion &motion)
    {
      return Tensor<1, dim>({motion[0], motion[1], motion[2]});
    }

    Tensor<1, dim>
    rotation_vector(const Motion &motion, const Extent &where)
    {
      return Tensor<1, dim>({motion[3], motion[4], motion[5]}) / where.size;
    }

    /// I + a w x + b (w x)^2.
    Tensor<2, dim>
    polynomial(const Tensor<1, dim> &w, const double a, const double b)
    {
      const Tensor<2, dim> W = cross(w);
      return Tensor<2, dim>(unit_symmetric_tensor<dim>()) + a * W + b * W * W;
    }

    /// T.
    Tensor<2, dim>
    left_jacobian(const Tensor<1, dim> &w)
    {
      const double angle = w.norm(), half = std::sin(angle / 2.);
      return angle < 1e-3 ?
               polynomial(w, 0.5, 1. / 6.) :
               polynomial(w,
                          2. * half * half / (angle * angle),
                          (angle - std::sin(angle)) / (angle * angle * angle));
    }
  } // namespace

  AffineField
  RigidPart::displacement(const Motion &motion) const
  {
    const Tensor<1, dim> w = rotation_vector(motion, where);
    return {translation(motion),
            is_finite ?
              rotation_by(w) - Tensor<2, dim>(unit_symmetric_tensor<dim>()) :
              cross(w)};
  }

  AffineField
  RigidPart::change(const Motion   &motion,
                    const Motion   &direction,
                    Tensor<1, dim> *rotation) const
  {
    const Tensor<1, dim> w    = rotation_vector(motion, where);
    Tensor<1, dim>       turn = rotation_vector(direction, where);
    if (is_finite)
      turn = left_jacobian(w) * turn;
    if (rotation != nullptr)
      *rotation = turn;
    return {translation(direction),
            is_finite ? cross(turn) * rotation_by(w) : cross(turn)};
  }

  double
  RigidPart::work(const Motion &motion, const Motion &direction) const
  {
    double sum = 0.;
    for (const PointLoad &load : loads)
      {
        Tensor<1, dim>    turn;
        const AffineField moved = change(motion, direction, &turn);
        sum += load.force *
                 (moved.value + moved.gradient * (load.point - where.centre)) +
               load.moment * turn;
      }
    return sum;
  }

  std::array<Motion, 6>
  RigidPart::rows_of(const Extent &body) const
  {
    std::array<Motion, 6> result{};
    for (unsigned int c = 0; c < dim; ++c)
      {
        result[c]                = row_of(body, c, where.centre);
        result[dim + c][dim + c] = where.size / body.size;
      }
    return result;
  }

  std::vector<types::boundary_id>
  all_boundaries(const Body &body)
  {
    return Utilities::MPI::compute_set_union(
      body.triangulation().get_boundary_ids(),
      body.triangulation().get_communicator());
  }

  namespace
  {
    /// Add the motions that are prescribed of @p part; all if @p holds.
    void
    add_prescribed(const RigidPart &part,
                   const Extent    &where,
                   const bool       holds,
                   Support         &support)
    {
      const auto rows = part.rows_of(where);
      for (unsigned int i = 0; i < 6; ++i)
        {
          // one of the rows of I - sum_k free_k free_k^T
          Motion sum = rows[i];
          for (const Motion &free : part.free)
            for (unsigned int j = 0; j < 6 && !holds; ++j)
              for (unsigned int l = 0; l < 6; ++l)
                sum[l] -= free[i] * free[j] * rows[j][l];
          support.add({sum});
        }
    }
  } // namespace

  Support
  support_of(const Body                            &body,
             const std::vector<DirichletCondition> &dirichlet,
             const std::vector<RigidPart>          &parts,
             const Extent                          &where,
             const PartOfBody                      &piece)
  {
    Support support(1);
    for (const DirichletCondition &condition : dirichlet)
      if (!condition.is_rigid)
        for (const auto &[cell, f] : faces_of(body, condition))
          if (cell->is_locally_owned() && piece.has(cell))
            for (unsigned int k = 0; k < cell->face(f)->n_vertices(); ++k)
              if (const unsigned int v = CellFace(cell, f).vertices[k];
                  prescribes_vertex(condition, cell, v))
                for (unsigned int c = 0; c < dim; ++c)
                  if (condition.fixed[c])
                    support.add({row_of(where, c, cell->vertex(v))});
    for (const RigidPart &part : parts)
      if (part.body == body.index)
        for (const auto &[cell, f] : boundary_faces(body, part.boundaries))
          if (cell->is_locally_owned() && piece.has(cell))
            {
              add_prescribed(part, where, piece.pieces != nullptr, support);
              break; // one face of each rank
            }
    support.finish(body.triangulation().get_communicator());
    return support;
  }
} // namespace mortise
