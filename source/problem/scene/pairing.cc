#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/interface/smooth_patches.h>
#include <mortise/mortar/slave_frames.h>
#include <mortise/problem/input/interface_law.h>
#include <mortise/problem/scene/pairing.h>
#include <mortise/problem/scene/scene_data.h>
#include <mortise/problem/support/rigid_motions.h>
#include <mortise/problem/support/side_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  Pairing::Pairing(const RunContext                &run,
                   const SceneSpaces               &spaces,
                   const std::vector<BodySolution> *displaced,
                   const double                     least_search)
    : run(run)
    , spaces(spaces)
    , displaced(displaced)
    , least_search(least_search)
    , owned(0)
  {
    if (run.parameters.interfaces.empty())
      {
        check_rigid_motions(spaces.bodies,
                            spaces.dirichlet,
                            spaces.rigid_parts,
                            {});
        return;
      }
    find_and_integrate();
    auto stage = run.log.stage(run.timers, "coupling");
    choose_multipliers();
    stage.details(std::to_string(owned.size()) + " multipliers");
  }

  bool
  Pairing::is_start() const
  {
    return displaced == nullptr ||
           std::all_of(displaced->begin(),
                       displaced->end(),
                       [](const BodySolution &of_body) {
                         return of_body.displacement.linfty_norm() == 0.;
                       });
  }

  unsigned int
  Pairing::given_slave(const unsigned int i) const
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
  Pairing::faces_of(const InterfaceParameters &given,
                    const SideParameters      &side) const
  {
    return side_faces(spaces.bodies, side, "Interface " + given.name);
  }

  std::string
  Pairing::patch_name(const InterfaceParameters &given,
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
  Pairing::make_coupling(const InterfaceParameters       &given,
                         const std::string               &name,
                         const std::vector<BoundaryFace> &slave) const
  {
    const bool moved        = displaced != nullptr && given.follows_bodies;
    const auto displacement = [&](const SideParameters &side) {
      return moved ? &(*displaced)[side.body].displacement : nullptr;
    };
    const auto surface = [&](const SideParameters            &side,
                             const std::vector<BoundaryFace> &faces) {
      return extract_surface(*spaces.bodies[side.body],
                             faces,
                             spaces.fields.displacement.numbering,
                             spaces.fields.displacement.constraints,
                             spaces.nodal,
                             displacement(side));
    };
    BodySurface slave_surface = surface(given.slave, slave);
    slave_surface.direction   = given.direction;
    BodySurface master_surface =
      given.is_support ? rigid_obstacle(slave_surface) :
                         surface(given.master, faces_of(given, given.master));
    const RigidMotion placement = given.placement();
    if (given.periodic != Periodicity::none)
      place(placement, master_surface.faces);
    if (moved)
      slave_surface.undeformed =
        undeformed_faces(*spaces.bodies[given.slave.body], slave_surface);
    InterfaceOptions options;
    options.distance             = given.search_distance;
    options.points_per_direction = given.quadrature_points;
    const auto boundary          = [&](const SideParameters &side) {
      return [&body = *spaces.bodies[side.body], u = displacement(side)] {
        return whole_boundary(body, u);
      };
    };
    options.slave_boundary  = boundary(given.slave);
    options.master_boundary = boundary(given.master);
    if (given.periodic != Periodicity::none)
      options.master_boundary = [placement, of = options.master_boundary] {
        auto faces = of();
        place(placement, faces);
        return faces;
      };
    Coupling coupling;
    coupling.placement    = placement;
    coupling.is_turned    = given.periodic == Periodicity::rotation;
    coupling.law          = interface_law(run.parameters, given);
    coupling.is_displaced = moved;
    coupling.interface =
      std::make_unique<InterfaceHandler>(name,
                                         std::move(slave_surface),
                                         std::move(master_surface),
                                         options,
                                         run.comm);
    coupling.frames = slave_frames(*spaces.bodies[given.slave.body],
                                   coupling.interface->slave());
    return coupling;
  }

  void
  Pairing::integrate(const InterfaceParameters &given, Coupling &coupling) const
  {
    const InterfaceLaw &law = coupling.law;
    coupling.local =
      integrate_coupling(*coupling.interface,
                         spaces.choice.method != SolverMethod::direct,
                         given.multiplier == "dual" ? MultiplierBasis::dual :
                                                      MultiplierBasis::standard,
                         !law.is_compliant() && !given.is_support &&
                           !coupling.is_turned,
                         law.constrained == ConstrainedDirections::normal ||
                             coupling.is_directed() ?
                           coupling.frames :
                           std::vector<std::vector<Frame>>());
    // the plane of slip
    if (coupling.has_following_friction())
      coupling.frames =
        slave_frames(*spaces.bodies[given.slave.body],
                     coupling.interface->slave(),
                     normals_of_master(*coupling.interface, coupling.local));
    set_springs(coupling);
  }

  std::vector<std::vector<BoundaryFace>>
  Pairing::find_pairs()
  {
    std::vector<std::vector<BoundaryFace>> slaves;
    auto          stage = run.log.stage(run.timers, "interface_search");
    std::uint64_t faces = 0;
    std::string   divided;
    for (InterfaceParameters given : run.parameters.interfaces)
      {
        const auto &least = spaces.cycle.least_search;
        if (const auto length = least.find(given.name); length != least.end())
          given.search_distance.least = length->second;
        if (given.follows_bodies)
          given.search_distance.least =
            std::max(given.search_distance.least, least_search);
        const auto slave = faces_of(given, given.slave);
        // tractions jump at edges
        auto patches =
          given.direction ?
            std::vector<std::vector<BoundaryFace>>{slave} :
            smooth_patches(*spaces.bodies[given.slave.body], slave);
        for (unsigned int k = 0; k < patches.size(); ++k)
          {
            interfaces.push_back(given);
            couplings.push_back(make_coupling(given,
                                              patches.size() > 1 ?
                                                patch_name(given, k) :
                                                given.name,
                                              patches[k]));
            couplings.back().number = couplings.size() - 1;
            faces += Utilities::MPI::sum(
              couplings.back().interface->slave().faces.size(), run.comm);
            slaves.push_back(std::move(patches[k]));
          }
        if (patches.size() > 1)
          divided += ", " + given.name + " in " +
                     std::to_string(patches.size()) +
                     " smooth patches of the slave";
      }
    stage.details(std::to_string(faces) + " slave faces" + divided);
    return slaves;
  }

  void
  Pairing::find_overlap(const unsigned int               i,
                        const std::vector<BoundaryFace> &slave)
  {
    const Coupling        &found = couplings[i];
    const InterfaceReport &known = found.interface->report();
    if (known.covered_area > 0.99 * known.slave_area)
      return;
    InterfaceParameters given = interfaces[i];
    const auto         &faces = found.interface->slave().faces;
    double              lower[dim], upper[dim]; // of all slave faces
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::numeric_limits<double>::max();
        upper[d] = std::numeric_limits<double>::lowest();
        for (const SurfaceFace &face : faces)
          {
            lower[d] = std::min(lower[d], face.frame.center[d] - face.size);
            upper[d] = std::max(upper[d], face.frame.center[d] + face.size);
          }
        lower[d] = Utilities::MPI::min(lower[d], run.comm);
        upper[d] = Utilities::MPI::max(upper[d], run.comm);
        given.search_distance.least =
          std::max(given.search_distance.least, upper[d] - lower[d]);
      }
    Coupling other = make_coupling(given, found.interface->name(), slave);
    integrate(given, other);
    const InterfaceReport &report = other.interface->report();
    if (!(report.covered_area > 1.01 * known.covered_area &&
          report.gap_mean < 0.))
      return;
    run.log.warning("interface " + found.interface->name() +
                    ": the bodies overlap by " +
                    RunLog::number(-report.gap_mean) +
                    " in the mean, more than the Search distance, which is "
                    "taken to be larger at the start");
    other.number = found.number;
    couplings[i] = std::move(other);
  }

  namespace
  {
    /// More than the coverage of mismatched coarse curved faces, less than that
    /// of a second layer.
    constexpr double most_coverage = 1.1;
  } // namespace

  void
  Pairing::warn_of_mesh_gap(const unsigned int i) const
  {
    const InterfaceReport     &report = couplings[i].interface->report();
    const InterfaceParameters &given  = interfaces[i];
    const std::string          mean   = RunLog::number(report.gap_mean),
                      largest         = RunLog::number(report.distance_max),
                      off_by          = RunLog::number(report.sagitta_mean);
    const std::string text =
      "interface " + couplings[i].interface->name() + ": the meshes are " +
      RunLog::number(report.distance_mean) + " apart in the mean, " + largest +
      " at most (with signs, " + mean + " in the mean; negative: they overlap)";
    // straight faces of both sides on one round surface
    const double facets = 2. * report.sagitta_mean;
    const double size =
      std::sqrt(report.slave_area / std::max<double>(1., report.slave_faces));
    const bool is_rounding = report.distance_max < 1e-6 * size;
    if (is_rounding)
      return;
    if (!couplings[i].law.is_one_sided() && !couplings[i].law.has_mesh_gap)
      {
        if (report.distance_mean > facets + 1e-3 * size)
          run.log.warning(
            text + ", which Law = " + name_of(given.law) +
            " ignores, so that rotations of the bodies cause spurious moments. Allowed: meshes that touch; for an "
            "interference that is drawn Law = contact, or Offset in its place");
        return;
      }
    if (couplings[i].law.has_mesh_gap &&
        report.sagitta_mean > 0.1 * std::fabs(report.gap_mean))
      run.log.warning(
        text + "; straight faces on a round surface are " + off_by +
        " off by themselves, which is not small beside that. Allowed: finer meshes, Mesh/Curved "
        "boundaries, or Mesh gap = ignored with an Offset");
  }

  void
  Pairing::check_overlap(const unsigned int i) const
  {
    const InterfaceReport     &report = couplings[i].interface->report();
    const InterfaceParameters &given  = interfaces[i];
    const std::string         &name   = couplings[i].interface->name();
    if (report.pairs == 0 && !given.follows_bodies)
      throw InputError(
        "Interface " + given.name + ": the surfaces " +
        side_text(run.parameters, given.slave) + " and " +
        side_text(run.parameters, given.master) +
        " do not meet: no pair of faces overlaps within the search distance of " +
        (given.search_distance.length > 0. ?
           RunLog::number(given.search_distance.length) :
           RunLog::number(given.search_distance.by_size) + " face sizes") +
        (given.periodic == Periodicity::none ?
           ", or all are hidden by a body. Check positions, names and Search distance" :
           " after the master is moved. Check that Translation or Rotation leads from the master to the slave, and not back"));
    if (report.failed_pairs > 0)
      run.log.warning("interface " + name + ": the projection of " +
                      std::to_string(report.failed_pairs) +
                      " pairs of faces did not converge");
    if (report.largest_coverage > most_coverage)
      {
        std::ostringstream text;
        text
          << "Interface " << given.name << ": a face of the slave has "
          << RunLog::number(report.largest_coverage)
          << " times its area in partners; worst is the face at "
          << report.worst_face_centre << ". Parts of "
          << side_text(run.parameters, given.master)
          << " lie in several layers before it; allowed: one layer. Make "
             "those that do not belong to the interface boundaries of their own";
        throw InputError(text.str());
      }
    if (!displaced && report.pairs > 0)
      warn_of_mesh_gap(i);
    if (report.covered_area < 0.999 * report.slave_area &&
        !given.follows_bodies)
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
  Pairing::drop_patches_apart()
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
        run.log.line("  interface " + couplings[i].interface->name() +
                     ": this smooth patch of the slave meets no master");
        couplings.erase(couplings.begin() + i);
        interfaces.erase(interfaces.begin() + i);
      }
  }

  void
  Pairing::find_and_integrate()
  {
    const auto  slaves   = find_pairs();
    const auto  total    = run.timers.scope("coupling");
    double      clipping = 0.;
    std::string balance;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      integrate(interfaces[i], couplings[i]);
    const bool starts = is_start();
    for (unsigned int i = 0; i < couplings.size() && starts; ++i)
      if (interfaces[i].follows_bodies)
        find_overlap(i, slaves[i]);
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
  Pairing::summary(const unsigned int i) const
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
    result.gap_mean                  = report.gap_mean;
    result.distance_mean             = report.distance_mean;
    result.distance_max              = report.distance_max;
    result.sagitta_mean              = report.sagitta_mean;
    result.worst_face_coverage_error = report.worst_face_error;
    result.partition_of_unity_error  = errors.partition_of_unity;
    result.linear_completeness_error = errors.linear_completeness;
    return result;
  }

  std::vector<BalanceSummary>
  Pairing::balance() const
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
