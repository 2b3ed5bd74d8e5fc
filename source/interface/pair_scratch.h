// Scratch memory of PairIntegrator and the integration of curved and linear
// pairs; private to this folder.
#pragma once

#include <mortise/interface/clipping.h>
#include <mortise/interface/integration_cells.h>

#include <optional>
#include <vector>

namespace mortise
{
  /// Overlaps with less area in the slave's reference coordinates are rounding.
  constexpr double empty_area = 1e-15;

  struct PairIntegrator::Scratch
  {
    /// Parameters of the rule besides the distortion.
    void
    begin_pair(const SurfaceFace &master_face,
               const unsigned int slave_degree,
               const unsigned int master_degree)
    {
      degree_slave  = slave_degree;
      degree_master = master_degree;
      master_shape  = master_face.shape;
    }

    /// The rule for the present pair.
    const GaussRule &
    rule(const double distortion) const;

    bool
    both_triangles() const
    {
      return slave.shape() == FaceShape::triangle &&
             master_shape == FaceShape::triangle;
    }

    /// Whether any of some sample points of one face has a partner on the
    /// other: distinguishes pairs that could not be clipped from pairs without
    /// overlap.
    bool
    samples_meet() const;

    SlaveMap       slave;
    FaceFrame      slave_frame;
    bool           slave_linear = false;
    double         slave_size = 0, slave_area = 0;
    SearchDistance distance;
    double         gap_limit = 0;
    unsigned       n_points = 0, degree_slave = 1, degree_master = 1;
    Products       products     = Products::of_faces;
    FaceShape      master_shape = FaceShape::quadrilateral;
    MasterMap      master;
    LoopClipper    clipper;

    std::vector<double> xi[2], reference_weight; ///< points before mapping
    std::vector<double> gamma[2], gamma_rate[2]; ///< points on curved pieces
  };

  /// Affine faces with one normal: everything is linear and in closed form.
  PairResult
  integrate_linear_pair(PairIntegrator::Scratch &scratch,
                        const SurfaceFace       &master,
                        IntegrationPoints       &points);

  /// Nothing where the faces do not have the same points.
  std::optional<PairResult>
  integrate_coinciding_pair(PairIntegrator::Scratch &scratch,
                            const SurfaceFace       &slave,
                            const SurfaceFace       &master,
                            IntegrationPoints       &points);

  /// All other pairs.
  PairResult
  integrate_curved_pair(PairIntegrator::Scratch &scratch,
                        const SurfaceFace       &master,
                        IntegrationPoints       &points);
} // namespace mortise
