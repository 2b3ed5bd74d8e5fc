#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/interface/smooth_patches.h>
#include <mortise/mortar/slave_normals.h>
#include <mortise/problem/interface_law.h>
#include <mortise/problem/scene_couplings.h>
#include <mortise/problem/scene_data.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  SceneCouplings::SceneCouplings(const RunContext  &run,
                                 const SceneSpaces &spaces)
    : run(run)
    , spaces(spaces)
    , owned(0)
  {}

  unsigned int
  SceneCouplings::given_slave(const unsigned int i) const
  {
    const auto &given = run.parameters.interfaces;
    return std::find_if(given.begin(),
                        given.end(),
                        [&](const InterfaceParameters &interface) {
                          return interface.name == interfaces[i].name;
                        })
      ->slave.body;
  }

  std::vector<BoundaryFace>
  SceneCouplings::faces_of(const InterfaceParameters &given,
                           const SideParameters      &side) const
  {
    return side_faces(spaces.bodies, side, "Interface " + given.name);
  }

  std::string
  SceneCouplings::patch_name(const InterfaceParameters &given,
                             const unsigned int         k) const
  {
    const auto is = [](const std::string &name) {
      return [&](const auto &other) { return other.name == name; };
    };
    std::string name = given.name + "-" + std::to_string(k + 1);
    const auto &all  = run.parameters;
    while (std::any_of(all.bodies.begin(), all.bodies.end(), is(name)) ||
           std::any_of(all.interfaces.begin(), all.interfaces.end(), is(name)))
      name += "-";
    return name;
  }

  Coupling
  SceneCouplings::make_coupling(const InterfaceParameters       &given,
                                const std::string               &name,
                                const std::vector<BoundaryFace> &slave) const
  {
    const auto surface = [&](const SideParameters            &side,
                             const std::vector<BoundaryFace> &faces) {
      return extract_surface(*spaces.bodies[side.body],
                             faces,
                             spaces.fields.displacement.numbering,
                             spaces.fields.displacement.constraints,
                             spaces.nodal);
    };
    BodySurface slave_surface = surface(given.slave, slave);
    slave_surface.direction   = given.direction;
    BodySurface master_surface =
      given.is_support ?
        rigid_counterpart(slave_surface) :
        surface(given.master, faces_of(given, given.master));
    InterfaceOptions options;
    options.distance             = given.search_distance;
    options.points_per_direction = given.quadrature_points;
    Coupling coupling;
    coupling.is_spring  = given.law == "spring";
    coupling.is_contact = given.law == "contact";
    coupling.directions = tied_directions(run.parameters, given);
    coupling.interface =
      std::make_unique<InterfaceHandler>(name,
                                         std::move(slave_surface),
                                         std::move(master_surface),
                                         options,
                                         run.comm);
    return coupling;
  }

  void
  SceneCouplings::integrate(const InterfaceParameters &given,
                            Coupling                  &coupling) const
  {
    coupling.local =
      integrate_coupling(*coupling.interface,
                         spaces.choice.method != SolverMethod::direct,
                         given.multiplier == "dual" ? MultiplierBasis::dual :
                                                      MultiplierBasis::standard,
                         !coupling.is_spring && !given.is_support);
    if (const auto stiffness = spring_stiffness(run.parameters, given))
      set_springs(stiffness,
                  slave_normals(*spaces.bodies[given.slave.body],
                                coupling.interface->slave()),
                  coupling);
  }

  void
  SceneCouplings::find_pairs()
  {
    auto          stage = run.log.stage(run.timers, "interface_search");
    std::uint64_t faces = 0;
    std::string   divided;
    for (const InterfaceParameters &given : run.parameters.interfaces)
      {
        const auto slave = faces_of(given, given.slave);
        const auto patches =
          tied_directions(run.parameters, given) == TiedDirections::normal &&
              !given.direction ?
            smooth_patches(*spaces.bodies[given.slave.body], slave) :
            std::vector<std::vector<BoundaryFace>>{slave};
        for (unsigned int k = 0; k < patches.size(); ++k)
          {
            interfaces.push_back(given);
            couplings.push_back(make_coupling(given,
                                              patches.size() > 1 ?
                                                patch_name(given, k) :
                                                given.name,
                                              patches[k]));
            faces += Utilities::MPI::sum(
              couplings.back().interface->slave().faces.size(), run.comm);
          }
        if (patches.size() > 1)
          divided += ", " + given.name + " in " +
                     std::to_string(patches.size()) +
                     " smooth patches of the slave";
      }
    stage.details(std::to_string(faces) + " slave faces" + divided);
  }

  void
  SceneCouplings::check_overlap(const unsigned int i) const
  {
    const InterfaceReport     &report = couplings[i].interface->report();
    const InterfaceParameters &given  = interfaces[i];
    const std::string         &name   = couplings[i].interface->name();
    if (report.pairs == 0)
      throw InputError(
        "Interface " + given.name + ": the surfaces " +
        side_text(run.parameters, given.slave) + " and " +
        side_text(run.parameters, given.master) +
        " do not meet: no pair of faces overlaps within the search distance of " +
        RunLog::number(given.search_distance.by_size) +
        " face sizes. Check positions, names and Search distance");
    if (report.failed_pairs > 0)
      run.log.warning("interface " + name + ": the projection of " +
                      std::to_string(report.failed_pairs) +
                      " pairs of faces did not converge");
    if (report.covered_area < 0.999 * report.slave_area)
      {
        std::ostringstream text;
        text << "interface " << name << ": only "
             << RunLog::number(100. * report.covered_area / report.slave_area)
             << " % of the slave surface has a partner; worst is the face at "
             << report.worst_face_centre << " ("
             << RunLog::number(100. * report.worst_face_error) << " % off)";
        run.log.warning(text.str());
      }
  }

  void
  SceneCouplings::drop_patches_apart()
  {
    for (unsigned int i = couplings.size(); i-- > 0;)
      {
        const auto same_interface = [&](const InterfaceParameters &other) {
          return other.name == interfaces[i].name;
        };
        if (couplings[i].interface->report().pairs > 0 ||
            std::count_if(interfaces.begin(),
                          interfaces.end(),
                          same_interface) == 1)
          continue;
        run.log.warning("interface " + couplings[i].interface->name() +
                        ": the surfaces do not meet; nothing is tied");
        couplings.erase(couplings.begin() + i);
        interfaces.erase(interfaces.begin() + i);
      }
  }

  void
  SceneCouplings::couple()
  {
    find_pairs();
    const auto  total    = run.timers.scope("coupling");
    double      clipping = 0.;
    std::string balance;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      integrate(interfaces[i], couplings[i]);
    drop_patches_apart();
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        const InterfaceReport &report = couplings[i].interface->report();
        clipping += report.clipping_seconds;
        if (const unsigned int n_ranks =
              Utilities::MPI::n_mpi_processes(run.comm);
            n_ranks > 1)
          balance +=
            (i ? ", " : "") + std::to_string(report.largest_integration_cells) +
            " cells on the busiest rank, " +
            RunLog::number(double(report.integration_cells) / n_ranks) +
            " on average";
        if (report.coinciding_faces > 0)
          balance += (balance.empty() ? "" : ", ") +
                     std::to_string(report.coinciding_faces) + " of " +
                     std::to_string(report.slave_faces) +
                     " faces coincide with a partner";
        check_overlap(i);
      }
    clipping = Utilities::MPI::max(clipping, run.comm);
    if (clipping == 0.)
      return; // all faces coincide
    run.timers.add("interface_clipping", clipping);
    run.timers.add("coupling", -clipping);
    run.log.stage_line("interface_clipping", clipping, balance);
  }

  InterfaceSummary
  SceneCouplings::summary(const unsigned int i) const
  {
    const InterfaceReport &report = couplings[i].interface->report();
    const TransferErrors   errors =
      transfer_errors(couplings[i], owned, run.comm);
    InterfaceSummary result;
    result.name                      = couplings[i].interface->name();
    result.slave_faces               = report.slave_faces;
    result.master_faces              = report.master_faces;
    result.candidate_pairs           = report.candidate_pairs;
    result.pairs                     = report.pairs;
    result.integration_cells         = report.integration_cells;
    result.quadrature_points         = report.quadrature_points;
    result.slave_area                = report.slave_area;
    result.covered_area              = report.covered_area;
    result.worst_face_coverage_error = report.worst_face_error;
    result.partition_of_unity_error  = errors.partition_of_unity;
    result.linear_completeness_error = errors.linear_completeness;
    return result;
  }

  std::vector<BalanceSummary>
  SceneCouplings::balance() const
  {
    std::vector<BalanceSummary> result;
    for (const Coupling &coupling : couplings)
      {
        const InterfaceReport &report = coupling.interface->report();
        result.push_back({coupling.interface->name(),
                          report.largest_integration_cells,
                          double(report.integration_cells) /
                            Utilities::MPI::n_mpi_processes(run.comm)});
      }
    return result;
  }
} // namespace mortise
