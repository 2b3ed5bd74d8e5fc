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
  namespace
  {
    /// To the start of the line, which becomes empty.
    constexpr char clear_line[] = "\r\033[K";
  } // namespace

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

  RunLog::RunLog(std::ostream &out, const MPI_Comm comm, const bool terminal)
    : out(out)
    , prints(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , terminal(terminal && prints)
  {}

  RunLog::~RunLog()
  {
    if (!bar.empty())
      out << clear_line << std::flush;
  }

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
    if (!prints)
      return;
    if (!bar.empty())
      out << clear_line;
    out << text << '\n' << bar << std::flush; // at once: somebody watches
  }

  void
  RunLog::progress(const double fraction,
                   const double seconds,
                   const double left)
  {
    const std::string done =
      number(100. * fraction) + " % done in " + number(seconds) + " s" +
      (fraction >= 1. ? "" : ", about " + number(left) + " s left");
    if (!terminal)
      return line("  " + done);
    constexpr int     width = 30;
    const std::size_t n =
      std::clamp(static_cast<int>(width * fraction), 0, width);
    if (!bar.empty())
      out << clear_line;
    bar = fraction >= 1. ? "" :
                           "  [" + std::string(n, '#') +
                             std::string(width - n, '.') + "] " + done;
    out << bar << std::flush;
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
