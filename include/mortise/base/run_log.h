// Log of a run: a line per stage with its time, warnings once, a table at the
// end. Only rank 0 prints.
#pragma once

#include <mortise/base/timers.h>
#include <mpi.h>

#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mortise
{
  class RunLog
  {
  public:
    /// One stage of a run: enters the timer of its name and, when it ends
    /// without an exception, prints "  name   0.12 s   details".
    class Stage
    {
    public:
      Stage(RunLog &log, Timers &timers, const std::string &name);
      ~Stage();
      Stage(const Stage &) = delete;
      Stage &
      operator=(const Stage &) = delete;

      /// Result of the stage in a few words ("2 bodies, 96 cells").
      void
      details(const std::string &new_text)
      {
        text = new_text;
      }

      /// End now rather than with the scope.
      void
      done();

    private:
      RunLog                      &log;
      std::optional<Timers::Scope> scope; ///< ended by done()
      std::string                  name;
      std::string                  text;
      int                          exceptions; ///< in flight at construction
      bool                         open = true;
    };

    /// @p out is written by rank 0 of @p comm only; it must outlive the log. On a
    /// @p terminal there may be a bar below the lines.
    RunLog(std::ostream &out, MPI_Comm comm, bool terminal = false);
    ~RunLog();
    RunLog(const RunLog &) = delete;
    RunLog &
    operator=(const RunLog &) = delete;

    /// Run a stage: `auto stage = log.stage(timers, "mesh"); ...
    /// stage.details("96 cells");`
    [[nodiscard]] Stage
    stage(Timers &timers, const std::string &name);

    /// The line of a stage that took @p seconds.
    void
    stage_line(const std::string &name,
               double             seconds,
               const std::string &details = {});

    /// A line of text, as it is.
    void
    line(const std::string &text = {});

    /// How much of the run is done (@p fraction of 1) after @p seconds, and in how
    /// many it will be (@p left): a bar on a terminal, else a line.
    void
    progress(double fraction, double seconds, double left);

    /// "warning: text", once for each text. Call it on every rank or on rank 0;
    /// what only another rank knows must be brought to rank 0 first.
    void
    warning(const std::string &text)
    {
      if (!seen.insert(text).second)
        return;
      texts.push_back(text);
      line("warning: " + text);
    }

    /// Texts of the warnings so far, in order (of rank 0; the same on all ranks
    /// if all called).
    const std::vector<std::string> &
    warnings() const
    {
      return texts;
    }

    /// Rows in aligned columns: the first column to the left, the others to the
    /// right. The first row is the heading. A row may be shorter than the
    /// heading.
    void
    table(const std::vector<std::vector<std::string>> &rows);

    /// A number for people: 4 significant digits ("1.235e-07", "0.125", "96").
    static std::string
    number(double value);

  private:
    std::ostream            &out;
    bool                     prints, terminal;
    std::string              bar; ///< below the lines
    std::set<std::string>    seen;
    std::vector<std::string> texts;
  };
} // namespace mortise
