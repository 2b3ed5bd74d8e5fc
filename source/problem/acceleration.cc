// See acceleration.h.
#include <mortise/problem/acceleration.h>
#include <mortise/solvers/anderson.h>

#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_steps = 4, most_states = 3;
  } // namespace

  void
  Acceleration::add(const Vector &given, const Iterate &result)
  {
    Step step{result, result.x.displacement};
    step.way -= given;
    steps.push_back(std::move(step));
    if (steps.size() > most_steps)
      steps.pop_front();
  }

  Iterate
  Acceleration::next() const
  {
    const unsigned int n = steps.size();
    FullMatrix<double> products(n, n);
    for (unsigned int a = 0; a < n; ++a)
      {
        Vector scaled = steps[a].way;
        scaled.scale(weights);
        for (unsigned int b = a; b < n; ++b)
          products(a, b) = products(b, a) = scaled * steps[b].way;
      }
    const std::vector<double> factors = anderson_weights(products);
    Iterate                   result  = steps.back().result;
    for (unsigned int a = 0; a < n; ++a)
      add_scaled(result, factors[a] - (a + 1 == n ? 1. : 0.), steps[a].result);
    return result;
  }

  void
  Extrapolation::add(Iterate state)
  {
    if (!states.empty() && !(state.x.time > states.back().x.time))
      return;
    states.push_back(std::move(state));
    if (states.size() > most_states)
      states.pop_front();
  }

  Iterate
  Extrapolation::at(const double time, const unsigned int n) const
  {
    const auto first  = states.end() - n;
    Iterate    result = states.back();
    for (auto i = first; i != states.end(); ++i)
      {
        double factor = 1.;
        for (auto j = first; j != states.end(); ++j)
          if (j != i)
            factor *= (time - j->x.time) / (i->x.time - j->x.time);
        add_scaled(result, factor - (i + 1 == states.end() ? 1. : 0.), *i);
      }
    result.x.time = states.back().x.time;
    return result;
  }
} // namespace mortise
