#include "import_history.h"

#include <deal.II/base/symmetric_tensor.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  std::string
  number_text(const double value)
  {
    if (!std::isfinite(value))
      throw InputError("--import: the deck has a value that is no finite "
                       "number, as of a division by zero");
    std::ostringstream text;
    text.precision(12);
    text << value;
    return text.str();
  }

  double
  ImportHistory::at(const double t) const
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (t <= points[i].first)
        {
          if (i == 0 || t == points[i].first)
            return points[i].second;
          const auto &[t0, v0] = points[i - 1];
          return v0 +
                 (points[i].second - v0) * (t - t0) / (points[i].first - t0);
        }
    return points.empty() ? 0. : points.back().second;
  }

  double
  ImportHistory::after(const double t) const
  {
    for (std::size_t i = points.size(); i-- > 0;)
      if (t == points[i].first)
        return points[i].second;
    return at(t);
  }

  bool
  ImportHistory::is_zero() const
  {
    return std::all_of(points.begin(), points.end(), [](const auto &p) {
      return p.second == 0.;
    });
  }

  std::string
  ImportHistory::text() const
  {
    if (is_zero())
      return "0";
    std::string text, end;
    for (std::size_t i = 1; i < points.size(); ++i)
      {
        const auto &[t0, v0] = points[i - 1];
        const auto &[t1, v1] = points[i];
        if (t1 == t0)
          continue;
        const double slope = (v1 - v0) / (t1 - t0);
        std::string  piece = v0 == 0. && slope != 0. ? "" : number_text(v0);
        if (slope != 0.)
          piece += (piece.empty() ? number_text(slope) :
                                    (slope < 0. ? " - " : " + ") +
                                      number_text(std::fabs(slope))) +
                   (t0 == 0. ? "*t" : "*(t - " + number_text(t0) + ")");
        // the last piece needs no end where the last step has its end
        if (i + 1 < points.size())
          {
            text += "if(t <= " + number_text(t1) + ", " + piece + ", ";
            end += ")";
          }
        else
          text += piece;
      }
    return points.size() == 1 ? number_text(points[0].second) : text + end;
  }

  ImportHistory
  ImportHistory::times(const double factor) const
  {
    ImportHistory result = *this;
    for (auto &point : result.points)
      point.second *= factor;
    return result;
  }

  ImportHistory
  ImportHistory::plus(const ImportHistory &other) const
  {
    if (points.empty() || other.points.empty())
      return points.empty() ? other : *this;
    std::set<double> times;
    for (const auto *list : {&points, &other.points})
      for (const auto &point : *list)
        times.insert(point.first);
    ImportHistory sum;
    for (const double t : times)
      {
        sum.points.emplace_back(t, at(t) + other.at(t));
        if (const double next = after(t) + other.after(t);
            next != sum.points.back().second)
          sum.points.emplace_back(t, next);
      }
    return sum;
  }

  std::string
  affine_text(const AffineHistory &coefficients)
  {
    static const std::array<std::string, 4> variables = {{"", "x", "y", "z"}};
    std::string                             text;
    for (unsigned int i = 0; i < 4; ++i)
      {
        if (coefficients[i].is_zero())
          continue;
        const std::string factor = coefficients[i].text();
        const bool is_sum = factor.find(' ') != std::string::npos && i > 0;
        text += (text.empty() ? "" : " + ") +
                (is_sum ? "(" + factor + ")" : factor) +
                (i > 0 ? "*" + variables[i] : "");
      }
    return text.empty() ? "0" : text;
  }

  std::vector<double>
  affine_fit(const std::vector<Point<3>> &points,
             const std::vector<double>   &values)
  {
    const double n = points.size();
    Tensor<1, 3> centre;
    double       mean = 0., scale = 0.;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        centre += Tensor<1, 3>(points[i]) / n;
        mean += values[i] / n;
        scale = std::max(scale, std::fabs(values[i]));
      }
    SymmetricTensor<2, 3> squares;
    Tensor<1, 3>          products;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Tensor<1, 3> d = points[i] - Point<3>(centre);
        squares += symmetrize(outer_product(d, d));
        products += (values[i] - mean) * d;
      }
    // directions in which there are no points have no slope
    Tensor<1, 3> slope;
    const auto   directions = eigenvectors(squares);
    for (const auto &[square, direction] : directions)
      if (square > 1e-10 * directions[0].first)
        slope += (direction * products) / square * direction;
    std::vector<double> fit = {mean - slope * centre,
                               slope[0],
                               slope[1],
                               slope[2]};
    const double        extent =
      std::sqrt(std::max(directions[0].first, 0.)) * slope.norm();
    for (unsigned int i = 0; i < 4; ++i)
      if (std::fabs(fit[i]) * (i == 0 ? 1. : extent / (slope.norm() + 1e-300)) <
          1e-12 * scale)
        fit[i] = 0.;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::fabs(mean + slope * (points[i] - Point<3>(centre)) - values[i]) >
          1e-7 * scale)
        return {};
    return fit;
  }

  namespace
  {
    double
    number_of(const InpLine &line, const std::size_t i, const double otherwise)
    {
      return i >= line.words.size() || line.words[i].empty() ?
               otherwise :
               inp_number(line.words[i], [&](const std::string &what) {
                 throw InputError("--import: the deck has in " + line.place +
                                  " " + what);
               });
    }
  } // namespace

  ImportSteps::ImportSteps(const InpDeck &deck, ImportRemarks &remarks)
  {
    bool in_step = false;
    for (const InpBlock &block : deck.blocks)
      if (block.keyword == "*STEP")
        {
          in_step = true;
          const double last =
            steps.empty() ? 0. : steps.back().start + steps.back().period;
          steps.emplace_back();
          steps.back().start   = last;
          steps.back().at_once = upper(block.option("AMPLITUDE")) == "STEP";
          finite               = finite || (block.has("NLGEOM") &&
                              upper(block.option("NLGEOM")) != "NO");
          if (block.has("PERTURBATION"))
            remarks.approximated(block.place,
                                 "*STEP, PERTURBATION is a static step");
        }
      else if (block.keyword == "*END STEP")
        in_step = false;
      else if (block.keyword == "*STATIC")
        read_static(block, remarks);
      else if (block.keyword == "*AMPLITUDE")
        read_amplitude(block, remarks);
      else if (in_step)
        steps.back().blocks.push_back(&block);
      else
        model.push_back(&block);
    nonlinear = finite;
    if (steps.empty())
      steps.emplace_back();
  }

  void
  ImportSteps::read_static(const InpBlock &block, ImportRemarks &remarks)
  {
    if (steps.empty())
      return;
    if (block.has("RIKS"))
      remarks.approximated(block.place,
                           "RIKS: loads are given; Control = arc length "
                           "follows a path beyond the largest load");
    if (block.lines.empty())
      return;
    const double first   = number_of(block.lines[0], 0, 1.);
    steps.back().period  = number_of(block.lines[0], 1, 1.);
    steps.back().largest = number_of(block.lines[0], 3, 0.);
    if (block.has("DIRECT"))
      steps.back().largest = first;
    if (!(steps.back().period > 0.))
      steps.back().period = 1.;
    if (!(steps.back().largest > 0.) ||
        steps.back().largest >= steps.back().period)
      steps.back().largest = 0.;
  }

  void
  ImportSteps::read_amplitude(const InpBlock &block, ImportRemarks &remarks)
  {
    Amplitude         amplitude;
    const std::string kind = upper(block.option("DEFINITION"));
    if ((!kind.empty() && kind != "TABULAR") || block.has("USER"))
      return remarks.left_out(block.place,
                              "*AMPLITUDE that is no table; what has it grows "
                              "as without one");
    amplitude.total_time = upper(block.option("TIME")).rfind("TOTAL", 0) == 0;
    for (const InpLine &line : block.lines)
      for (std::size_t i = 0; i + 1 < line.words.size(); i += 2)
        {
          amplitude.history.points.emplace_back(number_of(line, i, 0.),
                                                number_of(line, i + 1, 0.));
          const auto &points = amplitude.history.points;
          if (points.size() > 1 &&
              points.back().first < points[points.size() - 2].first)
            throw InputError("--import: the deck has in " + line.place +
                             " an *AMPLITUDE whose times descend");
        }
    amplitudes[upper(block.option("NAME"))] = amplitude;
  }

  void
  ImportSteps::change(std::vector<ImportChange> &changes,
                      const ImportChange        &next)
  {
    if (!changes.empty() && changes.back().step == next.step)
      changes.pop_back();
    changes.push_back(next);
  }

  bool
  ImportSteps::is_simple() const
  {
    return steps.size() == 1 && amplitudes.empty() &&
           (steps[0].largest == 0. || !nonlinear);
  }

  ImportHistory
  ImportSteps::history(const std::vector<ImportChange> &changes) const
  {
    if (is_simple())
      return {{{0., changes.empty() ? 0. : changes.back().value}}};
    ImportHistory result;
    double        value = 0.;
    result.points.emplace_back(0., 0.);
    for (const ImportChange &change : changes)
      {
        if (change.step == 0)
          {
            value                   = change.value;
            result.points[0].second = value;
            continue;
          }
        const ImportStep &step  = steps[change.step - 1];
        const double      end   = step.start + step.period;
        const auto        found = amplitudes.find(change.amplitude);
        if (step.start > result.points.back().first)
          result.points.emplace_back(step.start, value);
        // a jump at the start of all is none
        const auto jump = [&](const double to) {
          if (step.start == 0.)
            result.points.back().second = to;
          else if (to != result.points.back().second)
            result.points.emplace_back(step.start, to);
        };
        if (found != amplitudes.end())
          {
            const Amplitude &a      = found->second;
            const double     offset = a.total_time ? 0. : step.start;
            jump(change.value * a.history.after(step.start - offset));
            for (const auto &[t, factor] : a.history.points)
              if (t + offset > step.start && t + offset < end)
                result.points.emplace_back(t + offset, change.value * factor);
            value = change.value * a.history.at(end - offset);
          }
        else
          {
            value = change.value;
            if (step.at_once)
              jump(value);
          }
        result.points.emplace_back(end, value);
      }
    if (std::all_of(result.points.begin(),
                    result.points.end(),
                    [&](const auto &p) { return p.second == value; }))
      result.points.resize(1);
    else if (const double last = steps.back().start + steps.back().period;
             result.points.back().first < last)
      result.points.emplace_back(last, value);
    return result;
  }

  std::string
  ImportSteps::text() const
  {
    if (is_simple())
      return "";
    std::set<double> times;
    double           largest = 0.;
    for (const ImportStep &step : steps)
      {
        const double end = step.start + step.period;
        times.insert(end);
        if (step.largest > 0.)
          largest =
            largest > 0. ? std::min(largest, step.largest) : step.largest;
        for (const auto &amplitude : amplitudes)
          for (const auto &point : amplitude.second.history.points)
            {
              const double t =
                point.first + (amplitude.second.total_time ? 0. : step.start);
              if (t > step.start && t < end)
                times.insert(t);
            }
      }
    std::string list;
    for (const double t : times)
      list += (list.empty() ? "" : ", ") + number_text(t);
    std::string text =
      "\nsubsection Steps\n  set Step = " + (times.size() > 1 ? list : "");
    if (times.size() == 1)
      text = "\nsubsection Steps\n  set End time = " + list;
    if (nonlinear && largest > 0.)
      text += "\n  set Largest step = " + number_text(largest);
    return text + "\nend\n";
  }
} // namespace mortise
