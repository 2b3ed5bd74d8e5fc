// Values of a deck that change from step to step, as expressions in t.
#pragma once

#include <mortise/body/mesh/inp_deck.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "import_remarks.h"

namespace mortise
{
  /// As scenes have numbers: as many digits as are needed, up to 12. Throws
  /// InputError for what is no finite number.
  std::string
  number_text(double value);

  /// Linear between points (t, value), constant before and beyond them. Of two
  /// points at one time the first one counts there, the second one after it.
  struct ImportHistory
  {
    std::vector<std::pair<double, double>> points;

    double
    at(double t) const;

    /// Where there is a jump, the value after it.
    double
    after(double t) const;

    bool
    is_zero() const;

    /// An expression in t, or a number.
    std::string
    text() const;

    ImportHistory
    times(double factor) const;

    ImportHistory
    plus(const ImportHistory &other) const;
  };

  /// a + b x + c y + d z; the coefficients in this order.
  using AffineHistory = std::array<ImportHistory, 4>;

  /// An expression in x, y, z, t.
  std::string
  affine_text(const AffineHistory &coefficients);

  /// Coefficients a, b, c, d of the affine function that has the @p values at
  /// @p points, or none if there is no such function.
  std::vector<double>
  affine_fit(const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &values);

  /// What a line of a step, or of the model before all steps, prescribes.
  struct ImportChange
  {
    std::size_t step; ///< 0: before all steps
    double      value;
    std::string amplitude; ///< in capitals; empty: that of the step

    bool
    operator==(const ImportChange &other) const
    {
      return step == other.step && value == other.value &&
             amplitude == other.amplitude;
    }
  };

  struct ImportStep
  {
    double                        start = 0., period = 1.;
    double                        largest = 0.;    ///< increment; 0: not given
    bool                          at_once = false; ///< AMPLITUDE=STEP
    std::vector<const InpBlock *> blocks;
  };

  class ImportSteps
  {
  public:
    /// Collects steps and amplitudes; keywords that are none of a static step
    /// are told.
    ImportSteps(const InpDeck &deck, ImportRemarks &remarks);

    ImportHistory
    history(const std::vector<ImportChange> &changes) const;

    /// Append a change, or replace that of the same step.
    static void
    change(std::vector<ImportChange> &changes, const ImportChange &next);

    /// The section Steps of the scene, which may be empty.
    std::string
    text() const;

    std::vector<ImportStep>       steps;
    std::vector<const InpBlock *> model;          ///< blocks outside of steps
    bool                          finite = false; ///< NLGEOM
    bool nonlinear = false; ///< for reasons of materials or interfaces, too

  private:
    void
    read_static(const InpBlock &block, ImportRemarks &remarks);
    void
    read_amplitude(const InpBlock &block, ImportRemarks &remarks);
    bool
    is_simple() const;

    struct Amplitude
    {
      ImportHistory history;
      bool          total_time = false;
    };
    InpDeck::Named<Amplitude> amplitudes;
  };
} // namespace mortise
