// Materials of a deck as sections of a scene.
#pragma once

#include <map>
#include <string>

#include "import_bodies.h"
#include "import_history.h"
#include "import_remarks.h"

namespace mortise
{
  struct ImportMaterial
  {
    std::string text; ///< lines of the section Material
    double      density    = 0.;
    double      expansion  = 0.;
    bool        nonlinear  = false; ///< yields, or large strains by itself
    bool        needs_more = false; ///< degree 1 locks: yields, or nu near 1/2
  };

  /// The materials of the model, by name in capitals. @p finite: with NLGEOM.
  class ImportMaterials
  {
  public:
    ImportMaterials(const InpDeck     &deck,
                    const ImportSteps &steps,
                    ImportRemarks     &remarks);

    /// That of a section. Throws InputError if there is none.
    ImportMaterial
    of(const InpBlock &section, ImportRemarks &remarks) const;

  private:
    std::string
    axes_text(const InpBlock &section, ImportRemarks &remarks) const;

    const InpDeck                                       &deck;
    const bool                                           finite;
    std::map<std::string, std::vector<const InpBlock *>> blocks; ///< of each
    /// By instance and name.
    std::map<std::pair<std::string, std::string>, const InpBlock *>
      orientations;
  };

  /// Angles by which axes are rotated about x, then y, then z, in degrees.
  std::string
  angles_text(const dealii::Tensor<2, 3> &rotation);

  /// The axes of *ORIENTATION or *TRANSFORM by the points a and b on the
  /// local x axis and in the local x-y plane; columns. Throws InputError with
  /// the @p place where these are on one line.
  dealii::Tensor<2, 3>
  axes_of(const dealii::Tensor<1, 3> &a,
          const dealii::Tensor<1, 3> &b,
          const std::string          &place);

  /// One of the columns.
  inline dealii::Tensor<1, 3>
  axis_of(const dealii::Tensor<2, 3> &axes, const unsigned int c)
  {
    return dealii::Tensor<1, 3>({axes[0][c], axes[1][c], axes[2][c]});
  }

  /// The words of @p line as numbers; empty words are 0.
  std::vector<double>
  import_numbers(const InpLine &line, std::size_t first = 0);
} // namespace mortise
