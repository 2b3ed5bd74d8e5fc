// See iterate.h.
#include <mortise/mortar/coupling.h>
#include <mortise/problem/iterate.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The normal of a node and two tangents that move with the face.
    Frame
    axes(const Coupling &coupling, const unsigned int s, const unsigned int k)
    {
      Tensor<1, dim> n(coupling.frames[s][k][0]),
        t(coupling.interface->slave().faces[s].frame.tangent[0]);
      t -= (t * n) * n;
      Frame result;
      result[0] = n;
      result[1] = t / t.norm();
      result[2] = cross_product_3d(n, Tensor<1, dim>(result[1]));
      return result;
    }

    /// Of tractions with friction, by slave face, in the axes of nodes, or from
    /// these in space.
    std::vector<std::vector<double>>
    in_axes(const Coupling                  &coupling,
            std::vector<std::vector<double>> coefficients,
            const bool                       to_space)
    {
      if (!coupling.has_following_friction())
        return coefficients;
      for (unsigned int s = 0; s < coefficients.size(); ++s)
        {
          const unsigned int n = coupling.frames[s].size();
          for (unsigned int k = 0; k < n; ++k)
            {
              const Frame    Q = axes(coupling, s, k);
              Tensor<1, dim> value;
              for (unsigned int c = 0; c < dim; ++c)
                value[c] = coefficients[s][c * n + k];
              value = to_space ? transpose(Q) * value : Q * value;
              for (unsigned int c = 0; c < dim; ++c)
                coefficients[s][c * n + k] = value[c];
            }
        }
      return coefficients;
    }
  } // namespace

  void
  add_scaled(Iterate &x, const double factor, const Iterate &y)
  {
    add_scaled(x.x, factor, y.x);
    for (const auto &[name, of_faces] : y.multipliers)
      if (const auto found = x.multipliers.find(name);
          found != x.multipliers.end())
        for (unsigned int s = 0; s < of_faces.size(); ++s)
          for (unsigned int i = 0; i < of_faces[s].size(); ++i)
            found->second[s][i] += factor * of_faces[s][i];
  }

  MultipliersByFace
  multipliers_by_face(const Pairing &pairing,
                      const Vector  &multiplier,
                      const MPI_Comm comm)
  {
    MultipliersByFace result;
    for (const Coupling &coupling : pairing.all())
      result[coupling.interface->name()] =
        in_axes(coupling,
                multiplier_coefficients(coupling, multiplier, comm),
                false);
    return result;
  }

  void
  set_multipliers(const MultipliersByFace &known,
                  const Pairing           &pairing,
                  Vector                  &multiplier)
  {
    for (const Coupling &coupling : pairing.all())
      if (const auto found = known.find(coupling.interface->name());
          found != known.end())
        set_multiplier(coupling,
                       in_axes(coupling, found->second, true),
                       multiplier);
  }
} // namespace mortise
