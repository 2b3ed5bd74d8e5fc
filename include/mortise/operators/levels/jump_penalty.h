// The jump penalty of interfaces on coarse levels, and products with it.
#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <mortise/base/types.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// J = sum over interfaces of gamma int [[u]].[[v]], gamma ~ E / h of the
  /// softer side, for the nodes of owned slave faces and their partners; of
  /// sliding bodies gamma int [[u.n]] [[v.n]]. K + J, which may be regular
  /// where K is not, serves preconditioning alone.
  struct JumpPenalty
  {
    /// Nodes that couple with the same nodes, as those inside a face do.
    struct Group
    {
      std::vector<unsigned int> rows;    ///< indices of first components
      std::vector<unsigned int> columns; ///< indices of first components
      std::vector<double>       values;  ///< row by row
    };
    std::vector<Group> groups;
    /// By node of sliding bodies, equally directed on both sides; of turned
    /// masters one of the directions. Else empty.
    std::vector<dealii::Tensor<1, dim>> normals;
  };

  /// Of one level.
  struct JumpPenalties
  {
    /// See interface_layout(); indices of the parts are local ones of it.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    std::vector<JumpPenalty>                                   parts;
  };

  template <typename Number>
  class PenaltyProduct
  {
  public:
    explicit PenaltyProduct(std::shared_ptr<const JumpPenalties> penalties);

    /// dst += J src, both by owned index. Collective.
    void
    add(const Number *src, Number *dst) const;

    /// diagonal += that of J, by owned index. Collective.
    void
    add_diagonal(Number *diagonal) const;

  private:
    /// One penalty in the order of products.
    struct Part
    {
      explicit Part(const JumpPenalty &penalty);

      const JumpPenalty            &penalty;
      dealii::AlignedVector<Number> values;  ///< rows padded
      std::vector<Number>           normals; ///< by node and component
    };

    /// By local index of the layout.
    template <typename T>
    struct Entries
    {
      T           *owned, *ghosts;
      unsigned int n_owned;

      T *
      operator()(const unsigned int i) const
      {
        return i < n_owned ? owned + i : ghosts + (i - n_owned);
      }
    };

    void
    add_along_normals(const Part                  &part,
                      const Entries<const Number> &src,
                      const Entries<Number>       &dst) const;
    void
    add_all_components(const Part                  &part,
                       const Entries<const Number> &src,
                       const Entries<Number>       &dst) const;
    /// dst += what @p add_parts adds to vectors with ghosts.
    template <typename AddParts>
    void
    gather(Number *dst, const AddParts &add_parts) const;

    const std::shared_ptr<const JumpPenalties> penalties;
    const dealii::Utilities::MPI::Partitioner &layout;
    std::vector<Part>                          parts;
    mutable dealii::AlignedVector<Number> workspace, ghosts, sums, exchanged;
  };
} // namespace mortise
