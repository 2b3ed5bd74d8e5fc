// Proves which times a run goes to: planned ones exactly, halves of them where
// steps fail, longer ones after easy steps, and the same after a restart.
#include <mortise/problem/load_steps.h>
#include <verdict.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace mortise;

namespace
{
  StepParameters
  planned(const std::vector<double> &times)
  {
    StepParameters parameters;
    parameters.step = times;
    return parameters;
  }

  void
  check_times()
  {
    StepParameters parameters;
    verdict(!parameters.given() &&
              parameters.times() == std::vector<double>{1.},
            "nothing given: one step to 1");
    parameters.step = {0.3};
    verdict(parameters.given() && parameters.times().size() == 4 &&
              parameters.times()[2] == 3 * 0.3 && parameters.times()[3] == 1.,
            "a length that does not divide the end: a shorter last step");
    parameters.step     = {0.1};
    parameters.end_time = 0.7;
    verdict(parameters.times().size() == 7 && parameters.times()[6] == 0.7,
            "a length that divides it but for rounding");
    parameters.step = {5.};
    verdict(parameters.times() == std::vector<double>{0.7},
            "a length beyond the end: one step");
    bool same = true;
    for (const std::vector<double> &step : std::vector<std::vector<double>>{
           {}, {0.1}, {0.7}, {5.}, {0.2, 0.3}, {0.3, 0.6}})
      for (const std::optional<double> end :
           {std::optional<double>(), std::optional<double>(0.7)})
        {
          parameters.step     = step;
          parameters.end_time = end;
          same = same && parameters.first_time() == parameters.times().front();
        }
    verdict(same, "the first time is that of the list");
  }

  void
  check_path()
  {
    StepParameters parameters;
    parameters.by_arc_length = true;
    parameters.step          = {0.5};
    verdict(parameters.times().size() == 100 && parameters.times()[99] == 50.,
            "along a path: a hundred lengths, whatever the end time");
    parameters.n_steps = 3;
    LoadSteps steps(parameters, true);
    verdict(steps.halve() && steps.next() == 0.25, "a length is halved");
    steps.accept(true);
    steps.accept(true);
    verdict(steps.time() == 0.5 && steps.output_due() && !steps.finished(),
            "two halves are one step");
    steps.accept(true);
    steps.finish();
    verdict(steps.finished() && steps.output_due() && steps.fraction() == 1. &&
              steps.time() == 1.,
            "a path ends where the end time is reached");
  }

  void
  check_planned()
  {
    StepParameters parameters = planned({0.1, 0.3, 1., 1.5, 2.});
    parameters.output_every   = 2;
    LoadSteps           steps(parameters, false);
    std::vector<double> reached, written;
    while (!steps.finished())
      {
        reached.push_back(steps.next());
        steps.accept(true);
        if (steps.output_due())
          written.push_back(steps.time());
      }
    verdict(reached == parameters.step, "planned times exactly");
    verdict(written == std::vector<double>({0.3, 1.5, 2.}),
            "output at every second one and the last");
    verdict(steps.fraction() == 1. && steps.n_done() == 5, "all is done");
    LoadSteps linear(parameters, false);
    verdict(!linear.halve() && linear.next() == 0.1,
            "a linear scene does not halve");
  }

  void
  check_halving()
  {
    LoadSteps steps(planned({1., 2.}), true);
    verdict(steps.halve() && steps.halve() && steps.next() == 0.25,
            "halved twice: a quarter");
    steps.accept(false);
    verdict(!steps.output_due() && steps.next() == 0.5,
            "not easy: the next is as long, no output in between");
    steps.accept(true);
    verdict(steps.next() == 1., "easy: twice as long, up to the planned time");
    steps.accept(true);
    verdict(steps.output_due() && steps.next() == 2.,
            "easy again: the whole planned step");
    steps.accept(true);
    verdict(steps.finished() && steps.n_done() == 4, "four steps");

    StepParameters parameters = planned({});
    parameters.smallest_step  = 0.2;
    LoadSteps    coarse(parameters, true);
    unsigned int halvings = 0;
    while (coarse.halve())
      ++halvings;
    verdict(halvings == 2 && coarse.next() == 0.25,
            "no step below the smallest");

    StepParameters limited = planned({1., 2.});
    limited.largest_step   = 0.4;
    LoadSteps even(limited, true);
    verdict(std::fabs(even.next() - 1. / 3.) < 1e-15 && even.halve() &&
              std::fabs(even.next() - 1. / 6.) < 1e-15,
            "no step above the largest: three of the same length, and halves");

    // thirds of a step leave no sliver
    StepParameters short_one;
    short_one.end_time = 0.3;
    LoadSteps thirds(short_one, true);
    thirds.resume(0., 0, 0.1);
    unsigned int n = 0;
    for (; !thirds.finished() && n < 10; ++n)
      thirds.accept(false);
    verdict(n == 3 && thirds.time() == 0.3, "three thirds, exactly at the end");
  }

  /// 3 * 0.1 is not 0.3: no step is left between them.
  void
  check_rounding()
  {
    LoadSteps steps(planned({0.1, 2 * 0.1, 3 * 0.1, 0.4}), false);
    steps.resume(0.3, 3, 1.);
    verdict(steps.next() == 0.4, "a planned time with another rounding");
  }

  void
  check_resume()
  {
    StepParameters parameters = planned({});
    for (unsigned int i = 1; i <= 10; ++i)
      parameters.step.push_back(0.1 * i);
    for (unsigned int stop = 1; stop <= 12; ++stop)
      {
        LoadSteps           whole(parameters, true);
        std::vector<double> expected, got;
        const auto          run = [](LoadSteps           &steps,
                            std::vector<double> &times,
                            const unsigned int   until) {
          while (!steps.finished() && steps.n_done() < until)
            {
              if (steps.n_done() == 3)
                steps.halve();
              times.push_back(steps.next());
              steps.accept(steps.n_done() % 2 == 0);
            }
        };
        run(whole, expected, 100);
        LoadSteps first(parameters, true), second(parameters, true);
        run(first, got, stop);
        second.resume(first.time(), first.n_done(), first.longest());
        run(second, got, 100);
        verdict(got == expected && second.n_done() == whole.n_done(),
                "stopped after " + std::to_string(stop) +
                  " steps: the same times");
      }
  }
} // namespace

int
main()
{
  check_times();
  check_path();
  check_planned();
  check_halving();
  check_rounding();
  check_resume();
}
