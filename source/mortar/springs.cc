// Interfaces that give way, assemble_compliance().
#include <mortise/mortar/coupled_faces.h>
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/mortar/row_assembler.h>

#include <cmath>

#include "multiplier_sums.h"
#include "projected_products.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of the compliance, along the normal and across it.
    struct Roots
    {
      explicit Roots(const InterfaceStiffness &spring)
        : along(1. / std::sqrt(spring.normal))
        , across(spring.tangential > 0. ? 1. / std::sqrt(spring.tangential) :
                                          0.)
      {}

      double along, across;
    };

    /// The root of K^{-1}.
    Tensor<2, dim>
    root_of_compliance(const double          along,
                       const double          across,
                       const Tensor<1, dim> &normal)
    {
      Tensor<2, dim> root = (along - across) * outer_product(normal, normal);
      for (unsigned int c = 0; c < dim; ++c)
        root[c][c] += across;
      return root;
    }

    /// The compliance of one slave face, by pairs of nodes that it couples.
    class FaceCompliance
    {
    public:
      FaceCompliance(const Coupling &coupling, const unsigned int s)
        : local(coupling.local[s])
        , frames(coupling.frames[s])
        , rows(coupling.multipliers->rows()[s])
        , constrained(coupling.law.constrained)
      {
        std::vector<Roots> at_nodes(local.springs.begin(), local.springs.end());
        for (unsigned int k = 0; k < at_nodes.size(); ++k)
          roots.push_back(root_of_compliance(at_nodes[k].along,
                                             at_nodes[k].across,
                                             frames[k][0]));
        if (!local.is_dual() && constrained == ConstrainedDirections::all &&
            are_unlike(frames))
          set_turning(coupling.interface->slave(), s, at_nodes);
      }

      /// visit(row expansion, column expansion, block)
      template <typename Visit>
      void
      for_each_block(const Visit &visit) const
      {
        const unsigned int n = rows.n_nodes();
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            if (i == j || !local.is_dual())
              visit(expansion(i), expansion(j), block(i, j));
      }

    private:
      /// The rows of a node.
      ExpansionList
      expansion(const unsigned int k) const
      {
        std::vector<unsigned int> of_node;
        for (unsigned int r = k; r + 1 < rows.begin.size(); r += rows.n_nodes())
          of_node.push_back(r);
        return ExpansionList({rows.begin, rows.index, rows.weight, 0}, of_node);
      }

      /// Standard multipliers of all directions where the normal turns: the
      /// root varies along the face with it, as LocalCoupling::along_normals
      /// do, since a root that each node has for its own holds tangential
      /// openings where springs are far stiffer along the normal.
      void
      set_turning(const BodySurface        &slave,
                  const unsigned int        s,
                  const std::vector<Roots> &at_nodes)
      {
        const unsigned int n        = at_nodes.size();
        const auto         products = projected_products<Tensor<2, dim>>(
          slave.faces[s],
          slave.traces[s],
          [&](const dealii::Vector<double> &phi) {
            double along = 0., across = 0.;
            for (unsigned int k = 0; k < n; ++k)
              {
                along += phi(k) * at_nodes[k].along;
                across += phi(k) * at_nodes[k].across;
              }
            const auto normal = interpolated(frames, phi);
            return root_of_compliance(along, across, normal / normal.norm());
          });
        // the product of all with their masses, a side at a time
        std::vector<Tensor<2, dim>> weighted(n * n);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              weighted[j * n + a] +=
                multiplier_product(local, a, b) * products[j * n + b];
        turning.resize(n * n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int a = 0; a < n; ++a)
              turning[i * n + j] +=
                products[i * n + a] * weighted[j * n + a]; // symmetric roots
      }

      FullMatrix<double>
      block(const unsigned int i, const unsigned int j) const
      {
        const Tensor<2, dim> product =
          turning.empty() ?
            (local.is_dual() ? local.weights[i] :
                               multiplier_product(local, i, j)) *
              roots[i] * roots[j] :
            turning[i * roots.size() + j];
        if (constrained == ConstrainedDirections::normal)
          {
            FullMatrix<double> along(1, 1);
            along(0, 0) = frames[i][0] * (product * frames[j][0]);
            return along;
          }
        FullMatrix<double> all(dim, dim);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            all(a, b) = product[a][b];
        return all;
      }

      const LocalCoupling                    &local;
      const std::vector<Frame>               &frames;
      const MultiplierSpace::FaceMultipliers &rows;
      const ConstrainedDirections             constrained;
      std::vector<Tensor<2, dim>>             roots; ///< by node
      /// Where the normal turns: int psi_i K^{-1} psi_j at i n + j; else empty.
      std::vector<Tensor<2, dim>> turning;
    };
  } // namespace

  void
  set_springs(Coupling &coupling)
  {
    if (!coupling.law.is_compliant())
      return;
    const BodySurface &slave = coupling.interface->slave();
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (!coupling.local[s].partners.empty())
        for (const Point<2> &xi :
             face_nodes(slave.traces[s].shape, slave.traces[s].degree))
          coupling.local[s].springs.push_back(
            coupling.law.stiffness(face_point(slave.faces[s], xi)));
  }

  SparseMatrix
  assemble_compliance(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition)
  {
    RowAssembler assembler(partition.owned_multiplier,
                           partition.owned_multiplier);
    const auto   for_each_block = [&](const auto &visit) {
      for_each_face(couplings,
                    [&](const Coupling &coupling, const unsigned int s) {
                      if (!coupling.local[s].springs.empty())
                        FaceCompliance(coupling, s).for_each_block(visit);
                    });
    };
    for_each_block([&](const ExpansionList      &row,
                       const ExpansionList      &column,
                       const FullMatrix<double> &block) {
      assembler.record(row(), block.m(), column(), block.n());
    });
    assembler.allocate();
    for_each_block([&](const ExpansionList      &row,
                       const ExpansionList      &column,
                       const FullMatrix<double> &block) {
      assembler.add(row(), column(), block, 1., false);
    });
    return assembler.create(partition.comm);
  }
} // namespace mortise
