#include <mortise/base/error.h>
#include <mortise/material/exact_solution.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  ExpressionSolution::ExpressionSolution(
    const VectorExpression        &displacement,
    const std::vector<Material>   &materials,
    const Expression              &pressure,
    const std::vector<Expression> &thermal_strains)
    : expression(displacement)
    , materials(materials)
    , pressure(pressure)
    , thermal_strains(thermal_strains)
  {}

  Tensor<2, 3>
  ExpressionSolution::elastic_gradient(const Point<3>    &p,
                                       const unsigned int body) const
  {
    return materials[body].elastic_gradient(expression.gradient(p),
                                            thermal_strain(p, body));
  }

  double
  ExpressionSolution::pressure_at(const Point<3>    &p,
                                  const unsigned int body) const
  {
    return materials[body].incompressible() ?
             materials[body].pressure(elastic_gradient(p, body),
                                      -pressure.value(p) *
                                        unit_symmetric_tensor<3>()) :
             0.;
  }

  SymmetricTensor<2, 3>
  ExpressionSolution::stress(const Point<3> &p, const unsigned int body) const
  {
    AssertIndexRange(body, materials.size());
    const Material    &material = materials[body];
    const Tensor<2, 3> gradient = elastic_gradient(p, body);
    if (!material.incompressible())
      return material.nonlinear() ? material.respond(gradient, 0.).cauchy :
                                    material.stress(gradient);
    // in the mean minus the pressure, whatever the divergence
    return deviator(material.respond(gradient, 0.).cauchy) -
           pressure.value(p) * unit_symmetric_tensor<3>();
  }

  Tensor<2, 3>
  ExpressionSolution::nominal_stress(const Point<3>    &p,
                                     const unsigned int body) const
  {
    if (!materials[body].has_finite_strain())
      return stress(p, body);
    const double stretch =
      materials[body].thermal_stretch(thermal_strain(p, body));
    return stretch * stretch *
           materials[body]
             .respond(elastic_gradient(p, body), pressure_at(p, body))
             .nominal;
  }

  namespace
  {
    /// The change of the nominal stress with that of the elastic @p gradient, and
    /// with that of the mean pressure of incompressible materials, whose
    /// mixed form has @p pressure.
    Tensor<2, 3>
    slope_of_stress(const Material     &material,
                    const Tensor<2, 3> &gradient,
                    const double        pressure,
                    const Tensor<2, 3> &slope,
                    const double        mean_slope)
    {
      if (!material.incompressible())
        return material.nonlinear() ?
                 material.nominal_change(gradient, 0., slope, 0.) :
                 Tensor<2, 3>(material.stress(slope));
      // tau = P F^T has the trace 3 (p - mean pressure)
      Tensor<2, 3> tau = material.nominal_change(gradient, 0., slope, 0.);
      if (material.has_finite_strain())
        tau = tau * transpose(deformation_gradient(gradient)) +
              material.respond(gradient, 0.).nominal * transpose(slope);
      return material.nominal_change(gradient,
                                     pressure,
                                     slope,
                                     trace(tau) / 3. + mean_slope);
    }
  } // namespace

  Tensor<1, 3>
  ExpressionSolution::body_force(const Point<3>    &p,
                                 const unsigned int body) const
  {
    AssertIndexRange(body, materials.size());
    const Material &material = materials[body];
    const bool      finite   = material.has_finite_strain();
    const double    stretch = material.thermal_stretch(thermal_strain(p, body));
    // of linear laws any gradient serves
    const Tensor<2, 3> gradient =
      material.nonlinear() ? elastic_gradient(p, body) : Tensor<2, 3>();
    const double       at = material.nonlinear() ? pressure_at(p, body) : 0.;
    const auto         hessian = expression.hessian(p);
    const Tensor<1, 3> mean = material.incompressible() ? pressure.gradient(p) :
                                                          Tensor<1, 3>(),
                       strain = thermal_strains.empty() ?
                                  Tensor<1, 3>() :
                                  thermal_strains[body].gradient(p);
    Tensor<1, 3> force;
    for (unsigned int j = 0; j < 3; ++j)
      {
        Tensor<2, 3> slope;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            slope[i][k] = hessian[i][k][j];
        slope -=
          strain[j] * deformation_gradient(finite ? gradient : Tensor<2, 3>());
        Tensor<2, 3> change =
          stretch *
          slope_of_stress(material, gradient, at, slope, stretch * mean[j]);
        if (finite)
          change += 2. / stretch * strain[j] * nominal_stress(p, body);
        for (unsigned int i = 0; i < 3; ++i)
          force[i] -= change[i][j];
      }
    return force;
  }

  namespace
  {
    using Layer = LameSolution::Layer;

    /// Order of the layers from the inside out; throws if they do not fit
    /// together.
    std::vector<unsigned int>
    order_of(const std::vector<Layer> &layers)
    {
      std::vector<unsigned int> order(layers.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(),
                order.end(),
                [&](const unsigned int a, const unsigned int b) {
                  return layers[a].inner_radius < layers[b].inner_radius;
                });
      std::ostringstream message;
      if (layers.empty())
        message << "no body has radii";
      for (unsigned int i = 0; i < order.size(); ++i)
        {
          const Layer &layer = layers[order[i]];
          if (!(0. < layer.inner_radius &&
                layer.inner_radius < layer.outer_radius))
            message << "; radii " << layer.inner_radius << ", "
                    << layer.outer_radius << " of body number " << order[i] + 1
                    << "; allowed: 0 < inner < outer";
          else if (i > 0)
            {
              const double below = layers[order[i - 1]].outer_radius;
              if (!(std::fabs(below - layer.inner_radius) <= 1e-8 * below))
                message << "; one layer ends at radius " << below
                        << " and the next begins at " << layer.inner_radius
                        << "; allowed: the same radius";
            }
        }
      if (!message.str().empty())
        throw InputError("Exact solution of concentric layers: " +
                         message.str().substr(message.str()[0] == ';' ? 2 : 0));
      return order;
    }

    /// One layer's response to pressures: u_r = A r + B / r^(d-1) and
    /// sigma_r = k A - s B / r^d with k = d lambda + 2 mu, s = 2 (d-1) mu.
    struct Response
    {
      Response(const Layer &layer, const unsigned int d)
        : a(layer.inner_radius)
        , b(layer.outer_radius)
        , offset(layer.offset_inside)
        , compliance(layer.compliance_inside)
        , contact(layer.contact_inside)
        , d(d)
      {
        const double E  = layer.material.young_modulus,
                     nu = layer.material.poisson_ratio;
        one_by_k        = (d == 3 ? 1. : 1. + nu) * (1. - 2. * nu) / E;
        one_by_s        = (1. + nu) / ((d - 1) * E);
        ratio           = std::pow(a / b, static_cast<int>(d));
      }

      /// k A for pressures @p pa inside and @p pb outside.
      double
      mean(const double pa, const double pb) const
      {
        return (pa * ratio - pb) / (1. - ratio);
      }

      /// s B / b^d.
      double
      shear(const double pa, const double pb) const
      {
        return (pa - pb) * ratio / (1. - ratio);
      }

      /// u_r at radius a or b.
      double
      displacement(const double r, const double pa, const double pb) const
      {
        return r * (mean(pa, pb) * one_by_k +
                    shear(pa, pb) * std::pow(b / r, static_cast<int>(d)) *
                      one_by_s);
      }

      double       a, b, offset, compliance;
      bool         contact;
      unsigned int d;
      double       one_by_k, one_by_s, ratio;
    };

    /// Pressures at all radii, from the inside out, those at the radii of
    /// @p open being zero. The unknowns are the pressures where layers meet, so
    /// that no differences of stiffnesses occur: the equations (displacements
    /// of both sides that differ by the offset, and by what a spring gives) are
    /// tridiagonal and diagonally dominant for each sign.
    std::vector<double>
    pressures_at_radii(const std::vector<Response> &responses,
                       const std::vector<bool>     &open,
                       const double                 pressure_inside,
                       const double                 pressure_outside)
    {
      const unsigned int  n = responses.size();
      std::vector<double> pressures(n + 1, 0.), diagonal(n + 1, 1.),
        upper(n + 1, 0.);
      pressures[0] = pressure_inside;
      pressures[n] = pressure_outside;
      // Thomas' algorithm; row i: lower p_{i-1} + middle p_i + upper p_{i+1} =
      // offset.
      for (unsigned int i = 1; i < n; ++i)
        {
          if (open[i])
            continue; // p_i = 0
          const Response &below = responses[i - 1], &above = responses[i];
          const double    lower  = below.displacement(below.b, 1., 0.);
          const double    middle = below.displacement(below.b, 0., 1.) -
                                above.displacement(above.a, 1., 0.) -
                                above.compliance;
          upper[i]            = -above.displacement(above.a, 0., 1.);
          const double factor = lower / diagonal[i - 1];
          diagonal[i]         = middle - (i > 1 ? factor * upper[i - 1] : 0.);
          pressures[i]        = above.offset - factor * pressures[i - 1];
        }
      for (unsigned int i = n - 1; i >= 1; --i)
        pressures[i] =
          (pressures[i] - upper[i] * pressures[i + 1]) / diagonal[i];
      return pressures;
    }

    /// The same where layers part that would pull: from the inside out, the
    /// first that has the wrong sign turns, which ends.
    std::vector<double>
    interface_pressures(const std::vector<Response> &responses,
                        const double                 pressure_inside,
                        const double                 pressure_outside)
    {
      const unsigned int n = responses.size();
      std::vector<bool>  open(n, false);
      while (true)
        {
          const auto p        = pressures_at_radii(responses,
                                            open,
                                            pressure_inside,
                                            pressure_outside);
          const auto is_wrong = [&](const unsigned int i) {
            const Response &below = responses[i - 1], &above = responses[i];
            const double    gap = above.offset +
                               above.displacement(above.a, p[i], p[i + 1]) -
                               below.displacement(below.b, p[i - 1], p[i]);
            return above.contact && (open[i] ? gap < 0. : p[i] < 0.);
          };
          unsigned int first = 1;
          while (first < n && !is_wrong(first))
            ++first;
          if (first >= n)
            return p;
          open[first] = !open[first];
        }
    }
  } // namespace

  LameSolution::LameSolution(const Geometry            geometry,
                             const std::vector<Layer> &layers,
                             const double              pressure_inside,
                             const double              pressure_outside,
                             const RigidMotion        &motion)
    : d(geometry == Geometry::sphere ? 3 : 2)
    , coefficients(layers.size())
    , motion(motion)
  {
    const std::vector<unsigned int> order = order_of(layers);
    std::vector<Response>           responses;
    for (const unsigned int body : order)
      responses.emplace_back(layers[body], d);
    const std::vector<double> p =
      interface_pressures(responses, pressure_inside, pressure_outside);
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        const Response &r    = responses[i];
        const double    mean = r.mean(p[i], p[i + 1]);
        const double    shear =
          r.shear(p[i], p[i + 1]) * std::pow(r.b, static_cast<int>(d));
        coefficients[order[i]] = {mean * r.one_by_k,
                                  shear * r.one_by_s,
                                  mean,
                                  shear,
                                  layers[order[i]].material.poisson_ratio};
      }
  }

  Tensor<2, 3>
  LameSolution::gradient(const Point<3> &p, const unsigned int body) const
  {
    AssertIndexRange(body, coefficients.size());
    const Coefficients &c = coefficients[body];
    // u = g(r) x with g = A + B / r^d, so grad u = g P + (g' / r) x (x) x, P
    // the identity of the d directions.
    const Tensor<1, 3> x     = radius_vector(p);
    const double       r     = x.norm();
    const double       B_r_d = c.B / std::pow(r, static_cast<int>(d));
    Tensor<2, 3>       local = -(d * B_r_d / (r * r)) * outer_product(x, x);
    for (unsigned int i = 0; i < d; ++i)
      local[i][i] += c.A + B_r_d;
    return motion.rotation * local * transpose(motion.rotation);
  }

  SymmetricTensor<2, 3>
  LameSolution::stress(const Point<3> &p, const unsigned int body) const
  {
    AssertIndexRange(body, coefficients.size());
    const Coefficients &c = coefficients[body];
    // sigma_r = mean - shear / r^d; across: mean + shear / ((d-1) r^d); along
    // the axis of a cylinder in plane strain nu (sigma_r + sigma_t) = 2 nu
    // mean.
    const Tensor<1, 3> x = radius_vector(p);
    const double       r = x.norm();
    const double       across =
      c.shear / ((d - 1) * std::pow(r, static_cast<int>(d)));
    Tensor<2, 3> local = -(d * across / (r * r)) * outer_product(x, x);
    for (unsigned int i = 0; i < d; ++i)
      local[i][i] += c.mean + across;
    if (d == 2)
      local[2][2] = 2. * c.poisson_ratio * c.mean;
    return symmetrize(motion.rotation * local * transpose(motion.rotation));
  }
} // namespace mortise
