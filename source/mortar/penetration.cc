// See penetration.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/penetration.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Displacements on faces from the coefficients of all.
    class TraceValues
    {
    public:
      TraceValues(const InterfaceHandler  &interface,
                  const TraceDisplacement &displacement,
                  const MPI_Comm           comm)
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
        prescribed.reinit(owned, relevant, comm);
        prescribed = displacement.prescribed;
      }

      /// Of the functions of a face, by component.
      std::array<std::vector<double>, dim>
      coefficients(const FaceTrace &trace) const
      {
        const unsigned int                   n = trace.n_functions();
        std::array<std::vector<double>, dim> result;
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

    private:
      Vector free, prescribed;
    };

    Tensor<1, dim>
    displacement_at(const TraceBasis                           &basis,
                    const std::array<std::vector<double>, dim> &coefficients,
                    const double                                xi_1,
                    const double                                xi_2,
                    std::vector<double>                        &values)
    {
      values.resize(basis.size());
      basis.evaluate(xi_1, xi_2, values.data());
      Tensor<1, dim> u;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int k = 0; k < values.size(); ++k)
          u[c] += values[k] * coefficients[c][k];
      return u;
    }
  } // namespace

  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const GapOfSurfaces     &gap,
                      const MPI_Comm           comm)
  {
    InterfaceHandler &interface = *coupling.interface;
    const TraceValues traces(interface, displacement, comm);
    std::vector<std::array<std::vector<double>, dim>> masters;
    for (const FaceTrace &trace : interface.master_traces())
      masters.push_back(traces.coefficients(trace));
    double              largest = 0.;
    std::vector<double> values;
    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      const SurfaceFace &face        = interface.slave().faces[s];
      const TraceBasis  &slave_basis = interface.slave().traces[s].basis(),
                       &master_basis = interface.master_traces()[m].basis();
      const auto slave = traces.coefficients(interface.slave().traces[s]);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const Point<2>       xi(points.slave_xi[0][q], points.slave_xi[1][q]);
          const Tensor<1, dim> normal = face_normal(face, xi);
          Point<dim>           position;
          Tensor<1, dim>       between;
          for (unsigned int c = 0; c < dim; ++c)
            {
              position[c] = points.slave_x[c][q];
              if (gap.of_meshes)
                between[c] = points.master_x[c][q] - position[c];
            }
          between += displacement_at(master_basis,
                                     masters[m],
                                     points.master_eta[0][q],
                                     points.master_eta[1][q],
                                     values) -
                     displacement_at(slave_basis, slave, xi[0], xi[1], values);
          const double open =
            normal * between + (gap.offset ? gap.offset(position) : 0.);
          largest = std::max(largest, -open);
        }
    });
    return Utilities::MPI::max(largest, comm);
  }
} // namespace mortise
