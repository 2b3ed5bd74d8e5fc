// A picture of the numbered faces of a surface, as SVG, seen from two opposite
// sides. It knows no mesh.
#pragma once

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace mortise
{
  /// A flat face, with its outer side where its vertices go round to the left.
  struct PictureFace
  {
    std::vector<dealii::Point<3>> vertices;
    unsigned int                  number = 0; ///< gives colour and label
  };

  /// Each number is written once in each view in which its faces are seen.
  std::string
  face_picture(const std::vector<PictureFace> &faces);
} // namespace mortise
