// What the points of cells remember, by cell, and its values elsewhere.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/body.h>

#include <map>
#include <vector>

namespace mortise
{
  /// Of one body by active cell: [point][number] of NonlinearLaw::n_history()
  /// numbers, of owned and ghost cells; empty for laws that remember nothing.
  using CellHistories = std::vector<std::vector<double>>;

  /// Do the points of @p body remember anything?
  bool
  has_history(const Body &body);

  /// Set those of ghost cells of @p body. Collective.
  void
  update_ghosts(const Body &body, CellHistories &histories);

  /// The points at which the internal forces of cells with one element of a
  /// body are integrated, on the reference cell.
  dealii::Quadrature<dim>
  points_of_forces(const Body &body, unsigned int element);

  /// Numbers of histories at the points of a rule: of the polynomials, one
  /// degree lower than the displacement but at least linear, that are closest
  /// in L2 to the numbers at the points of forces.
  class HistoryValues
  {
  public:
    /// Both are kept by reference.
    HistoryValues(const Body &body, const dealii::Quadrature<dim> &rule)
      : body(body)
      , rule(rule)
    {}

    /// Of @p history at all points of the rule: [point][number].
    std::vector<double>
    evaluate(const Body::CellIterator  &cell,
             const std::vector<double> &history);

  private:
    dealii::FullMatrix<double>
    projection(unsigned int element) const;

    const Body                                        &body;
    const dealii::Quadrature<dim>                     &rule;
    std::map<unsigned int, dealii::FullMatrix<double>> by_element;
  };
} // namespace mortise
