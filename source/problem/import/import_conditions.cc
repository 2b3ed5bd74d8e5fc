#include "import_conditions.h"

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mortise
{
  using namespace dealii;

  ImportConditions::ImportConditions(ImportBodies      &bodies,
                                     const ImportSteps &steps,
                                     ImportRemarks     &remarks)
    : bodies(bodies)
    , deck(bodies.deck)
    , steps(steps)
    , remarks(remarks)
  {
    find_references();
    for (const InpBlock *block : steps.model)
      read(*block, 0);
    for (std::size_t step = 0; step < steps.steps.size(); ++step)
      for (const InpBlock *block : steps.steps[step].blocks)
        read(*block, step + 1);
    tell_released_supports();
    find_supports();
    find_couplings();
    find_forces();
    // elements that are loaded alike, each in a line of its own, are one load
    std::map<std::string, std::pair<ImportCondition, std::set<unsigned int>>>
      loads;
    for (const auto &entry : face_loads)
      {
        const FaceLoad     &load      = entry.second;
        ImportCondition     condition = load.condition;
        const ImportHistory history   = steps.history(load.changes);
        condition.value[0]            = history;
        std::string key = condition.name + ":" + history.text() + ":";
        for (std::size_t d = 0; d < load.direction.size(); ++d)
          {
            condition.traction[d] = history.times(load.direction[d]);
            key += number_text(load.direction[d]) + ",";
          }
        auto &found = loads[key];
        found.first = condition;
        found.second.insert(load.faces.begin(), load.faces.end());
      }
    for (const auto &entry : loads)
      add(entry.second.first,
          {entry.second.second.begin(), entry.second.second.end()});
  }

  void
  ImportConditions::read(const InpBlock &block, const std::size_t step)
  {
    static const std::set<std::string> acting = {
      "*BOUNDARY", "*CLOAD", "*DLOAD", "*DSLOAD", "*TEMPERATURE"};
    if (acting.count(block.keyword) > 0)
      {
        if (block.has("FIXED") && is_kept(block, step))
          return;
        for (const std::string option :
             {"USER", "SUBMODEL", "FIXED", "FILE", "CYCLIC MODE"})
          if (block.has(option))
            return remarks.left_out(block.place, block.keyword + ", " + option);
        for (const std::string option : {"TIME DELAY", "SECTOR"})
          if (block.has(option))
            remarks.left_out(block.place,
                             "the option " + option + " of " + block.keyword);
      }
    if (block.keyword == "*TRANSFORM")
      read_transform(block);
    else if (block.keyword == "*BOUNDARY")
      read_boundary(block, step);
    else if (block.keyword == "*CLOAD")
      read_nodal_forces(block, step);
    else if (block.keyword == "*DLOAD" || block.keyword == "*DSLOAD" ||
             block.keyword == "*FOUNDATION")
      read_loads(block, step);
    else if (block.keyword == "*TEMPERATURE" ||
             (block.keyword == "*INITIAL CONDITIONS" &&
              upper(block.option("TYPE")) == "TEMPERATURE"))
      read_temperatures(block, step);
    else if (block.keyword == "*INITIAL CONDITIONS")
      remarks.left_out(block.place,
                       block.keyword + ", TYPE=" + block.option("TYPE"));
  }

  void
  ImportConditions::read_transform(const InpBlock &block)
  {
    const auto        x     = block.lines.empty() ? std::vector<double>() :
                                                    import_numbers(block.lines[0]);
    const std::string kind  = upper(block.option("TYPE")).substr(0, 1);
    const bool        round = kind == "C";
    if (x.size() != 6 || kind == "S")
      return remarks.left_out(block.place,
                              "*TRANSFORM that is neither of TYPE=R nor of "
                              "TYPE=C with two points");
    const Tensor<1, 3> a({x[0], x[1], x[2]}), b({x[3], x[4], x[5]});
    const Tensor<2, 3> fixed =
      round ? Tensor<2, 3>() : axes_of(a, b, block.place);
    for (const unsigned int node :
         deck.find_nodes(block.option("NSET"), block.instance))
      {
        LocalSystem &at = local_axes[node];
        at              = {fixed, round, 0.};
        if (!round)
          continue;
        // z along the axis from a to b, x to the node
        const Tensor<1, 3> axis   = b - a;
        Tensor<1, 3>       radial = Tensor<1, 3>(deck.nodes[node]) - a;
        if (axis.norm() > 0.)
          radial -= (radial * axis) / axis.norm_square() * axis;
        at.radius = radial.norm();
        if (at.radius > 1e-12 * axis.norm())
          at.axes =
            axes_of(radial, cross_product_3d(axis, radial), block.place);
        else
          {
            local_axes.erase(node);
            remarks.left_out(block.place,
                             "*TRANSFORM, TYPE=C of a node on its axis");
          }
      }
  }

  unsigned int
  ImportConditions::add(const ImportCondition           &condition,
                        const std::vector<unsigned int> &faces)
  {
    const unsigned int number = conditions.size();
    conditions.push_back(condition);
    for (const unsigned int f : faces)
      bodies.faces[f].conditions.push_back(number);
    return number;
  }

  void
  ImportConditions::name_boundaries()
  {
    std::map<std::pair<unsigned int, std::vector<unsigned int>>, std::string>
                                          boundaries;
    std::vector<std::vector<std::string>> taken(bodies.bodies.size());
    for (ImportFace &face : bodies.faces)
      {
        if (face.conditions.empty())
          continue;
        std::string &name = boundaries[{face.body, face.conditions}];
        if (name.empty())
          {
            std::set<std::string> names;
            for (const unsigned int c : face.conditions)
              names.insert(conditions[c].name);
            std::string joined;
            for (const std::string &part : names)
              joined += (joined.empty() ? "" : "-") + part;
            if (joined.size() > 60)
              joined = joined.substr(0, 60);
            name = scene_name(joined, taken[face.body]);
            taken[face.body].push_back(name);
          }
        face.boundary = name;
      }
    for (ImportFace &face : bodies.faces)
      if (taken[face.body].empty())
        face.boundary = "skin";
  }

  bool
  ImportConditions::is_held(const unsigned int body,
                            const unsigned int condition) const
  {
    return std::any_of(
      bodies.faces.begin(), bodies.faces.end(), [&](const ImportFace &face) {
        const auto &all = face.conditions;
        return face.body == body &&
               std::count(all.begin(), all.end(), condition) > 0 &&
               std::any_of(all.begin(), all.end(), [&](const auto c) {
                 return conditions[c].kind == ImportCondition::Kind::support ||
                        conditions[c].kind == ImportCondition::Kind::motion ||
                        conditions[c].kind == ImportCondition::Kind::rigid_part;
               });
      });
  }

  namespace
  {
    std::string
    three(const std::array<std::string, 3> &texts, const std::string &between)
    {
      return texts[0] + between + texts[1] + between + texts[2];
    }

    std::string
    setting(const std::string &name, const std::string &value)
    {
      return "    set " + name + " = " + value + "\n";
    }

    std::string
    point_text(const Point<3> &x)
    {
      return three({number_text(x[0]), number_text(x[1]), number_text(x[2])},
                   ", ");
    }

    std::string
    history_text(const std::array<ImportHistory, 3> &x)
    {
      return three({x[0].text(), x[1].text(), x[2].text()}, "; ");
    }

    std::string
    vector_setting(const std::string                  &name,
                   const std::array<ImportHistory, 3> &x)
    {
      if (std::all_of(x.begin(), x.end(), [](const auto &h) {
            return h.is_zero();
          }))
        return "";
      return setting(name, history_text(x));
    }

    /// Add components along the axes of the scene to those along @p axes; false:
    /// one of them is parallel to none of these.
    bool
    add_components(const std::array<std::string, 3> &of_scene,
                   const Tensor<2, 3>               &axes,
                   std::array<std::string, 3>       &local)
    {
      bool all = true;
      for (unsigned int d = 0; d < 3; ++d)
        if (of_scene[d] != "-")
          {
            bool found = false;
            for (unsigned int c = 0; c < 3; ++c)
              if (std::fabs(axes[d][c]) > 1. - 1e-9)
                {
                  found = true;
                  local[c] =
                    axes[d][c] > 0. ? of_scene[d] : "-(" + of_scene[d] + ")";
                }
            all = all && found;
          }
      return all;
    }

    std::array<ImportHistory, 3>
    sum_of(const std::array<ImportHistory, 3> &a,
           const std::array<ImportHistory, 3> &b)
    {
      return {{a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])}};
    }

    /// A constant matrix times histories.
    std::array<ImportHistory, 3>
    product(const Tensor<2, 3> &A, const std::array<ImportHistory, 3> &x)
    {
      std::array<ImportHistory, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if (std::fabs(A[i][j]) > 1e-12 * A.norm())
            result[i] = result[i].plus(x[j].times(A[i][j]));
      return result;
    }

    /// v x ... as a matrix.
    Tensor<2, 3>
    cross_matrix(const Tensor<1, 3> &v)
    {
      Tensor<2, 3> A;
      A[0][1] = -v[2];
      A[0][2] = v[1];
      A[1][0] = v[2];
      A[1][2] = -v[0];
      A[2][0] = -v[1];
      A[2][1] = v[0];
      return A;
    }
  } // namespace

  std::string
  ImportConditions::boundaries_text(const unsigned int body) const
  {
    std::map<std::string, std::vector<unsigned int>> boundaries;
    for (unsigned int f = 0; f < bodies.faces.size(); ++f)
      if (bodies.faces[f].body == body && !bodies.faces[f].boundary.empty())
        boundaries[bodies.faces[f].boundary].push_back(f);
    std::string text;
    for (const auto &[name, faces] : boundaries)
      {
        std::array<std::string, 3> displacement = free_components,
                                   local        = free_components;
        Tensor<2, 3>                 axes;
        std::string                  normal, motion, stiffness, pressure, lines;
        std::array<ImportHistory, 3> traction, force, moment;
        const ImportCondition       *rigid = nullptr;
        for (const unsigned int c : bodies.faces[faces[0]].conditions)
          {
            const ImportCondition &condition = conditions[c];
            switch (condition.kind)
              {
                case ImportCondition::Kind::support:
                  if (condition.component == ImportCondition::normal)
                    normal = affine_text(condition.value);
                  else if (condition.axes.norm() > 0.)
                    {
                      local[condition.component] = affine_text(condition.value);
                      axes                       = condition.axes;
                    }
                  else
                    displacement[condition.component] =
                      affine_text(condition.value);
                  break;
                case ImportCondition::Kind::motion:
                  displacement = condition.displacement;
                  motion =
                    setting("Rotation", history_text(condition.traction)) +
                    setting("Reference point", point_text(condition.reference));
                  break;
                case ImportCondition::Kind::rigid_part:
                  rigid = &condition;
                  break;
                case ImportCondition::Kind::foundation:
                  stiffness += (stiffness.empty() ? "" : " + ") +
                               affine_text(condition.value);
                  break;
                case ImportCondition::Kind::pressure:
                  pressure += (pressure.empty() ? "" : " + ") +
                              affine_text(condition.value);
                  break;
                case ImportCondition::Kind::traction:
                  traction = sum_of(traction, condition.traction);
                  break;
                case ImportCondition::Kind::force:
                  {
                    // the part of the traction F / A + w x (x - centroid) on
                    // these faces
                    const ImportForce &whole = condition.force;
                    const ImportForce  part  = area_of(faces);
                    const double       share = part.area / whole.area;
                    const auto w = product(invert(whole.inertia), whole.moment);
                    force        = sum_of(force,
                                          {{whole.force[0].times(share),
                                            whole.force[1].times(share),
                                            whole.force[2].times(share)}});
                    if (share < 1. - 1e-9)
                      force = sum_of(force,
                                     product(-part.area *
                                               cross_matrix(part.centroid -
                                                            whole.centroid),
                                             w));
                    moment = sum_of(moment, product(part.inertia, w));
                    break;
                  }
                default:
                  break;
              }
          }
        if (rigid != nullptr)
          {
            if (!normal.empty() || axes.norm() > 0. || !stiffness.empty() ||
                displacement != free_components)
              remarks.left_out("*BOUNDARY",
                               "of the body " + bodies.bodies[body].name +
                                 " at " + name +
                                 ", which moves with a reference node");
            normal.clear();
            stiffness.clear();
            axes         = {};
            displacement = rigid->displacement;
            motion       = setting("Coupling", "rigid") +
                     setting("Reference point", point_text(rigid->reference));
            if (rigid->rotation != free_components)
              motion += setting("Rotation", three(rigid->rotation, "; "));
            force  = sum_of(force, rigid->force.force);
            moment = sum_of(moment, rigid->force.moment);
          }
        bool both = !normal.empty() && displacement != free_components;
        if (axes.norm() > 0.)
          {
            both         = !add_components(displacement, axes, local) || both;
            displacement = local;
          }
        if (both)
          remarks.left_out("*BOUNDARY",
                           "of the body " + bodies.bodies[body].name + " at " +
                             name +
                             ", along the axes of the scene beside others");
        if (!normal.empty())
          lines += setting("Displacement", "normal: " + normal);
        else if (displacement != free_components)
          lines += setting("Displacement", three(displacement, ", "));
        if (axes.norm() > 0.)
          lines += setting("Displacement axes", angles_text(axes));
        lines += motion;
        if (!stiffness.empty())
          lines += setting("Normal stiffness", stiffness);
        if (!pressure.empty())
          lines += setting("Pressure", pressure);
        lines += vector_setting("Traction", traction) +
                 vector_setting("Force", force) +
                 vector_setting("Moment", moment);
        if (!lines.empty())
          text += "  subsection Boundary " + name + "\n" + lines + "  end\n";
      }
    return text;
  }

  std::string
  ImportConditions::side_text(const unsigned int body,
                              const unsigned int condition) const
  {
    std::set<std::string> names;
    for (const ImportFace &face : bodies.faces)
      if (face.body == body && std::count(face.conditions.begin(),
                                          face.conditions.end(),
                                          condition) > 0)
        names.insert(face.boundary);
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? bodies.bodies[body].name + ": " : ", ") + name;
    return text;
  }

  std::string
  ImportConditions::resultants_text() const
  {
    std::set<std::string> entries;
    for (const ImportFace &face : bodies.faces)
      for (const unsigned int c : face.conditions)
        if (conditions[c].kind == ImportCondition::Kind::support)
          {
            const std::string &body = bodies.bodies[face.body].name;
            entries.insert((bodies.bodies.size() > 1 ? body + "-" : "") +
                           face.boundary + ": " + body + ": " + face.boundary);
          }
    std::string text;
    for (const std::string &entry : entries)
      text += (text.empty() ? "" : "; ") + entry;
    return text;
  }

  void
  ImportConditions::read_temperatures(const InpBlock   &block,
                                      const std::size_t step)
  {
    for (const InpLine &line : block.lines)
      {
        const auto numbers = import_numbers(line, 1);
        if (numbers.empty())
          continue;
        for (const unsigned int node :
             deck.find_nodes(line.words[0], block.instance))
          if (block.keyword == "*TEMPERATURE")
            ImportSteps::change(temperatures[node],
                                {step,
                                 numbers[0],
                                 upper(block.option("AMPLITUDE"))});
          else
            initial[node] = numbers[0];
      }
  }

  /// Where it is linear in x, y, z.
  std::string
  ImportConditions::temperature_text(const unsigned int body) const
  {
    const auto &nodes = bodies.bodies[body].nodes;
    std::map<std::string, std::vector<unsigned int>> by_steps;
    for (const unsigned int node : nodes)
      {
        std::string kind;
        if (const auto found = temperatures.find(node);
            found != temperatures.end())
          for (const ImportChange &change : found->second)
            kind += std::to_string(change.step) + "," + change.amplitude + ",";
        by_steps[kind].push_back(node);
      }
    if (by_steps.size() == 1 && by_steps.begin()->first.empty())
      return "";
    bool          fits = by_steps.size() == 1;
    AffineHistory sum;
    if (fits)
      {
        std::vector<Point<3>>                    points;
        std::array<std::vector<ImportChange>, 4> coefficients;
        for (const unsigned int node : nodes)
          points.push_back(deck.nodes[node]);
        const auto &first = temperatures.at(nodes[0]);
        for (std::size_t i = 0; fits && i < first.size(); ++i)
          {
            // what acts is the difference; an amplitude scales the temperature
            std::vector<double> values;
            for (const unsigned int node : nodes)
              {
                const auto at = initial.find(node);
                values.push_back(temperatures.at(node)[i].value -
                                 (at == initial.end() ? 0. : at->second));
              }
            const auto fit = affine_fit(points, values);
            fits           = !fit.empty();
            for (unsigned int k = 0; fits && k < 4; ++k)
              coefficients[k].push_back(
                {first[i].step, fit[k], first[i].amplitude});
          }
        for (unsigned int k = 0; fits && k < 4; ++k)
          sum[k] = steps.history(coefficients[k]);
      }
    if (!fits)
      {
        remarks.left_out("*TEMPERATURE",
                         "that of the body " + bodies.bodies[body].name +
                           ", which is no linear function of x, y, z");
        return "";
      }
    return "  set Temperature = " + affine_text(sum) + "\n";
  }
} // namespace mortise
