// See weak_jump.h.
#include <deal.II/lac/la_parallel_vector.h>

#include <Epetra_CrsMatrix.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/mortar/row_assembler.h>
#include <mortise/operators/levels/weak_jump.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// As in local_coupling.cc.
    constexpr double covered_as_a_whole = 0.999;

    /// The local functions of a face by the nodes that carry them.
    class NodesOfFace
    {
    public:
      explicit NodesOfFace(const FaceNodes &face)
        : begin(face.begin)
        , weight(face.weight)
      {
        if (face.hang())
          for (const unsigned int column : face.column)
            index.push_back(face.nodes[column]);
        else
          {
            index = face.nodes;
            weight.assign(index.size(), 1.);
            for (unsigned int k = 0; k <= index.size(); ++k)
              begin.push_back(k);
          }
      }

      Expansion
      operator()() const
      {
        return {begin, index, weight, 0};
      }

    private:
      std::vector<unsigned int>            begin;
      std::vector<types::global_dof_index> index;
      std::vector<double>                  weight;
    };

    BlockSide
    side(const FaceTrace &trace, const unsigned int number)
    {
      return {trace.shape, trace.degree, trace.nodes[number].degree};
    }

    /// int phi_i phi_j of the nodal functions of the finest level.
    FullMatrix<double>
    nodal_mass(const Coupling &coupling, const unsigned int s)
    {
      const BlockSide own = side(coupling.interface->slave().traces[s], 0);
      return nodal_block(coupling.local[s].mass, own, own);
    }

    /// int phi_i where dual functions exist, else nothing.
    std::vector<double>
    dual_weights(const FullMatrix<double> &mass, const double coverage)
    {
      std::vector<double> weights(mass.m());
      if (!(coverage > covered_as_a_whole))
        return {};
      for (unsigned int i = 0; i < mass.m(); ++i)
        for (unsigned int j = 0; j < mass.n(); ++j)
          weights[i] += mass(i, j);
      const auto [least, largest] =
        std::minmax_element(weights.begin(), weights.end());
      return *least > 1e-3 * *largest ? weights : std::vector<double>();
    }

    /// psi_i = sum_j A_ij phi_j; empty: there are none.
    FullMatrix<double>
    dual_functions(FullMatrix<double> mass, const double coverage)
    {
      const std::vector<double> weights = dual_weights(mass, coverage);
      if (weights.empty())
        return {};
      mass.gauss_jordan();
      for (unsigned int i = 0; i < weights.size(); ++i)
        for (unsigned int j = 0; j < weights.size(); ++j)
          mass(i, j) *= weights[i];
      return mass;
    }

    /// int |psi_i|
    std::vector<double>
    sizes(const Coupling &coupling, const unsigned int s)
    {
      const FullMatrix<double> mass = nodal_mass(coupling, s);
      std::vector<double>      result =
        dual_weights(mass, coupling.interface->coverage()[s]);
      if (!result.empty())
        return result;
      result.resize(mass.m());
      for (unsigned int i = 0; i < mass.m(); ++i)
        for (unsigned int j = 0; j < mass.n(); ++j)
          result[i] += std::fabs(mass(i, j));
      return result;
    }
  } // namespace

  WeakJump::WeakJump(const Coupling    &coupling,
                     const unsigned int number,
                     const IndexSet    &owned_tests,
                     const IndexSet    &owned_nodes,
                     const MPI_Comm     comm)
    : owned_tests(owned_tests)
    , comm(comm)
    , tests(std::make_unique<SparseMatrix>())
  {
    RowAssembler assembler(owned_tests, owned_nodes);
    // visit(rows, columns, block, factor)
    const auto for_each_block = [&](const bool values, const auto &visit) {
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        {
          const LocalCoupling &local = coupling.local[s];
          if (local.partners.empty())
            continue;
          const FaceTrace   &slave = coupling.interface->slave().traces[s];
          const NodesOfFace  rows(slave.nodes[0]);
          FullMatrix<double> to_dual;
          if (values)
            to_dual = dual_functions(nodal_mass(coupling, s),
                                     coupling.interface->coverage()[s]);
          const auto add = [&](const FaceTrace          &trace,
                               const FullMatrix<double> &modal,
                               const double              sign) {
            const NodesOfFace  columns(trace.nodes[number]);
            FullMatrix<double> block(slave.nodes[0].n_functions(),
                                     trace.nodes[number].n_functions());
            if (values)
              block = nodal_block(modal, side(slave, 0), side(trace, number));
            if (to_dual.m() > 0)
              {
                FullMatrix<double> product(block.m(), block.n());
                to_dual.mmult(product, block);
                block = product;
              }
            visit(rows(), columns(), block, sign);
          };
          add(slave, local.mass, 1.);
          for (const auto &partner : local.partners)
            add(coupling.interface->master_traces()[partner.master],
                partner.mixed,
                -1.);
        }
    };
    for_each_block(false,
                   [&](const Expansion          &rows,
                       const Expansion          &columns,
                       const FullMatrix<double> &block,
                       const double) {
                     assembler.record(rows, block.m(), columns, block.n());
                   });
    assembler.allocate();
    for_each_block(true,
                   [&](const Expansion          &rows,
                       const Expansion          &columns,
                       const FullMatrix<double> &block,
                       const double              factor) {
                     assembler.add(rows, columns, block, factor, false);
                   });
    assembler.create(*tests, comm);
  }

  void
  WeakJump::add_nodes(IndexSet &nodes) const
  {
    for_each_test([&](const unsigned int, const std::vector<Entry> &entries) {
      for (const auto &[node, value] : entries)
        nodes.add_index(node);
    });
  }

  void
  WeakJump::for_each_test(
    const std::function<void(unsigned int, const std::vector<Entry> &)> &visit)
    const
  {
    const Epetra_CrsMatrix &rows = tests->trilinos_matrix();
    std::vector<Entry>      entries;
    for (int i = 0; i < rows.NumMyRows(); ++i)
      {
        int     length = 0, *columns = nullptr;
        double *values = nullptr;
        rows.ExtractMyRowView(i, length, values, columns);
        entries.clear();
        double largest = 0.;
        for (int k = 0; k < length; ++k)
          largest = std::max(largest, std::fabs(values[k]));
        for (int k = 0; k < length; ++k)
          if (std::fabs(values[k]) > 1e-14 * largest)
            entries.emplace_back(rows.GCID(columns[k]), values[k]);
        if (!entries.empty())
          visit(i, entries);
      }
  }

  std::vector<double>
  WeakJump::factors(const Coupling                                 &coupling,
                    const std::function<double(unsigned int face)> &gamma) const
  {
    IndexSet relevant(owned_tests.size());
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (!coupling.local[s].partners.empty())
        {
          const auto &nodes =
            coupling.interface->slave().traces[s].nodes[0].nodes;
          relevant.add_indices(nodes.begin(), nodes.end());
        }
    LinearAlgebra::distributed::Vector<double> size(owned_tests,
                                                    relevant,
                                                    comm),
      weighted(size);
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (!coupling.local[s].partners.empty())
        {
          const auto        sizes_here = sizes(coupling, s);
          const NodesOfFace nodes(
            coupling.interface->slave().traces[s].nodes[0]);
          const Expansion rows   = nodes();
          const double    factor = gamma(s);
          for (unsigned int k = 0; k < sizes_here.size(); ++k)
            for (unsigned int e = rows.begin[k]; e < rows.begin[k + 1]; ++e)
              {
                const double part = std::fabs(rows.weight[e]) * sizes_here[k];
                size(rows.index[e]) += part;
                weighted(rows.index[e]) += factor * part;
              }
        }
    size.compress(VectorOperation::add);
    weighted.compress(VectorOperation::add);
    std::vector<double> result(size.locally_owned_size());
    for (unsigned int i = 0; i < result.size(); ++i)
      if (const double w = size.local_element(i); w > 0.)
        result[i] = weighted.local_element(i) / (w * w);
    return result;
  }
} // namespace mortise
