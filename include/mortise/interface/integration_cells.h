// Quadrature on the overlap of a slave face with a master face: clip, cut into
// cells, place points and map each back to both faces.
#pragma once

#include <mortise/interface/search.h>
#include <mortise/interface/surface_face.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace mortise
{
  /// Points of one pair, as separate arrays that keep their storage from pair
  /// to pair. Entry q of each array belongs to the same point: x_m(eta) =
  /// x_s(xi) + gap n/|n|, n the slave's averaged normal field.
  struct IntegrationPoints
  {
    std::array<std::vector<double>, 2>
      slave_xi; ///< reference coordinates in the slave face
    std::array<std::vector<double>, 2>
      master_eta;               ///< reference coordinates in the master face
    std::vector<double> weight; ///< area on the true slave surface, see
                                ///< refer_to()
    std::array<std::vector<double>, 3> slave_x; ///< position on the slave face
    std::array<std::vector<double>, 3>
                        master_x; ///< position on the master face
    std::vector<double> gap;      ///< along the unit normal; positive: open
    /// Where the slave face was; empty before refer_to().
    std::array<std::vector<double>, 3> undeformed_x;

    unsigned int
    size() const
    {
      return weight.size();
    }

    void
    resize(const unsigned int n);

    /// Point @p from takes the place of point @p to.
    void
    move(unsigned int from, unsigned int to);

    /// The point of the slave in its body, by which expressions and nodes are
    /// known.
    dealii::Point<3>
    place(const unsigned int q) const
    {
      const auto &x = undeformed_x[0].empty() ? slave_x : undeformed_x;
      return dealii::Point<3>(x[0][q], x[1][q], x[2][q]);
    }

    /// Set the undeformed places, and change the weights from areas of the
    /// slave face @p slave, where the points are, to those of @p undeformed,
    /// the same face there.
    void
    refer_to(const SurfaceFace &undeformed, const SurfaceFace &slave);
  };

  /// Outcome of integrate() for a pair.
  enum class PairStatus : unsigned char
  {
    accepted,
    no_overlap,    ///< nothing left after clipping
    normals_agree, ///< the outward normals do not oppose everywhere on the
                   ///< overlap
    too_far,       ///< the gap exceeds the search fraction of the larger face
                   ///< somewhere
    hidden,        ///< the partner would be seen through a body
    failed ///< a Newton iteration did not converge: to be counted and reported
  };

  struct PairResult
  {
    PairStatus status = PairStatus::no_overlap;
    double area = 0; ///< of the overlap on the slave surface; 0 unless accepted
    unsigned int n_cells = 0; ///< integration cells
    double       max_gap = 0; ///< largest |gap| of the points
  };

  /// Points per direction in each integration cell, for products of two shape
  /// functions of
  /// the given degrees: total degrees on triangles, degrees per direction on
  /// quadrilaterals.
  /// @p distortion is 0 where both faces are affine with one normal and all maps are linear; else the variation (max - min) / (max + min) over
  /// the overlap of the surface elements of both faces, less than 1. The choice
  /// and its measured errors stand with the definition.
  unsigned int
  quadrature_points(const unsigned int degree_slave,
                    const unsigned int degree_master,
                    const double       distortion,
                    const bool         both_triangles = false);

  /// Products of functions of both faces that the points of a pair integrate.
  enum class Products
  {
    of_faces, ///< as quadrature_points() says
    /// More than those of quadrilaterals on cells of any shape, so that
    /// integrals do not jump where other points are taken as the faces move.
    all,
    of_flat_faces ///< fewer, for tangents
  };

  /// Integrates over one slave face after the other against any number of
  /// masters. Owns all scratch memory: one object per thread.
  class PairIntegrator
  {
  public:
    explicit PairIntegrator(const SearchDistance &distance = {});
    ~PairIntegrator();

    /// Choose the slave face of the pairs to come. Copies what it needs.
    void
    reinit(const SurfaceFace &slave);

    /// The overlap of the present slave with @p master; @p points is overwritten and is empty
    /// unless the pair is accepted. The degrees are those of the shape
    /// functions.
    PairResult
    integrate(const SurfaceFace &master,
              const unsigned int degree_slave,
              const unsigned int degree_master,
              IntegrationPoints &points);

    /// The same without clipping and projection where @p master has the same
    /// points as @p slave, the present one, to rounding, in any order, and the
    /// opposite normal; nothing elsewhere.
    std::optional<PairResult>
    integrate_coinciding(const SurfaceFace &slave,
                         const SurfaceFace &master,
                         const unsigned int degree_slave,
                         const unsigned int degree_master,
                         IntegrationPoints &points);

    /// Points per direction and cell; 0 (default): as quadrature_points() says.
    void
    set_points_per_direction(const unsigned int n);

    /// Default: Products::of_faces.
    void
    set_products(Products of);

    /// Area of the present slave face.
    double
    slave_area() const;

    struct Scratch;

  private:
    std::unique_ptr<Scratch> scratch;
  };

  /// Sums over the pairs of one or more slave faces.
  struct Coverage
  {
    double       slave_area   = 0;
    double       covered_area = 0;
    unsigned int n_candidates = 0;
    unsigned int n_pairs      = 0; ///< accepted ones
    unsigned int n_cells      = 0;
    unsigned int n_points     = 0;
    unsigned int n_failures   = 0; ///< pairs with status failed
    double       max_gap      = 0;
    double gap_sum = 0, distance_sum = 0; ///< of gaps and magnitudes, by area

    void
    add(const Coverage &other);

    void
    add(const PairResult &pair, const IntegrationPoints &points);
  };
} // namespace mortise
