#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/solvers/multigrid/chebyshev.h>
#include <mortise/solvers/pseudo_random.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Where this was measured: see lower_smoothing_bound.cc.
    constexpr double degree_by_root = 0.88;
  } // namespace

  template <typename Number>
  Chebyshev<Number>::Chebyshev(const LevelOperatorBase<Number>   &matrix,
                               const double                       smallest,
                               const InterfaceCorrection<Number> *correction)
    : matrix(matrix)
    , correction(correction)
    , smallest(smallest)
  {
    set_up();
  }

  template <typename Number>
  bool
  Chebyshev<Number>::update(const InterfaceCorrection<Number> *with)
  {
    correction = with;
    if (has_independent ||
        (correction != nullptr && correction->has_independent()))
      set_up();
    return is_valid();
  }

  template <typename Number>
  void
  Chebyshev<Number>::set_up()
  {
    has_independent = correction != nullptr && correction->has_independent();
    matrix.diagonal(inverse_diagonal);
    matrix.average_components(inverse_diagonal);
    if (correction != nullptr)
      correction->add_dependent_stiffness(inverse_diagonal);
    for (unsigned int i = 0; i < inverse_diagonal.locally_owned_size(); ++i)
      inverse_diagonal.local_element(i) = 1 / inverse_diagonal.local_element(i);
    matrix.initialize(r);
    matrix.initialize(d);
    largest = 1.1 * estimate_largest();
    range   = std::max(2., largest / smallest);
    degree  = static_cast<unsigned int>(
      std::max(1., std::round(degree_by_root * std::sqrt(range))));
  }

  template <typename Number>
  double
  Chebyshev<Number>::estimate_largest() const
  {
    // Lanczos by conjugate gradients on a right hand side of all frequencies
    LevelVector<Number> p(r), q(r);
    const auto          first = r.get_partitioner()->local_range().first;
    for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
      r.local_element(i) = std::sqrt(1 / inverse_diagonal.local_element(i)) *
                           pseudo_random(first + i);
    matrix.clear_constrained(r);
    std::vector<double> alpha, beta;
    double              rho_old = 0.;
    for (unsigned int k = 0; k < 12; ++k)
      {
        d = r;
        d.scale(inverse_diagonal);
        // without independent ones the constraint makes no eigenvalue larger
        if (correction != nullptr && correction->has_independent())
          correction->correct(
            [&](const unsigned int i) { return r.local_element(i); },
            inverse_diagonal,
            [&](const unsigned int i, const Number c) {
              d.local_element(i) -= c;
            });
        const double rho = r * d;
        if (!(rho > 0.))
          break;
        if (k == 0)
          p = d;
        else
          {
            beta.push_back(rho / rho_old);
            p.sadd(beta.back(), 1, d);
          }
        rho_old = rho;
        matrix.vmult(q, p);
        const double energy = p * q;
        if (!(energy > 0.))
          {
            if (energy < 0. || std::isnan(energy))
              return -1.;
            break;
          }
        alpha.push_back(rho / energy);
        r.add(-alpha.back(), q);
      }
    const unsigned int n = alpha.size();
    if (n == 0)
      return 1.;
    LAPACKFullMatrix<double> T(n, n);
    for (unsigned int i = 0; i < n; ++i)
      {
        T(i, i) = 1. / alpha[i] + (i > 0 ? beta[i - 1] / alpha[i - 1] : 0.);
        if (i + 1 < n)
          T(i, i + 1) = T(i + 1, i) = std::sqrt(beta[i]) / alpha[i];
      }
    T.compute_eigenvalues();
    double result = 0.;
    for (unsigned int i = 0; i < n; ++i)
      result = std::max(result, T.eigenvalue(i).real());
    return result;
  }

  template <typename Number>
  void
  Chebyshev<Number>::smooth(LevelVector<Number>       &x,
                            const LevelVector<Number> &b,
                            const bool                 from_zero) const
  {
    const double theta     = largest * (1. + 1. / range) / 2.,
                 delta     = largest * (1. - 1. / range) / 2.,
                 sigma     = theta / delta;
    double     rho         = 1. / sigma;
    const bool has_springs = correction != nullptr && correction->has_springs();
    const auto n           = x.locally_owned_size();
    Number    *X = x.begin(), *D = d.begin(), *R = r.begin();
    const Number *B = b.begin(), *I = inverse_diagonal.begin();
    for (unsigned int k = 0; k < degree; ++k)
      {
        const bool   no_product = k == 0 && from_zero;
        const double next       = k == 0 ? rho : 1. / (2. * sigma - rho);
        const Number keep       = k == 0 ? 0. : next * rho,
                     take       = k == 0 ? 1. / theta : 2. * next / delta;
        rho                     = next;
        if (no_product && has_springs)
          correction->release_springs();
        if (!no_product)
          matrix.vmult(r, x);
        if (!no_product && has_springs)
          correction->add_spring_forces(r);
        if (no_product)
          for (unsigned int i = 0; i < n; ++i)
            X[i] = D[i] = take * I[i] * B[i];
        else if (k == 0)
          for (unsigned int i = 0; i < n; ++i)
            X[i] += D[i] = take * I[i] * (B[i] - R[i]);
        else
          for (unsigned int i = 0; i < n; ++i)
            X[i] += D[i] = keep * D[i] + take * I[i] * (B[i] - R[i]);
        if (correction != nullptr)
          correction->correct(
            [&](const unsigned int i) {
              return no_product ? B[i] : B[i] - R[i];
            },
            inverse_diagonal,
            [&](const unsigned int i, const Number c) {
              D[i] -= take * c;
              X[i] -= take * c;
            });
        if (has_springs)
          correction->load_springs(keep, take);
      }
  }

  template class Chebyshev<float>;
  template class Chebyshev<double>;
} // namespace mortise
