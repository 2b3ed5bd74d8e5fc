// Exact solutions of elastic problems, with exact stresses and body forces.
#pragma once

#include <mortise/base/expression.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/material/material.h>

#include <vector>

namespace mortise
{
  /// A displacement field on one or several bodies. @p body is the index of the body in the scene;
  /// points are in the scene's (moved) coordinates.
  class ExactSolution
  {
  public:
    virtual ~ExactSolution() = default;

    virtual dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &p, unsigned int body) const = 0;

    /// gradient[i][j] = d u_i / d x_j.
    virtual dealii::Tensor<2, 3>
    gradient(const dealii::Point<3> &p, unsigned int body) const = 0;

    virtual dealii::SymmetricTensor<2, 3>
    stress(const dealii::Point<3> &p, unsigned int body) const = 0;

    /// Per undeformed area, of deformed and undeformed coordinates.
    virtual dealii::Tensor<2, 3>
    nominal_stress(const dealii::Point<3> &p, const unsigned int body) const
    {
      return stress(p, body);
    }

    /// Force per undeformed volume, -Div P of the nominal stress P.
    virtual dealii::Tensor<1, 3>
    body_force(const dealii::Point<3> &p, unsigned int body) const = 0;
  };

  /// A displacement given by expressions, the same in every body; stresses by
  /// body's material, and the mean pressure where that is incompressible; with
  /// strains by temperature, the same in all directions, by body. Materials
  /// that yield go from zero to the displacement in one step, as is right where
  /// the stress deviator keeps its direction.
  class ExpressionSolution : public ExactSolution
  {
  public:
    ExpressionSolution(const VectorExpression        &displacement,
                       const std::vector<Material>   &materials,
                       const Expression              &pressure = Expression(),
                       const std::vector<Expression> &thermal_strains = {});

    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &p, unsigned int) const override
    {
      return expression.value(p);
    }
    dealii::Tensor<2, 3>
    gradient(const dealii::Point<3> &p, unsigned int) const override
    {
      return expression.gradient(p);
    }
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::Point<3> &p, unsigned int body) const override;
    dealii::Tensor<2, 3>
    nominal_stress(const dealii::Point<3> &p, unsigned int body) const override;
    dealii::Tensor<1, 3>
    body_force(const dealii::Point<3> &p, unsigned int body) const override;

  private:
    double
    thermal_strain(const dealii::Point<3> &p, const unsigned int body) const
    {
      return thermal_strains.empty() ? 0. : thermal_strains[body].value(p);
    }
    /// Without the thermal strain.
    dealii::Tensor<2, 3>
    elastic_gradient(const dealii::Point<3> &p, unsigned int body) const;
    /// Of the mixed form, zero except of incompressible materials.
    double
    pressure_at(const dealii::Point<3> &p, unsigned int body) const;

    VectorExpression        expression;
    std::vector<Material>   materials;
    Expression              pressure;
    std::vector<Expression> thermal_strains; ///< none, or by body
  };

  /// Lame's thick sphere, or thick cylinder in plane strain, of one or more
  /// concentric layers under pressure inside and outside; displacement, but for
  /// gaps, and radial stress are continuous where two layers meet. u_r = A r +
  /// B / r^(d-1) with d = 3 (sphere) or 2 (cylinder) in each layer. Source:
  /// Timoshenko and Goodier, Theory of Elasticity, chapters 4 and 12.
  class LameSolution : public ExactSolution
  {
  public:
    enum class Geometry
    {
      sphere,
      cylinder ///< axis z before the motion
    };

    struct Layer
    {
      double        inner_radius;
      double        outer_radius;
      LinearElastic material; ///< nu = 0.5 is allowed here
      /// Between this layer and the one inside: the gap that is left (negative:
      /// an interference), a length, and how much tension of one opens it.
      double offset_inside = 0., compliance_inside = 0.;
      /// May these two part, where they would pull?
      bool contact_inside = false;
    };

    /// Layer i is body i; layers may come in any order of radius. The centre
    /// (axis) is the origin
    /// (z axis) before @p motion. Pressures are positive in compression. Throws InputError for
    /// radii that are not 0 < inner < outer and for layers that do not touch
    /// (1e-8 relative).
    LameSolution(Geometry                  geometry,
                 const std::vector<Layer> &layers,
                 double                    pressure_inside,
                 double                    pressure_outside = 0.,
                 const RigidMotion        &motion           = RigidMotion());

    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &p, unsigned int body) const override
    {
      const dealii::Tensor<1, 3> x = radius_vector(p);
      const double               r = x.norm();
      return motion.rotation * (radial_displacement(r, body) / r * x);
    }
    dealii::Tensor<2, 3>
    gradient(const dealii::Point<3> &p, unsigned int body) const override;
    dealii::SymmetricTensor<2, 3>
    stress(const dealii::Point<3> &p, unsigned int body) const override;
    /// Zero.
    dealii::Tensor<1, 3>
    body_force(const dealii::Point<3> &, unsigned int) const override
    {
      return {};
    }

    /// u_r at @p radius in layer @p body.
    double
    radial_displacement(double radius, unsigned int body) const
    {
      AssertIndexRange(body, coefficients.size());
      const Coefficients &c = coefficients[body];
      return c.A * radius + c.B / std::pow(radius, static_cast<int>(d) - 1);
    }
    /// sigma_r at @p radius in layer @p body (negative in compression).
    double
    radial_stress(double radius, unsigned int body) const
    {
      AssertIndexRange(body, coefficients.size());
      const Coefficients &c = coefficients[body];
      return c.mean - c.shear / std::pow(radius, static_cast<int>(d));
    }

  private:
    /// u_r = A r + B / r^(d-1); sigma_r = mean - shear / r^d. The stresses have
    /// constants of their own, which stay finite at nu = 0.5.
    struct Coefficients
    {
      double A, B, mean, shear, poisson_ratio;
    };

    /// p in the frame of the solution, projected to the xy plane for the
    /// cylinder.
    dealii::Tensor<1, 3>
    radius_vector(const dealii::Point<3> &p) const
    {
      dealii::Tensor<1, 3> x = motion.inverse(p);
      if (d == 2)
        x[2] = 0.;
      return x;
    }

    unsigned int              d; ///< 3 for the sphere, 2 for the cylinder
    std::vector<Coefficients> coefficients;
    RigidMotion               motion;
  };
} // namespace mortise
