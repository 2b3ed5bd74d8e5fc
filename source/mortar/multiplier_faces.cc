#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/elements/cell_face.h>
#include <mortise/mortar/multiplier_faces.h>

#include <cstdint>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr double nothing_below = 1e-6;
    constexpr double sliver_below  = 0.1;
    constexpr double full_above    = 0.9;

    /// What only the owner of a cell knows for sure, by face: 12 bits of rims,
    /// 2 of coverage, 3 of what can follow.
    using FaceBits = std::array<std::uint32_t, 6>;

    class ConstrainedDofs
    {
    public:
      ConstrainedDofs(const Body &body, const std::vector<bool> &owned)
        : body(body)
        , flags(body.dof_handler.locally_owned_dofs(),
                body.relevant_dofs,
                body.triangulation().get_communicator())
      {
        for (unsigned int i = 0; i < owned.size(); ++i)
          flags.local_element(i) = owned[i] ? 1. : 0.;
        flags.update_ghost_values();
      }

      /// A hanging dof is constrained when all that it hangs on is.
      bool
      operator()(const types::global_dof_index dof) const
      {
        if (!body.conformity.is_constrained(dof))
          return flags(dof) > 0.5;
        for (const auto &entry : *body.conformity.get_constraint_entries(dof))
          if (flags(entry.first) < 0.5)
            return false;
        return true;
      }

    private:
      const Body                                &body;
      LinearAlgebra::distributed::Vector<double> flags;
    };

    unsigned int
    rim_bit(const unsigned int c, const unsigned int edge)
    {
      return 4 * c + edge;
    }

    std::uint32_t
    owner_bits(const MultiplierFace  &face,
               const PartnerState    &partner,
               const ConstrainedDofs &constrained)
    {
      const TraceBasis &basis = *face.basis;
      std::uint32_t     bits  = 0;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          {
            bool rim = true;
            for (const unsigned int v : basis.edge_vertices(e))
              rim = rim && constrained(face.dofs[c][basis.vertex_function(v)]);
            for (unsigned int k = 0; k < basis.size() && rim; ++k)
              if (const auto &f = basis.functions[k];
                  f.dimension == 1 && f.entity == e &&
                  f.degree <= face.edge_degree[e])
                rim = constrained(face.dofs[c][k]);
            if (rim)
              bits |= 1u << rim_bit(c, e);
          }
      for (unsigned int c = 0; c < dim; ++c)
        if (partner.has_free_displacement[c])
          bits |= 1u << (14 + c);
      return bits | (static_cast<std::uint32_t>(partner.cover) << 12);
    }

    MultiplierFace
    describe(const Body               &body,
             const Body::CellIterator &cell,
             const unsigned int        f)
    {
      const CellFace on_cell(cell, f);
      MultiplierFace face;
      face.basis = on_cell.basis;
      face.dofs  = face_dofs(cell, f);
      // where degrees meet, one dof carries a mode for all cells around it
      std::vector<types::global_dof_index> masters;
      body.degrees->get_master_dofs(cell, masters);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int k = 0; k < on_cell.indices.size(); ++k)
          {
            const auto master =
              masters[cell->get_fe().component_to_system_index(
                c, on_cell.indices[k])];
            if (master != numbers::invalid_dof_index)
              face.dofs[c][k] = master;
          }
      face.face_degree = body.degrees->quad_degree(cell, f);
      for (unsigned int e = 0; e < face.basis->n_edges(); ++e)
        face.edge_degree[e] = body.degrees->line_degree(cell, on_cell.lines[e]);
      return face;
    }

    void
    apply_bits(const std::uint32_t    bits,
               const Body            &body,
               const ConstrainedDofs &constrained,
               MultiplierFace        &face)
    {
      face.cover = static_cast<FaceCoverage>((bits >> 12) & 3u);
      for (unsigned int c = 0; c < dim; ++c)
        {
          face.has_free_displacement[c] = bits & (1u << (14 + c));
          for (unsigned int e = 0; e < face.basis->n_edges(); ++e)
            face.rim[c][e] = bits & (1u << rim_bit(c, e));
          for (unsigned int v = 0; v < face.basis->n_vertices(); ++v)
            {
              const auto dof = face.dofs[c][face.basis->vertex_function(v)];
              face.constrained_vertex[c][v] =
                body.conformity.is_constrained(dof) || constrained(dof);
            }
        }
    }
  } // namespace

  FaceCoverage
  face_coverage(const double covered, const bool most)
  {
    return covered < nothing_below         ? FaceCoverage::none :
           covered < sliver_below || !most ? FaceCoverage::sliver :
           covered < full_above            ? FaceCoverage::partial :
                                             FaceCoverage::full;
  }

  std::vector<MultiplierFace>
  collect_multiplier_faces(const Body                      &body,
                           const BodySurface               &slave,
                           const std::vector<PartnerState> &partners,
                           const std::vector<bool>         &constrained_owned)
  {
    const ConstrainedDofs      constrained(body, constrained_owned);
    std::map<CellId, FaceBits> bits;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      bits[slave.cells[s]->id()][slave.face_numbers[s]] =
        owner_bits(describe(body, slave.cells[s], slave.face_numbers[s]),
                   partners[s],
                   constrained);

    const auto pack = [&](const Body::CellIterator &cell) {
      const auto found = bits.find(cell->id());
      return found == bits.end() ? FaceBits{} : found->second;
    };
    const auto unpack = [&](const Body::CellIterator &cell,
                            const FaceBits           &received) {
      bits[cell->id()] = received;
    };
    GridTools::exchange_cell_data_to_ghosts<FaceBits>(body.dof_handler,
                                                      pack,
                                                      unpack);

    std::vector<MultiplierFace> faces;
    for (const auto &[cell, f] : slave.known)
      {
        faces.push_back(describe(body, cell, f));
        apply_bits(bits[cell->id()][f], body, constrained, faces.back());
      }
    return faces;
  }
} // namespace mortise
