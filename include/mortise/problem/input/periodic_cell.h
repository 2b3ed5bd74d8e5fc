// The cell that periodic interfaces repeat: its translations and mean strain.
// Source: Michel, Moulinec, Suquet, Effective properties of composite materials
// with periodic microstructure, Comput. Methods Appl. Mech. Engrg. 172 (1999).
#pragma once

#include <mortise/problem/input/parameters.h>

#include <vector>

namespace mortise
{
  /// The component of a symmetric tensor with this number: xx, yy, zz, yz, zx,
  /// xy. A shear has both of its entries.
  dealii::Tensor<2, 3>
  unit_strain(unsigned int component);

  /// Those of the periodic interfaces, each once and with one sign.
  std::vector<dealii::Tensor<1, 3>>
  translations(const Parameters &parameters);

  /// The least of three translations, which bodies and pores share; 0 without
  /// three that span space.
  double
  cell_volume(const Parameters &parameters);

  /// Is this component of Mean strain an unknown?
  bool
  is_free_strain(const Parameters &parameters, unsigned int component);

  /// Is any?
  bool
  has_free_strain(const Parameters &parameters);

  /// Is one of xx, yy, zz, so that the volume follows?
  bool
  has_free_volume(const Parameters &parameters);

  /// Throws InputError for what does not go together.
  void
  check_periodic_cell(const Parameters &parameters);
} // namespace mortise
