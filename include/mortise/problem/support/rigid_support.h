// Resistance of prescribed displacements and multipliers against rigid motions,
// as sums of squares.
#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/body/pieces.h>
#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_system.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mortise
{
  /// A translation a and a rotation w about the centre of a body, the latter
  /// times its size.
  using Motion = std::array<double, 6>;

  struct Extent
  {
    dealii::Point<dim> centre;
    double             size = 0.;
  };

  /// Free rigid motions of a scene.
  struct FreeMotions
  {
    std::vector<Extent>              of_body; ///< centres of rotation and sizes
    std::vector<std::vector<Motion>> motions; ///< by motion and body
  };

  /// The cells of one piece of a body, or all.
  struct PartOfBody
  {
    const Pieces *pieces = nullptr;
    unsigned int  number = 0;

    bool
    has(const Body::CellIterator &cell) const
    {
      return pieces == nullptr ||
             pieces->of_cell[cell->active_cell_index()] == number;
    }
  };

  /// Of the box around the body, or a part of it. Collective.
  Extent
  extent(const Body &body, const PartOfBody &part = {});

  /// Component @p c of a + w x (position - centre), for position / weight.
  Motion
  row_of(const Extent                 &where,
         unsigned int                  c,
         const dealii::Tensor<1, dim> &position,
         double                        weight = 1.);

  /// The moment of a multiplier with a + w x (x - centre).
  Motion
  row_of(const Extent &where, const MultiplierMoment &multiplier);

  /// Weighted mean of squares of rows on @p n_bodies bodies, a quadratic form
  /// of motions.
  class Support
  {
  public:
    explicit Support(const unsigned int n_bodies = 0)
      : size(6 * n_bodies)
      , sums(size * size + 1, 0.)
    {}

    void
    add(const std::vector<Motion> &row,
        const double               factor = 1.,
        double                     weight = 1.)
    {
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = 0; j < size; ++j)
          sums[size * i + j] += factor * row[i / 6][i % 6] * row[j / 6][j % 6];
      sums.back() += factor * weight;
    }

    /// Over all ranks. Collective.
    void
    finish(MPI_Comm comm)
    {
      dealii::Utilities::MPI::sum(sums, comm, sums);
      const double total = sums.back();
      for (double &sum : sums)
        sum /= total > 0. ? total : 1.;
    }

    double
    operator()(unsigned int i, unsigned int j) const
    {
      return sums[size * i + j];
    }

  private:
    unsigned int        size;
    std::vector<double> sums;
  };

  /// Data of an interface against the relative motion of two bodies.
  struct TieSupport
  {
    /// As a master: a rigid support.
    static constexpr unsigned int ground = -1;

    std::string                   name;
    unsigned int                  slave, master; ///< bodies
    std::vector<MultiplierMoment> multipliers;   ///< of this rank
    RigidMotion                   placement;     ///< of the master
    double                        coverage;      ///< of the slave surface
    ConstrainedDirections         constrained;
    struct Sample
    {
      dealii::Point<dim>     point;
      double                 area; ///< that it stands for
      dealii::Tensor<1, dim> normal;
    };
    /// Of this rank, spread over the covered part of the slave surface.
    std::vector<Sample> samples;
    /// The direction along which a preload lets the sides approach each other.
    std::optional<dealii::Tensor<1, dim>> released;
    /// Of this rank, what friction holds across the direction of slip.
    std::vector<MultiplierMoment> across_slip;
  };

  /// Symmetric and positive semidefinite: a sum of squares.
  using RigidMatrix = dealii::LAPACKFullMatrix<double>;

  /// Eigenvalues, the largest first, and eigenvectors.
  struct Spectrum
  {
    std::vector<double>              values;
    std::vector<std::vector<double>> vectors; ///< by eigenvalue
  };

  Spectrum
  spectrum(RigidMatrix matrix);

  /// basis^T @p matrix basis. @p basis: vectors.
  RigidMatrix
  restricted(const RigidMatrix                      &matrix,
             const std::vector<std::vector<double>> &basis);

  /// Less than this share of the largest eigenvalue is rounding.
  constexpr double rounding_of_squares = 1e-13;

  /// Resistance of the multipliers of an interface against motions of slave,
  /// then master, normalised by translations.
  struct TieResistance
  {
    Support along_directions;
    Support along_all; ///< as if each multiplier acted along every direction
    bool    curved;    ///< multipliers along normals that are not parallel
  };

  /// Collective.
  TieResistance
  resistance_of(const TieSupport &tie,
                const Extent     &slave,
                const Extent     &master,
                MPI_Comm          comm);

  /// Resistance against rigid motions of several bodies.
  class Resistance
  {
  public:
    explicit Resistance(unsigned int n_bodies);

    /// The prescribed displacements of body @p b.
    void
    add(unsigned int b, const Support &support);

    /// An interface of the bodies @p slave and @p master; negative: rigid.
    void
    add(int slave, int master, const TieResistance &tie);

    RigidMatrix
    sum() const
    {
      RigidMatrix result = constrained;
      result.add(1., across);
      return result;
    }

    /// An orthonormal basis of free motions. Prescribed displacements, ties and
    /// sliding along planes resist exactly to rounding. Motions that they leave
    /// are free if the normal displacement on curved sliding surfaces is less
    /// than three thousandths of the displacement there, the error of
    /// approximated surfaces.
    std::vector<std::vector<double>>
    free_motions() const;

  private:
    static void
    add_block(RigidMatrix   &matrix,
              unsigned int   i,
              unsigned int   j,
              const Support &support,
              unsigned int   a,
              unsigned int   b);

    RigidMatrix constrained; ///< exactly
    RigidMatrix across,
      moved; ///< of curved sliding surfaces: along normals, along all
             ///< directions
  };
} // namespace mortise
