// One interface between a slave and a master surface: searches pairs of faces,
// clips them and passes their integration points to visitors. Where bodies are
// displaced, pairs are those of the displaced surfaces, and areas and weights
// those of the undeformed slave: multipliers are tractions per area there.
#pragma once

#include <mortise/interface/body_surface.h>
#include <mortise/interface/integration_cells.h>
#include <mortise/interface/visibility.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  struct InterfaceOptions
  {
    /// Largest distance of partners.
    SearchDistance distance;
    /// Points per direction in an integration cell; absent: see
    /// quadrature_points().
    std::optional<unsigned int> points_per_direction;
    /// Owned faces of the whole boundaries of both bodies for tests of
    /// visibility; empty: no tests.
    std::function<std::vector<SurfaceFace>()> slave_boundary, master_boundary;
  };

  /// Totals over all ranks.
  struct InterfaceReport
  {
    std::uint64_t slave_faces  = 0;
    std::uint64_t master_faces = 0;
    /// Slave faces that coincide with a master face and are not clipped.
    std::uint64_t coinciding_faces          = 0;
    std::uint64_t candidate_pairs           = 0;
    std::uint64_t pairs                     = 0;
    std::uint64_t integration_cells         = 0;
    std::uint64_t largest_integration_cells = 0; ///< of the busiest rank
    std::uint64_t quadrature_points         = 0;
    std::uint64_t failed_pairs = 0; ///< projections that did not converge
    /// The mesh gap along the normal over the covered area, positive where the
    /// meshes are apart: mean, mean magnitude, largest magnitude.
    double gap_mean = 0., distance_mean = 0., distance_max = 0.;
    /// sagitta() of the slave faces, the mean over the covered area.
    double sagitta_mean = 0.;
    /// Largest covered part of a face.
    double largest_coverage = 0.;
    double slave_area       = 0.;
    double covered_area     = 0.;
    double worst_face_error =
      0.; ///< largest |1 - covered / area| of a slave face
    dealii::Point<3> worst_face_centre;
    double           clipping_seconds =
      0.; ///< spent in clipping and projection, this rank
  };

  class InterfaceHandler
  {
  public:
    /// Takes the owned faces of both sides and imports the master faces, with
    /// their traces, near to owned slave faces. Collective.
    InterfaceHandler(const std::string      &name,
                     BodySurface             slave,
                     BodySurface             master,
                     const InterfaceOptions &options,
                     MPI_Comm                comm);

    /// Called for each pair of overlapping faces: number of the slave face,
    /// number in master_faces(), points.
    using Visitor = std::function<void(unsigned int             slave,
                                       unsigned int             master,
                                       const IntegrationPoints &points)>;

    /// Clip all pairs, slave by slave, and set coverage() and report().
    /// Collective.
    void
    integrate_pairs(const Visitor &visitor);

    /// Clip all pairs again for another integral with the same points.
    void
    visit_pairs(const Visitor &visitor) const
    {
      clip(visitor, products());
    }

    using Choice = std::function<bool(unsigned int slave)>;

    /// Those of chosen slave faces, with fewer points. Pairs may be others, as
    /// their points decide.
    void
    visit_pairs_for_tangents(const Choice &choice, const Visitor &visitor) const
    {
      clip(visitor, Products::of_flat_faces, choice);
    }

    const std::string &
    name() const
    {
      return interface_name;
    }

    const BodySurface &
    slave() const
    {
      return slave_surface;
    }

    /// The owned faces of the master side.
    const BodySurface &
    master() const
    {
      return master_surface;
    }

    /// Traces of master_faces().
    const std::vector<FaceTrace> &
    master_traces() const
    {
      return near_traces;
    }

    const std::vector<SurfaceFace> &
    master_faces() const
    {
      return near_masters;
    }

    /// Covered fraction of the area, by slave face. Valid after
    /// integrate_pairs().
    const std::vector<double> &
    coverage() const
    {
      return covered_fraction;
    }

    /// Valid after integrate_pairs().
    const InterfaceReport &
    report() const
    {
      return totals;
    }

  private:
    /// Does the search distance exceed the thickness of the bodies? Collective.
    bool
    may_see_through() const;
    /// Remove from @p points those whose partners are hidden.
    void
    drop_hidden(unsigned int       s,
                unsigned int       m,
                PairResult        &pair,
                IntegrationPoints &points) const;
    /// Change areas of slave face @p s to those of the undeformed body.
    void
    refer_to_undeformed(unsigned int       s,
                        PairResult        &pair,
                        IntegrationPoints &points) const;
    /// False where no candidate has the same points as slave face @p s.
    bool
    visit_coinciding(unsigned int       s,
                     const Visitor     &visitor,
                     PairIntegrator    &integrator,
                     IntegrationPoints &points,
                     Coverage          &coverage) const;
    /// Results of a pass over the pairs on this rank.
    struct Pass
    {
      Coverage            sum;
      std::vector<double> covered; ///< fraction, by slave face
      double              worst_error = -1.;
      dealii::Point<3>    worst_centre;
      double              clipping_seconds = 0.;
      std::uint64_t       n_coinciding     = 0;
      double              sagitta = 0., largest_coverage = 0.;
    };

    /// More where slaves are displaced, whose pairs change as they move.
    Products
    products() const
    {
      return slave_surface.undeformed.empty() ? Products::of_faces :
                                                Products::all;
    }

    Pass
    clip(const Visitor &visitor,
         Products       products,
         const Choice  &choice = Choice()) const;
    /// Sums of all ranks. Collective.
    InterfaceReport
    report_of(const Pass &own) const;

    std::string                            interface_name;
    BodySurface                            slave_surface;
    BodySurface                            master_surface;
    InterfaceOptions                       options;
    MPI_Comm                               comm;
    std::vector<SurfaceFace>               near_masters;
    std::vector<FaceTrace>                 near_traces;
    std::vector<std::vector<unsigned int>> candidates; ///< by slave face
    std::unique_ptr<Visibility>            visibility; ///< where it is needed
    std::vector<double>                    covered_fraction;
    InterfaceReport                        totals;
  };
} // namespace mortise
