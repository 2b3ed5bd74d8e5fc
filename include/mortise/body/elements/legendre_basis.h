// The one-dimensional hierarchical basis on [0,1]: two linear functions and
// integrated Legendre (Lobatto) bubbles, their restriction to the halves of the
// interval, and the same functions as polynomials for deal.II.
#pragma once

#include <deal.II/base/polynomial.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace mortise
{
  /// Highest degree for which the functions of this file are available.
  constexpr unsigned int max_lobatto_degree = 8;

  /// Values and derivatives of the @p degree + 1 functions at @p x, in the order N_0 = 1-x,
  /// N_1 = x, N_2, ..., N_degree with the bubbles
  ///
  ///   N_k(x) = (P_k(t) - P_{k-2}(t)) / (2 sqrt(2k-1)),  t = 2x-1,  k
  ///   = 2..degree,
  ///
  /// (P_k: Legendre polynomials), which vanish at both ends and are scaled such
  /// that int_0^1 N_k' N_l' dx = delta_kl for k, l >= 2 and int_0^1 N_k' N_0'
  /// dx = 0. Source: Szabo and Babuska, Finite Element Analysis (1991).
  ///
  /// @p values, @p derivatives and @p second (any of the last two may be null) have room for
  /// @p degree + 1 numbers each; derivatives are with respect to x. @p x may lie outside [0,1].
  /// No allocation. 1 <= degree <= max_lobatto_degree.
  void
  evaluate_lobatto(unsigned int degree,
                   double       x,
                   double      *values,
                   double      *derivatives = nullptr,
                   double      *second      = nullptr);

  /// Matrix R with N_j(x)|_child = sum_i R(i,j) N_i(y), where the child is
  /// [0,1/2] (x = y/2) for
  /// @p child 0 and [1/2,1] (x = (1+y)/2) for @p child 1. Square, of size max_lobatto_degree + 1;
  /// the leading block of size p+1 is the matrix of degree p (R(i,j) = 0 for i
  /// > j >= 1). Entries that are 0 or 1 in exact arithmetic are exactly so.
  const dealii::FullMatrix<double> &
  lobatto_restriction(unsigned int child);

  /// What the coefficients of a continuous function on the half @p child bring to
  /// those of its best approximation on [0,1], in the H1-seminorm and with the
  /// same values at both ends: a square matrix of size @p degree + 1.
  dealii::FullMatrix<double>
  lobatto_merging(unsigned int degree, unsigned int child);

  /// The functions of evaluate_lobatto() as polynomials in the lexicographic
  /// order of deal.II's tensor product elements: N_0, N_2, ..., N_degree, N_1
  /// (the end of the interval last). They are kept as products of roots, which
  /// is accurate to rounding, unlike powers of x.
  std::vector<dealii::Polynomials::Polynomial<double>>
  lobatto_polynomials(unsigned int degree);

  /// Place of N_k (in the order of evaluate_lobatto()) in the order of
  /// lobatto_polynomials().
  inline unsigned int
  lobatto_to_lexicographic(const unsigned int degree, const unsigned int k)
  {
    return k == 0 ? 0 : (k == 1 ? degree : k - 1);
  }

  /// Place in the order of evaluate_lobatto() of place @p l in the lexicographic order of nodes.
  inline unsigned int
  lexicographic_to_lobatto(const unsigned int degree, const unsigned int l)
  {
    return l == 0 ? 0 : (l == degree ? 1 : l + 1);
  }
} // namespace mortise
