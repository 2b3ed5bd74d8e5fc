#include <deal.II/base/mpi.h>

#include <mortise/base/run_log.h>
#include <mortise/base/text_table.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace mortise
{
  RunLog::Stage::Stage(RunLog &log, Timers &timers, const std::string &name)
    : log(log)
    , scope(std::in_place, timers, name)
    , name(name)
    , exceptions(std::uncaught_exceptions())
  {}

  RunLog::Stage::~Stage()
  {
    // A stage that ends by an error was not done: the message says what
    // happened.
    if (open && std::uncaught_exceptions() == exceptions)
      log.stage_line(name, scope->seconds(), text);
  }

  void
  RunLog::Stage::done()
  {
    if (open)
      log.stage_line(name, scope->seconds(), text);
    open = false;
    scope.reset();
  }

  RunLog::RunLog(std::ostream &out, const MPI_Comm comm)
    : out(out)
    , prints(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
  {}

  RunLog::Stage
  RunLog::stage(Timers &timers, const std::string &name)
  {
    return Stage(*this, timers, name);
  }

  void
  RunLog::stage_line(const std::string &name,
                     const double       seconds,
                     const std::string &details)
  {
    std::string readable = name; // "interface_search" of the summary
    std::replace(readable.begin(), readable.end(), '_', ' ');
    std::ostringstream text;
    text << "  " << std::left << std::setw(19) << readable << std::right
         << std::fixed << std::setprecision(2) << std::setw(8) << seconds
         << " s";
    if (!details.empty())
      text << "   " << details;
    line(text.str());
  }

  void
  RunLog::line(const std::string &text)
  {
    if (prints)
      out << text << std::endl; // at once: somebody watches
  }

  void
  RunLog::table(const std::vector<std::vector<std::string>> &rows)
  {
    std::istringstream lines(text_table(rows, true));
    for (std::string text; std::getline(lines, text);)
      line(text);
  }

  std::string
  RunLog::number(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
  }
} // namespace mortise
