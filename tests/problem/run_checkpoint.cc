// Proves that what the driver keeps in a checkpoint comes back as it was, and
// that a text with a right checksum and wrong contents is refused with a
// message on the checkpoint or on a parameter: it never crashes and never takes
// memory for what it only claims to hold.
#include <deal.II/base/mpi.h>

#include <mortise/problem/run_checkpoint.h>
#include <mortise/problem/simulation.h>
#include <temporary_file.h>
#include <verdict.h>

#include <cstring>
#include <filesystem>
#include <random>

using namespace dealii;
using namespace mortise;

namespace
{
  const std::string directory = "run_checkpoint";

  const std::string scene = R"(
set Bodies     = low, high
set Interfaces = glue
subsection Body low
  set Degree = 1
  subsection Mesh
    set Source       = box
    set Extent       = 0, 0, 0, 1, 1, 1
    set Subdivisions = 2, 2, 1
  end
  subsection Material
    set Young modulus = 1
  end
  subsection Boundary zmin
    set Displacement = 0, 0, 0
  end
end
subsection Body high
  set Degree = 1
  subsection Mesh
    set Source       = box
    set Extent       = 0, 0, 1, 1, 1, 2
    set Subdivisions = 1, 1, 1
  end
  subsection Material
    set Young modulus = 2
  end
  subsection Boundary zmax
    set Traction = 0.1; 0; 0
  end
end
subsection Interface glue
  set Slave  = low: zmax
  set Master = high: zmin
end
subsection Adaptivity
  set Target error = 0.2
end
subsection Output
  set Directory        = run_checkpoint
  set Fields           =
  set Checkpoint every = 1
end
)";

  /// Of what --restart does before it makes a mesh.
  std::string
  message_of_restart()
  {
    return message_of([] {
      const RunCheckpoint checkpoint =
        read_run_checkpoint(directory, MPI_COMM_WORLD);
      const Parameters parameters =
        restart_parameters(checkpoint, {}, directory);
      validate(parameters);
      std::ostringstream silence;
      RunLog             log(silence, MPI_COMM_WORLD);
      Simulation         simulation(parameters, log, MPI_COMM_WORLD);
      simulation.resume(checkpoint, directory);
    });
  }

  void
  replace(const Sections &sections)
  {
    write_checkpoint_file(checkpoint_file_name(directory),
                          sections,
                          {},
                          MPI_COMM_WORLD);
  }

  std::string
  with_changed_bytes(std::string bytes, std::mt19937 &random)
  {
    const std::size_t at = random() % bytes.size();
    switch (random() % 5)
      {
        case 0:
          bytes[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          bytes.resize(at);
          break;
        case 2:
          bytes.erase(at, 1 + random() % 8);
          break;
        default:
          {
            const std::uint64_t number = random() % 2 == 0 ?
                                           std::uint64_t(1) << (random() % 64) :
                                           -1 - std::uint64_t(random() % 3);
            std::memcpy(&bytes[at],
                        &number,
                        std::min<std::size_t>(bytes.size() - at,
                                              1 << (random() % 4)));
          }
      }
    return bytes;
  }

  /// One value of JSON in place of another.
  std::string
  with_changed_value(std::string text, std::mt19937 &random)
  {
    static const std::vector<std::string> values = {"null",
                                                    "true",
                                                    "-1",
                                                    "0",
                                                    "7",
                                                    "1e300",
                                                    "4294967296",
                                                    "0.5",
                                                    "\"\"",
                                                    "\"x\"",
                                                    "[]",
                                                    "{}",
                                                    "[[1]]",
                                                    "18446744073709551615"};
    const std::size_t                     begin =
      text.find_first_of(":,[", random() % (text.size() - 2)) + 1;
    const std::size_t end = begin == 0 ? 0 : text.find_first_of(",]}:", begin);
    if (begin > 0 && end != std::string::npos)
      text.replace(begin, end - begin, values[random() % values.size()]);
    return text;
  }

  void
  test_lies(const std::string &what,
            Sections           good,
            const std::string &section,
            std::string (*change)(std::string, std::mt19937 &))
  {
    std::mt19937      random(5);
    const std::string bytes     = good.at(section);
    unsigned int      n_refused = 0, n_not_foreseen = 0;
    for (unsigned int i = 0; i < 300; ++i)
      {
        good[section] = change(bytes, random);
        replace(good);
        const std::string message = message_of_restart();
        n_refused += message != "(no error)";
        if (message.find("another kind") == 0)
          {
            ++n_not_foreseen;
            std::cout << message << std::endl;
          }
      }
    verdict(what + ": some of 300 are refused", n_refused < 50, 0);
    verdict(what + ": nothing but messages", n_not_foreseen, 0);
  }

  void
  refused(const std::string &what,
          const Sections    &sections,
          const std::string &fragment)
  {
    replace(sections);
    const std::string message = message_of_restart();
    verdict("refused: " + what + " (" + fragment + ")",
            message.find("The checkpoint \"") != 0 ||
              message.find(fragment) == std::string::npos,
            0);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // the parameters, which are changed at random, name the same directory always
  std::filesystem::current_path(temporary_file(""));
  {
    const Parameters   parameters = parse_parameters(scene, "test", {});
    std::ostringstream silence;
    RunLog             log(silence, MPI_COMM_WORLD);
    Simulation(parameters, log, MPI_COMM_WORLD).run();
  }
  Sections good;
  {
    const CheckpointFile file(checkpoint_file_name(directory), MPI_COMM_WORLD);
    for (const std::string name :
         {"run", "contact status", "shortenings", "motions", "adaptivity"})
      good[name] = file.read(name);
  }
  verdict("a run of cycles left its state", good["adaptivity"].size() < 100, 0);
  verdict("its sections come back as they were",
          to_sections(read_run_checkpoint(directory, MPI_COMM_WORLD)) != good,
          0);
  replace(good);
  check_message("they are taken", message_of_restart(), {"(no error)"});

  const auto with = [&](const std::string &section, const std::string &bytes) {
    Sections sections = good;
    sections[section] = bytes;
    return sections;
  };
  const auto changed = [&](const std::string &from, const std::string &to) {
    std::string text = good["run"];
    return with("run", text.replace(text.find(from), from.size(), to));
  };
  Sections more = with("of a later program", "anything");
  replace(more);
  check_message("a section that nobody knows is skipped",
                message_of_restart(),
                {"(no error)"});
  for (const std::string name :
       {"contact status", "run", "shortenings", "motions"})
    {
      Sections fewer = good;
      fewer.erase(name);
      refused("one that is missing", fewer, "has no section \"" + name + "\"");
    }
  refused("no JSON", with("run", "{"), "its text cannot be read");
  refused("a number of steps that is negative",
          changed("\"n_steps\":", "\"n_steps\":-"),
          "there is -");
  refused("a number of steps that is none",
          changed("\"n_steps\":", "\"n_steps\":\"x\",\"n\":"),
          "there is \"x\" where another kind of value is expected");
  refused("a time that is not finite",
          changed("\"time\":", "\"time\":null,\"t\":"),
          "it has reached the time");
  refused("a shortening that is not finite",
          with("shortenings",
               to_bytes(std::vector<double>{
                 std::numeric_limits<double>::quiet_NaN()})),
          "values that are not finite");
  refused("a motion that is not finite",
          with("motions",
               to_bytes(
                 std::vector<double>{std::numeric_limits<double>::infinity()})),
          "values that are not finite");
  const std::string cycles = good["adaptivity"];
  refused("half of the cycles",
          with("adaptivity", cycles.substr(0, cycles.size() / 2)),
          "bytes where");
  refused("more than the cycles",
          with("adaptivity", cycles + "x"),
          "bytes too many");

  test_lies("bytes of the text", good, "run", with_changed_bytes);
  test_lies("values of the text", good, "run", with_changed_value);
  test_lies("bytes of the cycles", good, "adaptivity", with_changed_bytes);
  test_lies("bytes of the contact", good, "contact status", with_changed_bytes);
}
