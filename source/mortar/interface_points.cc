#include <mortise/mortar/interface_points.h>

namespace mortise
{
  using namespace dealii;

  InterfacePoints::InterfacePoints(const Coupling          &coupling,
                                   const TraceDisplacement &displacement,
                                   const Offset            &offset,
                                   const MPI_Comm           comm)
    : interface(*coupling.interface)
    , placement(coupling.placement)
    , offset(offset)
  {
    const IndexSet owned    = displacement.free.locally_owned_elements();
    IndexSet       relevant = owned;
    for (const auto *traces :
         {&interface.slave().traces, &interface.master_traces()})
      for (const FaceTrace &trace : *traces)
        {
          relevant.add_indices(trace.column.begin(), trace.column.end());
          for (const auto dof : trace.prescribed)
            if (dof != numbers::invalid_dof_index)
              relevant.add_index(dof);
        }
    relevant.compress();
    free.reinit(owned, relevant, comm);
    free = displacement.free;
    free.update_ghost_values();
    prescribed.reinit(owned, relevant, comm);
    prescribed = displacement.prescribed;
    prescribed.update_ghost_values();
    for (const FaceTrace &trace : interface.master_traces())
      masters.push_back(coefficients(trace));
  }

  void
  InterfacePoints::reinit(const unsigned int s)
  {
    slave    = s;
    of_slave = coefficients(interface.slave().traces[s]);
  }

  InterfacePoint
  InterfacePoints::operator()(const unsigned int       m,
                              const IntegrationPoints &points,
                              const unsigned int       q)
  {
    const Point<2> xi(points.slave_xi[0][q], points.slave_xi[1][q]),
      eta(points.master_eta[0][q], points.master_eta[1][q]);
    InterfacePoint result;
    result.position = points.place(q);
    for (unsigned int c = 0; c < dim; ++c)
      {
        result.mesh_gap[c] = points.master_x[c][q] - points.slave_x[c][q];
      }
    result.normal = face_normal(interface.slave().faces[slave], xi);
    if (interface.slave().undeformed.empty())
      result.jump =
        placement.rotation *
          value(interface.master_traces()[m].basis(), masters[m], eta) +
        offset.jump -
        value(interface.slave().traces[slave].basis(), of_slave, xi);
    result.offset = offset.gap ? offset.gap(result.position) : 0.;
    return result;
  }

  InterfacePoints::Coefficients
  InterfacePoints::coefficients(const FaceTrace &trace) const
  {
    const unsigned int n = trace.n_functions();
    Coefficients       result;
    for (unsigned int r = 0; r < dim * n; ++r)
      {
        double value = 0.;
        if (trace.prescribed[r] != numbers::invalid_dof_index)
          value = prescribed(trace.prescribed[r]);
        for (unsigned int e = trace.begin[r]; e < trace.begin[r + 1]; ++e)
          value += trace.weight[e] * free(trace.column[e]);
        result[r / n].push_back(value);
      }
    return result;
  }

  Tensor<1, dim>
  InterfacePoints::value(const TraceBasis   &basis,
                         const Coefficients &coefficients,
                         const Point<2>     &xi)
  {
    values.resize(basis.size());
    basis.evaluate(xi[0], xi[1], values.data());
    Tensor<1, dim> u;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int k = 0; k < values.size(); ++k)
        u[c] += values[k] * coefficients[c][k];
    return u;
  }
} // namespace mortise
