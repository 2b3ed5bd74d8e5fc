#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <mortise/mortar/interface_evaluation.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of displacements with wave number @p k on a layer of this @p depth, free on its other side, by
    /// that of a half-space: it bends.
    double
    part_of_half_space(const double k, const double depth)
    {
      return std::min(1., std::pow(k * depth, 3) / 6.);
    }

    /// k / (2 (1/E_1 + 1/E_2)), see evaluate_interface().
    double
    stiffness_of_sides(const SurfaceFace &face,
                       const FaceTrace   &slave,
                       const FaceTrace   &master,
                       const bool         is_contact)
    {
      const auto  &tangent = face.frame.tangent;
      const double h =
        std::sqrt(cross_product_3d(tangent[0], tangent[1]).norm());
      const double k         = numbers::PI * slave.degree / h;
      double       gives_way = 0.;
      for (const FaceTrace *side : {&slave, &master})
        gives_way +=
          1. / (side->modulus *
                (is_contact ? 1. : part_of_half_space(k, side->depth)));
      return k / (2. * gives_way);
    }

    /// Active part of the area of a face.
    struct ActiveArea
    {
      std::uint64_t face = 0;
      double        area = 0., sticking = 0., all = 0.;

      void
      add(const double weight, const bool is_active, const bool sticks)
      {
        all += weight;
        area += is_active ? weight : 0.;
        sticking += is_active && sticks ? weight : 0.;
      }

      /// Of the contact, or of its part that sticks.
      bool
      at_edge() const
      {
        constexpr double noticeable = 1e-3;
        const auto       is_part = [](const double part, const double whole) {
          return part > noticeable * whole && part < (1. - noticeable) * whole;
        };
        return is_part(area, all) || is_part(sticking, area);
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &face &area &sticking &all;
      }
    };

    /// By owned face of the master, from what each rank has @p seen.
    std::vector<bool>
    masters_at_edge(const InterfaceHandler        &interface,
                    const std::vector<ActiveArea> &seen,
                    const MPI_Comm                 comm)
    {
      std::map<unsigned int, std::vector<ActiveArea>> for_owners;
      for (unsigned int m = 0; m < seen.size(); ++m)
        if (seen[m].all > 0.)
          for_owners[interface.master_faces()[m].owner].push_back(seen[m]);
      std::map<std::uint64_t, ActiveArea> sums;
      for (const auto &from : Utilities::MPI::some_to_some(comm, for_owners))
        for (const ActiveArea &part : from.second)
          {
            sums[part.face].area += part.area;
            sums[part.face].sticking += part.sticking;
            sums[part.face].all += part.all;
          }
      std::vector<bool> result;
      for (const SurfaceFace &face : interface.master().faces)
        result.push_back(sums[face.id].at_edge());
      return result;
    }

    /// From coefficients on a face with this @p trace.
    Tensor<1, dim>
    traction_at(const Point<2>            &xi,
                const FaceTrace           &trace,
                const std::vector<double> &coefficients)
    {
      const unsigned int  n = trace.n_functions();
      std::vector<double> values(n);
      trace.basis().evaluate(xi[0], xi[1], values.data());
      Tensor<1, dim> traction;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int k = 0; k < n; ++k)
          traction[d] += values[k] * coefficients[d * n + k];
      return traction;
    }

    /// What this rank has found for masters goes to those who own them.
    TractionsOnFaces
    tractions_on_master(const InterfaceHandler &interface,
                        const std::vector<std::vector<TractionAtPoint>> &found,
                        const MPI_Comm                                   comm)
    {
      using Found = std::pair<std::uint64_t, std::vector<TractionAtPoint>>;
      std::map<unsigned int, std::vector<Found>> for_owners;
      for (unsigned int m = 0; m < found.size(); ++m)
        if (!found[m].empty())
          for_owners[interface.master_faces()[m].owner].emplace_back(
            interface.master_faces()[m].id, found[m]);
      std::map<std::uint64_t, std::vector<TractionAtPoint>> of_faces;
      for (const auto &from : Utilities::MPI::some_to_some(comm, for_owners))
        for (const auto &[face, points] : from.second)
          of_faces[face].insert(of_faces[face].end(),
                                points.begin(),
                                points.end());
      TractionsOnFaces   result;
      const BodySurface &master = interface.master();
      for (unsigned int k = 0; k < master.faces.size(); ++k)
        if (const auto points = of_faces.find(master.faces[k].id);
            points != of_faces.end())
          result.push_back(
            {master.cells[k], master.face_numbers[k], points->second});
      return result;
    }
  } // namespace

  InterfaceEvaluation
  evaluate_interface(const Coupling                         &coupling,
                     const TraceDisplacement                &displacement,
                     const std::vector<std::vector<double>> &tractions,
                     const Offset                           &offset,
                     const BoundOfFriction                  &friction,
                     const MPI_Comm                          comm)
  {
    const InterfaceHandler &interface = *coupling.interface;
    // the master where it is
    const Tensor<2, dim> back = transpose(coupling.placement.rotation);
    InterfacePoints      point_at(coupling, displacement, offset, comm);
    InterfaceEvaluation  result;
    result.energies.resize(interface.slave().faces.size(), 0.);
    std::vector<ActiveArea> of_slaves(interface.slave().faces.size()),
      of_masters(interface.master_faces().size());
    std::vector<std::vector<TractionAtPoint>> on_slaves(of_slaves.size()),
      on_masters(of_masters.size());
    for (unsigned int m = 0; m < of_masters.size(); ++m)
      of_masters[m].face = interface.master_faces()[m].id;
    const auto is_known_on_master = [&](const std::array<bool, dim> &on_slave,
                                        const unsigned int           c) {
      for (unsigned int d = 0; d < dim; ++d)
        if (!on_slave[d] && std::fabs(back[c][d]) > 1e-12)
          return false;
      return true;
    };
    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      const SurfaceFace &face  = interface.slave().faces[s];
      const FaceTrace   &slave = interface.slave().traces[s];
      const double       c     = stiffness_of_sides(face,
                                          slave,
                                          interface.master_traces()[m],
                                          coupling.law.is_one_sided());
      point_at.reinit(s);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Point<2> xi(points.slave_xi[0][q], points.slave_xi[1][q]);
          InterfacePoint point = point_at(m, points, q);
          point.traction       = traction_at(xi, slave, tractions[s]);
          if (friction)
            point.friction = friction(point.position);
          result.penetration =
            std::max(result.penetration, -coupling.law.gap(point));
          if (coupling.law.is_one_sided())
            for (ActiveArea *of : {&of_slaves[s], &of_masters[m]})
              of->add(points.weight[q],
                      coupling.law.is_active(point, c),
                      coupling.law.sticks(point, c));
          result.energies[s] +=
            points.weight[q] * coupling.law.violation(point, c);
          const auto     &rows = coupling.multipliers->rows()[s];
          TractionAtPoint at{xi,
                             point.position,
                             point.normal,
                             -point.traction,
                             points.weight[q],
                             {}};
          for (unsigned int c = 0; c < dim; ++c)
            at.is_known[c] = rows.reproduce_constants[c];
          on_slaves[s].push_back(at);
          for (unsigned int c = 0; c < dim; ++c)
            at.is_known[c] = is_known_on_master(rows.reproduce_constants, c);
          at.xi = Point<2>(points.master_eta[0][q], points.master_eta[1][q]);
          at.x  = coupling.placement.inverse({points.master_x[0][q],
                                              points.master_x[1][q],
                                              points.master_x[2][q]});
          at.normal   = back * face_normal(interface.master_faces()[m], at.xi);
          at.traction = back * point.traction;
          on_masters[m].push_back(at);
        }
    });
    for (unsigned int s = 0; s < on_slaves.size(); ++s)
      if (!on_slaves[s].empty())
        result.on_slave.push_back({interface.slave().cells[s],
                                   interface.slave().face_numbers[s],
                                   on_slaves[s]});
    result.on_master = tractions_on_master(interface, on_masters, comm);
    for (const ActiveArea &face : of_slaves)
      result.slave_at_edge.push_back(face.at_edge());
    result.master_at_edge = masters_at_edge(interface, of_masters, comm);
    result.penetration    = Utilities::MPI::max(result.penetration, comm);
    return result;
  }

  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const Offset            &offset,
                      const MPI_Comm           comm)
  {
    InterfacePoints point_at(coupling, displacement, offset, comm);
    double          largest = 0.;
    coupling.interface->visit_pairs([&](const unsigned int       s,
                                        const unsigned int       m,
                                        const IntegrationPoints &points) {
      point_at.reinit(s);
      for (unsigned int q = 0; q < points.size(); ++q)
        largest = std::max(largest, -coupling.law.gap(point_at(m, points, q)));
    });
    return Utilities::MPI::max(largest, comm);
  }
} // namespace mortise
