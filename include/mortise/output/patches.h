// Fields on simplices for the writers of deal.II, which have linear ones only:
// each is shown by many small linear ones.
#pragma once

#include <deal.II/base/data_out_base.h>

#include <string>
#include <vector>

namespace mortise
{
  /// Points of a simplex in even lattice of @p n intervals per edge, and the
  /// n^dim small simplices between them.
  template <int dim>
  struct SimplexLattice
  {
    explicit SimplexLattice(unsigned int n);

    std::vector<dealii::Point<dim>> points; ///< reference simplex
    std::vector<std::array<unsigned int, dim + 1>> simplices;
  };

  /// Vertices and data of small simplices, dim = 2 or 3, ready to be written.
  template <int dim>
  class SimplexPatches : public dealii::DataOutInterface<dim, 3>
  {
  public:
    explicit SimplexPatches(unsigned int n_intervals);

    /// Announce a field of 1, 3 (vector) or 9 (tensor) components.
    void
    add_field(const std::string &name, unsigned int n_components);

    /// One simplex: positions of the lattice's points and, for each, the
    /// components of all fields one after the other.
    void
    add_simplex(const std::vector<dealii::Point<3>>    &positions,
                const std::vector<std::vector<double>> &data);

    const SimplexLattice<dim> lattice;

  protected:
    const std::vector<dealii::DataOutBase::Patch<dim, 3>> &
    get_patches() const override
    {
      return patches;
    }

    std::vector<std::string>
    get_dataset_names() const override
    {
      return names;
    }

    using Ranges = std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>;

    Ranges
    get_nonscalar_data_ranges() const override
    {
      return ranges;
    }

  private:
    std::vector<dealii::DataOutBase::Patch<dim, 3>> patches;
    std::vector<std::string>                        names; ///< by component
    Ranges                                          ranges;
  };
} // namespace mortise
