#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

namespace mortise
{
  void
  throw_if_any(const std::string &message, const MPI_Comm comm)
  {
    const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    const int me      = dealii::Utilities::MPI::this_mpi_process(comm);
    const int reporter =
      dealii::Utilities::MPI::min(message.empty() ? n_ranks : me, comm);
    if (reporter < n_ranks)
      throw InputError(
        dealii::Utilities::MPI::broadcast(comm, message, reporter));
  }

  namespace
  {
    /// Levenshtein distance, case ignored.
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const bool same =
                std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                std::tolower(static_cast<unsigned char>(b[j - 1]));
              const std::size_t substituted = diagonal + (same ? 0 : 1);
              diagonal                      = row[j];
              row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
            }
        }
      return row[b.size()];
    }
  } // namespace

  std::string
  nearest_name(const std::string &got, const std::vector<std::string> &allowed)
  {
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(3, got.size() / 2);
    for (const std::string &name : allowed)
      {
        const std::size_t distance = edit_distance(got, name);
        if (distance < best_distance)
          {
            best_distance = distance;
            best          = name;
          }
      }
    return best;
  }

  std::string
  join_lines(const std::vector<std::string> &texts, const std::size_t most)
  {
    std::vector<std::string> lines;
    for (const std::string &text : texts)
      {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
          lines.push_back(line);
      }
    const std::size_t shown = lines.size() <= most ? lines.size() : most - 1;
    std::string       result;
    for (std::size_t i = 0; i < shown; ++i)
      result += (i > 0 ? "\n" : "") + lines[i];
    return shown == lines.size() ?
             result :
             result + "\n... (" + std::to_string(lines.size() - shown) +
               " lines more)";
  }

  std::string
  join_names(const std::vector<std::string> &names)
  {
    constexpr std::size_t most = 1000; // names of a mesh may be thousands
    if (names.empty())
      return "(none)";
    std::string joined = shortened(names.front());
    for (std::size_t i = 1; i < names.size(); ++i)
      {
        if (names[i].size() + joined.size() > most && i + 1 < names.size())
          return joined + ", ... (" + std::to_string(names.size()) + " in all)";
        joined += ", " + shortened(names[i]);
      }
    return joined;
  }
} // namespace mortise
