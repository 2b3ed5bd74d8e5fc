// Proves that a checkpoint gives every number back bit for bit, whatever the
// numbers of ranks that write and read it, on hexahedra of generators and of
// files with hanging nodes and several degrees, on tetrahedra of both, with
// pressures, and where ranks own no cells; that each number is in the file
// once.
#include <mortise/output/checkpoint_records.h>

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

  void
  test_ranks(const Given &given, const Truth &truth)
  {
    const std::string        directory = gmsh_test::own_name("checkpoint");
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
                           truth.spread(*scenes[w]),
                           scenes[w]->bodies,
                           scenes[w]->couplings,
                           all[w].comm);
        MPI_Barrier(MPI_COMM_WORLD);
        const auto of_values =
          std::filesystem::file_size(file) -
          16 * Utilities::MPI::broadcast(MPI_COMM_WORLD,
                                         Utilities::MPI::n_mpi_processes(
                                           all[w].comm),
                                         0);
        size = w == 0 ? of_values : size;
        verdict("written by " + all[w].name + ": each value once",
                of_values != size,
                0);
        for (unsigned int r = 0; r < all.size(); ++r)
          {
            unsigned int n_wrong = 0;
            if (all[r].member)
              n_wrong = truth.n_wrong(*scenes[r],
                                      read_checkpoint(directory,
                                                      scenes[r]->bodies,
                                                      scenes[r]->couplings,
                                                      all[r].comm));
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
                                     truth.spread(*scenes.back()),
                                     scenes.back()->bodies,
                                     scenes.back()->couplings,
                                     MPI_COMM_WORLD);
                  }),
                  {"cannot write"});
    MPI_Barrier(MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(directory);
    MPI_Comm fewer = all[1].comm;
    scenes.clear();
    MPI_Comm_free(&fewer);
  }

  /// Files are longer than a block only when they are large.
  void
  test_blocks(const Given &given, const Truth &truth)
  {
    const Scene       scene(given, MPI_COMM_SELF);
    const std::string records =
      pack_records(truth.spread(scene), scene.bodies, scene.couplings);
    for (const std::size_t size : {1, 5, 777, 100000})
      {
        RecordReader reader(scene.bodies, scene.couplings);
        for (std::size_t start = 0; start < records.size(); start += size)
          reader.take(records.substr(start, size));
        const std::string problem = reader.finish();
        Checkpoint        got     = reader.result();
        got.text                  = truth.text();
        verdict("records in blocks of " + std::to_string(size) + " bytes" +
                  (problem.empty() ? "" : ": " + problem),
                truth.n_wrong(scene, got) + !problem.empty(),
                0);
      }
    RecordReader reader(scene.bodies, scene.couplings);
    reader.take(records.substr(0, records.size() - 1));
    check_message("records that end too early",
                  reader.finish(),
                  {"interface \"seam\" has no values"});
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Given                      given = given_scene("checkpoint");
  const Truth                      truth(given);
  test_ranks(given, truth);
  test_blocks(given, truth);
}
