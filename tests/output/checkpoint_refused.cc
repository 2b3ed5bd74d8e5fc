// Proves that a checkpoint that is damaged anywhere, or of another version,
// format or scene, is refused on all ranks with what is wrong.
#include <boost/crc.hpp>

#include <mortise/output/summary.h>

#include "checkpoint_truth.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  const std::string &
  directory()
  {
    static const std::string name = temporary_file("checkpoint");
    return name;
  }

  std::string
  file()
  {
    return checkpoint_file_name(directory());
  }

  /// Rank 0 puts @p content in the place of the checkpoint.
  void
  replace(const std::string &content)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(file(), std::ios::binary | std::ios::trunc) << content;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  CheckpointFile
  open()
  {
    return {file(), MPI_COMM_WORLD};
  }

  void
  read(const Scene &scene)
  {
    read_scene(open(), scene.bodies, scene.couplings, MPI_COMM_WORLD);
  }

  /// A file with @p content is refused with @p fragments.
  void
  check_refused(const std::string              &what,
                const std::string              &content,
                const std::vector<std::string> &fragments)
  {
    replace(content);
    check_message(what, message_of([] { open(); }), fragments);
  }

  constexpr std::size_t checksum_place = 16, format_place = 24,
                        version_place = 48;

  /// After the header.
  std::size_t
  start_of_values(const std::string &content)
  {
    std::uint64_t header;
    std::memcpy(&header, content.data() + format_place + 8, 8);
    return format_place + 16 + header;
  }

  /// @p content with the checksum of its header.
  std::string
  with_checksum(std::string content)
  {
    boost::crc_32_type crc;
    crc.process_bytes(content.data() + format_place,
                      start_of_values(content) - format_place);
    const std::uint64_t checksum = crc.checksum();
    std::memcpy(content.data() + checksum_place, &checksum, 8);
    return content;
  }

  void
  test_truncation(const std::string &good)
  {
    const std::size_t start = start_of_values(good);
    for (const auto &[name, size] :
         std::vector<std::pair<std::string, std::size_t>>{
           {"nothing", 0},
           {"one byte", 1},
           {"all but one byte of the start", format_place + 15},
           {"the start", format_place + 16},
           {"half of the header", start / 2},
           {"all of the header", start},
           {"one byte of the values", start + 1},
           {"half of the file", good.size() / 2},
           {"all but one byte", good.size() - 1}})
      check_refused("truncated, left is " + name,
                    good.substr(0, size),
                    {"damaged",
                     size < start ?
                       "ends after " + std::to_string(size) :
                       std::to_string(size) + " bytes instead of " +
                         std::to_string(good.size())});
    check_refused("a byte too many", good + "x", {"bytes instead of"});
    std::string zeros = good;
    std::fill(zeros.end() - 100, zeros.end(), '\0');
    check_refused("zeros at the end",
                  zeros,
                  {"damaged", "values", "do not match their checksum"});
  }

  void
  test_changed_bytes(const std::string &good)
  {
    const std::size_t start = start_of_values(good);
    std::mt19937      random(2);
    unsigned int      n_missed = 0, n_silent = 0;
    for (unsigned int i = 0; i < 400; ++i)
      {
        std::string content = good;
        // half of them in the header
        content[random() % (i % 2 ? start : good.size())] ^=
          static_cast<char>(1 + random() % 255);
        replace(content);
        const std::string message = message_of([] { open(); });
        n_missed += message == "(no error)";
        n_silent += message.find("damaged") == std::string::npos;
      }
    verdict("400 files with one byte changed are refused", n_missed, 0);
    verdict("... as damaged", n_silent, 0);
  }

  /// @p content with numbers of its header and of what follows changed, and with
  /// checksums that are right again.
  std::string
  with_lies(const std::string &content, std::mt19937 &random)
  {
    std::string       result = content;
    const std::size_t start  = start_of_values(content);
    const auto change = [&](const std::size_t first, const std::size_t end) {
      std::uint64_t number = 0;
      switch (random() % 4)
        {
          case 0:
            number = random() % 300;
            break;
          case 1:
            number = std::uint64_t(1) << (random() % 64);
            break;
          case 2:
            number = -1 - std::uint64_t(random() % 10);
            break;
          default:
            number = (std::uint64_t(random()) << 32) + random();
        }
      const std::size_t size = std::size_t(1) << (random() % 4);
      const std::size_t at   = first + random() % (end - first - size);
      std::memcpy(&result[at], &number, size);
    };
    if (random() % 2 == 0)
      {
        change(version_place + program_info(1).version.size(), start);
        return with_checksum(result);
      }
    change(start, result.size());
    // the header: version, names of sections, sizes and checksums of ranks
    constexpr std::size_t    begin = format_place + 16;
    const std::string        header(content, begin, start - begin);
    ByteArchive              archive(header);
    std::string              version;
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::array<std::uint64_t, 2>>> ranks;
    archive &version &names                                         &ranks;
    std::size_t                                                      at = start;
    for (auto &of_rank : ranks)
      for (const std::string &name : names)
        if (of_rank.count(name) > 0)
          {
            auto &[size, checksum] = of_rank[name];
            boost::crc_32_type crc;
            crc.process_bytes(result.data() + at, size);
            checksum = crc.checksum();
            at += size;
          }
    const std::string changed =
      to_bytes(version) + to_bytes(names) + to_bytes(ranks);
    return with_checksum(result.replace(begin, changed.size(), changed));
  }

  /// Sizes and numbers in a file are checked.
  void
  test_lies(const Scene &scene, const std::string &good)
  {
    std::mt19937 random(3);
    unsigned int n_refused = 0, n_other = 0;
    for (unsigned int i = 0; i < 400; ++i)
      {
        replace(with_lies(good, random));
        const std::string message = message_of([&] { read(scene); });
        n_refused += message != "(no error)";
        n_other +=
          message != "(no error)" && message.find("The checkpoint \"") != 0;
      }
    // the rest has another text, or other values of dofs
    verdict("of 400 files that lie half are refused", n_refused < 200, 0);
    verdict("... with a message on the checkpoint", n_other, 0);
    replace(good);
  }

  void
  test_versions(const std::string &good)
  {
    std::string other    = good;
    other[version_place] = 'x';
    check_refused("another version",
                  with_checksum(other),
                  {"was written by version \"x",
                   "this is version \"" + program_info(1).version + "\""});
    other               = good;
    other[format_place] = 2;
    check_refused("another format",
                  with_checksum(other),
                  {"has format 2, allowed is format 7"});
    check_refused("no checkpoint", std::string(1000, 'M'), {"no checkpoint"});
    replace(good);
    check_message("no file",
                  message_of([] {
                    CheckpointFile(directory() + "/none", MPI_COMM_WORLD);
                  }),
                  {"Cannot read the checkpoint \"", "No such file"});
    verdict("the good one is read",
            message_of([] { open(); }) != "(no error)",
            0);
  }

  /// The tetrahedra of a file of version 2.2 in the opposite order.
  std::string
  renumbered(const std::string &name)
  {
    std::istringstream       in(gmsh_test::read_file(name));
    std::ostringstream       out;
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      {
        std::istringstream words(line);
        std::string        number, type, rest;
        words >> number >> type;
        std::getline(words, rest);
        if (type == "4" && !rest.empty() && rest.find('"') == std::string::npos)
          lines.push_back(" " + type + rest);
        else
          {
            for (unsigned int i = 0; i < lines.size(); ++i)
              out << 1000 + i << lines[lines.size() - 1 - i] << '\n';
            lines.clear();
            out << line << '\n';
          }
      }
    return gmsh_test::write_file("renumbered.msh", out.str());
  }

  /// The scene as @p change leaves it is refused.
  void
  check_change(const Given                        &given,
               const std::string                  &what,
               const std::function<void(Given &)> &change,
               const std::vector<std::string>     &fragments)
  {
    Given other = given;
    change(other);
    const Scene scene(other, MPI_COMM_WORLD);
    check_message(what, message_of([&] { read(scene); }), fragments);
  }

  void
  test_other_bodies(const Given &given)
  {
    check_change(given,
                 "another degree",
                 [](Given &other) { other.bodies[brick].degree = 2; },
                 {"body \"brick\" has degree 1, now degree 2"});
    check_change(given,
                 "other degrees",
                 [](Given &other) {
                   other.bodies[outer].regions[1] = 1;
                   other.bodies[outer].mixed      = false;
                 },
                 {"body \"outer\" has degrees 2 to 4, now degrees 1 to 4"});
    check_change(given,
                 "degrees exchanged between regions",
                 [](Given &other) {
                   other.bodies[bar].regions = {{0, 3}, {1, 2}};
                 },
                 {"body \"bar\" has its degrees in other cells than now"});
    check_change(given,
                 "degrees of other regions",
                 [](Given &other) {
                   other.bodies[inner].regions = {{0, 2}, {1, 3}, {2, 4}};
                 },
                 {"body \"inner\""});
    check_change(given,
                 "another form",
                 [](Given &other) { other.bodies[inner].mixed = false; },
                 {"body \"inner\" has pressures, now it has none"});
    check_change(given,
                 "another shape",
                 [](Given &other) {
                   other.bodies[bar].mesh.cells = "tetrahedra";
                 },
                 {"body \"bar\" consists of hexahedra, now of tetrahedra"});
    check_change(given,
                 "another number of cells",
                 [](Given &other) {
                   other.bodies[bar].mesh.subdivisions = {3, 1, 1};
                 },
                 {"body \"bar\" has 2 cells, now 3"});
  }

  void
  test_other_geometry(const Given &given)
  {
    check_change(given,
                 "another place of the refinement",
                 [](Given &other) {
                   other.bodies[inner].mesh.refine_near = "0, 1.5, 0, 0.4, 1";
                 },
                 {"body \"inner\""});
    check_change(given,
                 "vertices elsewhere in the same box",
                 [](Given &other) { other.bodies[bar].mesh.distort = 0.2; },
                 {"body \"bar\" has another geometry"});
    check_change(given,
                 "moved by 1e-8",
                 [](Given &other) {
                   other.bodies[block].mesh.translate[1] = 1e-8;
                 },
                 {"body \"block\" has another geometry"});
    check_change(given,
                 "the same mesh with cells in another order",
                 [](Given &other) {
                   other.bodies[block].mesh.file =
                     renumbered(other.bodies[block].mesh.file);
                 },
                 {"(no error)"});
    check_change(
      given,
      "a body missing",
      [](Given &other) { other.bodies.pop_back(); },
      {"the bodies inner, outer, block, solid, brick, bar, the scene has inner, outer, block, solid, brick"});
  }

  void
  test_other_interfaces(const Given &given)
  {
    check_change(given,
                 "another interface",
                 [](Given &other) { other.interfaces[1].name = "weld"; },
                 {"the interfaces glue, seam, the scene has glue, weld"});
    check_change(given,
                 "no interfaces",
                 [](Given &other) { other.interfaces.clear(); },
                 {"the interfaces glue, seam, the scene has (none)"});
    check_change(
      given,
      "sides exchanged",
      [](Given &other) {
        other.interfaces[1] = {"seam", brick, "zmin", block, "top"};
      },
      {"interface \"seam\" has its slave on body \"block\", now on body \"brick\""});
    check_change(given,
                 "another number of slave faces",
                 [](Given &other) {
                   other.interfaces[0].slave_boundary = "xmin";
                 },
                 {"interface \"glue\" has ", " slave faces, now "});
    check_change(
      given,
      "other slave faces",
      [](Given &other) { other.interfaces[1].slave_boundary = "bottom"; },
      {"interface \"seam\" has no values for some of the slave faces"});
    check_change(given,
                 "two things",
                 [](Given &other) {
                   other.bodies[brick].degree = 2;
                   other.interfaces[1].name   = "weld";
                 },
                 {"degree 2", "weld"});
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Given                      given = given_scene();
  const Scene                      scene(given, MPI_COMM_WORLD);
  write_checkpoint(directory(),
                   {},
                   Truth(given).spread(scene),
                   scene.bodies,
                   scene.couplings,
                   MPI_COMM_WORLD);
  const std::string good = gmsh_test::read_file(file());
  test_truncation(good);
  test_changed_bytes(good);
  test_lies(scene, good);
  test_versions(good);
  test_other_bodies(given);
  test_other_geometry(given);
  test_other_interfaces(given);
}
