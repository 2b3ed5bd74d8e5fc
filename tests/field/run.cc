// run MORTISE MPI_SCRIPT SCENE.prm: runs a scene as a user would and holds what
// comes out against the expectations in its comment lines:
//   # field: KIND OF SOURCE                          what the scene was drawn
//   from # options --set "Body a/Degree=3"                further arguments of
//   the program # ranks 3                                        1 without it
//   # expect exit 2
//   # expect message "TEXT"                          the program prints TEXT
//   # expect no message "TEXT"
//   # expect no /JSON/POINTER                      summary.json has none
//   # expect /JSON/POINTER = NUMBER within NUMBER    of summary.json, absolute
//   # expect /JSON/POINTER = NUMBER relative NUMBER
//   # expect /JSON/POINTER < NUMBER                  or >
//   # expect field NAME of FILE.vtu = NUMBER relative NUMBER
//                          of a scalar, at all points at which it is a number
// where /steps/last is the last one of /steps.
// Exit code 0 when all of them hold, 1 with a line for each that does not, 2
// for an expectation that cannot be read.

#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../output/vtu_content.h"
#include "../temporary_directory.h"

namespace
{
  struct Expectations
  {
    bool                     source  = false;
    std::string              options = "";
    int                      ranks   = 1;
    std::vector<std::string> lines   = {};
  };

  Expectations
  read_expectations(const std::string &scene)
  {
    Expectations  expectations;
    std::ifstream file(scene);
    if (!file)
      throw std::runtime_error("cannot be read");
    bool exit_code = false;
    for (std::string line; std::getline(file, line);)
      if (line.rfind("# expect ", 0) == 0)
        {
          expectations.lines.push_back(line.substr(9));
          exit_code |= line.rfind("# expect exit ", 0) == 0;
        }
      else if (line.rfind("# options ", 0) == 0)
        expectations.options += " " + line.substr(10);
      else if (line.rfind("# ranks ", 0) == 0)
        expectations.ranks = std::stoi(line.substr(8));
      else
        expectations.source |= line.rfind("# field: ", 0) == 0;
    if (!expectations.source || !exit_code)
      throw std::runtime_error(
        "needs a line '# field: ...' and a line '# expect exit ...'");
    return expectations;
  }

  struct Outcome
  {
    int            exit_code = 0;
    std::string    printed   = "";
    nlohmann::json summary   = {};

    std::filesystem::path directory = {};
  };

  Outcome
  run(const std::string &command, const std::filesystem::path &output)
  {
    FILE *pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr)
      throw std::runtime_error("cannot be started");
    Outcome outcome;
    outcome.directory = output;
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
      outcome.printed.append(buffer, n);
    const int status = pclose(pipe);
    outcome.exit_code =
      WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    std::ifstream summary(output / "summary.json");
    if (summary)
      summary >> outcome.summary;
    return outcome;
  }

  // of "NAME of FILE.vtu = NUMBER relative NUMBER"; as difference()
  std::string
  difference_of_field(std::istringstream &words, const Outcome &outcome)
  {
    std::string name, of, file, relation, kind;
    double      value = 0, tolerance = 0;
    words >> name >> of >> file >> relation >> value >> kind >> tolerance;
    if (!words || of != "of" || relation != "=" || kind != "relative")
      throw std::runtime_error(
        "a field has the form 'field NAME of FILE.vtu = NUMBER relative NUMBER'");
    const mortise::testing::VtuPieces<std::array<double, 3>> content(
      outcome.directory / file);
    const auto field = content.data.find(name);
    if (field == content.data.end())
      return "there is none";
    double worst = value;
    bool   any   = false;
    for (const std::vector<double> &at_point : field->second)
      if (!std::isnan(at_point[0]))
        {
          any = true;
          if (std::abs(at_point[0] - value) > std::abs(worst - value))
            worst = at_point[0];
        }
    return any && std::abs(worst - value) <= tolerance * std::abs(value) ?
             "" :
             std::to_string(worst);
  }

  // "" when the expectation holds, else what was got
  std::string
  difference(const std::string &line, const Outcome &outcome)
  {
    std::istringstream words(line);
    std::string        first, second, relation;
    words >> first;
    if (first == "exit")
      {
        int code = -1;
        words >> code;
        return outcome.exit_code == code ?
                 "" :
                 "exit code " + std::to_string(outcome.exit_code);
      }
    if (first == "field")
      return difference_of_field(words, outcome);
    if (first == "no")
      words >> second;
    if (!second.empty() && second[0] == '/')
      return outcome.summary.contains(nlohmann::json::json_pointer(second)) ?
               "there is one" :
               "";
    if (first == "message" || first == "no")
      {
        const std::size_t begin = line.find('"'), end = line.rfind('"');
        if (begin == end)
          throw std::runtime_error("'" + line + "' has no text in quotes");
        const bool found =
          outcome.printed.find(line.substr(begin + 1, end - begin - 1)) !=
          std::string::npos;
        return found == (first == "message") ? "" :
               first == "no"                 ? "it is printed" :
                                               "it is not printed";
      }
    double            value = 0, tolerance = 0;
    const std::size_t space =
      line.find_last_of(' ', line.find_first_of("=<>")); // names have spaces
    first = line.substr(0, space);
    words.clear();
    words.str(space == std::string::npos ? "" : line.substr(space));
    words >> relation >> value;
    const bool equality = relation == "=";
    if (equality)
      words >> second >> tolerance;
    if (!words || first[0] != '/' ||
        (equality && second != "within" && second != "relative") ||
        (!equality && relation != "<" && relation != ">"))
      throw std::runtime_error("'" + line + "' is no expectation");
    if (first.rfind("/steps/last/", 0) == 0 &&
        outcome.summary.contains("steps"))
      first.replace(7, 4, std::to_string(outcome.summary["steps"].size() - 1));
    const nlohmann::json::json_pointer where(first);
    if (!outcome.summary.contains(where) ||
        !outcome.summary.at(where).is_number())
      return "summary.json has no such number";
    const double got = outcome.summary.at(where);
    if (second == "relative")
      tolerance *= std::abs(value);
    const bool         holds = equality ? std::abs(got - value) <= tolerance :
                               relation == "<" ? got < value :
                                                 got > value;
    std::ostringstream text;
    text.precision(12);
    text << got;
    return holds ? "" : text.str();
  }
} // namespace

int
main(int argc, char **argv)
{
  if (argc != 4)
    {
      std::cerr << "run MORTISE MPI_SCRIPT SCENE.prm" << std::endl;
      return 2;
    }
  const std::filesystem::path scene = argv[3];
  try
    {
      const TemporaryDirectory directory;
      const std::string  output = directory.path + "/" + scene.stem().string();
      const Expectations expectations = read_expectations(scene);
      std::string command = "cd '" + scene.parent_path().string() + "' && ";
      if (expectations.ranks > 1)
        command += std::string("'") + argv[2] + "' " +
                   std::to_string(expectations.ranks) + " ";
      command += std::string("'") + argv[1] + "'" + expectations.options +
                 " --output '" + output + "' '" + scene.string() + "'";
      const Outcome outcome = run(command, output);
      bool          good    = true;
      for (const std::string &line : expectations.lines)
        {
          const std::string got = difference(line, outcome);
          std::cout << (got.empty() ? "OK  " + line :
                                      "FAILED  " + line + ": " + got)
                    << std::endl;
          good &= got.empty();
        }
      if (!good)
        std::cout << outcome.printed << std::endl;
      return good ? 0 : 1;
    }
  catch (const std::exception &error)
    {
      std::cout << "FAILED  " << scene.string() << ": " << error.what()
                << std::endl;
      return 2;
    }
}
