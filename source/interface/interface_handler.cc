#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mortise/interface/interface_handler.h>
#include <mortise/interface/search.h>

#include <chrono>
#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  InterfaceHandler::InterfaceHandler(const std::string      &name,
                                     BodySurface             slave,
                                     BodySurface             master,
                                     const InterfaceOptions &options,
                                     const MPI_Comm          comm)
    : interface_name(name)
    , slave_surface(std::move(slave))
    , master_surface(std::move(master))
    , options(options)
    , comm(comm)
    , candidates(slave_surface.faces.size())
    , covered_fraction(slave_surface.faces.size(), 0.)
  {
    near_masters = exchange_near_faces(slave_surface.faces,
                                       master_surface.faces,
                                       options.distance,
                                       comm);
    for (SurfaceFace &face : near_masters)
      {
        near_traces.push_back(
          Utilities::unpack<FaceTrace>(face.payload, false));
        face.payload.clear();
      }
    for (SurfaceFace &face : slave_surface.faces)
      face.payload.clear();

    const FaceTree tree(near_masters, options.distance);
    for (unsigned int s = 0; s < slave_surface.faces.size(); ++s)
      tree.candidates(slave_surface.faces[s], candidates[s]);
    if (options.slave_boundary && may_see_through())
      visibility = std::make_unique<Visibility>(
        exchange_near_faces(slave_surface.faces,
                            options.slave_boundary(),
                            options.distance,
                            comm),
        exchange_near_faces(slave_surface.faces,
                            options.master_boundary(),
                            options.distance,
                            comm));
  }

  namespace
  {
    /// Of the depth of the cells behind both faces: no body ends within that.
    constexpr double safe_distance = 0.25;
  } // namespace

  namespace
  {
    /// Of a pair of displaced faces, beside that of the slave's: less is
    /// rounding.
    constexpr double least_area = 1e-12;
  } // namespace

  bool
  InterfaceHandler::may_see_through() const
  {
    unsigned int found = 0;
    for (unsigned int s = 0; s < slave_surface.faces.size(); ++s)
      for (const unsigned int m : candidates[s])
        {
          const FaceFrame &slave  = slave_surface.faces[s].frame;
          const FaceFrame &master = near_masters[m].frame;
          const double     depth =
            std::min(slave_surface.traces[s].depth, near_traces[m].depth);
          if (std::fabs((master.center - slave.center) * slave.normal) >
              safe_distance * depth)
            found = 1;
        }
    return Utilities::MPI::max(found, comm) == 1;
  }

  void
  InterfaceHandler::drop_hidden(const unsigned int s,
                                const unsigned int m,
                                PairResult        &pair,
                                IntegrationPoints &points) const
  {
    const double safe = safe_distance * std::min(slave_surface.traces[s].depth,
                                                 near_traces[m].depth);
    if (!visibility || pair.max_gap <= safe)
      return;
    const std::vector<bool> hidden = visibility->hidden(
      slave_surface.faces[s].id, near_masters[m].id, safe, points);
    unsigned int n = 0;
    pair.area = pair.max_gap = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
      if (!hidden[q])
        {
          pair.area += points.weight[q];
          pair.max_gap = std::max(pair.max_gap, std::fabs(points.gap[q]));
          points.move(q, n++);
        }
    points.resize(n);
    if (n == 0)
      pair.status = PairStatus::hidden;
  }

  void
  InterfaceHandler::refer_to_undeformed(const unsigned int s,
                                        PairResult        &pair,
                                        IntegrationPoints &points) const
  {
    if (slave_surface.undeformed.empty() || pair.status != PairStatus::accepted)
      return;
    points.refer_to(slave_surface.undeformed[s], slave_surface.faces[s]);
    pair.area = std::accumulate(points.weight.begin(), points.weight.end(), 0.);
  }

  bool
  InterfaceHandler::visit_coinciding(const unsigned int s,
                                     const Visitor     &visitor,
                                     PairIntegrator    &integrator,
                                     IntegrationPoints &points,
                                     Coverage          &coverage) const
  {
    for (const unsigned int m : candidates[s])
      if (auto pair =
            integrator.integrate_coinciding(slave_surface.faces[s],
                                            near_masters[m],
                                            slave_surface.traces[s].degree,
                                            near_traces[m].degree,
                                            points))
        {
          refer_to_undeformed(s, *pair, points);
          coverage.add(*pair, points);
          coverage.n_candidates = candidates[s].size();
          visitor(s, m, points);
          return true;
        }
    return false;
  }

  void
  InterfaceHandler::integrate_pairs(const Visitor &visitor)
  {
    Pass own         = clip(visitor, products());
    totals           = report_of(own);
    covered_fraction = std::move(own.covered);
  }

  InterfaceHandler::Pass
  InterfaceHandler::clip(const Visitor &visitor,
                         const Products products,
                         const Choice  &choice) const
  {
    using Clock = std::chrono::steady_clock;
    PairIntegrator    integrator(options.distance);
    IntegrationPoints points;
    integrator.set_points_per_direction(
      options.points_per_direction.value_or(0));
    integrator.set_products(products);

    Pass            pass;
    Clock::duration clipping(0);
    for (unsigned int s = 0; s < slave_surface.faces.size(); ++s)
      {
        if (choice && !choice(s))
          continue;
        auto before = Clock::now();
        integrator.reinit(slave_surface.faces[s]);
        Coverage face;
        face.slave_area = slave_surface.undeformed.empty() ?
                            integrator.slave_area() :
                            face_area(slave_surface.undeformed[s]);
        // a face with the same points is the only partner
        if (visit_coinciding(s, visitor, integrator, points, face))
          ++pass.n_coinciding;
        else
          {
            clipping += Clock::now() - before;
            for (const unsigned int m : candidates[s])
              {
                before = Clock::now();
                PairResult pair =
                  integrator.integrate(near_masters[m],
                                       slave_surface.traces[s].degree,
                                       near_traces[m].degree,
                                       points);
                if (pair.status == PairStatus::accepted)
                  drop_hidden(s, m, pair, points);
                refer_to_undeformed(s, pair, points);
                if (pair.status == PairStatus::accepted &&
                    !slave_surface.undeformed.empty() &&
                    !(pair.area > least_area * face.slave_area))
                  pair.status = PairStatus::no_overlap;
                clipping += Clock::now() - before;
                face.add(pair, points);
                if (pair.status == PairStatus::accepted)
                  visitor(s, m, points);
              }
          }
        const double covered = face.covered_area / face.slave_area;
        pass.covered.push_back(covered);
        if (std::fabs(1. - covered) > pass.worst_error)
          {
            pass.worst_error  = std::fabs(1. - covered);
            pass.worst_centre = slave_surface.faces[s].frame.center;
          }
        pass.largest_coverage = std::max(pass.largest_coverage, covered);
        pass.sagitta +=
          face.covered_area * mortise::sagitta(slave_surface.faces[s]);
        pass.sum.add(face);
      }
    pass.clipping_seconds = std::chrono::duration<double>(clipping).count();
    return pass;
  }

  InterfaceReport
  InterfaceHandler::report_of(const Pass &own) const
  {
    const Coverage &local = own.sum;
    InterfaceReport totals;
    totals.largest_coverage = Utilities::MPI::max(own.largest_coverage, comm);
    totals.sagitta_mean     = Utilities::MPI::sum(own.sagitta, comm);
    totals.clipping_seconds = own.clipping_seconds;
    totals.coinciding_faces = Utilities::MPI::sum(own.n_coinciding, comm);
    const auto total        = [&](const std::uint64_t n) {
      return Utilities::MPI::sum(n, comm);
    };
    totals.slave_faces       = total(slave_surface.faces.size());
    totals.master_faces      = total(master_surface.faces.size());
    totals.candidate_pairs   = total(local.n_candidates);
    totals.pairs             = total(local.n_pairs);
    totals.integration_cells = total(local.n_cells);
    totals.largest_integration_cells =
      Utilities::MPI::max(std::uint64_t(local.n_cells), comm);
    totals.quadrature_points = total(local.n_points);
    totals.failed_pairs      = total(local.n_failures);
    totals.slave_area        = Utilities::MPI::sum(local.slave_area, comm);
    totals.covered_area      = Utilities::MPI::sum(local.covered_area, comm);
    totals.worst_face_error  = Utilities::MPI::max(own.worst_error, comm);
    totals.distance_max      = Utilities::MPI::max(local.max_gap, comm);
    totals.gap_mean          = Utilities::MPI::sum(local.gap_sum, comm);
    totals.distance_mean     = Utilities::MPI::sum(local.distance_sum, comm);
    if (totals.covered_area > 0.)
      for (double *mean :
           {&totals.gap_mean, &totals.distance_mean, &totals.sagitta_mean})
        *mean /= totals.covered_area;

    // several faces may be equally bad: name the one of the lowest rank
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int me       = Utilities::MPI::this_mpi_process(comm);
    const unsigned int reporter = Utilities::MPI::min(
      own.worst_error == totals.worst_face_error ? me : n_ranks, comm);
    totals.worst_face_centre =
      Utilities::MPI::broadcast(comm,
                                own.worst_centre,
                                std::min(reporter, n_ranks - 1));
    return totals;
  }
} // namespace mortise
