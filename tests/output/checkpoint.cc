// Proves that a checkpoint gives every number back bit for bit, whatever the
// numbers of ranks that write and read it, on hexahedra of generators and of
// files with hanging nodes and several degrees, on tetrahedra of both, with
// pressures, and where ranks own no cells; that each number is in the file
// once.
#include <temporary_file.h>

#include <filesystem>

#include "checkpoint_truth.h"

using namespace mortise;
using namespace mortise::testing;

namespace
{
  /// Some of the ranks of the world.
  struct Group
  {
    std::string name;
    MPI_Comm    comm;
    bool        member;
  };

  std::vector<Group>
  groups()
  {
    const unsigned int me = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n  = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const bool         in = me < std::max(n - 1, 1u);
    MPI_Comm           fewer;
    MPI_Comm_split(MPI_COMM_WORLD, in, me, &fewer);
    return {{"one rank", MPI_COMM_SELF, me == 0},
            {"all ranks but one", fewer, in},
            {"all ranks", MPI_COMM_WORLD, true}};
  }

  /// Bytes that the header needs for @p n_ranks: names, sizes and checksums of
  /// the sections of each rank.
  std::size_t
  header_of_ranks(const unsigned int n_ranks)
  {
    std::size_t size = 0;
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        size += 8;
        for (const std::string name : {"displacements",
                                       "multipliers",
                                       "pressures",
                                       "nothing",
                                       "scene",
                                       "text"})
          if (r == 0 || name.size() > 8)
            size += 8 + name.size() + 16;
      }
    return size;
  }

  /// Of the caller, the same on all ranks.
  const Sections sections = {{"nothing", ""},
                             {"text", std::string("{\"step\": 3}\0 end", 16)}};

  void
  test_ranks(const Given &given, const Truth &truth)
  {
    const std::string        directory = temporary_file("checkpoint");
    const std::string        file      = checkpoint_file_name(directory);
    const std::vector<Group> all       = groups();
    std::vector<std::unique_ptr<Scene>> scenes;
    for (const Group &group : all)
      scenes.push_back(std::make_unique<Scene>(given, group.comm));
    std::uint64_t size = 0;
    for (unsigned int w = 0; w < all.size(); ++w)
      {
        if (all[w].member)
          write_checkpoint(directory,
                           sections,
                           truth.spread(*scenes[w]),
                           scenes[w]->bodies,
                           scenes[w]->couplings,
                           all[w].comm);
        MPI_Barrier(MPI_COMM_WORLD);
        const auto of_values =
          std::filesystem::file_size(file) -
          header_of_ranks(Utilities::MPI::broadcast(
            MPI_COMM_WORLD, Utilities::MPI::n_mpi_processes(all[w].comm), 0));
        size = w == 0 ? of_values : size;
        verdict("written by " + all[w].name + ": each value once",
                of_values != size,
                0);
        for (unsigned int r = 0; r < all.size(); ++r)
          {
            unsigned int n_wrong = 0;
            if (all[r].member)
              {
                const CheckpointFile archive(file, all[r].comm);
                n_wrong = truth.n_wrong(*scenes[r],
                                        read_scene(archive,
                                                   scenes[r]->bodies,
                                                   scenes[r]->couplings,
                                                   all[r].comm));
                for (const auto &[name, bytes] : sections)
                  n_wrong += archive.read(name) != bytes;
              }
            verdict("written by " + all[w].name + ", read by " + all[r].name,
                    Utilities::MPI::sum(n_wrong, MPI_COMM_WORLD),
                    0);
          }
      }
    const std::filesystem::directory_iterator files(directory);
    verdict("no other file is left",
            std::distance(begin(files), end(files)) - 1,
            0);
    check_message("a directory that is a file",
                  message_of([&] {
                    write_checkpoint(file,
                                     sections,
                                     truth.spread(*scenes.back()),
                                     scenes.back()->bodies,
                                     scenes.back()->couplings,
                                     MPI_COMM_WORLD);
                  }),
                  {"cannot write"});
    MPI_Comm fewer = all[1].comm;
    scenes.clear();
    MPI_Comm_free(&fewer);
  }

  /// Files are longer than a block only when they are large.
  void
  test_blocks(const Given &given, const Truth &truth)
  {
    const std::string directory = temporary_file("checkpoint_blocks");
    const Scene       scene(given, MPI_COMM_SELF);
    const auto        read = [&](const std::uint64_t block) {
      return read_scene(CheckpointFile(checkpoint_file_name(directory),
                                       MPI_COMM_SELF),
                        scene.bodies,
                        scene.couplings,
                        MPI_COMM_SELF,
                        block);
    };
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        write_checkpoint(directory,
                         sections,
                         truth.spread(scene),
                         scene.bodies,
                         scene.couplings,
                         MPI_COMM_SELF);
        for (const std::uint64_t size : {1, 5, 777, 100000})
          verdict("records in blocks of " + std::to_string(size) + " bytes",
                  truth.n_wrong(scene, read(size)),
                  0);
      }
  }

  void
  test_sections()
  {
    const std::string directory = temporary_file("checkpoint_sections");
    const std::string file      = checkpoint_file_name(directory);
    const std::string records   = to_bytes(std::string("a record"));
    write_checkpoint_file(file,
                          {{"of a later program", "x"}, {"short", "12"}},
                          {{"records", records},
                           {"half", records.substr(0, records.size() - 1)}},
                          MPI_COMM_WORLD);
    const CheckpointFile archive(file, MPI_COMM_WORLD);
    unsigned int         n_records = 0;
    archive.for_each_record("records", [&](const std::string &record) {
      n_records += record == "a record";
    });
    verdict("records of all ranks",
            n_records - Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
            0);
    check_message("a section that is missing",
                  message_of([&] { archive.read("shortenings"); }),
                  {"has no section \"shortenings\""});
    check_message("a section that is too short",
                  message_of([&] { archive.get<double>("short"); }),
                  {"damaged", "there are 2 bytes where 8 are expected"});
    check_message("records that end too early",
                  message_of([&] {
                    archive.for_each_record("half", [](const auto &) {});
                  }),
                  {"damaged", "section \"half\" ends within a record"});
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Given                      given = given_scene();
  const Truth                      truth(given);
  test_ranks(given, truth);
  test_blocks(given, truth);
  test_sections();
}
