// Proves of steps with friction, two blocks of which one is pressed on the
// other and drawn to and fro, that every node has |t| <= F, slips along t and
// only where |t| = F, and dissipates; that Newton's method and the fixed point,
// iterative and direct, and any number of ranks come to the same; that nothing
// depends on the axes; that a coefficient of zero is no friction, and a large
// one a tie.
#include <mortise/problem/scene_solver.h>
#include <scenes/scene.h>
#include <scenes/scenes.h>
#include <scenes/solutions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace mortise;
using namespace mortise::testing;

namespace
{
  using Vec = dealii::Tensor<1, dim>;

  /// A node after a step.
  struct NodeResult
  {
    dealii::Point<dim> position;
    NodeStatus         status = NodeStatus::open;
    double             area = 0., pressure = 0., bound = 0., dissipated = 0.;
    Vec                traction, slip; ///< tangential, of the step; in space

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &position &status &area &pressure &bound &dissipated &traction
        &slip;
    }
  };

  using Nodes = std::vector<NodeResult>;

  /// Less than a tenth of what blocks are moved by is measured beside that.
  constexpr double least_slip = 1e-3;

  /// A scene that takes one step after the other.
  class Steps
  {
  public:
    Steps(const std::string &text,
          const Settings    &settings,
          const MPI_Comm     comm = MPI_COMM_WORLD)
      : parameters(valid(parse_parameters(text, "test", settings)))
      , log(silence, comm)
      , run{parameters, log, timers, comm}
      , first(parameters, 1., checks)
      , bodies(create_meshes(run))
      , solver(run, first, bodies, {}, nullptr)
    {}

    /// The nodes of all ranks after the step to @p time.
    Nodes
    step(const double time)
    {
      data.push_back(std::make_unique<SceneData>(parameters, time, checks));
      load               = solver.discretisation.load(*data.back());
      SolvedState solved = solver.solve(*data.back(), {}, {}, load);
      converged          = converged && solved.report.converged;
      solution           = solved.state.solution;
      return results();
    }

    /// Displacements of all bodies.
    std::vector<BodySolution>
    fields() const
    {
      return solver.discretisation.solutions(load, solution);
    }

    bool converged = true;

  private:
    static Parameters
    valid(Parameters parameters)
    {
      validate(parameters);
      return parameters;
    }

    Nodes
    results()
    {
      const Pairing      &interfaces = solver.discretisation.interfaces();
      const SolvedContact contact    = solver.solved_contact();
      const auto          nodes      = interfaces.contact_nodes();
      const auto          bound = data.back()->friction(interfaces.sides()[0]);
      slips.resize(nodes.size());
      Nodes own;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          const ContactNode &node  = *nodes[i];
          const Vec          value = node.traction(solution.multiplier.begin());
          NodeResult        &result = own.emplace_back();
          result.position           = node.position;
          result.status             = contact.statuses[i];
          result.area               = node.area;
          result.pressure           = node.normal * value;
          const FrictionBound law   = bound(node.position);
          result.bound              = result.status == NodeStatus::stick ?
                                        law.at_rest(result.pressure) :
                                        law.of(result.pressure);
          result.dissipated         = contact.dissipated[i];
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            {
              const Vec along = node.forces[r] / node.forces[r].norm();
              result.traction +=
                (value[r] - result.pressure * node.normal[r]) * along;
              result.slip += (contact.slips[i][r] - slips[i][r]) * along;
            }
          slips[i] = contact.slips[i];
        }
      Nodes all;
      for (const Nodes &of_rank :
           dealii::Utilities::MPI::all_gather(run.comm, own))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      return all;
    }

    const Parameters   parameters;
    std::ostringstream silence;
    RunLog             log;
    Timers             timers;
    FieldChecks        checks;
    const RunContext   run;
    const SceneData    first;
    Bodies             bodies;
    SceneSolver        solver;
    SceneLoad          load;
    SystemVector       solution;
    std::vector<Vec>   slips; ///< of all steps

    std::vector<std::unique_ptr<SceneData>> data;
  };

  const std::vector<double> times = {1., 2., 3., 4.};

  /// The motion of the upper block's upper face: out along one direction,
  /// further, aside, and back.
  std::array<std::string, dim>
  motion_texts()
  {
    return {
      {"(0.009*t - 0.006*max(t - 1, 0) - 0.005*max(t - 2, 0) - 0.016*max(t - 3, 0))",
       "(0.002*max(t - 1, 0))",
       "(-0.01 - 0.001*t)"}};
  }

  /// @p turn: degrees about x, y, z.
  std::string
  blocks(const std::array<double, dim> &turn = {})
  {
    std::array<Vec, dim> rows;
    for (unsigned int c = 0; c < dim; ++c)
      {
        Vec axis;
        axis[c] = 1.;
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double angle = turn[a] * dealii::numbers::PI / 180.;
            const double p = axis[(a + 1) % 3], q = axis[(a + 2) % 3];
            axis[(a + 1) % 3] = std::cos(angle) * p - std::sin(angle) * q;
            axis[(a + 2) % 3] = std::sin(angle) * p + std::cos(angle) * q;
          }
        for (unsigned int d = 0; d < dim; ++d)
          rows[d][c] = axis[d];
      }
    std::string pushed, rotate;
    for (unsigned int d = 0; d < dim; ++d)
      {
        pushed += d > 0 ? ", " : "";
        for (unsigned int c = 0; c < dim; ++c)
          pushed += (c > 0 ? " + " : "") + std::string("(") +
                    number(rows[d][c]) + ")*" + motion_texts()[c];
        rotate += (d > 0 ? ", " : "") + number(turn[d]);
      }
    return tied("lower, upper", "upper: zmin", "lower: zmax") +
           "subsection Steps\n  set Step = 1, 2, 3, 4\nend\n"
           "subsection Interface glue\n  set Law = contact\n"
           "  set Friction coefficient = 0.3\nend\n"
           "subsection Solver\n  set Tolerance = 1e-11\nend\n"
           "subsection Body lower\n  set Degree = 2\n  subsection Mesh\n"
           "    set Extent = 0, 0, 0, 1.4, 1.2, 0.5\n    set Subdivisions = 4, 3, 2\n"
           "    set Rotate = " +
           rotate +
           "\n  end\n  subsection Material\n    set Young modulus = 900\n"
           "    set Poisson ratio = 0.3\n  end\n"
           "  subsection Boundary zmin\n    set Displacement = 0, 0, 0\n  end\nend\n"
           "subsection Body upper\n  set Degree = 2\n  subsection Mesh\n"
           "    set Extent = 0.2, 0.1, 0.5, 1.2, 1.1, 1\n    set Subdivisions = 3, 3, 1\n"
           "    set Rotate = " +
           rotate +
           "\n  end\n  subsection Material\n    set Young modulus = 300\n"
           "    set Poisson ratio = 0.1\n  end\n"
           "  subsection Boundary zmax\n    set Displacement = " +
           pushed + "\n  end\nend\n";
  }

  /// The largest differences of statuses, tractions and slips beside the
  /// largest traction and slip, of nodes at the same places. @p turned: from
  /// the one to the other.
  struct Difference
  {
    unsigned int statuses  = 0;
    double       tractions = 0., slips = 0.;
  };

  template <typename Turned>
  Difference
  difference(const Nodes &a, const Nodes &b, const Turned &turned)
  {
    Difference result;
    double     traction = 0., slip = least_slip;
    for (const NodeResult &one : a)
      {
        const dealii::Point<dim> at(turned(one.position));
        const auto               other =
          std::min_element(b.begin(), b.end(), [&](auto &c, auto &d) {
            return c.position.distance(at) < d.position.distance(at);
          });
        result.statuses +=
          one.status == other->status && other->position.distance(at) < 1e-8 ?
            0 :
            1;
        result.tractions =
          std::max(result.tractions,
                   (turned(one.traction) - other->traction).norm() +
                     std::fabs(one.pressure - other->pressure));
        result.slips =
          std::max(result.slips, (turned(one.slip) - other->slip).norm());
        traction = std::max(traction, one.traction.norm());
        slip     = std::max(slip, one.slip.norm());
      }
    result.tractions /= traction;
    result.slips /= slip;
    return result;
  }

  const auto as_it_is = [](const Vec &v) { return v; };

  void
  check_same(const std::string &what,
             const Difference  &got,
             const double       allowed)
  {
    std::ostringstream limit;
    limit << " " << allowed;
    verdict(what + ": statuses", got.statuses, 0.);
    verdict(what + ": tractions" + limit.str(), got.tractions, allowed);
    verdict(what + ": slips" + limit.str(), got.slips, allowed);
  }

  void
  check_law(const std::string &what,
            const Settings    &settings,
            const bool         opens = false)
  {
    Steps        scene(blocks(), settings);
    double       energy = 0.;
    unsigned int n_back = 0, n_mixed = 0, n_open = 0;
    Nodes        last;
    for (const double time : times)
      {
        const Nodes       nodes = scene.step(time);
        const std::string at    = what + ", t = " + number(time);
        double over = 0., along = 0., against = 0., sticks = 0., pulls = 0.;
        double largest = 0., slip = least_slip, sum = 0.;
        unsigned int n[3] = {0, 0, 0};
        for (const NodeResult &node : nodes)
          {
            largest = std::max(largest, node.bound);
            slip    = std::max(slip, node.slip.norm());
          }
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            NodeResult node = nodes[i];
            // those that close have no friction before they are closed
            if (!last.empty() && last[i].status == NodeStatus::open)
              node.bound = 0.;
            ++n[static_cast<unsigned int>(node.status)];
            over  = std::max(over, node.traction.norm() - node.bound);
            pulls = std::max(pulls, -node.pressure);
            if (node.status == NodeStatus::slip)
              {
                along   = std::max(along,
                                 (node.slip.norm() * node.traction -
                                  node.bound * node.slip)
                                   .norm());
                against = std::max(against, -(node.slip * node.traction));
              }
            else if (node.status == NodeStatus::stick)
              sticks = std::max(sticks, node.slip.norm());
            else
              over = std::max(over, node.traction.norm());
            sum += node.dissipated;
          }
        verdict(at + ": |t| <= F 1e-8", over / largest, 1e-8);
        verdict(at + ": t |s| = F s 1e-8", along / (largest * slip), 1e-8);
        verdict(at + ": s t >= 0", against / (largest * slip), 1e-12);
        verdict(at + ": no slip where it sticks 1e-8", sticks / slip, 1e-8);
        verdict(at + ": nothing pulls 1e-8", pulls / largest, 1e-8);
        verdict(at + ": does not gain energy", energy - sum, 1e-15);
        n_mixed += n[1] > 0 && n[2] > 0 ? 1 : 0;
        n_open += n[0] > 0 ? 1 : 0;
        verdict(scene.converged, at + ": converged");
        for (unsigned int i = 0; i < last.size(); ++i)
          n_back += last[i].status == NodeStatus::slip &&
                        nodes[i].status == NodeStatus::stick ?
                      1 :
                      0;
        energy = sum;
        last   = nodes;
      }
    verdict(n_back > 0, what + ": some that slipped stick again");
    verdict(n_mixed > 0, what + ": some stick beside others that slip");
    verdict(energy > 0. && opens == (n_open > 0), what + ": dissipates");
  }

  void
  check_methods()
  {
    const std::vector<std::array<std::string, 2>> ways = {
      {{"newton", "direct"}},
      {{"newton", "saddle point"}},
      {{"fixed point", "direct"}},
      {{"fixed point", "saddle point"}},
      {{"newton", "condensed"}},
      {{"fixed point", "condensed"}}};
    std::vector<std::unique_ptr<Steps>> scenes;
    for (const auto &[friction, method] : ways)
      scenes.push_back(std::make_unique<Steps>(
        blocks(),
        Settings{"Solver/Friction=" + friction, "Solver/Method=" + method}));
    for (const double time : times)
      {
        const Nodes first  = scenes[0]->step(time);
        const auto  fields = scenes[0]->fields();
        for (unsigned int i = 1; i < ways.size(); ++i)
          {
            const std::string what =
              ways[i][0] + ", " + ways[i][1] + ", t = " + number(time);
            const Nodes nodes = scenes[i]->step(time);
            verdict(scenes[i]->converged, what + ": converged");
            verdict(what + ": displacements 1e-8",
                    relative_difference(scenes[i]->fields(), fields),
                    1e-8);
            check_same(what, difference(first, nodes, as_it_is), 1e-7);
          }
      }
  }

  void
  check_ranks()
  {
    Steps scene(blocks(), {}), alone(blocks(), {}, MPI_COMM_SELF);
    for (const double time : times)
      {
        const Nodes one = scene.step(time), other = alone.step(time);
        verdict("as on one rank, t = " + number(time) + ": nodes",
                std::fabs(double(one.size()) - double(other.size())),
                0.);
        check_same("as on one rank, t = " + number(time),
                   difference(one, other, as_it_is),
                   1e-7);
      }
  }

  void
  check_rotation()
  {
    const std::array<double, dim> angles{{20., 35., 50.}};
    Steps      straight(blocks(), {}), tilted(blocks(angles), {});
    const auto turned = [&](const Vec &v) {
      Vec result = v;
      for (unsigned int a = 0; a < dim; ++a)
        {
          const double angle = angles[a] * dealii::numbers::PI / 180.;
          const double p = result[(a + 1) % 3], q = result[(a + 2) % 3];
          result[(a + 1) % 3] = std::cos(angle) * p - std::sin(angle) * q;
          result[(a + 2) % 3] = std::sin(angle) * p + std::cos(angle) * q;
        }
      return result;
    };
    for (const double time : times)
      {
        const Nodes one = straight.step(time), other = tilted.step(time);
        check_same("turned, t = " + number(time),
                   difference(one, other, turned),
                   1e-7);
      }
  }

  /// A coefficient of zero, in an expression that does not tell, or so in a
  /// part, and one that lets nothing slip.
  void
  check_limits()
  {
    Steps none(blocks(), {"Interface glue/Friction coefficient="}),
      zero(blocks(), {"Interface glue/Friction coefficient=0*x"}),
      small(blocks(), {"Interface glue/Friction coefficient=1e-14*x"});
    for (const double time : {1., 2.})
      {
        none.step(time);
        const Nodes nodes = zero.step(time);
        small.step(time);
        const std::string at = ", t = " + number(time);
        verdict("zero coefficient" + at + ": as without friction 1e-9",
                relative_difference(zero.fields(), none.fields()),
                1e-9);
        verdict("tiny coefficient" + at + ": as without friction 1e-9",
                relative_difference(small.fields(), none.fields()),
                1e-9);
        double most = 0.;
        for (const NodeResult &node : nodes)
          most = std::max({most, node.traction.norm(), node.dissipated});
        verdict("zero coefficient" + at + ": neither traction nor dissipation",
                most,
                1e-30);
      }

    const Settings pressed{
      "Body upper/Boundary zmax/Displacement=0.0002*t, 0.0001*t, -0.02",
      "Body upper/Material/Poisson ratio=0",
      "Body lower/Material/Poisson ratio=0",
      "Body upper/Mesh/Extent=0, 0, 0.5, 1.4, 1.2, 1"};
    Steps tie(blocks(),
              pressed + Settings{"Interface glue/Law=tie",
                                 "Interface glue/Friction coefficient="}),
      large(blocks(),
            pressed + Settings{"Interface glue/Friction coefficient=1e3"});
    for (const double time : {1., 2.})
      {
        tie.step(time);
        const Nodes nodes = large.step(time);
        verdict(std::all_of(nodes.begin(),
                            nodes.end(),
                            [](const NodeResult &node) {
                              return node.status == NodeStatus::stick;
                            }),
                "large coefficient, t = " + number(time) + ": all sticks");
        verdict("large coefficient, t = " + number(time) + ": as a tie 1e-8",
                relative_difference(large.fields(), tie.fields()),
                1e-8);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_law("Coulomb", {});
  check_law("fixed point", {"Solver/Friction=fixed point"});
  check_law("Coulomb and static",
            {"Interface glue/Static friction coefficient=0.4"});
  check_law("Tresca",
            {"Interface glue/Law=tresca",
             "Interface glue/Friction coefficient=",
             "Interface glue/Friction bound=1.5 + 0.5*x"});
  check_law(
    "tilted",
    {"Body upper/Boundary zmax/Displacement=0.004*t - 0.008*max(t - 2, 0), "
     "0.001*t, -0.004 + 0.01*(x - 0.7)*(2.2 - t)"},
    true);
  // beside sides that are held components have functions of their own
  for (const std::string p : {"1", "2", "3"})
    for (const std::string held :
         {"0, -, -", "-, 0, -", "-, -, -0.01 - 0.001*t"})
      check_law("degree " + p + ", a side held: " + held,
                {"Body lower/Degree=" + p,
                 "Body upper/Degree=" + p,
                 "Body upper/Mesh/Extent=0, 0, 0.5, 1.2, 1.1, 1",
                 "Body lower/Boundary xmin/Displacement=0, -, -",
                 "Body upper/Boundary xmin/Displacement=" + held,
                 "Body upper/Boundary zmax/Displacement=0, 0.009*t - "
                 "0.006*max(t - 1, 0) - 0.02*max(t - 2, 0), -0.01 - 0.001*t",
                 "Body upper/Material/Poisson ratio=0.4"},
                held[3] == '-' && held[0] == '-');
  check_methods();
  check_ranks();
  check_rotation();
  check_limits();
}
