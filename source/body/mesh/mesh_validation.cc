#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/generators.h>
#include <mortise/body/mesh/mesh_file.h>
#include <mortise/body/mesh/mesh_source.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Numbers that a generator expects in Extent and Subdivisions.
    struct Layout
    {
      std::vector<std::string> extent, subdivisions;
    };

    Layout
    layout_of(const MeshParameters &q)
    {
      const std::vector<std::string> corners = {
        "x0", "y0", "z0", "x1", "y1", "z1"};
      if (q.source == "shell octant")
        return {{"r_in", "r_out"}, {"n", "m"}};
      if (q.source == "cylinder sector")
        return {{"r_in", "r_out", "length"}, {"around", "radial", "axial"}};
      if (q.source == "curved block" && q.half == "both")
        return {corners, {"nx", "ny", "nz_lower", "nz_upper"}};
      if (q.source == "file")
        return {};
      return {corners, {"nx", "ny", "nz"}};
    }

    /// Collects the checks of one subsection.
    class Checker
    {
    public:
      explicit Checker(const std::string &where)
        : where(where)
      {}

      void
      require(const bool fine, const std::string &what) const
      {
        if (!fine)
          throw InputError(where + ": " + what);
      }

      void
      choice(const std::string              &parameter,
             const std::string              &got,
             const std::vector<std::string> &allowed) const
      {
        const std::string nearest = nearest_name(got, allowed);
        require(std::find(allowed.begin(), allowed.end(), got) != allowed.end(),
                parameter + " = " + in_quotes(got, '\'') + " is not known" +
                  (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                  "; allowed: " + join_names(allowed));
      }

      /// @p got, a list of @p n_got numbers, must have as many as @p names.
      void
      count(const std::string              &parameter,
            const std::string              &source,
            const std::string              &got,
            const std::vector<std::string> &names,
            const std::size_t               n_got) const
      {
        require(n_got == names.size(),
                parameter + " = " + (n_got == 0 ? "(nothing)" : got) +
                  "; allowed: " +
                  (names.empty() ? "nothing" :
                                   std::to_string(names.size()) + " numbers, " +
                                     join_names(names)) +
                  ", for Source = " + source);
      }

    private:
      const std::string &where;
    };

    template <typename Number>
    std::string
    list(const std::vector<Number> &numbers)
    {
      std::ostringstream text;
      for (std::size_t i = 0; i < numbers.size(); ++i)
        text << (i > 0 ? ", " : "") << numbers[i];
      return text.str();
    }

    std::string
    list(const std::array<double, 3> &numbers)
    {
      return list(std::vector<double>(numbers.begin(), numbers.end()));
    }

    template <typename Numbers>
    bool
    all_finite(const Numbers &numbers)
    {
      return std::all_of(numbers.begin(),
                         numbers.end(),
                         [](const double number) {
                           return std::isfinite(number);
                         });
    }

    template <typename Numbers>
    bool
    sensible_lengths(const Numbers &numbers)
    {
      return std::all_of(numbers.begin(),
                         numbers.end(),
                         [](const double number) {
                           return std::fabs(number) <= largest_length;
                         });
    }

    void
    validate_numbers(const MeshParameters &q, const Checker &check)
    {
      const Layout layout = layout_of(q);
      check.count(
        "Extent", q.source, list(q.extent), layout.extent, q.extent.size());
      check.count("Subdivisions",
                  q.source,
                  list(q.subdivisions),
                  layout.subdivisions,
                  q.subdivisions.size());
      double cells = 1.;
      for (const unsigned int n : q.subdivisions)
        {
          check.require(n >= 1 && n <= 10000,
                        "Subdivisions = " + list(q.subdivisions) +
                          "; allowed: 1 to 10000 each");
          cells *= n;
        }
      check.require(
        cells <= 2e7,
        "Subdivisions = " + list(q.subdivisions) +
          " make more than 20 million coarse cells; use Refinements instead");
      check.require(all_finite(q.extent),
                    "Extent = " + list(q.extent) + " is not finite");
      check.require(sensible_lengths(q.extent),
                    "Extent = " + list(q.extent) +
                      "; allowed: finite numbers of at most " +
                      list<double>({largest_length}) + " in magnitude");
      const bool radial =
        q.source == "shell octant" || q.source == "cylinder sector";
      if (radial)
        check.require(0. < q.extent[0] && q.extent[0] < q.extent[1],
                      "Extent = " + list(q.extent) +
                        "; allowed: 0 < r_in < r_out");
      if (q.source == "cylinder sector")
        check.require(0. < q.extent[2],
                      "Extent = " + list(q.extent) + "; allowed: length > 0");
      for (unsigned int d = 0; q.extent.size() == 6 && d < 3; ++d)
        check.require(q.extent[d] < q.extent[d + 3],
                      "Extent = " + list(q.extent) +
                        "; allowed: x0 < x1, y0 < y1, z0 < z1");
      double size = radial ? q.extent[1] : 0.;
      for (unsigned int d = 0; q.extent.size() == 6 && d < 3; ++d)
        size = std::max(size, q.extent[d + 3] - q.extent[d]);
      check.require(q.extent.empty() || size >= smallest_length,
                    "Extent = " + list(q.extent) +
                      "; allowed: a body whose size is " + allowed_lengths());
    }

    /// Check that parameters of files are not set.
    void
    validate_file(const MeshParameters &q, const Checker &check)
    {
      if (q.source == "file")
        return;
      const std::pair<std::string, std::string> given[] = {
        {"File", q.file},
        {"Part", q.part},
        {"Boundaries", q.boundaries},
        {"Curved boundaries", q.curved_boundaries},
        {"Mesh size", q.mesh_size == 0. ? "" : list<double>({q.mesh_size})}};
      for (const auto &[name, value] : given)
        check.require(value.empty(),
                      name + " = " + in_quotes(value, '\'') +
                        " belongs to Source = file; got Source = " + q.source);
    }

    void
    validate_box(const MeshParameters &q, const Checker &check)
    {
      if (q.source != "box")
        {
          for (const double slope : {q.bottom_slope[0],
                                     q.bottom_slope[1],
                                     q.top_slope[0],
                                     q.top_slope[1]})
            check.require(slope == 0.,
                          "Bottom slope and Top slope belong to Source = box");
          check.require(q.distort == 0., "Distort belongs to Source = box");
          return;
        }
      check.require(q.distort >= 0. && q.distort <= 0.3,
                    "Distort = " + list<double>({q.distort}) +
                      "; allowed: 0 to 0.3");
      check.require(all_finite(q.bottom_slope) && all_finite(q.top_slope),
                    "Bottom slope or Top slope is not finite");
      for (unsigned int corner = 0; corner < 4; ++corner)
        {
          const double x = corner % 2 * (q.extent[3] - q.extent[0]);
          const double y = corner / 2 * (q.extent[4] - q.extent[1]);
          check.require(
            q.extent[5] + q.top_slope[0] * x + q.top_slope[1] * y >
              q.extent[2] + q.bottom_slope[0] * x + q.bottom_slope[1] * y,
            "with Bottom slope and Top slope the top meets the bottom of the box; "
            "allowed: slopes that leave a positive height at all four sides");
        }
    }

    void
    validate_curved_block(const MeshParameters &q, const Checker &check)
    {
      if (q.source != "curved block")
        {
          check.require(q.amplitude == 0.,
                        "Amplitude belongs to Source = curved block");
          return;
        }
      check.choice("Surface", q.surface, surface_names());
      check.require(q.middle > 0. && q.middle < 1.,
                    "Middle = " + list<double>({q.middle}) +
                      "; allowed: between 0 and 1");
      const double height =
        (q.extent[5] - q.extent[2]) * std::min(q.middle, 1. - q.middle);
      std::ostringstream got;
      got << "Amplitude = " << q.amplitude
          << "; allowed: less in magnitude than " << 0.9 * height
          << ", 0.9 times the height of the thinner half";
      check.require(std::fabs(q.amplitude) < 0.9 * height, got.str());
    }
  } // namespace

  std::vector<std::string>
  mesh_source_names()
  {
    std::vector<std::string> names = generator_names();
    names.emplace_back("file");
    return names;
  }

  std::vector<Ball>
  refinement_balls(const MeshParameters &parameters, const std::string &where)
  {
    return parse_balls(parameters.refine_near,
                       where + ": Refine near",
                       "times",
                       12);
  }

  void
  validate(const MeshParameters &parameters, const std::string &where)
  {
    const Checker check(where);
    check.choice("Source", parameters.source, mesh_source_names());
    check.choice("Cells",
                 parameters.cells,
                 {"auto", "hexahedra", "tetrahedra"});
    if (parameters.source == "curved block")
      check.choice("Half", parameters.half, {"lower", "upper", "both"});
    validate_file(parameters, check);
    validate_numbers(parameters, check);
    validate_box(parameters, check);
    validate_curved_block(parameters, check);
    const auto   balls  = refinement_balls(parameters, where);
    unsigned int levels = parameters.refinements;
    for (const Ball &ball : balls)
      levels += ball.number;
    check.require(levels <= 14,
                  "Refinements and the times of Refine near make " +
                    std::to_string(levels) + " levels; allowed: 14 in all");
    check.require(parameters.cells != "tetrahedra" || balls.empty(),
                  "Refine near = " + in_quotes(parameters.refine_near, '\'') +
                    " belongs to hexahedra, since tetrahedra cannot be refined "
                    "locally; try Degree near, Refinements, or a gmsh file "
                    "whose Mesh size varies");
    check.require(all_finite(parameters.rotate) &&
                    all_finite(parameters.translate),
                  "Rotate or Translate is not finite");
    check.require(sensible_lengths(parameters.translate),
                  "Translate = " + list(parameters.translate) +
                    "; allowed: lengths of at most " +
                    list<double>({largest_length}) + " in magnitude");
    if (parameters.source == "file")
      check_file_parameters(parameters, where);
  }

  std::vector<std::string>
  boundary_names(const MeshParameters &parameters)
  {
    if (parameters.source != "file")
      {
        Checker("Mesh").choice("Source",
                               parameters.source,
                               mesh_source_names());
        return generator_boundaries(parameters);
      }
    std::vector<std::string> names;
    for (const auto &[name, id] :
         read_mesh_file(parameters, "Mesh", MPI_COMM_SELF).names.boundaries)
      names.push_back(name);
    return names;
  }
} // namespace mortise
