// The overlap of a slave face with a master face as a closed loop in the
// slave's reference domain.
#pragma once

#include <mortise/interface/projection.h>

#include <vector>

namespace mortise
{
  /// One side of an overlap, from p to q in the slave's reference coordinates:
  /// straight, or the pull-back of a part of a master edge.
  struct LoopPiece
  {
    double p[2], q[2];
    int    edge   = -1; ///< of the master, see edge_coordinates(); -1: straight
    double tau_p  = 0;  ///< parameters of the ends on that edge
    double tau_q  = 0;
    double mid[2] = {0,
                     0}; ///< the curve's point at the mean of both parameters
    bool   has_mid = false;
  };

  /// Clips the curved edges of a master face, pulled back to the slave's
  /// reference coordinates, against the slave's reference domain.
  ///
  /// Every edge is cut where it crosses a side, by Newton's
  /// method on (tau, xi, alpha) within a bracket; after that no piece crosses a
  /// side, and Sutherland and Hodgman's walk needs no geometry for curved
  /// pieces. Pieces that lie outside on one side are replaced by their chords,
  /// which are outside as well. No decision depends on a tolerance in a way
  /// that could change the area by more than rounding: values below 1e-13 count
  /// as "on the side", and taking them for inside or outside is equally right.
  class LoopClipper
  {
  public:
    /// Compute the loop; it runs in the direction in which the master's edges
    /// run. Returns false where a Newton iteration near the slave face did not
    /// converge.
    bool
    clip(const SlaveMap &slave, const MasterMap &master);

    /// The overlap; empty where there is none.
    std::vector<LoopPiece> loop;

    /// The whole master face lies in the slave face: the loop is the master's
    /// own boundary.
    bool whole_master = false;

    /// The loop is the boundary of the whole slave face.
    bool whole_slave = false;

    /// Signed area of the polygon through ends and middles of the pieces, and
    /// its centroid.
    double area        = 0;
    double centroid[2] = {0, 0};

  private:
    struct Breakpoint
    {
      unsigned int edge;
      double       tau;
      double       xi[2], dxi[2];
    };

    struct Segment
    {
      unsigned int first, last; ///< breakpoints
      bool         far;         ///< outside on one side
      bool         checked = false;
      double       deviation =
        0;           ///< of the curve from its cubic through ends and slopes
      double mid[2]; ///< the curve's point at the mean parameter
    };

    struct Crossing
    {
      unsigned int segment, side;
      double       tau_0, tau_1, f_0, f_1; ///< bracket
      double       tau;
      double       xi[2];
    };

    /// Points of a segment with their distances from a side. Entry i of
    /// @p beside: the points i and i+1 lie outside on another side.
    struct Samples
    {
      static constexpr unsigned int last = n_lanes + 1;

      double tau[last + 1], x[last + 1][2], f[last + 1];
      bool   beside[last + 1];
    };

    void
    subdivide_edge(const unsigned int edge);
    void
    subdivide(const unsigned int edge,
              const double       tau_0,
              const double       tau_1,
              unsigned int       depth);
    void
    locate(const unsigned int begin, const bool has_guess);
    void
    locate_breakpoints();
    void
    check_segments();
    static double
    on_cubic(const Breakpoint  &a,
             const Breakpoint  &b,
             const unsigned int i,
             const double       t);
    bool
    check_segment(Segment &segment, const Breakpoint &middle) const;
    void
    find_crossings(const unsigned int segment, const unsigned int side);
    void
    take_samples(const Segment     &segment,
                 const unsigned int side,
                 const double       low,
                 const double       high,
                 Samples           &samples);
    bool
    sample_near_part(const Segment     &segment,
                     const unsigned int side,
                     Samples           &samples);
    void
    sample_segment(const unsigned int segment,
                   const unsigned int side,
                   const unsigned int rounds);
    void
    solve_crossings();
    void
    solve_batch(const unsigned int begin, const unsigned int n);
    void
    solve_by_sections(Crossing &crossing);
    void
    pull_back_segment(const Segment &segment, const Lanes &tau, Lanes (&xi)[2]);
    void
    build_pieces();
    void
    add_piece(const Segment &segment, LoopPiece piece);
    void
    locate_middles();
    void
    settle(LoopPiece &piece);
    void
    clip_straight(const unsigned int side);
    void
    measure();

    const SlaveMap  *slave  = nullptr;
    const MasterMap *master = nullptr;
    FaceShape        shape  = FaceShape::quadrilateral; ///< of the slave
    bool             failed = false;

    std::vector<Breakpoint> breakpoints;
    std::vector<Segment>    segments, new_segments;
    std::vector<Crossing>   crossings;
    std::vector<LoopPiece>  scratch;
    std::vector<double>
      control; ///< stack of control polygons of the subdivision
  };
} // namespace mortise
