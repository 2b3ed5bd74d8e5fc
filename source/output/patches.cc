#include <mortise/output/patches.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  // The simplex 1 >= y_1 >= ... >= y_dim >= 0 is the union of some of the
  // simplices into which Kuhn cuts each cube of an even grid; its barycentric
  // coordinates are the differences of the y.
  template <int dim>
  SimplexLattice<dim>::SimplexLattice(const unsigned int n)
  {
    using Node = std::array<unsigned int, dim>;
    std::map<Node, unsigned int> index;
    const auto                   place = [&](const Node &y) {
      const auto [entry, is_new] = index.try_emplace(y, points.size());
      if (is_new)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = (y[d] - (d + 1 < dim ? y[d + 1] : 0.)) / n;
          points.push_back(x);
        }
      return entry->second;
    };
    unsigned int n_cubes = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_cubes *= n;
    for (unsigned int cube = 0; cube < n_cubes; ++cube)
      {
        Node         origin;
        unsigned int rest = cube;
        for (unsigned int &i : origin)
          {
            i = rest % n;
            rest /= n;
          }
        std::array<unsigned int, dim> axes;
        std::iota(axes.begin(), axes.end(), 0);
        do
          {
            std::array<Node, dim + 1> nodes;
            nodes[0] = origin;
            for (unsigned int d = 0; d < dim; ++d)
              {
                nodes[d + 1] = nodes[d];
                ++nodes[d + 1][axes[d]];
              }
            if (!std::all_of(nodes.begin(), nodes.end(), [](const Node &y) {
                  return std::is_sorted(y.rbegin(), y.rend());
                }))
              continue;
            std::array<unsigned int, dim + 1> simplex;
            std::transform(nodes.begin(), nodes.end(), simplex.begin(), place);
            simplices.push_back(simplex);
          }
        while (std::next_permutation(axes.begin(), axes.end()));
      }
  }

  template <int dim>
  SimplexPatches<dim>::SimplexPatches(const unsigned int n_intervals)
    : lattice(n_intervals)
  {}

  template <int dim>
  void
  SimplexPatches<dim>::add_field(const std::string &name,
                                 const unsigned int n_components)
  {
    using namespace DataComponentInterpretation;
    const unsigned int first = names.size();
    names.resize(first + n_components, name);
    if (n_components > 1)
      ranges.emplace_back(first,
                          first + n_components - 1,
                          name,
                          n_components == 3 ? component_is_part_of_vector :
                                              component_is_part_of_tensor);
  }

  template <int dim>
  void
  SimplexPatches<dim>::add_simplex(const std::vector<Point<3>> &positions,
                                   const std::vector<std::vector<double>> &data)
  {
    for (const auto &simplex : lattice.simplices)
      {
        DataOutBase::Patch<dim, 3> patch;
        patch.reference_cell       = ReferenceCells::get_simplex<dim>();
        patch.n_subdivisions       = 1;
        patch.patch_index          = patches.size();
        patch.points_are_available = true;
        patch.data.reinit(names.size() + 3, dim + 1);
        for (unsigned int v = 0; v <= dim; ++v)
          {
            patch.vertices[v] = positions[simplex[v]];
            for (unsigned int i = 0; i < names.size(); ++i)
              patch.data(i, v) = data[simplex[v]][i];
            for (unsigned int d = 0; d < 3; ++d)
              patch.data(names.size() + d, v) = positions[simplex[v]][d];
          }
        patches.push_back(patch);
      }
  }

  template struct SimplexLattice<2>;
  template struct SimplexLattice<3>;
  template class SimplexPatches<2>;
  template class SimplexPatches<3>;
} // namespace mortise
