// What prescribed displacements and multipliers do against rigid motions of
// bodies, as sums of squares.
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

  /// Rigid motions of a scene that nothing prevents.
  struct FreeMotions
  {
    std::vector<Extent>              of_body; ///< what they are about
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

  /// What a multiplier feels of a + w x (x - centre).
  Motion
  row_of(const Extent &where, const MultiplierMoment &multiplier);

  /// Weighted means of squares of rows, each on @p n_bodies bodies: what is
  /// prevented.
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

  /// Of the prescribed displacements of one body, or a part of it. Collective.
  Support
  support_of(const Body                            &body,
             const std::vector<DirichletCondition> &dirichlet,
             const Extent                          &where,
             const PartOfBody                      &part = {});

  /// What an interface does against the relative motion of two bodies.
  struct TieSupport
  {
    /// As a master: what never moves.
    static constexpr unsigned int ground = -1;

    std::string                   name;
    unsigned int                  slave, master; ///< bodies
    std::vector<MultiplierMoment> multipliers;   ///< of this rank
    double                        coverage;      ///< of the slave surface
    HeldDirections                held;
    struct Place
    {
      dealii::Point<dim>     point;
      double                 area; ///< that it stands for
      dealii::Tensor<1, dim> normal;
    };
    /// Of this rank, spread over the covered part of the slave surface.
    std::vector<Place> places;
    /// The sides come as close along it as a given force takes: a preload.
    std::optional<dealii::Tensor<1, dim>> released;
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

  /// What the multipliers of an interface resist: of the slave, then of the
  /// master, translations of all together weighing one.
  struct TieResistance
  {
    Support along_directions;
    Support along_all; ///< as if each multiplier held along every direction
    bool    curved;    ///< they hold along normals that are not parallel
  };

  /// Collective.
  TieResistance
  resistance_of(const TieSupport &tie,
                const Extent     &slave,
                const Extent     &master,
                MPI_Comm          comm);

  /// What resists the rigid motions of several bodies.
  class Resistance
  {
  public:
    explicit Resistance(unsigned int n_bodies);

    /// The prescribed displacements of body @p b.
    void
    add(unsigned int b, const Support &support);

    /// An interface of the bodies @p slave and @p master; negative: one that does not move.
    void
    add(int slave, int master, const TieResistance &tie);

    RigidMatrix
    sum() const
    {
      RigidMatrix result = held;
      result.add(1., across);
      return result;
    }

    /// An orthonormal basis of the motions that nothing prevents. What
    /// displacements, ties and sliding along planes hold is exact but for
    /// rounding. Of the motions that they leave, free are those along which all
    /// that slides along curved surfaces moves across by less than three
    /// thousandths of what it moves: so much is left of a surface that is
    /// approximated. A thin body moves little and is no freer for it.
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

    RigidMatrix held; ///< exactly
    RigidMatrix across,
      moved; ///< of curved surfaces that slide: normals, and all directions
  };
} // namespace mortise
