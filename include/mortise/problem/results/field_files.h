// Files of fields: a VTU file for each body and interface, in a run of several
// steps for each time, and a PVD file with all times.
#pragma once

#include <mortise/adapt/cell_states.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/results/step_evaluation.h>

#include <utility>
#include <vector>

namespace mortise
{
  class FieldFiles
  {
  public:
    /// @p run must live on.
    explicit FieldFiles(const RunContext &run)
      : run(run)
    {}

    /// Write the requested fields as step @p step at @p time. Returns errors of
    /// writing. @p estimates: CycleErrors::by_cell(), or none. Collective.
    std::vector<OutputError>
    write(unsigned int          step,
          double                time,
          const StepEvaluation &evaluation,
          const NumbersByCell  &estimates);

    /// Steps and times that were written.
    const std::vector<std::pair<unsigned int, double>> &
    written() const
    {
      return steps;
    }

    /// Go on after @p written.
    void
    resume(const std::vector<std::pair<unsigned int, double>> &written)
    {
      steps = written;
    }

  private:
    /// The file of @p name (a body or an interface) without its directory.
    std::string
    file_name(const std::string &name, unsigned int step) const;

    /// The collection of the files of @p name.
    void
    write_collection(const std::string &name) const;

    const RunContext                            &run;
    std::vector<std::pair<unsigned int, double>> steps;
  };
} // namespace mortise
