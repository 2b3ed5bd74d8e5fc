// Pressures on deformed faces: the force -p n da with the normal n and the area
// da of the deformed body, and its derivative, which is symmetric where the
// faces have no rim or one that moves in planes of symmetry. Source: Bonet,
// Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, section 8.5.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>
#include <mortise/operators/scene_load.h>

#include <array>
#include <memory>
#include <vector>

namespace mortise
{
  class FollowerPressures
  {
  public:
    /// Those of @p loads, by body, on the faces of this rank's cells, at the
    /// nodes of @p level, which must live on.
    FollowerPressures(const MultigridLevel     &level,
                      const std::vector<Loads> &loads);

    /// Are there none on this rank?
    bool
    empty() const
    {
      return faces.empty();
    }

    /// target += forces at the displacement @p u, both local with ghost
    /// entries and values of hanging nodes; those on @p boundary of body
    /// @p body alone, if that is given.
    void
    add_forces(const double              *u,
               double                    *target,
               const Body                *body     = nullptr,
               dealii::types::boundary_id boundary = 0) const;

    /// Later products are derivatives at @p u.
    void
    linearise(const double *u);

    /// dst += A du with the derivative A of minus the forces.
    void
    add_product(const double *du, double *dst) const;

  private:
    using Vector3 = dealii::Tensor<1, dim>;

    /// Functions that do not vanish on a face of an element at the points of a
    /// rule: entry [point][function].
    struct Functions
    {
      std::vector<unsigned int>          nodes; ///< of the cell
      std::vector<double>                values;
      std::array<std::vector<double>, 2> slopes; ///< along the face
    };

    struct Point
    {
      double                 load;     ///< pressure times weight
      std::array<Vector3, 2> along;    ///< tangents X_xi, X_eta
      std::array<Vector3, 2> deformed; ///< x_xi, x_eta of linearise()
    };

    struct Face
    {
      const Body                      *body;
      dealii::types::boundary_id       boundary;
      std::shared_ptr<const Functions> functions; ///< of many faces
      std::vector<unsigned int> indices; ///< of first components, by function
      std::vector<Point>        points;
    };

    static Functions
    make_functions(const Body                    &body,
                   const Body::CellIterator      &cell,
                   unsigned int                   f,
                   const dealii::Quadrature<dim> &rule);

    std::array<Vector3, 2>
    tangents(const Face &face, unsigned int q, const double *u) const;

    std::vector<Face> faces;
  };
} // namespace mortise
