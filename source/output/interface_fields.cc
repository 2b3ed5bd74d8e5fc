#include <mortise/interface/surface_evaluation.h>
#include <mortise/output/fields.h>
#include <mortise/output/vtu_file.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// int N_i N_j over the whole face, covered or not.
    FullMatrix<double>
    whole_mass(const SurfaceFace &face, const TraceBasis &basis)
    {
      const GaussRule     &gauss = gauss_rule(basis.degree + face.degree + 2);
      const ReferenceRule &rule  = gauss.on(basis.shape);
      const unsigned int   n     = basis.size();
      FacePolynomial       geometry;
      geometry.reinit(face, face.frame.center);
      FullMatrix<double>  mass(n, n);
      std::vector<double> values(n);
      for (unsigned int begin = 0; begin < rule.weight.size(); begin += n_lanes)
        {
          const unsigned int count =
            std::min<unsigned int>(n_lanes, rule.weight.size() - begin);
          Lanes xi[2];
          for (unsigned int l = 0; l < n_lanes; ++l)
            {
              xi[0][l] = rule.xi_1[begin + std::min(l, count - 1)];
              xi[1][l] = rule.xi_2[begin + std::min(l, count - 1)];
            }
          Vec3<Lanes> x, dx[2];
          geometry.evaluate(xi[0], xi[1], x, dx);
          const Vec3<Lanes> area = cross(dx[0], dx[1]);
          const Lanes       size = square_root(dot(area, area));
          for (unsigned int l = 0; l < count; ++l)
            {
              basis.evaluate(xi[0][l], xi[1][l], values.data());
              const double weight = rule.weight[begin + l] * size[l];
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  mass(i, j) += weight * values[i] * values[j];
            }
        }
      return mass;
    }

    /// What has @p coefficients on the covered part of a face and is zero beside it, as the
    /// polynomials on the whole face that do the same work on its functions:
    /// their integrals are those of the forces.
    void
    spread_over_face(const FullMatrix<double> &covered_mass,
                     const SurfaceFace        &face,
                     const TraceBasis         &basis,
                     const unsigned int        n_components,
                     std::vector<double>      &coefficients)
    {
      const unsigned int n = basis.size();
      FullMatrix<double> inverse(n, n), spread(n, n);
      inverse.invert(whole_mass(face, basis));
      inverse.mmult(spread, covered_mass);
      dealii::Vector<double> given(n), result(n);
      for (unsigned int c = 0; c < n_components; ++c)
        {
          const auto first = coefficients.begin() + c * n;
          std::copy_n(first, n, given.begin());
          spread.vmult(result, given);
          std::copy_n(result.begin(), n, first);
        }
    }

    /// Gap by local projection: that of x_master - x_slave, as multipliers see
    /// it; nothing of faces that are covered by less than half.
    std::vector<double>
    gap_coefficients(const Coupling &coupling, const unsigned int s)
    {
      const auto        &local = coupling.local[s];
      const unsigned int n     = local.mass.m();
      if (!(coupling.interface->coverage()[s] > 0.5))
        return {};
      FullMatrix<double> inverse(n, n);
      inverse.invert(local.constraint);
      std::vector<double> result(dim * n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int c = 0; c < dim; ++c)
            result[c * n + i] += inverse(i, j) * local.gap_moment[j][c];
      return result;
    }

    /// A field on one face: coefficients component by component, none where it
    /// is no number.
    struct FaceField
    {
      std::string         name;
      unsigned int        n_components;
      std::vector<double> coefficients;
      bool                per_deformed_area = false; ///< else undeformed
    };

    std::vector<double>
    displacement_on(const BodySurface &surface,
                    const unsigned int s,
                    const BodyVector  &displacement)
    {
      std::vector<double> result;
      for (const auto &component :
           face_dofs(surface.cells[s], surface.face_numbers[s]))
        for (const auto dof : component)
          result.push_back(displacement(dof));
      return result;
    }

    /// The fields of face @p s, displacement excepted, in the order of the file.
    std::vector<FaceField>
    fields_on_face(const Coupling            &coupling,
                   const unsigned int         s,
                   const std::vector<double> &multiplier,
                   const std::vector<double> &contact)
    {
      const BodySurface &surface = coupling.interface->slave();
      const SurfaceFace &face    = surface.undeformed_face(s);
      const TraceBasis  &basis   = surface.traces[s].basis();
      const unsigned int n       = basis.size();
      const bool         faces   = !coupling.local[s].partners.empty() &&
                         face_coverage(coupling.interface->coverage()[s],
                                       true) != FaceCoverage::none;
      std::vector<FaceField> fields{{"traction", dim, {}}};
      if (coupling.law.is_one_sided())
        fields.insert(fields.end(),
                      {{"pressure", 1, {}}, {"gap", 1, {}}, {"status", 1, {}}});
      if (coupling.law.has_friction())
        fields.push_back({"slip", dim, {}});
      if (!coupling.law.is_one_sided())
        fields.push_back({"gap", dim, {}});
      else if (!surface.undeformed.empty())
        fields.push_back({"true_pressure", 1, {}, true});
      if (!faces)
        return fields;
      const auto spread = [&](FaceField &field) {
        spread_over_face(coupling.local[s].mass,
                         face,
                         basis,
                         field.n_components,
                         field.coefficients);
      };
      for (const double value :
           multiplier) // of which the slave bears the opposite
        fields[0].coefficients.push_back(-value);
      spread(fields[0]);
      if (!coupling.law.is_one_sided())
        {
          fields[1].coefficients = gap_coefficients(coupling, s);
          return fields;
        }
      auto next = contact.begin();
      for (auto field = fields.begin() + 1;
           field != fields.end() && !field->per_deformed_area;
           ++field)
        {
          field->coefficients.assign(next, next + field->n_components * n);
          next += field->n_components * n;
        }
      spread(fields[1]);
      if (!surface.undeformed.empty())
        fields.back().coefficients = fields[1].coefficients;
      return fields;
    }

    /// Areas of a displaced slave by those where it was.
    class Stretch
    {
    public:
      Stretch(const BodySurface &surface, const unsigned int s)
      {
        before.reinit(surface.undeformed[s],
                      surface.undeformed[s].frame.center);
        after.reinit(surface.faces[s], surface.faces[s].frame.center);
      }

      double
      at(const Point<2> &xi) const
      {
        const Lanes x = broadcast(xi[0]), y = broadcast(xi[1]);
        return after.area_element(x, y)[0] / before.area_element(x, y)[0];
      }

    private:
      FacePolynomial before, after;
    };

    void
    add_face(const BodySurface            &surface,
             const unsigned int            s,
             const std::vector<FaceField> &fields,
             VtuPiece                     &piece)
    {
      const SurfaceFace     &face  = surface.undeformed_face(s);
      const TraceBasis      &basis = surface.traces[s].basis();
      std::optional<Stretch> stretch;
      if (!surface.undeformed.empty())
        stretch.emplace(surface, s);
      const LagrangeShape shape = basis.shape == FaceShape::triangle ?
                                    LagrangeShape::triangle :
                                    LagrangeShape::quadrilateral;
      const unsigned int  degree =
        face.affine ? basis.degree : std::max(basis.degree, face.degree);
      std::vector<double> values(basis.size());
      piece.begin_cell(shape, degree);
      for (const auto &node : lagrange_nodes(shape, degree))
        {
          const auto xi = Point<2>(node[0], node[1]) / degree;
          basis.evaluate(xi[0], xi[1], values.data());
          piece.add_point(face_point(face, xi));
          const double area = stretch ? stretch->at(xi) : 1.;
          for (unsigned int f = 0; f < fields.size(); ++f)
            for (unsigned int c = 0; c < fields[f].n_components; ++c)
              piece.of_points[f].values.push_back(
                fields[f].coefficients.empty() ?
                  std::numeric_limits<float>::quiet_NaN() :
                  std::inner_product(values.begin(),
                                     values.end(),
                                     fields[f].coefficients.begin() +
                                       c * values.size(),
                                     0.) /
                    (fields[f].per_deformed_area ? area : 1.));
        }
    }
  } // namespace

  void
  write_interface_fields(const Body                             &slave_body,
                         const Coupling                         &coupling,
                         const std::vector<std::vector<double>> &coefficients,
                         const std::vector<std::vector<double>> &contact,
                         const BodyVector                       &displacement,
                         const std::string                      &file)
  {
    const BodySurface &surface = coupling.interface->slave();
    VtuPiece           piece;
    piece.of_cells.push_back({"covered", 1, {}});
    for (unsigned int s = 0; s < surface.faces.size(); ++s)
      {
        std::vector<FaceField> fields =
          fields_on_face(coupling,
                         s,
                         coefficients[s],
                         coupling.law.is_one_sided() ? contact[s] :
                                                       std::vector<double>());
        fields.push_back(
          {"displacement", dim, displacement_on(surface, s, displacement)});
        if (piece.of_points.empty())
          for (const FaceField &field : fields)
            piece.of_points.push_back({field.name, field.n_components, {}});
        add_face(surface, s, fields, piece);
        piece.of_cells[0].values.push_back(coupling.interface->coverage()[s]);
      }
    write_vtu_file(piece, file, slave_body.triangulation().get_communicator());
  }
} // namespace mortise
